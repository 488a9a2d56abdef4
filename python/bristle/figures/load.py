"""Friction over the load, and over the load in units of the lift-off load, a panel for each model of bending."""

import numpy as np

from ..plotting.curves import (curve_marks, draw_curve, jump_note, legend_below, over, read_curve, title_axis,
                               up_to_last_value, with_symbol)
from ..plotting.layout import Cell, across, corners, heading, place_cell, sheet
from ..plotting.lift_off import LIFT_OFF, in_percent, scatter
from ..plotting.page import lettered, paper_width, points
from ..plotting.readings import one_page, reading_name, readings
from ..plotting.style import GREY, described, looks
from ..results import axis_values, dataset, select

AXES = ["k_r", "R_n_target"]
VARIABLES = ["R_x_norm"]
SCALED = "load_over_lift_off"
LEGEND_INCHES = 0.3


def MARKS(file):
    return f"{curve_marks(file, 'R_n_target')} {lift_off_note(file)}"


@one_page
def draw(file):
    shown = lettered([(scaled, reading) for scaled in (False, True) for reading in readings(file)])
    cell, columns = across(max(2, len(readings(file))), Cell(3.75, 3.4, 0.85, 0.72, 2.8, 2.35), 0.62)
    columns = min(columns, len(shown))
    below = LEGEND_INCHES if paper_width() is None else 0  # of the legend
    figure, bottom = sheet(file, cell.width * columns + 0.1, cell.height * -(-len(shown) // columns) + below,
                           f"{lift_off_note(file)}\n{jump_note(file, 'R_n_target')}")
    entries, first = {}, None
    places = corners(len(shown), columns, cell, bottom + below)
    for i, ((letter, (scaled, reading)), corner) in enumerate(zip(shown, places)):
        axes = place_cell(figure, corner, cell, sharey=first)
        first = first or axes
        over_what = SCALED if scaled else "R_n_target"
        heading(axes, letter, reading_name(reading), [f"over the {described(dataset(file, over_what))}", reading_name(reading)])
        entries |= draw_brushes(axes, file, reading, scaled)
        title_axis(axes, "x", dataset(file, over_what), "load over lift-off load" if scaled else "load")
        if i % columns == 0:
            title_axis(axes, "y", dataset(file, VARIABLES[0]), "friction relative\nto rigid bristles")
    first.set_ylim(0, 1)
    legend_below(first, entries, bottom + LEGEND_INCHES / 2)
    return figure


def draw_brushes(axes, file, reading, scaled):
    """A line for each radial stiffness; returns legend entries of the statuses."""
    entries, stiffness = {}, dataset(file, "k_r")
    for k_r, look in looks(axis_values(file, "k_r")):
        curve = up_to_last_value(read_curve(file, VARIABLES[0], "R_n_target", k_r=k_r, **reading))
        if scaled:
            lift_off = select(dataset(file, LIFT_OFF), ["R_n_target"], k_r=k_r, **reading)
            curve = over(curve, np.nanmean(lift_off))
        entries |= draw_curve(axes, curve, look, with_symbol(stiffness, k_r))
    axes.set_xlim(left=0)
    if scaled:
        draw_lift_off(axes, scatter(file))
    return entries


def draw_lift_off(axes, width):
    """The lift-off load, its scatter, and which phase is on which side."""
    axes.axvline(1, color=GREY, linewidth=1, zorder=0)
    axes.axvspan(1 - width, 1 + width, color=GREY, alpha=0.2, linewidth=0, zorder=0)
    for name, place, side in (("bouncing", 1 - width, "right"), ("in contact", 1 + width, "left")):
        axes.text(place, 0.97, f" {name} ", transform=axes.get_xaxis_transform(), ha=side, va="top", color=GREY, fontsize=points(9))


def lift_off_note(file):
    return (f"Grey line: the lift-off load by its formula; grey band: the scatter of the formula, {in_percent(scatter(file))}. "
            "Lines end at the largest load that is reached.")
