"""Fig. 8: friction over the local friction coefficient, for soft and stiff bristles."""

import numpy as np

from curves import (BANDS, coloured, draw_curve, label_line, legend, log_axis, log_range, number_axis,
                    read_curve, with_symbol)
from page import page, place
from style import GREY, dataset, fail, run
from sweep import axis

NAME = "R_x_norm"
HIGHEST = 1.5  # of the plot


def draw(file):
    figure, bottom = page(file, 7.2, 4.9, BANDS)
    axes = place(figure, 0.9, bottom + 0.65, 5.9, 4.1)
    curves, entries, stiffnesses = [], {}, axis(file, "k_r")
    for stiffness, colour in coloured(stiffnesses):
        curves.append(read_curve(file, NAME, "mu_c", k_r=stiffness))
        entries |= draw_curve(axes, curves[-1], colour, with_symbol(dataset(file, "k_r"), stiffness))
    found = np.concatenate([curve.y for curve in curves])
    if not (found > 0).any():
        fail(f"{file.filename}: dataset '/{NAME}' has no positive values to draw")
    log_axis(axes, "x", dataset(file, "mu_c"), room=0)
    log_range(axes, "y", np.log10(0.8 * np.nanmin(found)), np.log10(HIGHEST))
    number_axis(axes, "y", dataset(file, NAME))
    draw_limits(axes, curves[int(np.argmax(stiffnesses))])
    legend(axes, entries, loc="lower left")
    return figure


def draw_limits(axes, stiff):
    """Rigid bristles, and the friction force that the stiff ones have last, at any coefficient."""
    axes.axhline(1, color=GREY, linewidth=1, zorder=0)
    label_line(axes, 1.05 * stiff.x[0], 1.03, 0, "rigid bristles")
    valued = np.flatnonzero(np.isfinite(stiff.y))
    if valued.size:
        force = stiff.x[valued[-1]] * stiff.y[valued[-1]]
        x = np.geomspace(force / HIGHEST, stiff.x[-1])
        axes.plot(x, force / x, color=GREY, linewidth=1, zorder=0)
        label_line(axes, 2.6 * force, 1.02 / 2.6, -1, r"constant force $R_x$")


if __name__ == "__main__":
    run("fig8", __doc__, ["k_r", "mu_c", "status", NAME], draw)
