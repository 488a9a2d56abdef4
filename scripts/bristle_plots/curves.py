"""Quantities along one axis: lines with the errors as bands, points with the errors as bars."""

from collections import namedtuple
from itertools import cycle

import numpy as np
from matplotlib import ticker
from matplotlib.lines import Line2D

from style import COLOURS, GREY, MARKERS, dataset, fail, label, log_ticks
from sweep import axis, errors, over, statuses, where

# status: index into `meanings` of each point's; 0 is a point without remark.
Curve = namedtuple("Curve", "x y error status meanings")

BANDS = "Bands, often thinner than the lines, are the estimated errors of the values."
BARS = "Bars are the standard errors of the lattices' time means."


def read_curve(file, name, along, **chosen):
    """A variable along one axis, at the chosen values of the others."""
    x = axis(file, along)
    y = over(dataset(file, name), [along], chosen)
    meanings, status = statuses(file, [along], chosen)
    return Curve(x, y, errors(file, name, [along], chosen), status, meanings)


def draw_curve(axes, curve, colour, text=None, line="-", marker="o"):
    """A line with a gap where there is no value; returns legend entries for the statuses by text."""
    axes.plot(curve.x, curve.y, line, color=colour, linewidth=1.6, marker=marker, markersize=3.2, label=text)
    axes.fill_between(curve.x, curve.y - curve.error, curve.y + curve.error, color=colour, alpha=0.3,
                      linewidth=0)
    return draw_statuses(axes, curve, colour)


def draw_points(axes, curve, colour, text=None, marker="o", shift=1.0, filled=True):
    """Points with error bars, moved aside by a factor; returns legend entries for the statuses."""
    moved = curve._replace(x=curve.x * shift)
    there = np.isfinite(moved.y)
    error = np.where(np.isfinite(moved.error), moved.error, 0)
    axes.errorbar(moved.x[there], moved.y[there], error[there], linestyle="", color=colour, label=text,
                  marker=marker, markersize=4.5, markerfacecolor=colour if filled else "white", capsize=2,
                  linewidth=1.1)
    return draw_statuses(axes, moved, colour)


def draw_statuses(axes, curve, colour):
    """Mark the points with a remark, and at the foot those without a value; legend entries by text."""
    entries = {}
    for status in np.unique(curve.status):
        here = curve.status == status
        empty, remarked = here & ~np.isfinite(curve.y), here & np.isfinite(curve.y) & (status > 0)
        if empty.any():
            look = dict(linestyle="", marker="x", markersize=5, markeredgewidth=1.2)
            axes.plot(curve.x[empty], np.full(empty.sum(), 0.03), color=colour, clip_on=False,
                      transform=axes.get_xaxis_transform(), **look)
            entries[f"no value: {curve.meanings[status]}"] = Line2D([], [], color="black", **look)
        if remarked.any():
            look = dict(linestyle="", marker=MARKERS[status % len(MARKERS)], markersize=9,
                        markerfacecolor="none", markeredgecolor="black", markeredgewidth=0.9, zorder=5)
            axes.plot(curve.x[remarked], curve.y[remarked], **look)
            entries[f"status: {curve.meanings[status]}"] = Line2D([], [], **look)
    return entries


def legend(axes, entries, **options):
    """The legend of what is drawn, and of the statuses among it."""
    lines, texts = axes.get_legend_handles_labels()
    return axes.legend([*lines, *entries.values()], [*texts, *entries], **options)


def legend_below(axes, entries, bottom):
    """The same for panels with equal lines: in the middle of the figure, there (inches)."""
    lines, texts = axes.get_legend_handles_labels()
    anchor = 0.5, bottom / axes.figure.get_figheight()
    axes.figure.legend([*lines, *entries.values()], [*texts, *entries], loc="lower center", borderaxespad=0,
                       bbox_to_anchor=anchor, ncol=len(lines) + len(entries))


def with_symbol(data, value):
    """The value of an axis as a legend's text."""
    return f"{label(data)} = {value:g}"


def coloured(curves):
    """Each with its colour."""
    return zip(curves, cycle(COLOURS))


def stretches(here):
    """First and last index of each run of true values."""
    change = np.flatnonzero(np.diff(np.concatenate([[False], here, [False]]).astype(int)))
    return [(first, after - 1) for first, after in change.reshape(-1, 2)]


def number_axis(axes, which, data):
    """Title of an axis from the dataset."""
    getattr(axes, f"set_{which}label")(label(data))


def log_axis(axes, which, data, room=0.03):
    """A logarithmic axis over the dataset's range, with round ticks, and its title."""
    numbers = np.atleast_1d(data[()])
    if not (np.isfinite(numbers).all() and (numbers > 0).all()):
        fail(f"{where(data)} must be positive to be a logarithmic axis")
    low, high = np.log10(numbers.min()), np.log10(numbers.max())
    room *= (high - low) or 1
    log_range(axes, which, low - room, high + room)
    number_axis(axes, which, data)


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
