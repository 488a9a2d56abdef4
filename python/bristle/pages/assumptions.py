"""How the verdicts depend on what the paper leaves open: docs/assumptions.md, and the whole matrix as a figure and in
docs/generated/assumptions.md."""

import argparse
import os
from itertools import groupby

from matplotlib import patches
from matplotlib.figure import Figure

from ..command_line import run
from ..files import save_figure, write_text
from ..plotting.style import BLUE, GREEN, GREY, VERMILION, apply_look, wrapped
from ..plotting.verdicts import number, threshold_text, with_uncertainty
from .markdown import filled, table
from .matrix import TOGETHER, digest_line, read_matrix, reversed_verdict

SIGNS = {"supported": ("+", GREEN), "refuted": ("\u2212", VERMILION), "undecided": ("?", BLUE)}
CONCLUSIONS = ("robust", "weakened", "assumption-dependent", "open")

CELL_INCHES = 0.27
LEFT_INCHES, RIGHT_INCHES, TOP_INCHES, BOTTOM_INCHES = 6.1, 1.3, 2.7, 0.75
STATEMENT_LETTERS = 62


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("matrix", metavar="MATRIX.json", help="output of `bristle assumptions`")
    parser.add_argument("-o", dest="directory", metavar="DIRECTORY", default="figures",
                        help="where to write assumptions.pdf and .png (default: %(default)s)")
    parser.add_argument("--text", metavar="FILE", help="where to write what matters in words (Markdown)")
    parser.add_argument("--details", metavar="FILE", help="where to write the verdicts on every check (Markdown)")
    arguments = parser.parse_args()
    matrix = read_matrix(arguments.matrix)
    apply_look()
    save_figure(draw(matrix), arguments.directory, "assumptions")
    if arguments.text:
        write_text(arguments.text, filled(TEXT.format(tier=matrix["tier"], digest=digest_line(matrix).strip(),
                                                      counts=counts(matrix)) + influence(matrix)))
    if arguments.details:
        os.makedirs(os.path.dirname(arguments.details) or ".", exist_ok=True)
        write_text(arguments.details, details(matrix))


def draw(matrix):
    """Rows are checks, columns alternatives; pale: the alternative does not affect the check."""
    rows, columns = len(matrix["checks"]), len(matrix["alternatives"])
    width = LEFT_INCHES + CELL_INCHES * columns + RIGHT_INCHES
    height = TOP_INCHES + CELL_INCHES * rows + BOTTOM_INCHES
    figure = Figure(figsize=(width, height))
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, width), ylim=(height, 0))
    axes.axis("off")
    axes.text(width / 2, 0.15, "How the verdicts depend on what the paper leaves open", ha="center", va="top",
              fontsize=14)
    for index, check in enumerate(matrix["checks"]):
        draw_row(axes, matrix, index, check)
    for index, alternative in enumerate(matrix["alternatives"]):
        axes.text(column_x(index) + CELL_INCHES / 2, TOP_INCHES - 0.08, alternative["name"], rotation=60,
                  rotation_mode="anchor", fontsize=8.5, va="center")
    draw_borders(axes, matrix)
    draw_legend(axes, height - 0.45)
    return figure


def column_x(index):
    return LEFT_INCHES + CELL_INCHES * index


def row_y(index):
    return TOP_INCHES + CELL_INCHES * index


def draw_row(axes, matrix, index, check):
    y = row_y(index) + CELL_INCHES / 2
    statement = check["statement"]
    if len(statement) > STATEMENT_LETTERS:
        statement = statement[:STATEMENT_LETTERS - 1].rsplit(" ", 1)[0] + " \u2026"
    axes.text(0.15, y, check["claim"], va="center", fontsize=9, weight="bold")
    axes.text(0.55, y, wrapped(statement, 200), va="center", fontsize=8.5)
    axes.text(LEFT_INCHES - 0.1, y, matrix["conclusions"][index]["conclusion"], va="center", ha="right",
              fontsize=8.5, color=GREY)
    for column, cell in enumerate(matrix["grid"][index]):
        draw_cell(axes, column_x(column), row_y(index), cell)


