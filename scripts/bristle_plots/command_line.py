"""Command lines of the scripts: the only place where an error ends the program."""

import argparse
import os
import sys

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


def run_figure(script, description, draw, **further):
    """The command line of a figure's script: RESULT.h5 -o DIRECTORY, with draw(file) -> figure.

    further: functions that draw more figures of the same result, by the ending of their files' names.
    """
    name = os.path.splitext(os.path.basename(script))[0]

    def main():
        parser = argparse.ArgumentParser(description=description)
        parser.add_argument("result", metavar="RESULT.h5", help="result file of `bristle run`")
        parser.add_argument("-o", dest="directory", metavar="DIRECTORY", default="figures",
                            help=f"where to write {name}.pdf and {name}.png, and a PNG for each further page "
                                 "(default: %(default)s)")
        arguments = parser.parse_args()
        apply_look()
        with open_result(arguments.result) as file:
            for ending, function in {"": draw, **further}.items():
                save_pages(pages(function, file), arguments.directory, "-".join(filter(None, [name, ending])))

    run(main)
