"""Why a claim is not supported: texts with the numbers behind them, read from the result files or measured by the program.

A function takes the file of the claim's figure and (check, claim as measured) for the checks of one reading.
"""

from contextvars import ContextVar

import numpy as np

from .program import DEFAULT, measure
from .results import axis_names, axis_values, constant, dataset, place_of, point_numbers, read, select, setting
from .verdicts import number, p_text, threshold_text, with_uncertainty

READINGS = {"polar": "exact", "polar_as_printed": "as printed", "rod": "rod"}  # models of bending

PROGRAM = ContextVar("program", default=DEFAULT)  # what measures

CHANCE = 0.05  # significance that a trend needs (docs/claims.md)
NEAR_GROUND = 0.02  # the gap z_0 of claim 3b


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
    return f"{number(100 * share, '.2g')} %"


def at_most(shares):
    return f"at most {percent(max(shares))}" if max(shares) > 0 else "none"


def span(values, text=short):
    """The smallest and the largest value."""
    low, high = text(np.nanmin(values)), text(np.nanmax(values))
    return low if low == high else f"{low} to {high}"


def turns(x, y, share=0.15):
    """The first and the last value, and between them those at which y turns, without swings below a share of its range."""
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


def over_k_r(file, stiffness, variable, abscissa, target, *, reading):
    """For each k_r the variable where the abscissa first has this value, at the paper's k_phi."""
    k_phi = setting(file, "model", "k_phi")
    return measured(file, reading, *({"predicate": "level", "variable": variable, "along": "k_phi", "at": {abscissa: target},
                                      "where": {"k_phi": k_phi, "k_r": k_r}} for k_r in stiffness))


def nearest(values, wanted):
    """Indices of the values that are nearest to the wanted ones."""
    return [int(np.argmin(abs(values - one))) for one in wanted]


def failing(pairs):
    return [(check, row) for check, row in pairs if row.verdict != "supported"]


def others(file, reading):
    return [one for one in axis_values(file, "bending") if one != reading]


def stiff_first_contact(file, pairs):
    check, row = failing(pairs)[0]
    gap, (low, high) = check["at"]["z_0"], check["where"]["k_r"]
    k_r = np.array([one for one in axis_values(file, "k_r") if low <= one <= high])
    load = over_k_r(file, k_r, "R_n", "z_0", gap, reading=row.reading)
    falls = [f"from k_r = {chosen_at(k_r[i])} to {chosen_at(k_r[i + 1])}" for i in range(len(k_r) - 1)
             if load[i + 1] < load[i]]
    text = f"At z_0 = {gap}, R_n is {listed(load)} for k_r = {listed(k_r, chosen_at)}"
    text += f": it falls {listed(falls, str)}." if falls else "."
    if row.significance > CHANCE:
        text += (f" The trend of {row.measured:.2f} meets the threshold of {row.threshold:g}, but so few points can show "
                 f"it by chance{p_text(row)}; {CHANCE} is required.")
    for one in others(file, row.reading):
        text += f" ({READINGS[one].capitalize()}: {listed(over_k_r(file, k_r, 'R_n', 'z_0', gap, reading=one))}.)"
    return text


def slope_at_contact(file, pairs):
    check, row = pairs[0]
    chosen = {"bending": row.reading, "k_phi": setting(file, "model", "k_phi")}
    k_r = check["compare"]["k_r"]
    load = [select(dataset(file, "R_n"), ["node"], k_r=one, **chosen)[0] for one in k_r]
    return (f"at first contact, where the range of this check begins, R_n is {listed(load)} for k_r = "
            f"{listed(k_r, chosen_at)} already, and the curve of the stiffer bristles flattens below it.")


