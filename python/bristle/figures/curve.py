"""A variable of any result over its longest numeric axis, a line for each value of the other axes."""

from itertools import product

import numpy as np
import xarray

from ..errors import BristleError
from ..plotting.curves import BANDS, LINES, draw_panels, in_words, log_axis, title_axis
from ..plotting.page import drawn_on
from ..plotting.readings import AXIS, OPTIONS, with_panels
from ..plotting.style import with_displayed
from ..results import as_result, as_text, axis_names, axis_values, dataset, place_of, values

AXES = []
MARKS = f"{LINES} {BANDS}"
MOST = 7  # lines; of more, some are drawn
OVERLAID = "result"  # the axis of several results


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


def overlaid(files, labels, name):
    """The variable of several results over the same axes as one Dataset, with an axis of the results' labels."""
    first = as_result(files[0])
    axes = {axis: axis_values(first, axis) for axis in axis_names(dataset(first, name))}
    parts = []
    for file in map(as_result, files):
        here = {axis: axis_values(file, axis) for axis in axis_names(dataset(file, name))}
        if list(here) != list(axes):
            raise BristleError(f"{place_of(file)} is over {', '.join(here) or 'no axis'}, and {place_of(first)} over "
                               f"{', '.join(axes) or 'no axis'}; one picture needs results over the same axes")
        for axis in axes:
            if not np.array_equal(here[axis], axes[axis]):
                raise BristleError(f"{place_of(file)}: axis {axis} has other values than in {place_of(first)}; one picture needs "
                                   "results over the same axes")
        for flag in ("status", "phase"):
            if flag in file and as_text(file[flag].attrs["flag_meanings"]) != as_text(first[flag].attrs["flag_meanings"]):
                raise BristleError(f"{place_of(file)}: {flag} has other words than in {place_of(first)}; compute one again")
        parts.append(file)
    shared = [key for key in (name, f"{name}_err", "status", "phase", "z_0") if all(key in file for file in parts)]
    return xarray.concat([file[shared] for file in parts], xarray.DataArray(labels, dims=OVERLAID, name=OVERLAID), coords="minimal",
                         compat="override", combine_attrs="override", join="override")
