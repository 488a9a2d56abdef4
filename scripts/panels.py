"""Quantities side by side over one axis, with one legend below."""

from curves import BANDS, legend_below, number_axis
from page import heading, page, place
from style import attribute, dataset

PANEL_INCHES = (4.1, 3.3)


def panels(file, names, draw_panel):
    """A figure with one panel for each quantity; draw_panel(axes, name) draws the lines and the lower axis, and
    returns the legend's entries for the statuses."""
    figure, bottom = page(file, 5.3 * len(names), PANEL_INCHES[1] + 1.45, BANDS)
    for i, name in enumerate(names):
        axes = place(figure, 0.8 + 5.3 * i, bottom + 1, *PANEL_INCHES)
        entries = draw_panel(axes, name)
        number_axis(axes, "y", dataset(file, name))
        heading(axes, "abcd"[i], attribute(dataset(file, name), "long_name"))
    legend_below(axes, entries, bottom + 0.15)
    return figure
