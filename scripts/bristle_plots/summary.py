"""The findings that a reader should know first, as sentences."""

import numpy as np

from .figures.hysteresis import windows
from .quantities import (at_most, chosen_at, falls_of_laws, jump_of, listed, measured, on_k_theta, percent,
                         periodic_part, READINGS, short, span, where_saturated)
from .results import as_text, axis_values, dataset, select
from .verdicts import declared_checks, number, with_uncertainty


def claims_of(file):
    """By claim, in the order of the experiment's checks: (check, its rows, one for each reading)."""
    claims = {}
    for check, row in declared_checks(file):
        claims.setdefault(check["claim"], {}).setdefault(row.declared, (check, []))[1].append(row)
    return {claim: list(checks.values()) for claim, checks in claims.items()}


def verdicts_of(checks):
    """The verdict on a claim by reading."""
    return {row.reading: row.claim_verdict for row in checks[0][1]}


def all_verdicts(found):
    """By claim of any figure, the verdict by reading."""
    return dict(sorted((claim, verdicts_of(checks)) for _, claims in found for claim, checks in claims.items()))


def readings_of(found):
    return list(dict.fromkeys(reading for verdicts in all_verdicts(found).values() for reading in verdicts))


def in_short(found):
    """The findings that a reader should know first; those whose results are there."""
    verdicts, readings = all_verdicts(found), readings_of(found)
    files = {as_text(file.attrs["name"]): file for file, _ in found}
    first = {"fig7": [one_jump, magnitude], "hysteresis": [two_frictions], "fig4": [contact_area]}
    rest = {"fig8": [saturation], "figA1": [isotropy], "fig3": [order_of_gaps], "figA2": [row_period]}
    lines = [counts(verdicts, readings)] if readings else []
    if readings == list(READINGS):
        top, below = ([headline(files[name], verdicts) for name, functions in part.items() if name in files for headline in functions]
                      for part in (first, rest))
        lines = [*top, *lines, *below]
    return [line for line in lines if line]


def counts(verdicts, readings):
    """How many claims are supported under each reading, and which are not."""
    parts = []
    for reading in readings:
        by_verdict = {}
        for claim, found in verdicts.items():
            by_verdict.setdefault(found.get(reading), []).append(claim)
        rest = [f"{verdict}: {', '.join(by_verdict[verdict])}" for verdict in ("refuted", "undecided") if verdict in by_verdict]
        under = {"polar": " under the exact equations", "polar_as_printed": " with Eq. (17) as printed",
                 "rod": " for rods"}.get(reading, "")
        parts.append(f"{len(by_verdict.get('supported', []))} are supported{under}" + (f" ({'; '.join(rest)})" if rest else ""))
    *first, last = parts
    pinned = " 8b depends on k_theta and on bristles pinned at the pole: see below." * ("refuted" in verdicts.get("8b", {}).values())
    return f"Of the paper's {len(verdicts)} claims, {', '.join([*first, 'and ' * bool(first) + last])}.{pinned}"


def of_each(sentence):
    """The text for each reading, those after the first in brackets."""
    first, *rest = READINGS
    return f"{sentence(first)} ({', '.join(f'{READINGS[reading]} {sentence(reading)}' for reading in rest)})"


def on_claim(what, claim, verdicts):
    found = verdicts[claim]
    same = len(set(found.values())) == 1
    return f"{what} ({claim}) is {next(iter(found.values()))} with every model" if same else f"{what} ({claim}) is {of_each(found.get)}"


def one_jump(file, _):
    """How much of the fall of friction lies within three steps of k_r at its steepest place."""
    k_r, jumps = axis_values(file, "k_r"), {reading: jump_of(file, reading) for reading in READINGS}
    def found(text):
        return of_each(lambda reading: text(jumps[reading]))
    return (f"Stiffer bristles have less friction because of one jump (nominal shear stress, Figure 7): "
            f"{found(lambda jump: percent(jump.share))} of the fall of ln R_x_norm from k_r = {chosen_at(k_r[0])} to "
            f"{chosen_at(k_r[-1])} lies within three of {len(k_r) - 1} steps of k_r, at k_r of about "
            f"{found(lambda jump: chosen_at(jump.place))}. From the lowest k_r to the first of these steps R_x_norm changes by a "
            f"factor of {found(lambda jump: short(jump.before))}. At the jump the slab rises from one branch of gaps to another, and "
            f"the load becomes spiky, so that the contact area under it, gamma_3, falls by a factor of "
            f"{found(lambda jump: short(jump.area))}.")


def two_frictions(file, _):
    def found(reading):
        return " and ".join(windows(file, {"bending": reading}, "k_r")) or "nowhere"
    return ("Where it jumps, one lattice has two frictions under the same load (`make hysteresis`): after a slab that came "
            f"up from the ground, and not down from above, it is larger, {of_each(found)}.")


