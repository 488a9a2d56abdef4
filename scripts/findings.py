"""docs/findings.md from result files: every claim with its verdict and the numbers behind it."""

import argparse

import numpy as np

from bristle_plots.command_line import run
from bristle_plots.files import write_text
from bristle_plots.markdown import filled, table
from bristle_plots.results import as_text, experiment, open_result, read, status_counts
from bristle_plots.verdicts import declared_checks, p_text, quantity, threshold_text

INTRODUCTION = """\
# Findings

The claims of the paper in the order of its figures, and the verdicts of the computations:
**supported**, **refuted**, or undecided within the uncertainty. docs/claims.md describes how claims
are checked, docs/model.md the baseline: the choices for what the paper leaves open. `make findings`
writes this page from the result files; no number in it is typed.
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", metavar="RESULT.h5", nargs="+", help="result files in the figures' order")
    parser.add_argument("-o", dest="output", metavar="FILE", default="docs/findings.md")
    arguments = parser.parse_args()
    files = [open_result(path) for path in arguments.results]
    write_text(arguments.output, filled("\n".join([INTRODUCTION, overview(files), *map(section, files)])))
    checks = sum(len(declared_checks(file)) for file in files)
    print(f"{arguments.output}: {checks} checks of {len(files)} results")


def overview(files):
    """A row for each claim: the verdicts of its checks."""
    verdicts = {}
    for file in files:
        for check, claim in declared_checks(file):
            verdicts.setdefault(check["claim"], []).append(claim.verdict)
    rows = [[name, ", ".join(map(emphasised, found))] for name, found in verdicts.items()]
    return table(["claim", "verdict"], *rows) + "\n"


def emphasised(verdict):
    return f"**{verdict}**" if verdict == "refuted" else verdict


def section(file):
    lines = [f"## {as_text(file.attrs['title'])}", "", provenance(file), ""]
    checks = declared_checks(file)
    if checks:
        lines += ["\n".join(item(check, claim) for check, claim in checks), ""]
    left_open = {}
    for check, _ in checks:
        if "leaves_open" in check:
            left_open.setdefault(check["leaves_open"], []).append(check["claim"])
    if left_open:
        lines += ["The paper leaves open, and it matters here:", ""]
        lines += [f"- {what} ({', '.join(dict.fromkeys(claims))})" for what, claims in left_open.items()]
        lines.append("")
    for note in experiment(file).get("notes", []):
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


def item(check, claim):
    """An item of a list: the statement, and below it the verdict with its numbers."""
    measured = f"{quantity(check)} {claim.measured:.3f} ± {claim.uncertainty:.3f}{p_text(claim)}"
    threshold = threshold_text(claim.relation, claim.threshold, claim.band).strip()
    return (f"- **{claim.claim}**: {claim.statement}\n"
            f"  - {emphasised(claim.verdict)}: {measured}; threshold {threshold}")


if __name__ == "__main__":
    run(main)
