"""What all figures share: colours, fonts, axis labels, ticks and wrapped text."""

import re
import textwrap
import unicodedata
from collections import namedtuple
from functools import lru_cache
from itertools import cycle

import matplotlib
import numpy as np
from matplotlib import mathtext, ticker
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

from ..errors import BristleError
from ..results import as_text, attribute, place_of

COLORMAP = "viridis"  # perceptually uniform, readable with any colour vision

# Okabe and Ito's colours: distinguishable with any colour vision.
GREEN, VERMILION, BLUE, PURPLE, ORANGE, SKY = "#009E73", "#D55E00", "#0072B2", "#CC79A7", "#E69F00", "#56B4E9"
GREY, BLACK = "#666666", "#000000"
COLOURS = [BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK, GREY]

# Of the lines of a panel: in grey, dashes and markers tell apart what colours do else. No dots: these mark jumps.
Look = namedtuple("Look", "colour line marker")
DASHES = ["-", (0, (5, 1.6)), (0, (5, 1.6, 1, 1.6)), (0, (9, 2)), (0, (2.4, 1.4)), (0, (9, 1.6, 1, 1.6, 1, 1.6)),
          (0, (7, 1.4, 2.4, 1.4)), (0, (4, 4))]
LOOKS = [Look(*look) for look in zip(COLOURS, DASHES, "os^Dv<Ph")]
BAR_HATCHES = ["", "////", "....", "xxxx"]

# What figures show in place of SI units in which their numbers would be large or small: the unit, and how many there are.
UNITS = {"m": ("mm", 1e3), "Pa": ("MPa", 1e-6), "W m-2": ("MW m-2", 1e-6)}

MARKERS = " o^sDvP"  # by index of the status; 0 is a point without remark

DPI = 160
LETTER_INCHES = 0.08  # width of a tick's letter
DECADE_INCHES = 0.55  # width of a decade with ticks at 1, 2 and 5

LOOK = {
    "font.family": "DejaVu Sans",  # comes with matplotlib: the same glyphs on every machine
    "mathtext.fontset": "dejavusans",
    "font.size": 10,
    "axes.labelsize": 11,
    "axes.linewidth": 0.8,
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
    "xtick.labelsize": 9,
    "ytick.labelsize": 9,
    "legend.fontsize": 10,
    "legend.frameon": False,
    "legend.handlelength": 2.8,  # shows how a line is dashed
    "axes.formatter.useoffset": False,
    "image.cmap": COLORMAP,
    "hatch.linewidth": 0.6,
    "figure.dpi": DPI,
    "savefig.dpi": DPI,
    "pdf.fonttype": 42,
    "svg.hashsalt": "bristle",
}

# No dates and no program versions: equal figures are equal files.
METADATA = {
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
    "png": {"Software": None},
    "svg": {"Date": None, "Creator": None},
}


def apply_look():
    """Sets matplotlib's parameters; a user's matplotlibrc must not change the figures."""
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(LOOK)


def looks(items):
    """Pairs of item and Look."""
    return zip(items, cycle(LOOKS))


def bar_looks():
    """Options of bars, without end; the hatches tell them apart in grey."""
    return cycle({"facecolor": colour, "edgecolor": BLACK, "linewidth": 0.6, "alpha": 0.75, "hatch": hatch}
                 for colour, hatch in zip(COLOURS, BAR_HATCHES))


def status_marker(status):
    return MARKERS[status % len(MARKERS)]


def label(data):
    """Axis label of a dataset: its symbol, and its unit unless dimensionless."""
    units = attribute(data, "units")
    return symbol(data) if units == "1" else f"{symbol(data)} [{unit_text(units)}]"


def unit_text(units):
    """Units such as "W m-2" for a reader: W/m^2, with the exponent set as such."""
    units = re.sub(r"(?<=\w) ([A-Za-z]+)-(\d)", lambda found: f"/{found[1]}" + (found[2] != "1") * f"$^{found[2]}$", units)
    return re.sub(r"(?<=[A-Za-z])-(\d)", r"$^{-\1}$", units)


def displayed(data):
    """The DataArray in the unit of UNITS, if there is one for it."""
    units, factor = UNITS.get(as_text(data.attrs.get("units", "")), (None, 1))
    return data if units is None else (data * factor).assign_attrs({**data.attrs, "units": units})


