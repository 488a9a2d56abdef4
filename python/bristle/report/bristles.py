"""The recorded bristles beside the handle of Figure 4: their passages, thinned, with the places of their points on its axes."""

from itertools import product

import numpy as np

from ..errors import BristleError
from ..figures.fig2 import read_passages
from ..results import as_text, axis_names, axis_values, dataset, experiment, place_of, point_numbers, read, setting

NAME, GRID, PLAYED = "bristles", "fig4", "fig2"
PARAMETERS = ["model", "si", "friction_law", "load", "orientation", "integrator"]  # of an experiment
ROWS = 100  # of a passage
FORCE = 0.3  # of a length of the bristle: what the largest force counts as, where lines deviate
DIGITS = {"xi": 4, "x": 3, "y": 3, "z": 3, "F_n": 3, "F_fx": 3, "F_fy": 3}


def played(results):
    """The length of the slab and the passages of Figure 2 for the page's players; None without its result."""
    file = next((file for file in results if as_text(file.attrs["name"]) == PLAYED), None)
    if file is None:
        return None
    passages = []
    for at, point, gap in points_of(file):
        passages += [{"model": at["bending"], "z_0": gap, **thinned(passage)} for passage in read_passages(file, [point])[0]]
    return {"slab": setting(file, "model", "L_x"), "passages": passages}


def points_of(file):
    """Of each point of a result: the values of its axes by name, its number and its gap."""
    axes = axis_names(dataset(file, "status"))
    places = product(*(axis_values(file, name) for name in axes))
    return [(dict(zip(axes, values)), point, gap)
            for values, point, gap in zip(places, np.ravel(point_numbers(file)), np.ravel(read(file, "z_0")))]


def recorded(results):
    """The length of the slab and the passages for the page; None if one of the two results is missing."""
    files = {as_text(file.attrs["name"]): file for file in results}
    if not {NAME, GRID} <= set(files):
        return None
    file, grid = files[NAME], files[GRID]
    require_same_points(file, grid)
    columns = {name: list(axis_values(grid, name)) for name in ("k_r", "k_theta")}
    passages = []
    for at, point, gap in points_of(file):
        place = {"model": at["bending"], "z_0": gap, **{name: line.index(at[name]) for name, line in columns.items()}}
        passages += [{**place, **thinned(passage)} for passage in read_passages(file, [point])[0]]
    return {"slab": setting(file, "model", "L_x"), "passages": passages}


def require_same_points(file, grid):
    """Raises BristleError unless the points are points of Figure 4: parameters, values of the axes and gaps are equal."""
    where = f"{place_of(file)} is not at points of {place_of(grid)}"
    for name in PARAMETERS:
        if experiment(file).get(name) != experiment(grid).get(name):
            raise BristleError(f"{where}: they differ in /{name} of their experiments")
    axes = axis_names(dataset(grid, "z_0"))
    if axis_names(dataset(file, "z_0")) != axes:
        raise BristleError(f"{where}, which has the axes {', '.join(axes)}")
    for name in axes:
        if missing := set(axis_values(file, name)) - set(axis_values(grid, name)):
            raise BristleError(f"{where}, which lacks {name} = {', '.join(map(str, sorted(missing)))}")
    gaps = dataset(grid, "z_0").sel({name: dataset(file, name) for name in axes})
    if not np.array_equal(gaps, read(file, "z_0"), equal_nan=True):
        raise BristleError(f"{where}: the gaps differ; `make {GRID} {NAME}` computes both")


def thinned(passage):
    """The rows with which lines between them deviate least from all: the farthest is added until there are enough."""
    numbers = np.array([passage.numbers[name] for name in DIGITS])
    units = [max(abs(row).max(), 1) / FORCE if name.startswith("F") else 1 for name, row in zip(DIGITS, numbers)]
    xi, *scaled = numbers / np.transpose([units])
    last = len(xi) - 1
    kept = {0, last, *np.flatnonzero(passage.phase[1:] != passage.phase[:-1]) + 1}
    while len(kept) < min(ROWS, last + 1):
        rows = sorted(kept)
        off = sum(abs(row - np.interp(xi, xi[rows], row[rows])) for row in scaled)
        off[rows] = -1
        kept.add(np.argmax(off))
    rows = sorted(kept)
    return {"theta_0": passage.theta_0, "phase": passage.phase[rows].tolist(),
            **{name: np.round(row[rows], DIGITS[name]).tolist() for name, row in zip(DIGITS, numbers)}}
