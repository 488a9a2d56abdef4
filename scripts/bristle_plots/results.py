"""Variables over named axes: picking values of some axes, ordering the others."""

import json

import numpy as np

from style import attribute, dataset, fail, text, values

NAMES = {"nss": "NSS", "coulomb": "Amontons\u2013Coulomb", "stribeck": "exponential Stribeck"}  # of choices, as the figures show them


def where(data):
    return f"{data.file.filename}: dataset '{data.name}'"


def flags(data):
    """The words of a dataset of flags, and its numbers as indices into them."""
    words = attribute(data, "flag_meanings").split()
    codes = np.atleast_1d(data.attrs.get("flag_values", [])).tolist()
    if not codes or len(codes) != len(words):
        fail(f"{where(data)}: attribute 'flag_values' has {len(codes)} values for {len(words)} flag_meanings")
    numbers = values(data)
    if not np.isin(numbers, codes).all():
        fail(f"{where(data)} has values that are not in its flag_values")
    return words, np.vectorize(codes.index, otypes=[int])(numbers)


def axis(file, name):
    """The values of an axis: numbers, or the words of a choice."""
    data = dataset(file, name)
    if "flag_meanings" in data.attrs:
        words, numbers = flags(data)
        return [words[i] for i in np.atleast_1d(numbers)]
    return np.atleast_1d(values(data))


def axis_names(data):
    return [scales[0].name.strip("/") if len(scales) else "(no scale)" for scales in data.dims]


def over(data, names, chosen=None, numbers=None):
    """The values with axes in the order of `names`, whatever the order of the sweep.

    chosen: the value or word to take on each of the other axes; numbers: instead of the dataset's own.
    """
    chosen = chosen or {}
    order = axis_names(data)
    if sorted(order) != sorted([*names, *chosen]):
        fail(f"{where(data)} is over ({', '.join(order)}); "
             f"this figure needs ({', '.join([*names, *chosen])})")
    numbers = values(data) if numbers is None else numbers
    index = tuple(position(data.file, name, chosen[name]) if name in chosen else slice(None)
                  for name in order)
    left = [name for name in order if name not in chosen]
    return numbers[index].transpose([left.index(name) for name in names])


def position(file, name, value):
    """Where on the axis the value or word is."""
    line = axis(file, name)
    found = [i for i, here in enumerate(line) if here == value]
    if not found:
        fail(f"{file.filename}: axis '{name}' has no {value}; it has: {', '.join(map(str, line))}")
    return found[0]


def statuses(file, names, chosen=None):
    """The meanings of the points' status, and the index of each point's; 0 is a point without remark."""
    data = dataset(file, "status")
    words, numbers = flags(data)
    return [word.replace("_", " ") for word in words], over(data, names, chosen, numbers)


def errors(file, name, names, chosen=None):
    """The estimated errors of a variable; not-a-number if it has none."""
    if f"{name}_err" in file:
        return over(dataset(file, f"{name}_err"), names, chosen)
    return np.full(over(dataset(file, name), names, chosen).shape, np.nan)


def setting(file, *path, default=None):
    """A value of the experiment that is stored in the file."""
    value = json.loads(text(file.attrs.get("experiment", "{}")))
    for key in path:
        if not isinstance(value, dict) or key not in value:
            if default is None:
                fail(f"{file.filename}: attribute 'experiment' has no /{'/'.join(path)}")
            return default
        value = value[key]
    return value
