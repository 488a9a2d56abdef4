"""Every point of a result for the page's explorer: axes, values with errors, statuses, replay commands."""

import json

import numpy as np
from markupsafe import Markup

import symbols
from style import attribute, dataset, fail, text, values
from sweep import NAMES as WORDS
from sweep import axis, axis_names, flags

# Beside a variable; not variables themselves.
ERROR = "_err"


def collect(file, replay):
    """The points for the page; replay: the command of each point of the sweep, the last axis fastest."""
    status = dataset(file, "status")
    shape = np.shape(values(status))
    points = int(np.prod(shape))
    if not replay or points % len(replay):
        fail(f"{file.filename}: {points} points, but {len(replay)} commands of `bristle check --json`")
    axes = [read_axis(file, name) for name in axis_names(status)]
    return {
        "name": text(file.attrs["name"]),
        "axes": axes,
        "map": plane(axes),
        "variables": [read_variable(file, name) for name in shown(file, status.shape)],
        "status": read_flags(status),
        "replay": replay,
        "nodes": points // len(replay),
    }


def plane(axes):
    """Indices of the axes that make the map: across, the longest of numbers; upwards, the next."""
    order = sorted(range(len(axes)), key=lambda i: (axes[i]["words"], -len(axes[i]["values"])))
    return order[:2] if len(order) > 1 else None


def read_axis(file, name):
    data = dataset(file, name)
    line = axis(file, name)
    words = isinstance(line[0], str)
    return {
        "name": name,
        "symbol": symbol(data, name),
        "title": text(data.attrs.get("long_name", name)),
        "words": words,
        "values": [WORDS.get(word, word) for word in line] if words else line.tolist(),
    }


def shown(file, shape):
    """Names of the variables over the sweep that have values, what figures are about first."""
    first = ["R_x_norm", "gamma_1", "gamma_2", "gamma_3", "z_0", "R_n", "R_x", "N_c_ratio"]
    found = [name for name, data in file.items()
             if hasattr(data, "shape") and data.shape == shape and not name.endswith(ERROR)
             and name not in (*axis_names(file["status"]), "status")
             and ("flag_meanings" in data.attrs or np.isfinite(values(data)).any())]
    return sorted(found, key=lambda name: (first.index(name) if name in first else len(first), name))


def read_variable(file, name):
    data = dataset(file, name)
    out = {"name": name, "symbol": symbol(data, name), "title": attribute(data, "long_name"),
           "equation": text(data.attrs.get("equation", ""))}
    if "flag_meanings" in data.attrs:
        return {**out, **read_flags(data)}
    out["values"] = numbers(values(data))
    if name + ERROR in file:
        out["errors"] = numbers(values(dataset(file, name + ERROR)))
    return out


def read_flags(data):
    words, codes = flags(data)
    return {"words": [word.replace("_", " ") for word in words], "codes": np.ravel(codes).tolist()}


def numbers(array):
    """All digits of every number; null where there is none."""
    return [value if np.isfinite(value) else None for value in np.ravel(array).tolist()]


def symbol(data, name):
    found = text(data.attrs.get("symbol", ""))
    return str(symbols.html(found)) if found not in ("", name) else name  # a word is no formula


def embedded(data):
    """JSON that can stand within a script element."""
    words = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return Markup(words.replace("<", "\\u003c"))
