"""What explanations and the summary of the findings state: numbers from the result files or measured by the program, as text."""

from collections import namedtuple
from contextvars import ContextVar

import numpy as np

from ..plotting.verdicts import number
from ..program import DEFAULT, measure
from ..results import axis_values, constant, dataset, place_of, point_numbers, read, select, setting
from .matrix import verdicts_by_value

READINGS = {"polar": "corrected", "polar_as_printed": "as printed", "rod": "rod"}  # models of bending

PROGRAM = ContextVar("program", default=DEFAULT)  # what measures
MATRIX = ContextVar("matrix", default=None)  # the matrix of assumptions, if there is one

# The three steps of k_r about the steepest fall of R_x_norm. place: k_r; ends: the k_r before and behind; share: of the whole
# fall of ln R_x_norm; before: the factor by which R_x_norm changes up to there; area: by which gamma_3 falls there; gaps, spreads:
# z_0 and F_n_spread before and behind; fall: the factor by which R_x_norm falls over all k_r.
Jump = namedtuple("Jump", "place ends share before area gaps spreads fall")


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
    return f"{number(100 * share, '.0f' if abs(share) >= 0.1 else '.2g')} %"


def at_most(shares):
    return f"at most {percent(max(shares))}" if max(shares) > 0 else "none"


def span(values, text=short):
    """The smallest and the largest value."""
    low, high = text(np.nanmin(values)), text(np.nanmax(values))
    return low if low == high else f"{low} to {high}"


def turns(x, y, share=0.15):
    """The first and the last value, and between them those at which y turns, without swings below a share of its range."""
    x, y = x[np.isfinite(y)], y[np.isfinite(y)]
    step = np.diff(y)
    kept = [0, *(np.flatnonzero(step[1:] * step[:-1] < 0) + 1), len(y) - 1]
    while len(kept) > 2:
        swings = abs(np.diff(y[kept]))
        i = int(np.argmin(swings))
        if swings[i] >= share * np.ptp(y):
            break
        del kept[max(i, 1):min(i + 2, len(kept) - 1)]
    return ", ".join(f"{short(y[i])} (k_r = {chosen_at(x[i])})" for i in kept)


def geometric_mean(file, name, **chosen):
    """Over k_theta, for each k_r."""
    return np.exp(np.log(select(dataset(file, name), ["k_r", "k_theta"], **chosen)).mean(axis=1))


def measured(file, reading, *quantities):
    """What the program measures: the number of each quantity, described by the keys of a check."""
    return np.array(measure(PROGRAM.get(), place_of(file), reading, quantities))


def nearest(values, wanted):
    """Indices of the values that are nearest to the wanted ones."""
    return [int(np.argmin(abs(values - one))) for one in wanted]


def failing(pairs):
    return [(check, row) for check, row in pairs if row.verdict != "supported"]


def others(file, reading):
    return [one for one in axis_values(file, "bending") if one != reading]


def loads_at(file, k_r, gaps, reading):
    """R_n for each k_r at each gap near first contact."""
    return measured(file, reading, *({"predicate": "level", "variable": "R_n", "along": "k_r",
                                      "where": {"z_0_target": gap, "k_r": one}} for gap in gaps for one in k_r))


def unpaired(check):
    """What the check measures, without what it compares."""
    return {key: value for key, value in check.items() if key not in ("compare", "role")}


def periodic_part(file, reading):
    """L_y, and for each the standard deviations of R_n(t), the periodic part and all of it, over the mean; mean over
    the seeds."""
    point, t, load = (read(file, f"slab_force/{name}") for name in ("point", "t", "R_n"))
    later = t >= constant(dataset(file, "slab_force/t"), "t_1")
    numbers = point_numbers(file)
    intervals = round(setting(file, "model", "spacing") / (t[1] - t[0]))  # of a row; V_0 = 1
    widths, part, whole = axis_values(file, "L_y"), [], []
    for width in widths:
        found = []
        for number in select(numbers, ["seed"], bending=reading, L_y=width, sampling="lattice"):
            series = load[later & (point == number)]
            phases = [series[i::intervals].mean() for i in range(intervals)]
            found.append((np.std(phases) / series.mean(), series.std() / series.mean()))
        part.append(np.mean([one for one, _ in found]))
        whole.append(np.mean([one for _, one in found]))
    return widths, part, whole


