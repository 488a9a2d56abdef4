"""docs/findings.md from result files: every claim with its verdict and a paragraph; the summary in README.md."""

import argparse
import os

import numpy as np

from ..command_line import run
from ..files import write_text
from ..plotting.verdicts import measured_text
from ..results import as_text, open_result, read, status_counts
from .explanations import explain_claim
from .markdown import filled, replace_between, table
from .quantities import PROGRAM, READINGS
from .summary import all_verdicts, claims_of, further, in_context, in_short, joint, own_verdicts, readings_of, verdicts_of

INTRODUCTION = """\
The claims of the paper in the order of its figures, and the verdicts of the computations:
supported, **refuted**, undecided within the uncertainty or because no check of ours decides it, or
depends: supported under one meaning of the sentence or range, and not under another. A claim is named after the figure
beside which it stands; claims of Appendix A begin with A, of the abstract with B, of the conclusions
with C. Findings of this project, which the paper does not claim, begin with F. Every
claim is checked with three models of bending. Two are readings of the paper, whose Eq. (17) has
another denominator than the kinematics of the azimuth theta:

- **corrected**: theta' = (x v_y - y v_x)/s^2, with the distance s of the tip from the pole, the
  vertical through the bristle's root;
- **as printed**: theta' = (x v_y - y v_x)/r^2, with the distance r from the root;
- **rod**: bending without polar coordinates and so without a pole. What holds for the rod, too, is
  the bristle's; what does not may be the coordinates'.

[claims.md](claims.md) describes how claims are checked, [model.md](model.md) the equations and the
baseline: the choices for what the paper leaves open. A paragraph has the checks that decide;
`bristle check RESULT.h5 --all` prints the further ones, too, which are stricter or explain.
`make findings` writes this page and the summary in README.md from the result files; no result in
them is typed. A dash stands for a number that could not be measured: the points have no values
there, or the uncertainty has no bound.
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
    findings = "\n".join(f"- {line}" for line in in_short(found))
    lines = "\n" + filled("\n\n".join([findings, *in_context(found)])) + "\n"
    summary = f"{BEGIN}\n{lines}{END}"
    sections = [section(file, claims, images) for file, claims in found]
    more = "\n".join(f"- {line}" for line in further(found))
    page = filled("\n".join(["# Findings\n\nFor everyone who wants to know what holds.\n\n@summary@\n", INTRODUCTION, overview(found),
                             "## On single claims\n", more + "\n", *sections]))
    write_text(arguments.output, page.replace("@summary@", summary))
    if arguments.readme:
        replace_between(arguments.readme, BEGIN, END, lines)
    checks = sum(len(checks) for _, claims in found for checks in claims.values())
    print(f"{arguments.output}: {checks} checks of {len(files)} results")


def overview(found):
    """A row for each claim: what the paper states in short, and the verdict under each reading."""
    readings = readings_of(found)
    shorts = {check["claim"]: check["short"] for _, claims in found for checks in claims.values() for check, _ in checks
              if "short" in check}
    rows = [[claim, shorts.get(claim, ""), *(emphasised(verdicts.get(reading, "")) for reading in readings)]
            for claim, verdicts in all_verdicts(found).items()]
    own = [[claim, shorts.get(claim, ""), in_words(verdicts)] for claim, verdicts in own_verdicts(found).items()]
    return "\n".join([table(["claim", "the paper, in short", *(READINGS.get(one, one or "verdict") for one in readings)], *rows), "",
                      *([table(["finding", "what we found, in short", "verdict"], *own), ""] if own else [])])


def in_words(verdicts):
    """The verdict by reading in words."""
    if len(verdicts) > 1 and len(set(verdicts.values())) == 1:
        return f"{next(iter(verdicts.values()))} with every model"
    return ", ".join(f"{READINGS.get(reading, reading)} {verdict}".strip() for reading, verdict in verdicts.items())


def emphasised(verdict):
    return f"**{verdict}**" if verdict == "refuted" else verdict


def section(file, claims, images):
    """The claims of a figure; images: the folder of its picture."""
    name, figure = (as_text(file.attrs[key]) for key in ("name", "figure"))
    lines = [f"## {as_text(file.attrs['title'])}", "", provenance(file), ""]
    if os.path.exists(os.path.join(images, f"{name}.png")):
        lines += [f"![{figure and 'Figure '}{figure or name}](images/{name}.png)", ""]
    for claim, checks in claims.items():
        lines += paragraph(file, claim, checks)
    return "\n".join(lines)


def provenance(file):
    """Caption, points by status, passages, the longest ensemble mean of the contact time, digest."""
    points = ", ".join(f"{n} {status}" for status, n in status_counts(file))
    passages = int(np.sum(read(file, "passages")))
    contact = np.nanmax(read(file, "N_c_ratio"))
    caption, digest = (as_text(file.attrs[name]) for name in ("caption", "payload_sha256"))
    return (f"{caption}. Points: {points}; {passages} passages, ensemble mean of the contact time at most "
            f"{contact:.2f} L_x/V_0. Payload SHA-256 `{digest[:16]}`.")


def paragraph(file, claim, checks):
    """Heading with the verdicts, the paper's sentence, what decides, and the reason."""
    lines = [f"### {claim}: {in_words(verdicts_of(checks))}", "", *quotes(checks)]
    text = " ".join(sentence(*pair) for pair in checks if pair[1][0].role == "main")
    return [*lines, f"{text} {reason(file, checks)}".strip(), ""]


def reason(file, checks):
    """Why the last model that does not support the claim does not; empty if all support it."""
    verdicts = verdicts_of(checks)
    unsupported = [reading for reading, verdict in verdicts.items() if verdict != "supported"]
    if not unsupported:
        return ""
    reading = unsupported[-1]
    rows = [(check, row) for check, rows in checks for row in rows if row.reading == reading]
    return f"{why(verdicts[reading])} with the model {READINGS.get(reading, reading)}: {by_meaning(rows)}{explain_claim(file, rows)}"


def why(verdict):
    return "Why it depends" if verdict == "depends" else f"Why it is {verdict}"


def by_meaning(pairs):
    """The verdict under each interpretation of the main checks of one reading; empty if there is one interpretation."""
    found = {}
    for check, row in pairs:
        if row.role == "main":
            meaning = check.get("interpretation", "")
            found[meaning] = joint(row.verdict, found.get(meaning, row.verdict))
    return f"{'; '.join(f'{verdict} if {meaning}' for meaning, verdict in found.items())}. " if len(found) > 1 else ""


def sentence(check, rows):
    """What a check states and requires, and what was measured under each reading."""
    found = [f"{READINGS.get(row.reading, row.reading)} {measured_text(row)}".strip() for row in rows]
    given = f" (if {check['interpretation']})" if check.get("interpretation") else ""
    return f"{check['statement'][0].upper()}{check['statement'][1:]}{given} ({rows[0].required}): {', '.join(found)}."


def quotes(checks):
    return [line for check, _ in checks if "quote" in check for line in (f"The paper: \u201c{check['quote']}\u201d", "")]


if __name__ == "__main__":
    run(main)
