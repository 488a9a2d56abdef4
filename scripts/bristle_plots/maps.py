"""Quantities over the radial and azimuthal stiffness: a surface, and below it a map with contours."""

from collections import namedtuple

import numpy as np
from matplotlib import colormaps, colors, patches, ticker
from matplotlib.collections import PatchCollection
from matplotlib.lines import Line2D
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from .contour_labels import label_contours
from .errors import BristleError
from .jumps import LEAST_CHANGE, located_axis, located_jumps, read_jumps
from .layout import Cell, across, corners, heading, legend_at_foot, place, sheet
from .page import paper_width, points
from .results import attribute, dataset, place_of, readable, select, select_flags, values
from .style import COLORMAP, VERMILION, label, log_ticks, status_marker, wrapped

COLUMN_INCHES = (3.2, 5.9)
LEGEND_INCHES = 0.4
MOST_CELLS = 10_000  # of a map that is drawn as vectors

# By index of the status; 0 is a point without remark.
HATCHES = ["....", "----", "////", "xxxx", "\\\\\\\\", "||||", "++++"]

# log10 of the axes x and y by name, and the index of each point's status into `meanings`.
# chosen: the values of further axes at which the quantities are drawn.
# jumps: whether the loading path jumps between neighbours along y, and along x.
# located: (row, log10 x) of each jump along x that the run located; None if it located none.
Grid = namedtuple("Grid", "x y status meanings axes chosen jumps located")

JUMP_LOOK = dict(color=VERMILION, linewidth=1.4, solid_capstyle="round")
JUMP_TEXT = "jump of the loading path,"


def read_grid(file, x_name, y_name, chosen):
    x, y = (log_axis_values(dataset(file, name)) for name in (x_name, y_name))
    meanings, status = select_flags(file, "status", [y_name, x_name], **chosen)
    located = None
    if located_axis(file) == x_name:
        located = [(row, np.log10(value))
                   for (row, _), value in located_jumps(file, [y_name, x_name], **chosen)]
    return Grid(x, y, status, meanings, (x_name, y_name), chosen, read_jumps(file, [y_name, x_name], **chosen),
                located)


def log_axis_values(data):
    numbers = np.atleast_1d(values(data))
    if numbers.ndim != 1 or numbers.size < 2:
        raise BristleError(f"{place_of(data)} has {numbers.size} value(s); a surface needs a sweep of at least "
                           "2 values in each direction")
    if not (np.isfinite(numbers).all() and numbers[0] > 0 and (np.diff(numbers) > 0).all()):
        raise BristleError(f"{place_of(data)} must be positive and increasing to be a logarithmic axis")
    return np.log10(numbers)


def value_ticks(bins=5):
    return ticker.MaxNLocator(bins, steps=[1, 2, 2.5, 5, 10], min_n_ticks=3)