def draw_cell(axes, x, y, cell):
    sign, colour = SIGNS[cell["verdict"]]
    shade = 0.85 if cell["affected"] else 0.18
    axes.add_patch(patches.Rectangle((x, y), CELL_INCHES, CELL_INCHES, facecolor=colour, alpha=shade,
                                     edgecolor="white", linewidth=1.2))
    axes.text(x + CELL_INCHES / 2, y + CELL_INCHES / 2, sign, ha="center", va="center", fontsize=9,
              color="white" if cell["affected"] else GREY, weight="bold")


def draw_borders(axes, matrix):
    """A line before each group of alternatives, and between figures."""
    bottom = row_y(len(matrix["checks"]))
    column = 0
    for _, group in groupby(matrix["alternatives"], key=lambda a: a["choice"]):
        axes.plot([column_x(column)] * 2, [TOP_INCHES - 0.05, bottom], color="black", linewidth=0.8)
        column += len(list(group))
    row = 0
    for _, group in groupby(matrix["checks"], key=lambda c: c["experiment"]):
        axes.plot([0.15, column_x(len(matrix["alternatives"]))], [row_y(row)] * 2, color=GREY, linewidth=0.5)
        row += len(list(group))


def draw_legend(axes, y):
    x = 0.15
    for verdict in SIGNS:
        draw_cell(axes, x, y, {"verdict": verdict, "affected": True})
        axes.text(x + 0.35, y + CELL_INCHES / 2, verdict, va="center", fontsize=9)
        x += 1.35
    draw_cell(axes, x, y, {"verdict": "supported", "affected": False})
    axes.text(x + 0.35, y + CELL_INCHES / 2, "pale: the alternative does not affect this claim's experiment",
              va="center", fontsize=9)


TEXT = """\
# How the verdicts depend on what the paper leaves open

For readers who doubt a verdict. The paper does not state everything that its numbers depend on. The baseline, described in
[model.md](model.md), makes a choice for each point that it leaves open; here each choice is replaced by
alternatives, singly and some together (experiments/assumptions/), and every claim is checked again.
`make assumptions` computes the matrix and writes this page; no number in it is typed. The runs are of
the experiments' `{tier}` tier, which is coarser than the figures: a baseline verdict may differ from that in
[findings.md](findings.md), and alternatives are compared with the baseline of the same tier. The lattices
of Figure A2 have a gap of 0.5 there and not a load of 2, which changes the verdict on A2.

{digest} {counts} [generated/assumptions.md](generated/assumptions.md) has every check with the numbers under its
alternatives, and a picture of the matrix.

## The choices that matter

"""

DETAILS = """\
# Every check under every alternative

For readers of [assumptions.md](../assumptions.md) who look for one check. `make assumptions` writes this page.

![The matrix of claims and alternatives](../images/assumptions.png)

A check is **robust** if its verdict is the same under every alternative, **weakened** if some
alternatives leave it undecided, and **assumption-dependent** if an alternative reverses it; **open** is
a check that the baseline leaves undecided. Below each statement are the number that the baseline
gives, the threshold, and the range of the numbers over the alternatives that affect the check.
"""


def details(matrix):
    parts = [DETAILS]
    for name in CONCLUSIONS:
        found = [c for c in matrix["conclusions"] if c["conclusion"] == name]
        parts.append(f"## {name.capitalize()}: {len(found)} of {len(matrix['conclusions'])}\n")
        parts += [check_item(matrix, c) for c in found] + [""] if found else []
    parts.append("## The alternatives\n")
    for choice, group in groupby(range(1, len(matrix["alternatives"])), key=lambda i: matrix["alternatives"][i]["choice"]):
        parts += [f"### {choice}\n", *(alternative_item(matrix, i) for i in group), ""]
    return filled("\n".join(parts))


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
    rows = [[choice, str(len(by_choice[choice])), str(len(most[choice][1])), most[choice][0] if most[choice][1] else "",
             " ".join(dict.fromkeys(most[choice][1]))] for choice in ranked]
    return table(["choice", "alternatives", "verdicts that one reverses", "the one that reverses most", "claims"], *rows) + "\n"


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
    return (f"- **{alternative['name']}**: {alternative['description']}\n"
            f"  - other verdicts than the baseline's: {', '.join(changed) or 'none'}")


if __name__ == "__main__":
    run(main)
