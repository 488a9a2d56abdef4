"""What all figures share: their look, reading the result file, labels, and byte-reproducible saving."""

import argparse
import contextlib
import io
import os
import re
import sys
import textwrap

import h5py
import matplotlib
import numpy as np
from matplotlib import mathtext

COLORMAP = "viridis"  # perceptually uniform, readable with any colour vision

# Okabe and Ito's colours: distinguishable with any colour vision.
GREEN, VERMILION, BLUE, PURPLE, ORANGE, SKY = "#009E73", "#D55E00", "#0072B2", "#CC79A7", "#E69F00", "#56B4E9"
GREY, BLACK = "#666666", "#000000"
COLOURS = [BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK]

MARKERS = " o^sDvP"  # by status; the first is a point without remark

TITLE_INCHES, CAPTION_INCHES = 0.32, 0.22  # line heights of the header
DPI = 160

LOOK = {
    "font.family": "DejaVu Sans",  # comes with matplotlib: the same glyphs on every machine
    "mathtext.fontset": "dejavusans",
    "font.size": 10,
    "axes.labelsize": 11,
    "axes.linewidth": 0.8,
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
    "xtick.labelsize": 9,
    "ytick.labelsize": 9,
    "legend.fontsize": 9,
    "legend.frameon": False,
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
SAVED = ("pdf", "png")


def fail(message, code=2):
    """End the program with one line; 2: the input is wrong, 3: the output could not be written."""
    print(f"{os.path.basename(sys.argv[0])}: error: {message}", file=sys.stderr)
    raise SystemExit(code)


def run(name, description, needed, draw):
    """The main program of a script: RESULT.h5 -o DIRECTORY, draw(file) -> figure, saved as `name`."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("result", metavar="RESULT.h5", help="result file of `bristle run`")
    parser.add_argument("-o", dest="directory", metavar="DIRECTORY", default="figures",
                        help=f"where to write {name}.pdf and {name}.png (default: %(default)s)")
    arguments = parser.parse_args()
    apply_look()
    with open_result(arguments.result, needed) as file:
        figure = draw(file)
    save(figure, arguments.directory, name)


def apply_look():
    matplotlib.use("Agg")
    matplotlib.rcdefaults()  # a user's matplotlibrc must not change the figures
    matplotlib.rcParams.update(LOOK)


SCHEMA = "bristle-result/1"


def open_result(path, needed=()):
    """The result file, open for reading, with all datasets that are needed."""
    if os.path.isdir(path):
        fail(f"{path}: a folder, not a result file")
    if not os.path.exists(path):
        fail(f"{path}: no such file; `bristle run EXPERIMENT.json -o {path}` writes it")
    if not os.access(path, os.R_OK):
        fail(f"{path}: no permission to read it")
    if not h5py.is_hdf5(path):
        fail(f"{path}: not an HDF5 file")
    try:
        file = h5py.File(path, "r")
    except OSError as error:
        fail(f"{path}: damaged HDF5 file ({error})")
    schema = text(file.attrs.get("schema_version", ""))
    if schema.startswith("bristle-part/"):
        fail(f"{path}: a part ({text(file.attrs.get('shard', '?'))}) of {text(file.attrs.get('name', '?'))}, not the whole; "
             "merge the parts first: bristle merge -o FILE.h5 PARTS...")
    if schema != SCHEMA:
        fail(f"{path}: schema version {schema or 'none'}; this script reads {SCHEMA}")
    for name in needed:
        dataset(file, name)
    return file


def dataset(file, name):
    """The dataset `name` of the file or group."""
    found = file.get(name)
    if not isinstance(found, h5py.Dataset):
        present = ", ".join(key for key in file if not key.endswith("_err"))
        fail(f"{file.file.filename}: no dataset '{file.name.rstrip('/')}/{name}'; "
             f"{file.name} has: {present or 'none'}")
    return found


def values(data):
    """The numbers of a dataset."""
    try:
        return data[()]
    except OSError as error:
        fail(f"{data.file.filename}: dataset '{data.name}' is damaged ({error})")


def text(value):
    """A string out of HDF5, where it may be bytes, str or an array of one of them."""
    if isinstance(value, np.ndarray):
        value = value.ravel()[0]
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def attribute(data, name):
    """The attribute as a string."""
    if name not in data.attrs:
        fail(f"{data.file.filename}: dataset '{data.name}' has no attribute '{name}'")
    return text(data.attrs[name])


def label(data):
    """Axis label of a dataset: its symbol, and its unit unless dimensionless."""
    # mathtext knows the accent \breve but draws \check as a character of its own.
    symbol = f"${attribute(data, 'symbol')}$".replace(r"\check", r"\breve")
    if not is_math(symbol):
        fail(f"{data.file.filename}: dataset '{data.name}': attribute 'symbol' "
             f"is not mathtext: {symbol.strip('$')}")
    units = attribute(data, "units")
    return symbol if units == "1" else f"{symbol} [{units}]"


def is_math(string):
    try:
        mathtext.MathTextParser("path").parse(string)
    except ValueError:
        return False
    return True


def log_ticks(low, high):
    """Positions (log10) and texts of ticks in the range: 1-2-5, or decades if long, or 1 to 9 if short."""
    decades = np.arange(np.floor(low), np.ceil(high) + 1)
    for steps in ([1],) if high - low > 2.5 else ([1, 2, 5], range(1, 10)):
        places = np.add.outer(decades, np.log10(steps)).ravel()
        places = places[(places > low - 1e-9) & (places < high + 1e-9)]
        if places.size >= 2:
            break
    else:  # too short for round numbers
        places = np.array([low, high])
    return places, [f"{float(f'{10 ** place:.3g}'):g}" for place in places]


def prose(string, width):
    """A sentence in lines of at most `width` characters; $...$ is mathematics where it can be."""
    if string.count("$") % 2 or not is_math(string):
        string = string.replace("$", r"\$")
    whole = re.sub(r"\$[^$]+\$", lambda formula: formula.group().replace(" ", "\0"), string)
    return "\n".join(textwrap.wrap(whole, width)).replace("\0", " ")


def header_lines(file, width):
    """Title and caption of the experiment, in lines that fit a figure of this width (inches)."""
    title, caption = (text(file.attrs.get(name, "")) for name in ("title", "caption"))
    return prose(title, int(9 * width)).splitlines(), prose(caption, int(14 * width)).splitlines()


def header_height(file, width):
    """Inches that the header takes at the top of a figure."""
    title, caption = header_lines(file, width)
    return 0.3 + TITLE_INCHES * len(title) + CAPTION_INCHES * len(caption)


def draw_header(figure, file):
    width, height = figure.get_size_inches()
    title, caption = header_lines(file, width)
    top = height - 0.12
    for lines, step, size in ((title, TITLE_INCHES, 14), (caption, CAPTION_INCHES, 10)):
        for line in lines:
            figure.text(0.5, top / height, line, ha="center", va="top", fontsize=size)
            top -= step


def save(figure, directory, name):
    """Write name.pdf and name.png into the directory, whole or not at all."""
    for kind in SAVED:
        path = os.path.join(directory, f"{name}.{kind}")
        buffer = io.BytesIO()
        figure.savefig(buffer, format=kind, metadata=METADATA[kind])
        write_whole(path, buffer.getbuffer())


def write_whole(path, content):
    """A file of these bytes, and its folder; the whole file or, with an error, none."""
    try:
        os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
        with open(path + ".part", "wb") as part:
            part.write(content)
        os.replace(path + ".part", path)
    except OSError as error:
        with contextlib.suppress(OSError):
            os.remove(path + ".part")
        fail(f"{path}: cannot be written ({error.strerror})", 3)
