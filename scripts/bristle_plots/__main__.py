"""Draws a figure from a result file: python3 -m bristle_plots FIGURE RESULT.h5."""

import os
import sys

os.environ["MPLBACKEND"] = "agg"  # for files alone, whatever a notebook or a shell has set
try:
    from .command_line import PROGRAM, draw_figure, run
except (ImportError, AttributeError, RuntimeError, ValueError) as error:  # of modules that are missing or do not fit together
    print(f"{os.environ.get('BRISTLE_PLOT', 'plot')}: error: {sys.executable} cannot import what the figures need ({error}); "
          "on Debian, the packages are python3-h5py python3-matplotlib python3-xarray python3-h5netcdf, and "
          "`scripts/plot` looks for a python3 that has them", file=sys.stderr)
    raise SystemExit(2) from None

run(draw_figure, PROGRAM)
