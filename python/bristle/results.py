"""Result files as xarray Datasets: variables, values at chosen points of a sweep, flags, the experiment.

`file` is a Dataset as `as_result` makes it of one that a user opened or selected from: every axis of the sweep is a
dimension, and choices are words. The groups of the file are read from the file that the Dataset was opened from.
"""

import json
import os
from functools import lru_cache

import h5py
import numpy as np
import xarray

from .current import origin
from .errors import BristleError, did_you_mean, is_of_the_system, system_reason
from .integrity import CopiedResult, require_intact

SCHEMA = "bristle-result/2"

# h5netcdf also reads datasets without dimensions.
OPENING = dict(engine="h5netcdf", phony_dims="access")

NUMBERS = "iuf"  # kinds of data; other variables are texts

# Names of choices in figures.
CHOICE_NAMES = {"nss": "NSS", "coulomb": "Coulomb", "hertz": "Hertz"}
CHOICE_NAMES |= {"polar": "corrected", "polar_as_printed": "as printed", "rod": "rod"}

# What a status says of a point, in figures.
STATUS_WORDS = {
    "load jump": "the load jumps here: values behind the jump", "unreachable": "no gap carries this load",
    "incomplete": "a passage did not end", "not converged": "error above its tolerance", "failed": "the computation failed",
    "work limit": "more evaluations than allowed", "ambiguous": "two gaps carry this load",
    "inaccurate": "the energy budget is open by more than 1 %", "undefined": "a ratio to a load or friction of zero"}


def open_result(path):
    """The Dataset of a result file: one that could be read and whose digests match."""
    path = os.fspath(path)
    if os.path.isdir(path):
        raise BristleError(f"{path}: a folder, not a result file")
    if not os.path.exists(path):
        raise BristleError(f"{path}: no such file; `bristle run EXPERIMENT.json -o {path}` writes it")
    if not os.path.isfile(path):
        raise BristleError(f"{path}: a device, pipe or socket, not a result file")
    try:
        with open(path, "rb"):
            pass
    except PermissionError as error:
        raise BristleError(f"{path}: no permission to read it") from error
    except OSError as error:
        raise BristleError(f"{path}: cannot be read: {system_reason(error)}") from error
    if not h5py.is_hdf5(path):
        raise BristleError(f"{path}: not an HDF5 file")
    require_intact(path)
    file = opened(path)
    result = as_result(file)
    result.set_close(file.close)
    return result


def source_of(file, form=""):
    """The digests of the result's payload and of what draws it, and the commit of the program that computed it, as a text."""
    provenance = table(file, "provenance")
    commit = "" if provenance is None else as_text(provenance.attrs.get("commit", provenance.get("commit", "")))
    return origin(file.attrs, commit, form)


def as_result(ds):
    """The Dataset with a dimension for each axis of the sweep, also for an axis with one selected value."""
    if not isinstance(ds, xarray.Dataset):
        raise BristleError(f"a figure is drawn from an xarray Dataset, as open_result(PATH) returns, not from a "
                           f"{type(ds).__name__}")
    require_schema(ds)
    for name, size in ds.sizes.items():
        if size == 0:
            raise BristleError(f"{place_of(ds)}: axis '{name}' has no values")
    return ds.expand_dims([name for name, line in ds.coords.items() if not line.dims])


def require_axes(file, figure, axes):
    """Raises BristleError unless the Dataset has the axes that the figure needs."""
    if missing := [name for name in axes if name not in file.dims]:
        here = ", ".join(file["status"].dims if "status" in file else file.dims)
        raise BristleError(f"{place_of(file)}: figure {figure} needs the axes {', '.join(axes)}; this result has "
                           f"{here or 'none'}, and lacks {', '.join(missing)}")


def require_schema(ds):
    schema = as_text(ds.attrs.get("schema_version", ""))
    if schema != SCHEMA:
        raise BristleError(f"{place_of(ds)}: schema version {schema or 'none'}; these figures read {SCHEMA}")


def place_of(data):
    """Where the data are from, for error messages: the file, and the name of a variable."""
    path = data.encoding.get("source", "the Dataset")
    return f"{path}: dataset '/{data.name}'" if isinstance(data, xarray.DataArray) else path


def table(file, name):
    """A group of the file that the Dataset was opened from, such as checks or trajectories; None if there is none."""
    path = file.encoding.get("source", "")
    return read_group(path, os.stat(path).st_mtime_ns, name) if os.path.isfile(path) else None


def table_with(file, name, *needed):
    """The same, of a group that must have these variables."""
    found = table(file, name)
    if found is None:
        raise BristleError(f"{place_of(file)}: has no group {name}; a Dataset has groups if its file is opened by open_result(PATH)")
    for variable in needed:
        if variable not in found:
            raise BristleError(f"{place_of(file)}: there is no {name}/{variable}")
    return found