def magnitude(file, verdicts):
    """The counterfactual of claims 6b and 7a: both laws at both nominal frictions."""
    low, high = min(nominal := axis_values(file, "nominal_friction")), max(nominal)
    found = {reading: falls_of_laws(file, reading) for reading in READINGS}
    def factor(law, at):
        return of_each(lambda reading: short(found[reading][law, at]))
    by_magnitude = all(one[law, high] >= 2 > one[law, low] for one in found.values() for law in ("nss", "coulomb"))
    concluded = ("So a steep fall takes a high local friction, whatever its law." if by_magnitude else
                 "So law and magnitude both matter.")
    rises = " (below 1: it rises)" if min(min(one.values()) for one in found.values()) < 1 else ""
    return (f"The paper names the friction law as the cause: a steep fall under nominal shear stress, a smoother one under Coulomb "
            f"friction (6b, 7a). But its two laws differ in magnitude, too: rigid bristles have a friction of {chosen_at(high)} times "
            f"the load under the first, and of {chosen_at(low)} under the second. At {chosen_at(high)} R_x_norm falls from k_r = "
            f"{chosen_at(axis_values(file, 'k_r')[0])} to {chosen_at(axis_values(file, 'k_r')[-1])} by a factor of {factor('nss', high)} under "
            f"nominal shear stress and of {factor('coulomb', high)} under Coulomb friction; at {chosen_at(low)} by {factor('nss', low)} and "
            f"{factor('coulomb', low)}{rises}. {concluded}")


def contact_area(file, _):
    def share(reading):
        return percent(measured(file, reading, {"predicate": "share", "variable": "gamma_3", "along": "k_r", "x": "R_x_norm"})[0])
    return ("The paper says that friction falls \u201cmostly due to the reduction of the effective contact area\u201d (4b): gamma_3 has "
            f"{of_each(share)} of the fall of ln R_x_norm in Figure 4.")


def saturation(file, verdicts):
    exact, printed, rod = (where_saturated(file, reading) for reading in READINGS)
    return (f"{on_claim('The saturation of R_x with mu_c', '8b', verdicts)}. {on_k_theta(file, 'polar')} For stiff bristles (k_r = "
            f"{exact['k_r']:g}) at mu_c = {listed(exact['mu_c'], chosen_at)} R_x is {listed(exact['R_x'])} for all "
            f"bristles and {listed(exact['R_x_unpinned'])} for those that pass. "
            f"{listed(exact['pinned_fraction'], percent)} of the bristles are pinned head-on at the pole, carry "
            f"{listed(exact['pinned_share_R_x'], percent)} of R_x, and do not saturate. As printed "
            f"{at_most(printed['pinned_fraction'])} are pinned, and R_x is {listed(printed['R_x'])}. "
            f"Rods have no pole: R_x is {listed(rod['R_x'])}.")


def isotropy(file, verdicts):
    def largest(reading):
        values = select(dataset(file, "R_y_norm"), ["k_r", "seed"], bending=reading, sampling="quadrature")
        return number(np.abs(values).max(), ".1g")
    return (f"{on_claim('Isotropy, R_y = 0 for uniform azimuths', 'A1', verdicts)}: |R_y_norm| of the ensemble mean is at most "
            f"{of_each(largest)}.")


def order_of_gaps(file, verdicts):
    """Claim 3d, if a reading does not support it."""
    if set(verdicts["3d"].values()) == {"supported"}:
        return ""
    trends = {}
    for check, row in declared_checks(file):
        if row.claim == "3d":
            trends.setdefault(row.reading, {})[check["at"]["R_n"]] = number(row.measured, ".2f")
    loads = listed(next(iter(trends.values())), chosen_at)
    return (f"{on_claim('The reversed order of z_0 over k_r between low and high load', '3d', verdicts)}: Kendall's tau is"
            f" {of_each(lambda reading: listed(trends[reading].values(), str))} at R_n = {loads}.")


def row_period(file, verdicts):
    """Claim A2, if a reading does not support it."""
    if set(verdicts["A2"].values()) == {"supported"}:
        return ""
    def slope(reading):
        return next(with_uncertainty(row.measured, row.uncertainty) for check, row in declared_checks(file)
                    if check["variable"] == "R_n_fluctuation_of_rows" and row.reading == reading)
    def part(reading):
        return span(periodic_part(file, reading)[1], percent)
    return (f"{on_claim('The vanishing fluctuation of large lattices', 'A2', verdicts)}. Bristles enter in rows, so "
            f"R_n(t) has a part with the period of a row, {of_each(part)} of its mean, in a lattice of any width. "
            f"The rest falls with the width to the power of {of_each(slope)}.")
