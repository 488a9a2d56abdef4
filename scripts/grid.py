"""Quantities over two swept parameters, with the status of every point."""

from collections import namedtuple

import numpy as np

from style import attribute, dataset, fail, values

# log10 of the axes, and the status of each point as an index into `meanings`; 0 is a point without remark.
Grid = namedtuple("Grid", "x y status meanings axes")


def read_grid(file, x_name, y_name):
    x, y = (log_axis(dataset(file, name)) for name in (x_name, y_name))
    flags = dataset(file, "status")
    meanings = [word.replace("_", " ") for word in attribute(flags, "flag_meanings").split()]
    codes = np.atleast_1d(flags.attrs.get("flag_values", [])).tolist()
    if not codes or len(codes) != len(meanings):
        fail(f"{file.filename}: dataset '/status': attribute 'flag_values' has {len(codes)} "
             f"values for {len(meanings)} flag_meanings")
    numbers = oriented(flags, x_name, y_name)
    if not np.isin(numbers, codes).all():
        fail(f"{file.filename}: dataset '/status' has values that are not in its flag_values")
    status = np.vectorize(codes.index, otypes=[int])(numbers)
    return Grid(x, y, status, meanings, (x_name, y_name))


def log_axis(data):
    numbers = np.atleast_1d(values(data))
    place = f"{data.file.filename}: dataset '{data.name}'"
    if numbers.ndim != 1 or numbers.size < 2:
        fail(f"{place} has {numbers.size} value(s); a surface needs a sweep of at least "
             "2 values in each direction")
    if not (np.isfinite(numbers).all() and numbers[0] > 0 and (np.diff(numbers) > 0).all()):
        fail(f"{place} must be positive and increasing to be a logarithmic axis")
    return np.log10(numbers)


def oriented(data, x_name, y_name):
    """The values with axes (y, x), whatever the order of the sweep."""
    order = [scales[0].name.strip("/") if len(scales) else "(no scale)" for scales in data.dims]
    if sorted(order) != sorted((x_name, y_name)):
        fail(f"{data.file.filename}: dataset '{data.name}' is over ({', '.join(order)}); "
             f"this figure needs ({x_name}, {y_name})")
    numbers = values(data)
    return numbers if order == [y_name, x_name] else numbers.T
