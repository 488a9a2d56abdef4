"""An artificial ski slope: friction over the slab's velocity and over the load, under both local friction laws."""

import numpy as np

from curves import BANDS, coloured, draw_curve, legend, log_axis, number_axis, read_curve
from page import heading, page, place
from style import attribute, dataset, run
from sweep import NAMES as WORDS
from sweep import axis

# The columns: what is drawn over which axis, for values of the other.
COLUMNS = [("friction_coefficient", "V0_m_per_s", "R_n_N"), ("R_x_in_N", "R_n_N", "V0_m_per_s")]
PANEL_INCHES = (4.1, 2.9)
ROW_INCHES = 3.75
SHOWN = 4  # curves of a panel, at most


def draw(file):
    laws = axis(file, "friction")
    figure, bottom = page(file, 10.6, ROW_INCHES * len(laws) + 0.25, BANDS)
    for row, law in enumerate(laws):
        low = bottom + 0.7 + ROW_INCHES * (len(laws) - 1 - row)
        for column, (name, along, other) in enumerate(COLUMNS):
            axes = place(figure, 0.8 + 5.3 * column, low, *PANEL_INCHES)
            draw_panel(axes, file, law, name, along, other)
            heading(axes, "abcdef"[2 * row + column],
                    f"{WORDS.get(law, law)}: {attribute(dataset(file, name), 'long_name').split(' per')[0]}")
    return figure


def draw_panel(axes, file, law, name, along, other):
    entries = {}
    lines = axis(file, other)
    shown = lines[np.unique(np.linspace(0, len(lines) - 1, min(SHOWN, len(lines))).round().astype(int))]
    for value, colour in coloured(shown):
        curve = read_curve(file, name, along, friction=law, **{other: value})
        entries |= draw_curve(axes, curve, colour, with_units(dataset(file, other), value))
    if along == "V0_m_per_s":
        log_axis(axes, "x", dataset(file, along))
        low, high = axes.get_ylim()
        axes.set_ylim(max(0, low - 0.35 * (high - low)), high)  # room for the legend
    else:
        number_axis(axes, "x", dataset(file, along))
        axes.set_xlim(left=0)
        axes.set_ylim(bottom=0)
    number_axis(axes, "y", dataset(file, name))
    legend(axes, entries, loc="upper left" if along == "R_n_N" else "best", fontsize=8, ncol=1 if along == "R_n_N" else 2)


def with_units(data, value):
    return f"${attribute(data, 'symbol')}$ = {value:.3g} {attribute(data, 'units')}"


if __name__ == "__main__":
    run("ski", __doc__, ["friction", "V0_m_per_s", "R_n_N", "status", *(name for name, _, _ in COLUMNS)], draw)
