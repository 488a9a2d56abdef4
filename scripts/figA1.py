"""Fig. A1: isotropy of the lattice, its transverse force for several draws of the azimuths."""

import numpy as np

from curves import BARS, draw_statuses, legend, number_axis, read_curve
from page import page, place
from style import COLOURS, GREY, dataset, label, run
from sweep import axis

NAME = "R_y_norm"
NOTE = (" Lines: the mean over the whole circle by quadrature, with its estimated error as a band. "
        "Lattices of one seed have the same azimuths.")
APART = 0.12  # between the stiffnesses of one seed


def draw(file):
    figure, bottom = page(file, 8.2, 4.6, BARS + NOTE)
    axes = place(figure, 1.05, bottom + 0.65, 6.9, 3.8)
    axes.axhline(0, color=GREY, linewidth=1, zorder=0)
    entries = {}
    stiffnesses = axis(file, "k_r")
    places = APART * (np.arange(len(stiffnesses)) - (len(stiffnesses) - 1) / 2)
    for colour, k_r, beside in zip(COLOURS, stiffnesses, places):
        lattice = read_curve(file, NAME, "seed", sampling="lattice", k_r=k_r)
        lattice = lattice._replace(x=lattice.x + beside)
        axes.errorbar(lattice.x, lattice.y, lattice.error, linestyle="", marker="o", markersize=4.5, capsize=2,
                      linewidth=1.1, color=colour, label=f"{label(dataset(file, 'k_r'))} = {k_r:g}")
        entries |= draw_statuses(axes, lattice, colour)
        mean = read_curve(file, NAME, "seed", sampling="quadrature", k_r=k_r)
        axes.axhspan(mean.y[0] - mean.error[0], mean.y[0] + mean.error[0], color=colour, alpha=0.3, linewidth=0)
        axes.axhline(mean.y[0], color=colour, linewidth=0.8)
    axes.set_xticks(axis(file, "seed"))
    widest = np.nanmax(np.abs(axes.dataLim.intervaly))
    axes.set_ylim(-1.1 * widest, 1.35 * widest)
    axes.set_xlabel("seed")
    number_axis(axes, "y", dataset(file, NAME))
    legend(axes, entries, loc="upper right", ncol=3)
    return figure


if __name__ == "__main__":
    run("figA1", __doc__, ["sampling", "k_r", "seed", "status", NAME], draw)
