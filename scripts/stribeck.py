"""The exponential Stribeck law beside Coulomb's: friction and its modulation by the speed."""

from bristle_plots.command_line import run_figure
from bristle_plots.curves import draw_panels
from bristle_plots.results import CHOICE_NAMES, axis_values

VARIABLES = ["R_x_norm", "gamma_1"]


def draw(file):
    curves = {f"{CHOICE_NAMES.get(law, law)}, $A$ = {A:g}": {"friction": law, "A": A}
              for A in axis_values(file, "A") for law in axis_values(file, "friction")}
    return draw_panels(file, VARIABLES, "k_r", curves)


if __name__ == "__main__":
    run_figure(__file__, __doc__, draw)
