"""The figures as inline SVG, without header and verdicts: the page has these as text."""

import io
import math
import re

import numpy as np
from matplotlib import rc_context
from matplotlib.collections import PolyCollection, QuadMesh
from matplotlib.transforms import Bbox
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from ..figures import module_of, own_figure
from ..plotting.curves import kept
from ..plotting.layout import CAPTION_INCHES, HEADER, NOTE
from ..plotting.readings import reading_name, readings
from ..plotting.style import METADATA
from ..plotting.verdicts import FURTHER_SYMBOLS, STRIP, read_claims, strip_height
from ..results import as_text, axis_names, axis_values, dataset, read, readable, require_axes
from .points import embedded
from .svg import compact, inline
from .symbols import plain, prose
from .tables import packed

# Maps and surfaces of more cells become images within the SVG, as elements for each cell are slow to show.
MANY, MAP_DPI = 50, 120
SIMPLIFIED = {"path.simplify_threshold": 0.5}  # of a pixel: how far lines may be from what they show
NARROW = "3.5in"  # page of the drawings for phones, whose letters have at least 9 pixels there
LEAST_LETTER = 9  # pixels on the screen
LETTERS = re.compile(r"scale\(0?(\.\d+) -")  # of glyphs, in hundredths of their size in an SVG's units

# Of the modules' further figures.
FURTHER_NAMES = {"energy": "energy budget", "parts": "factors of the friction"}


@rc_context(SIMPLIFIED)
def draw(name, file, verdicts):
    """The figure's drawings, one for each reading: what it shows besides the figure's heading, and two layouts of it.

    Wide: panels side by side, `width` pixels wide; narrow: where the wide one's letters would be too small, panels below each other,
    without its note. Both have the same ids: a page has one of them at a time.
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
            out.append({"name": identity, "further": bool(ending), "shown": shown, "reading": "".join(reading.values()),
                        "width": round(100 * figures[0].get_figwidth()), "note": note_of(figures[0]),
                        **layouts(*figures, part, words)})
    return out


def layouts(wide, narrow, file, words):
    """Both layouts, compressed, with the points of the curves; the shapes of their letters, their own shapes (width over height),
    whether there are curves, and the least width (pixels) at which the letters of the wide one can be read; words: those of
    `inline`."""
    found = {}
    for kind, figure in (("wide", wide), ("narrow", narrow)):
        foot, top = trim(figure, file)
        found[kind] = {"svg": as_svg(figure, foot, top), "places": places_of(figure, top),
                       "shape": f"{figure.get_figwidth() / (top - foot):.3f}"}
    least = 100 * min(map(float, LETTERS.findall(found["wide"]["svg"])))
    curves, letters, content = curves_of(wide), {}, {}
    for kind, one in found.items():
        svg, shapes = inline(one["svg"], *words)
        letters |= shapes
        content[kind] = {"svg": str(svg), "places": one["places"]}
    return {"letters": letters, "shapes": {kind: one["shape"] for kind, one in found.items()}, "curves": bool(curves),
            "least": math.ceil(72 * wide.get_figwidth() * LEAST_LETTER / least),
            "layouts": packed(embedded({**content, "curves": curves}))}


def note_of(figure):
    return prose(" ".join(text.get_text() for text in figure.texts if text.get_gid() == NOTE), FURTHER_SYMBOLS)


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


def has_many_cells(artist):
    """Whether it is a map or a surface."""
    return isinstance(artist, (QuadMesh, Poly3DCollection)) or (isinstance(artist, PolyCollection) and len(artist.get_paths()) > MANY)


def as_svg(figure, foot, top):
    for artist in figure.findobj(has_many_cells):
        artist.set_rasterized(True)
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata=METADATA["svg"], dpi=MAP_DPI,
                   bbox_inches=Bbox([[0, foot], [figure.get_figwidth(), top]]))
    return compact(buffer.getvalue())


def curves_of(figure):
    """The curves of a drawing: what they show, and of each point x, y, the error of y and the status."""
    return [{"along": str(prose(curve.along)), "title": str(prose(curve.title)), "chosen": str(prose(curve.chosen)),
             "points": [[*numbers([curve.x[i], curve.y[i], curve.error[i]]),
                         readable(curve.meanings[curve.status[i]]) if curve.status[i] else ""] for i in range(len(curve.x))]}
            for axes in figure.axes for curve, _ in kept(axes)]


def places_of(figure, top):
    """The places in the SVG of the points of each curve; null for a point that is not within its panel."""
    out = []
    for axes in figure.axes:
        for _, drawn in kept(axes):
            box = axes.bbox.padded(2)
            out.append([[round(72 * x / figure.dpi, 1), round(72 * (top - y / figure.dpi), 1)] if box.contains(x, y) else None
                        for x, y in axes.transData.transform(drawn)])
    return out


def numbers(values):
    """Numbers for JSON, with the digits that are shown: null where there is no value."""
    return [float(f"{value:.6g}") if np.isfinite(value) else None for value in values]


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
