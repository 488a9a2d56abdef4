"""How the verdicts depend on what the paper leaves open: docs/assumptions.md, and every check in
docs/generated/assumptions.md."""

import argparse
import os
from itertools import groupby

from ..command_line import run
from ..files import write_text
from ..plotting.verdicts import number, threshold_text, with_uncertainty
from .markdown import COLUMNS, filled, signs, table
from .matrix import TOGETHER, digest_line, read_matrix, reversed_verdict

SIGNS = {"supported": "+", "refuted": "-", "undecided": "?"}
UNAFFECTED = "."
CONCLUSIONS = ("robust", "weakened", "assumption-dependent", "open")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("matrix", metavar="MATRIX.json", help="output of `bristle assumptions`")
    parser.add_argument("--text", metavar="FILE", help="where to write what matters in words (Markdown)")
    parser.add_argument("--details", metavar="FILE", help="where to write the verdicts on every check (Markdown)")
    arguments = parser.parse_args()
    matrix = read_matrix(arguments.matrix)
    if arguments.text:
        write_text(arguments.text, filled(TEXT.format(tier=matrix["tier"], digest=digest_line(matrix).strip(),
                                                      counts=counts(matrix)) + influence(matrix)))
    if arguments.details:
        os.makedirs(os.path.dirname(arguments.details) or ".", exist_ok=True)
        write_text(arguments.details, details(matrix))


TEXT = """\
# How the verdicts depend on what the paper leaves open

For readers who doubt a verdict. The paper does not state everything that its numbers depend on. The baseline, described in
[model.md](model.md), makes a choice for each point that the paper leaves open; here each choice is replaced by
alternatives, singly and some together (experiments/assumptions/), and the checks of these experiments are judged again.
`make assumptions` computes the matrix and writes this page; no number in it is typed. The runs are of
the experiments' `{tier}` tier, which is coarser than the figures: a verdict of the baseline may differ from the verdict in
[findings.md](findings.md), and alternatives are compared with the baseline of the same tier. The lattices
of Figure A2 have a gap of 0.5 there and not a load of 2, which changes the verdict on A2.

{digest} {counts} [generated/assumptions.md](generated/assumptions.md) has every check with the numbers under its
alternatives, and the whole matrix.

## The choices that matter

"""

DETAILS = """\
# Every check under every alternative

For readers of [assumptions.md](../assumptions.md) who look for one check. `make assumptions` writes this page.

A check is **robust** if its verdict is the same under every alternative, **weakened** if some
alternatives leave it undecided, and **assumption-dependent** if an alternative reverses it; **open** is
a check that the baseline leaves undecided. Below each statement are the number that the baseline
gives, the threshold, and the range of the numbers over the alternatives that affect the check.

## The matrix

A row is a check, a column an alternative by its number in the list at the end of this page; the first column, 0, is the
baseline. Signs: `+` supported, `-` refuted, `?` undecided, `.` not affected by the alternative.

"""


def details(matrix):
    parts = [DETAILS + all_verdicts(matrix) + "\n"]
    for name in CONCLUSIONS:
        found = [c for c in matrix["conclusions"] if c["conclusion"] == name]
        parts.append(f"## {name.capitalize()}: {len(found)} of {len(matrix['conclusions'])}\n")
        parts += [check_item(matrix, c) for c in found] + [""] if found else []
    parts.append("## The alternatives\n")
    for choice, group in groupby(range(1, len(matrix["alternatives"])), key=lambda i: matrix["alternatives"][i]["choice"]):
        parts += [f"### {choice}\n", *(alternative_item(matrix, i) for i in group), ""]
    return filled("\n".join(parts))


def all_verdicts(matrix):
    """The matrix as signs, with a space before each group of alternatives."""
    groups = [alternative["choice"] for alternative in matrix["alternatives"]]
    gaps = {i for i in range(1, len(groups)) if groups[i] != groups[i - 1]}
    room = COLUMNS - len(groups) - len(gaps) - 2
    rows = [("".join(SIGNS[cell["verdict"]] if cell["affected"] or i == 0 else UNAFFECTED for i, cell in enumerate(cells)),
             shortened(f"{check['claim']} {check['statement']}", room)) for check, cells in zip(matrix["checks"], matrix["grid"])]
    return signs([str(i) for i in range(len(groups))], rows, gaps)


def shortened(statement, letters):
    return statement if len(statement) <= letters else statement[:letters - 1].rsplit(" ", 1)[0] + " \u2026"


def counts(matrix):
    """How many checks keep their verdict under every alternative, and how many do not."""
    of = {name: sum(c["conclusion"] == name for c in matrix["conclusions"]) for name in CONCLUSIONS}
    return (f"Of {len(matrix['conclusions'])} checks, {of['robust']} have the same verdict under every alternative; some alternative "
            f"leaves {of['weakened']} undecided and reverses {of['assumption-dependent']}; the baseline leaves {of['open']} open.")


def influence(matrix):
    """A row for each open choice: its alternatives, and how many verdicts one of them reverses at most."""
    by_choice = {}
    for index, alternative in enumerate(matrix["alternatives"][1:], 1):
        reversed_by = [check["claim"] for check, cells in zip(matrix["checks"], matrix["grid"]) if reversed_verdict(cells[index], cells[0])]
        by_choice.setdefault(alternative["choice"], []).append((alternative["name"], reversed_by))
    most = {choice: max(found, key=lambda one: len(one[1])) for choice, found in by_choice.items()}
    ranked = sorted((choice for choice in most if choice != TOGETHER), key=lambda choice: -len(most[choice][1]))
    rows = [[choice, str(len(by_choice[choice])), most[choice][0] if most[choice][1] else "", str(len(most[choice][1])),
             " ".join(dict.fromkeys(most[choice][1]))] for choice in ranked]
    return table(["choice", "alternatives", "strongest alternative", "checks that it reverses", "their claims"], *rows) + "\n"


def check_item(matrix, conclusion):
    """An item of a list: the statement, its numbers, and the alternatives that give another verdict."""
    check, cells = matrix["checks"][conclusion["check"]], matrix["grid"][conclusion["check"]]
    lines = [f"- **{check['claim']}**, {conclusion['baseline']}: {check['statement']}", f"  - {numbers(check, cells)}"]
    for verdict in SIGNS:
        names = [a["name"] for a, cell in zip(matrix["alternatives"], cells) if cell["verdict"] == verdict]
        if names and verdict != conclusion["baseline"]:
            lines.append(f"  - {verdict} under: {'; '.join(names)}")
    return "\n".join(lines)


def numbers(check, cells):
    """The baseline's value, the threshold, and the range over the alternatives that affect the check."""
    baseline = [float("nan") if cells[0][key] is None else cells[0][key] for key in ("measured", "uncertainty")]
    values = [c["measured"] for c in cells if c["affected"] and c["measured"] is not None]
    spread = f"{number(min(values), '.3g')} to {number(max(values), '.3g')}" if values else "none"
    threshold = threshold_text(check["is"], check["threshold"], check["band"]).strip()
    return f"baseline {with_uncertainty(*baseline)}; threshold {threshold}; over the alternatives {spread}"


def alternative_item(matrix, index):
    alternative = matrix["alternatives"][index]
    changed = [f"{check['claim']} {cells[index]['verdict']}" for check, cells in zip(matrix["checks"], matrix["grid"])
               if cells[index]["verdict"] != cells[0]["verdict"]]
    return (f"- {index}: **{alternative['name']}**: {alternative['description']}\n"
            f"  - other verdicts than the baseline's: {', '.join(changed) or 'none'}")


if __name__ == "__main__":
    run(main)