def order_of_gaps(file, pairs):
    reading, k_r = pairs[0][1].reading, axis_values(file, "k_r")
    trends = {check["at"]["R_n"]: row.measured for check, row in pairs}
    parts = []
    for load, tau in trends.items():
        word = "rises with k_r" if tau >= 0.5 else "falls with k_r" if tau <= -0.5 else "has no clear order"
        gaps = over_k_r(file, k_r, "z_0", "R_n", load, reading=reading)
        missing = " (\u2013: the load is not carried)" if np.isnan(gaps).any() else ""
        parts.append(f"At R_n = {load} z_0 {word} (tau = {number(tau, '.2f')}): {listed(gaps)} for k_r = "
                     f"{listed(k_r, chosen_at)}{missing}.")
    ground = over_k_r(file, k_r, "R_n", "z_0", NEAR_GROUND, reading=reading)
    time = over_k_r(file, k_r, "N_c_ratio", "z_0", NEAR_GROUND, reading=reading)
    moved = (time - 1) * setting(file, "model", "L_x")  # the slip of a passage is L_x, Eq. (A2)
    parts.append(f"Near the ground, at z_0 = {NEAR_GROUND}, R_n is {listed(ground)}, and when the slab leaves them the tips "
                 f"have been dragged by {listed(moved)} bristle lengths, (N_c/N_c0 - 1) L_x: from k_r = "
                 f"{chosen_at(k_r[np.argmin(ground)])} on, the softer a bristle is, the longer it becomes and the less it "
                 "carries. So under a growing load soft bristles let the slab down to the ground first. (The curves are "
                 "those of the paper's k_phi; tau is over all k_phi.)")
    return " ".join(parts)


def row_period(file, pairs):
    reading = pairs[0][1].reading
    slopes = {check["variable"]: row for check, row in pairs if check["predicate"] == "slope"}
    widths, part, whole = periodic_part(file, reading)
    raw, of_rows = (slopes[name] for name in ("R_n_fluctuation", "R_n_fluctuation_of_rows"))
    return (f"All bristles of a row enter at the same time, so R_n(t) has a part with the period of a row that does not depend "
            f"on the number of bristles: its standard deviation is {span(part, percent)} of the mean for every L_y from "
            f"{chosen_at(widths[0])} to {chosen_at(widths[-1])}, while that of R_n(t) falls from {percent(whole[0])} to "
            f"{percent(whole[-1])}. The slope over L_y is therefore "
            f"{with_uncertainty(raw.measured, raw.uncertainty)}; that of means over a row's time, which are free of this "
            f"part, is {with_uncertainty(of_rows.measured, of_rows.uncertainty)}.")


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


def pinned_bristles(file, pairs):
    reading = pairs[0][1].reading
    at = where_saturated(file, reading)
    measured = {check["variable"]: row for check, row in pairs}
    plateau = measured["R_x_unpinned"]
    text = (f"At k_r = {at['k_r']:g} and mu_c = {listed(at['mu_c'], chosen_at)}, {listed(at['pinned_fraction'], percent)} of "
            f"the bristles are pinned upright at the pole and carry {listed(at['pinned_share_R_x'], percent)} of R_x. The "
            f"slab slides over them at V_0, so their friction grows with mu_c: R_x is {listed(at['R_x_pinned'])} per pinned "
            f"bristle. R_x of all bristles is {listed(at['R_x'])}; that of the bristles that pass is "
            f"{listed(at['R_x_unpinned'])}. The latter is constant within {percent(plateau.measured)} "
            f"({plateau.verdict} as a further check): the bristles that pass do saturate.")
    for one in others(file, reading):
        there = where_saturated(file, one)
        text += (f" ({READINGS.get(one, one).capitalize()}: {at_most(there['pinned_fraction'])} of the bristles are pinned "
                 f"there, and R_x of all is {listed(there['R_x'])}.)")
    return text


