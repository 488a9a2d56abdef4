"""Figures and documents from result files of `bristle run`.

    from bristle_plots import fig4, open_result
    figure = fig4.draw(open_result("results/fig4.h5"))  # a matplotlib Figure
    figure.savefig("fig4.pdf")

run() computes a result by the program (bristle_plots/computing.py):

    from bristle_plots import run
    ds = run("paper.json", k_r=[5, 10, 20], friction="coulomb")  # an xarray Dataset

draw() also takes the Dataset of `xarray.open_dataset(PATH)`, or a part of it: `ds.sel(...)`. Whatever is wrong with a
file raises BristleError. `python3 -m bristle_plots fig4 RESULT.h5` is the same as a command.
"""

import importlib
import os

from .errors import BristleError

FIGURES = sorted(name.removesuffix(".py") for name in os.listdir(os.path.join(os.path.dirname(__file__), "figures"))
                 if name.endswith(".py") and not name.startswith("_"))

FUNCTIONS = {"apply_look": "style", "open_result": "results", "pages": "readings", "run": "computing"}  # and their modules

# Without map, which would hide Python's own.
__all__ = ["BristleError", "FIGURES", "apply_look", "open_result", "pages", "run",
           *(name for name in FIGURES if name != "map")]


def __getattr__(name):
    """A function, or the module of a figure, imported when it is first used, so that a message can say what is missing."""
    if name in FUNCTIONS:
        return getattr(importlib.import_module(f".{FUNCTIONS[name]}", __name__), name)
    if name in FIGURES:
        return importlib.import_module(f".figures.{name}", __name__)
    raise AttributeError(f"module {__name__} has no attribute {name}")
