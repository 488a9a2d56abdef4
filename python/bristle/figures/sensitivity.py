"""Sobol indices of variables over a sample, and the variables over the parameter that matters most, at each point of
the other axes."""

from itertools import product

import numpy as np

from ..errors import BristleError
from ..plotting import style
from ..plotting.curves import log_axis, title_axis
from ..plotting.layout import Cell, across, corners, heading, legend_at_foot, place_cell, sheet
from ..plotting.lift_off import PHASES
from ..plotting.page import lettered, paper_width, points
from ..plotting.readings import AXIS, one_page, reading_name, readings
from ..plotting.style import bar_looks, label, looks
from ..results import axis_names, axis_values, dataset, flags, place_of, readable, table, table_with

AXES = ["sample"]
STATUSES = False  # no point is marked
LEGEND_INCHES = 0.3
MOST_DOTS = 2_000  # that are drawn as vectors
NOTE = ("Bars: total indices, a parameter's share of the variance with all its interactions; circles: first-order indices, its "
        "share on its own. Error bars: standard errors by bootstrap.{}")
DOTS = "Dots: the points of the sample{}, coloured by phase, with the design's further points pale."


def MARKS(file):
    indices = table(file, "indices")
    return f"{NOTE.format('' if indices is None else left_out(file, indices))} {dots_note(file)}"


def dots_note(file):
    model = reading_name(dots_model(file))
    return DOTS.format(f" ({model})" if model else "")


def dots_model(file):
    """The model of the dots: the last one, of rods if it is there."""
    return readings(file)[-1]


