"""What a reader must know of a result: where bristles are crushed upright, where pinned ones carry much of the friction, and
where the model is beyond its limits."""

import numpy as np

from ..results import CHOICE_NAMES, as_text, axis_names, axis_values, dataset, flags

CRUSHED = "Bristles are crushed upright, not bent, as the slab comes down"

PINNED_SHARE = 0.1  # of R_x


def pinned_note(file, reading=None):
    """At how many points bristles that stay pinned at the pole carry more than a tenth of the friction; empty if nowhere.

    reading: the choice of bending to which the note is limited.
    """
    if "pinned_share_R_x" not in file:
        return ""
    share = file["pinned_share_R_x"].sel(reading or {})
    many = share > PINNED_SHARE
    if not many.any():
        return ""
    where = ""
    if "bending" in many.dims:
        words = [str(word) for word in many["bending"].values if many.sel(bending=word).any()]
        where = f" ({', '.join(CHOICE_NAMES.get(word, word) for word in words)})"
    return (f"Bristles that stay pinned upright at the pole carry more than a tenth of the friction at {int(many.sum())} of {many.size} "
            f"points, up to {100 * float(share.max()):.2g} %{where}.")


def validity_note(file, reading=None):
    """At how many of the points with a value the model is beyond each of its limits, see docs/results-format.md; empty if nowhere.

    reading: the choice of bending to which the note is limited.
    """
    found = limits(file, reading)
    parts = [f"{meaning} ({beyond})" for meaning, beyond, _ in found if beyond]
    return f"Beyond limits of the model, of {found[-1][2]} points with a value: {', '.join(parts)}." if parts else ""


def limits_everywhere(file):
    """The limits of the model that every point with a value exceeds, in words."""
    return [meaning for meaning, beyond, judged in limits(file) if beyond == judged > 0]


def limits(file, reading=None):
    """For each limit of the model: what is wrong beyond it, the number of points beyond it and of points with a value."""
    found = []
    for name in (name for name in file if name.startswith("exceeds_")):
        data = file[name].sel(reading or {})
        words = data.attrs["flag_meanings"].split()
        beyond, judged = data == words.index("yes"), data != words.index("unknown")
        found.append((as_text(data.attrs["long_name"]), int(beyond.sum()), int(judged.sum())))
    return found


def start_note(file):
    """Where along the first axis on which it depends bristles are crushed upright; empty if all are bent."""
    if "start" not in file:
        return ""
    words, numbers = flags(dataset(file, "start"))
    crushed, names = np.asarray(numbers) == list(words).index("crushed"), axis_names(dataset(file, "start"))
    if not crushed.any():
        return ""
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