def with_displayed(file, name):
    """The Dataset with the variable and its error in the unit of UNITS."""
    return file.assign({one: displayed(file[one]) for one in (name, f"{name}_err") if one in file})


def symbol(data):
    """The dataset's symbol as mathtext."""
    found = f"${with_carons(attribute(data, 'symbol'))}$"
    if not is_math(found):
        raise BristleError(f"{place_of(data)}: attribute 'symbol' is not mathtext: {found.strip('$')}")
    return found


def described(data):
    """What the dataset is, and its symbol, for a caption."""
    return f"{attribute(data, 'long_name')}, {symbol(data)}"


def with_carons(formula):
    """The formula with characters such as \u0158 for \\check{R}: mathtext draws \\check beside its letter, not above."""
    return re.sub(r"\\check\{(\w)\}", lambda found: unicodedata.normalize("NFC", found[1] + "\u030c"), formula)


@lru_cache(maxsize=1000)
def is_math(string):
    try:
        mathtext.MathTextParser("path").parse(string)
    except ValueError:
        return False
    return True


def log_ticks(low, high, width=np.inf):
    """Positions (log10) and texts of ticks: 1-2-5, only decades in a long range or on few inches, equal steps in a short one."""
    decades = np.arange(np.floor(low), np.ceil(high) + 1)
    places = np.add.outer(decades, np.log10([1] if high - low > min(2.5, width / DECADE_INCHES) else [1, 2, 5])).ravel()
    places = places[(places > low - 1e-9) & (places < high + 1e-9)]
    if places.size < 2 and high > low:
        numbers = value_ticks(2).tick_values(10 ** low, 10 ** high)
        places = np.log10(numbers[(numbers >= 10 ** low) & (numbers <= 10 ** high)])
        apart = 4.5 * LETTER_INCHES / width * (high - low)  # of texts such as 7.5 on a panel of few inches
        kept = []
        for place in places:
            if not kept or place - kept[-1] > apart:
                kept.append(place)
        places = np.array(kept)
    if places.size < 1:
        places = np.array([low])
    return places, [f"{float(f'{10 ** place:.6g}'):g}" for place in places]


def value_ticks(bins=5):
    return ticker.MaxNLocator(bins, steps=[1, 2, 2.5, 5, 10], min_n_ticks=min(bins, 3))


def bar_ticks(norm, width):
    """Round numbers for a horizontal bar of this width (inches), so few that their texts do not touch."""
    for bins in (5, 4, 3, 2):
        places = value_ticks(bins).tick_values(norm.vmin, norm.vmax)
        places = places[(places >= norm.vmin) & (places <= norm.vmax)]
        letters = max((len(f"{place:.5g}") for place in places), default=0) + 1.5
        if len(places) * letters * LETTER_INCHES < width and (len(places) <= 4 or width > 2):
            break
    return places


def wrapped(string, width):
    """A sentence in lines of at most `width` characters; $...$ is mathtext if it is valid, else plain text."""
    return "\n".join(textwrap.wrap(with_whole_formulas(string), width)).replace("\0", " ")


def lines_within(string, inches, look):
    """The same in a list of lines of at most this width. look: of the text, with its fontsize."""
    space = text_inches("n n", look) - text_inches("nn", look)
    lines, end = [[]], 0
    for word in with_whole_formulas(string).split():
        wide = text_inches(word.replace("\0", " "), look)
        if lines[-1] and end + wide > inches:
            lines.append([])
            end = 0
        lines[-1].append(word)
        end += wide + space
    return [" ".join(line).replace("\0", " ") for line in lines]


def with_whole_formulas(string):
    """The string with \0 for spaces at which it is not broken: within formulas, and before the unit of a value; a string
    that is not valid as mathtext has no formulas."""
    if string.count("$") % 2 or not is_math(string):
        string = string.replace("$", r"\$")
    return re.sub(r"\$[^$]+\$( (?=[A-Za-z/^$\d]+(,|$)))?", lambda formula: formula.group().replace(" ", "\0"), string)


def text_inches(string, look):
    """Width of a text in one line."""
    font = FontProperties(size=look["fontsize"], weight=look.get("weight"))
    return text_to_path.get_text_width_height_descent(string, font, "$" in string)[0] / 72
