"""Orientation as a lever: magnitude and direction of the friction over the way in which the bristles lean."""

import numpy as np

from curves import coloured, draw_curve, number_axis, read_curve, with_symbol
from panels import panels
from style import GREY, dataset, run
from sweep import axis

NAMES = ["R_norm", "direction"]


def draw(file):
    def draw_panel(axes, name):
        entries = {}
        for value, colour in coloured(axis(file, "concentration")):
            curve = read_curve(file, name, "mean_deg", concentration=value)
            entries |= draw_curve(axes, curve, colour, with_symbol(dataset(file, "concentration"), value))
        axes.set_xticks(np.arange(0, 181, 30))
        axes.set_xlim(-3, 183)
        number_axis(axes, "x", dataset(file, "mean_deg"))
        if name == "direction":
            axes.axhline(0, color=GREY, linewidth=0.8, zorder=0)
        return entries
    return panels(file, NAMES, draw_panel)


if __name__ == "__main__":
    run("orientation", __doc__, ["concentration", "mean_deg", "status", *NAMES], draw)