def where_saturated(file, reading):
    """Variables of the stiffer bristles at mu_c of about 2.5, 5 and 10."""
    k_r, mu_c = max(axis_values(file, "k_r")), axis_values(file, "mu_c")
    at = nearest(mu_c, [2.5, 5, 10])
    names = ("pinned_fraction", "pinned_share_R_x", "R_x", "R_x_unpinned")
    found = {name: select(dataset(file, name), ["mu_c"], bending=reading, k_r=k_r)[at] for name in names}
    with np.errstate(invalid="ignore"):
        per_bristle = found["pinned_share_R_x"] * found["R_x"] / found["pinned_fraction"]
    return {**found, "R_x_pinned": per_bristle, "k_r": k_r, "mu_c": mu_c[at]}


def order_within_branches(file, pairs):
    """A trend over k_r that holds across the fall of R_x_norm, but not before and behind it."""
    check, row = failing(pairs)[0]
    chosen = {"bending": row.reading, **check.get("where", {})}
    other = [name for name in axis_names(dataset(file, "R_x_norm")) if name not in ("k_r", *chosen)]
    curves = [{}] if not other else [{other[0]: value} for value in axis_values(file, other[0])]
    taus, falls, first, top, elsewhere = [], [], [], [], {}
    for curve in curves:
        x, y = (select(dataset(file, name), ["k_r"], **chosen, **curve) for name in (check["x"], check["variable"]))
        there = np.isfinite(x) & np.isfinite(y)
        k_r, x, y = axis_values(file, "k_r")[there], x[there], y[there]
        fall = int(np.argmin(np.diff(np.log(y)))) + 1
        falls += [k_r[fall - 1], k_r[fall]]
        first.append(y[0])
        top.append(max(y[:fall]))
        for one in others(file, row.reading):
            there = select(dataset(file, check["variable"]), ["k_r"], **{**chosen, "bending": one}, **curve)
            elsewhere.setdefault(READINGS[one], []).append(there[0])
        taus.append(tau_by_side(x, y, np.arange(len(y)) >= fall))
    across, before, behind = (number(tau, ".2f") for tau in np.nanmean(taus, axis=0))
    apart = "less" if row.verdict == "undecided" else "more"
    other_readings = "".join(f" ({one}: {span(there)})" for one, there in elsewhere.items())
    return (f"The trend, {with_uncertainty(row.measured, row.uncertainty)}, and the threshold, "
            f"{number(row.threshold, 'g')}, differ by {apart} than the uncertainty. R_x_norm falls most steeply at k_r = "
            f"{span(falls, chosen_at)}. For pairs of points on either side of the fall tau is {across}; for pairs before it "
            f"{before}, and for pairs behind it {behind}. Before the fall R_x_norm rises with k_r, from {span(first)} at "
            f"the lowest k_r{other_readings} to at most {span(top)}.")


def tau_by_side(x, y, behind):
    """Kendall's tau between x and y for pairs across a border, before it and behind it."""
    agrees = np.sign(x[:, None] - x) * np.sign(y[:, None] - y)
    pairs = np.triu(np.ones(agrees.shape, bool), 1)
    first, second = behind[:, None], behind[None, :]
    kinds = (first != second, ~first & ~second, first & second)
    return [agrees[pairs & kind].mean() if (pairs & kind).any() else np.nan for kind in kinds]


def sticking_at_low_stiffness(file, pairs):
    chosen = {"bending": pairs[0][1].reading}
    k_r = axis_values(file, "k_r")
    every, passing = (geometric_mean(file, name, **chosen)[0] for name in ("gamma_1", "gamma_1_unpinned"))
    pinned = select(dataset(file, "pinned_fraction"), ["k_r", "k_theta"], **chosen).mean(axis=1)[0]
    return (f"gamma_1 has its maximum on the branch of thin gaps, before the gap jumps: "
            f"{turns(k_r, geometric_mean(file, 'gamma_1', **chosen))}. At the lowest k_r {percent(pinned)} of the bristles "
            f"are pinned, which raises it: {short(passing)} for the bristles that pass, {short(every)} for all.")


