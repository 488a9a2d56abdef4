"""Fig. 5: bristles in contact, and friction, over the radial stiffness for several polar stiffnesses."""

from ..plotting.curves import curve_marks, draw_panels, with_symbol
from ..plotting.readings import one_page
from ..results import axis_values, dataset

AXES = ["k_phi", "k_r"]
VARIABLES = ["N_c_ratio", "R_x_norm"]
MARKS = curve_marks


@one_page
def draw(file):
    curves = {with_symbol(dataset(file, "k_phi"), value): {"k_phi": value} for value in axis_values(file, "k_phi")}
    return draw_panels(file, VARIABLES, "k_r", curves)
