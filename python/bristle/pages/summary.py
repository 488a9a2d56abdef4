"""The findings that a reader should know first, as sentences."""

import numpy as np

from ..figures.hysteresis import windows
from ..plotting.verdicts import declared_checks, number, with_uncertainty
from ..results import as_text, axis_values, dataset, flags, read, select, setting
from .quantities import (at_most, chosen_at, falls_of_laws, jump_of, listed, measured, on_k_theta, percent,
                         periodic_part, READINGS, short, span, where_saturated)


def claims_of(file):
    """By claim, in the order of the experiment's checks: (check, its rows, one for each reading)."""
    claims = {}
    for check, row in declared_checks(file):
        claims.setdefault(check["claim"], {}).setdefault(row.declared, (check, []))[1].append(row)
    return {claim: list(checks.values()) for claim, checks in claims.items()}


def verdicts_of(checks):
    """The verdict on a claim by reading."""
    return {row.reading: row.claim_verdict for row in checks[0][1]}


OWN = "F"  # the first letter of the findings that are ours; all other claims are the paper's


def all_verdicts(found):
    """By claim of the paper, the verdict by reading."""
    return {claim: verdicts for claim, verdicts in every_verdict(found).items() if not claim.startswith(OWN)}


def own_verdicts(found):
    """By finding of ours, the verdict by reading."""
    return {claim: verdicts for claim, verdicts in every_verdict(found).items() if claim.startswith(OWN)}


def every_verdict(found):
    """The verdict by reading, in the order of the claims."""
    every = {}
    for _, claims in found:
        for claim, checks in claims.items():
            verdicts = every.setdefault(claim, {})
            for reading, verdict in verdicts_of(checks).items():
                verdicts[reading] = joint(verdict, verdicts.get(reading, verdict))
    return dict(sorted(every.items()))


def joint(*verdicts):
    """The verdict on a claim that checks of several results decide: supported if all support it, refuted if one refutes it."""
    return min(verdicts, key=["refuted", "depends", "undecided", "supported"].index)


def readings_of(found):
    return list(dict.fromkeys(reading for verdicts in all_verdicts(found).values() for reading in verdicts))


def in_short(found):
    """What a reader should know first, of the results that are there, each finding as a sentence or several."""
    findings = [[("load", two_phases)], [("liftoff", formula)], [("load", sliding_easily)],
                [("hysteresis", two_frictions), ("scatter", bristles_that_differ)], [("chart", weak_friction)]]
    return [" ".join(leading + sentences(found, more)) for first, *more in findings if (leading := sentences(found, [first]))]


def in_context(found):
    """What belongs to the findings: the paper's claims in numbers, and what a reader must not take from its figures."""
    return sentences(found, [], [counts]) + sentences(found, [("fig4", limits)])


def further(found):
    """Findings on single claims of the paper."""
    return sentences(found, [("fig7", one_jump), ("fig7", magnitude), ("fig7", contact_area), ("fig8", saturation),
                             ("figA1", isotropy), ("figA2", row_period)])


def sentences(found, of_files, of_verdicts=()):
    """What the functions say of the files by name, without those that are missing or lack a model of bending."""
    verdicts, readings = all_verdicts(found), readings_of(found)
    files = {as_text(file.attrs["name"]): file for file, _ in found}
    lines = [say(files[name], verdicts) for name, say in of_files if name in files and readings == list(READINGS)]
    return [line for line in [*lines, *(say(verdicts, readings) for say in of_verdicts if readings)] if line]


def counts(verdicts, readings):
    """How many claims hold with every model, how many fail with every model, and how many depend on the model."""
    words = {claim: set(found.values()) if len(found) == len(readings) else {""} for claim, found in verdicts.items()}
    holding, failing = ([claim for claim, found in words.items() if found == {word}] for word in ("supported", "refuted"))
    rest = len(verdicts) - len(holding) - len(failing)
    by_model = (" and {} depend on the model, on a range or on what is meant, or are undecided" if len(readings) > 1 else
                " and {} depend on what is meant or are undecided").format(rest)
    model = " with every model of bending" if len(readings) > 1 else ""
    fails = "fails" if len(failing) == 1 else "fail"
    return (f"Of the paper's {len(verdicts)} claims, {len(holding)} hold{model}, {len(failing)} {fails}{model}"
            f"{' (' + ', '.join(failing) + ')' if failing else ''}{by_model}.")


def in_two_digits(value):
    return number(value, ".2g")


TESTED = "4 to 36", "3 to 20"  # k_r/k_phi and local friction for which docs/lift-off.md compares the formula with computed loads


