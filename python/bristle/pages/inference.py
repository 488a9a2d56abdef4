"""docs/inference.md and docs/generated/inference.md: which joint set of choices agrees best with the paper's sentences."""

import argparse
import os

import numpy as np

from ..command_line import run
from ..files import write_text
from .markdown import filled, signs, table
from .matrix import digest_line, read_matrix

VERDICTS = ("refuted", "undecided", "supported")
SIGNS = "-?+"  # of these
MODELS = {"corrected": "corrected", "printed": "as printed", "rod": "rods"}  # of bending; "corrected" has no name in a set
BEST, RANKED = 5, 15  # sets in the tables of the page, and of the page with all


def short(name):
    for text, instead in (("40 random azimuths", "40 random"), ("18 azimuths", "18 fixed"), ("phi_0 = ", ""), (" deg", "\u00b0")):
        name = name.replace(text, instead)
    return name


class Scores:
    """verdicts[set, window, claim] as indices into VERDICTS; further[set, window]: supported further checks."""

    def __init__(self, matrix):
        checks = matrix["checks"]
        self.sets = [short(alternative["name"]) for alternative in matrix["alternatives"]]
        self.members = [alternative["members"] or [alternative["name"]] for alternative in matrix["alternatives"]]
        self.digest = digest_line(matrix)
        self.windows = list(dict.fromkeys(cell["window"] for cell in matrix["cells"]))
        self.claims = list(dict.fromkeys(check["claim"] for check in checks))
        self.further_checks = sum(check["role"] == "further" for check in checks)
        shape = len(self.sets), len(self.windows)
        self.verdicts = np.zeros((*shape, len(self.claims)), int)
        self.further = np.zeros(shape, int)
        for cell in matrix["cells"]:
            place, check = (cell["alternative"], self.windows.index(cell["window"])), checks[cell["check"]]
            self.verdicts[*place, self.claims.index(check["claim"])] = VERDICTS.index(cell["claim_verdict"])
            self.further[place] += check["role"] == "further" and cell["verdict"] == "supported"

    def supported(self, claims=slice(None)):
        return (self.verdicts[..., claims] == VERDICTS.index("supported")).sum(axis=-1)

    def best_windows(self, claims=slice(None)):
        """For each set the window with most supported claims; of equals that with most further checks."""
        return (1000 * self.supported(claims) + self.further).argmax(axis=1)

    def ranking(self, claims=slice(None)):
        """The sets, best first, and the score of each set: supported claims, supported further checks."""
        windows, rows = self.best_windows(claims), np.arange(len(self.sets))
        score = np.stack([self.supported(claims)[rows, windows], self.further[rows, windows]], axis=1)
        return sorted(rows, key=lambda i: tuple(-score[i])), score


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("matrix", metavar="MATRIX.json", help="output of `bristle assumptions`, see `make inference`")
    parser.add_argument("-o", dest="output", metavar="DIRECTORY", default="docs", help="of inference.md and generated/inference.md")
    arguments = parser.parse_args()
    scores = Scores(read_matrix(arguments.matrix))
    os.makedirs(f"{arguments.output}/generated", exist_ok=True)
    write_text(f"{arguments.output}/generated/inference.md", filled(details(scores)))
    path = f"{arguments.output}/inference.md"
    write_text(path, filled(page(scores)))
    print(path)


def all_verdicts(scores):
    """The sets, best first, and their verdicts on the claims as signs, each set in its best window."""
    order, score = scores.ranking()
    windows = scores.best_windows()
    rows = [("".join(SIGNS[verdict] for verdict in scores.verdicts[i, windows[i]]), f"{score[i][0]}, {score[i][1]}  {scores.sets[i]}")
            for i in order]
    return signs(scores.claims, rows)


def ranking_table(scores, count):
    order, score = scores.ranking()
    windows = scores.best_windows()
    rows = []
    for rank, i in enumerate(order[:count], 1):
        verdicts = scores.verdicts[i, windows[i]]
        window = scores.windows[windows[i]].replace("k_r ", "").replace("k_theta ", "")
        refuted, undecided = (claims_with(scores, verdicts, word).replace(",", "") for word in ("refuted", "undecided"))
        rows.append([str(rank), scores.sets[i], window, f"{score[i][0]}, {score[i][1]}", refuted, undecided])
    return table(["", "set", "window", "supported", "refuted", "undecided"], *rows)


