"""Why a claim is not supported: texts with the numbers behind them.

A function takes the file of the claim's figure and (check, claim as measured) for the checks of one reading.
"""

import numpy as np

from ..plotting.verdicts import measured_text, number, p_text, threshold_text, with_uncertainty
from ..results import axis_values, dataset, select
from .quantities import (at_most, chosen_at, failing, falls, falls_of_laws, geometric_mean, listed, loads_at,
                         measured, on_k_theta, others, percent, periodic_part, READINGS, short, span,
                         tau_by_side, turns, unpaired, where_saturated)

CHANCE = 0.05  # significance that a trend needs (docs/claims.md)


def stiff_first_contact(file, pairs):
    check, row = failing(pairs)[0]
    gap, k_r = check["where"]["z_0_target"], axis_values(file, "k_r")
    load = loads_at(file, k_r, [gap], row.reading)
    top = int(np.argmax(load))
    between = f", largest with {short(load[top])} at k_r = {chosen_at(k_r[top])}" if top < len(k_r) - 1 else ""
    return (f"R_n at z_0 = {gap} is {short(load[0])} at k_r = {chosen_at(k_r[0])}{between}, and {short(load[-1])} at k_r = "
            f"{chosen_at(k_r[-1])}. {what_was_measured([pair for pair in pairs if pair[1].role == 'main'])}")


def slope_at_contact(file, pairs):
    check, row = pairs[0]
    k_r, gaps = check["compare"]["k_r"], np.array(axis_values(file, "z_0_target"))[[0, -1]]
    load = loads_at(file, k_r, gaps[::-1], row.reading)
    return (f"R_n is {listed(load[:2])} for k_r = {listed(k_r, chosen_at)} at z_0 = {chosen_at(gaps[1])} already, and "
            f"{listed(load[2:])} at z_0 = {chosen_at(gaps[0])}.")


def slopes_of_ends(file, pairs):
    check, row = pairs[0]
    k_r = axis_values(file, "k_r")
    top, ground = (-measured(file, row.reading, *({**unpaired(check), "where": {**check["where"], "z_0": end, "k_r": one}}
                                                  for one in k_r)) for end in check["compare"]["z_0"])
    return (f"-dR_n/dz_0 is {listed(top)} at first contact and {listed(ground)} near the ground, for k_r = "
            f"{listed(k_r, chosen_at)}.")


def order_of_gaps(file, pairs):
    """Claim 3d: the gaps over k_r under both loads."""
    reading, k_r = pairs[0][1].reading, axis_values(file, "k_r")
    parts = []
    for load in axis_values(file, "R_n_target"):
        gaps = select(dataset(file, "z_0"), ["k_r"], R_n_target=load, **({"bending": reading} if reading else {}))
        missing = " (\u2013: no gap carries the load)" if np.isnan(gaps).any() else ""
        parts.append(f"under R_n = {load:g} it is {listed(gaps)}{missing}")
    return f"The gap z_0 for k_r = {listed(k_r, chosen_at)}: {'; '.join(parts)}."


def row_period(file, pairs):
    reading = pairs[0][1].reading
    slopes = {check["variable"]: row for check, row in pairs if check["predicate"] == "slope"}
    widths, part, whole = periodic_part(file, reading)
    raw, of_rows = (slopes[name] for name in ("R_n_fluctuation", "R_n_fluctuation_of_rows"))
    return (f"All bristles of a row enter at the same time, so R_n(t) has a part with the period of a row that does not depend "
            f"on the number of bristles: its standard deviation is {span(part, percent)} of the mean for every L_y from "
            f"{chosen_at(widths[0])} to {chosen_at(widths[-1])}, while the standard deviation of R_n(t) falls from {percent(whole[0])} to "
            f"{percent(whole[-1])}. The slope over L_y is therefore "
            f"{with_uncertainty(raw.measured, raw.uncertainty)}; the slope of means over a row's time, which are free of this "
            f"part, is {with_uncertainty(of_rows.measured, of_rows.uncertainty)}.")


