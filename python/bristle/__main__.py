"""Draws a figure from a result file: python3 -m bristle FIGURE RESULT.h5."""

import os
import sys

from .needs import load

os.environ["MPLBACKEND"] = "agg"  # for files alone, whatever a notebook or a shell has set
try:
    command_line = load(".command_line", __package__)
except ImportError as error:
    print(f"{os.environ.get('BRISTLE_PLOT', 'plot')}: error: {error}", file=sys.stderr)
    raise SystemExit(2) from None

command_line.run(command_line.draw_figure, command_line.PROGRAM)
