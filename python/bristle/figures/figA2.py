"""Fig. A2: the lattice's load over time, its means and the quadrature's, its fluctuation over its size."""

import numpy as np

from ..errors import BristleError
from ..plotting.curves import draw_points, label_line, legend, log_range, positive, read_curve, title_axis, with_symbol
from ..plotting.layout import Cell, across, corners, heading, place, sheet
from ..plotting.page import lettered, paper_width
from ..plotting.readings import page_for_each_reading
from ..plotting.style import BLUE, COLOURS, GREY, ORANGE, VERMILION, label
from ..results import attribute, axis_values, constant, dataset, place_of, point_numbers, read, select, select_errors

AXES = ["sampling", "L_y", "seed"]
FORCE = "slab_force"
NOTES = [r"grey, the transient; dashed, the mean over $t_1$ to $t_2$, with its standard error as a band.",
         "one point for each seed; grey, two standard errors.",
         "one point for each seed, bars are standard errors; grey lines, slope for independent bristles."]
# Of the caption, what the legends say.
LEGENDS = ["Orange: the narrowest lattice; blue: the widest.", "Circles: load; squares: friction.",
           "Circles: as it is; squares: means over a row's time."]
# Of panel c: R_n(t), and its means over a row's time, which do not contain the rows' period.
FLUCTUATIONS = (("R_n_fluctuation", "as it is", BLUE, "o"),
                ("R_n_fluctuation_of_rows", "means over a row's time", VERMILION, "s"))


def lettered_notes(notes):
    return "\n".join(f"({letter}) {text}" if letter else text[0].upper() + text[1:] for letter, text in lettered(notes))


def MARKS(_):
    return lettered_notes([f"{note} {entries}" for note, entries in zip(NOTES, LEGENDS)])