def pinned_bristles(file, pairs):
    reading = pairs[0][1].reading
    at = where_saturated(file, reading)
    measured = {check["variable"]: row for check, row in pairs}
    plateau = measured["R_x_unpinned"]
    text = (f"At k_r = {at['k_r']:g} and mu_c = {listed(at['mu_c'], chosen_at)}, {listed(at['pinned_fraction'], percent)} of "
            f"the bristles are pinned upright at the pole and carry {listed(at['pinned_share_R_x'], percent)} of R_x. The "
            f"slab slides over them at V_0, so their friction grows with mu_c: R_x is {listed(at['R_x_pinned'])} per pinned "
            f"bristle. R_x of all bristles is {listed(at['R_x'])}; R_x of the bristles that pass is "
            f"{listed(at['R_x_unpinned'])}, constant within {percent(plateau.measured)} "
            f"({plateau.verdict} as a further check): the bristles that pass do saturate. {on_k_theta(file, reading)}")
    for one in others(file, reading):
        there = where_saturated(file, one)
        text += (f" ({READINGS.get(one, one).capitalize()}: {at_most(there['pinned_fraction'])} of the bristles are pinned "
                 f"there, and R_x of all is {listed(there['R_x'])}.)")
    return text


def on_each_branch(file, check, row):
    """How the variables of a trend over k_r change before the jump of the gap and behind it, at all curves."""
    chosen = {"bending": row.reading, **check.get("where", {})}
    k_r = axis_values(file, "k_r")
    steps = np.diff(np.log(dataset(file, "z_0").sel(chosen).transpose(..., "k_r").values.reshape(-1, len(k_r))))
    step = np.nanargmax(steps[np.isfinite(steps).any(axis=1)], axis=1)
    sides = [k_r[0], k_r[min(step)]], [k_r[max(step) + 1], k_r[-1]]
    names = [name for name in (check["variable"], check.get("x")) if name]
    before, behind = (listed(measured(file, row.reading, *({"predicate": "end_ratio", "variable": name, "along": "k_r", "where": {
        **check.get("where", {}), "k_r": side}} for name in names))) for side in sides)
    return (f"{listed(names, str)} {'change by factors' if names[1:] else 'changes by a factor'} of {before} from k_r = "
            f"{listed(sides[0], chosen_at).replace('and', 'to')}, before the jump of the gap, and of {behind} from "
            f"{listed(sides[1], chosen_at).replace('and', 'to')}, behind it.")


def by_branch(file, pairs):
    """A trend over k_r: the numbers across the jump of the gap and within the branches, and what happens there."""
    parts = []
    for check, row in failing([pair for pair in pairs if pair[1].role == "main"]):
        of_pairs = {other["pairs"]: with_uncertainty(found.measured, found.uncertainty) for other, found in pairs
                    if "pairs" in other and all(other.get(key) == check.get(key) for key in ("variable", "x", "where", "along"))}
        if not of_pairs:
            parts.append(what_was_measured([(check, row)]))
            continue
        parts.append(f"\u201c{row.statement}\u201d: tau is {with_uncertainty(row.measured, row.uncertainty)}{p_text(row)}, required "
                     f"{threshold_text(row.relation, row.threshold, row.band)}{by_chance(row)}. For pairs of points on either side of the jump of the gap "
                     f"it is {of_pairs['across']}, for pairs on the same side {of_pairs['within']}: "
                     f"{on_each_branch(file, check, row)}")
    return " ".join(parts)


def within_branches(file, pairs):
    check, row = pairs[0]
    return on_each_branch(file, check, row) if check.get("pairs") == "within" else ""


def sticking_at_low_stiffness(file, pairs):
    chosen = {"bending": pairs[0][1].reading}
    k_r = axis_values(file, "k_r")
    every, passing = (geometric_mean(file, name, **chosen)[0] for name in ("gamma_1", "gamma_1_unpinned"))
    pinned = select(dataset(file, "pinned_fraction"), ["k_r", "k_theta"], **chosen).mean(axis=1)[0]
    raised = (f" At the lowest k_r {percent(pinned)} of the bristles are pinned, which raises it: {short(passing)} for the "
              f"bristles that pass, {short(every)} for all." if pinned > 0 else "")
    return (f"gamma_1 has its maximum on the branch of thin gaps, before the gap jumps: "
            f"{turns(k_r, geometric_mean(file, 'gamma_1', **chosen))}.{raised}")


def alignment_over_stiffness(file, pairs):
    if "pairs" in pairs[0][0]:
        return within_branches(file, pairs)
    mean = geometric_mean(file, "gamma_2", bending=pairs[0][1].reading)
    return f"along k_r gamma_2 falls and rises more than once: {turns(axis_values(file, 'k_r'), mean)}."


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
    fall = np.argmin(np.nan_to_num(np.diff(np.log(friction), axis=0)), axis=0) + 1
    behind = np.arange(len(friction))[:, None] >= fall
    across, before, after = tau_by_side(nss.ravel(), coulomb.ravel(), behind.ravel())
    return (f"under NSS the gap jumps along k_r, under Coulomb friction it does not: tau is {number(across, '.2f')} for pairs "
            f"of points across the jump, {number(before, '.2f')} before and {number(after, '.2f')} behind it.")


