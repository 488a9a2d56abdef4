"""The models of bending with which a result was computed (the paper's two readings of Eq. (17), and the rod), and the
pages of a figure."""

import sys
from functools import wraps

from ..errors import BristleError, did_you_mean
from ..results import CHOICE_NAMES, as_result, axis_names, axis_values, dataset, place_of, readable, require_axes
from .page import drawn_on

AXIS = "bending"
HIGHEST = 10  # inches, of a figure in a paper

OPTIONS = """
file: a Dataset from open_result(PATH) or xarray.open_dataset(PATH), or a part of it.
plain: without title, notes and verdicts.
width: of the page of a paper, such as "3.5in", "89mm" or a number of inches; implies plain.
panels: letters of the panels to draw, such as "a,d"; those that are left have letters anew.
maps_only: maps without the surfaces above them.
cmap: of maps and surfaces, a name of matplotlib or a Colormap; without it viridis.
style: matplotlib's rcParams, which replace the look's, for what the figure does not set itself.

Returns a matplotlib Figure; raises BristleError if something is wrong with the Dataset or an option.
"""
READING = """
reading: the model of bending, "polar" (corrected), "polar_as_printed" or "rod"; without it, the {which} one of the
Dataset.
"""


def readings(file):
    """The choice of each reading, as `select` and its like take it; one empty choice if the file has no such axis."""
    if AXIS not in axis_names(dataset(file, "status")):
        return [{}]
    return [{AXIS: word} for word in axis_values(file, AXIS)]


def reading_name(reading):
    """A choice of `readings` in words."""
    return "".join(CHOICE_NAMES.get(word, readable(word)) for word in reading.values())


def chosen_reading(file, reading):
    """The choice of `readings` for a user's word or choice."""
    found = [choice for choice in readings(file) if reading in (choice, *choice.values())]
    if not found:
        words = [word for choice in readings(file) for word in choice.values()]
        raise BristleError(f"{place_of(file)}: no reading {reading!r}{did_you_mean(str(reading), words)}; "
                           f"it has: {', '.join(words) or 'one, without a name'}")
    return found[0]


def of_reading(file, word):
    """The part of the Dataset with one reading."""
    return file.sel({axis: [value] for axis, value in chosen_reading(file, word).items()})


def checked(draw, ds):
    """The Dataset as a result with the axes that the figure needs."""
    file, module = as_result(ds), sys.modules[draw.__module__]
    require_axes(file, draw.__module__.rpartition(".")[2], module.AXES)
    return file


def documented(drawn, draw, options):
    """Gives the function the name of `draw` and a text on its options, but not its signature."""
    wraps(draw)(drawn)
    del drawn.__wrapped__
    drawn.__doc__ = f"{draw.__doc__ or sys.modules[draw.__module__].__doc__}\n{options}"
    return drawn


def with_panels(figure, panels, maps_only):
    """The figure, which must have what was asked for."""
    if panels and not any(hasattr(axes, "panel") for axes in figure.axes):
        raise BristleError(f"panels {panels}: this figure has no panels with letters")
    if maps_only and not hasattr(figure, "maps"):
        raise BristleError("maps only: this figure has no surfaces")
    return figure


def one_page(draw):
    """Makes draw(file) a function of any Dataset of a result, and of the options of `drawn_on`."""
    def drawn(file, *, plain=False, width=None, panels=None, maps_only=False, cmap=None, style=None):
        with drawn_on(plain, width, panels, maps_only, cmap, style):
            return with_panels(draw(checked(draw, file)), panels, maps_only)

    return documented(drawn, draw, OPTIONS.lstrip())


def page_for_each_reading(draw):
    """The same for draw(file, reading): without a reading it draws the first one."""
    return of_readings(draw, readings, "first")


def page_as_printed(draw):
    """The same, but only Eq. (17) as printed has a page, and is drawn without a reading; where it was not computed, the
    last reading."""
    def shown(file):
        return [choice for choice in readings(file) if choice.get(AXIS) == "polar_as_printed"] or readings(file)[-1:]

    return of_readings(draw, shown, "printed")


def of_readings(draw, shown, which):
    def drawn(file, reading=None, *, plain=False, width=None, panels=None, maps_only=False, cmap=None, style=None):
        with drawn_on(plain, width, panels, maps_only, cmap, style):
            file = checked(draw, file)
            choice = shown(file)[0] if reading is None else chosen_reading(file, reading)
            return with_panels(draw(file, choice), panels, maps_only)

    drawn = documented(drawn, draw, READING.strip().format(which=which) + OPTIONS)
    drawn.shown = shown
    return drawn


def pages(draw, file, **options):
    """(ending of the file's name, the reading, figure) of each page; the ending of the first reading is empty.

    A figure of all readings that is too high for a paper has a page for each of them, too, unless its panels are chosen.
    """
    first = readings(file)[0]

    def page(reading, figure):
        return "" if reading == first else "-" + reading[AXIS].replace("_", "-"), reading, figure

    if hasattr(draw, "shown"):
        return [page(reading, draw(file, reading, **options)) for reading in draw.shown(file)]
    figure = draw(file, **options)
    if options.get("width") is None or options.get("panels") or figure.get_figheight() < HIGHEST or first == {}:
        return [("", {}, figure)]
    return [page(reading, draw(of_reading(file, reading), **options)) for reading in readings(file)]
