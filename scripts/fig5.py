"""Fig. 5: bristles in contact, and friction, over the radial stiffness for several polar stiffnesses."""

from bristle_plots.command_line import run_figure
from bristle_plots.curves import draw_panels, with_symbol
from bristle_plots.results import axis_values, dataset

VARIABLES = ["N_c_ratio", "R_x_norm"]


def draw(file):
    curves = {with_symbol(dataset(file, "k_phi"), value): {"k_phi": value} for value in axis_values(file, "k_phi")}
    return draw_panels(file, VARIABLES, "k_r", curves)


if __name__ == "__main__":
    run_figure(__file__, __doc__, draw)
