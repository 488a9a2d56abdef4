"""Fig. 8: friction over the local friction coefficient, for soft and stiff bristles."""

import numpy as np

from ..plotting.curves import (BANDS, LINES, draw_curve, jump_note, label_line, legend, log_axis, log_range,
                               panels_by_reading, positive, read_curve, title_axis, with_symbol, without_remarks)
from ..plotting.readings import one_page, readings
from ..plotting.style import GREY, looks
from ..results import axis_values, dataset, experiment

AXES = ["k_r", "mu_c"]
VARIABLES = ["R_x_norm"]
PASSING = "R_x_norm_unpinned"
PINNED = "pinned_share_R_x"
NOTE_PASSING = "Thin: friction of the bristles that pass, without those that stay pinned at the pole."
RIGID = "Grey: the friction of rigid bristles{}."
TESTED = ", and from the $\\mu_c$ on where the check of claim 8b begins, a constant friction force of the stiffer bristles"
HIGHEST = 1.5  # upper end of the plot


def MARKS(file):
    return f"{LINES} {note(file)} {RIGID.format('' if where_tested(file) is None else TESTED)}"


def note(file):
    return f"{BANDS} {jump_note(file, 'mu_c')} {NOTE_PASSING * any(some_pinned(file, reading) for reading in readings(file))}"


def some_pinned(file, reading):
    """Whether bristles stay pinned at the pole, so that the friction of those that pass is another."""
    return PASSING in file and PINNED in file and bool((dataset(file, PINNED).sel(reading) > 0).any())


@one_page
def draw(file):
    data = dataset(file, VARIABLES[0])
    figure, panels = panels_by_reading(file, (4.7, 4.1), (5.9, 4.1), note(file))
    stiffnesses, least = axis_values(file, "k_r"), []
    for axes, reading in panels:
        curves, entries = [], {}
        for stiffness, look in looks(stiffnesses):
            chosen = dict(k_r=stiffness, **reading)
            curves.append(read_curve(file, VARIABLES[0], "mu_c", **chosen))
            entries |= draw_curve(axes, curves[-1], look, with_symbol(dataset(file, "k_r"), stiffness))
            if some_pinned(file, reading):
                thin = read_curve(file, PASSING, "mu_c", **chosen)
                draw_curve(axes, without_remarks(thin), look._replace(marker=""), width=0.8)
        log_axis(axes, "x", dataset(file, "mu_c"), room=0)
        title_axis(axes, "y", data)
        draw_limits(axes, curves[int(np.argmax(stiffnesses))], where_tested(file))
        legend(axes, entries, loc="lower left")
        least.append(positive(data, np.concatenate([curve.y for curve in curves])).min())
    log_range(axes, "y", np.log10(0.6 * min(least)), np.log10(HIGHEST))
    return figure


def where_tested(file):
    """The mu_c from which on an experiment's check measures the slope of the friction; None without such a check."""
    ranges = [check.get("where", {}).get("mu_c") for check in experiment(file).get("checks", []) if check["predicate"] == "slope"]
    return min((each[0] for each in ranges if isinstance(each, list)), default=None)


def draw_limits(axes, stiff, tested):
    """Lines for rigid bristles, and for the friction force that stiff bristles have where the check of it begins."""
    axes.axhline(1, color=GREY, linewidth=1, zorder=0)
    label_line(axes, stiff.x[-1] / 1.05, 1.03, 0, "rigid bristles", ha="right")
    valued = np.flatnonzero(np.isfinite(stiff.y) & (stiff.x >= (tested or np.inf) * (1 - 1e-9)))
    if valued.size > 1:
        force = stiff.x[valued[0]] * stiff.y[valued[0]]
        ends = stiff.x[valued[[0, -1]]]
        axes.plot(ends, force / ends, color=GREY, linewidth=1, zorder=0, label=r"constant force $R_x$")
