"""Brushes of elastic bristles: results of the program `bristle` in Python, and their figures.

    from bristle import draw, open_result, run
    ds = run("paper.json", k_r=[5, 10, 20], friction="coulomb")  # computed by the program: an xarray Dataset
    figure = draw(open_result("results/fig4.h5"))  # a matplotlib Figure
    figure.savefig("fig4.pdf")

draw() also takes the Dataset of `xarray.open_dataset(PATH)`, or a part of it: `ds.sel(...)`. Whatever is wrong with a
file or a name raises BristleError. `python3 -m bristle fig4 RESULT.h5` draws as a command.

bristle.figures has a module for each figure, bristle.pages writes documents such as docs/findings.md, and bristle.report
the report; what figures share is in bristle.plotting.
"""

from .errors import BristleError, did_you_mean
from .needs import FIGURES_NEED, load, need

need(*FIGURES_NEED)

FUNCTIONS = {"draw": "figures", "open_result": "results", "run": "computing"}  # and their modules

__all__ = ["BristleError", *FUNCTIONS]


def __getattr__(name):
    """A function of FUNCTIONS, whose module is imported when it is first used: the plotting libraries take a second."""
    if name in FUNCTIONS:
        return getattr(load(f".{FUNCTIONS[name]}", __name__), name)
    raise AttributeError(f"module {__name__} has no {name}{did_you_mean(name, __all__)}")


def __dir__():
    return sorted({*globals(), *__all__})