def page(scores):
    return f"""# Inference: what the authors may have computed

For readers of the paper. **This is an inference, not a test.** The paper leaves choices open, and
this page ranks joint sets of choices by how many of the paper's sentences each set supports. The
checks were made from the same sentences, and for each set the best window of the swept ranges is
chosen after the fact. So a high score shows what is compatible with the paper, not that it is true.

{len(scores.sets)} joint sets of choices were tried (`experiments/inference/`): polar coordinates with Eq. (17)
corrected or as printed, or rods; the start in static equilibrium or unstretched; azimuths continuous,
18 fixed or 40 random; phi_0 of 80, 85 or 89 degrees; a tip that is reflected at the pole or crosses it. Each was
checked in {len(scores.windows)} windows of the ranges of k_r and k_theta,
{len(scores.sets) * len(scores.windows)} scores in all, on the {len(scores.claims)} claims of Figures 3 to 8 and
{scores.further_checks} further checks. The sweeps are coarse. `baseline` is the choice of this project. A set that
names no model of bending has Eq. (17) corrected. A mean over a list
of azimuths has no error of quadrature, so fewer of its checks are
undecided than with a continuous distribution: this favours the sets with 18 or 40 azimuths.

The best {BEST} sets, each in its best window of k_r and k_theta, with the numbers of claims and of further checks
that are supported:

{ranking_table(scores, BEST)}

{best_of_models(scores)}
[generated/inference.md](generated/inference.md) has more of the ranking, what it is without each claim, and the claims that
separate the models. `make inference` computes the scores and writes both pages.

{scores.digest}"""


def details(scores):
    return f"""# All joint sets of choices

For readers of [inference.md](../inference.md). `make inference` writes this page.

## Ranking

The best {RANKED} sets, as on that page.

{ranking_table(scores, RANKED)}

## All sets and claims

A row is a set in its best window, best first, with the numbers of claims and of further checks that are supported; a column
is a claim. Signs: `+` supported, `-` refuted, `?` undecided.

{all_verdicts(scores)}

## If one claim is left out

The sets with the highest score (claims, then further checks) if one claim does not count.

{table(["without", "best sets"], *leave_one_out(scores))}

## Which claims separate the models of bending

For each claim, how many sets support it with each model, of {len(shared(scores))} choices of everything else that were tried
with all of them, in the window of the baseline.

{table(["claim", *models(scores)], *separating(scores))}
"""


def claims_with(scores, verdicts, word):
    found = [claim for claim, verdict in zip(scores.claims, verdicts) if VERDICTS[verdict] == word]
    return ", ".join(found) or "none"


def model_of(members):
    return next((member for member in members if member in MODELS), "corrected")


def models(scores):
    """The models of bending of the sets, in the order of MODELS."""
    there = set(map(model_of, scores.members))
    return [model for model in MODELS if model in there]


def best_of_models(scores):
    _, score = scores.ranking()
    parts = []
    for model in models(scores):
        claims, further = max(tuple(s) for s, members in zip(score, scores.members) if model_of(members) == model)
        parts.append(f"{MODELS[model]} {claims} claims and {further} further checks")
    return f"The best sets support: {', '.join(parts)}. The baseline supports {score[0][0]} and {score[0][1]}."


def shared(scores):
    """By what a set chooses beside the model of bending, the number of the set for each model; those with all models."""
    sets = {}
    for i, members in enumerate(scores.members):
        model = model_of(members)
        sets.setdefault(frozenset(members) - {"baseline", model}, {})[model] = i
    return [found for found in sets.values() if len(found) == len(models(scores))]


def leave_one_out(scores):
    rows = []
    for left_out in range(len(scores.claims)):
        claims = [c for c in range(len(scores.claims)) if c != left_out]
        order, score = scores.ranking(claims)
        best = [scores.sets[i] for i in order if tuple(score[i]) == tuple(score[order[0]])]
        rows.append([scores.claims[left_out], "; ".join(best[:2]) + (f" and {len(best) - 2} more" if len(best) > 2 else "")])
    return rows


def separating(scores):
    rows = []
    for c, claim in enumerate(scores.claims):
        counts = [sum(scores.verdicts[found[model], 0, c] == VERDICTS.index("supported") for found in shared(scores))
                  for model in models(scores)]
        rows.append((claim, counts))
    return [[claim, *map(str, counts)] for claim, counts in sorted(rows, key=lambda row: min(row[1]) - max(row[1]))]


if __name__ == "__main__":
    run(main)
