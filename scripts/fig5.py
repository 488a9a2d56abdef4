"""Fig. 5: bristles in contact, and friction, over the radial stiffness for several polar stiffnesses."""

from curves import BANDS, coloured, draw_curve, legend_below, log_axis, number_axis, read_curve, with_symbol
from page import heading, page, place
from style import attribute, dataset, run
from sweep import axis

NAMES = ["N_c_ratio", "R_x_norm"]
PANEL_INCHES = (4.1, 3.3)


def draw(file):
    figure, bottom = page(file, 10.6, PANEL_INCHES[1] + 1.45, BANDS)
    for i, name in enumerate(NAMES):
        axes = place(figure, 0.8 + 5.3 * i, bottom + 1, *PANEL_INCHES)
        entries = {}
        for value, colour in coloured(axis(file, "k_phi")):
            curve = read_curve(file, name, "k_r", k_phi=value)
            entries |= draw_curve(axes, curve, colour, with_symbol(dataset(file, "k_phi"), value))
        log_axis(axes, "x", dataset(file, "k_r"))
        number_axis(axes, "y", dataset(file, name))
        heading(axes, "ab"[i], attribute(dataset(file, name), "long_name"))
    legend_below(axes, entries, bottom + 0.15)
    return figure


if __name__ == "__main__":
    run("fig5", __doc__, ["k_phi", "k_r", "status", *NAMES], draw)
