"""Fig. 4: friction and its three causes over the radial and azimuthal stiffness (NSS law)."""

from maps import draw_maps
from style import run

NAMES = ["R_x_norm", "gamma_1", "gamma_2", "gamma_3"]


def draw(file):
    return draw_maps(file, NAMES)


if __name__ == "__main__":
    run("fig4", __doc__, ["k_r", "k_theta", "status", *NAMES], draw)
