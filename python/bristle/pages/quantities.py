"""Sentences written by hand, with numbers from results: what stands between braces is measured, read or counted.

{end_ratio R_x_norm along k_r friction=nss:percent} is what a check with these keys would measure (docs/claims.md),
{R_x k_r=last mu_c=2.5,5,10} lists a variable at the nearest values of its axes, {setting model/L_x} is of the experiment, and
the words of WORDS are functions. After = stand numbers, a word of a choice, a range 0.5..1, `first` or `last` of an axis, and
of k_r the ranges `before` and `behind` the jump of the gap and the steps about it, `jump`. Between two such descriptions /
divides. At the end, `each` gives the number for every model of bending, and `all` the range over them. After the colon
stands a format, see `text`.
"""

import json
import re
from contextvars import ContextVar
from functools import lru_cache

import numpy as np

from ..figures.hysteresis import windows
from ..plotting.verdicts import measured_text, number
from ..program import DEFAULT, measure
from ..results import axis_values, dataset, flags, place_of, read, setting

READINGS = {"polar": "corrected", "polar_as_printed": "as printed", "rod": "rod"}  # models of bending
PREDICATES = ("level", "rise", "end_ratio", "steepest_fall")
PROGRAM = ContextVar("program", default=DEFAULT)  # what measures
DERIVED = {"local_friction": lambda file: file["R_x"] / file["R_x_norm"] / file["R_n"],
           "R_x_pinned": lambda file: file["pinned_share_R_x"] * file["R_x"] / file["pinned_fraction"],
           "scatter_of_formula": lambda file: file["lift_off_load_err"] / file["lift_off_load"]}


def filled_in(sentence, file, reading="", pairs=()):
    """The sentence with the numbers of a result under a reading; pairs: the claim's checks, each with what it measured."""
    return re.sub(r"\{([^{}:]*):?([^{}]*)\}", lambda found: said(found[1].split(), found[2], file, reading, pairs), sentence)


def said(words, form, file, reading, pairs):
    if words[0] in WORDS:
        return WORDS[words[0]](words[1:], file, reading, pairs)
    if words[-1] not in ("each", "all"):
        return text(numbers(words, file, reading), form)
    found = [numbers(words[:-1], file, one) for one in READINGS]
    if words[-1] == "all":
        return text(np.concatenate(found), f"range {form}")
    first, *rest = (text(values, form) for values in found)
    return f"{first} ({', '.join(f'{model} {one}' for model, one in zip(list(READINGS.values())[1:], rest))})"


def text(values, form):
    """The values with three digits, or as the format says: `axis`, of an axis; `percent`; or one of Python's. Before it may
    stand `range`, for the smallest and the largest value, or one of them, `least` or `most`."""
    *which, form = f" {form}".split(" ")
    one = {"": short, "axis": chosen_at, "percent": percent}.get(form, lambda value: number(value, form))
    if which == [""]:
        return listed(values, one)
    low, high = one(np.nanmin(values)), one(np.nanmax(values))
    return {"least": low, "most": high, "range": low if low == high else f"{low} to {high}"}[which[1]]


def numbers(words, file, reading):
    if "/" in words:
        at = words.index("/")
        return numbers(words[:at], file, reading) / numbers(words[at + 1:], file, reading)
    if words[0] in ("1", "setting"):
        return np.array([float(setting(file, *words[1].split("/")) if words[1:] else 1)])
    where = resolved([word.split("=") for word in words if "=" in word], file, reading)
    if words[0] not in PREDICATES:
        return values_of(file, words[0], where)
    where = {key: one[0] if len(one) == 1 else one for key, one in where.items() if key != "bending"}
    check = {"predicate": words[0], "variable": words[1], "along": words[3], "where": where}
    return np.array([measured(PROGRAM.get(), place_of(file), json.dumps(check, default=float))[reading]])


@lru_cache(maxsize=1000)
def measured(program, path, check):
    """What the program measures, by reading; check: JSON."""
    return measure(program, path, json.loads(check))


