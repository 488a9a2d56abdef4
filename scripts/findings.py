"""docs/findings.md from result files: every claim with its verdict and the numbers behind it; the summary in README.md."""

import argparse
import os
import re

import numpy as np

from bristle_plots import assumptions
from bristle_plots.command_line import run
from bristle_plots.errors import BristleError
from bristle_plots.explanations import (MATRIX, PROGRAM, READINGS, at_most, chosen_at, explain_claim, explain_further, falls_of_laws,
                                        listed, measured, on_k_theta, percent, periodic_part, short, span, where_saturated)
from bristle_plots.figures.hysteresis import windows
from bristle_plots.files import write_text
from bristle_plots.markdown import filled, table
from bristle_plots.results import as_text, axis_values, dataset, experiment, open_result, read, select, status_counts
from bristle_plots.remarks import pinned_note, start_note
from bristle_plots.verdicts import declared_checks, number, p_text, quantity, threshold_text, with_uncertainty

INTRODUCTION = """\
The claims of the paper in the order of its figures, and the verdicts of the computations:
supported, **refuted**, or undecided within the uncertainty. A claim is named after the figure
beside which it stands; those of Appendix A begin with A, those of the conclusions with C. Every claim is checked with three models of bending. Two are readings of the paper, whose
Eq. (17) has another denominator than the kinematics of the azimuth theta:

- **exact**: theta' = (x v_y - y v_x)/s^2, with the distance s of the tip from the pole, the
  vertical through the bristle's root;
- **as printed**: theta' = (x v_y - y v_x)/r^2, with the distance r from the root;
- **rod**: bending without polar coordinates and so without a pole. What holds for the rod, too, is
  the bristle's; what does not may be the coordinates'.

docs/claims.md describes how claims are checked, docs/model.md the equations and the baseline: the
choices for what the paper leaves open. `make findings` writes this page and the summary in
README.md from the result files; no number in them is typed.
"""

BEGIN, END = "<!-- summary: written by `make findings` -->", "<!-- end of summary -->"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", metavar="RESULT.h5", nargs="+", help="result files in the figures' order")
    parser.add_argument("-o", dest="output", metavar="FILE", default="docs/findings.md")
    parser.add_argument("--readme", metavar="FILE", help="document whose summary is replaced")
    parser.add_argument("--program", default=PROGRAM.get(), help="what measures on the results (default: %(default)s)")
    parser.add_argument("--assumptions", metavar="FILE", nargs="+", help="matrices, of which the first that exists is read",
                        default=assumptions.DEFAULT)
    arguments = parser.parse_args()
    PROGRAM.set(arguments.program)
    MATRIX.set(next(filter(os.path.exists, arguments.assumptions), None))
    files = [open_result(path) for path in arguments.results]
    images = os.path.join(os.path.dirname(arguments.output), "images")
    found = [(file, claims_of(file)) for file in files]
    summary = f"{BEGIN}\n\n{filled(chr(10).join(f'- {line}' for line in in_short(found)))}\n{END}"
    sections = [section(file, claims, images) for file, claims in found]
    page = filled("\n".join(["# Findings\n\n@summary@\n", INTRODUCTION, overview(found), *sections]))
    write_text(arguments.output, page.replace("@summary@", summary))
    if arguments.readme:
        replace_summary(arguments.readme, summary)
    checks = sum(len(checks) for _, claims in found for checks in claims.values())
    print(f"{arguments.output}: {checks} checks of {len(files)} results")


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


def overview(found):
    """A row for each claim: what the paper states in short, and the verdict under each reading."""
    readings = readings_of(found)
    shorts = {check["claim"]: check["short"] for _, claims in found for checks in claims.values() for check, _ in checks
              if "short" in check}
    rows = [[claim, shorts.get(claim, ""), *(emphasised(verdicts.get(reading, "")) for reading in readings)]
            for claim, verdicts in all_verdicts(found).items()]
    return table(["claim", "the paper, in short", *(READINGS.get(one, one or "verdict") for one in readings)], *rows) + "\n"


def emphasised(verdict):
    return f"**{verdict}**" if verdict == "refuted" else verdict


def section(file, claims, images):
    name, figure = (as_text(file.attrs[key]) for key in ("name", "figure"))
    lines = [f"## {as_text(file.attrs['title'])}", "", provenance(file), ""]
    if os.path.exists(os.path.join(images, f"{name}.png")):
        lines += [f"![{figure and 'Figure '}{figure or name}](images/{name}.png)", ""]
    for claim, checks in claims.items():
        lines += claim_lines(file, claim, checks)
    left_open = {}
    for check, _ in (pair for checks in claims.values() for pair in checks):
        if "leaves_open" in check:
            left_open.setdefault(check["leaves_open"], []).append(check["claim"])
    if left_open:
        lines += ["The paper leaves open, and it matters here:", ""]
        lines += [f"- {what} ({', '.join(dict.fromkeys(claims))})" for what, claims in left_open.items()]
        lines.append("")
    for note in [*filter(None, [start_note(file), pinned_note(file)]), *experiment(file).get("notes", [])]:
        lines += [note, ""]
    return "\n".join(lines)