@page_for_each_reading
def draw(file, reading):
    shown = lettered([draw_history, draw_deviations, draw_fluctuation])
    history = shown[:1] if shown[0][1] is draw_history else []
    below = shown[len(history):]
    wide = 4.1 if len(below) > 1 else 6
    cell, columns = across(max(1, len(below)), Cell(wide + 1.1, 3.4, 0.9, 0.6, wide, 2.35), 0.6)
    width = cell.width * columns + (0.2 if paper_width() is None else 0)
    upper, lower = (2.9 if paper_width() is None else 2.0) * len(history), cell.height * -(-len(below) // columns)
    figure, bottom = sheet(file, width, upper + lower, lettered_notes(NOTES), reading)
    places = [(cell.left, bottom + lower + cell.low, (columns - 1) * cell.width + cell.inner_width, upper - cell.low - 0.35)
              for _ in history]
    places += [(x + cell.left, y + cell.low, cell.inner_width, cell.inner_height)
               for x, y in corners(len(below), columns, cell, bottom)]
    for (letter, draw_panel), room in zip(shown, places):
        axes = place(figure, *room)
        heading(axes, letter, draw_panel(axes, file, reading))
    return figure


def draw_history(axes, file, reading):
    """R_n(t) of the smallest and the largest lattice with the first seed; returns the panel's title, like the next two."""
    sizes, seed = axis_values(file, "L_y"), axis_values(file, "seed")[0]
    begin = constant(dataset(file, f"{FORCE}/t"), "t_1")
    point = read(file, f"{FORCE}/point")
    for size, colour, level in ((sizes[0], ORANGE, 2), (sizes[-1], BLUE, 3)):
        here = dict(sampling="lattice", L_y=size, seed=seed, **reading)
        rows = point == select(point_numbers(file), [], **here)
        if not rows.any():
            raise BristleError(f"{place_of(file)}: table '/{FORCE}' has no rows of the lattice with "
                               f"L_y = {size:g}, seed {seed:g}")
        t, load = (read(file, f"{FORCE}/{name}")[rows] for name in ("t", "R_n"))
        axes.plot(t, load, color=colour, linewidth=0.8, zorder=level,
                  label=f"{with_symbol(dataset(file, 'L_y'), size)}, seed {seed:g}")
        mean, error = select(dataset(file, "R_n"), [], **here), select_errors(file, "R_n", [], **here)
        axes.plot([begin, t[-1]], [mean, mean], "--", color=colour, linewidth=1.4, zorder=level + 2)
        axes.fill_between([begin, t[-1]], mean - error, mean + error, color=colour, alpha=0.35, linewidth=0)
    axes.axvspan(0, begin, color="#e4e4e4", zorder=0)
    axes.set(xlim=(0, t[-1]), ylim=(0, None))
    title_axis(axes, "x", dataset(file, f"{FORCE}/t"))
    title_axis(axes, "y", dataset(file, f"{FORCE}/R_n"))
    axes.legend(loc="lower right")
    return attribute(dataset(file, f"{FORCE}/R_n"), "long_name")


def draw_deviations(axes, file, reading):
    """Lattice minus quadrature, in standard errors of the lattice."""
    sizes = np.arange(len(axis_values(file, "L_y")))
    seeds = axis_values(file, "seed")
    axes.axhspan(-2, 2, color="#e4e4e4", zorder=0)
    axes.axhline(0, color=GREY, linewidth=0.8, zorder=0)
    for name, marker, colour, side in (("R_n", "o", COLOURS[0], -0.17), ("R_x", "s", COLOURS[1], 0.17)):
        lattice, means = (select(dataset(file, name), ["L_y", "seed"], sampling=sampling, **reading)
                          for sampling in ("lattice", "quadrature"))
        off = (lattice - means) / select_errors(file, name, ["L_y", "seed"], sampling="lattice", **reading)
        x = np.add.outer(sizes + side, np.linspace(-0.12, 0.12, len(seeds)))
        axes.plot(x.ravel(), off.ravel(), marker, color=colour, markersize=3.8,
                  label=label(dataset(file, name)))
    axes.set_xticks(sizes, [f"{size:g}" for size in axis_values(file, "L_y")])
    axes.set_xlim(-0.5, len(sizes) - 0.5)
    ends = np.abs(axes.dataLim.intervaly)
    widest = 1.15 * np.max(ends, initial=2.6, where=np.isfinite(ends))
    axes.set_ylim(-widest, 1.35 * widest)
    title_axis(axes, "x", dataset(file, "L_y"))
    axes.set_ylabel("deviation [standard errors]")
    axes.legend(loc="upper right", ncol=2)
    return "lattices' means less the quadrature's"


def draw_fluctuation(axes, file, reading):
    """R_n's relative fluctuation over the number of bristles, with the slope for independent bristles."""
    per_width = constant(dataset(file, f"{FORCE}/R_n"), "N_c0_per_L_y")
    seeds = axis_values(file, "seed")
    shifts = 1.03 ** (np.arange(len(seeds)) - (len(seeds) - 1) / 2)
    number = axis_values(file, "L_y") * per_width
    ends = number[[0, -1]] * [0.8, 1.25]
    entries, found = {}, []
    for name, title, colour, marker in FLUCTUATIONS:
        curves = [read_curve(file, name, "L_y", sampling="lattice", seed=seed, **reading) for seed in seeds]
        for curve, shift in zip(curves, shifts):
            curve = curve._replace(x=curve.x * per_width)
            entries |= draw_points(axes, curve, colour, title, marker, shift)
            title = None  # one entry for all seeds
        found.append(np.array([curve.y for curve in curves]))
        positive(dataset(file, name), found[-1])
        level = np.exp(np.nanmean(np.log(found[-1] * np.sqrt(number))))
        axes.plot(ends, level / np.sqrt(ends), color=GREY, linewidth=1, zorder=0)
    log_range(axes, "x", *np.log10(ends))
    log_range(axes, "y", np.log10(0.75 * np.nanmin(found)), np.log10(2 * np.nanmax(found)))
    gap = np.argmax(np.diff(np.log(number)))
    x = np.sqrt(number[gap] * number[gap + 1])
    label_line(axes, x, 0.78 * level / np.sqrt(x), -0.5, r"$\propto N_{c,0}^{-1/2}$", ha="center")
    axes.set_xlabel("$N_{c,0}$")
    title_axis(axes, "y", dataset(file, FLUCTUATIONS[0][0]))
    legend(axes, entries, loc="upper right")
    return "standard deviation of $R_n(t)$ over its mean"
