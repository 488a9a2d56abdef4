"""The checks of a result as rows of a table, in HTML."""

from collections import Counter

import numpy as np

import symbols
from bristle_plots.verdicts import (VERDICT_SIGNS, declared_checks, number, p_text, quantity, threshold_text,
                                    with_uncertainty)

ORDER = ["supported", "refuted", "undecided"]


def read(figure, file):
    """One row for each check of the experiment, in its order."""
    if "checks" not in file:
        return []
    return [row(figure, check, claim) for check, claim in declared_checks(file)]


def row(figure, check, claim):
    return {
        "figure": figure,
        "claim": claim.claim,
        "statement": symbols.prose(claim.statement),
        "quantity": quantity(check),
        "measured": with_uncertainty(claim.measured, claim.uncertainty) + p_text(claim),
        "measured_value": sortable(claim.measured),
        "threshold": threshold_text(claim.relation, claim.threshold, claim.band),
        "threshold_value": sortable(claim.threshold),
        "margin": number(claim.margin, "+.3f"),
        "margin_value": sortable(claim.margin),
        "verdict": claim.verdict,
        "sign": sign(claim.verdict),
        "leaves_open": symbols.prose(check.get("leaves_open", "")),
    }


def sign(verdict):
    return VERDICT_SIGNS.get(verdict, ("\u2022",))[0]


def sortable(value):
    return repr(float(value)) if np.isfinite(value) else ""


def count(rows):
    """Numbers of checks, of claims, and of checks by verdict."""
    found = Counter(row["verdict"] for row in rows)
    verdicts = ORDER + sorted(set(found) - set(ORDER))
    return {"checks": len(rows), "claims": len({row["claim"] for row in rows}),
            "verdicts": [(verdict, found[verdict], sign(verdict)) for verdict in verdicts]}
