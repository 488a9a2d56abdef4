"""Fig. 6: friction and its causes over the radial and azimuthal stiffness (Amontons-Coulomb law)."""

from maps import draw_maps
from style import run

NAMES = ["R_x_norm", "gamma_1", "gamma_2"]


def draw(file):
    return draw_maps(file, NAMES, {"friction": "coulomb"}, "The maps are for Amontons\u2013Coulomb friction.")


if __name__ == "__main__":
    run("fig6", __doc__, ["friction", "k_r", "k_theta", "status", *NAMES], draw)
