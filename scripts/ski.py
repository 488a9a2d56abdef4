"""An artificial ski slope: friction over the slab's velocity and over the load, under both local friction laws."""

import numpy as np

from curves import BANDS, coloured, draw_curve, legend, log_axis, number_axis, read_curve, with_symbol
from page import heading, page, place
from style import dataset, run
from sweep import NAMES as WORDS
from sweep import axis

NAME = "friction_coefficient"
PANEL_INCHES = (4.1, 2.9)
ROW_INCHES = 3.75
SHOWN = 4  # curves of a panel, at most


def draw(file):
    laws = axis(file, "friction")
    figure, bottom = page(file, 10.6, ROW_INCHES * len(laws) + 0.25, BANDS)
    for row, law in enumerate(laws):
        low = bottom + 0.7 + ROW_INCHES * (len(laws) - 1 - row)
        for column, (along, other) in enumerate((("V0_m_per_s", "R_n_N"), ("R_n_N", "V0_m_per_s"))):
            axes = place(figure, 0.8 + 5.3 * column, low, *PANEL_INCHES)
            draw_panel(axes, file, law, along, other)
            heading(axes, "abcd"[2 * row + column], f"{WORDS.get(law, law)}: over the "
                    f"{'velocity' if column == 0 else 'load'}")
    return figure


def draw_panel(axes, file, law, along, other):
    entries = {}
    lines = axis(file, other)
    shown = lines[np.unique(np.linspace(0, len(lines) - 1, min(SHOWN, len(lines))).round().astype(int))]
    for value, colour in coloured(shown):
        curve = read_curve(file, NAME, along, friction=law, **{other: value})
        entries |= draw_curve(axes, curve, colour, with_symbol(dataset(file, other), round(value, 3)))
    log_axis(axes, "x", dataset(file, along))
    number_axis(axes, "y", dataset(file, NAME))
    axes.set_ylim(bottom=0)
    legend(axes, entries, loc="best", fontsize=8)


if __name__ == "__main__":
    run("ski", __doc__, ["friction", "V0_m_per_s", "R_n_N", "status", NAME], draw)
