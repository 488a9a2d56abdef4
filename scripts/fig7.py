"""Fig. 7: friction and gap over the radial stiffness, under both local friction laws."""

from curves import BANDS, draw_curve, legend_below, log_axis, number_axis, read_curve
from page import heading, page, place
from style import COLOURS, attribute, dataset, run
from sweep import NAMES as WORDS
from sweep import axis

NAMES = ["R_x_norm", "z_0"]
PANEL_INCHES = (4.1, 3.3)


def draw(file):
    figure, bottom = page(file, 10.6, PANEL_INCHES[1] + 1.45, BANDS)
    for i, name in enumerate(NAMES):
        axes = place(figure, 0.8 + 5.3 * i, bottom + 1, *PANEL_INCHES)
        entries = {}
        for law, colour, marker in zip(axis(file, "friction"), COLOURS, "os^D"):
            curve = read_curve(file, name, "k_r", friction=law)
            entries |= draw_curve(axes, curve, colour, WORDS.get(law, law), marker=marker)
        log_axis(axes, "x", dataset(file, "k_r"))
        number_axis(axes, "y", dataset(file, name))
        axes.set_ylim(0, 1)
        heading(axes, "ab"[i], attribute(dataset(file, name), "long_name"))
    legend_below(axes, entries, bottom + 0.15)
    return figure


if __name__ == "__main__":
    run("fig7", __doc__, ["friction", "k_r", "status", *NAMES], draw)
