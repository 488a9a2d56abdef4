"""Fig. 4: friction and its three causes over the radial and azimuthal stiffness (NSS law)."""

import numpy as np

from ..plotting.maps import draw_log_map, draw_maps, jump_marks, marks
from ..plotting.readings import page_for_each_reading, page_as_printed, reading_name, readings
from ..results import dataset, select

AXES = ["k_r", "k_theta"]
VARIABLES = ["R_x_norm", "gamma_1", "gamma_2", "gamma_3"]
TITLES = {"energy": "Figure 4, continued: the defect of the energy budget"}
ENERGY = ("Colours: defect of the energy budget, relative to the energy dissipated or the initial one. "
          "Where the budget closes, only the error of the integration is left.")


@page_for_each_reading
def draw(file, reading):
    return draw_maps(file, VARIABLES, reading)


@page_as_printed
def draw_energy(file, shown):
    """The defect of the energy budget, as printed if it was computed."""
    others = [reading for reading in readings(file) if reading != shown]
    found = [f"{reading_name(reading)}: the budget closes to within {largest_defect(file, reading):.1g}."
             for reading in others]
    return draw_log_map(file, "energy_residual", shown, "\n".join([ENERGY, *found]), TITLES["energy"])


def largest_defect(file, reading):
    return np.nanmax(np.abs(select(dataset(file, "energy_residual"), ["k_r", "k_theta"], **reading)))


FURTHER = {"energy": draw_energy}
MARKS = {"": marks, "energy": lambda file: f"{ENERGY} {jump_marks(file)}"}
