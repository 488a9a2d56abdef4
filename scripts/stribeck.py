"""The exponential Stribeck law beside Coulomb's: friction and its modulation by the speed."""

from curves import coloured, draw_curve, log_axis, read_curve
from panels import panels
from style import dataset, run
from sweep import NAMES as WORDS
from sweep import axis

NAMES = ["R_x_norm", "gamma_1"]


def draw(file):
    def draw_panel(axes, name):
        entries = {}
        curves = [(law, A) for A in axis(file, "A") for law in axis(file, "friction")]
        for (law, A), colour in coloured(curves):
            curve = read_curve(file, name, "k_r", friction=law, A=A)
            entries |= draw_curve(axes, curve, colour, f"{WORDS.get(law, law)}, $A$ = {A:g}")
        log_axis(axes, "x", dataset(file, "k_r"))
        return entries
    return panels(file, NAMES, draw_panel)


if __name__ == "__main__":
    run("stribeck", __doc__, ["friction", "A", "k_r", "status", *NAMES], draw)
