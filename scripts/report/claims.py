"""The checks of a result as rows of a table, all in words and HTML."""

from collections import Counter

import numpy as np

import symbols
from findings import checks, quantity
from style import dataset, values
from verdicts import SYMBOLS, demand, number, with_uncertainty

ORDER = ["supported", "refuted", "undecided"]


def read(figure, file):
    """One row for each check of the experiment, in its order."""
    if "checks" not in file:
        return []
    margins, significances = (values(dataset(file["checks"], name)) for name in ("margin", "significance"))
    return [row(figure, check, claim, margins[i], significances[i])
            for i, (check, claim) in enumerate(checks(file))]


def row(figure, check, claim, margin, significance):
    measured = with_uncertainty(claim.measured, claim.uncertainty)
    if np.isfinite(significance):
        measured += f", p = {significance:.1g}" if significance >= 1e-4 else ", p < 0.0001"
    return {
        "figure": figure,
        "claim": claim.claim,
        "statement": symbols.prose(claim.statement),
        "quantity": quantity(check),
        "measured": measured,
        "measured_value": sortable(claim.measured),
        "asked": demand(claim),
        "asked_value": sortable(claim.threshold),
        "margin": number(margin, "+.3f"),
        "margin_value": sortable(margin),
        "verdict": claim.verdict,
        "sign": sign(claim.verdict),
        "leaves_open": symbols.prose(check.get("leaves_open", "")),
    }


def sign(verdict):
    return SYMBOLS.get(verdict, ("\u2022",))[0]


def sortable(value):
    return repr(float(value)) if np.isfinite(value) else ""


def count(rows):
    """How many checks have each verdict, and how many claims they are of."""
    found = Counter(row["verdict"] for row in rows)
    verdicts = ORDER + sorted(set(found) - set(ORDER))
    return {"checks": len(rows), "claims": len({row["claim"] for row in rows}),
            "verdicts": [(verdict, found[verdict], sign(verdict)) for verdict in verdicts]}
