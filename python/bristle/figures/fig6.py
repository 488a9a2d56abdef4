"""Fig. 6: friction and its causes over the radial and azimuthal stiffness (Coulomb friction)."""

from ..plotting.maps import draw_maps, marks
from ..plotting.readings import page_for_each_reading

AXES = ["friction", "k_r", "k_theta"]
VARIABLES = ["R_x_norm", "gamma_1", "gamma_2"]
CHOSEN = {"friction": "coulomb"}
MARKS = marks


@page_for_each_reading
def draw(file, reading):
    return draw_maps(file, VARIABLES, reading, CHOSEN,
                     "The maps are for Coulomb friction.")
