"""The paper's claims beside a figure, with their checks and verdicts for each model of bending, in HTML."""

from collections import Counter

from ..errors import BristleError
from ..pages.explanations import explain_claim, explain_further, what_was_measured
from ..pages.quantities import READINGS
from ..pages.summary import OWN, claims_of, joint, verdicts_of
from ..plotting.verdicts import VERDICT_SIGNS, measured_text, number, p_text
from ..results import readable, table
from . import symbols

ORDER = ["supported", "refuted", "undecided", "depends"]


def read(figure, file, names):
    """The claims in the order of the experiment; names: the symbols of quantities."""
    if table(file, "checks") is None:
        return []
    return [claim_of(figure, file, claim, checks, names) for claim, checks in claims_of(file).items()]


def claim_of(figure, file, claim, checks, names):
    """What the paper says, the main and the further checks, the verdicts, and the reason of each that is not "supported"."""
    def texts(key):
        return [symbols.prose(text, names) for text in dict.fromkeys(check[key] for check, _ in checks if key in check)]

    def explained(reading):
        return explain_claim(file, [(check, row) for check, rows in checks for row in rows if row.reading == reading])

    main, further = ([check_of(file, check, rows, names) for check, rows in checks if (rows[0].role == "main") == of_main]
                     for of_main in (True, False))
    verdicts = [cell(reading, verdict) for reading, verdict in verdicts_of(checks).items()]
    return {"claim": claim, "figure": figure, "place": f"claim-{figure}-{claim}", "short": next(iter(texts("short")), ""), "quotes": texts("quote"),
            "left_open": texts("leaves_open"), "main": main, "further": further, "verdicts": verdicts,
            "whys": [{**found, "text": symbols.prose(attempt(explained, found["word"], checks), names)}
                     for found in verdicts if found["verdict"] != "supported"]}


def overview(claims):
    """A row for each claim in their order: its places, and for each model the verdict of all results that decide it."""
    rows = {}
    for claim in sorted(claims, key=lambda claim: claim["claim"]):
        row = rows.setdefault(claim["claim"], {**claim, "places": []})
        row["places"].append({"figure": claim["figure"], "place": claim["place"]})
        others = {one["word"]: one["verdict"] for one in claim["verdicts"]}
        row["verdicts"] = [cell(one["word"], joint(one["verdict"], others.get(one["word"], one["verdict"]))) for one in row["verdicts"]]
    return list(rows.values())


def attempt(explained, reading, checks):
    """The explanation; for an experiment that lacks what it reads, only what was measured."""
    try:
        return explained(reading)
    except (BristleError, LookupError, ValueError):
        return what_was_measured([(check, row) for check, rows in checks for row in rows
                                  if row.reading == reading and row.role == "main"])


def cell(reading, verdict):
    return {"word": reading, "reading": READINGS.get(reading, readable(reading)), "verdict": verdict, "sign": sign(verdict)}


def check_of(file, check, rows, names):
    """One check: what it measures and requires, and for each model the verdict with its numbers."""
    first = rows[0]
    return {
        "statement": symbols.prose(first.statement, names), "quantity": first.required,
        "interpretation": symbols.prose(check.get("interpretation", ""), names),
        "cells": [{**cell(row.reading, row.verdict), "measured": measured_text(row) + p_text(row),
                   "margin": number(row.margin, "+.3f"), "why": symbols.prose(why_further(file, check, row), names)}
                  for row in rows],
    }


def why_further(file, check, row):
    if row.role == "main" or row.verdict != "refuted":
        return ""
    try:
        return explain_further(file, check, row)
    except (BristleError, LookupError, ValueError):
        return ""


def sign(verdict):
    return VERDICT_SIGNS.get(verdict, ("\u2022",))[0]


def by_reading(claims):
    """For each model, the claims' verdicts as (claim, verdict)."""
    found = {}
    for claim in claims:
        for one in claim["verdicts"]:
            found.setdefault(one["reading"], []).append((claim["claim"], one["verdict"]))
    return found


def count(claims):
    """Numbers of claims of the paper and of all checks, and for each model (verdict, number of claims, sign)."""
    papers = [claim for claim in claims if not claim["claim"].startswith(OWN)]
    return {"claims": len({claim["claim"] for claim in papers}), "checks": sum(len(claim["main"] + claim["further"]) for claim in claims),
            "readings": {reading: counted(verdict for _, verdict in found) for reading, found in by_reading(papers).items()}}


def counted(verdicts):
    found = Counter(verdicts)
    return [(verdict, found[verdict], sign(verdict)) for verdict in ORDER + sorted(set(found) - set(ORDER))]
