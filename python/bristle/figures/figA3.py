"""Fig. A3: bristles in contact over the radial stiffness, lattice and quadrature, both friction laws."""

from ..plotting.curves import (BANDS, BARS, draw_curve, draw_points, label_line, legend, legend_below, log_axis,
                               panels_by_reading, read_curve, title_axis)
from ..plotting.page import paper_width
from ..plotting.readings import one_page
from ..plotting.style import GREY, looks
from ..results import CHOICE_NAMES, axis_values, dataset

AXES = ["friction", "sampling", "k_r"]
VARIABLES = ["N_c_ratio"]
MARKS = f"Lines: the mean over the azimuth by quadrature; open markers: lattices. {BANDS} {BARS} Grey line: as many bristles as rigid ones"


@one_page
def draw(file):
    figure, panels = panels_by_reading(file, (5.2, 3.6), (6.9, 3.8), f"{BANDS} {BARS}")
    for axes, reading in panels:
        entries = draw_panel(axes, file, reading)
    axes.set_ylim(bottom=min(0.97, axes.get_ylim()[0]))
    if paper_width() is not None:  # a small panel has no room for it
        legend_below(axes, entries, 0)
    else:
        low, high = axes.get_ylim()
        axes.set_ylim(top=high + 0.35 * (high - low))  # room for the legend
    return figure


def draw_panel(axes, file, reading):
    entries = {}
    for law, look in looks(axis_values(file, "friction")):
        means, lattice = (read_curve(file, VARIABLES[0], "k_r", friction=law, sampling=sampling, **reading)
                          for sampling in ("quadrature", "lattice"))
        name = CHOICE_NAMES.get(law, law)
        entries |= draw_curve(axes, means, look._replace(marker=""), f"{name}, quadrature")
        entries |= draw_points(axes, lattice, look.colour, f"{name}, lattice", look.marker, filled=False)
    axes.axhline(1, color=GREY, linewidth=1, zorder=0)
    log_axis(axes, "x", dataset(file, "k_r"))
    title_axis(axes, "y", dataset(file, VARIABLES[0]))
    label_line(axes, axis_values(file, "k_r")[0], 1.003, 0, r"$N_c = N_{c,0}$")
    if paper_width() is None:
        legend(axes, entries, loc="upper right")
    return entries
