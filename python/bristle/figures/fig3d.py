"""Fig. 3, the order of the gaps: gap over the radial stiffness under a low and a high load."""

from ..plotting.curves import curve_marks, draw_by_reading, with_symbol
from ..plotting.readings import one_page
from ..results import axis_values, dataset

AXES = ["R_n_target", "k_r"]
VARIABLES = ["z_0"]
MARKS = curve_marks


@one_page
def draw(file):
    loads = {with_symbol(dataset(file, AXES[0]), load): {AXES[0]: load} for load in axis_values(file, AXES[0])}
    return draw_by_reading(file, VARIABLES[0], "k_r", loads, loc="upper left")
