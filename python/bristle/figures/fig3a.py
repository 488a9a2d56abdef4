"""Fig. 3, first contact: load over the radial stiffness at gaps just below first contact."""

from ..plotting.curves import curve_marks, draw_by_reading, with_symbol
from ..plotting.readings import one_page
from ..results import axis_values, dataset

AXES = ["z_0_target", "k_r"]
VARIABLES = ["R_n"]
MARKS = curve_marks


@one_page
def draw(file):
    gaps = {with_symbol(dataset(file, AXES[0]), gap): {AXES[0]: gap} for gap in axis_values(file, AXES[0])}
    return draw_by_reading(file, VARIABLES[0], "k_r", gaps, loc="upper left")
