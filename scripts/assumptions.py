"""What hangs on what the paper leaves open: the matrix of claims and alternatives as a figure, and as text."""

import argparse
import json
from collections import namedtuple
from itertools import groupby

from matplotlib import patches
from matplotlib.figure import Figure

from document import table, write
from style import BLUE, GREEN, GREY, VERMILION, apply_look, fail, prose, save
from verdicts import number, with_uncertainty

SCHEMA = "bristle-assumptions/1"
LETTERS = {"supported": ("+", GREEN), "refuted": ("\u2212", VERMILION), "undecided": ("?", BLUE)}

CELL_INCHES = 0.27
LEFT_INCHES, RIGHT_INCHES, TOP_INCHES, BOTTOM_INCHES = 5.6, 1.3, 2.7, 0.75
STATEMENT_LETTERS = 62

# cells[check][alternative]
Study = namedtuple("Study", "tier program checks alternatives cells conclusions")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("matrix", metavar="MATRIX.json", help="what `bristle assumptions` writes")
    parser.add_argument("-o", dest="directory", metavar="DIRECTORY", default="figures",
                        help="where to write assumptions.pdf and .png (default: %(default)s)")
    parser.add_argument("--text", metavar="FILE", help="where to write the account in words (Markdown)")
    arguments = parser.parse_args()
    study = read(arguments.matrix)
    apply_look()
    save(draw(study), arguments.directory, "assumptions")
    if arguments.text:
        write(arguments.text, account(study))


def read(path):
    try:
        with open(path, encoding="utf-8") as file:
            data = json.load(file)
    except OSError as error:
        fail(f"{path}: {error.strerror}; `make assumptions` writes it")
    except ValueError as error:
        fail(f"{path}: not JSON: {error}")
    if not isinstance(data, dict) or data.get("schema") != SCHEMA:
        fail(f"{path}: not a matrix of assumptions ({SCHEMA})")
    cells = [[None] * len(data["alternatives"]) for _ in data["checks"]]
    for cell in data["cells"]:
        cells[cell["check"]][cell["alternative"]] = cell
    return Study(data["tier"], data["program"], data["checks"], data["alternatives"], cells, data["conclusions"])


def draw(study):
    """Rows are checks, columns alternatives; a pale cell is one that the alternative cannot change."""
    rows, columns = len(study.checks), len(study.alternatives)
    width = LEFT_INCHES + CELL_INCHES * columns + RIGHT_INCHES
    height = TOP_INCHES + CELL_INCHES * rows + BOTTOM_INCHES
    figure = Figure(figsize=(width, height))
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, width), ylim=(height, 0))
    axes.axis("off")
    axes.text(width / 2, 0.15, "What hangs on what the paper leaves open", ha="center", va="top", fontsize=14)
    for index, check in enumerate(study.checks):
        draw_row(axes, study, index, check)
    for index, alternative in enumerate(study.alternatives):
        axes.text(column_x(index) + CELL_INCHES / 2, TOP_INCHES - 0.08, alternative["name"], rotation=60,
                  rotation_mode="anchor", fontsize=8.5, va="center")
    draw_borders(axes, study)
    draw_legend(axes, height - 0.45)
    return figure


def column_x(index):
    return LEFT_INCHES + CELL_INCHES * index


def row_y(index):
    return TOP_INCHES + CELL_INCHES * index


def draw_row(axes, study, index, check):
    y = row_y(index) + CELL_INCHES / 2
    statement = check["statement"]
    if len(statement) > STATEMENT_LETTERS:
        statement = statement[:STATEMENT_LETTERS - 1].rsplit(" ", 1)[0] + " \u2026"
    axes.text(0.15, y, check["claim"], va="center", fontsize=9, weight="bold")
    axes.text(0.55, y, prose(statement, 200), va="center", fontsize=8.5)
    axes.text(LEFT_INCHES - 0.1, y, study.conclusions[index]["conclusion"], va="center", ha="right", fontsize=8.5,
              color=GREY)
    for column, cell in enumerate(study.cells[index]):
        draw_cell(axes, column_x(column), row_y(index), cell)


def draw_cell(axes, x, y, cell):
    letter, colour = LETTERS[cell["verdict"]]
    shade = 0.85 if cell["affected"] else 0.18
    axes.add_patch(patches.Rectangle((x, y), CELL_INCHES, CELL_INCHES, facecolor=colour, alpha=shade,
                                     edgecolor="white", linewidth=1.2))
    axes.text(x + CELL_INCHES / 2, y + CELL_INCHES / 2, letter, ha="center", va="center", fontsize=9,
              color="white" if cell["affected"] else GREY, weight="bold")


