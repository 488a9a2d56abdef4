"""A variable of any result over its longest numeric axis, a line for each value of the other axes."""

from itertools import product

import numpy as np

from ..errors import BristleError
from ..plotting.curves import BANDS, LINES, draw_panels, in_words, log_axis, title_axis
from ..plotting.page import drawn_on
from ..plotting.readings import AXIS, OPTIONS, with_panels
from ..plotting.style import with_displayed
from ..results import as_result, axis_names, axis_values, dataset, place_of, values

AXES = []
MARKS = f"{LINES} {BANDS}"
MOST = 7  # lines; of more, some are drawn


def draw(file, y="R_x_norm", *, plain=True, width=None, panels=None, maps_only=False, cmap=None, style=None):
    """Always as for a paper, 7 inches wide unless there is a width: a single panel has no room for the verdicts."""
    with drawn_on(plain, 7 if width is None else width, panels, maps_only, cmap, style):
        return with_panels(draw_variable(as_result(file), y), panels, maps_only)


draw.__doc__ = f"{__doc__}\n\n{draw.__doc__}\ny: the variable, for example \"gamma_1\".{OPTIONS}"


def draw_variable(file, name):
    axes = {axis: axis_values(file, axis) for axis in axis_names(dataset(file, name)) if axis != AXIS}
    numeric = [axis for axis, line in axes.items() if len(line) > 1 and not isinstance(line[0], str)]
    if not numeric or values(dataset(file, name)).dtype.kind != "f":
        raise BristleError(f"{place_of(dataset(file, name))}: a curve needs a variable with numbers over an axis with "
                           "at least 2 numbers")
    along = max(numeric, key=lambda axis: len(axes[axis]))
    others = {axis: line for axis, line in axes.items() if axis != along}
    choices = [dict(zip(others, chosen)) for chosen in product(*others.values())]
    shown = np.unique(np.linspace(0, len(choices) - 1, min(MOST, len(choices))).round().astype(int))
    curves = {in_words(file, choices[i]): choices[i] for i in shown}
    line = np.asarray(axes[along], dtype=float)
    equal_steps = np.ptp(np.diff(line)) < 1e-6 * np.ptp(line)
    log = (line > 0).all() and line.max() >= 10 * line.min() and not equal_steps
    return draw_panels(with_displayed(file, name), [name], along, curves, x_axis=log_axis if log else title_axis)
