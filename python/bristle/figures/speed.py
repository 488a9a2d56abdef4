"""Friction coefficient and gap over the speed in SI units, after loading and after unloading."""

import numpy as np
from matplotlib.lines import Line2D

from ..plotting.curves import BANDS, JUMPS, draw_curve, log_axis, read_curve, title_axis
from ..plotting.jumps import Jump
from ..plotting.layout import Cell, across, corners, heading, legend_at_foot, place_cell, sheet
from ..plotting.page import lettered, paper_width
from ..plotting.readings import one_page, reading_name, readings
from ..plotting.style import BLACK, Look, described, looks, symbol, value_ticks
from ..results import attribute, axis_values, dataset

AXES = ["path", "R_n_N", "V0_m_per_s"]
VARIABLES = ["friction_coefficient", "z_0_in_m"]
TITLES_OF = {"friction_coefficient": "friction coefficient", "z_0_in_m": "gap between slab and ground"}
DASHES = {"loading": "-", "unloading": "--"}
LEGEND_INCHES = 0.35
NOTE = "Loads are per bristle. Solid, after loading; dashed, after unloading; where both are the same, solid."
DOTTED = "Dotted lines join both sides, halfway between the points."


def MARKS(file):
    return f"Colours and markers tell the loads apart, as in the legend. {NOTE} {BANDS} {JUMPS} {DOTTED}"


@one_page
def draw(file):
    panels = lettered([(reading, name) for reading in readings(file) for name in VARIABLES])
    cell, columns = across(min(len(panels), 2), Cell(5.2, 4.25, 0.8, 0.75, 4.15, 3.2), 0.7)
    below = LEGEND_INCHES if paper_width() is None else 0
    figure, bottom = sheet(file, cell.width * columns, cell.height * -(-len(panels) // columns) + below,
                           f"{NOTE}\n{BANDS} {JUMPS} {DOTTED}")
    lines, statuses = {}, {}
    for (letter, (reading, name)), corner in zip(panels, corners(len(panels), columns, cell, bottom + below)):
        axes = place_cell(figure, corner, cell)
        statuses |= draw_panel(axes, file, name, reading)
        lines |= dict(zip(*axes.get_legend_handles_labels()[::-1]))
        title = ": ".join(filter(None, [reading_name(reading), TITLES_OF[name]]))
        heading(axes, letter, title, [described(dataset(file, name)), reading_name(reading)])
    for path in axis_values(file, "path"):
        lines[f"after {path}"] = Line2D([], [], color=BLACK, linestyle=DASHES[path], linewidth=1.4)
    legend_at_foot(figure, lines | statuses, bottom + LEGEND_INCHES / 2)
    return figure


def draw_panel(axes, file, name, reading):
    """Lines of each load; returns legend entries of the statuses."""
    entries, speed, unit = {}, dataset(file, "V0_m_per_s"), attribute(dataset(file, "R_n_N"), "units")
    for load, look in looks(axis_values(file, "R_n_N")):
        for path in axis_values(file, "path"):
            curve = joined(read_curve(file, name, "V0_m_per_s", path=path, R_n_N=load, **reading))
            if name == "z_0_in_m":
                curve = curve._replace(y=1000 * curve.y, error=1000 * curve.error)
            first = path == axis_values(file, "path")[0]
            entries |= draw_curve(axes, curve, Look(look.colour, DASHES[path], look.marker if first else ""),
                                  f"load {load:g} {unit}" if first else None, 1.3)
    log_axis(axes, "x", speed)
    title_axis(axes, "x", speed, "speed of the slab")
    top = axes.get_ylim()[1]
    axes.set_yticks(value_ticks().tick_values(0, top))
    axes.set_ylim(0, top)
    if name == "z_0_in_m":
        axes.set_ylabel(f"gap {symbol(dataset(file, name))} [mm]")
    else:
        title_axis(axes, "y", dataset(file, name), "friction over load")
    return entries


def joined(curve):
    """The curve with its jumps halfway between the points, so that both sides are joined."""
    places = np.sqrt(curve.x[1:] * curve.x[:-1])
    return curve._replace(located=[Jump((int(i),), *[places[i]] * 3) for i in np.flatnonzero(curve.jumps)])
