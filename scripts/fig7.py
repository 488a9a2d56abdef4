"""Fig. 7: friction and gap over the radial stiffness, under both local friction laws."""

from bristle_plots.command_line import run_figure
from bristle_plots.curves import draw_panels
from bristle_plots.results import CHOICE_NAMES, axis_values

VARIABLES = ["R_x_norm", "z_0"]


def draw(file):
    curves = {CHOICE_NAMES.get(law, law): {"friction": law} for law in axis_values(file, "friction")}
    return draw_panels(file, VARIABLES, "k_r", curves, markers="os^D",
                       finish=lambda axes, name: axes.set_ylim(0, 1))


if __name__ == "__main__":
    run_figure(__file__, __doc__, draw)