def magnitude_or_law(file, pairs):
    check, row = pairs[0]
    if row.statement.startswith("the bristles that pass"):
        return ""
    names = {"nss": "NSS", "coulomb": "Coulomb"}
    found = "; ".join(f"{names[law]}, local friction {chosen_at(nominal)}: {short(factor)}"
                      for (law, nominal), factor in falls_of_laws(file, row.reading).items())
    return f"the factors by which R_x_norm falls: {found}."


def directions(file, pairs):
    """Claim 6a: ln of the last over the first value under both laws."""
    parts = []
    for check, row in failing([pair for pair in pairs if pair[1].role == "main"]):
        rises = measured(file, row.reading, *({**unpaired(check), "where": {"friction": law}} for law in check["compare"]["friction"]))
        small = f", where {check['resolution']:g} is the least change that has a direction" * (row.verdict == "undecided")
        parts.append(f"Along {check['along']} ln {check['variable']} changes by {number(rises[0], '+.2f')} under Coulomb friction and by "
                     f"{number(rises[1], '+.2f')} under NSS{small}.")
    return " ".join(parts)


def shares_of_k_theta(file, pairs):
    names = ("gamma_1", "gamma_2", "gamma_3")
    rises = measured(file, pairs[0][1].reading, *({"predicate": "rise", "variable": name, "along": "k_theta"} for name in names))
    return (f"From the lowest to the highest k_theta ln gamma_1, ln gamma_2 and ln gamma_3 change by "
            f"{listed(rises, lambda rise: number(rise, '+.3f'))}.")


def polar_stiffness(file, pairs):
    """Claim C1: what k_phi does before the jump and behind it."""
    k_phi = axis_values(file, "k_phi")
    found = [(check["where"]["k_r"], row.measured) for check, row in pairs if "where" in check]
    parts = [f"{short(factor)} for k_r from {low:g} to {high:g}" for (low, high), factor in found]
    more = ": behind the jump of the gap bristles that are stiffer against bending have more friction" * bool(found[-1][1] > 1)
    return (f"{what_was_measured([pair for pair in pairs if pair[1].role == 'main'])} From k_phi = {chosen_at(k_phi[0])} to "
            f"{chosen_at(k_phi[-1])} R_x_norm changes by a factor of {listed(parts, str)}{more}.")


def largest_friction(file, pairs):
    """Claim 8c: R_x over the local friction under both laws, of all bristles and of those that pass."""
    row = pairs[0][1]
    k_r, nominal = max(axis_values(file, "k_r")), axis_values(file, "nominal_friction")
    at = [i for i, one in enumerate(nominal) if one >= 10]
    parts, most = [], 0
    for law, name in (("nss", "NSS"), ("coulomb", "Coulomb")):
        every, passing, pinned = (select(dataset(file, variable), ["nominal_friction"], bending=row.reading, k_r=k_r, friction=law)[at]
                                  for variable in ("R_x", "R_x_unpinned", "pinned_share_R_x"))
        most = max(most, *pinned)
        of_passing = f" ({listed(passing)} of the bristles that pass; pinned ones carry {span(pinned, percent)})" if max(pinned) > 0 else ""
        parts.append(f"{listed(every)} under {name}{of_passing}")
    slides = " The slab slides over pinned bristles, so their friction grows with the local one." * bool(most > 0)
    return f"At k_r = {k_r:g} and a local friction of {listed(nominal[at], chosen_at)} R_x is {'; '.join(parts)}.{slides}"


def end_of_transient(file, pairs):
    """Claim A4: the time in contact, and how much is left at t_1."""
    reading, by_variable = pairs[0][1].reading, {}
    for check, row in pairs:
        if check["where"]["rows"] == axis_values(file, "rows")[0]:
            by_variable[check["variable"]] = row.measured
    (contact,) = measured(file, reading, {"predicate": "level", "variable": "N_c_ratio", "along": "seed",
                                          "where": {"sampling": "quadrature"}})
    missing = listed([1 - by_variable[name] for name in ("R_n", "R_x", "N_c_ratio")], percent)
    return (f"The slab drags the tips along, so that a bristle stays in contact for {short(contact)} L_x/V_0 on average: at t_1 = "
            f"L_x/V_0 fewer bristles have arrived than are in contact later. In the unit of time after t_1, R_n, R_x and N_c lack {missing} "
            "of their ensemble means.")


