"""Friction and gap over the radial stiffness after loading and after unloading: two branches, and where both exist."""

import numpy as np

from ..plotting.curves import curve_marks, draw_panels
from ..plotting.readings import one_page, reading_name, readings
from ..results import axis_values, dataset, select

AXES = ["path", "k_r"]
VARIABLES = ["R_x_norm", "z_0"]
MARKS = curve_marks
APART = 1.5  # factor between the frictions of two branches


@one_page
def draw(file):
    curves = {f"after {path}": {"path": path} for path in axis_values(file, "path")}
    windows = "\n".join(window(file, reading) for reading in readings(file))
    return draw_panels(file, VARIABLES, "k_r", curves, note=windows)


def windows(file, reading, k_r_text="$k_r$"):
    """A text for each range of k_r in which the friction depends on the path: by which factor, and where."""
    k_r = axis_values(file, "k_r")
    loading, unloading = (select(dataset(file, "R_x_norm"), ["k_r"], path=path, **reading) for path in ("loading", "unloading"))
    with np.errstate(invalid="ignore", divide="ignore"):
        factor = unloading / loading
    apart = np.flatnonzero(factor >= APART)
    windows = [at for at in np.split(apart, np.flatnonzero(np.diff(apart) > 1) + 1) if at.size]
    return [f"by a factor of {factor[at].min():.2g} to {factor[at].max():.2g} from {k_r_text} = {k_r[at[0]]:.3g} to {k_r[at[-1]]:.3g}"
            if at.size > 1 else f"by a factor of {factor[at[0]]:.2g} at {k_r_text} = {k_r[at[0]]:.3g}" for at in windows]


def window(file, reading):
    """A sentence on the windows."""
    name = f"{reading_name(reading)}: " if reading else ""
    if found := windows(file, reading):
        return f"{name}the friction after unloading is larger than after loading {' and '.join(found)}."
    return f"{name}the friction is the same after loading and after unloading, within a factor of {APART}."
