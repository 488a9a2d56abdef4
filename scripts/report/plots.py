"""The figures of bristle_plots as inline SVG, without header and verdicts: the page has these as text."""

import importlib
import io
import re

import numpy as np
from markupsafe import Markup, escape
from matplotlib.transforms import Bbox

from bristle_plots.layout import CAPTION_INCHES, HEADER
from bristle_plots.readings import pages
from bristle_plots.results import as_text, axis_names, axis_values, dataset, read
from bristle_plots.style import METADATA
from bristle_plots.verdicts import STRIP, read_claims, strip_height
from symbols import plain

# Of the modules' further figures.
FURTHER_NAMES = {"energy": "energy budget", "parts": "factors of the friction"}


def draw(name, file, verdicts):
    """The figure's drawings: SVG element, what it shows besides the figure's heading, and its width (inches).

    verdicts: the claims with their verdicts under each reading, for the description.
    """
    module = importlib.import_module(f"bristle_plots.figures.{name}")
    title, description = plain(as_text(file.attrs["title"])), describe(module, file, verdicts)
    out = []
    for ending, function in {"": module.draw, **getattr(module, "FURTHER", {})}.items():
        for page, reading, figure in pages(function, file):
            shown = ", ".join(filter(None, [FURTHER_NAMES.get(ending, ending), reading]))
            identity = "-".join(filter(None, [name, ending])) + page
            out.append({"shown": shown, "width": round(100 * figure.get_figwidth()),
                        "svg": inline(content(figure, file), identity, f"{title}{shown and f' ({shown})'}",
                                      description)})
    return out


def content(figure, file):
    """The SVG of a figure without header and verdicts."""
    width, height = figure.get_size_inches()
    top, foot = height, 0
    for artist in figure.texts:
        if artist.get_gid() == HEADER:
            artist.set_visible(False)
            top = min(top, artist.get_position()[1] * height - CAPTION_INCHES)
    for axes in figure.axes:
        if axes.get_gid() == STRIP:
            axes.set_visible(False)
            foot = strip_height(read_claims(file), width)
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata=METADATA["svg"], bbox_inches=Bbox([[0, foot], [width, top]]))
    return buffer.getvalue()


def inline(svg, name, title, description):
    """The SVG as an element of a page with several: unique ids, and no style rules that affect the rest."""
    svg = svg[svg.index("<svg"):]
    svg = re.sub(r"<style.*?</style>", "", svg, flags=re.DOTALL)
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    used = set(re.findall(r'(?:href="|url\()#([^")]*)', svg))
    svg = re.sub(r' id="([^"]*)"',
                 lambda found: f' id="{name}-{found.group(1)}"' if found.group(1) in used else "", svg)
    svg = re.sub(r'href="#', f'href="#{name}-', svg)
    svg = svg.replace("url(#", f"url(#{name}-")
    box = re.search(r'viewBox="([^"]*)"', svg).group(1)
    words = (f'<title id="{name}-title">{escape(title)}</title>'
             f'<desc id="{name}-desc">{escape(description)}</desc>')
    start = (f'<svg xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="{box}" class="plot" role="img" '
             f'aria-labelledby="{name}-title {name}-desc" stroke-linejoin="round" stroke-linecap="butt">')
    return Markup(start + words + svg[svg.index(">") + 1:])


def describe(module, file, verdicts):
    """The plotted variables with their ranges and the verdicts, in words."""
    shown = [name for name in getattr(module, "VARIABLES", ["R_n", "z_0"]) if name in file]
    sentences = [module.__doc__.splitlines()[0], plain(as_text(file.attrs.get("caption", ""))) + "."]
    ranges = [axis_range(file, name) for name in axis_names(dataset(file, "status"))]
    if ranges:
        sentences.append(f"Swept: {'; '.join(ranges)}.")
    sentences.append(f"Plotted: {'; '.join(value_range(file, name) for name in shown)}.")
    for found in verdicts:
        heading = ", ".join(filter(None, ["Verdicts", found["reading"]]))
        sentences.append(f"{heading}: {', '.join(f'{claim} {verdict}' for claim, verdict, _ in found['claims'])}.")
    return " ".join(sentences)


def axis_range(file, name):
    line = axis_values(file, name)
    if isinstance(line[0], str):
        return f"{name}: {', '.join(line)}"
    return f"{name} from {line[0]:g} to {line[-1]:g}, {len(line)} values"


def value_range(file, name):
    numbers = read(file, name)
    numbers = numbers[np.isfinite(numbers)]
    what = f"{name} ({as_text(file[name].attrs['long_name'])})"
    return f"{what} from {numbers.min():.3g} to {numbers.max():.3g}" if numbers.size else f"{what}, no values"