def two_phases(file, _):
    words, phases = flags(dataset(file, "phase"))
    number_of = {word: int(np.sum(np.asarray(phases) == i)) for i, word in enumerate(words)}
    share = {"predicate": "level", "variable": "off_slab_share", "along": "R_n_target", "where": {"off_slab_share": [0.5, 1]}}
    off = [measured(file, reading, share)[0] for reading in READINGS]
    points = sum(number_of[word] for word in ("contact", "bouncing", "mixed"))
    local = read(file, "R_x") / read(file, "R_x_norm") / read(file, "R_n")
    return ("**Under strong local friction a brush of point masses is in contact or bounces.** In contact the tips stay on the slab and drag along it. "
            f"Bouncing, they are off the slab for {span(off, percent)} of the time (L_x = {setting(file, 'model', 'L_x'):g}). Of the {points} points of `make load` with a value "
            f"(local friction {span([np.nanmin(local), np.nanmax(local)], in_two_digits)}), {number_of['mixed'] or 'none'} "
            f"{'is' if number_of['mixed'] < 2 else 'are'} in between.")


def sliding_easily(file, _):
    words, phases = flags(dataset(file, "phase"))
    friction, over_lift_off = read(file, "R_x_norm"), read(file, "load_over_lift_off")
    rods = axis_values(file, "bending").index("rod")

    def span_of(phase, chosen=True):
        there = (np.asarray(phases) == list(words).index(phase)) & chosen & np.isfinite(friction)
        return span(friction[rods][there[rods]], in_two_digits) if there[rods].any() else ""

    bouncing, contact, k_r = span_of("bouncing", over_lift_off >= 0.5), span_of("contact"), axis_values(file, "k_r")
    if not (bouncing and contact):
        return ""
    return (f"**Bouncing point masses slide easily.** In `make load` (rods, k_r from {k_r[0]:g} to {k_r[-1]:g}) bouncing brushes have {bouncing} times the "
            f"friction of rigid bristles, under loads of at least half the lift-off load; brushes in contact have {contact} times. "
            "Stiffness decides at which load a brush falls into contact, and changes the friction of either kind less.")


def formula(file, _):
    scatter = float(np.nanmax(read(file, "lift_off_load_err") / read(file, "lift_off_load")))
    return ("**A formula says when.** If the slab is lowered, a brush of point masses bounces below a certain load per bristle, the "
            f"lift-off load. A formula (docs/lift-off.md) gives this load with a root mean square error of {percent(scatter)} for a radial over "
            f"polar stiffness, k_r/k_phi, of {TESTED[0]} and a local friction of {TESTED[1]}. Straight rods lie outside this range.")


def bristles_that_differ(file, _):
    loading, unloading = (select(dataset(file, "R_x_norm"), ["sample", "R_n_target"], path=path) for path in ("loading", "unloading"))
    widths = {text: read(file, name) for text, name in (("length", "scatter_r0"), ("modulus", "scatter_E"))}
    if not (unloading / loading >= 2).all(axis=0).any():
        return ""
    names = " or ".join(f"{percent(width.max())} in {text}" for text, width in widths.items())
    return f"Both frictions remain if the bristles of a brush differ, by standard deviations of up to {names}."


def weak_friction(file, _):
    friction, local = select(dataset(file, "R_x_norm"), ["nominal_friction", "contact", "R_n_target"]), axis_values(file, "nominal_friction")
    loads, k_r = axis_values(file, "R_n_target"), setting(file, "model", "k_r")
    least = np.nanmin(friction, axis=(1, 2))
    uncontrolled = np.flatnonzero(np.minimum.accumulate(least) >= 0.9)
    if not uncontrolled.size:
        return ""
    lean = setting(file, "model", "phi_0_deg")
    return (f"**Weak local friction cannot be controlled if bristles are soft along their axis.** If the local friction is "
            f"{in_two_digits(local[uncontrolled[-1]])} or less, rods with k_r/k_phi = {k_r / setting(file, 'model', 'k_phi'):.3g} have at least "
            f"{percent(least[uncontrolled[-1]])} of the friction of rigid bristles, whatever the load ({loads[0]:g} to {loads[-1]:.3g}; L_x = "
            f"{setting(file, 'model', 'L_x'):g}). Where the local friction exceeds cot(phi_0), {1 / np.tan(np.radians(lean)):.2f} at {lean:g} degrees, "
            "bristles that are stiff along their axis lock, vault over the vertical, and have less friction, under axial forces that would "
            "buckle their shafts.")


