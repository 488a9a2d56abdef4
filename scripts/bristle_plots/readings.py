"""The readings of Eq. (17) under which a result was computed, and the pages of a figure."""

from functools import wraps

from .page import drawn_on
from .results import CHOICE_NAMES, as_result, axis_names, axis_values, dataset, readable

AXIS = "azimuth_rate"


def readings(file):
    """The choice of each reading, as `select` and its like take it; one empty choice if the file has no such axis."""
    if AXIS not in axis_names(dataset(file, "status")):
        return [{}]
    return [{AXIS: word} for word in axis_values(file, AXIS)]


def reading_name(reading):
    """A choice of `readings` in words."""
    return "".join(CHOICE_NAMES.get(word, readable(word)) for word in reading.values())


def one_page(draw):
    """Makes draw(file) a function of any Dataset of a result, and of the options of `drawn_on`."""
    @wraps(draw)
    def drawn(ds, **options):
        with drawn_on(**options):
            return draw(as_result(ds))

    return drawn


def page_for_each_reading(draw):
    """The same for draw(file, reading): without a reading it draws the first one."""
    @wraps(draw)
    def drawn(ds, reading=None, **options):
        with drawn_on(**options):
            file = as_result(ds)
            return draw(file, readings(file)[0] if reading is None else reading)

    drawn.has_pages = True
    return drawn


def pages(draw, file, **options):
    """(ending of the file's name, name of the reading, figure) of each page; the first page's ending is empty."""
    if not getattr(draw, "has_pages", False):
        return [("", "", draw(file, **options))]
    return [("-" + reading[AXIS].replace("_", "-") if i else "", reading_name(reading), draw(file, reading, **options))
            for i, reading in enumerate(readings(file))]
