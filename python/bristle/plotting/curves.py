"""Quantities over one axis of the sweep: lines with error bands, points with error bars, panels."""

from collections import namedtuple

import numpy as np
from matplotlib import ticker
from matplotlib.lines import Line2D

from ..errors import BristleError
from ..results import (CHOICE_NAMES, attribute, axis_values, dataset, place_of, readable, select, select_errors,
                       select_flags, status_words, values)
from .jumps import LEAST_CHANGE, WIDEST_STEP, Jump, breaks_on_line, has_breaks, located_axis, located_jumps
from .layout import NO_VALUE, Cell, across, corners, heading, legend_at_foot, place_cell, row_title, sheet
from .page import lettered, paper_width, points
from .readings import reading_name, readings
from .style import GREY, described, label, log_ticks, looks, status_marker

# status: index of each point's status into `meanings`; 0 is a point without remark.
# jumps: whether the loading path jumps, or the phase changes between contact and bouncing, between each point and the next.
# located: each Jump that the run located.
Curve = namedtuple("Curve", "x y error status meanings jumps located")

LINES = ("Colours, dashes and markers tell the lines apart, as in the legend; markers are at computed points, of long lines at "
         "some of them only.")
BANDS = "Bands, often thinner than the lines, are the estimated errors of the values."
BREAKS = "Lines are broken between contact and bouncing, and where"
LOCATED_JUMPS = (f"{BREAKS} the loading path jumps; dotted lines mark the places of jumps, located to 1 %, "
                 "pale areas where less than 0.5 % of the load decides between two gaps.")
JUMPS = f"{BREAKS} $z_0$ jumps by more than {LEAST_CHANGE:g} $r_0$ between points less than {WIDEST_STEP:g} decades apart."
BARS = "Bars are the standard errors of the lattices' time means."
PANEL_INCHES = (4.1, 3.3)
ROW_TITLE_INCHES = 0.36  # above the panels of each reading
MARKERS_ON_LINE = 12  # about; more would hide how it is dashed


def read_curve(file, name, along, **chosen):
    """A variable along one axis, at the chosen values of the others."""
    y = select(dataset(file, name), [along], **chosen)
    meanings, status = select_flags(file, "status", [along], **chosen)
    located = located_jumps(file, [along], **chosen) if located_axis(file) == along else []
    return Curve(axis_values(file, along), y, select_errors(file, name, [along], **chosen), status, meanings,
                 breaks_on_line(file, along, **chosen), located)


def in_words(file, chosen):
    """The values of axes as one text."""
    return ", ".join(with_symbol(dataset(file, name), value) for name, value in chosen.items())


def jump_note(file, along):
    """What breaks the lines, for the figure's foot; empty if nothing does."""
    if not has_breaks(file, along):
        return ""
    return LOCATED_JUMPS if located_axis(file) == along else JUMPS


def curve_marks(file, along="k_r"):
    """What the marks of lines mean, for a caption."""
    return f"{LINES} {BANDS} {jump_note(file, along)}"


def broken(curve):
    """x, y and error of a line with a gap at each break."""
    places = np.flatnonzero(curve.jumps) + 1
    return [np.insert(np.asarray(numbers, dtype=float), places, np.nan)
            for numbers in (curve.x, curve.y, curve.error)]


def draw_curve(axes, curve, look, text=None, width=1.6):
    """A line, interrupted where there is no value or a break; returns legend entries for the statuses by text."""
    x, y, error = broken(curve)
    colour = look.colour
    axes.plot(x, y, color=colour, linestyle=look.line, linewidth=width, marker=look.marker, markersize=2.4 * width,
              markevery=marked(y, len(axes.lines)), label=text)
    axes.fill_between(x, y - error, y + error, color=colour, alpha=0.3, linewidth=0)
    for (index,), place, start, end in curve.located:
        sides = curve.y[index:index + 2]
        axes.plot([place, place], sides, ":", color=colour, linewidth=0.7 * width)
        axes.fill_between([start, end], *sides, color=colour, alpha=0.2, linewidth=0)
    return draw_statuses(axes, curve, colour)


