"""The trials of a design, its front, and what is beside the recommended trial: friction, jumps, tolerances."""

from functools import partial

import numpy as np
from matplotlib.colors import to_rgba

from ..errors import BristleError
from ..plotting.curves import title_axis
from ..plotting.layout import Cell, across, corners, heading, place_cell, sheet
from ..plotting.page import lettered, points
from ..plotting.readings import one_page
from ..plotting.style import COLOURS, bar_looks, displayed, label, value_ticks
from ..results import attribute, place_of, table, table_with

AXES = ["sample"]
STATUSES = False  # no point is marked
ALL, FRONT, BEST, JUMP = "0.75", COLOURS[0], COLOURS[1], "0.35"
MADE = "the recommended brush as it can be made; open diamond: its trial, before it was rounded"
NOTE = ("Grey: trials that meet the constraints; blue: the front, of trials that no other surpasses; diamond: {}. q95: the value that 95 % of the brushes with deviations stay below. Error bars: errors of the computation and of the few "
        "deviations.\n"
        "Curves: the first objective at nominal values over each quantity, the others as recommended, in the scenario where it "
        "is worst; band: its error; dashed: a jump of the gap in any scenario, where the curve is broken.")


def note(file):
    return NOTE.format("the recommended trial" if made(file) is None else MADE)


def made(file):
    """The recommended brush as it can be made; None without steps in which dimensions can be made."""
    compared = table(file, "comparison")
    return compared.sel(brush="as_made") if compared is not None and "as_made" in compared["brush"] else None


def MARKS(file):
    return f"{note(file)} Vermilion lines: the recommended value"


@one_page
def draw(file):
    values = ("objective_1", "objective_1_err")
    trials = in_units(table_with(file, "trials", "violation", *values))
    if table(file, "best") is None:
        raise BristleError(f"{place_of(file)}: has no recommended trial; `bristle design` writes it if a trial meets the constraints")
    front, best = (in_units(table_with(file, name, "trial", *values)) for name in ("front", "best"))
    margins = table_with(file, "margins", "value", "margin_below", "margin_above")
    indices = None if table(file, "indices") is None else table_with(file, "indices", "ST", "ST_err")
    quantities = [str(name) for name in margins["quantity"].values]
    brush = made(file)
    panels = [partial(draw_trials, trials=trials, front=front, best=best, brush=best if brush is None else in_units(brush))]
    for name, margin in zip(quantities, margins.transpose("quantity").to_dataframe().itertuples()):
        profile = table_with(file, f"profile_{name}", name, *values)
        place = int(np.abs(profile[name].values - margin.value).argmin())  # of the recommended brush, as made
        panels.append(partial(draw_profile, profile=in_units(profile), name=name, place=place, margin=margin))
    if indices is not None:
        panels.append(partial(draw_indices, indices=indices, trials=trials))
    panels = lettered(panels)
    cell, columns = across(len(panels), Cell(5.6, 4.0, 1.2, 0.8, 4.1, 2.8), 0.3)
    figure, bottom = sheet(file, cell.width * columns, cell.height * -(-len(panels) // columns), note(file))
    for (letter, draw_panel), corner in zip(panels, corners(len(panels), columns, cell, bottom)):
        axes = place_cell(figure, corner, cell)
        draw_panel(axes)
        heading(axes, letter, labels=[f"{axes.get_ylabel()} over {axes.get_xlabel()}" if axes.get_xlabel() else axes.get_ylabel()])
    return figure


def in_units(group):
    """The variables of the group by their names, in the units of figures."""
    return {name: displayed(group[name]) for name in group.variables}


def draw_trials(axes, trials, front, best, brush):
    """All trials, the front, the recommended trial, and the recommended brush, which is this trial or can be made."""
    valid = trials["violation"].values == 0
    if "objective_2" not in trials:
        x = np.arange(valid.size)
        axes.plot(x[valid], trials["objective_1"].values[valid], ".", color=ALL)
        axes.errorbar(best["trial"], brush["objective_1"], brush["objective_1_err"], fmt="d", color=BEST)
        axes.set_xlabel("trial")
        axes.set_ylabel(objective_label(trials, 1))
        return
    axes.plot(trials["objective_1"].values[valid], trials["objective_2"].values[valid], ".", color=ALL, markersize=3)
    axes.errorbar(front["objective_1"], front["objective_2"], front["objective_2_err"], front["objective_1_err"], fmt="o",
                  color=FRONT, ecolor=to_rgba(FRONT, 0.3), markersize=3, linewidth=0.7)
    axes.plot(best["objective_1"], best["objective_2"], "d", color=BEST, markerfacecolor="white", zorder=4)
    axes.errorbar(brush["objective_1"], brush["objective_2"], brush["objective_2_err"], brush["objective_1_err"], fmt="d", color=BEST,
                  linewidth=0.7, zorder=5)
    axes.set_xlabel(objective_label(trials, 1))
    axes.set_ylabel(objective_label(trials, 2))


def objective_label(group, number):
    """The symbol and the unit of an objective's variable, and the statistic over the tolerances."""
    variable = group[f"objective_{number}"]
    text = attribute(variable, "long_name").split(":")[0]
    statistic = text[text.rindex("(") + 1:-1] + " of " if text.endswith(")") else ""
    return statistic + label(variable)


def draw_profile(axes, profile, name, place, margin):
    x, y, error = (profile[key].values for key in (name, "objective_1", "objective_1_err"))
    at = float(x[place])
    jumps = [at * (1 + change) for change in (-margin.margin_below, margin.margin_above) if np.isfinite(change)]
    line, value, band = (np.insert(numbers, np.searchsorted(x, jumps), np.nan) for numbers in (x, y, error))
    axes.fill_between(line, value - band, value + band, color=FRONT, alpha=0.25, linewidth=0)
    axes.plot(line, value, color=FRONT, linewidth=1.2)
    axes.axvline(at, color=BEST, linewidth=0.8)
    for jump in jumps:
        axes.axvline(jump, color=JUMP, linestyle="--", linewidth=1)
    axes.plot(at, y[place], "d", color=BEST)
    axes.xaxis.set_major_locator(value_ticks(5))
    title_axis(axes, "x", profile[name])
    axes.set_ylabel("nominal " + label(profile["objective_1"]))


def draw_indices(axes, indices, trials):
    inputs = [str(name) for name in indices["input"].values]
    width = 0.8 / indices.sizes["objective"]
    for i, look in zip(range(indices.sizes["objective"]), bar_looks()):
        at = np.arange(len(inputs)) - 0.4 + (i + 0.5) * width
        one = indices.isel(objective=i)
        axes.bar(at, np.nan_to_num(one["ST"]), width * 0.9, yerr=np.nan_to_num(one["ST_err"]), error_kw={"linewidth": 0.8}, **look,
                 label=label(trials[f"objective_{i + 1}"]))
    axes.set_xticks(range(len(inputs)), [f"${attribute(trials[name], 'symbol')}$" for name in inputs], fontsize=points(10))
    axes.set_ylabel("total Sobol index\nover the tolerances")
    axes.legend(frameon=False)
