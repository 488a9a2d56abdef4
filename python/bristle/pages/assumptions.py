"""How the verdicts depend on what the paper leaves open: docs/assumptions.md."""

import argparse

from ..command_line import run
from ..files import write_text
from .markdown import filled, table
from .matrix import TOGETHER, digest_line, read_matrix, reversed_verdict

CONCLUSIONS = ("robust", "weakened", "assumption-dependent", "open")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("matrix", metavar="MATRIX.json", help="output of `bristle assumptions`")
    parser.add_argument("--text", metavar="FILE", default="docs/assumptions.md", help="where to write it (default: %(default)s)")
    arguments = parser.parse_args()
    matrix = read_matrix(arguments.matrix)
    write_text(arguments.text, filled(TEXT.format(tier=matrix["tier"], digest=digest_line(matrix).strip(),
                                                  counts=counts(matrix)) + influence(matrix)))


TEXT = """\
# How the verdicts depend on what the paper leaves open

For readers who doubt a verdict. The paper does not state everything that its numbers depend on. The baseline, described in
[model.md](model.md), makes a choice for each point that the paper leaves open; here each choice is replaced by
alternatives, singly and some together (experiments/assumptions/), and the checks of these experiments are judged again.
`make assumptions` computes the matrix and writes this page; no number in it is typed. The runs are of
the experiments' `{tier}` tier, which is coarser than the figures: a verdict of the baseline may differ from the verdict in
[findings.md](findings.md), and alternatives are compared with the baseline of the same tier. The lattices
of Figure A2 have a gap of 0.5 there and not a load of 2, which changes the verdict on A2.

{digest} {counts} `reference/assumptions.json` has every check with the numbers under its alternatives, and
`bristle assumptions` prints the conclusion on each.

## The choices that matter

"""

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


if __name__ == "__main__":
    run(main)