@lru_cache(maxsize=256)
def read_group(path, _time, name):
    """The values of a group of the file, "/" for the root; _time: of its last change. None for a copy: it has no tables."""
    try:
        require_intact(path)
    except CopiedResult:
        return None
    with h5py.File(path, "r") as file:
        if name not in file:
            return None
    with opened(path, name) as group:
        return group.load()


def opened(path, group="/"):
    """A group of a file that is intact, but may still not be what netCDF programs expect."""
    try:
        return xarray.open_dataset(path, group=group, **OPENING)
    except (OSError, ValueError, KeyError, TypeError, RuntimeError) as error:
        if is_of_the_system(error):
            raise BristleError(f"{path}: cannot be read: {system_reason(error)}") from error
        raise BristleError(f"{path}: its group {group} cannot be read as netCDF-4 ({error})") from error


def whole(file):
    """The Dataset with all points of the file that this one, perhaps a part of it, was opened from; None without it."""
    found = table(file, "/")
    return None if found is None else as_result(found)


def is_whole(file):
    """Whether the Dataset has all points of its file, which is intact, so that the file's verdicts are about it."""
    with h5py.File(file.encoding["source"], "r") as stored:
        return stored["status"].size == dataset(file, "status").size


def dataset(file, name):
    """The variable `name`, or `table/name`."""
    group, _, column = name.rpartition("/")
    holder = table(file, group) if group else file
    if holder is None:
        raise BristleError(f"{place_of(file)}: no dataset '/{name}'; the table {group} is read from the result file, so "
                           "the Dataset must be from open_result(PATH) or xarray.open_dataset(PATH)")
    if column not in holder.variables:
        present = [key for key in map(str, holder.variables) if not key.endswith("_err")]
        meant = did_you_mean(column, present)
        raise BristleError(f"{place_of(file)}: there is no variable {name}{meant or '; known: ' + (', '.join(present) or 'none')}")
    return holder[column]


def read(file, name):
    """The values of the variable `name`, or `table/name`."""
    return values(dataset(file, name))


def values(data):
    try:
        return data.values
    except OSError as error:
        if is_of_the_system(error):
            raise BristleError(f"{place_of(data)} cannot be read: {system_reason(error)}") from error
        raise BristleError(f"{place_of(data)} is damaged ({error})") from error


def as_text(value):
    """A string of an attribute or variable, which may be bytes, str or an array of one of them."""
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
            raise BristleError(f"{place_of(file)}: attribute 'experiment' has no /{'/'.join(path)}")
        value = value[key]
    return value


def flags(data):
    """The words of a dataset of flags, and its values as indices into them."""
    words = attribute(data, "flag_meanings").split()
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
    line = np.atleast_1d(read(file, name))
    return line if line.dtype.kind in NUMBERS else list(map(as_text, line))


def axis_names(data):
    return list(map(str, data.dims))


def point_numbers(file):
    """The number of each of the Dataset's points in the tables of the whole file."""
    status = dataset(file if whole(file) is None else whole(file), "status")
    numbers = xarray.DataArray(np.arange(status.size).reshape(status.shape), status.coords, status.dims)
    return numbers.sel({name: dataset(file, name) for name in numbers.dims})


def select(data, along, **chosen):
    """The values over the axes `along`, in this order; chosen: the value or word on each other axis.

    Axes of one value that are not named are left out.
    """
    single = {name: 0 for name, size in data.sizes.items() if size == 1 and name not in (*along, *chosen)}
    data = data.isel(single)
    if sorted(data.dims) != sorted([*along, *chosen]):
        raise BristleError(f"{place_of(data)} is over ({', '.join(data.dims)}); "
                           f"this figure needs ({', '.join([*along, *chosen])})")
    for name, value in chosen.items():
        if value not in (present := data[name].values.tolist()):
            raise BristleError(f"{place_of(data)}: axis '{name}' has no {value}; it has: {', '.join(map(str, present))}")
    return values(data.sel(chosen).transpose(*along))


def select_flags(file, name, along, **chosen):
    """The words of a dataset of flags, and the index of each point's word."""
    data = dataset(file, name)
    words, numbers = flags(data)
    return words, select(data.copy(data=numbers), along, **chosen)


def select_errors(file, name, along, **chosen):
    """The estimated errors of a variable; NaN if it has none."""
    if f"{name}_err" in file:
        return select(dataset(file, f"{name}_err"), along, **chosen)
    return np.full(select(dataset(file, name), along, **chosen).shape, np.nan)


def readable(flag):
    """A flag's word as the documents print it."""
    return flag.replace("_", " ")


def status_words(status):
    """What a status says of a point, for a legend or a caption."""
    return STATUS_WORDS.get(readable(status), readable(status))


def status_counts(file):
    """(status, number of points) for each status that occurs."""
    words, codes = flags(dataset(file, "status"))
    counts = np.bincount(np.ravel(codes), minlength=len(words))
    return [(readable(word), int(n)) for word, n in zip(words, counts) if n]
