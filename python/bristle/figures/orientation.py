"""Magnitude and direction of the friction over mean and concentration of the undeformed azimuths."""

import numpy as np

from ..plotting.curves import curve_marks, draw_panels, title_axis, with_symbol
from ..plotting.readings import one_page
from ..plotting.style import GREY
from ..results import axis_values, dataset

AXES = ["concentration", "mean_deg"]
VARIABLES = ["R_norm", "direction"]


def MARKS(file):
    return f"{curve_marks(file, 'mean_deg')} Grey line, at 0: no force across the motion"


@one_page
def draw(file):
    concentrations = dataset(file, "concentration")
    curves = {with_symbol(concentrations, value): {"concentration": value}
              for value in axis_values(file, "concentration")}
    return draw_panels(file, VARIABLES, "mean_deg", curves, x_axis=title_axis, finish=finish)


def finish(axes, name):
    axes.set_xticks(np.arange(0, 181, 30))
    axes.set_xlim(-3, 183)
    if name == "direction":
        axes.axhline(0, color=GREY, linewidth=0.8, zorder=0)
