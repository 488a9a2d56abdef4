"""Friction over the load of brushes whose bristles differ, after loading and after unloading."""

import numpy as np
from matplotlib.lines import Line2D

from ..plotting.curves import BANDS, JUMPS, draw_curve, legend_below, read_curve, title_axis
from ..plotting.layout import Cell, across, corners, heading, place_cell, sheet
from ..plotting.page import lettered, paper_width
from ..plotting.readings import one_page
from ..plotting.style import BLACK, Look, described, looks
from ..results import axis_values, dataset, values

AXES = ["path", "sample", "R_n_target"]
VARIABLES = ["R_x_norm"]
PANELS = {"scatter_r0": "length of the bristles", "scatter_E": "Young's modulus"}
DASHES = {"loading": "-", "unloading": "--"}
LEGEND_INCHES = 0.3
NOTE = "Solid, after loading; dashed, after unloading. The bristles of a brush differ, normally distributed, and share one gap."
MARKS = f"Colours and markers tell the standard deviations apart, as in the legend. {NOTE} {BANDS} {JUMPS}"


@one_page
def draw(file):
    cell, columns = across(len(PANELS), Cell(5.0, 4.2, 0.85, 0.72, 3.95, 3.1), 0.62)
    below = LEGEND_INCHES if paper_width() is None else 0
    figure, bottom = sheet(file, cell.width * columns + 0.1, cell.height * -(-len(PANELS) // columns) + below,
                           f"{NOTE}\n{BANDS} {JUMPS}")
    entries, first = {}, None
    places = corners(len(PANELS), columns, cell, bottom + below)
    for (letter, (name, text)), corner in zip(lettered(PANELS.items()), places):
        axes = place_cell(figure, corner, cell, sharey=first)
        first = first or axes
        heading(axes, letter, f"bristles that differ in {'length' if text.startswith('length') else text}",
                [f"{described(dataset(file, VARIABLES[0]))}, scatter of the {text}"])
        entries |= draw_brushes(axes, file, name)
        title_axis(axes, "x", dataset(file, "R_n_target"), "load")
        title_axis(axes, "y", dataset(file, VARIABLES[0]), "friction relative\nto rigid bristles")
    for path in axis_values(file, "path"):
        entries[f"after {path}"] = Line2D([], [], color=BLACK, linestyle=DASHES[path], linewidth=1.4)
    first.set_ylim(0, 1)
    legend_below(first, entries, bottom + LEGEND_INCHES / 2)
    return figure


def draw_brushes(axes, file, name):
    """A line for each width of the scatter and each path; returns legend entries of the statuses."""
    entries, width = {}, values(dataset(file, name))
    others = sum(values(dataset(file, other)) for other in PANELS if other != name)
    samples = [sample for sample in np.argsort(width) if others[sample] == 0]
    for sample, look in looks(samples):
        text = f"scatter {100 * width[sample]:g} %" if width[sample] else "all alike"
        for path in axis_values(file, "path"):
            curve = read_curve(file, VARIABLES[0], "R_n_target", path=path, sample=axis_values(file, "sample")[sample])
            first = path == axis_values(file, "path")[0]
            entries |= draw_curve(axes, curve, Look(look.colour, DASHES[path], look.marker if first else ""),
                                  text if first else None, 1.3)
    return entries
