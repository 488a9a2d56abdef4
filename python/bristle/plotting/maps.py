"""Quantities over the radial and azimuthal stiffness: a surface, and below it a map with contours."""

from collections import namedtuple

import numpy as np
from matplotlib import colors, patches, patheffects
from matplotlib.collections import PatchCollection, PolyCollection
from matplotlib.lines import Line2D

from ..errors import BristleError
from ..results import attribute, dataset, place_of, select, select_flags, status_words, values
from .contour_labels import label_contours
from .jumps import LEAST_CHANGE, located_axis, located_jumps, read_jumps
from .layout import NO_VALUE, Cell, across, corners, heading, legend_at_foot, place, sheet
from .page import lettered, maps_only, paper_width, points
from .style import VERMILION, bar_ticks, described, label, log_ticks, status_marker, value_ticks, wrapped
from .surfaces import draw_surface, label_surface, torn_faces

COLUMN_INCHES = (3.2, 5.9)
MAP_INCHES = 3.45  # height of the cell of a map without a surface
LEGEND_INCHES = 0.4
MOST_CELLS = 10_000  # of a map that is drawn as vectors

# By index of the status; 0 is a point without remark.
HATCHES = ["....", "----", "////", "xxxx", "\\\\\\\\", "||||", "++++"]

# Places along x and y, log10 of the axes' values where `log` is true, and the index of each point's status into `meanings`.
# chosen: the values of further axes at which the quantities are drawn.
# jumps: whether the loading path jumps between neighbours along y, and along x.
# located: row and places of the jump, its start and its end, of each Jump along x that the run located; None if it located none.
Grid = namedtuple("Grid", "x y status meanings axes chosen jumps located log", defaults=[(True, True)])

# In grey, vermilion is as bright as the middle of viridis: the white rim tells the line from the map.
JUMP_LOOK = dict(color=VERMILION, linewidth=1.4, solid_capstyle="butt",
                 path_effects=[patheffects.Stroke(linewidth=2.7, foreground="white"), patheffects.Normal()])
BAND_LOOK = dict(facecolor=VERMILION, alpha=0.45, linewidth=0)
NOT_LOCATED = f"$z_0$ of neighbours differs by more than {LEAST_CHANGE:g}"
JUMP_TEXT = "jump of the loading path,"
MAP_MARKS = "Colours, of surfaces and maps alike, as at the bars; black lines on the maps are contours at the numbers."
JUMP_MARKS = ("Vermilion lines with a white rim: jumps of the loading path, {}; pale areas: less than 0.5 % of the load decides "
              "between two gaps. Surfaces and contours are broken at jumps.")


def marks(file):
    """What the marks of surfaces and maps mean, for a caption."""
    return f"{MAP_MARKS} {jump_marks(file)}"


def jump_marks(file):
    return JUMP_MARKS.format("located to 1 %" if located_axis(file) else NOT_LOCATED)


def read_grid(file, x_name, y_name, chosen, any_scale=False):
    """any_scale: an axis may be linear, and is where it spans less than a decade or has values below zero."""
    (x, x_log), (y, y_log) = (axis_places(dataset(file, name), any_scale) for name in (x_name, y_name))
    meanings, status = select_flags(file, "status", [y_name, x_name], **chosen)
    located = None
    if located_axis(file) == x_name:
        located = [(jump.index[0], *(np.log10(jump[1:]) if x_log else jump[1:]))
                   for jump in located_jumps(file, [y_name, x_name], **chosen)]
    return Grid(x, y, status, meanings, (x_name, y_name), chosen, read_jumps(file, [y_name, x_name], **chosen),
                located, (x_log, y_log))


def axis_places(data, any_scale):
    """The places of an axis' values, and whether they are log10 of them."""
    numbers = np.atleast_1d(values(data))
    if numbers.ndim != 1 or numbers.size < 2:
        raise BristleError(f"{place_of(data)} has {numbers.size} value(s); a surface needs a sweep of at least "
                           "2 values in each direction")
    increasing, positive = np.isfinite(numbers).all() and (np.diff(numbers) > 0).all(), numbers[0] > 0
    if not (increasing and (positive or any_scale)):
        raise BristleError(f"{place_of(data)} must be {'' if any_scale else 'positive and '}increasing to be an axis of a map")
    log = not any_scale or bool(positive and numbers[-1] >= 10 * numbers[0])
    return (np.log10(numbers) if log else numbers), log


