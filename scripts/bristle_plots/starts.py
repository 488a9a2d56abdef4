"""How the bristles yield to the slab that comes down on them: where a sweep crosses the limit, a figure names it."""

import numpy as np

from .results import axis_names, axis_values, dataset, flags, values

CRUSHED = "Bristles are crushed upright, not bent, as the slab comes down"


def start_note(file):
    """Where along the first axis on which it depends bristles are crushed upright; empty if all are bent."""
    if "start" not in file:
        return ""
    words, numbers = flags(dataset(file, "start"))
    crushed = np.asarray(numbers) == list(words).index("crushed")
    if not crushed.any():
        return ""
    names = axis_names(dataset(file, "start"))
    if "k_r" not in names:
        return f"{CRUSHED}, at {crushed.sum()} of {crushed.size} points."
    stiffness, along = axis_values(file, "k_r"), names.index("k_r")
    lines = np.moveaxis(crushed, along, -1)
    others = [name for name in names if name != "k_r"]
    limits = {}
    for index in np.ndindex(lines.shape[:-1]):
        line = lines[index]
        if not line.any():
            continue
        last = np.flatnonzero(line)[-1]
        where = "at all k_r" if line.all() else f"for k_r up to {stiffness[last]:.3g}"
        limits.setdefault(where, set()).add(index)
    return f"{CRUSHED}: {'; '.join(where + of_lines(file, others, lines.shape, found) for where, found in limits.items())}."


def of_lines(file, names, shape, found):
    """The values of the axes on which it depends, as a text."""
    parts = []
    for at, name in enumerate(names):
        line, here = axis_values(file, name), sorted({index[at] for index in found})
        if len(here) < shape[at]:
            parts.append(f"{name} = {', '.join(f'{line[i]:.4g}' if not isinstance(line[i], str) else line[i] for i in here)}")
    return f" ({'; '.join(parts)})" if parts else ""
