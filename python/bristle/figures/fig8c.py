"""Fig. 8, continued: friction over the local friction under both local friction laws."""

from ..plotting.curves import curve_marks, draw_by_reading, with_symbol
from ..plotting.readings import one_page
from ..results import CHOICE_NAMES, axis_values, dataset

AXES = ["friction", "k_r", "nominal_friction"]
VARIABLES = ["R_x"]


def MARKS(file):
    return curve_marks(file, "nominal_friction")


@one_page
def draw(file):
    curves = {f"{CHOICE_NAMES.get(law, law)}, {with_symbol(dataset(file, 'k_r'), k_r)}": {"friction": law, "k_r": k_r}
              for law in axis_values(file, "friction") for k_r in axis_values(file, "k_r")}
    return draw_by_reading(file, VARIABLES[0], "nominal_friction", curves, loc="upper left")