def draw_maps(file, names, reading, chosen=None, note=""):
    """A figure with one column for each quantity; chosen: values of the axes beside reading and stiffnesses."""
    grid = read_grid(file, "k_r", "k_theta", {**reading, **(chosen or {})})
    panels, size = lettered(names), (COLUMN_INCHES[0], MAP_INCHES if maps_only() else COLUMN_INCHES[1])
    cell, columns = across(len(panels), Cell(*size, 0, 0, *size), 0.6 if maps_only() else 0.48)
    rows, below = -(-len(panels) // columns), legend_inches()
    figure, bottom = sheet(file, cell.width * columns + 0.25, below + cell.height * rows, note, reading)
    figure.maps = True
    entries = {}
    for (letter, name), corner in zip(panels, corners(len(panels), columns, cell, bottom + below)):
        entries |= draw_column(figure, file, grid, name, letter, corner, cell)
    legend_at_foot(figure, entries, bottom + 0.2 * LEGEND_INCHES)
    return figure


def legend_inches():
    """Room below the maps; the figure of a paper grows by its legend."""
    return LEGEND_INCHES if paper_width() is None else 0


def boxes(cell):
    """Within the cell of a quantity: corner and size of surface, map, colour bar and heading, and the heading's width in
    letters. In the standard figure the map is below the surface, in a paper beside it, with its axis at the right:
    at the left the surface has its ticks. The surface's box is empty if there are maps only."""
    width, height = cell.width, cell.height
    if paper_width() is None:
        return ([] if maps_only() else (0, 2.95, width, height - 3.3), (0.62, 0.5, width - 0.85, 1.8),
                (0.62, 2.4, width - 0.85, 0.1), (0, height - 0.4, width, 0.4), 36)
    if maps_only():
        return ([], (0.58, 0.42, width - 1.08, height - 1.07), (0.58, height - 0.57, width - 1.08, 0.07),
                (0, height - 0.25, width, 0.22), int(14 * width))
    left, right, tall = 0.5 * width + 0.24, 0.5 * width - 0.76, height - 1.07
    return ((0, 0.08, 0.5 * width - 0.1, height - 0.28), (left, 0.42, right, tall), (left, tall + 0.5, right, 0.07),
            (0, height - 0.25, width, 0.22), int(14 * width))


def draw_log_map(file, name, reading, note, title):
    """A map of one quantity of wide range, with a logarithmic colour scale."""
    grid = read_grid(file, "k_r", "k_theta", reading)
    data = dataset(file, name)
    field = np.ma.masked_less_equal(np.ma.masked_invalid(select(data, grid.axes[::-1], **grid.chosen)), 0)
    if not field.count():
        raise BristleError(f"{place_of(data)} has no positive values to draw")
    width, below = paper_width() or 7.6, legend_inches()
    tall = 3.6 if paper_width() is None else 0.66 * (width - 1.8)
    figure, bottom = sheet(file, width, below + tall + 1, note, reading, verdicts=False, title=title)
    figure.maps = True
    flat = place(figure, 0.8, bottom + below + 0.5, width - (2.2 if paper_width() is None else 1.8), tall)
    norm = colors.LogNorm(field.min(), max(field.max(), 1.001 * field.min()))
    image = draw_cells(flat, grid, field, norm)
    label_map(flat, grid, [label(dataset(file, axis)) for axis in grid.axes])
    heading(flat, "", attribute(data, "long_name"))
    end = flat.get_position().x1 * figure.get_figwidth()
    bar = colour_bar(figure, image, (end + 0.15, bottom + below + 0.5, 0.15, tall))
    bar.ax.set_ylabel(label(data))
    legend_at_foot(figure, draw_jumps(flat, grid) | draw_status(flat, grid, field), bottom + 0.2 * LEGEND_INCHES)
    return figure


def draw_column(figure, file, grid, name, letter, corner, cell):
    """One quantity; corner: the lower left one of its cell (inches). Returns legend entries by text."""
    def axes(box, **options):
        return place(figure, corner[0] + box[0], corner[1] + box[1], *box[2:], **options)

    data = dataset(file, name)
    field = np.ma.masked_invalid(select(data, grid.axes[::-1], **grid.chosen))
    norm = colour_range(field)
    titles = [label(dataset(file, axis)) for axis in grid.axes]
    of_surface, of_map, of_bar, of_head, letters = boxes(cell)

    if of_surface:
        space = axes(of_surface, projection="3d")
        draw_surface(space, grid, field, norm)
        label_surface(space, grid, norm, titles, label(data))

    flat = axes(of_map)
    image = draw_map(flat, grid, field, norm)
    label_map(flat, grid, titles)
    if paper_width() is not None and of_surface:
        axis_at_right(flat)

    bar = colour_bar(figure, image, (corner[0] + of_bar[0], corner[1] + of_bar[1], *of_bar[2:]),
                     orientation="horizontal", ticks=bar_ticks(norm, of_bar[2]))
    bar.ax.xaxis.set_ticks_position("top")
    left = paper_width() is None
    bar.ax.yaxis.set_label_position("left" if left else "right")
    bar.ax.set_ylabel(label(data), rotation=0, ha="right" if left else "left", va="center")

    head = axes(of_head)
    head.axis("off")
    head.text(0.03, 1, letter, weight="bold", fontsize=points(13), va="top")
    head.panel = letter, [described(data)]
    head.text(0.12 if letter else 0.03, 0.97, wrapped(attribute(data, "long_name"), letters), va="top")
    return draw_jumps(flat, grid) | draw_status(flat, grid, field)


def draw_cells(flat, grid, field, norm):
    """The map's cells, as vectors unless they are many. Their edges have their colours: PDF viewers show seams else."""
    corners = [corners_of(cell) for cell in cells_at(grid, np.argwhere(~np.ma.getmaskarray(field)))]
    cells = PolyCollection(corners, array=field.compressed(), norm=norm, edgecolors="face", linewidth=0.3,
                           rasterized=field.size > MOST_CELLS)
    flat.add_collection(cells)
    # The outer cells are cut in half: the map has the sweep's range.
    flat.set(xlim=grid.x[[0, -1]], ylim=grid.y[[0, -1]])
    return cells


def colour_bar(figure, image, box, **options):
    """The bar in a box (inches), of vectors as the map."""
    bar = figure.colorbar(image, cax=place(figure, *box), **options)
    bar.solids.set(rasterized=image.get_rasterized(), edgecolor="face", linewidth=0.3)
    return bar


def colour_range(field):
    if field.count() == 0:
        return colors.Normalize(0, 1)
    low, high = field.min(), field.max()
    # A constant needs a range too, and its last digits must not decide the colour.
    missing = max(0, 1e-3 * (max(abs(low), abs(high)) or 1) - (high - low))
    return colors.Normalize(low - missing / 2, high + missing / 2)


def torn_field(grid, field):
    """x, y and the field with points between the grid's points, which are masked in the faces with a jump.

    A contour that follows this field does not cross a jump.
    """
    along_y, along_x = grid.jumps
    fine = np.ma.masked_all([2 * n - 1 for n in field.shape])
    fine[::2, ::2] = field
    fine[::2, 1::2] = np.ma.masked_where(along_x, (field[:, :-1] + field[:, 1:]) / 2)
    fine[1::2, ::2] = np.ma.masked_where(along_y, (field[:-1] + field[1:]) / 2)
    middle = (field[:-1, :-1] + field[:-1, 1:] + field[1:, :-1] + field[1:, 1:]) / 4
    fine[1::2, 1::2] = np.ma.masked_where(torn_faces(grid), middle)
    x, y = (np.sort(np.concatenate([line, (line[1:] + line[:-1]) / 2])) for line in (grid.x, grid.y))
    return x, y, fine


def draw_jumps(flat, grid):
    """Lines where the loading path jumps along x; returns a legend entry by text.

    A jump that the run did not locate is drawn halfway between the points.
    """
    _, along_x = grid.jumps
    x, y = cell_edges(grid.x), cell_edges(grid.y)
    bands = grid.located or []
    places = [(j, x[i + 1]) for j, i in np.argwhere(along_x)] if grid.located is None else [band[:2] for band in bands]
    if not places:
        return {}
    # One line with gaps: a rim would else cover the end of the line below.
    path = np.array([(point, height) for j, point in places
                     for point, height in ((point, y[j]), (point, y[j + 1]), (np.nan, np.nan))])
    flat.plot(*path.T, **JUMP_LOOK)
    for j, _, start, end in bands:
        flat.fill_between([start, end], y[j], y[j + 1], **BAND_LOOK)
    how = "located to 1 %" if grid.located is not None else NOT_LOCATED
    entries = {f"{JUMP_TEXT} {how}": Line2D([], [], **JUMP_LOOK)}
    if any(end > start for _, _, start, end in bands):
        entries["less than 0.5 % of the load decides"] = patches.Patch(**BAND_LOOK)
    return entries


def cell_edges(line):
    """Edges of the map's cells, halfway between the points."""
    middle = (line[1:] + line[:-1]) / 2
    return np.concatenate([[2 * line[0] - middle[0]], middle, [2 * line[-1] - middle[-1]]])


def cells_at(grid, places):
    """Left, low, right and upper end of the cells at (row, column): a located jump between two points ends a cell."""
    x, y = np.tile(cell_edges(grid.x), (len(grid.y), 1)), cell_edges(grid.y)
    for row, place_x, *_ in grid.located or []:
        x[row, np.searchsorted(grid.x, place_x)] = place_x
    return [(x[j, i], y[j], x[j, i + 1], y[j + 1]) for j, i in places]


def corners_of(cell):
    left, low, right, top = cell
    return [(left, low), (right, low), (right, top), (left, top)]


def draw_map(flat, grid, field, norm):
    flat.set_facecolor("#dddddd")
    image = draw_cells(flat, grid, field, norm)
    if field.count() and np.ptp(field.compressed()) > 0:
        levels = value_ticks(7 if paper_width() is None else 4).tick_values(norm.vmin, norm.vmax)
        levels = levels[(levels > norm.vmin) & (levels < norm.vmax)]
        lines = flat.contour(*torn_field(grid, field), levels, colors="black", linewidths=0.7, corner_mask=False)
        j, i = np.nonzero(remarked(grid, field))
        label_contours(flat, lines, np.column_stack([grid.x[i], grid.y[j]]))
    return image


def label_map(flat, grid, titles):
    for axis, line, log, title in zip("xy", (grid.x, grid.y), grid.log, titles):
        if log:
            getattr(flat, f"set_{axis}ticks")(*log_ticks(line[0], line[-1]))
        else:
            getattr(flat, f"{axis}axis").set_major_locator(value_ticks(4))
        getattr(flat, f"set_{axis}label")(title, labelpad=1)


def axis_at_right(flat):
    """Ticks and title of y at the right; the title's place does not depend on the ticks."""
    flat.yaxis.tick_right()
    inches = flat.get_position().width * flat.figure.get_figwidth()
    flat.yaxis.set_label_position("right")
    flat.yaxis.set_label_coords(1 + 0.38 / inches, 0.5)
    flat.yaxis.label.set(rotation=0, ha="center", va="center")


def remarked(grid, field):
    """Points with a value and a status other than ok."""
    return (grid.status > 0) & ~np.ma.getmaskarray(field)


def draw_status(flat, grid, field):
    """Hatches cells without a value and marks points with a remark; returns legend entries by text."""
    entries = {}
    empty = np.ma.getmaskarray(field)
    for status in np.unique(grid.status):
        here = grid.status == status
        meaning = status_words(grid.meanings[status])
        cells = [patches.Polygon(corners_of(cell)) for cell in cells_at(grid, np.argwhere(here & empty))]
        if cells:
            look = dict(facecolor="#dddddd", edgecolor="#555555", linewidth=0,
                        hatch=HATCHES[status % len(HATCHES)])
            flat.add_collection(PatchCollection(cells, **look))
            entries[f"{NO_VALUE}{meaning}"] = patches.Patch(**look)
        marked = here & remarked(grid, field)
        if marked.any():
            look = dict(marker=status_marker(status), markersize=4, linestyle="",
                        markerfacecolor="white", markeredgecolor="black", markeredgewidth=0.7,
                        clip_on=False)
            j, i = np.nonzero(marked)
            flat.plot(grid.x[i], grid.y[j], **look)
            entries[meaning] = Line2D([], [], **look)
    return entries
