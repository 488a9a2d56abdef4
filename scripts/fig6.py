"""Fig. 6: friction and its causes over the radial and azimuthal stiffness (Amontons-Coulomb law)."""

from bristle_plots.command_line import run_figure
from bristle_plots.maps import draw_maps
from bristle_plots.readings import page_for_each_reading

VARIABLES = ["R_x_norm", "gamma_1", "gamma_2"]


@page_for_each_reading
def draw(file, reading):
    return draw_maps(file, VARIABLES, reading, {"friction": "coulomb"},
                     "The maps are for Amontons\u2013Coulomb friction.")


if __name__ == "__main__":
    run_figure(__file__, __doc__, draw)
