"""Fig. 5: bristles in contact, and friction, over the radial stiffness for several polar stiffnesses."""

from curves import coloured, draw_curve, log_axis, read_curve, with_symbol
from panels import panels
from style import dataset, run
from sweep import axis

NAMES = ["N_c_ratio", "R_x_norm"]


def draw(file):
    def draw_panel(axes, name):
        entries = {}
        for value, colour in coloured(axis(file, "k_phi")):
            curve = read_curve(file, name, "k_r", k_phi=value)
            entries |= draw_curve(axes, curve, colour, with_symbol(dataset(file, "k_phi"), value))
        log_axis(axes, "x", dataset(file, "k_r"))
        return entries
    return panels(file, NAMES, draw_panel)


if __name__ == "__main__":
    run("fig5", __doc__, ["k_phi", "k_r", "status", *NAMES], draw)
