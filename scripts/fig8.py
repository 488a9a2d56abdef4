"""Fig. 8: friction over the local friction coefficient, for soft and stiff bristles."""

import numpy as np

from bristle_plots.command_line import run_figure
from bristle_plots.curves import (BANDS, coloured, draw_curve, label_line, legend, log_axis, log_range, positive,
                                  read_curve, title_axis, with_symbol)
from bristle_plots.layout import place, sheet
from bristle_plots.results import axis_values, dataset
from bristle_plots.style import GREY

VARIABLES = ["R_x_norm"]
HIGHEST = 1.5  # upper end of the plot


def draw(file):
    data = dataset(file, VARIABLES[0])
    figure, bottom = sheet(file, 7.2, 4.9, BANDS)
    axes = place(figure, 0.9, bottom + 0.65, 5.9, 4.1)
    curves, entries, stiffnesses = [], {}, axis_values(file, "k_r")
    for stiffness, colour in coloured(stiffnesses):
        curves.append(read_curve(file, VARIABLES[0], "mu_c", k_r=stiffness))
        entries |= draw_curve(axes, curves[-1], colour, with_symbol(dataset(file, "k_r"), stiffness))
    least = positive(data, np.concatenate([curve.y for curve in curves])).min()
    log_axis(axes, "x", dataset(file, "mu_c"), room=0)
    log_range(axes, "y", np.log10(0.8 * least), np.log10(HIGHEST))
    title_axis(axes, "y", data)
    draw_limits(axes, curves[int(np.argmax(stiffnesses))])
    legend(axes, entries, loc="lower left")
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
        label_line(axes, 2.6 * force, 1.02 / 2.6, -1, r"constant force $R_x$")


if __name__ == "__main__":
    run_figure(__file__, __doc__, draw)