def limits(file, _):
    names = {"exceeds_buckling": "the axial force is more than 4 times the load under which a straight shaft buckles",
             "exceeds_spacing": "the tips travel beyond the next bristle, which the model lets them pass through",
             "exceeds_strain_limit": "the roots are strained beyond the linear range"}
    valued = np.isfinite(read(file, "R_x_norm"))
    places = {}
    for name, what in names.items():
        words, found = flags(dataset(file, name))
        beyond = int(np.sum(np.asarray(found)[valued] == list(words).index("yes")))
        place = "every point" if beyond == valued.sum() else f"{beyond} of {int(valued.sum())} points"
        places.setdefault(place, []).append(what)
    parts = [f"at {place} {', and '.join(found)}" for place, found in places.items()]
    return (f"**Before you trust a number:** in the paper's Figure 4, {'; '.join(parts)}. And all of this holds only for point masses: bristles "
            "whose tips are heavier than their shafts, or pins in springy sockets. For bristles with their mass along their length, such as "
            "wires and fibres, it is not settled: the first computations found neither the jump nor the lift-off load (docs/lift-off.md).")


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
    return ("**Near the lift-off load a brush of point masses has two frictions.** Friction is higher if the slab was raised from the ground than "
            f"if it was lowered from above: for rods under a load of {setting(file, 'load', 'R_n'):g}, {found('rod')}.")


def magnitude(file, verdicts):
    """The counterfactual of claims 6b and 7a: both laws at both local frictions."""
    low, high = min(nominal := axis_values(file, "nominal_friction")), max(nominal)
    found = {reading: falls_of_laws(file, reading) for reading in READINGS}
    def factor(law, at):
        return of_each(lambda reading: short(found[reading][law, at]))
    by_magnitude = all(one[law, high] >= 2 > one[law, low] for one in found.values() for law in ("nss", "coulomb"))
    concluded = ("So a steep fall takes a high local friction, whatever its law." if by_magnitude else
                 "So law and magnitude both matter for this fall; once a brush bounces, the law hardly matters (docs/lift-off.md).")
    rises = " (below 1: it rises)" if min(min(one.values()) for one in found.values()) < 1 else ""
    return (f"The paper names the friction law as the cause: a steep fall under nominal shear stress, a smoother one under Coulomb "
            f"friction (6b, 7a). But its two laws differ in magnitude, too: rigid bristles have a friction of {chosen_at(high)} times "
            f"the load under the first, and of {chosen_at(low)} under the second. At {chosen_at(high)} R_x_norm falls from k_r = "
            f"{chosen_at(axis_values(file, 'k_r')[0])} to {chosen_at(axis_values(file, 'k_r')[-1])} by a factor of {factor('nss', high)} under "
            f"nominal shear stress and of {factor('coulomb', high)} under Coulomb friction; at {chosen_at(low)} by {factor('nss', low)} and "
            f"{factor('coulomb', low)}{rises}. {concluded}")


def contact_area(file, _):
    """The counterfactual of claim 4b."""
    law = {"nominal_friction": max(axis_values(file, "nominal_friction"))}
    def share(reading):
        without, full = measured(file, reading, *({"predicate": "rise", "variable": "R_x_norm", "along": "k_r",
                                                   "where": {**law, "friction": name}} for name in ("coulomb", "nss")))
        return percent(without / full)
    return ("The paper says that friction falls \u201cmostly due to the reduction of the effective contact area\u201d (4b). Coulomb friction of "
            f"the same magnitude, which no contact area enters, has {of_each(share)} of the fall of ln R_x_norm.")


def saturation(file, verdicts):
    corrected, printed, rod = (where_saturated(file, reading) for reading in READINGS)
    return (f"{on_claim('The saturation of R_x with mu_c', '8b', verdicts)}. {on_k_theta(file, 'polar')} For stiff bristles (k_r = "
            f"{corrected['k_r']:g}) at mu_c = {listed(corrected['mu_c'], chosen_at)} R_x is {listed(corrected['R_x'])} for all "
            f"bristles and {listed(corrected['R_x_unpinned'])} for those that pass. "
            f"{listed(corrected['pinned_fraction'], percent)} of the bristles are pinned head-on at the pole, carry "
            f"{listed(corrected['pinned_share_R_x'], percent)} of R_x, and do not saturate. As printed "
            f"{at_most(printed['pinned_fraction'])} are pinned, and R_x is {listed(printed['R_x'])}. "
            f"Rods have no pole: R_x is {listed(rod['R_x'])}.")


def isotropy(file, verdicts):
    def largest(reading):
        values = select(dataset(file, "R_y_norm"), ["k_r", "seed"], bending=reading, sampling="quadrature")
        return number(np.abs(values).max(), ".1g")
    return (f"{on_claim('Isotropy, R_y = 0 for uniform azimuths', 'A1', verdicts)}: |R_y_norm| of the ensemble mean is at most "
            f"{of_each(largest)}.")


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
