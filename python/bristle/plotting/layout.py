"""The sheet of a figure: header, room for the plots, a note and the verdicts; and panels placed in inches."""

import re
from collections import namedtuple

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..results import as_text
from .page import is_plain, paper_width, points
from .readings import reading_name
from .remarks import pinned_note, start_note, validity_note
from .style import GREY, lines_within, wrapped
from .verdicts import draw_strip, read_claims, strip_height

NO_VALUE = "no value: "  # begins the legend of a status without a value
TITLE_INCHES, CAPTION_INCHES, NOTE_INCHES = 0.32, 0.22, 0.2  # line heights

SIDE = 0.3  # inches beside header and note
NOTE_LOOK = dict(fontsize=10, color=GREY)

# The room of one panel in inches: its size, and within it the corner and the size of the axes.
Cell = namedtuple("Cell", "width height left low inner_width inner_height")
PLAIN_INCHES = 0.05  # above the plots of a figure without header
WIDEST = 10.5  # inches of a standard figure's panels: subscripts of letters of 10 points have 9 pixels if it is shown 1000 pixels wide
LEAST_AXES = 2.5  # inches of the axes of a standard figure's panel
LEAST_CELL = 2.9  # inches of a paper's width that a panel needs


def across(count, standard, flat=0.5):
    """The cell of a panel and the number of panels side by side: as many of `count` as there is room for, in the standard
    figure with narrower axes if one more has room then. flat: height of the axes over their width in a paper."""
    if paper_width() is None:
        beside = standard.width - standard.inner_width
        columns = max(1, min(count, int(WIDEST / min(standard.width, LEAST_AXES + beside))))
        width = min(standard.width, WIDEST / columns)
        return standard._replace(width=width, inner_width=width - beside), columns
    columns = max(1, min(count, int(paper_width() / LEAST_CELL)))
    width = paper_width() / columns
    left, low = 0.73, 0.47
    height = flat * (width - left - 0.12)
    return Cell(width, low + height + 0.34, left, low, width - left - 0.12, height), columns


