"""Appendix A: forces and bristles in contact over time after the slab has arrived, against their steady means."""

import numpy as np

from ..plotting.curves import legend, panels_by_reading, title_axis
from ..plotting.readings import one_page
from ..plotting.style import GREY, looks, symbol
from ..results import axis_values, constant, dataset, point_numbers, read, select, setting

AXES = ["sampling", "rows", "seed"]
FORCE = "slab_force"
VARIABLES = ["R_n", "R_x", "N_c_ratio"]
MARKS = "Means over lattices and over the time in which a row enters. Grey area: the time before $t_1 = L_x/V_0$; grey line: the ensemble mean"


@one_page
def draw(file):
    begin = constant(dataset(file, f"{FORCE}/t"), "t_1")
    note = (f"Mean over {len(axis_values(file, 'seed'))} lattices, and over the time in which a row enters. "
            "Grey: the time before $t_1 = L_x/V_0$.")
    figure, panels = panels_by_reading(file, (4.1, 3.7), (5.9, 4.1), note)
    for axes, reading in panels:
        axes.axvspan(0, begin, color="#e4e4e4", zorder=0)
        axes.axhline(1, color=GREY, linewidth=1, zorder=0)
        for name, look in looks(VARIABLES):
            t, ratio = history(file, name, reading)
            axes.plot(t, ratio, color=look.colour, linestyle=look.line, linewidth=1.4, label=symbol(dataset(file, f"{FORCE}/{name}")))
        axes.set(xlim=(0, t[-1]), ylim=(0, 1.2))
        title_axis(axes, "x", dataset(file, f"{FORCE}/t"))
        axes.set_ylabel("over the ensemble mean")
    legend(panels[0][0], {}, loc="lower right")
    return figure


def history(file, name, reading):
    """Time, and the quantity over its ensemble mean: averaged over the seeds and over the time of a row, in the
    lattices with the most rows."""
    here = dict(rows=axis_values(file, "rows")[-1], **reading)
    point, t, values = (read(file, f"{FORCE}/{column}") for column in ("point", "t", name))
    numbers = select(point_numbers(file), ["seed"], sampling="lattice", **here)
    series = np.mean([values[point == number] for number in numbers], axis=0)
    t = t[point == numbers[0]]
    row = round(setting(file, "model", "spacing") / (t[1] - t[0]))  # V_0 = 1
    smooth = np.convolve(series, np.ones(row) / row, "valid")
    steady = select(dataset(file, name), ["seed"], sampling="quadrature", **here)[0]
    return t[row - 1:] - (t[row - 1] - t[0]) / 2, smooth / steady
