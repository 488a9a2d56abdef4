"""docs/findings.md from result files: every claim with its verdict and the numbers behind it."""

import argparse
import json

import h5py
import numpy as np

from document import table, write
from style import attribute, dataset, fail, open_result, text, values
from verdicts import read_claims

INTRODUCTION = """\
# What was found

What the paper claims, in the order of its figures, and what the computations say: **supported**, **refuted**, or undecided at
their resolution. How claims are checked is in docs/claims.md, what is assumed where the paper is silent in docs/model.md.
This page is written by `make findings` from the result files; no number in it is typed.
"""

# Predicates that are about both sides of "compare" at once.
PAIRS = ("ordering", "concordance", "equality")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", metavar="RESULT.h5", nargs="+", help="result files in the figures' order")
    parser.add_argument("-o", dest="output", metavar="FILE", default="docs/findings.md")
    arguments = parser.parse_args()
    files = [open_result(path, ["status"]) for path in arguments.results]
    page = "\n".join([INTRODUCTION, overview(files), *map(section, files)])
    write(arguments.output, page)
    print(f"{arguments.output}: {sum(len(checks(file)) for file in files)} checks of {len(files)} results")


def experiment(file):
    return json.loads(text(file.attrs["experiment"]))


def checks(file):
    """The experiment's checks, each with its measured row of /checks."""
    declared = experiment(file).get("checks", [])
    measured = read_claims(file)
    if [check["claim"] for check in declared] != [row.claim for row in measured]:
        fail(f"{file.filename}: /checks is not that of the experiment; run `bristle run` again")
    return list(zip(declared, measured))


def overview(files):
    """One line per claim: the verdicts of its checks."""
    verdicts = {}
    for file in files:
        for check, row in checks(file):
            verdicts.setdefault(check["claim"], []).append(row.verdict)
    rows = [[claim, ", ".join(map(emphasised, found))] for claim, found in verdicts.items()]
    return table(["claim", "verdict"], *rows) + "\n"


def emphasised(verdict):
    return f"**{verdict}**" if verdict == "refuted" else verdict


def section(file):
    lines = [f"## {text(file.attrs['title'])}", "", provenance(file), ""]
    rows = checks(file)
    if rows:
        cells = [table_row(file, check, index) for index, (check, _) in enumerate(rows)]
        lines += [table(["claim", "statement", "verdict", "measured", "asked"], *cells), ""]
    opened = {}
    for check, _ in rows:
        if "leaves_open" in check:
            opened.setdefault(check["leaves_open"], []).append(check["claim"])
    if opened:
        lines += ["The paper leaves open, and it matters here:", ""]
        lines += [f"- {what} ({', '.join(dict.fromkeys(claims))})" for what, claims in opened.items()]
        lines.append("")
    for note in experiment(file).get("notes", []):
        lines += [note, ""]
    return "\n".join(lines)


def provenance(file):
    """What the numbers are of: caption, points by status, passages, how long bristles stay, digest."""
    status = dataset(file, "status")
    names = attribute(status, "flag_meanings").split()
    counts = np.bincount(np.ravel(values(status)), minlength=len(names))
    points = ", ".join(f"{n} {name.replace('_', ' ')}" for name, n in zip(names, counts) if n and name != "absent")
    passages = int(np.sum(values(dataset(file, "passages"))))
    digest = text(file.attrs["payload_sha256"])
    contact = np.nanmax(values(dataset(file, "N_c_ratio")))
    return (f"{text(file.attrs['caption'])}. Points: {points}; {passages} passages, in the mean at most {contact:.2f} L_x/V_0 long. "
            f"Payload SHA-256 `{digest[:16]}`.")


def table_row(file, check, index):
    group = file["checks"]
    measured, uncertainty, threshold = (float(group[name][index]) for name in ("measured", "uncertainty", "threshold"))
    significance, band = (float(group[name][index]) for name in ("significance", "band"))
    found = f"{measured:.3f} ± {uncertainty:.3f}"
    if np.isfinite(significance):
        found += f", p {significance:.1g}" if significance >= 1e-4 else ", p < 0.0001"
    asked = {"at_most": f"≤ {threshold:.3g}", "at_least": f"≥ {threshold:.3g}",
             "near": f"{threshold:.3g} ± {band:.3g}"}[check["is"]]
    verdict = text(group["verdict"][index])
    return [check["claim"], check["statement"], emphasised(verdict), f"{quantity(check)} {found}", asked]


def quantity(check):
    """What the check measures, in words."""
    what = check["predicate"].replace("_", " ")
    if "compare" in check and check["predicate"] not in PAIRS:
        return f"{check.get('by', 'ratio')} of {what}"
    return what


if __name__ == "__main__":
    main()
