"""Fig. 3: gap against normal load, with the stable paths of a slab that is loaded or unloaded."""

from collections import namedtuple

import numpy as np
from matplotlib import colormaps
from matplotlib.lines import Line2D

from ..plotting.contour_labels import HALO
from ..plotting.curves import log_range, positive, title_axis, true_runs, with_symbol
from ..plotting.layout import LEAST_CELL, heading, legend_at_foot, place, sheet
from ..plotting.page import lettered, paper_width, points
from ..plotting.readings import page_for_each_reading
from ..plotting.style import BLACK, GREY, label, status_marker
from ..results import axis_values, dataset, read, select, select_flags, setting, status_words

AXES = ["k_phi", "k_r", "z_0_target"]
SIDE_PANELS = 2
LOW, HIGH = -0.04, 1.04  # range of the gap in the plots

# Points from first contact downward; loading, unloading: whether the point is on that path.
Trace = namedtuple("Trace", "load gap loading unloading status meanings")

LOADING = dict(linewidth=2.6, solid_capstyle="round")
UNLOADING = dict(linewidth=1.5, linestyle=(0, (3.2, 1.6)))
UNSTABLE = dict(linewidth=1.1, linestyle=(0, (1, 1.3)))
STYLES = {"loading path": LOADING, "stable when unloading only": UNLOADING, "unstable": UNSTABLE}
JUMPS = {"jump under growing load": "-", "jump under falling load": (0, (2.5, 1.5))}


def MARKS(file):
    return ("Thick lines: the loading path; dashed: stable when unloading only; dotted: unstable; solid and dashed arrows: jumps under "
            f"growing and under falling load; darker lines: smaller $\\tilde{{k}}_r$. {note(file)}")


@page_for_each_reading
def draw(file, reading):
    polar, radial = axis_values(file, "k_phi"), axis_values(file, "k_r")
    paper = setting(file, "model", "k_phi")  # the experiment's value outside its sweep
    main = int(np.argmin(abs(polar - paper))) if paper in polar else len(polar) // 2
    traces = {i: [read_trace(file, k_phi=value, k_r=stiffness, **reading) for stiffness in radial]
              for i, value in enumerate(polar)}
    order = [main] + [i for i in traces if i != main][:SIDE_PANELS]
    order = lettered(order)
    width, height, boxes = arrangement(len(order))
    figure, bottom = sheet(file, width, height, note(file), reading)
    for (letter, i), (x, y, *size) in zip(order, boxes):
        axes = place(figure, x, bottom + y, *size)
        entries = draw_panel(axes, file, traces[i], small=letter not in ("", "a"))
        set_range(axes, file, traces[i])
        heading(axes, letter, with_symbol(dataset(file, "k_phi"), polar[i]))
    colours = {with_symbol(dataset(file, "k_r"), value): Line2D([], [], color=colour, linewidth=2.6)
               for value, colour in shaded(radial)}
    draw_legends(figure, bottom, colours, entries)
    return figure


def shaded(items):
    """Pairs of item and colour, from dark to light: the paths decide the styles of lines."""
    return zip(items, colormaps["viridis"](np.linspace(0, 0.8, max(2, len(items)))))


def arrangement(panels):
    """Width and height of the figure, and corner and size of its panels, the main one first; in inches."""
    width = paper_width()
    if width is None:
        side = [(7.35, 1.35, 3.1, 4.6)] if panels == 2 else [(7.35, 4.1, 3.1, 1.85), (7.35, 1.35, 3.1, 1.85)]
        return 10.7 if panels > 1 else 7.2, 6.25, [(0.8, 1.35, 5.6, 4.6), *side]
    if width >= 2 * LEAST_CELL or panels == 1:
        main = width - (0.7 if panels == 1 else 0.38 * width + 0.4)
        tall, x = 0.8 * main, main + 1.15
        low = 0.5 * (tall - 0.8) if panels == 3 else tall
        return width, tall + 0.8, [(0.58, 0.47, main, tall), (x, 0.47 + tall - low, width - x - 0.12, low),
                                    (x, 0.47, width - x - 0.12, low)]
    small = 0.5 * width - 0.7
    return width, 0.75 * width + 2.5, [(0.58, 2.45, width - 0.7, 0.75 * width - 0.25), (0.58, 0.47, small, 1.2),
                                      (0.5 * width + 0.58, 0.47, small, 1.2)]


def note(file):
    string = ("A to D: the loading path of the curve with the largest jump under growing load. An arrow that "
              "ends at the frame: no gap of the curve carries the load beyond it. Curves end at the smallest gap "
              f"that is computed, {label(dataset(file, 'z_0'))} = {np.nanmin(read(file, 'z_0')):.3g}.")
    if "R_n_err" in file:
        error = read(file, "R_n_err") / read(file, "R_n")
        if np.isfinite(error).any():
            string += f" Estimated errors of the loads, not drawn: at most {100 * np.nanmax(error):.2g} %."
    return string


