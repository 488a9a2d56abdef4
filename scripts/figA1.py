"""Fig. A1: isotropy of the lattice, its transverse force for several draws of the azimuths."""

import numpy as np

from curves import BARS, coloured, draw_points, legend, log_axis, number_axis, read_curve
from page import page, place
from style import BLACK, GREY, dataset, run
from sweep import axis

NAME = "R_y_norm"
NOTE = " Quadrature: the estimated error. The points of one stiffness are drawn side by side."
NEXT = 1.04  # factor between neighbouring points of one k_r


def draw(file):
    figure, bottom = page(file, 8.2, 4.6, BARS + NOTE)
    axes = place(figure, 1.05, bottom + 0.65, 5.4, 3.8)
    axes.axhline(0, color=GREY, linewidth=1, zorder=0)
    seeds = axis(file, "seed")
    shifts = NEXT ** (np.arange(len(seeds) + 1) - len(seeds) / 2)
    mean = read_curve(file, NAME, "k_r", sampling="quadrature", seed=seeds[0])
    entries = draw_points(axes, mean, BLACK, "quadrature", "D", shifts[0])
    for (seed, colour), shift in zip(coloured(seeds), shifts[1:]):
        curve = read_curve(file, NAME, "k_r", sampling="lattice", seed=seed)
        entries |= draw_points(axes, curve, colour, f"lattice, seed {seed:g}", shift=shift)
    log_axis(axes, "x", dataset(file, "k_r"), room=0.12)
    number_axis(axes, "y", dataset(file, NAME))
    legend(axes, entries, loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


if __name__ == "__main__":
    run("figA1", __doc__, ["sampling", "k_r", "seed", "status", NAME], draw)