def alignment_over_stiffness(file, pairs):
    mean = geometric_mean(file, "gamma_2", bending=pairs[0][1].reading)
    return f"along k_r gamma_2 falls and rises more than once: {turns(axis_values(file, 'k_r'), mean)}."


def falls(file, reading, *names, **chosen):
    """The factor by which each variable falls along k_r, geometric mean over the curves."""
    return 1 / measured(file, reading, *({"predicate": "end_ratio", "variable": name, "along": "k_r", "where": chosen}
                                         for name in names))


def estimate_of_friction(file, pairs):
    friction, count, area = falls(file, pairs[0][1].reading, "R_x_norm", "N_c_ratio", "gamma_3")
    return (f"over the range of k_r R_x_norm falls by a factor of {short(friction)} and N_c/N_c0 by "
            f"{short(count)}, whose cube root is {short(count ** (1 / 3))}; gamma_3, the contact area under "
            f"a fluctuating load, falls by {short(area)}.")


def product_of_gammas(file, pairs):
    check, row = pairs[0]
    quotient = {"predicate": "level", "along": "k_r", **{key: check[key] for key in ("variable", "divide_by")}}
    lowest, highest = (measured(file, row.reading, *({**quotient, "where": {"k_r": k_r, "k_phi": k_phi}}
                                                     for k_phi in axis_values(file, "k_phi")))
                       for k_r in axis_values(file, "k_r")[[0, -1]])
    return (f"the quotient is {span(lowest)} at the lowest k_r and {span(highest)} at the highest, over all k_phi: "
            "the mean over the bristles of a product is not the product of the means.")


def jump_of_one_law(file, pairs):
    check, row = pairs[0]
    chosen = {"bending": row.reading}
    nss, coulomb = (select(dataset(file, check["variable"]), ["k_r", "k_theta"], friction=law, **chosen)
                    for law in ("nss", "coulomb"))
    friction = select(dataset(file, "R_x_norm"), ["k_r", "k_theta"], friction="nss", **chosen)
    fall = np.argmin(np.diff(np.log(friction), axis=0), axis=0) + 1
    behind = np.arange(len(friction))[:, None] >= fall
    across, before, after = tau_by_side(nss.ravel(), coulomb.ravel(), behind.ravel())
    return (f"under NSS the gap jumps along k_r, under Coulomb friction it does not: tau is {number(across, '.2f')} for pairs "
            f"of points across the jump, {number(before, '.2f')} before and {number(after, '.2f')} behind it.")


# By claim; and of further checks by claim and predicate, a sentence.
CLAIMS = {"3a": stiff_first_contact, "3d": order_of_gaps, "5c": order_within_branches, "7b": order_within_branches,
          "8b": pinned_bristles, "A2": row_period}
FURTHER = {("3a", "slope"): slope_at_contact, ("4c", "end_ratio"): sticking_at_low_stiffness,
           ("4d", "trend"): alignment_over_stiffness, ("5c", "slope"): estimate_of_friction,
           ("5c", "plateau"): product_of_gammas, ("6a", "concordance"): jump_of_one_law}


def what_was_measured(pairs):
    """The explanation of any other claim: what its checks measured, and what they require."""
    rows = [row for _, row in failing(pairs) or pairs]
    return " ".join(f"\u201c{row.statement}\u201d: measured is {with_uncertainty(row.measured, row.uncertainty)}{p_text(row)}, "
                    f"required {threshold_text(row.relation, row.threshold, row.band).strip()}." for row in rows)


def explain_claim(file, pairs):
    """Why the claim is refuted or undecided under the reading of these checks."""
    explanation = CLAIMS.get(pairs[0][0]["claim"])
    return explanation(file, pairs) if explanation else what_was_measured([pair for pair in pairs if pair[1].role == "main"])


def explain_further(file, check, row):
    """Why a further check is refuted; empty where its numbers say it."""
    explanation = FURTHER.get((check["claim"], check["predicate"]))
    return explanation(file, [(check, row)]) if explanation else ""
