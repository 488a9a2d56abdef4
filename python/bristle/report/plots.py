"""The figures as inline SVG, without header and verdicts: the page has these as text."""

import io
import math
import re

import numpy as np
from markupsafe import Markup, escape
from matplotlib.transforms import Bbox

from ..figures import module_of, own_figure
from ..plotting.curves import kept
from ..plotting.layout import CAPTION_INCHES, HEADER, NOTE
from ..plotting.readings import reading_name, readings
from ..plotting.style import METADATA
from ..plotting.verdicts import STRIP, read_claims, strip_height
from ..results import as_text, axis_names, axis_values, dataset, read, readable, require_axes
from .symbols import plain, prose

NARROW = "3.5in"  # page of the drawings for phones, whose letters have at least 9 pixels there
LEAST_LETTER = 9  # pixels on the screen
LETTERS = re.compile(r"scale\(0?(\.\d+) -")  # of glyphs, in hundredths of their size in an SVG's units
LONG_NUMBER = re.compile(r"-?\d+\.\d{3,}")  # of an SVG's units, 1/72 inch
EQUAL_LINES = re.compile(r'<path d="[^"]*"( clip-path="[^"]*" style="fill: none;[^"]*"/>)(?:\s*<path d="[^"]*"\1)+')

# Of the modules' further figures.
FURTHER_NAMES = {"energy": "energy budget", "parts": "factors of the friction"}


def draw(name, file, verdicts):
    """The figure's drawings, one for each reading: what it shows besides the figure's heading, and two layouts of it.

    wide: panels side by side, `width` pixels wide; narrow: where the wide one's letters would be too small, panels below each
    other, without its note. Both have the same ids: a page has one of them at a time.
    verdicts: for each reading the claims with their verdicts, for the description.
    """
    module = module_of(own_figure(name))
    require_axes(file, name, module.AXES)
    title, description = plain(as_text(file.attrs["title"])), describe(module, file, verdicts)
    out = []
    for ending, function in {"": module.draw, **getattr(module, "FURTHER", {})}.items():
        parts = [(reading, file.sel({axis: [word] for axis, word in reading.items()})) for reading in readings(file)]
        wide, narrow = ([function(part, **page) for _, part in parts] for page in ({}, {"width": NARROW}))
        share_limits(wide)
        share_limits(narrow)
        for (reading, part), *figures in zip(parts, wide, narrow):
            shown = ", ".join(filter(None, [FURTHER_NAMES.get(ending, ending), reading_name(reading)]))
            identity = "-".join(filter(None, [name, ending, *reading.values()])).replace("_", "-")
            words = identity, f"{title}{shown and f' ({shown})'}", description
            out.append({"name": identity, "shown": shown, "reading": "".join(reading.values()),
                        "width": round(100 * figures[0].get_figwidth()), "note": note_of(figures[0]),
                        **{kind: layout(figure, part, words) for kind, figure in zip(("wide", "narrow"), figures)}})
    return out


def layout(figure, file, words):
    """The SVG element, its width over its height, the least width (pixels) at which its letters can be read, and the points of
    its curves; words: those of `inline`."""
    foot, top = trim(figure, file)
    svg = as_svg(figure, foot, top)
    least = 100 * min(map(float, LETTERS.findall(svg)))
    return {"shape": f"{figure.get_figwidth() / (top - foot):.3f}", "points": points_of(figure, top),
            "least": math.ceil(72 * figure.get_figwidth() * LEAST_LETTER / least), "svg": inline(svg, *words)}


def note_of(figure):
    return prose(" ".join(text.get_text() for text in figure.texts if text.get_gid() == NOTE))


def share_limits(figures):
    """The same ranges under all readings in panels with curves."""
    for panels in zip(*(figure.axes for figure in figures)):
        if not all(map(kept, panels)):
            continue
        for which in "xy":
            limits = [getattr(axes, f"get_{which}lim")() for axes in panels]
            common = min(low for low, _ in limits), max(high for _, high in limits)
            for axes in panels:
                getattr(axes, f"set_{which}lim")(common)


def trim(figure, file):
    """Hides header and verdicts; returns the lower and the upper end of the rest (inches)."""
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
    return foot, top


def as_svg(figure, foot, top):
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata=METADATA["svg"],
                   bbox_inches=Bbox([[0, foot], [figure.get_figwidth(), top]]))
    svg = re.sub(r' d="[^"]*"', lambda path: LONG_NUMBER.sub(lambda found: f"{float(found.group()):.1f}", path.group()),
                 buffer.getvalue())
    return EQUAL_LINES.sub(joined, svg)


def joined(lines):
    """Lines of one look, one after the other, as one path."""
    places = " ".join(re.findall(r' d="([^"]*)"', lines.group()))
    return f'<path d="{places}"{lines.group(1)}'


def points_of(figure, top):
    """The curves of a drawing: what they show, and their points with place in the SVG, x, y, error of y and status."""
    out = []
    for axes in figure.axes:
        for curve, drawn in kept(axes):
            places = axes.transData.transform(drawn) / figure.dpi
            box = axes.bbox.padded(2)
            rows = [[round(72 * x, 1), round(72 * (top - y), 1), *numbers([curve.x[i], curve.y[i], curve.error[i]]),
                     readable(curve.meanings[curve.status[i]]) if curve.status[i] else ""]
                    for i, (x, y) in enumerate(places) if box.contains(x * figure.dpi, y * figure.dpi)]
            if rows:
                out.append({"along": str(prose(curve.along)), "title": str(prose(curve.title)),
                            "chosen": str(prose(curve.chosen)), "points": rows})
    return out


def numbers(values):
    """Numbers for JSON: null where there is no value."""
    return [float(value) if np.isfinite(value) else None for value in values]


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
    for reading, found in verdicts.items():
        heading = ", ".join(filter(None, ["Verdicts", reading]))
        sentences.append(f"{heading}: {', '.join(' '.join(one) for one in found)}.")
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
