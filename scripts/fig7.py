"""Fig. 7: friction and gap over the radial stiffness, under both local friction laws."""

from curves import draw_curve, log_axis, read_curve
from panels import panels
from style import COLOURS, dataset, run
from sweep import NAMES as WORDS
from sweep import axis

NAMES = ["R_x_norm", "z_0"]


def draw(file):
    def draw_panel(axes, name):
        entries = {}
        for law, colour, marker in zip(axis(file, "friction"), COLOURS, "os^D"):
            curve = read_curve(file, name, "k_r", friction=law)
            entries |= draw_curve(axes, curve, colour, WORDS.get(law, law), marker=marker)
        log_axis(axes, "x", dataset(file, "k_r"))
        axes.set_ylim(0, 1)
        return entries
    return panels(file, NAMES, draw_panel)


if __name__ == "__main__":
    run("fig7", __doc__, ["friction", "k_r", "status", *NAMES], draw)
