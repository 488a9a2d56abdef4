"""Quantities over two swept parameters, with the status of every point."""

from collections import namedtuple

import numpy as np

from style import dataset, fail, values
from sweep import over, statuses, where

# log10 of the axes, and the status of each point as an index into `meanings`; 0 is a point without remark.
# chosen: the values of further axes that the quantities are taken at.
Grid = namedtuple("Grid", "x y status meanings axes chosen")


def read_grid(file, x_name, y_name, chosen=None):
    x, y = (log_axis(dataset(file, name)) for name in (x_name, y_name))
    meanings, status = statuses(file, [y_name, x_name], chosen)
    return Grid(x, y, status, meanings, (x_name, y_name), chosen)


def log_axis(data):
    numbers = np.atleast_1d(values(data))
    if numbers.ndim != 1 or numbers.size < 2:
        fail(f"{where(data)} has {numbers.size} value(s); a surface needs a sweep of at least "
             "2 values in each direction")
    if not (np.isfinite(numbers).all() and numbers[0] > 0 and (np.diff(numbers) > 0).all()):
        fail(f"{where(data)} must be positive and increasing to be a logarithmic axis")
    return np.log10(numbers)


def oriented(data, grid):
    """The values with axes (y, x), whatever the order of the sweep."""
    return over(data, grid.axes[::-1], grid.chosen)
