"""docs/findings.md from result files: every claim with its verdict and the numbers behind it; the summary in README.md."""

import argparse
import os
import re

import numpy as np

from bristle_plots.command_line import run
from bristle_plots.errors import BristleError
from bristle_plots.explanations import (PROGRAM, READINGS, at_most, chosen_at, explain_claim, explain_further, falls, listed,
                                        percent, periodic_part, short, span, where_saturated)
from bristle_plots.files import write_text
from bristle_plots.markdown import filled, table
from bristle_plots.results import as_text, axis_values, dataset, experiment, open_result, read, select, status_counts
from bristle_plots.remarks import pinned_note, start_note
from bristle_plots.verdicts import declared_checks, number, p_text, quantity, threshold_text, with_uncertainty

INTRODUCTION = """\
The claims of the paper in the order of its figures, and the verdicts of the computations:
supported, **refuted**, or undecided within the uncertainty. Every claim is checked with three
models of bending: polar coordinates with Eq. (17) **exact** or **as printed**, which are two
readings of the paper, and a **rod** without a pole (docs/model.md): what holds for the rod, too,
is the bristle's; what does not may be the coordinates'. docs/claims.md describes how claims are checked, docs/model.md the baseline: the
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
    arguments = parser.parse_args()
    PROGRAM.set(arguments.program)
    files = [open_result(path) for path in arguments.results]
    images = os.path.join(os.path.dirname(arguments.output), "images")
    found = [(file, claims_of(file)) for file in files]
    summary = f"{BEGIN}\n\n{filled(in_short(found))}\n{END}"
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
    return {claim: verdicts_of(checks) for _, claims in found for claim, checks in claims.items()}


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
        lines += [f"![Figure {figure}](images/{name}.png)", ""]
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
        lines.append(f"  - {reading}{emphasised(row.verdict)}, {measured}{why and '; '}{why}")
    return "\n".join(lines)


def in_short(found):
    """The findings that a reader should know first, as a list; those whose results are there."""
    verdicts, readings = all_verdicts(found), readings_of(found)
    files = {as_text(file.attrs["name"]): file for file, _ in found}
    headlines = {"fig7": one_jump, "fig6": fall_with_stiffness, "fig8": saturation, "figA1": isotropy, "fig3": order_of_gaps, "figA2": row_period}
    lines = [counts(verdicts, readings)]
    if readings == list(READINGS):
        found = [headline(files[name], verdicts) for name, headline in headlines.items() if name in files]
        lines = [*found[:1], *lines, *found[1:]]
    return "\n".join(f"- {line}" for line in lines if line)


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
    return f"Of the paper's {len(verdicts)} claims, {', '.join([*first, 'and ' * bool(first) + last])}."


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
    k_r = axis_values(file, "k_r")
    shares, places, areas = {}, {}, {}
    for reading in READINGS:
        fall, area = (-np.diff(np.log(select(dataset(file, name), ["k_r"], bending=reading, friction="nss")))
                      for name in ("R_x_norm", "gamma_3"))
        steepest = int(np.argmax(fall))
        there = slice(max(steepest - 1, 0), steepest + 2)
        shares[reading] = percent(fall[there].sum() / fall.sum())
        areas[reading] = short(np.exp(area[there].sum()))
        places[reading] = chosen_at(np.sqrt(k_r[steepest] * k_r[steepest + 1]))
    return (f"Stiffer bristles have less friction because of one jump (nominal shear stress, Figure 7): {of_each(shares.get)} of "
            f"the fall of ln R_x_norm from k_r = {chosen_at(k_r[0])} to {chosen_at(k_r[-1])} lies within three of {len(k_r) - 1} "
            f"steps of k_r, at k_r of about {of_each(places.get)}. There the slab rises from one branch of gaps to another, the "
            f"load becomes spiky, so that the contact area under it, gamma_3, falls by a factor of {of_each(areas.get)}, and the "
            f"friction depends on whether the slab came from above or from below (`make hysteresis`).")


def fall_with_stiffness(file, _):
    k_r = axis_values(file, "k_r")
    def factor(name, law):
        return of_each(lambda reading: short(*falls(file, reading, name, friction=law)))
    return (f"From k_r = {chosen_at(k_r[0])} to {chosen_at(k_r[-1])} the normalised friction R_x_norm falls by a factor of "
            f"{factor('R_x_norm', 'nss')} under nominal shear stress, and the contact area, gamma_3, by "
            f"{factor('gamma_3', 'nss')}; under Coulomb friction R_x_norm falls by {factor('R_x_norm', 'coulomb')}.")


def saturation(file, verdicts):
    exact, printed, rod = (where_saturated(file, reading) for reading in READINGS)
    return (f"{on_claim('The saturation of R_x with mu_c', '8b', verdicts)}. For stiff bristles (k_r = "
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
