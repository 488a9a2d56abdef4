"""The exponential Stribeck law beside Coulomb's: friction and its modulation by the speed."""

from ..plotting.curves import curve_marks, draw_panels
from ..plotting.readings import one_page
from ..results import CHOICE_NAMES, axis_values

AXES = ["friction", "A", "k_r"]
VARIABLES = ["R_x_norm", "gamma_1"]
MARKS = curve_marks


@one_page
def draw(file):
    curves = {f"{CHOICE_NAMES.get(law, law.capitalize())}, $A$ = {A:g}": {"friction": law, "A": A}
              for A in axis_values(file, "A") for law in axis_values(file, "friction")}
    return draw_panels(file, VARIABLES, "k_r", curves)
