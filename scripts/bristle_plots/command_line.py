"""Command lines: the only place where an error ends the program."""

import argparse
import importlib
import os
import sys

from . import FIGURES
from .errors import BristleError
from .files import save_pages
from .readings import pages
from .results import open_result
from .style import apply_look


def run(main):
    """Calls main(); an error becomes one line on stderr and the exit code (2: wrong input, 3: not written)."""
    try:
        main()
    except BristleError as error:
        print(f"{os.path.basename(sys.argv[0])}: error: {error}", file=sys.stderr)
        raise SystemExit(error.exit_code) from None


def draw_figure():
    """FIGURE RESULT.h5 -o DIRECTORY: all pages of a figure, and its further figures."""
    parser = argparse.ArgumentParser(prog="plot", description="Draws a figure from a result file.")
    parser.add_argument("figure", metavar="FIGURE", choices=FIGURES, help=", ".join(FIGURES))
    parser.add_argument("result", metavar="RESULT.h5", help="result file of `bristle run`")
    parser.add_argument("-o", dest="directory", metavar="DIRECTORY", default="figures",
                        help="where to write FIGURE.pdf and FIGURE.png, and a PNG for each further page "
                             "(default: %(default)s)")
    arguments = parser.parse_args()
    apply_look()
    module = importlib.import_module(f".figures.{arguments.figure}", __package__)
    with open_result(arguments.result) as file:
        for ending, function in {"": module.draw, **getattr(module, "FURTHER", {})}.items():
            save_pages(pages(function, file), arguments.directory, "-".join(filter(None, [arguments.figure, ending])))
