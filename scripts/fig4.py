"""Fig. 4: friction and its three causes over the radial and azimuthal stiffness (NSS law)."""

from bristle_plots.command_line import run_figure
from bristle_plots.maps import draw_maps

VARIABLES = ["R_x_norm", "gamma_1", "gamma_2", "gamma_3"]


def draw(file):
    return draw_maps(file, VARIABLES)


if __name__ == "__main__":
    run_figure(__file__, __doc__, draw)
