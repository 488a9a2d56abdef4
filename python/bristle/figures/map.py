"""A variable of any result as a map over its two longest numeric axes, a panel for each value of the other axes."""

from itertools import product

import numpy as np

from ..errors import BristleError
from ..plotting.curves import in_words
from ..plotting.layout import Cell, across, corners, heading, legend_at_foot, place, sheet
from ..plotting.maps import (LEGEND_INCHES, colour_bar, colour_range, draw_jumps, draw_map, draw_status, label_map,
                             marks, read_grid)
from ..plotting.page import drawn_on, lettered
from ..plotting.readings import OPTIONS
from ..plotting.style import bar_ticks, described, displayed, label
from ..results import as_result, axis_names, axis_values, dataset, place_of, select, values

AXES = []
MARKS = marks
MOST = 6  # panels; of more, some are drawn
BAR_INCHES = 0.75  # room of the colour bar


def draw(file, y="R_x_norm", *, plain=True, width=None, panels=None, maps_only=True, cmap=None, style=None):
    """Always as for a paper, 7 inches wide unless there is a width."""
    with drawn_on(plain, 7 if width is None else width, panels, maps_only, cmap, style):
        return draw_variable(as_result(file), y)


draw.__doc__ = f"{__doc__}\n\n{draw.__doc__}\ny: the variable, for example \"gamma_1\".{OPTIONS}"


def draw_variable(file, name):
    data = displayed(dataset(file, name))
    axes = {axis: axis_values(file, axis) for axis in axis_names(data)}
    numeric = [axis for axis, line in axes.items() if len(line) > 1 and not isinstance(line[0], str)]
    if len(numeric) < 2 or values(data).dtype.kind != "f":
        raise BristleError(f"{place_of(data)}: a map needs a variable with numbers over two axes with at least 2 numbers; "
                           "the figure curve draws one over a single axis")
    along = sorted(numeric, key=lambda axis: -len(axes[axis]))[:2]
    others = {axis: line for axis, line in axes.items() if axis not in along}
    choices = [dict(zip(others, chosen)) for chosen in product(*others.values())]
    shown = np.unique(np.linspace(0, len(choices) - 1, min(MOST, len(choices))).round().astype(int))
    shown = lettered([choices[i] for i in shown])
    fields = [np.ma.masked_invalid(select(data, along[::-1], **chosen)) for _, chosen in shown]
    norm = colour_range(np.ma.concatenate(fields))
    cell, columns = across(len(shown), Cell(5, 4, 0.7, 0.5, 4, 3), 0.7)
    figure, bottom = sheet(file, cell.width * columns, cell.height * -(-len(shown) // columns) + BAR_INCHES)
    figure.maps = True
    entries, titles = {}, [label(dataset(file, axis)) for axis in along]
    for (letter, chosen), field, corner in zip(shown, fields, corners(len(shown), columns, cell, bottom + BAR_INCHES)):
        flat = place(figure, corner[0] + cell.left, corner[1] + cell.low, cell.inner_width, cell.inner_height)
        grid = read_grid(file, *along, chosen, any_scale=True)
        image = draw_map(flat, grid, field, norm)
        label_map(flat, grid, titles)
        words = in_words(file, chosen)
        heading(flat, letter, words, [described(data), *(in_words(file, {axis: value}) for axis, value in chosen.items())])
        entries |= draw_jumps(flat, grid) | draw_status(flat, grid, field)
    wide = 0.6 * figure.get_figwidth()
    bar = colour_bar(figure, image, (0.2 * figure.get_figwidth(), bottom + 0.55, wide, 0.1), orientation="horizontal",
                     ticks=bar_ticks(norm, wide))
    bar.set_label(label(data), labelpad=0)
    legend_at_foot(figure, entries, bottom + 0.2 * LEGEND_INCHES)
    return figure
