"""Draws a figure from a result file: python3 -m bristle_plots FIGURE RESULT.h5."""

from .command_line import PROGRAM, draw_figure, run

run(draw_figure, PROGRAM)
