"""The chart of a brush: friction over the load in units of the lift-off load and over the local friction."""

from itertools import product

import numpy as np
from matplotlib import colors, patches
from matplotlib.collections import LineCollection, PatchCollection

from ..plotting.contour_labels import label_region
from ..plotting.curves import in_words
from ..plotting.layout import Cell, across, corners, heading, legend_at_foot, place_cell, sheet
from ..plotting.lift_off import LIFT_OFF, in_percent, scatter
from ..plotting.maps import (LEGEND_INCHES, cell_edges, cells_at, colour_bar, corners_of, draw_jumps, draw_map,
                             draw_status, jump_marks, label_map, read_grid)
from ..plotting.page import lettered, paper_width
from ..plotting.readings import one_page, readings
from ..plotting.style import BLACK, bar_ticks, described, label
from ..results import axis_values, dataset, select, select_flags, values

AXES = ["contact", "nominal_friction", "R_n_target"]
VARIABLES = ["R_x_norm"]
ALONG = ["nominal_friction", "R_n_target"]
SCALED = "load_over_lift_off"
RIGID = 0.9  # of the friction of rigid bristles
BAR_INCHES = 0.65
HATCHED = dict(facecolor="none", edgecolor="#444444", linewidth=0, hatch="//")
REGIONS = ["nothing to gain:\nrubs like rigid bristles", "bouncing", "in contact"]


def MARKS(file):
    return f"Colours as at the bar; black lines are contours at the numbers. {note(file)} {jump_marks(file)}"


def note(file):
    return (f"Hatched: friction above {RIGID:g} of the friction of rigid bristles. Dashed: the border of the bristles that bounce, whose tips "
            "are off the slab for more than half of the time. Dash-dotted: the lift-off load by the formula, where it was tested, with "
            f"its scatter of {in_percent(scatter(file))} as a pale band.")


@one_page
def draw(file):
    choices = [{"contact": contact, **reading} for reading, contact in product(readings(file), axis_values(file, "contact"))]
    shown, data = lettered(choices), dataset(file, VARIABLES[0])
    cell, columns = across(len(shown), Cell(5.9, 4.75, 0.85, 0.7, 4.85, 3.65), 0.8)
    below = BAR_INCHES + (LEGEND_INCHES if paper_width() is None else 0)
    figure, bottom = sheet(file, cell.width * columns, cell.height * -(-len(shown) // columns) + below, note(file))
    figure.maps = True
    fields = [np.ma.masked_invalid(select(data, ALONG, **chosen)) for _, chosen in shown]
    norm, entries = colors.Normalize(0, 1), {}
    for (letter, chosen), field, corner in zip(shown, fields, corners(len(shown), columns, cell, bottom + below)):
        axes = place_cell(figure, corner, cell)
        image, found = draw_chart(axes, file, chosen, field, norm)
        entries |= found
        heading(axes, letter, f"contact: {in_words(file, chosen)}", [described(data), in_words(file, chosen)])
    wide, low = 0.6 * figure.get_figwidth(), bottom + below - 0.15
    bar = colour_bar(figure, image, (0.2 * figure.get_figwidth(), low, wide, 0.1), orientation="horizontal", ticks=bar_ticks(norm, wide))
    bar.set_label(f"friction relative to rigid bristles {label(data)}", labelpad=1)
    legend_at_foot(figure, entries, bottom + 0.2 * LEGEND_INCHES)
    return figure


def draw_chart(axes, file, chosen, field, norm):
    """The map of one contact with its regions; returns the colours' image and legend entries by text."""
    unit, grid = lift_off_load(file), read_grid(file, *ALONG[::-1], chosen)
    shift = np.log10(unit)
    located = None if grid.located is None else [(row, *np.subtract(places, shift)) for row, *places in grid.located]
    grid = grid._replace(x=grid.x - shift, located=located)
    image = draw_map(axes, grid, field, norm)
    x_title = label(dataset(file, "R_n_target")) if unit == 1 else f"over lift-off load {label(dataset(file, SCALED))}"
    label_map(axes, grid, [f"load {x_title}", f"local friction {label(dataset(file, 'nominal_friction'))}"])
    entries = draw_jumps(axes, grid) | draw_status(axes, grid, field)
    draw_lift_off(axes, file, grid, chosen)
    words, phase = select_flags(file, "phase", ALONG, **chosen)
    bouncing, contact = (phase == words.index(word) for word in ("bouncing", "contact"))
    rigid = field.filled(0) > RIGID
    cells = [patches.Polygon(corners_of(cell)) for cell in cells_at(grid, np.argwhere(rigid))]
    axes.add_collection(PatchCollection(cells, **HATCHED))
    draw_border(axes, grid, bouncing)
    for string, region in zip(REGIONS, (rigid, bouncing & ~rigid, contact & ~rigid)):
        label_region(axes, grid.x, grid.y, region, string)
    return image, entries


def lift_off_load(file):
    """The lift-off load of the brush, which the friction does not change; 1 where the formula was not tested."""
    loads = values(dataset(file, LIFT_OFF))
    return float(np.nanmedian(loads)) if np.isfinite(loads).any() else 1


def draw_lift_off(axes, file, grid, chosen):
    """The lift-off load, at the local frictions at which the formula was tested."""
    tested = np.flatnonzero(np.isfinite(select(dataset(file, LIFT_OFF), ALONG, **chosen)).any(axis=1))
    if not tested.size:
        return
    ends, width = cell_edges(grid.y)[[tested[0], tested[-1] + 1]], scatter(file)
    axes.plot([0, 0], ends, color=BLACK, linestyle="-.", linewidth=1)
    axes.fill_betweenx(ends, *np.log10([1 - width, 1 + width]), color="white", alpha=0.35, linewidth=0)


def draw_border(axes, grid, region):
    """A dashed line along the edges of the cells of a region."""
    x, y = cell_edges(grid.x), cell_edges(grid.y)
    beside, above = (np.argwhere(np.diff(region, axis=axis)) for axis in (1, 0))
    ends = [((x[i + 1], x[i + 1]), (y[j], y[j + 1])) for j, i in beside]
    ends += [((x[i], x[i + 1]), (y[j + 1], y[j + 1])) for j, i in above]
    axes.add_collection(LineCollection([np.transpose(end) for end in ends], color=BLACK, linestyle="--", linewidth=1.3))
