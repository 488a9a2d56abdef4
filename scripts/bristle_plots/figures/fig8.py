"""Fig. 8: friction over the local friction coefficient, for soft and stiff bristles."""

import numpy as np

from ..curves import (BANDS, JUMPS, coloured, draw_curve, label_line, legend, log_axis, log_range,
                      panels_by_reading, positive, read_curve, title_axis, with_symbol, without_remarks)
from ..page import paper_width
from ..readings import one_page
from ..results import axis_values, dataset
from ..style import GREY

AXES = ["k_r", "mu_c"]
VARIABLES = ["R_x_norm"]
PASSING = "R_x_norm_unpinned"
NOTE = f"{BANDS} {JUMPS}"
NOTE_PASSING = " Thin: friction of the bristles that pass, without those that stay pinned at the pole."
HIGHEST = 1.5  # upper end of the plot


@one_page
def draw(file):
    data, passing = dataset(file, VARIABLES[0]), PASSING in file
    figure, panels = panels_by_reading(file, (4.7, 4.1), (5.9, 4.1), NOTE + NOTE_PASSING * passing)
    stiffnesses, least = axis_values(file, "k_r"), []
    for axes, reading in panels:
        curves, entries = [], {}
        for stiffness, colour in coloured(stiffnesses):
            chosen = dict(k_r=stiffness, **reading)
            curves.append(read_curve(file, VARIABLES[0], "mu_c", **chosen))
            entries |= draw_curve(axes, curves[-1], colour, with_symbol(dataset(file, "k_r"), stiffness))
            if passing:
                thin = read_curve(file, PASSING, "mu_c", **chosen)
                draw_curve(axes, without_remarks(thin), colour, marker="", width=0.8)
        log_axis(axes, "x", dataset(file, "mu_c"), room=0)
        title_axis(axes, "y", data)
        draw_limits(axes, curves[int(np.argmax(stiffnesses))])
        legend(axes, entries, loc="lower left")
        least.append(positive(data, np.concatenate([curve.y for curve in curves])).min())
    log_range(axes, "y", np.log10(0.6 * min(least)), np.log10(HIGHEST))
    return figure


def draw_limits(axes, stiff):
    """Lines for rigid bristles, and for the friction force of the stiff bristles at the largest mu_c."""
    axes.axhline(1, color=GREY, linewidth=1, zorder=0)
    label_line(axes, 1.05 * stiff.x[0], 1.03, 0, "rigid bristles")
    valued = np.flatnonzero(np.isfinite(stiff.y))
    if valued.size:
        force = stiff.x[valued[-1]] * stiff.y[valued[-1]]
        x = np.geomspace(force / HIGHEST, stiff.x[-1])
        axes.plot(x, force / x, color=GREY, linewidth=1, zorder=0)
        start = 2.6 if paper_width() is None else 1.5
        label_line(axes, start * force, 1.02 / start, -1, r"constant force $R_x$")