def resolved(conditions, file, reading):
    """By name, the values of an axis or the words that are meant, or the ends of a range as a tuple."""
    found = {"bending": [reading]} if reading else {}
    for key, wanted in conditions:
        line = axis_values(file, key) if key in file.dims else []
        if wanted in ("before", "behind", "jump"):
            found[key] = side(file, wanted, found)
        elif ".." in wanted:
            found[key] = tuple(map(float, wanted.split("..")))
        elif wanted in ("first", "last"):
            found[key] = [line[0 if wanted == "first" else -1]]
        elif wanted[0].isdigit():
            found[key] = [line[int(np.argmin(abs(line - float(one))))] for one in wanted.split(",")]
        else:
            found[key] = wanted.split(",")
    return found


def side(file, which, chosen):
    """The range of k_r before or behind the jump of the gap on all curves, or of the steps about it."""
    gaps = dataset(file, "z_0").sel({key: one for key, one in chosen.items() if key in file["z_0"].dims})
    k_r, steps = axis_values(file, "k_r"), np.diff(np.log(gaps.transpose(..., "k_r").values.reshape(-1, file.sizes["k_r"])))
    step = np.nanargmax(steps[np.isfinite(steps).any(axis=1)], axis=1)
    low, high = min(step), max(step) + 1
    ends = {"before": (0, low), "behind": (high, -1), "jump": (max(low - 1, 0), min(high + 1, len(k_r) - 1))}[which]
    return tuple(k_r[list(ends)])


def values_of(file, name, where):
    data = DERIVED[name](file) if name in DERIVED else dataset(file, name)
    for key, wanted in where.items():
        if key not in data.dims:
            data = data.where(holds(file, key, wanted)) if key in file.data_vars else data
        else:
            line = data[key]
            data = data.isel({key: (line >= wanted[0]) & (line <= wanted[1])}) if isinstance(wanted, tuple) else data.sel({key: wanted})
    return np.ravel(data)


def holds(file, key, wanted):
    """Where a variable is within the range, or one of flags has one of the words."""
    if isinstance(wanted, tuple):
        return (file[key] >= wanted[0]) & (file[key] <= wanted[1])
    words, codes = flags(dataset(file, key))
    return file[key].copy(data=np.isin(codes, [words.index(word) for word in wanted]))


def checked(conditions, _file, _reading, pairs):
    """{check KEY=VALUE...}: what the first check of the claim with these keys measured, with its uncertainty."""
    wanted = [word.split("=") for word in conditions]
    return measured_text([row for check, row in pairs if all(str(check.get(key)) == value for key, value in wanted)][0])


def largest(words, file, reading, _pairs):
    """{largest VARIABLE AXIS ...}: the largest value along an axis, and where it is."""
    values = numbers([words[0], *words[2:]], file, reading)
    at = int(np.nanargmax(values))
    return f"{short(values[at])} at {words[1]} = {chosen_at(axis_values(file, words[1])[at])}"


def counted(words, file, *_):
    """{count FLAGS=WORD,...}: the number of points."""
    name, wanted = words[0].split("=")
    return str(int(holds(file, name, wanted.split(",")).sum()) or "none")


def beyond(words, file, *_):
    """{beyond FLAGS}: of the points with a value of R_x_norm those beyond the limit, in words."""
    valued = np.isfinite(read(file, "R_x_norm"))
    number_of = int(holds(file, words[0], ["yes"]).values[valued].sum())
    return "every point" if number_of == valued.sum() else f"{number_of} of {valued.sum()} points"


def steps(words, file, *_):
    """{steps AXIS}: the number of steps between its values."""
    return str(file.sizes[words[0]] - 1)


WORDS = {"check": checked, "largest": largest, "count": counted, "beyond": beyond, "steps": steps,
         "windows": lambda words, file, *_: " and ".join(windows(file, {"bending": words[0]}, "k_r")) or "nowhere",
         "cot": lambda words, file, *_: f"{1 / np.tan(np.radians(setting(file, *words[0].split('/')))):.2f}"}


def short(value):
    """A computed value, with three digits."""
    return number(value, "#.3g").rstrip(".")


def chosen_at(value):
    """A value of an axis."""
    return number(value, ".3g")


def listed(values, text=short):
    *first, last = map(text, values)
    return f"{', '.join(first)} and {last}" if first else last


def percent(share):
    return f"{number(100 * share, '.0f' if abs(share) >= 0.1 else '.2g')} %" if share else "none"