def draw_borders(axes, study):
    """A line before each group of alternatives, and between figures."""
    bottom = row_y(len(study.checks))
    column = 0
    for _, group in groupby(study.alternatives, key=lambda a: a["choice"]):
        axes.plot([column_x(column)] * 2, [TOP_INCHES - 0.05, bottom], color="black", linewidth=0.8)
        column += len(list(group))
    row = 0
    for _, group in groupby(study.checks, key=lambda c: c["experiment"]):
        axes.plot([0.15, column_x(len(study.alternatives))], [row_y(row)] * 2, color=GREY, linewidth=0.5)
        row += len(list(group))


def draw_legend(axes, y):
    x = 0.15
    for verdict in LETTERS:
        draw_cell(axes, x, y, {"verdict": verdict, "affected": True})
        axes.text(x + 0.35, y + CELL_INCHES / 2, verdict, va="center", fontsize=9)
        x += 1.35
    draw_cell(axes, x, y, {"verdict": "supported", "affected": False})
    axes.text(x + 0.35, y + CELL_INCHES / 2, "pale: the alternative does not touch this claim's experiment",
              va="center", fontsize=9)


TEXT = """\
# What hangs on what the paper leaves open

The paper does not say everything that its numbers depend on. docs/model.md settles what it leaves open; here each choice is
settled otherwise, one at a time and some together (experiments/assumptions/), and every claim is checked again. `make assumptions` computes it and writes
this page; no number in it is typed. The runs are of the experiments' `{tier}` tier, coarser than the figures': a verdict
under "settled" may differ from that in docs/findings.md, and comparisons are with "settled".

![The matrix of claims and alternatives](images/assumptions.png)

A check is **robust** if its verdict is the same under every alternative, **weakened** if some leave it undecided, and it **hangs** on a
choice if an alternative reverses it; **open** is a check that the settled assumptions do not decide themselves.
"""


def account(study):
    parts = [TEXT.format(tier=study.tier), influence(study)]
    for conclusion, title in (("robust", "Robust"), ("weakened", "Weakened"), ("hangs", "Hangs on an assumption"),
                              ("open", "Open")):
        found = [c for c in study.conclusions if c["conclusion"] == conclusion]
        parts.append(f"## {title}: {len(found)} of {len(study.conclusions)}\n")
        parts += [sentence(study, c) for c in found] + [""] if found else []
    alternatives = [alternative_row(study, i) for i in range(1, len(study.alternatives))]
    parts += ["## The alternatives\n",
              table(["what is open", "alternative", "what is assumed", "verdicts other than settled"], *alternatives),
              "\n## The numbers\n", number_table(study)]
    return "\n".join(parts) + "\n"


def influence(study):
    """The open choices by the verdicts that an alternative of theirs reverses at most."""
    most = {}
    for index, alternative in enumerate(study.alternatives[1:], 1):
        reversals = sum({cells[0]["verdict"], cells[index]["verdict"]} == {"supported", "refuted"} for cells in study.cells)
        most[alternative["choice"]] = max(most.get(alternative["choice"], 0), reversals)
    ranked = sorted((choice for choice in most if most[choice] and choice != "together"), key=lambda c: -most[c])
    harmless = [choice for choice in most if not most[choice]]
    return (f"The choices that matter, with the verdicts that one alternative reverses: "
            f"{', '.join(f'{choice} ({most[choice]})' for choice in ranked)}. "
            f"No verdict is reversed by {', '.join(harmless)}.\n")


def sentence(study, conclusion):
    check = study.checks[conclusion["check"]]
    line = f"- {check['claim']}, {conclusion['settled']}: {check['statement']}."
    cells = study.cells[conclusion["check"]]
    for verdict in LETTERS:
        names = [a["name"] for a, cell in zip(study.alternatives, cells) if cell["verdict"] == verdict]
        if names and verdict != conclusion["settled"]:
            line += f" {verdict.capitalize()} under: {', '.join(names)}."
    return line


def alternative_row(study, index):
    alternative = study.alternatives[index]
    changed = [f"{study.checks[row]['claim']} {cells[index]['verdict']}" for row, cells in enumerate(study.cells)
               if cells[index]["verdict"] != cells[0]["verdict"]]
    return [alternative["choice"], alternative["name"], alternative["description"], ", ".join(changed) or "none"]


def number_table(study):
    """Settled value, and the range over the alternatives that touch the check."""
    rows = []
    for check, cells in zip(study.checks, study.cells):
        values = [c["measured"] for c in cells if c["affected"] and c["measured"] is not None]
        spread = f"{number(min(values), '.3g')} to {number(max(values), '.3g')}" if values else "none"
        asked = {"at_most": "\u2264 ", "at_least": "\u2265 ", "near": ""}[check["is"]] + number(check["threshold"], ".3g")
        if check["band"] is not None:
            asked += f" \u00b1 {number(check['band'], '.3g')}"
        settled = [float("nan") if cells[0][key] is None else cells[0][key] for key in ("measured", "uncertainty")]
        rows.append([check["claim"], check["statement"], with_uncertainty(*settled), asked, spread])
    return table(["claim", "statement", "settled", "asked", "over the alternatives"], *rows)


if __name__ == "__main__":
    main()
