"""Figures and documents from result files of `bristle run`.

The scripts beside this package are command lines around it. In a notebook, with scripts/ on the path:

    import fig4
    from bristle_plots import apply_look, open_result
    apply_look()
    with open_result("results/fig4.h5") as file:
        figure = fig4.draw(file)

Whatever is wrong with a file raises BristleError.
"""

from .errors import BristleError
from .results import open_result
from .style import apply_look

__all__ = ["BristleError", "apply_look", "open_result"]
