"""The sheet of a figure: header, room for the plots, a note and the verdicts; and panels placed in inches."""

from matplotlib.figure import Figure

from .results import as_text
from .style import GREY, wrapped
from .verdicts import draw_strip, read_claims, strip_height

TITLE_INCHES, CAPTION_INCHES, NOTE_INCHES = 0.32, 0.22, 0.18  # line heights


def sheet(file, width, body, note=""):
    """A figure with `body` inches for the plots; returns it with the lower end of that room (inches)."""
    claims = read_claims(file)
    characters = int(15 * (width - 0.6))
    lines = [line for part in note.splitlines() for line in wrapped(part, characters).splitlines()]
    bottom = strip_height(claims, width) + (NOTE_INCHES * len(lines) + 0.1 if lines else 0)
    height = bottom + body + header_height(file, width)
    figure = Figure(figsize=(width, height))
    draw_header(figure, file)
    for i, line in enumerate(lines):
        figure.text(0.3 / width, (bottom - NOTE_INCHES * i) / height, line, va="top", fontsize=9, color=GREY)
    draw_strip(figure, claims)
    return figure, bottom


def header_lines(file, width):
    """Title and caption of the experiment, in lines that fit a figure of this width (inches)."""
    title, caption = (as_text(file.attrs.get(name, "")) for name in ("title", "caption"))
    return wrapped(title, int(9 * width)).splitlines(), wrapped(caption, int(14 * width)).splitlines()


def header_height(file, width):
    """Height of the header in inches."""
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


def place(figure, x, y, width, height, **options):
    """Axes with their lower left corner at (x, y); all in inches."""
    size = figure.get_size_inches()
    return figure.add_axes((x / size[0], y / size[1], width / size[0], height / size[1]), **options)


def heading(axes, letter, string=""):
    """The panel's letter and title above the axes."""
    axes.annotate(letter, (0, 1), (-30, 7), xycoords="axes fraction", textcoords="offset points",
                  weight="bold", fontsize=13)
    axes.annotate(string, (0, 1), (0, 7), xycoords="axes fraction", textcoords="offset points")
