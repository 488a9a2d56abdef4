"""Where the loading path jumps from one gap to another: no line or face may join the two sides."""

import numpy as np

from .results import as_text, axis_names, axis_values, dataset, read, select, select_index

LEAST_CHANGE = 0.15  # of z_0 between neighbouring points
WIDEST_STEP = 0.1  # decades between neighbours; a coarser grid cannot tell a jump from a slope


def jumps_between_neighbours(z_0, x, axis):
    """Whether the gap jumps between each point and the next along the axis with the values x."""
    x, change = np.asarray(x, dtype=float), np.abs(np.diff(z_0, axis=axis))
    with np.errstate(divide="ignore", invalid="ignore"):
        near = np.abs(np.diff(np.log10(x))) < WIDEST_STEP
    return (change > LEAST_CHANGE) & np.expand_dims(near, [i for i in range(change.ndim) if i != axis])


def located_axis(file):
    """The axis along which the run located the jumps; None if it located none."""
    return as_text(file["jumps"].attrs["along"]) if "jumps" in file else None


def located_jumps(file, along, **chosen):
    """(index, place) of each jump that the run located, at the chosen values of the axes beside `along`.

    index: that of the point before the jump, over the axes `along`. place: the value of the axis, within 1 %.
    Jumps to or from points without a gap are left out.
    """
    status, jumps = dataset(file, "status"), file["jumps"]
    order = axis_names(status)
    at = np.unravel_index(read(jumps, "point").astype(int), status.shape)
    wanted = [order.index(name) for name in along]
    fixed = {order.index(name): i for name, i in zip(order, select_index(status, along, chosen)) if name in chosen}
    here = np.isfinite(read(jumps, "z_0_before")) & np.isfinite(read(jumps, "z_0_after"))
    for position, index in fixed.items():
        here &= at[position] == index
    middle = np.sqrt(read(jumps, "before") * read(jumps, "after"))
    return [(tuple(int(at[position][row]) for position in wanted), float(middle[row])) for row in np.flatnonzero(here)]


def read_jumps(file, along, **chosen):
    """For each of the axes `along`, whether z_0 jumps between neighbours; never in a file without z_0 over them."""
    axes = [axis_values(file, name) for name in along]
    if "z_0" not in file or set(axis_names(dataset(file, "z_0"))) != {*along, *chosen}:
        return [jumps_between_neighbours(np.zeros([len(line) for line in axes]), line, axis)
                for axis, line in enumerate(axes)]
    z_0 = select(dataset(file, "z_0"), along, **chosen)
    found = [jumps_between_neighbours(z_0, line, axis) for axis, line in enumerate(axes)]
    if located_axis(file) in along:
        here = found[along.index(located_axis(file))]
        here[...] = False
        for index, _ in located_jumps(file, along, **chosen):
            here[index] = True
    return found
