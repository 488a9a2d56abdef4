"""Fig. A2: the lattice's load over time, its means against the quadrature, its fluctuation against its size."""

import numpy as np

from curves import draw_points, label_line, legend, log_range, number_axis, read_curve
from page import heading, page, place
from style import BLUE, COLOURS, GREY, ORANGE, VERMILION, attribute, dataset, fail, label, run, values
from sweep import axis, axis_names, errors, over, position, setting

FORCE = "slab_force"
NOTE = """a: grey, the transient; dashed, the mean over $t_1$ to $t_2$, with its standard error as a band.
b: one point for each seed; grey, two standard errors.
c: one point for each seed, bars are standard errors; grey lines, slope for independent bristles."""
# What panel c shows: R_n(t), and its means over a row's time, which are free of the rows' period.
FLUCTUATIONS = (("R_n_fluctuation", "as it is", BLUE, "o"),
                ("R_n_fluctuation_of_rows", "means over a row's time", VERMILION, "s"))


def draw(file):
    figure, bottom = page(file, 10.6, 6.3, NOTE)
    draw_history(place(figure, 0.9, bottom + 4.0, 9.3, 1.95), file)
    draw_deviations(place(figure, 0.9, bottom + 0.6, 4.1, 2.35), file)
    draw_fluctuation(place(figure, 6.1, bottom + 0.6, 4.1, 2.35), file)
    return figure


def draw_history(axes, file):
    """R_n(t) of the smallest and the largest lattice with the first seed."""
    sizes, seed = axis(file, "L_y"), axis(file, "seed")[0]
    begin = setting(file, "orientation", "t_1", default=-1)
    begin = begin if begin >= 0 else 2 * setting(file, "model", "L_x")
    rows = dataset(file, f"{FORCE}/point")
    for size, colour, level in ((sizes[0], ORANGE, 2), (sizes[-1], BLUE, 3)):
        here = dict(sampling="lattice", L_y=size, seed=seed)
        mine = values(rows) == point(file, here)
        if not mine.any():
            fail(f"{file.filename}: table '/{FORCE}' has no rows of the lattice with "
                 f"L_y = {size:g}, seed {seed:g}")
        t, load = (values(dataset(file, f"{FORCE}/{name}"))[mine] for name in ("t", "R_n"))
        axes.plot(t, load, color=colour, linewidth=0.8, zorder=level,
                  label=f"{label(dataset(file, 'L_y'))} = {size:g}, seed {seed:g}")
        mean, error = over(dataset(file, "R_n"), [], here), errors(file, "R_n", [], here)
        axes.plot([begin, t[-1]], [mean, mean], "--", color=colour, linewidth=1.4, zorder=level + 2)
        axes.fill_between([begin, t[-1]], mean - error, mean + error, color=colour, alpha=0.35, linewidth=0)
    axes.axvspan(0, begin, color="#e4e4e4", zorder=0)
    axes.set(xlim=(0, t[-1]), ylim=(0, None))
    number_axis(axes, "x", dataset(file, f"{FORCE}/t"))
    number_axis(axes, "y", dataset(file, f"{FORCE}/R_n"))
    axes.legend(loc="lower right")
    heading(axes, "a", attribute(dataset(file, f"{FORCE}/R_n"), "long_name"))


def point(file, chosen):
    """Number of a point of the sweep, the last axis fastest."""
    data = dataset(file, "R_n")
    over(data, [], chosen)  # the axes are those chosen
    return np.ravel_multi_index([position(file, name, chosen[name]) for name in axis_names(data)], data.shape)


def draw_deviations(axes, file):
    """Lattice minus quadrature, in standard errors of the lattice."""
    sizes = np.arange(len(axis(file, "L_y")))
    seeds = axis(file, "seed")
    axes.axhspan(-2, 2, color="#e4e4e4", zorder=0)
    axes.axhline(0, color=GREY, linewidth=0.8, zorder=0)
    for name, marker, colour, side in (("R_n", "o", COLOURS[0], -0.17), ("R_x", "s", COLOURS[1], 0.17)):
        lattice, means = (over(dataset(file, name), ["L_y", "seed"], {"sampling": sampling})
                          for sampling in ("lattice", "quadrature"))
        off = (lattice - means) / errors(file, name, ["L_y", "seed"], {"sampling": "lattice"})
        x = np.add.outer(sizes + side, np.linspace(-0.12, 0.12, len(seeds)))
        axes.plot(x.ravel(), off.ravel(), marker, color=colour, markersize=3.8,
                  label=label(dataset(file, name)))
    axes.set_xticks(sizes, [f"{size:g}" for size in axis(file, "L_y")])
    axes.set_xlim(-0.5, len(sizes) - 0.5)
    ends = np.abs(axes.dataLim.intervaly)
    widest = 1.15 * np.max(ends, initial=2.6, where=np.isfinite(ends))
    axes.set_ylim(-widest, 1.35 * widest)
    number_axis(axes, "x", dataset(file, "L_y"))
    axes.set_ylabel("deviation [standard errors]")
    axes.legend(loc="upper right", ncol=2)
    heading(axes, "b", "lattices' means less the quadrature's")


def draw_fluctuation(axes, file):
    """R_n's relative fluctuation against the number of bristles, with the slope of independent ones."""
    per_width = setting(file, "model", "L_x") / setting(file, "model", "spacing") ** 2
    seeds = axis(file, "seed")
    shifts = 1.03 ** (np.arange(len(seeds)) - (len(seeds) - 1) / 2)
    number = axis(file, "L_y") * per_width
    ends = number[[0, -1]] * [0.8, 1.25]
    entries, found = {}, []
    for name, title, colour, marker in FLUCTUATIONS:
        curves = [read_curve(file, name, "L_y", sampling="lattice", seed=seed) for seed in seeds]
        for curve, shift in zip(curves, shifts):
            entries |= draw_points(axes, curve._replace(x=curve.x * per_width), colour, title, marker, shift)
            title = None  # one entry for all seeds
        found.append(np.array([curve.y for curve in curves]))
        if not (found[-1] > 0).any():
            fail(f"{file.filename}: dataset '/{name}' has no positive values to draw")
        level = np.exp(np.nanmean(np.log(found[-1] * np.sqrt(number))))
        axes.plot(ends, level / np.sqrt(ends), color=GREY, linewidth=1, zorder=0)
    log_range(axes, "x", *np.log10(ends))
    log_range(axes, "y", np.log10(0.75 * np.nanmin(found)), np.log10(2 * np.nanmax(found)))
    gap = np.argmax(np.diff(np.log(number)))
    x = np.sqrt(number[gap] * number[gap + 1])
    label_line(axes, x, 0.78 * level / np.sqrt(x), -0.5, r"$\propto N_{c,0}^{-1/2}$", ha="center")
    axes.set_xlabel("$N_{c,0}$")
    number_axis(axes, "y", dataset(file, FLUCTUATIONS[0][0]))
    legend(axes, entries, loc="upper right")
    heading(axes, "c", "standard deviation of $R_n(t)$ over its mean")


if __name__ == "__main__":
    run("figA2", __doc__, ["sampling", "L_y", "seed", "status", "R_n", "R_x",
                           *(row[0] for row in FLUCTUATIONS),
                           *(f"{FORCE}/{name}" for name in ("point", "t", "R_n"))], draw)
