"""The figures as SVG within the page, as matplotlib writes it, without titles and verdicts: the page has these as text."""

import base64
import io
import re

from PIL import Image
from markupsafe import Markup, escape
from matplotlib import rc_context
from matplotlib.collections import Collection
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from ..figures import module_of, own_figure
from ..plotting.captions import marks_of
from ..plotting.readings import pages, reading_name
from ..plotting.style import METADATA
from ..results import as_text, require_axes
from .symbols import plain, prose

# Letters are text in the reader's font. Lines may be half a pixel from what they show.
LOOK = {"svg.fonttype": "none", "path.simplify_threshold": 0.5}
MOST_PATHS, DPI, COLOURS = 50, 100, 64  # maps, surfaces and paths of more parts are images within the SVG
# Of numbers a hundredth of 1/72 inch is enough, above ten a tenth; and letters need no space between.
SHORTER = {r"(\.\d\d)\d+": r"\1", r"(\d\d\.\d)\d": r"\1", r"\s*([A-Za-z])\s*": r"\1"}

# Of the modules' further figures.
FURTHER_NAMES = {"energy": "energy budget", "parts": "factors of the friction"}


def draw(name, file, styles):
    """Each page of the figure and of its further figures: the words that tell it from the others, its label, its SVG, its width
    (inches), and with the last page what the marks mean. styles: see `inline`."""
    module = module_of(own_figure(name))
    require_axes(file, name, module.AXES)
    title, out = plain(as_text(file.attrs["title"])), []
    for ending, function in {"": module.draw, **getattr(module, "FURTHER", {})}.items():
        for _, reading, figure in pages(function, file, plain=True):
            shown = ", ".join(filter(None, [FURTHER_NAMES.get(ending, ending), reading_name(reading)]))
            label = f"{title}{shown and f' ({shown})'}"
            svg = inline(as_svg(figure), f"{name}-{len(out)}", f"{label}. {module.__doc__.splitlines()[0]}", styles)
            out.append({"shown": shown, "label": label, "svg": svg, "width": figure.get_figwidth(), "marks": ""})
        out[-1]["marks"] = prose(marks_of(module, file, ending))
    return out


def has_many_parts(artist):
    in_space = isinstance(artist, (Line3DCollection, Poly3DCollection))
    return in_space or (isinstance(artist, Collection) and len(artist.get_paths()) > MOST_PATHS)


@rc_context(LOOK)
def as_svg(figure):
    for artist in figure.findobj(has_many_parts):
        artist.set_rasterized(True)
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata=METADATA["svg"], dpi=DPI)
    return buffer.getvalue()


def inline(svg, name, words, styles):
    """The SVG as an element of a page: its ids begin with the name. styles: classes of the page by what they say, to which those
    of the SVG are added."""
    svg = re.sub(r"<metadata>.*?</metadata>|<style.*?</style>|<!--.*?-->", "", svg[svg.index("<svg"):], flags=re.DOTALL)
    svg = re.sub(r'(?<=<g) id="[^"]*"| id="image\w*"| transform="rotate\(-0 [^"]*"|(?<=>)\s+(?=<)', "", svg)  # without effect
    ids = {}
    svg = re.sub(r'( id="|xlink:href="#|url\(#)(\w+)', lambda found: found[1] + ids.setdefault(found[2], f"{name}-{len(ids)}"), svg)
    svg = svg.replace("xlink:href", "href")
    svg = re.sub(r'style="([^"]*)"', lambda found: f'class="{styles.setdefault(found[1], f"s{len(styles)}")}"', svg)
    svg = re.sub(r"data:image/png;base64,([^\"]*)", few_colours, svg)
    for long, short in SHORTER.items():
        svg = re.sub(r'(?<= [dxy]=")[^"]*', lambda numbers: re.sub(long, short, numbers[0]), svg)
    box = re.search(r'viewBox="[^"]*"', svg)[0]
    start = f'<svg {box} class="plot" role="img" aria-label="{escape(words)}">'
    return Markup(start + svg[svg.index(">") + 1:])


def few_colours(found):
    """The image with a palette, a sixth of the bytes."""
    buffer = io.BytesIO()
    picture = Image.open(io.BytesIO(base64.b64decode(found[1])))
    picture.quantize(COLOURS, method=Image.Quantize.FASTOCTREE).save(buffer, "png", optimize=True)
    return f"data:image/png;base64,{base64.b64encode(buffer.getvalue()).decode()}"
