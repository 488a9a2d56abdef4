"""The exponential Stribeck law beside Coulomb's: friction and its modulation by the speed."""

from curves import BANDS, coloured, draw_curve, legend_below, log_axis, number_axis, read_curve
from page import heading, page, place
from style import attribute, dataset, run
from sweep import NAMES as WORDS
from sweep import axis

NAMES = ["R_x_norm", "gamma_1"]
PANEL_INCHES = (4.1, 3.3)


def draw(file):
    figure, bottom = page(file, 10.6, PANEL_INCHES[1] + 1.45, BANDS)
    for i, name in enumerate(NAMES):
        axes = place(figure, 0.8 + 5.3 * i, bottom + 1, *PANEL_INCHES)
        entries = {}
        curves = [(law, A) for A in axis(file, "A") for law in axis(file, "friction")]
        for (law, A), colour in coloured(curves):
            curve = read_curve(file, name, "k_r", friction=law, A=A)
            entries |= draw_curve(axes, curve, colour, f"{WORDS.get(law, law)}, $A$ = {A:g}")
        log_axis(axes, "x", dataset(file, "k_r"))
        number_axis(axes, "y", dataset(file, name))
        heading(axes, "ab"[i], attribute(dataset(file, name), "long_name"))
    legend_below(axes, entries, bottom + 0.15)
    return figure


if __name__ == "__main__":
    run("stribeck", __doc__, ["friction", "A", "k_r", "status", *NAMES], draw)
