"""Fig. A3: bristles in contact over the radial stiffness, lattice and quadrature, both friction laws."""

from bristle_plots.command_line import run_figure
from bristle_plots.curves import (BANDS, BARS, draw_curve, draw_points, label_line, legend, log_axis, read_curve,
                                  title_axis)
from bristle_plots.layout import place, sheet
from bristle_plots.results import CHOICE_NAMES, axis_values, dataset
from bristle_plots.style import COLOURS, GREY

VARIABLES = ["N_c_ratio"]


def draw(file):
    figure, bottom = sheet(file, 8.2, 4.6, f"{BANDS} {BARS}")
    axes = place(figure, 0.9, bottom + 0.65, 6.9, 3.8)
    entries = {}
    for law, colour, marker in zip(axis_values(file, "friction"), COLOURS, "os^D"):
        means, lattice = (read_curve(file, VARIABLES[0], "k_r", friction=law, sampling=sampling)
                          for sampling in ("quadrature", "lattice"))
        name = CHOICE_NAMES.get(law, law)
        entries |= draw_curve(axes, means, colour, f"{name}, quadrature", marker="")
        entries |= draw_points(axes, lattice, colour, f"{name}, lattice", marker, filled=False)
    axes.axhline(1, color=GREY, linewidth=1, zorder=0)
    log_axis(axes, "x", dataset(file, "k_r"))
    title_axis(axes, "y", dataset(file, VARIABLES[0]))
    axes.set_ylim(bottom=min(0.97, axes.get_ylim()[0]))
    label_line(axes, axis_values(file, "k_r")[0], 1.003, 0, r"$N_c = N_0$")
    legend(axes, entries, loc="upper right")
    return figure


if __name__ == "__main__":
    run_figure(__file__, __doc__, draw)