@one_page
def draw(file):
    indices = table(file, "indices")
    if indices is None:
        raise BristleError(f"{place_of(file)}: has no group indices; the experiment needs "
                           '"analysis": {"sobol_indices": [...]} (in Python, open the file by open_result)')
    table_with(file, "indices", "S1", "S1_err", "ST", "ST_err", "blocks")
    wanted = list(product([str(name) for name in indices["output"].values], places(file)))
    # All bars first, then the dots.
    panels = lettered([(kind, output, place) for kind in (draw_indices, draw_dots) for output, place in wanted])
    cell, columns = across(min(len(panels), len(wanted)), Cell(5.6, 3.6, 1.0, 0.6, 4.3, 2.7), 0.5)
    below = LEGEND_INCHES if paper_width() is None else 0  # of the legend
    rows = -(-len(panels) // columns)
    figure, bottom = sheet(file, cell.width * columns, cell.height * rows + below, f"{NOTE.format(left_out(file, indices))}\n{dots_note(file)}")
    for (letter, (draw_panel, output, place)), corner in zip(panels, corners(len(panels), columns, cell, bottom + below)):
        axes = place_cell(figure, corner, cell)
        what, at = draw_panel(axes, file, output, indices.sel(output=output).isel(place), place), place_text(file, place)
        heading(axes, letter, at[2:] if draw_panel is draw_dots else what + at, [what + at])
    handles, texts = next(axes for axes in figure.axes if hasattr(axes, "panel")).get_legend_handles_labels()
    legend_at_foot(figure, dict(zip(texts, handles)), bottom + below / 3)
    return figure


def places(file):
    """The points of the axes besides the sample and the models, each as the number of its value on each axis."""
    axes = [name for name in axis_names(dataset(file, "status")) if name not in (*AXES, AXIS)]
    return [dict(zip(axes, numbers)) for numbers in product(*(range(len(axis_values(file, name))) for name in axes))]


def place_text(file, place):
    """", k_r = 5, friction = nss" in symbols."""
    def value(name, number):
        one = axis_values(file, name)[number]
        return readable(one) if isinstance(one, str) else f"{one:.4g}"

    return "".join(f", {symbol(file, name)} = {value(name, number)}" for name, number in place.items())


def symbol(file, name):
    return style.symbol(dataset(file, "R_n_target" if name == "R_n" and "R_n_target" in file else name))


def left_out(file, indices):
    """A sentence on blocks of the design that lack values of total indices."""
    blocks, total = indices["blocks"].values, dataset(file, "sample").size // (indices.sizes["input"] + 2)
    fewest, most = blocks.min(), blocks.max()
    if fewest == total:
        return ""
    return f" From {most if fewest == most else f'{fewest} to {most}'} of {total} blocks, as the others lack values."


def phases(file, output, place):
    """By phase, which points of the sample are in it and have a value of the output; without phases that have none."""
    valued = np.isfinite(dataset(file, output).isel(place).sel(dots_model(file)).values)
    words, numbers = flags(dataset(file, "phase").isel(place).sel(dots_model(file)))
    found = {word: valued & (numbers == i) for i, word in enumerate(words)}
    return {word: here for word, here in found.items() if here.any()}


def largest(indices):
    """The parameter with the largest total index, of the sum over the models."""
    total = np.nansum(indices["ST"].values.reshape(-1, indices.sizes["input"]), axis=0)
    return str(indices["input"].values[int(np.argmax(total))])


def draw_indices(axes, file, output, indices, _place):
    """Bars of one output; returns what the panel shows."""
    inputs, models = [str(name) for name in indices["input"].values], readings(file)
    width = 0.8 / len(models)
    for i, (model, look) in enumerate(zip(models, bar_looks())):
        at = np.arange(len(inputs)) - 0.4 + (i + 0.5) * width
        of_model = indices.isel(bending=i) if "bending" in indices.dims else indices
        # An index without a value has no bar and no circle.
        axes.bar(at, np.nan_to_num(of_model["ST"]), width * 0.9, yerr=np.nan_to_num(of_model["ST_err"]), **look,
                 error_kw={"linewidth": 0.8}, label=reading_name(model) or "total index")
        first, error = of_model["S1"].values, of_model["S1_err"].values
        shown = np.isfinite(first)
        axes.errorbar(at[shown] + width / 5, first[shown], error[shown], fmt="o", markersize=3.5, color="black", markerfacecolor="white",
                      linewidth=0.8)
    axes.axhline(0, color="black", linewidth=0.6)
    if np.isnan(indices["ST"].values).all():
        axes.text(0.5, 0.5, "no index: too few points have a value", transform=axes.transAxes, ha="center")
        axes.set_ylim(0, 1)
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, -0.5), min(high, 1.5))  # errors of few blocks are large
    axes.set_xticks(range(len(inputs)), [symbol(file, name) for name in inputs], fontsize=points(10))
    axes.set_ylabel("share of the variance")
    return f"Sobol indices of {symbol(file, output)}"


def draw_dots(axes, file, output, indices, place):
    """The output over the parameter that matters most; returns what the panel shows."""
    parameter = largest(indices)
    data = dataset(file, parameter)
    words, x = flags(data) if "flag_meanings" in data.attrs else ([], data.values)
    if words:
        present, x = np.unique(x, return_inverse=True)
    independent = np.arange(x.size) % (indices.sizes["input"] + 2) < 2
    y = dataset(file, output).isel(place).sel(dots_model(file)).values
    for (phase, here), look in looks(phases(file, output, place).items()):
        style = dict(linestyle="", marker=look.marker, color=look.colour, markeredgewidth=0)
        axes.plot(x[here & ~independent], y[here & ~independent], markersize=1.8, alpha=0.15, rasterized=x.size > MOST_DOTS, **style)
        axes.plot(x[here & independent], y[here & independent], markersize=3, alpha=0.8, label=PHASES.get(phase, phase), **style)
    axes.legend(loc="best", markerscale=1.5)
    if not words and x.min() > 0 and x.max() / x.min() > 8:
        log_axis(axes, "x", data)
    else:
        title_axis(axes, "x", data)
    if words:
        axes.set_xticks(range(len(present)), [readable(words[number]) for number in present])
        axes.set_xlim(-0.5, len(present) - 0.5)
    axes.set_ylabel(label(dataset(file, output)))
    return f"{symbol(file, output)} over {symbol(file, parameter)}"
