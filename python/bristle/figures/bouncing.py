"""Bouncing that lasts: the share of time off the slab over the slab's length, with and without damping."""

from ..plotting.curves import curve_marks, draw_by_reading, with_symbol
from ..plotting.readings import one_page
from ..results import axis_values, dataset

AXES = ["sample", "z_0_target", "L_x"]
VARIABLES = ["off_slab_share"]
MARKS = curve_marks


@one_page
def draw(file):
    damping = {sample: float(dataset(file, "zeta_phi").sel(sample=sample)) for sample in axis_values(file, "sample")}
    curves = {f"$\\zeta$ = {zeta:g}, {with_symbol(dataset(file, AXES[1]), gap)}": {"sample": sample, AXES[1]: gap}
              for sample, zeta in damping.items() for gap in axis_values(file, AXES[1])}
    return draw_by_reading(file, VARIABLES[0], "L_x", curves, loc="upper left")
