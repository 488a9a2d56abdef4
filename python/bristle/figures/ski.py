"""An artificial ski slope: friction over the slab's velocity and over the load, under both friction laws."""

import numpy as np

from ..plotting.curves import BANDS, LINES, draw_curve, legend, log_axis, read_curve, title_axis
from ..plotting.layout import Cell, across, corners, heading, legend_at_foot, place_cell, sheet
from ..plotting.page import is_plain, lettered, paper_width
from ..plotting.readings import one_page
from ..plotting.style import LOOKS
from ..results import CHOICE_NAMES, attribute, axis_values, dataset, select

AXES = ["friction", "R_n_N", "V0_m_per_s"]
# Of each column: the variable, the axis it is drawn over, and the axis that tells the curves apart.
COLUMNS = [("friction_coefficient", "V0_m_per_s", "R_n_N"), ("R_x_in_N", "R_n_N", "V0_m_per_s")]
TITLES_OF = {"friction_coefficient": "friction force over normal load", "R_x_in_N": "friction force"}
SHOWN = 4  # curves in a panel at most


def MARKS(file):
    return f"{LINES} {BANDS} {above_one(file)}"


@one_page
def draw(file):
    laws = axis_values(file, "friction")
    panels = lettered([(law, *column) for law in laws for column in COLUMNS])
    cell, columns = across(min(len(panels), len(COLUMNS)), Cell(5.3, 3.75, 0.8, 0.7, 4.1, 2.9), 0.5)
    height = cell.height * -(-len(panels) // columns) + (0 if is_plain() else 0.25)
    figure, bottom = sheet(file, cell.width * columns, height, f"{BANDS}\n{above_one(file)}")
    entries, statuses = {}, {}
    for (letter, panel), corner in zip(panels, corners(len(panels), columns, cell, bottom)):
        law, name, along, other = panel
        axes = place_cell(figure, corner, cell)
        found = draw_panel(axes, file, law, name, along, other)
        if paper_width() is None:
            loc, columns = ("upper left", 1) if along == "R_n_N" else ("upper center", 2)
            legend(axes, found, loc=loc, ncol=columns, handlelength=2, columnspacing=1)
        else:  # no room in the panels
            lines, texts = axes.get_legend_handles_labels()
            entries |= dict(zip(texts, lines))
            statuses |= found
        title = TITLES_OF[name]
        heading(axes, letter, f"{CHOICE_NAMES.get(law, law)}: {title}", [CHOICE_NAMES.get(law, law), title])
    legend_at_foot(figure, entries | statuses, bottom)
    return figure


def above_one(file):
    """Why the friction may exceed the load, with the ratio that rigid bristles would have."""
    if "nss" not in axis_values(file, "friction") or "R_x_norm" not in file:
        return ""
    ratio, share = (select(dataset(file, name), ["R_n_N", "V0_m_per_s"], friction="nss")
                    for name in (COLUMNS[0][0], "R_x_norm"))
    rigid = np.nanmean(ratio / share, axis=1)
    loads = axis_values(file, "R_n_N")
    return (r"NSS: the friction is $\tau_f$ times the area of contact (Hertz), which grows as $R_n^{2/3}$. So for rigid "
            f"bristles $R_x/R_n$ falls from {rigid[0]:.2g} at {loads[0]:g} N to {rigid[-1]:.2g} at {loads[-1]:g} N. Above 1 the "
            "friction exceeds the load.")


def draw_panel(axes, file, law, name, along, other):
    """Returns legend entries for the statuses by text."""
    entries = {}
    lines = axis_values(file, other)
    shown = lines[np.unique(np.linspace(0, len(lines) - 1, min(SHOWN, len(lines))).round().astype(int))]
    first = SHOWN * (along == COLUMNS[1][1])  # in a paper both columns have one legend, so each line its own look
    for value, look in zip(shown, LOOKS[first:]):
        curve = read_curve(file, name, along, friction=law, **{other: value})
        entries |= draw_curve(axes, curve, look, with_units(dataset(file, other), value))
    if along == "V0_m_per_s":
        log_axis(axes, "x", dataset(file, along))
        low, high = axes.get_ylim()
        if paper_width() is None:
            high += 0.38 * (high - low)  # room for the legend
        axes.set_ylim(max(0, low), high)
    else:
        title_axis(axes, "x", dataset(file, along))
        axes.set_xlim(left=0)
        axes.set_ylim(bottom=0)
    title_axis(axes, "y", dataset(file, name))
    return entries


def with_units(data, value):
    return f"${attribute(data, 'symbol')}$ = {value:.3g} {attribute(data, 'units')}"
