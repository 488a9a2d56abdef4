"""The figures: each module draws one. draw(ds) takes the Dataset of a result and returns a matplotlib Figure.

FURTHER, where a module has it: functions that draw more figures of the same result, by the ending of their files' names.
"""

import importlib
import inspect
import os

from ..errors import BristleError, did_you_mean
from ..results import as_result, as_text

FIGURES = sorted(name.removesuffix(".py") for name in os.listdir(os.path.dirname(__file__))
                 if name.endswith(".py") and not name.startswith("_"))

OF_ANY_RESULT = ("curve", "map")  # figures of a variable of any result


def draw(result, figure=None, **options):
    """Draws a figure of a result, and returns a matplotlib Figure.

    result: a Dataset from run(...), open_result(PATH) or xarray.open_dataset(PATH), or a part of it.
    figure: one of bristle.figures.FIGURES; without a name, the figure of the result's experiment, or else "curve".
    options: of the figure: help(bristle.figures.module_of("fig4").draw) describes the options of fig4.
    Raises BristleError if something is wrong with a name, an option or the Dataset.
    """
    if figure is not None and not isinstance(figure, str):
        raise BristleError('the result comes first, and then the name of a figure: draw(result, "load")')
    found = module_of(figure or own_figure(as_text(as_result(result).attrs.get("name", ""))))
    known = list(inspect.signature(found.draw).parameters)[1:]
    for name in options:
        if name not in known:
            raise BristleError(f"{name} is not an option of this figure{did_you_mean(name, known)}; known: {', '.join(known)}")
    return found.draw(result, **options)


def module_of(name):
    """The module of a figure."""
    if name not in FIGURES:
        raise BristleError(f"there is no figure {name}{did_you_mean(name, FIGURES)}; known: {', '.join(FIGURES)}; "
                           f"{' and '.join(OF_ANY_RESULT)} draw a variable of any result")
    return importlib.import_module(f".{name}", __name__)


def own_figure(experiment):
    """The figure of an experiment of this name."""
    return experiment if experiment in FIGURES else "curve"
