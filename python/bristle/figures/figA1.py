"""Fig. A1: isotropy of the lattice, its transverse force for several draws of the azimuths."""

import numpy as np
from matplotlib import ticker

from ..plotting.curves import BARS, draw_statuses, legend, panels_by_reading, read_curve, title_axis, with_symbol
from ..plotting.readings import one_page
from ..plotting.style import GREY, looks
from ..results import axis_values, dataset

AXES = ["sampling", "k_r", "seed"]
VARIABLES = ["R_y_norm"]
NOTE = (" Lines: the mean over the whole circle by quadrature, with its estimated error as a band. "
        "Lattices of one seed have the same azimuths.")
MARKS = f"{BARS}{NOTE} Thin grey line: zero"
OFFSET = 0.12  # between the stiffnesses of one seed


@one_page
def draw(file):
    figure, panels = panels_by_reading(file, (5.4, 3.6), (6.9, 3.8), BARS + NOTE)
    for axes, reading in panels:
        draw_panel(axes, file, reading)
    widest = max(np.nanmax(np.abs(axes.dataLim.intervaly)) for axes, _ in panels)
    axes.set_ylim(-1.1 * widest, 1.35 * widest)
    return figure


def draw_panel(axes, file, reading):
    axes.axhline(0, color=GREY, linewidth=1, zorder=0)
    entries = {}
    stiffnesses = axis_values(file, "k_r")
    offsets = OFFSET * (np.arange(len(stiffnesses)) - (len(stiffnesses) - 1) / 2)
    for (k_r, look), offset in zip(looks(stiffnesses), offsets):
        colour = look.colour
        lattice = read_curve(file, VARIABLES[0], "seed", sampling="lattice", k_r=k_r, **reading)
        lattice = lattice._replace(x=lattice.x + offset)
        axes.errorbar(lattice.x, lattice.y, lattice.error, linestyle="", marker=look.marker, markersize=4.5, capsize=2,
                      linewidth=1.1, color=colour, label=with_symbol(dataset(file, "k_r"), k_r))
        entries |= draw_statuses(axes, lattice, colour)
        mean = read_curve(file, VARIABLES[0], "seed", sampling="quadrature", k_r=k_r, **reading)
        axes.axhspan(mean.y[0] - mean.error[0], mean.y[0] + mean.error[0], color=colour, alpha=0.3, linewidth=0)
        axes.axhline(mean.y[0], color=colour, linestyle=look.line, linewidth=0.8)
    axes.set_xticks(axis_values(file, "seed"))
    axes.set_xlabel("seed")
    axes.yaxis.set_major_locator(ticker.MaxNLocator(6, steps=[1, 2, 5, 10]))
    title_axis(axes, "y", dataset(file, VARIABLES[0]))
    legend(axes, entries, loc="upper right", ncol=3)
