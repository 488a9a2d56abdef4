"""Quantities over one axis of the sweep: lines with error bands, points with error bars, panels."""

from collections import namedtuple
from itertools import cycle

import numpy as np
from matplotlib import ticker
from matplotlib.lines import Line2D

from .errors import BristleError
from .layout import heading, place, sheet
from .results import (attribute, axis_values, dataset, place_of, readable, select, select_errors, select_flags,
                      values)
from .style import COLOURS, GREY, label, log_ticks, status_marker

# status: index of each point's status into `meanings`; 0 is a point without remark.
Curve = namedtuple("Curve", "x y error status meanings")

BANDS = "Bands, often thinner than the lines, are the estimated errors of the values."
BARS = "Bars are the standard errors of the lattices' time means."
PANEL_INCHES = (4.1, 3.3)


def read_curve(file, name, along, **chosen):
    """A variable along one axis, at the chosen values of the others."""
    y = select(dataset(file, name), [along], **chosen)
    meanings, status = select_flags(file, "status", [along], **chosen)
    return Curve(axis_values(file, along), y, select_errors(file, name, [along], **chosen), status, meanings)


def draw_curve(axes, curve, colour, text=None, line="-", marker="o"):
    """A line, interrupted where there is no value; returns legend entries for the statuses by text."""
    axes.plot(curve.x, curve.y, line, color=colour, linewidth=1.6, marker=marker, markersize=3.2, label=text)
    axes.fill_between(curve.x, curve.y - curve.error, curve.y + curve.error, color=colour, alpha=0.3,
                      linewidth=0)
    return draw_statuses(axes, curve, colour)


def draw_points(axes, curve, colour, text=None, marker="o", shift=1.0, filled=True):
    """Points with error bars, shifted in x by a factor; returns legend entries for the statuses."""
    shifted = curve._replace(x=curve.x * shift)
    there = np.isfinite(shifted.y)
    error = np.where(np.isfinite(shifted.error), shifted.error, 0)
    axes.errorbar(shifted.x[there], shifted.y[there], error[there], linestyle="", color=colour, label=text,
                  marker=marker, markersize=4.5, markerfacecolor=colour if filled else "white", capsize=2,
                  linewidth=1.1)
    return draw_statuses(axes, shifted, colour)


def draw_statuses(axes, curve, colour):
    """Marks points with a remark, and at the foot those without a value; returns legend entries by text."""
    entries = {}
    for status in np.unique(curve.status):
        here, meaning = curve.status == status, readable(curve.meanings[status])
        empty, remarked = here & ~np.isfinite(curve.y), here & np.isfinite(curve.y) & (status > 0)
        if empty.any():
            look = dict(linestyle="", marker="x", markersize=5, markeredgewidth=1.2)
            axes.plot(curve.x[empty], np.full(empty.sum(), 0.03), color=colour, clip_on=False,
                      transform=axes.get_xaxis_transform(), **look)
            entries[f"no value: {meaning}"] = Line2D([], [], color="black", **look)
        if remarked.any():
            look = dict(linestyle="", marker=status_marker(status), markersize=9,
                        markerfacecolor="none", markeredgecolor="black", markeredgewidth=0.9, zorder=5)
            axes.plot(curve.x[remarked], curve.y[remarked], **look)
            entries[f"status: {meaning}"] = Line2D([], [], **look)
    return entries


def legend(axes, entries, **options):
    """The legend of the lines and of the statuses."""
    lines, texts = axes.get_legend_handles_labels()
    return axes.legend([*lines, *entries.values()], [*texts, *entries], **options)


def legend_below(axes, entries, bottom):
    """One legend for panels with equal lines, centred, at this height (inches)."""
    lines, texts = axes.get_legend_handles_labels()
    anchor = 0.5, bottom / axes.figure.get_figheight()
    axes.figure.legend([*lines, *entries.values()], [*texts, *entries], loc="lower center", borderaxespad=0,
                       bbox_to_anchor=anchor, ncol=len(lines) + len(entries))


def with_symbol(data, value):
    """A value of the axis as a legend's text."""
    return f"{label(data)} = {value:g}"


def coloured(items):
    """Pairs of item and colour."""
    return zip(items, cycle(COLOURS))


def true_runs(here):
    """First and last index of each run of true values."""
    change = np.flatnonzero(np.diff(np.concatenate([[False], here, [False]]).astype(int)))
    return [(first, after - 1) for first, after in change.reshape(-1, 2)]


def title_axis(axes, which, data):
    """Titles the plot's x or y axis with the dataset's symbol and unit."""
    getattr(axes, f"set_{which}label")(label(data))


def log_axis(axes, which, data, room=0.03):
    """Makes the plot's x or y axis logarithmic over the dataset's range, with round ticks and a title."""
    numbers = np.atleast_1d(values(data))
    if not (np.isfinite(numbers).all() and (numbers > 0).all()):
        raise BristleError(f"{place_of(data)} must be positive to be a logarithmic axis")
    low, high = np.log10(numbers.min()), np.log10(numbers.max())
    room *= (high - low) or 1
    log_range(axes, which, low - room, high + room)
    title_axis(axes, which, data)


def positive(data, numbers):
    """The numbers that a logarithmic plot of the dataset can show; there must be one."""
    numbers = numbers[np.isfinite(numbers) & (numbers > 0)]
    if not numbers.size:
        raise BristleError(f"{place_of(data)} has no positive values to draw")
    return numbers


def log_range(axes, which, low, high):
    """Limits (log10) of a logarithmic axis, with ticks at round numbers."""
    getattr(axes, f"set_{which}scale")("log")
    getattr(axes, f"set_{which}lim")(10 ** low, 10 ** high)
    places, texts = log_ticks(low, high)
    line = getattr(axes, f"{which}axis")
    line.set_major_locator(ticker.FixedLocator(10 ** places))
    line.set_major_formatter(ticker.FixedFormatter(texts))
    line.set_minor_locator(ticker.LogLocator(subs=range(2, 10)))
    line.set_minor_formatter(ticker.NullFormatter())


def label_line(axes, x, y, power, string, colour=GREY, **look):
    """A text along the line y ~ x^power, at a point of the plot."""
    angle = np.degrees(np.arctan2(power * y, x))
    axes.text(x, y, string, color=colour, rotation=angle, rotation_mode="anchor", va="bottom", fontsize=9,
              transform_rotates_text=True, **look)


def draw_panels(file, names, along, curves, markers="o", x_axis=log_axis, finish=None):
    """A figure with one panel for each variable, side by side, and one legend below.

    curves: the values of the axes beside `along` for each curve, by its text in the legend.
    finish(axes, name) is called for each panel, if given.
    """
    figure, bottom = sheet(file, 5.3 * len(names), PANEL_INCHES[1] + 1.45, BANDS)
    for i, name in enumerate(names):
        axes, entries = place(figure, 0.8 + 5.3 * i, bottom + 1, *PANEL_INCHES), {}
        for ((text, chosen), colour), marker in zip(coloured(curves.items()), cycle(markers)):
            curve = read_curve(file, name, along, **chosen)
            entries |= draw_curve(axes, curve, colour, text, marker=marker)
        x_axis(axes, "x", dataset(file, along))
        title_axis(axes, "y", dataset(file, name))
        heading(axes, "abcd"[i], attribute(dataset(file, name), "long_name"))
        if finish:
            finish(axes, name)
    legend_below(axes, entries, bottom + 0.15)
    return figure