def read_trace(file, **chosen):
    """The curve at one point of the sweep, from first contact down.

    A slab under a growing load takes the highest gap that carries it, one under a falling load the lowest.
    """
    along = ["z_0_target"]
    load, gap = (select(dataset(file, name), along, **chosen) for name in ("R_n", "z_0"))
    meanings, status = select_flags(file, "status", along, **chosen)
    there = np.flatnonzero(np.isfinite(load) & np.isfinite(gap))[::-1]
    load, gap, status = load[there], gap[there], status[there]
    return Trace(load, gap, load >= np.maximum.accumulate(load), load <= np.minimum.accumulate(load[::-1])[::-1], status, meanings)


def set_range(axes, file, traces):
    """The range of the panel's loads; the same range of the gap, and the same titles, in all panels."""
    loads = positive(dataset(file, "R_n"), np.concatenate([trace.load for trace in traces]))
    log_range(axes, "x", np.log10(loads.min()) - 0.08, np.log10(loads.max()) + 0.08)
    axes.set_ylim(LOW, HIGH)
    title_axis(axes, "x", dataset(file, "R_n"))
    title_axis(axes, "y", dataset(file, "z_0"))


def draw_panel(axes, file, traces, small):
    """The curves of one k_phi; returns legend entries for the statuses by text."""
    entries = {}
    for trace, colour in shaded(traces):
        draw_trace(axes, trace, colour, 0.65 if small else 1)
        for status in np.unique(trace.status[trace.status > 0]):
            here = trace.status == status
            look = dict(linestyle="", marker=status_marker(status), markersize=7, color=BLACK,
                        markerfacecolor="none", zorder=5)
            axes.plot(trace.load[here], trace.gap[here], **look)
            entries[status_words(trace.meanings[status])] = Line2D([], [], **look)
    if not small:
        draw_letters(axes, traces)
    return entries


def draw_trace(axes, trace, colour, scale):
    down, up = (path[1:] & path[:-1] for path in (trace.loading, trace.unloading))
    for style, segments in ((UNSTABLE, ~down & ~up), (UNLOADING, up & ~down), (LOADING, down)):
        look = {**style, "linewidth": scale * style["linewidth"]}
        for first, last in true_runs(segments):
            nodes = slice(first, last + 2)
            axes.plot(trace.load[nodes], trace.gap[nodes], color=colour, **look)
    for style, found, frame in zip(JUMPS.values(), (jumps(trace), jumps(trace, down=False)), (LOW, HIGH)):
        for load, start, end in found:
            look = dict(arrowstyle="-|>", color=colour, linestyle=style, linewidth=1.1 * scale, shrinkA=0,
                        shrinkB=0, mutation_scale=11 * scale)
            axes.annotate("", (load, frame if np.isnan(end) else end), (load, start), arrowprops=look)


def jumps(trace, down=True):
    """(load, gap before, gap after) of each jump on the loading path, or on the unloading path if not `down`.

    The gap after is NaN where the path leaves the curve.
    """
    path = np.flatnonzero(trace.loading if down else trace.unloading)[::1 if down else -1]
    found = [(trace.load[here], trace.gap[here], trace.gap[there])
             for here, there in zip(path, path[1:]) if abs(there - here) > 2]  # not a ripple
    if path.size and path[-1] != (len(trace.load) - 1 if down else 0):
        found.append((trace.load[path[-1]], trace.gap[path[-1]], np.nan))
    return found


def draw_letters(axes, traces):
    """The loading path A-B-C-D of the curve with the deepest jump."""
    falls = [(start - end, i, load, start, end) for i, trace in enumerate(traces)
             for load, start, end in jumps(trace) if np.isfinite(end)]
    if not falls:
        return
    _, i, load, start, end = max(falls)
    path = np.flatnonzero(traces[i].loading)[[0, -1]]
    (first, last), (top, bottom) = traces[i].load[path], traces[i].gap[path]
    for letter, point, shift in (("A", (first, top), (-9, 3)), ("B", (load, start), (8, 5)),
                                 ("C", (load, end), (-9, -7)), ("D", (last, bottom), (11, 9))):
        axes.plot(*point, "o", color=dict(enumerate(colour for _, colour in shaded(traces)))[i], markeredgecolor=BLACK, markersize=4.5, zorder=6)
        axes.annotate(letter, point, shift, textcoords="offset points", ha="center", va="center", weight="bold",
                      fontsize=points(11), path_effects=HALO, zorder=7)


def draw_legends(figure, bottom, colours, entries):
    """Colours in one row, line styles in another."""
    styles = {text: Line2D([], [], color=GREY, **look) for text, look in STYLES.items()}
    styles |= {text: Line2D([], [], color=GREY, linewidth=1.1, linestyle=style, marker=marker, markevery=[1])
               for (text, style), marker in zip(JUMPS.items(), "v^")}
    if paper_width() is not None:
        legend_at_foot(figure, colours | styles | entries, bottom)
        return
    for row, y in ((colours, 0.48), (styles | entries, 0.15)):
        legend_at_foot(figure, row, bottom + y)
