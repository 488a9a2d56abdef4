"""The readings of Eq. (17) under which a result was computed, and the pages of a figure."""

from functools import wraps

import numpy as np

from .results import CHOICE_NAMES, axis_index, axis_names, axis_values, dataset, readable

AXIS = "azimuth_rate"


def readings(file):
    """The choice of each reading, as `select` and its like take it; one empty choice if the file has no such axis."""
    if AXIS not in axis_names(dataset(file, "status")):
        return [{}]
    return [{AXIS: word} for word in axis_values(file, AXIS)]


def reading_name(reading):
    """A choice of `readings` in words."""
    return "".join(CHOICE_NAMES.get(word, readable(word)) for word in reading.values())


def points_of(file, reading):
    """Indices of the points of the sweep under this reading."""
    status = dataset(file, "status")
    points = np.arange(status.size).reshape(status.shape)
    for name, word in reading.items():
        points = np.take(points, axis_index(file, name, word), axis_names(status).index(name))
    return np.ravel(points)


def page_for_each_reading(draw):
    """Makes draw(file, reading) a function of the file alone, too: it draws the first reading."""
    @wraps(draw)
    def drawn(file, reading=None):
        return draw(file, readings(file)[0] if reading is None else reading)

    drawn.has_pages = True
    return drawn


def pages(draw, file):
    """(ending of the file's name, name of the reading, figure) of each page; the first page's ending is empty."""
    if not getattr(draw, "has_pages", False):
        return [("", "", draw(file))]
    return [("-" + reading[AXIS].replace("_", "-") if i else "", reading_name(reading), draw(file, reading))
            for i, reading in enumerate(readings(file))]