def corners(count, columns, cell, bottom):
    """The lower left corners of cells, row by row from the top; the lowest row is at `bottom`."""
    rows = -(-count // columns)
    return [(i % columns * cell.width, bottom + (rows - 1 - i // columns) * cell.height) for i in range(count)]


def place_cell(figure, corner, cell, **options):
    return place(figure, corner[0] + cell.left, corner[1] + cell.low, cell.inner_width, cell.inner_height, **options)


def sheet(file, width, body, note="", reading=None, verdicts=True, title=None):
    """A figure with `body` inches for the plots; returns it with the lower end of that room (inches).

    reading: the one that the whole figure shows, if it shows only one; verdicts: whether they are at its foot; title: of a
    further figure, in place of the experiment's.
    """
    if is_plain():
        return Figure(figsize=(paper_width() or width, body + PLAIN_INCHES)), 0
    claims = read_claims(file) if verdicts else []
    note = "\n".join(filter(None, [note, start_note(file), pinned_note(file, reading), validity_note(file, reading)]))
    lines = [line for part in note.splitlines() for line in lines_within(part, width - 2 * SIDE, NOTE_LOOK)]
    bottom = strip_height(claims, width) + (NOTE_INCHES * len(lines) + 0.1 if lines else 0)
    header = header_lines(file, width, reading, title)
    height = bottom + body + header_height(header)
    figure = Figure(figsize=(width, height))
    draw_header(figure, header)
    for i, line in enumerate(lines):
        figure.text(SIDE / width, (bottom - NOTE_INCHES * i) / height, line, va="top", **NOTE_LOOK)
    draw_strip(figure, claims)
    return figure, bottom


def header_lines(file, width, reading=None, title=None):
    """Lines that fit a figure of this width (inches), each with its height (inches) and look."""
    own, caption = (as_text(file.attrs.get(name, "")) for name in ("title", "caption"))
    parts = ((title or own, TITLE_INCHES, dict(fontsize=14)),
             (reading_name(reading or {}), CAPTION_INCHES + 0.03, dict(fontsize=11, weight="bold")),
             (caption, CAPTION_INCHES, dict(fontsize=10)))
    return [(line, height, look) for string, height, look in parts if string
            for line in lines_within(string, width - 2 * SIDE, look)]


def header_height(lines):
    """Height of the header in inches."""
    return 0.3 + sum(height for _, height, _ in lines)


def draw_header(figure, lines):
    height = figure.get_figheight()
    top = height - 0.12
    for line, step, look in lines:
        figure.text(0.5, top / height, line, ha="center", va="top", **look)
        top -= step


def place(figure, x, y, width, height, **options):
    """Axes with their lower left corner at (x, y); all in inches."""
    size = figure.get_size_inches()
    return figure.add_axes((x / size[0], y / size[1], width / size[0], height / size[1]), **options)


def row_title(figure, x, y, string):
    """The name of what a row of panels shows, centred at (x, y) in inches."""
    size = figure.get_size_inches()
    figure.text(x / size[0], y / size[1], string, ha="center", va="center", weight="bold", fontsize=points(11))


def heading(axes, letter, string="", labels=None):
    """The panel's letter and title above the axes. labels: what it shows, for the caption; without them, the title."""
    axes.panel = letter, labels or ([string] if string else [])
    axes.annotate(letter, (0, 1), (-30, 7), xycoords="axes fraction", textcoords="offset points",
                  weight="bold", fontsize=points(13))
    if paper_width() is not None:
        string = lines_of(string, axes.get_position().width * paper_width() + 0.3)
    axes.annotate(string, (0, 1), (0, 7), xycoords="axes fraction", textcoords="offset points")


def lines_of(string, width):
    """The string as a heading or legend of a paper, in as many lines as it needs for this width (inches)."""
    formula = r"\\[a-z]+|[{}_^$]"  # letters of mathtext that are not seen, or one of them
    return string if len(re.sub(formula, "", string)) < 15.5 * width else wrapped(string, int(15.5 * width))


def legend_at_foot(figure, entries, y):
    """One legend for the figure, its entries by text, centred at the height y (inches); in a paper at the foot.

    It has as many rows as its entries need. The figure grows by them, in the standard figure by those behind the first.
    """
    if not entries:
        return
    entries, paper = with_one_cross(entries), paper_width()
    if paper is not None:
        entries = {lines_of(text, paper - 0.6): entry for text, entry in entries.items()}
    columns, height = rows_of_legend(figure, entries)
    if paper is not None:
        make_room(figure, height + 0.05)
    elif columns < len(entries):
        make_room(figure, height - legend_size(figure, entries, len(entries))[1], y)
    draw_legend_at(figure, entries, y if paper is None else 0.03, columns)


def rows_of_legend(figure, entries):
    """The largest number of columns that the figure has room for, and the height of such a legend (inches)."""
    for columns in range(len(entries), 0, -1):
        width, height = legend_size(figure, entries, columns)
        if width < figure.get_figwidth() - 0.1:
            break
    return columns, height


def with_one_cross(entries):
    """The entries, with one for all statuses without a value whose mark is a cross; maps have a hatch for each."""
    crosses = [text for text, entry in entries.items() if text.startswith(NO_VALUE) and isinstance(entry, Line2D)]
    others = {text: entry for text, entry in entries.items() if text not in crosses}
    together = NO_VALUE + ", ".join(text.removeprefix(NO_VALUE) for text in crosses)
    return others | {together: entries[text] for text in crosses[:1]}


def legend_size(figure, entries, columns):
    """In inches."""
    legend = draw_legend_at(figure, entries, 0, columns)
    box = legend.get_window_extent(FigureCanvasAgg(figure).get_renderer())
    legend.remove()
    return box.width / figure.dpi, box.height / figure.dpi


def draw_legend_at(figure, entries, y, columns):
    return figure.legend(entries.values(), entries.keys(), loc="lower center", ncol=columns, borderaxespad=0,
                         bbox_to_anchor=(0.5, y / figure.get_figheight()), columnspacing=1.2)


def make_room(figure, room, at=0):
    """Makes the figure taller at this height, by inches; what is there keeps its size, and what is above it moves up."""
    width, height = figure.get_size_inches()
    figure.set_size_inches(width, height + room)

    def moved(y):
        return (y * height + room * (y * height >= at)) / (height + room)

    for axes in figure.axes:
        x, y, w, h = axes.get_position(original=True).bounds
        axes.set_position((x, moved(y), w, h * height / (height + room)))
    for text in figure.texts:
        text.set_y(moved(text.get_position()[1]))
