"""Orientation as a lever: magnitude and direction of the friction over the way in which the bristles lean."""

import numpy as np

from curves import BANDS, coloured, draw_curve, legend_below, number_axis, read_curve
from page import heading, page, place
from style import GREY, attribute, dataset, label, run
from sweep import axis

NAMES = ["R_norm", "direction"]
PANEL_INCHES = (4.1, 3.3)


def draw(file):
    figure, bottom = page(file, 10.6, PANEL_INCHES[1] + 1.45, BANDS)
    for i, name in enumerate(NAMES):
        axes = place(figure, 0.8 + 5.3 * i, bottom + 1, *PANEL_INCHES)
        entries = {}
        for value, colour in coloured(axis(file, "concentration")):
            curve = read_curve(file, name, "mean_deg", concentration=value)
            text = f"{label(dataset(file, 'concentration'))} = {value:g}"
            entries |= draw_curve(axes, curve, colour, text)
        axes.set_xticks(np.arange(0, 181, 30))
        axes.set_xlim(-3, 183)
        for which, data in (("x", "mean_deg"), ("y", name)):
            number_axis(axes, which, dataset(file, data))
        heading(axes, "ab"[i], attribute(dataset(file, name), "long_name"))
    axes.axhline(0, color=GREY, linewidth=0.8, zorder=0)
    legend_below(axes, entries, bottom + 0.15)
    return figure


if __name__ == "__main__":
    run("orientation", __doc__, ["concentration", "mean_deg", "status", *NAMES], draw)
