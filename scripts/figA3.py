"""Fig. A3: bristles in contact over the radial stiffness, lattice and quadrature, both friction laws."""

from curves import BANDS, BARS, draw_curve, draw_points, label_line, legend, log_axis, number_axis, read_curve
from page import page, place
from style import COLOURS, GREY, dataset, run
from sweep import NAMES as WORDS
from sweep import axis

NAME = "N_c_ratio"


def draw(file):
    figure, bottom = page(file, 8.2, 4.6, f"{BANDS} {BARS}")
    axes = place(figure, 0.9, bottom + 0.65, 6.9, 3.8)
    entries = {}
    for law, colour, marker in zip(axis(file, "friction"), COLOURS, "os^D"):
        means, lattice = (read_curve(file, NAME, "k_r", friction=law, sampling=sampling)
                          for sampling in ("quadrature", "lattice"))
        entries |= draw_curve(axes, means, colour, f"{WORDS.get(law, law)}, quadrature", marker="")
        entries |= draw_points(axes, lattice, colour, f"{WORDS.get(law, law)}, lattice", marker, filled=False)
    axes.axhline(1, color=GREY, linewidth=1, zorder=0)
    log_axis(axes, "x", dataset(file, "k_r"))
    number_axis(axes, "y", dataset(file, NAME))
    axes.set_ylim(bottom=min(0.97, axes.get_ylim()[0]))
    label_line(axes, axis(file, "k_r")[0], 1.003, 0, r"$N_c = N_0$")
    legend(axes, entries, loc="upper right")
    return figure


if __name__ == "__main__":
    run("figA3", __doc__, ["friction", "sampling", "k_r", "status", NAME], draw)
