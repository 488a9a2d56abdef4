"""Where the loading path jumps from one gap to another: no line or face may join the two sides."""

import numpy as np

from .results import axis_names, axis_values, dataset, select

LEAST_CHANGE = 0.15  # of z_0 between neighbouring points
WIDEST_STEP = 0.1  # decades between neighbours; a coarser grid cannot tell a jump from a slope


def jumps_between_neighbours(z_0, x, axis):
    """Whether the gap jumps between each point and the next along the axis with the values x."""
    x, change = np.asarray(x, dtype=float), np.abs(np.diff(z_0, axis=axis))
    with np.errstate(divide="ignore", invalid="ignore"):
        near = np.abs(np.diff(np.log10(x))) < WIDEST_STEP
    return (change > LEAST_CHANGE) & np.expand_dims(near, [i for i in range(change.ndim) if i != axis])


def read_jumps(file, along, **chosen):
    """For each of the axes `along`, whether z_0 jumps between neighbours; never in a file without z_0 over them."""
    axes = [axis_values(file, name) for name in along]
    if "z_0" in file and set(along) <= set(axis_names(dataset(file, "z_0"))):
        z_0 = select(dataset(file, "z_0"), along, **chosen)
    else:
        z_0 = np.zeros([len(values) for values in axes])
    return [jumps_between_neighbours(z_0, values, axis) for axis, values in enumerate(axes)]