def marked(y, shift):
    """Indices of a line's markers: on points that no line joins to others, and on some of the rest."""
    there = np.isfinite(y)
    joined = np.concatenate([[False], there[1:] & there[:-1], [False]])
    step = max(1, there.sum() // MARKERS_ON_LINE)
    return np.flatnonzero(there & (~(joined[1:] | joined[:-1]) | (np.arange(y.size) % step == shift % step))).tolist()


def draw_points(axes, curve, colour, text=None, marker="o", shift=1.0, filled=True):
    """Points with error bars, shifted in x by a factor; returns legend entries for the statuses."""
    shifted = curve._replace(x=curve.x * shift)
    there = np.isfinite(shifted.y)
    error = np.where(np.isfinite(shifted.error), shifted.error, 0)
    axes.errorbar(shifted.x[there], shifted.y[there], error[there], linestyle="", color=colour, label=text,
                  marker=marker, markersize=4.5, markerfacecolor=colour if filled else "white", capsize=2,
                  linewidth=1.1)
    return draw_statuses(axes, shifted, colour)


def over(curve, unit):
    """The curve with its x divided by a unit."""
    located = [Jump(jump.index, *(place / unit for place in jump[1:])) for jump in curve.located]
    return curve._replace(x=curve.x / unit, located=located)


def up_to_last_value(curve):
    """The curve without the points behind its last value: no marks are drawn for them."""
    end = int(np.flatnonzero(np.isfinite(curve.y)).max(initial=-1)) + 1
    return curve._replace(x=curve.x[:end], y=curve.y[:end], error=curve.error[:end], status=curve.status[:end],
                          jumps=curve.jumps[:max(end - 1, 0)], located=[jump for jump in curve.located if jump.index[0] + 1 < end])


def without_remarks(curve):
    """The curve, for which no statuses are drawn: another curve of the same points has them."""
    return curve._replace(status=np.zeros_like(curve.status))


def draw_statuses(axes, curve, colour):
    """Marks points with a remark, and at the foot those without a value; returns legend entries by text."""
    entries = {}
    for status in np.unique(curve.status):
        here, meaning = curve.status == status, status_words(curve.meanings[status])
        empty, remarked = here & ~np.isfinite(curve.y), here & np.isfinite(curve.y) & (status > 0)
        if empty.any():
            look = dict(linestyle="", marker="x", markersize=5, markeredgewidth=1.2)
            axes.plot(curve.x[empty], np.full(empty.sum(), 0.03), color=colour, clip_on=False,
                      transform=axes.get_xaxis_transform(), **look)
            entries[f"{NO_VALUE}{meaning}"] = Line2D([], [], color="black", **look)
        if remarked.any():
            look = dict(linestyle="", marker=status_marker(status), markersize=8,
                        markerfacecolor="none", markeredgecolor="black", markeredgewidth=0.8, zorder=1.5)  # behind the line
            axes.plot(curve.x[remarked], curve.y[remarked], **look)
            entries[meaning] = Line2D([], [], **look)
    return entries


def legend(axes, entries, **options):
    """The legend of the lines and of the statuses."""
    lines, texts = axes.get_legend_handles_labels()
    return axes.legend([*lines, *entries.values()], [*texts, *entries], **options)


def legend_below(axes, entries, bottom):
    """One legend for panels with equal lines, centred, at this height (inches)."""
    lines, texts = axes.get_legend_handles_labels()
    legend_at_foot(axes.figure, {**dict(zip(texts, lines)), **entries}, bottom)


def with_symbol(data, value):
    """A value of the axis as a text; the names of choices are enough."""
    return CHOICE_NAMES.get(value, readable(value)) if isinstance(value, str) else f"{label(data)} = {value:g}"


def true_runs(here):
    """First and last index of each run of true values."""
    change = np.flatnonzero(np.diff(np.concatenate([[False], here, [False]]).astype(int)))
    return [(first, after - 1) for first, after in change.reshape(-1, 2)]


def title_axis(axes, which, data, name=""):
    """Titles the plot's x or y axis with the dataset's symbol and unit, after a name if there is one."""
    getattr(axes, f"set_{which}label")(f"{name} {label(data)}".strip())


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
    width = axes.get_position().width * axes.figure.get_figwidth() if which == "x" else np.inf
    places, texts = log_ticks(low, high, width)
    line = getattr(axes, f"{which}axis")
    line.set_major_locator(ticker.FixedLocator(10 ** places))
    line.set_major_formatter(ticker.FixedFormatter(texts))
    line.set_minor_locator(ticker.LogLocator(subs=range(2, 10)))
    line.set_minor_formatter(ticker.NullFormatter())


def label_line(axes, x, y, power, string, colour=GREY, **look):
    """A text along the line y ~ x^power, at a point of the plot."""
    angle = np.degrees(np.arctan2(power * y, x))
    axes.text(x, y, string, color=colour, rotation=angle, rotation_mode="anchor", fontsize=points(10),
              transform_rotates_text=True, **{"va": "bottom", **look})


def draw_panels(file, names, along, curves, x_axis=log_axis, finish=None, note=""):
    """A figure with one panel for each variable, side by side, a row for each reading, and one legend below.

    curves: the values of the axes beside `along` for each curve, by its text in the legend.
    finish(axes, name) is called for each panel, if given. note: below the panels.
    """
    rows = {}
    for letter, (reading, name) in lettered([(reading, name) for reading in readings(file) for name in names]):
        rows.setdefault(reading_name(reading), []).append((letter, reading, name))
    titled = ROW_TITLE_INCHES if any(rows) else 0
    most = max(map(len, rows.values()))
    cell, columns = across(most, Cell(5.3, PANEL_INCHES[1] + 0.95, 0.8, 0.7, *PANEL_INCHES))
    heights = [cell.height * -(-len(row) // columns) + titled for row in rows.values()]
    below = 0.3 if paper_width() is None else 0  # of the legend
    note = "\n".join(filter(None, [note, f"{BANDS} {jump_note(file, along)}"]))
    figure, bottom = sheet(file, cell.width * columns, sum(heights) + below, note)
    entries, first, y = {}, {}, bottom + below + sum(heights)
    for (model, row), height in zip(rows.items(), heights):
        y -= height
        if model:
            row_title(figure, cell.width * columns / 2, y + height - 0.12, model)
        for (letter, reading, name), corner in zip(row, corners(len(row), columns, cell, y)):
            axes = place_cell(figure, corner, cell, sharey=first.get(name))
            first.setdefault(name, axes)
            entries |= draw_lines(axes, file, name, along, curves, reading)
            x_axis(axes, "x", dataset(file, along))
            heading(axes, letter, attribute(dataset(file, name), "long_name"), [described(dataset(file, name)), model])
            if finish:
                finish(axes, name)
    legend_below(axes, entries, bottom + 0.15)
    return figure


def draw_lines(axes, file, name, along, curves, reading):
    """A line for each curve, and the title of y; returns legend entries for the statuses by text."""
    entries = {}
    for (text, chosen), look in looks(curves.items()):
        entries |= draw_curve(axes, read_curve(file, name, along, **chosen, **reading), look, text)
    title_axis(axes, "y", dataset(file, name))
    return entries


def draw_by_reading(file, name, along, curves, **place):
    """A figure of one variable with a panel for each reading, side by side, and the legend in the first.

    curves: the values of the axes beside `along` for each curve, by its text. place: of the legend.
    """
    figure, panels = panels_by_reading(file, (4.1, 3.7), (5.9, 4.1), f"{BANDS} {jump_note(file, along)}")
    entries = {}
    for axes, reading in panels:
        entries |= draw_lines(axes, file, name, along, curves, reading)
        log_axis(axes, "x", dataset(file, along))
    legend(panels[0][0], entries, **place)
    return figure


def panels_by_reading(file, panel, alone, note):
    """A figure with a panel for each reading, side by side; returns it with (axes, reading) of each.

    panel: width and height (inches) of several panels; alone: of a single one.
    """
    shown = lettered(readings(file))
    width, height = panel if len(shown) > 1 else alone
    cell, columns = across(len(shown), Cell(width + 1, height + 1.05, 0.87, 0.65, width, height), 0.62)
    rows = -(-len(shown) // columns)
    figure, bottom = sheet(file, cell.width * columns + 0.1, cell.height * rows, note)
    out = []
    for (letter, reading), corner in zip(shown, corners(len(shown), columns, cell, bottom)):
        axes = place_cell(figure, corner, cell, sharey=out[0][0] if out else None)
        heading(axes, letter, reading_name(reading))
        out.append((axes, reading))
    return figure, out