def on_k_theta(file, reading):
    """A sentence: at which k_theta the verdict on 8b turns."""
    k_theta = setting(file, "model", "k_theta")
    found = verdicts_by_value(MATRIX.get(), "8b", "k_theta", k_theta) if MATRIX.get() and reading == "polar" else {}
    known = f"The caption of Figure 8 does not give k_theta, here {k_theta:g}"
    if len(found) < 2:
        return f"{known}."
    values = {}
    for value, verdict in found.items():
        values.setdefault(verdict, []).append(value)
    turns = ", ".join(f"{verdict} at {listed(at, chosen_at)}" for verdict, at in values.items())
    return f"{known}, and the verdict depends on it: in the coarser runs of docs/assumptions.md it is {turns}."


def where_saturated(file, reading):
    """Variables of the stiffer bristles at mu_c of about 2.5, 5 and 10."""
    k_r, mu_c = max(axis_values(file, "k_r")), axis_values(file, "mu_c")
    at = nearest(mu_c, [2.5, 5, 10])
    names = ("pinned_fraction", "pinned_share_R_x", "R_x", "R_x_unpinned")
    found = {name: select(dataset(file, name), ["mu_c"], bending=reading, k_r=k_r)[at] for name in names}
    with np.errstate(invalid="ignore"):
        per_bristle = found["pinned_share_R_x"] * found["R_x"] / found["pinned_fraction"]
    return {**found, "R_x_pinned": per_bristle, "k_r": k_r, "mu_c": mu_c[at]}


def tau_by_side(x, y, behind):
    """Kendall's tau between x and y for pairs across a border, before it and behind it."""
    agrees = np.sign(x[:, None] - x) * np.sign(y[:, None] - y)
    pairs = np.triu(np.isfinite(agrees), 1)
    first, second = behind[:, None], behind[None, :]
    kinds = (first != second, ~first & ~second, first & second)
    return [agrees[pairs & kind].mean() if (pairs & kind).any() else np.nan for kind in kinds]


def falls(file, reading, *names, **chosen):
    """The factor by which each variable falls along k_r, geometric mean over the curves."""
    return 1 / measured(file, reading, *({"predicate": "end_ratio", "variable": name, "along": "k_r", "where": chosen}
                                         for name in names))


def falls_of_laws(file, reading):
    """By law and local friction, the factor by which R_x_norm falls from the lowest to the highest k_r of Figure 7."""
    return {(law, nominal): falls(file, reading, "R_x_norm", friction=law, nominal_friction=nominal)[0]
            for nominal in axis_values(file, "nominal_friction")[::-1] for law in axis_values(file, "friction")}


def jump_of(file, reading):
    """The jump of Figure 7 under nominal shear stress of the paper's magnitude."""
    k_r = axis_values(file, "k_r")
    law = {"friction": "nss", "nominal_friction": max(axis_values(file, "nominal_friction"))}

    def along(predicate, name, **chosen):
        return measured(file, reading, {"predicate": predicate, "variable": name, "along": "k_r", "where": {**law, **chosen}})[0]

    place = along("steepest_fall", "R_x_norm")
    i = int(np.searchsorted(k_r, place))  # the step ends there
    before, behind = max(i - 2, 0), min(i + 1, len(k_r) - 1)
    ends = [k_r[before], k_r[behind]]
    gaps, spreads = (select(dataset(file, name), ["k_r"], bending=reading, **law)[[before, behind]] for name in ("z_0", "F_n_spread"))
    return Jump(place, ends, along("rise", "R_x_norm", k_r=ends) / along("rise", "R_x_norm"),
                along("end_ratio", "R_x_norm", k_r=[k_r[0], ends[0]]), 1 / along("end_ratio", "gamma_3", k_r=ends), gaps, spreads,
                1 / along("end_ratio", "R_x_norm"))
