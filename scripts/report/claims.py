"""The checks of a result under each reading of Eq. (17) as rows of a table, in HTML."""

from collections import Counter

import numpy as np

import symbols
from bristle_plots.results import CHOICE_NAMES, readable, table
from bristle_plots.verdicts import (VERDICT_SIGNS, declared_checks, number, p_text, quantity, threshold_text,
                                    with_uncertainty)

ORDER = ["supported", "refuted", "undecided"]


def read(figure, file, names):
    """One row for each check of the experiment, in its order, and each reading; names: the symbols of quantities."""
    if table(file, "checks") is None:
        return []
    return [row(figure, check, claim, names) for check, claim in declared_checks(file)]


def row(figure, check, claim, names):
    return {
        "figure": figure,
        "claim": claim.claim,
        "statement": symbols.prose(claim.statement, names),
        "quantity": quantity(check),
        "measured": with_uncertainty(claim.measured, claim.uncertainty) + p_text(claim),
        "measured_value": sortable(claim.measured),
        "threshold": threshold_text(claim.relation, claim.threshold, claim.band),
        "threshold_value": sortable(claim.threshold),
        "margin": number(claim.margin, "+.3f"),
        "margin_value": sortable(claim.margin),
        "verdict": claim.verdict,
        "sign": sign(claim.verdict),
        "declared": claim.declared,
        "reading": CHOICE_NAMES.get(claim.reading, readable(claim.reading)),
        "reading_word": claim.reading,
        "further": claim.role != "main",
        "claim_verdict": claim.claim_verdict,
        **{key: symbols.prose(check.get(key, ""), names) for key in ("quote", "interpretation", "leaves_open")},
    }


def sign(verdict):
    return VERDICT_SIGNS.get(verdict, ("\u2022",))[0]


def sortable(value):
    return repr(float(value)) if np.isfinite(value) else ""


def by_check(rows):
    """The rows of each check of one result: one for each reading."""
    found = {}
    for row in rows:
        found.setdefault(row["declared"], []).append(row)
    return list(found.values())


def by_claim(rows):
    """For each reading, the claims with their verdicts, and the number of each claim's first check."""
    found = {}
    for row in rows:
        claims = found.setdefault((row["reading"], row["reading_word"]), {})
        claims.setdefault((row["claim"], row["claim_verdict"]), row["declared"])
    return [{"reading": reading, "word": word, "claims": [{"claim": claim, "verdict": verdict, "sign": sign(verdict),
                                                           "declared": declared}
                                                          for (claim, verdict), declared in claims.items()]}
            for (reading, word), claims in found.items()]


def count(rows):
    """Numbers of checks and claims, of claims by verdict under each reading, and of rows by verdict."""
    return {"checks": len({(row["figure"], row["declared"]) for row in rows}),
            "claims": len({row["claim"] for row in rows}), "rows": counted(row["verdict"] for row in rows),
            "readings": [(found["reading"], found["word"], counted(claim["verdict"] for claim in found["claims"]))
                         for found in by_claim(rows)]}


def counted(verdicts):
    """(verdict, number, sign) of each verdict."""
    found = Counter(verdicts)
    return [(verdict, found[verdict], sign(verdict)) for verdict in ORDER + sorted(set(found) - set(ORDER))]
