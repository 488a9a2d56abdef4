"""Command lines of the scripts: the only place where an error ends the program."""

import argparse
import os
import sys

from .errors import BristleError
from .files import save_figure
from .results import open_result
from .style import apply_look


def run(main):
    """Calls main(); an error becomes one line on stderr and the exit code (2: wrong input, 3: not written)."""
    try:
        main()
    except BristleError as error:
        print(f"{os.path.basename(sys.argv[0])}: error: {error}", file=sys.stderr)
        raise SystemExit(error.exit_code) from None


def run_figure(script, description, draw):
    """The command line of a figure's script: RESULT.h5 -o DIRECTORY, with draw(file) -> figure."""
    name = os.path.splitext(os.path.basename(script))[0]

    def main():
        parser = argparse.ArgumentParser(description=description)
        parser.add_argument("result", metavar="RESULT.h5", help="result file of `bristle run`")
        parser.add_argument("-o", dest="directory", metavar="DIRECTORY", default="figures",
                            help=f"where to write {name}.pdf and {name}.png (default: %(default)s)")
        arguments = parser.parse_args()
        apply_look()
        with open_result(arguments.result) as file:
            save_figure(draw(file), arguments.directory, name)

    run(main)
