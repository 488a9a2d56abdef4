"""Where the loading path jumps from one gap to another, or bristles from contact to bouncing: no line may join the two sides."""

from collections import namedtuple

import numpy as np

from ..results import as_text, axis_names, axis_values, dataset, flags, read, select, table, whole

# index: of the point before the jump. place: the value of the axis, within 1 %.
# start, end: of the ambiguous points around the place; equal to it if there are none.
Jump = namedtuple("Jump", "index place start end")

LEAST_CHANGE = 0.15  # of z_0 between neighbouring points
WIDEST_STEP = 0.1  # decades between neighbours; a coarser grid cannot tell a jump from a slope


def jumps_between_neighbours(z_0, x, axis):
    """Whether the gap jumps between each point and the next along the axis with the values x."""
    x, change = np.asarray(x, dtype=float), np.abs(np.diff(z_0, axis=axis))
    with np.errstate(divide="ignore", invalid="ignore"):
        near = np.abs(np.diff(np.log10(x))) < WIDEST_STEP
    return (change > LEAST_CHANGE) & np.expand_dims(near, [i for i in range(change.ndim) if i != axis])


def phase_changes(file, along):
    """Whether one of each point and the next along the axis is in contact and the other bouncing; None without phases over the axis."""
    if "phase" not in file or along not in axis_names(dataset(file, "phase")):
        return None
    words, numbers = flags(dataset(file, "phase"))
    sides = np.array([{"contact": 1, "bouncing": -1}.get(word, 0) for word in words])[numbers]
    return abs(dataset(file, "phase").copy(data=sides).diff(along)) == 2


def located_axis(file):
    """The axis along which the run located the jumps; None if it located none."""
    jumps = table(file, "jumps")
    return None if jumps is None else as_text(jumps.attrs["along"])


def located_jumps(file, along, **chosen):
    """Each Jump that the run located, at the chosen values of the axes beside `along`; its index is over the axes `along`.

    Jumps to or from points without a gap are left out.
    """
    jumping, everything = located_axis(file), whole(file)
    lines = {name: axis_values(everything, name) for name in axis_names(dataset(everything, "status"))}
    here = {name: np.asarray(axis_values(file, name)) for name in lines}
    places = np.sqrt(read(file, "jumps/before") * read(file, "jumps/after"))
    finite = np.isfinite(read(file, "jumps/z_0_before") + read(file, "jumps/z_0_after"))
    found = []
    before, after, start, end = (read(file, f"jumps/{name}") for name in ("before", "after", "from", "to"))
    decided = (start == before) & (end == after)
    start, end = np.where(decided, places, start), np.where(decided, places, end)
    rows = np.transpose([read(file, "jumps/point"), places, start, end])[finite]
    for point, place, start, end in rows:
        at = dict(zip(lines, np.unravel_index(int(point), [len(line) for line in lines.values()])))
        at = {name: lines[name][i] for name, i in at.items()}
        # The Dataset may be a part of the file: the jump may lie between points that are no neighbours there.
        index = {name: np.flatnonzero(here[name] == value) for name, value in at.items()}
        index[jumping] = np.flatnonzero(here[jumping] < place)[-1:]
        inside = index[jumping].size and index[jumping][0] + 1 < len(here[jumping])
        if inside and all(i.size for i in index.values()) and all(at[name] == value for name, value in chosen.items()):
            found.append(Jump(tuple(int(index[name][0]) for name in along), float(place), float(start), float(end)))
    return found


def breaks_on_line(file, along, **chosen):
    """Whether a line over the axis, at the chosen values of the others, is broken between each point and the next."""
    jumps, changes = read_jumps(file, [along], **chosen)[0], phase_changes(file, along)
    return jumps if changes is None else jumps | select(changes, [along], **chosen)


def has_breaks(file, along):
    """Whether a line over this axis is broken at any values of the others."""
    changes = phase_changes(file, along)
    if changes is not None and changes.any():
        return True
    if located_axis(file) == along:
        return bool(located_jumps(file, [along]))
    if "z_0" not in file or along not in axis_names(dataset(file, "z_0")):
        return False
    axis = axis_names(dataset(file, "z_0")).index(along)
    return bool(jumps_between_neighbours(read(file, "z_0"), axis_values(file, along), axis).any())


def read_jumps(file, along, **chosen):
    """For each of the axes `along`, whether z_0 jumps between neighbours; never in a file without z_0 over them."""
    axes = [axis_values(file, name) for name in along]
    if "z_0" not in file or not set(along) <= set(axis_names(dataset(file, "z_0"))):
        return [jumps_between_neighbours(np.zeros([len(line) for line in axes]), line, axis)
                for axis, line in enumerate(axes)]
    z_0 = select(dataset(file, "z_0"), along, **chosen)
    found = [jumps_between_neighbours(z_0, line, axis) for axis, line in enumerate(axes)]
    if located_axis(file) in along:
        here = found[along.index(located_axis(file))]
        here[...] = False
        for jump in located_jumps(file, along, **chosen):
            here[jump.index] = True
    return found
