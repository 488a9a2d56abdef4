"""The lift-off load: bristles under a smaller load bounce, under a larger one they stay on the slab."""

import numpy as np

from ..results import dataset, values

LIFT_OFF = "lift_off_load"
PHASES = {"contact": "in contact", "mixed": "between contact and bouncing"}  # what figures call the words of the variable `phase`


def scatter(file):
    """The scatter of the formula of the lift-off load, relative to it."""
    load, error = (values(dataset(file, name)) for name in (LIFT_OFF, f"{LIFT_OFF}_err"))
    return float(np.max(error / load, initial=0, where=np.isfinite(load)))


def in_percent(share):
    return f"{100 * share:.2g} %"
