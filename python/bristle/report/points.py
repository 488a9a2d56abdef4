"""What the page's explorer needs besides a result's CSV: axes, names of the variables, replay commands."""

import json

import numpy as np
from markupsafe import Markup

from ..errors import BristleError
from ..results import (CHOICE_NAMES, as_text, attribute, axis_names, axis_values, dataset, flags, place_of, readable,
                       values)
from . import symbols

# Ending of the datasets with a variable's errors.
ERROR = "_err"


def collect(file, replay):
    """The result for the page; replay: the command of each point of the sweep, the last axis fastest."""
    status = dataset(file, "status")
    shape = np.shape(values(status))
    points = int(np.prod(shape))
    if not replay or points % len(replay):
        raise BristleError(f"{place_of(file)}: {points} points, but `bristle check --json` has {len(replay)} commands")
    axes = [read_axis(file, name) for name in axis_names(status)]
    return {
        "name": as_text(file.attrs["name"]),
        "axes": axes,
        "map": plane(axes),
        "along": "z_0" if axes and axes[-1]["name"] == "node" else None,
        "status": words_of(status),
        "variables": [read_variable(file, name) for name in shown(file, status.shape)],
        "replay": replay,
        "nodes": points // len(replay),
    }


def plane(axes):
    """Indices of the map's axes: horizontal, the longest numeric one; vertical, the next."""
    order = sorted(range(len(axes)), key=lambda i: (axes[i]["words"], -len(axes[i]["values"])))
    return order[:2] if len(order) > 1 else None


def read_axis(file, name):
    data = dataset(file, name)
    line = axis_values(file, name)
    words = isinstance(line[0], str)
    return {
        "name": name,
        "symbol": symbol(data, name),
        "title": as_text(data.attrs.get("long_name", name)),
        "unit": "" if words else unit(data),
        "words": words,
        "keys": line if words else line.tolist(),  # in the CSV
        "values": [CHOICE_NAMES.get(word, word) for word in line] if words else line.tolist(),
    }


def shown(file, shape):
    """Names of the variables over the sweep that have values; variables of the figures first."""
    first = ["R_x_norm", "gamma_1", "gamma_2", "gamma_3", "z_0", "R_n", "R_x", "N_c_ratio"]
    found = [name for name, data in file.data_vars.items()
             if data.shape == shape and not name.endswith(ERROR) and name != "status"
             and name.removesuffix("_code") not in file.dims
             and ("flag_meanings" in data.attrs or np.isfinite(values(data)).any())]
    return sorted(found, key=lambda name: (first.index(name) if name in first else len(first), name))


def read_variable(file, name):
    data = dataset(file, name)
    words = words_of(data)
    return {"name": name, "symbol": symbol(data, name), "title": attribute(data, "long_name"), "unit": "" if words else unit(data),
            "equation": as_text(data.attrs.get("equation", "")), "words": words}


def words_of(data):
    """The words of a variable of flags, else None."""
    return [readable(word) for word in flags(data)[0]] if "flag_meanings" in data.attrs else None


def unit(data):
    found = as_text(data.attrs.get("units", "1"))
    return "dimensionless" if found in ("", "1") else found


def symbol(data, name):
    """The symbol as HTML: with the unit, if it has one, and with a mark if it is a target and not what was computed."""
    found = as_text(data.attrs.get("symbol", ""))
    if found in ("", name):
        return name  # a name is not a formula
    mark = r"^{\mathrm{target}}" if name.endswith("_target") else ""
    return str(symbols.html(found + mark)) + (f" [{unit(data)}]" if unit(data) != "dimensionless" else "")


def embedded(data):
    """JSON for the content of a script element."""
    words = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return Markup(words.replace("<", "\\u003c"))
