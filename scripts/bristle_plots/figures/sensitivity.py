"""Sobol indices of variables over a sample, and the variables over the parameter that matters most."""

import numpy as np

from .. import style
from ..curves import log_axis, title_axis
from ..errors import BristleError
from ..layout import Cell, across, corners, heading, legend_at_foot, place_cell, sheet
from ..page import lettered, paper_width
from ..readings import one_page, reading_name, readings
from ..results import dataset, place_of, table, table_with
from ..style import bar_looks, label, looks

AXES = ["sample"]
LEGEND_INCHES = 0.3
NOTE = ("Bars: total indices, a parameter's share of the variance with all its interactions; circles: first-order indices, its "
        "share on its own. Error bars: standard errors by bootstrap.{}")
DOTS = ("Dots: the points of the sample, circles, squares and triangles in the order of the models, with the design's further points "
        "pale. A model with two branches has two clouds.")


def MARKS(file):
    indices = table(file, "indices")
    return f"{NOTE.format('' if indices is None else left_out(indices))} {DOTS}"


@one_page
def draw(file):
    indices = table(file, "indices")
    if indices is None:
        raise BristleError(f"{place_of(file)}: has no group indices; the experiment needs "
                           '"analysis": {"sobol_indices": [...]}, and its file is opened by open_result(PATH)')
    table_with(file, "indices", "S1", "S1_err", "ST", "ST_err", "blocks")
    outputs = [str(name) for name in indices["output"].values]
    # The bars of all outputs first, then the dots.
    panels = lettered([(kind, output) for kind in (draw_indices, draw_dots) for output in outputs])
    cell, columns = across(min(len(panels), len(outputs)), Cell(5.6, 3.6, 1.0, 0.6, 4.3, 2.7), 0.5)
    below = LEGEND_INCHES if paper_width() is None else 0  # of the legend
    rows = -(-len(panels) // columns)
    figure, bottom = sheet(file, cell.width * columns, cell.height * rows + below, f"{NOTE.format(left_out(indices))}\n{DOTS}")
    for (letter, (draw_panel, output)), corner in zip(panels, corners(len(panels), columns, cell, bottom + below)):
        axes = place_cell(figure, corner, cell)
        heading(axes, letter, *draw_panel(axes, file, output, indices.sel(output=output)))
    handles, texts = figure.axes[0].get_legend_handles_labels()
    legend_at_foot(figure, dict(zip(texts, handles)), bottom + below / 3)
    return figure


def symbol(file, name):
    return style.symbol(dataset(file, "R_n_target" if name == "R_n" and "R_n_target" in file else name))


def left_out(indices):
    """A sentence on blocks of the design that have points without values."""
    blocks = indices["blocks"].values
    return "" if blocks.min() == blocks.max() else f" From {blocks.min()} to {blocks.max()} blocks without missing values."


def largest(indices):
    """The parameter with the largest total index, of the sum over the models."""
    total = indices["ST"].values.reshape(-1, indices.sizes["input"]).sum(axis=0)
    return str(indices["input"].values[int(np.nanargmax(total))])


def draw_indices(axes, file, output, indices):
    """Bars of one output; returns the panel's title."""
    inputs, models = [str(name) for name in indices["input"].values], readings(file)
    width = 0.8 / len(models)
    for i, (model, look) in enumerate(zip(models, bar_looks())):
        at = np.arange(len(inputs)) - 0.4 + (i + 0.5) * width
        of_model = indices.isel(bending=i) if "bending" in indices.dims else indices
        axes.bar(at, of_model["ST"], width * 0.9, yerr=of_model["ST_err"], **look,
                 error_kw={"linewidth": 0.8}, label=reading_name(model) or "total index")
        axes.errorbar(at, of_model["S1"], of_model["S1_err"], fmt="o", markersize=3.5, color="black", markerfacecolor="white",
                      linewidth=0.8)
    axes.axhline(0, color="black", linewidth=0.6)
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, -0.5), min(high, 1.5))  # errors of few blocks are large
    axes.set_xticks(range(len(inputs)), [symbol(file, name) for name in inputs])
    axes.set_ylabel("share of the variance")
    return [f"Sobol indices of {symbol(file, output)}"]


def draw_dots(axes, file, output, indices):
    """The output over the parameter that matters most; returns that there is no title, and what the panel shows."""
    parameter = largest(indices)
    x = dataset(file, parameter).values
    independent = np.arange(x.size) % (indices.sizes["input"] + 2) < 2
    for model, look in looks(readings(file)):
        y = dataset(file, output).sel(model).values
        style = dict(linestyle="", marker=look.marker, color=look.colour, markeredgewidth=0)
        axes.plot(x[~independent], y[~independent], markersize=1.8, alpha=0.15, **style)
        axes.plot(x[independent], y[independent], markersize=3, alpha=0.8, label=reading_name(model), **style)
    if x.min() > 0 and x.max() / x.min() > 8:
        log_axis(axes, "x", dataset(file, parameter))
    else:
        title_axis(axes, "x", dataset(file, parameter))
    axes.set_ylabel(label(dataset(file, output)))
    return "", [f"{symbol(file, output)} over {symbol(file, parameter)}"]
