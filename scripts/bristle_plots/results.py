"""Reading result files: datasets and attributes, values at chosen points of a sweep, flags, the experiment.

This uses h5py alone. xarray would do the selection, but it adds 0.13 s to the 0.25 s that a figure's imports
take, and `make fig4` would have to install xarray and pandas, 42 MB unpacked.
"""

import json
import os

import h5py
import numpy as np

from .errors import BristleError
from .integrity import require_intact

SCHEMAS = ["bristle-result/1", "bristle-result/2"]  # in version 1 the axes of choices have codes
RENAMED_FLAGS = {"jump": "load_jump"}  # words in files of older programs

# Names of choices in figures.
CHOICE_NAMES = {"nss": "NSS", "coulomb": "Amontons\u2013Coulomb", "stribeck": "exponential Stribeck"}
CHOICE_NAMES |= {"kinematic": "Eq. (17) exact", "as_printed": "Eq. (17) as printed"}


def open_result(path):
    """The result file, open for reading: one that could be read and whose digests match."""
    if os.path.isdir(path):
        raise BristleError(f"{path}: a folder, not a result file")
    if not os.path.exists(path):
        raise BristleError(f"{path}: no such file; `bristle run EXPERIMENT.json -o {path}` writes it")
    if not os.path.isfile(path):
        raise BristleError(f"{path}: a device, pipe or socket, not a result file")
    if not os.access(path, os.R_OK):
        raise BristleError(f"{path}: no permission to read it")
    if not h5py.is_hdf5(path):
        raise BristleError(f"{path}: not an HDF5 file")
    require_intact(path)
    try:
        file = h5py.File(path, "r")
    except OSError as error:
        raise BristleError(f"{path}: damaged HDF5 file ({error})") from error
    schema = as_text(file.attrs.get("schema_version", ""))
    if schema.startswith("bristle-part/"):
        shard, name = (as_text(file.attrs.get(key, "?")) for key in ("shard", "name"))
        raise BristleError(f"{path}: a part ({shard}) of {name}; merge the parts first: "
                           "bristle merge -o FILE.h5 PARTS...")
    if schema not in SCHEMAS:
        raise BristleError(f"{path}: schema version {schema or 'none'}; this script reads {', '.join(SCHEMAS)}")
    return file


def place_of(data):
    """File and name of a dataset, for error messages."""
    return f"{data.file.filename}: dataset '{data.name}'"


def dataset(group, name):
    """The dataset `name` of the file or group."""
    found = group.get(name)
    if not isinstance(found, h5py.Dataset):
        present = ", ".join(key for key in group if not key.endswith("_err"))
        raise BristleError(f"{group.file.filename}: no dataset '{group.name.rstrip('/')}/{name}'; "
                           f"{group.name} has: {present or 'none'}")
    return found


def read(group, name):
    """The values of the dataset `name` of the file or group."""
    return values(dataset(group, name))


def values(data):
    try:
        return data[()]
    except OSError as error:
        raise BristleError(f"{place_of(data)} is damaged ({error})") from error


def as_text(value):
    """A string from HDF5, where it may be bytes, str or an array of one of them."""
    if isinstance(value, np.ndarray):
        value = value.ravel()[0]
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def attribute(data, name):
    """The attribute as a string."""
    if name not in data.attrs:
        raise BristleError(f"{place_of(data)} has no attribute '{name}'")
    return as_text(data.attrs[name])


def constant(data, name):
    """A numeric attribute: a constant of the model that the file states for plots."""
    if name not in data.attrs:
        raise BristleError(f"{place_of(data)} has no attribute '{name}'; it is of an older program: "
                           "compute it again with `bristle run --force`")
    return float(data.attrs[name])


def experiment(file):
    """The experiment (JSON) that the file was computed from."""
    return json.loads(as_text(file.attrs.get("experiment", "{}")))


def setting(file, *path):
    """A value of the experiment."""
    value = experiment(file)
    for key in path:
        if not isinstance(value, dict) or key not in value:
            raise BristleError(f"{file.filename}: attribute 'experiment' has no /{'/'.join(path)}")
        value = value[key]
    return value


def flags(data):
    """The words of a dataset of flags, and its values as indices into them."""
    words = [RENAMED_FLAGS.get(word, word) for word in attribute(data, "flag_meanings").split()]
    codes = np.atleast_1d(data.attrs.get("flag_values", [])).tolist()
    if not codes or len(codes) != len(words):
        raise BristleError(f"{place_of(data)}: attribute 'flag_values' has {len(codes)} values for "
                           f"{len(words)} flag_meanings")
    numbers = values(data)
    if not np.isin(numbers, codes).all():
        raise BristleError(f"{place_of(data)} has values that are not in its flag_values")
    return words, np.vectorize(codes.index, otypes=[int])(numbers)


def axis_values(file, name):
    """The values of an axis of the sweep: numbers, or the words of a choice."""
    data = dataset(file, name)
    if "flag_meanings" in data.attrs:
        words, numbers = flags(data)
        return [words[i] for i in np.atleast_1d(numbers)]
    if data.dtype.kind == "O":
        return [as_text(word) for word in values(data)]
    return np.atleast_1d(values(data))


def axis_names(data):
    return [scales[0].name.strip("/") if len(scales) else "(no scale)" for scales in data.dims]


def axis_index(file, name, value):
    """Index of the value or word on the axis."""
    found = [i for i, here in enumerate(axis_values(file, name)) if here == value]
    if not found:
        present = ", ".join(map(str, axis_values(file, name)))
        raise BristleError(f"{file.filename}: axis '{name}' has no {value}; it has: {present}")
    return found[0]


def point_index(file, **chosen):
    """Index of a point of the sweep (the last axis fastest) from its value on every axis."""
    status = dataset(file, "status")
    index = select_index(status, [], chosen)
    return int(np.ravel_multi_index(index, status.shape)) if index else 0


def select_index(data, along, chosen):
    order = axis_names(data)
    if sorted(order) != sorted([*along, *chosen]):
        raise BristleError(f"{place_of(data)} is over ({', '.join(order)}); "
                           f"this figure needs ({', '.join([*along, *chosen])})")
    return tuple(axis_index(data.file, name, chosen[name]) if name in chosen else slice(None) for name in order)


def select(data, along, numbers=None, **chosen):
    """The values over the axes `along`, in this order; chosen: the value or word on each other axis.

    numbers: array of the dataset's shape to select from, if not the dataset's values.
    """
    numbers = values(data) if numbers is None else numbers
    index = select_index(data, along, chosen)
    left = [name for name in axis_names(data) if name not in chosen]
    return numbers[index].transpose([left.index(name) for name in along])


def select_flags(file, name, along, **chosen):
    """The words of a dataset of flags, and the index of each point's word."""
    data = dataset(file, name)
    words, numbers = flags(data)
    return words, select(data, along, numbers, **chosen)


def select_errors(file, name, along, **chosen):
    """The estimated errors of a variable; NaN if it has none."""
    if f"{name}_err" in file:
        return select(dataset(file, f"{name}_err"), along, **chosen)
    return np.full(select(dataset(file, name), along, **chosen).shape, np.nan)


def readable(flag):
    """A flag's word as the documents print it."""
    return flag.replace("_", " ")


def status_counts(file):
    """(status, number of points) for each status that occurs, without absent points."""
    words, codes = flags(dataset(file, "status"))
    counts = np.bincount(np.ravel(codes), minlength=len(words))
    return [(readable(word), int(n)) for word, n in zip(words, counts) if n and word != "absent"]
