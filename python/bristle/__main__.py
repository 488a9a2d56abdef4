"""Draws a figure from a result file: python3 -m bristle FIGURE RESULT.h5."""

import os
import sys

from .needs import FIGURES_NEED, here, remedy

os.environ["MPLBACKEND"] = "agg"  # for files alone, whatever a notebook or a shell has set
try:
    from .command_line import PROGRAM, draw_figure, run
except (ImportError, AttributeError, RuntimeError, ValueError) as error:  # of modules that are missing or do not fit together
    print(f"{os.environ.get('BRISTLE_PLOT', 'plot')}: error: {here()} cannot import what the figures need ({error}); "
          f"{remedy(FIGURES_NEED)}", file=sys.stderr)
    raise SystemExit(2) from None

run(draw_figure, PROGRAM)
