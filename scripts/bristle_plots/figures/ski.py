"""An artificial ski slope: friction over the slab's velocity and over the load, under both friction laws."""

import numpy as np

from ..curves import BANDS, coloured, draw_curve, legend, log_axis, read_curve, title_axis
from ..layout import heading, place, sheet
from ..readings import one_page
from ..results import CHOICE_NAMES, attribute, axis_values, dataset

# Of each column: the variable, the axis it is drawn over, and the axis that tells the curves apart.
COLUMNS = [("friction_coefficient", "V0_m_per_s", "R_n_N"), ("R_x_in_N", "R_n_N", "V0_m_per_s")]
PANEL_INCHES = (4.1, 2.9)
ROW_INCHES = 3.75
SHOWN = 4  # curves in a panel at most


@one_page
def draw(file):
    laws = axis_values(file, "friction")
    figure, bottom = sheet(file, 10.6, ROW_INCHES * len(laws) + 0.25, BANDS)
    for row, law in enumerate(laws):
        low = bottom + 0.7 + ROW_INCHES * (len(laws) - 1 - row)
        for column, (name, along, other) in enumerate(COLUMNS):
            axes = place(figure, 0.8 + 5.3 * column, low, *PANEL_INCHES)
            draw_panel(axes, file, law, name, along, other)
            title = attribute(dataset(file, name), "long_name").split(" per")[0]
            heading(axes, "abcdef"[2 * row + column], f"{CHOICE_NAMES.get(law, law)}: {title}")
    return figure


def draw_panel(axes, file, law, name, along, other):
    entries = {}
    lines = axis_values(file, other)
    shown = lines[np.unique(np.linspace(0, len(lines) - 1, min(SHOWN, len(lines))).round().astype(int))]
    for value, colour in coloured(shown):
        curve = read_curve(file, name, along, friction=law, **{other: value})
        entries |= draw_curve(axes, curve, colour, with_units(dataset(file, other), value))
    if along == "V0_m_per_s":
        log_axis(axes, "x", dataset(file, along))
        low, high = axes.get_ylim()
        axes.set_ylim(max(0, low - 0.35 * (high - low)), high)  # room for the legend
    else:
        title_axis(axes, "x", dataset(file, along))
        axes.set_xlim(left=0)
        axes.set_ylim(bottom=0)
    title_axis(axes, "y", dataset(file, name))
    loc, columns = ("upper left", 1) if along == "R_n_N" else ("best", 2)
    legend(axes, entries, loc=loc, fontsize=8, ncol=columns)


def with_units(data, value):
    return f"${attribute(data, 'symbol')}$ = {value:.3g} {attribute(data, 'units')}"
