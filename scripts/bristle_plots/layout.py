"""The sheet of a figure: header on top, room for the plots, a note and the verdicts below."""

from matplotlib.figure import Figure

from style import GREY, draw_header, header_height, prose
from verdicts import draw_strip, read_claims, strip_height

NOTE_INCHES = 0.18  # line height of the note


def page(file, width, body, note=""):
    """A figure with `body` inches for the plots, and the bottom of that room (inches)."""
    claims = read_claims(file)
    lines = [line for part in note.splitlines() for line in prose(part, int(15 * (width - 0.6))).splitlines()]
    strip = strip_height(claims, width)
    bottom = strip + (NOTE_INCHES * len(lines) + 0.1 if lines else 0)
    height = bottom + body + header_height(file, width)
    figure = Figure(figsize=(width, height))
    draw_header(figure, file)
    for i, line in enumerate(lines):
        figure.text(0.3 / width, (bottom - NOTE_INCHES * i) / height, line, va="top", fontsize=9, color=GREY)
    draw_strip(figure, claims)
    return figure, bottom


def place(figure, x, y, width, height, **options):
    """Axes with their lower left corner there; all in inches."""
    size = figure.get_size_inches()
    return figure.add_axes((x / size[0], y / size[1], width / size[0], height / size[1]), **options)


def heading(axes, letter, string=""):
    """The panel's letter, and what it shows, above the axes."""
    axes.annotate(letter, (0, 1), (-30, 7), xycoords="axes fraction", textcoords="offset points",
                  weight="bold", fontsize=13)
    axes.annotate(string, (0, 1), (0, 7), xycoords="axes fraction", textcoords="offset points")