def same_fall_without_area(file, pairs):
    """Claim 4b: bouncing bristles have the same friction under the law without contact area."""
    ratio = next((row for check, row in pairs if check["variable"] == "R_x" and check["predicate"] == "level"), None)
    if ratio is None:
        return what_was_measured(pairs)
    return ("R_x of bouncing bristles under nominal shear stress is "
            f"{with_uncertainty(ratio.measured, ratio.uncertainty)} times R_x under Coulomb friction of the same magnitude. Under "
            "either law, friction soon makes a tip that strikes the slab as fast as the slab, and what this takes depends on the tip and its "
            "springs, not on the law (docs/lift-off.md).")


def order_along_k_phi(file, pairs):
    """Claim 5d: what gap and friction do along k_phi before the jump and behind it."""
    reading, k_r, k_phi = pairs[0][1].reading, axis_values(file, "k_r"), axis_values(file, "k_phi")
    friction = select(dataset(file, "R_x_norm"), ["k_r", "k_phi"], bending=reading)
    at_both_ends = np.flatnonzero(np.isfinite(friction[:, [0, -1]]).all(axis=1))
    if not at_both_ends.size:
        return what_was_measured(pairs)
    parts = []
    for i in dict.fromkeys(at_both_ends[[0, -1]]):
        gap, force = (measured(file, reading, {"predicate": "end_ratio", "variable": name, "along": "k_phi", "where": {"k_r": k_r[i]}})[0]
                      for name in ("z_0", "R_x_norm"))
        parts.append(f"at k_r = {chosen_at(k_r[i])} z_0 changes by a factor of {short(gap)} and R_x_norm by a factor of {short(force)}")
    return f"From k_phi = {chosen_at(k_phi[0])} to {chosen_at(k_phi[-1])}, {', and '.join(parts)}."


# By claim; and of further checks by claim and predicate, a sentence.
CLAIMS = {"3a": stiff_first_contact, "3d": order_of_gaps, "4b": same_fall_without_area, "4g": shares_of_k_theta,
          "5c": by_branch, "5d": order_along_k_phi, "6a": directions, "7b": by_branch, "8b": pinned_bristles, "8c": largest_friction,
          "C1": polar_stiffness, "A2": row_period, "A4": end_of_transient}
FURTHER = {("3a", "slope"): slope_at_contact, ("3e", "slope"): slopes_of_ends, ("4c", "end_ratio"): sticking_at_low_stiffness,
           ("4d", "trend"): alignment_over_stiffness, ("5c", "slope"): estimate_of_friction,
           ("5c", "plateau"): product_of_gammas, ("6a", "concordance"): jump_of_one_law, ("7a", "steepness"): magnitude_or_law,
           **{(claim, "trend"): within_branches for claim in ("4a", "5a", "5c", "5d", "7b")}}


def by_chance(row):
    """Of a trend that meets its threshold and is not supported."""
    return f", but so few points can show it by chance: p is to be at most {CHANCE}" if row.significance > CHANCE and row.margin > 0 else ""


def what_was_measured(pairs):
    """The explanation of any other claim: what its checks measured, and what they require."""
    rows = [row for _, row in failing(pairs) or pairs]
    return " ".join(f"\u201c{row.statement}\u201d: measured {measured_text(row)}{p_text(row)} ({row.required})"
                    f"{by_chance(row)}." for row in rows)


def explain_claim(file, pairs):
    """Why the claim is not supported under the reading of these checks."""
    if not any(row.role == "main" for _, row in pairs):
        found = " ".join(f"\u201c{row.statement}\u201d: {row.verdict}, {measured_text(row)} ({row.required})." for _, row in pairs)
        return f"No check of ours decides it. Beside it, {found}"
    explanation = CLAIMS.get(pairs[0][0]["claim"])
    return explanation(file, pairs) if explanation else what_was_measured([pair for pair in pairs if pair[1].role == "main"])


def explain_further(file, check, row):
    """Why a further check is refuted; empty where its numbers say it."""
    explanation = FURTHER.get((check["claim"], check["predicate"]))
    return explanation(file, [(check, row)]) if explanation else ""
