"""The trials of a design, and what is beside the recommended trial: friction, jumps, tolerances."""

from functools import partial

import numpy as np

from ..errors import BristleError
from ..plotting.curves import title_axis
from ..plotting.layout import Cell, across, corners, heading, place_cell, sheet
from ..plotting.page import lettered, points
from ..plotting.readings import one_page
from ..plotting.style import COLOURS, displayed, label, value_ticks
from ..results import as_text, attribute, place_of, table, table_with

AXES = ["sample"]
STATUSES = False  # no point is marked
ALL, CURVE, BEST, JUMP = "0.6", COLOURS[0], COLOURS[1], "0.35"
MADE = "the recommended brush as it can be made; open diamond: its trial, before it was rounded"
NOTE = ("Grey: trials that meet the constraints; diamond: {}. q95: the value that 95 % of the brushes with deviations stay below. Error bars: errors of the computation and of the few "
        "deviations.\n"
        "Curves: the objective at nominal values over each quantity, the others as recommended, in the scenario where it "
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
    values = ("objective", "objective_err")
    trials = in_units(table_with(file, "trials", "violation", *values))
    if table(file, "best") is None:
        raise BristleError(f"{place_of(file)}: has no recommended trial; `bristle design` writes it if a trial meets the constraints")
    best = in_units(table_with(file, "best", "trial", *values))
    margins = table_with(file, "margins", "value", "margin_below", "margin_above")
    indices = None if table(file, "indices") is None else table_with(file, "indices", "ST", "ST_err")
    quantities = [str(name) for name in margins["quantity"].values]
    brush = made(file)
    panels = [partial(draw_trials, trials=trials, best=best, brush=best if brush is None else in_units(brush))]
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


def draw_trials(axes, trials, best, brush):
    """The objective of all trials over the first constraint, or over the trial's number without one; the recommended trial and brush."""
    valid, over = trials["violation"].values == 0, "constraint_1" if "constraint_1" in trials else "trial"
    axes.plot(trials[over].values[valid], trials["objective"].values[valid], ".", color=ALL, markersize=3)
    axes.plot(best[over], best["objective"], "d", color=BEST, markerfacecolor="white", zorder=4)
    axes.errorbar(best[over] if over == "trial" else brush[over], brush["objective"], brush["objective_err"], fmt="d", color=BEST,
                  linewidth=0.7, zorder=5)
    axes.set_xlabel(attribute(trials[over], "long_name") if over == "constraint_1" else "trial")
    axes.set_ylabel(objective_label(trials))


def objective_label(group):
    """The symbol and the unit of the objective's variable, and the statistic over the tolerances."""
    variable = group["objective"]
    statistic = f"{as_text(variable.attrs['statistic'])} of " if "statistic" in variable.attrs else ""
    return statistic + label(variable)


def draw_profile(axes, profile, name, place, margin):
    x, y, error = (profile[key].values for key in (name, "objective", "objective_err"))
    at = float(x[place])
    jumps = [at * (1 + change) for change in (-margin.margin_below, margin.margin_above) if np.isfinite(change)]
    line, value, band = (np.insert(numbers, np.searchsorted(x, jumps), np.nan) for numbers in (x, y, error))
    axes.fill_between(line, value - band, value + band, color=CURVE, alpha=0.25, linewidth=0)
    axes.plot(line, value, color=CURVE, linewidth=1.2)
    axes.axvline(at, color=BEST, linewidth=0.8)
    for jump in jumps:
        axes.axvline(jump, color=JUMP, linestyle="--", linewidth=1)
    axes.plot(at, y[place], "d", color=BEST)
    axes.xaxis.set_major_locator(value_ticks(5))
    title_axis(axes, "x", profile[name])
    axes.set_ylabel("nominal " + label(profile["objective"]))


def draw_indices(axes, indices, trials):
    inputs = [str(name) for name in indices["input"].values]
    axes.bar(range(len(inputs)), np.nan_to_num(indices["ST"]), 0.7, yerr=np.nan_to_num(indices["ST_err"]), color=CURVE,
             error_kw={"linewidth": 0.8})
    axes.set_xticks(range(len(inputs)), [f"${attribute(trials[name], 'symbol')}$" for name in inputs], fontsize=points(10))
    axes.set_ylabel(f"total Sobol index of {label(trials['objective'])}\nover the tolerances")
