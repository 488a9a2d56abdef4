"""The sheet of a figure: header, room for the plots, a note and the verdicts; and panels placed in inches."""

from matplotlib.figure import Figure

from .readings import reading_name
from .results import as_text
from .style import GREY, wrapped
from .verdicts import draw_strip, read_claims, strip_height

HEADER = "header"  # gid of the header's texts
TITLE_INCHES, CAPTION_INCHES, NOTE_INCHES = 0.32, 0.22, 0.18  # line heights


def sheet(file, width, body, note="", reading=None, verdicts=True):
    """A figure with `body` inches for the plots; returns it with the lower end of that room (inches).

    reading: the one that the whole figure shows, if it shows only one; verdicts: whether they are at its foot.
    """
    claims = read_claims(file) if verdicts else []
    characters = int(15 * (width - 0.6))
    lines = [line for part in note.splitlines() for line in wrapped(part, characters).splitlines()]
    bottom = strip_height(claims, width) + (NOTE_INCHES * len(lines) + 0.1 if lines else 0)
    header = header_lines(file, width, reading)
    height = bottom + body + header_height(header)
    figure = Figure(figsize=(width, height))
    draw_header(figure, header)
    for i, line in enumerate(lines):
        figure.text(0.3 / width, (bottom - NOTE_INCHES * i) / height, line, va="top", fontsize=9, color=GREY)
    draw_strip(figure, claims)
    return figure, bottom


def header_lines(file, width, reading=None):
    """Lines that fit a figure of this width (inches), each with its height (inches) and look."""
    title, caption = (as_text(file.attrs.get(name, "")) for name in ("title", "caption"))
    parts = ((title, 9, TITLE_INCHES, dict(fontsize=14)),
             (reading_name(reading or {}), 14, CAPTION_INCHES + 0.03, dict(fontsize=11, weight="bold")),
             (caption, 14, CAPTION_INCHES, dict(fontsize=10)))
    return [(line, height, look) for string, density, height, look in parts
            for line in wrapped(string, int(density * width)).splitlines()]


def header_height(lines):
    """Height of the header in inches."""
    return 0.3 + sum(height for _, height, _ in lines)


def draw_header(figure, lines):
    height = figure.get_figheight()
    top = height - 0.12
    for line, step, look in lines:
        figure.text(0.5, top / height, line, ha="center", va="top", gid=HEADER, **look)
        top -= step


def place(figure, x, y, width, height, **options):
    """Axes with their lower left corner at (x, y); all in inches."""
    size = figure.get_size_inches()
    return figure.add_axes((x / size[0], y / size[1], width / size[0], height / size[1]), **options)


def row_title(figure, x, y, string):
    """The name of what a row of panels shows, centred at (x, y) in inches."""
    size = figure.get_size_inches()
    figure.text(x / size[0], y / size[1], string, ha="center", va="center", weight="bold", fontsize=11)


def heading(axes, letter, string=""):
    """The panel's letter and title above the axes."""
    axes.annotate(letter, (0, 1), (-30, 7), xycoords="axes fraction", textcoords="offset points",
                  weight="bold", fontsize=13)
    axes.annotate(string, (0, 1), (0, 7), xycoords="axes fraction", textcoords="offset points")