def draw_maps(file, names, reading, chosen=None, note=""):
    """A figure with one column for each quantity; chosen: values of the axes beside reading and stiffnesses."""
    grid = read_grid(file, "k_r", "k_theta", {**reading, **(chosen or {})})
    cell, columns = across(len(names), Cell(*COLUMN_INCHES, 0, 0, *COLUMN_INCHES), 0.48)
    rows, below = -(-len(names) // columns), legend_inches()
    note = " ".join(filter(None, [note, pinned_note(file, grid)]))
    figure, bottom = sheet(file, cell.width * columns + 0.1, below + cell.height * rows, note, reading)
    entries = {}
    for name, letter, corner in zip(names, "abcdefg", corners(len(names), columns, cell, bottom + below)):
        entries |= draw_column(figure, file, grid, name, letter, corner, cell)
    legend_at_foot(figure, entries, bottom + 0.2 * LEGEND_INCHES)
    return figure


def legend_inches():
    """Room below the maps; the figure of a paper grows by its legend."""
    return LEGEND_INCHES if paper_width() is None else 0


def boxes(cell):
    """Within the cell of a quantity: corner and size of surface, map, colour bar and heading, and the heading's width in
    letters. In the standard figure the map is below the surface, in a paper beside it."""
    width, height = cell.width, cell.height
    if paper_width() is None:
        return ((0, 2.95, width, height - 3.3), (0.62, 0.5, width - 0.85, 1.8), (0.62, 2.4, width - 0.85, 0.1),
                (0, height - 0.4, width, 0.4), 36)
    left, right, tall = 0.5 * width + 0.56, 0.5 * width - 0.7, height - 1.07
    return ((0, 0.08, 0.5 * width - 0.1, height - 0.28), (left, 0.42, right, tall), (left, tall + 0.5, right, 0.07),
            (0, height - 0.25, width, 0.22), int(14 * width))


def pinned_note(file, grid):
    """How much of the friction the pinned bristles carry."""
    if "pinned_share_R_x" not in file:
        return ""
    share = select(dataset(file, "pinned_share_R_x"), grid.axes[::-1], **grid.chosen)
    if not np.isfinite(share).any():
        return ""
    if np.nanmax(share) == 0:
        return "No bristle stays pinned at the pole."
    return (f"Bristles that stay pinned at the pole carry up to {100 * np.nanmax(share):.2g} % of the friction, "
            f"{100 * np.nanmedian(share):.2g} % in the median of the points.")


def draw_log_map(file, name, reading, note):
    """A map of one quantity of wide range, with a logarithmic colour scale."""
    grid = read_grid(file, "k_r", "k_theta", reading)
    data = dataset(file, name)
    field = np.ma.masked_less_equal(np.ma.masked_invalid(select(data, grid.axes[::-1], **grid.chosen)), 0)
    if not field.count():
        raise BristleError(f"{place_of(data)} has no positive values to draw")
    width, below = paper_width() or 7.6, legend_inches()
    tall = 3.6 if paper_width() is None else 0.66 * (width - 1.8)
    figure, bottom = sheet(file, width, below + tall + 1, note, reading, verdicts=False)
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

    space = axes(of_surface, projection="3d")
    draw_surface(space, grid, field, norm)
    label_surface(space, grid, norm, titles, label(data))

    flat = axes(of_map)
    image = draw_map(flat, grid, field, norm)
    label_map(flat, grid, titles)

    bar = colour_bar(figure, image, (corner[0] + of_bar[0], corner[1] + of_bar[1], *of_bar[2:]),
                     orientation="horizontal", ticks=value_ticks(5 if paper_width() is None else 3))
    bar.ax.xaxis.set_ticks_position("top")
    bar.ax.set_ylabel(label(data), rotation=0, ha="right", va="center")

    head = axes(of_head)
    head.axis("off")
    head.text(0.03, 1, letter, weight="bold", fontsize=points(13), va="top")
    head.text(0.12, 0.97, wrapped(attribute(data, "long_name"), letters), va="top")
    return draw_jumps(flat, grid) | draw_status(flat, grid, field)


def draw_cells(flat, grid, field, norm):
    """The map's cells, as vectors unless they are many. Their edges have their colours: PDF viewers show seams else."""
    return flat.pcolormesh(cell_edges(grid.x), cell_edges(grid.y), field, norm=norm, edgecolors="face", linewidth=0.3,
                           rasterized=field.size > MOST_CELLS)


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


def draw_surface(space, grid, field, norm):
    """Faces between neighbouring points with values and without a jump, coloured by their mean."""
    x, y = np.meshgrid(grid.x, grid.y)
    points = np.stack([x, y, field.filled(np.nan)], axis=-1)
    faces = []
    torn = torn_faces(grid)
    for j in range(len(grid.y) - 1):
        for i in range(len(grid.x) - 1):
            if torn[j, i]:
                continue
            corners = points[[j, j, j + 1, j + 1], [i, i + 1, i + 1, i]]
            corners = corners[np.isfinite(corners[:, 2])]
            if len(corners) >= 3:
                faces.append(corners)
    if faces:
        shades = colormaps[COLORMAP](norm([face[:, 2].mean() for face in faces]))
        space.add_collection3d(Poly3DCollection(faces, facecolors=shades, edgecolors="#00000070",
                                                linewidths=0.35))


def torn_faces(grid):
    """Whether the loading path jumps along any edge of the face between four points."""
    along_y, along_x = grid.jumps
    return along_x[:-1] | along_x[1:] | along_y[:, :-1] | along_y[:, 1:]


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
    places = [(j, x[i + 1]) for j, i in np.argwhere(along_x)] if grid.located is None else grid.located
    for j, place_x in places:
        flat.plot([place_x, place_x], [y[j], y[j + 1]], **JUMP_LOOK)
    if not places:
        return {}
    how = f"$z_0$ of neighbours differs by more than {LEAST_CHANGE:g}" if grid.located is None else "located to 1 %"
    return {f"{JUMP_TEXT} {how}": Line2D([], [], **JUMP_LOOK)}


def label_surface(space, grid, norm, titles, z_title):
    for axis, line, title in zip("xy", (grid.x, grid.y), titles):
        places, texts = log_ticks(line[0], line[-1])
        getattr(space, f"set_{axis}lim")(line[0], line[-1])
        getattr(space, f"set_{axis}ticks")(places, texts)
        getattr(space, f"set_{axis}label")(title, labelpad=-3)
    space.set_zlim(norm.vmin, norm.vmax)
    space.zaxis.set_major_locator(value_ticks())
    space.text2D(0.97, 0.83, z_title, transform=space.transAxes, ha="center", fontsize=points(11))
    space.tick_params(pad=-3, labelsize=points(8))
    space.tick_params(axis="z", pad=0)
    for axis in (space.xaxis, space.yaxis, space.zaxis):
        axis.set_pane_color((0.97, 0.97, 0.97, 1))
        axis.set_rotate_label(False)
    space.patch.set_visible(False)  # it would hide what is beside the surface
    # Seen from large k_r and small k_theta: a decrease with k_r faces the reader.
    space.view_init(elev=24, azim=-52)
    space.set_box_aspect((1.15, 1.0, 0.95))


def cell_edges(line):
    """Edges of the map's cells, halfway between the points."""
    middle = (line[1:] + line[:-1]) / 2
    return np.concatenate([[2 * line[0] - middle[0]], middle, [2 * line[-1] - middle[-1]]])


def draw_map(flat, grid, field, norm):
    flat.set_facecolor("#dddddd")
    image = draw_cells(flat, grid, field, norm)
    # The outer cells are cut in half: the map has the sweep's range.
    flat.set(xlim=grid.x[[0, -1]], ylim=grid.y[[0, -1]])
    if field.count() and np.ptp(field.compressed()) > 0:
        levels = value_ticks(7).tick_values(norm.vmin, norm.vmax)
        levels = levels[(levels > norm.vmin) & (levels < norm.vmax)]
        lines = flat.contour(*torn_field(grid, field), levels, colors="black", linewidths=0.7, corner_mask=False)
        j, i = np.nonzero(remarked(grid, field))
        label_contours(flat, lines, np.column_stack([grid.x[i], grid.y[j]]))
    return image


def label_map(flat, grid, titles):
    for axis, line, title in zip("xy", (grid.x, grid.y), titles):
        places, texts = log_ticks(line[0], line[-1])
        getattr(flat, f"set_{axis}ticks")(places, texts)
        getattr(flat, f"set_{axis}label")(title, labelpad=1)


def remarked(grid, field):
    """Points with a value and a status other than ok."""
    return (grid.status > 0) & ~np.ma.getmaskarray(field)


def draw_status(flat, grid, field):
    """Hatches cells without a value and marks points with a remark; returns legend entries by text."""
    entries = {}
    empty = np.ma.getmaskarray(field)
    x, y = cell_edges(grid.x), cell_edges(grid.y)
    for status in np.unique(grid.status):
        here = grid.status == status
        meaning = readable(grid.meanings[status])
        cells = [patches.Rectangle((x[i], y[j]), x[i + 1] - x[i], y[j + 1] - y[j])
                 for j, i in np.argwhere(here & empty)]
        if cells:
            look = dict(facecolor="#dddddd", edgecolor="#555555", linewidth=0,
                        hatch=HATCHES[status % len(HATCHES)])
            flat.add_collection(PatchCollection(cells, **look))
            entries[f"no value: {meaning}"] = patches.Patch(**look)
        marked = here & remarked(grid, field)
        if marked.any():
            look = dict(marker=status_marker(status), markersize=4, linestyle="",
                        markerfacecolor="white", markeredgecolor="black", markeredgewidth=0.7,
                        clip_on=False)
            j, i = np.nonzero(marked)
            flat.plot(grid.x[i], grid.y[j], **look)
            entries[f"status: {meaning}"] = Line2D([], [], **look)
    return entries