def provenance(file):
    """Caption, points by status, passages, the longest ensemble mean of the contact time, digest."""
    points = ", ".join(f"{n} {status}" for status, n in status_counts(file))
    passages = int(np.sum(read(file, "passages")))
    contact = np.nanmax(read(file, "N_c_ratio"))
    caption, digest = (as_text(file.attrs[name]) for name in ("caption", "payload_sha256"))
    return (f"{caption}. Points: {points}; {passages} passages, ensemble mean of the contact time at most "
            f"{contact:.2f} L_x/V_0. Payload SHA-256 `{digest[:16]}`.")


def claim_lines(file, claim, checks):
    """Heading with the verdicts, the paper's sentence, main and further checks, and why a verdict is not "supported"."""
    verdicts = verdicts_of(checks)
    words = ", ".join(f"{READINGS.get(reading, reading)} {verdict}".strip() for reading, verdict in verdicts.items())
    if len(verdicts) > 1 and len(set(verdicts.values())) == 1:
        words = f"{next(iter(verdicts.values()))} with every model"
    lines = [f"### {claim}: {words}", ""]
    for check, _ in checks:
        if "quote" in check:
            lines += [f"The paper: \u201c{check['quote']}\u201d", ""]
    main = [pair for pair in checks if pair[1][0].role == "main"]
    further = [pair for pair in checks if pair[1][0].role != "main"]
    for meaning in dict.fromkeys(check.get("interpretation") for check, _ in main):
        if meaning:
            lines += [f"If {meaning}:", ""]
        lines += [item(file, *pair) for pair in main if pair[0].get("interpretation") == meaning]
        lines.append("")
    if further:
        lines += ["Further checks, which do not decide the verdict:", "", *(item(file, *pair) for pair in further), ""]
    for reading, verdict in verdicts.items():
        if verdict != "supported":
            rows = [(check, row) for check, rows in checks for row in rows if row.reading == reading]
            lines += [f"Why {verdict} {READINGS.get(reading, reading)}: {explain_claim(file, rows)}", ""]
    return lines


def item(file, check, rows):
    """An item of a list: the statement, and below it the verdict of each reading with its numbers."""
    what = f"{quantity(check)} {threshold_text(rows[0].relation, rows[0].threshold, rows[0].band).strip()}"
    lines = [f"- {check['statement']} ({what})"]
    for row in rows:
        reading = f"{READINGS.get(row.reading, row.reading)}: " if row.reading else ""
        measured = f"{number(row.measured, '.3f')} ± {number(row.uncertainty, '.3f')}{p_text(row)}"
        why = explain_further(file, check, row) if row.role != "main" and row.verdict == "refuted" else ""
        if check["predicate"] == "rise" and "resolution" in check and not np.isfinite(row.uncertainty):
            why = f"ln changes by less than {check['resolution']:g} under a law"
        lines.append(f"  - {reading}{emphasised(row.verdict)}, {measured}{why and '; '}{why}")
    return "\n".join(lines)


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
    k_r, law = axis_values(file, "k_r"), {"friction": "nss", "nominal_friction": max(axis_values(file, "nominal_friction"))}
    shares, places, before, areas = {}, {}, {}, {}
    for reading in READINGS:
        def along(predicate, name, **chosen):
            return measured(file, reading, {"predicate": predicate, "variable": name, "along": "k_r", "where": {**law, **chosen}})[0]
        place = along("steepest_fall", "R_x_norm")
        i = int(np.searchsorted(k_r, place))  # the step ends there
        there = [k_r[max(i - 2, 0)], k_r[min(i + 1, len(k_r) - 1)]]
        shares[reading] = percent(along("rise", "R_x_norm", k_r=there) / along("rise", "R_x_norm"))
        before[reading] = short(along("end_ratio", "R_x_norm", k_r=[k_r[0], there[0]]))
        areas[reading] = short(1 / along("end_ratio", "gamma_3", k_r=there))
        places[reading] = chosen_at(place)
    return (f"Stiffer bristles have less friction because of one jump (nominal shear stress, Figure 7): {of_each(shares.get)} of "
            f"the fall of ln R_x_norm from k_r = {chosen_at(k_r[0])} to {chosen_at(k_r[-1])} lies within three of {len(k_r) - 1} "
            f"steps of k_r, at k_r of about {of_each(places.get)}. From the lowest k_r to the first of these steps R_x_norm changes "
            f"by a factor of {of_each(before.get)}. At the jump the slab rises from one branch of gaps to another, and the load becomes "
            f"spiky, so that the contact area under it, gamma_3, falls by a factor of {of_each(areas.get)}.")


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


def replace_summary(path, summary):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    pattern = re.escape(BEGIN) + ".*?" + re.escape(END)
    if not re.search(pattern, text, re.S):
        raise BristleError(f"{path}: has no summary to replace; it begins with {BEGIN}")
    write_text(path, re.sub(pattern, lambda _: summary, text, flags=re.S))


if __name__ == "__main__":
    run(main)
