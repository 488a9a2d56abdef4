"""The assumptions matrix on the page: how the verdicts change under alternatives to the baseline."""

import os
from itertools import groupby

import symbols
from bristle_plots.assumptions import TOGETHER, cells_by_place, read_matrix
from bristle_plots.errors import BristleError
from bristle_plots.verdicts import FURTHER_SYMBOLS, number, threshold_text, with_uncertainty
from claims import sign

LETTERS = {"supported": "S", "refuted": "R", "undecided": "U"}


def read(paths, names):
    """The matrix of the first file that exists; None without one. names: by experiment the symbols of quantities."""
    path = next(filter(os.path.exists, paths), None)
    if path is None:
        return None
    try:
        return matrix(path, read_matrix(path), names)
    except (KeyError, TypeError, IndexError, AttributeError) as error:
        raise BristleError(f"{path}: not a valid matrix ({type(error).__name__}: {error})") from error


def matrix(path, document, names):
    """Rows grouped by claim, columns grouped by choice, a sentence for each claim."""
    checks, alternatives = document["checks"], document["alternatives"]
    cells = cells_by_place(document)
    baselines = [j for j, alternative in enumerate(alternatives) if alternative["choice"] == ""]
    if len(baselines) != 1:
        raise BristleError(f"{path}: {len(baselines)} alternatives have no choice; only the baseline has none")
    conclusions = {one["check"]: one for one in document["conclusions"]}
    order = baselines + [j for j in range(len(alternatives)) if j not in baselines]
    return {
        "path": os.path.basename(path),
        "tier": document.get("tier", ""),
        "program": {"version": "", "commit": "", **document.get("program", {})},
        "choices": [(choice or "baseline", len(list(group)))
                    for choice, group in groupby(order, lambda j: alternatives[j]["choice"])],
        "alternatives": [{**alternatives[j], "index": j} for j in order],
        "claims": [claim_rows(claim, rows, cells, alternatives, order, conclusions, names) for claim, rows in by_claim(checks)],
    }


def by_claim(checks):
    found = {}
    for i, check in enumerate(checks):
        found.setdefault(check["claim"], []).append((i, check))
    return found.items()


def claim_rows(claim, rows, cells, alternatives, order, conclusions, names):
    """One claim: its sentence and its checks with their cells; order[0] is the baseline."""
    def statement(check):
        return check["statement"], names.get(check["experiment"], FURTHER_SYMBOLS)

    return {"claim": claim, "sentence": sentence(rows, cells, alternatives, conclusions),
            "checks": [{"statement": symbols.prose(*statement(check)), "experiment": check["experiment"],
                        "plain": symbols.plain(*statement(check)),
                        "cells": [cell(cells[i, j], cells[i, order[0]], alternatives[j], check)
                                  for j in order]}
                       for i, check in rows]}


def value(found, key):
    return float("nan") if found.get(key) is None else float(found[key])


def cell(found, baseline, alternative, check):
    """A cell's content, and the text shown when it is selected."""
    verdict = found["verdict"]
    margin = number(value(found, "margin"), "+.3f")
    limit = threshold_text(check["is"], check["threshold"], check.get("band"))
    measured = with_uncertainty(value(found, "measured"), value(found, "uncertainty"))
    details = f"{sign(verdict)} {verdict}: measured {measured}, threshold {limit}, margin {margin}"
    if not found["affected"]:
        details += "; this choice is not in the experiment's input: the numbers are the baseline's"
    return {"letter": LETTERS.get(verdict, "?"), "verdict": verdict, "margin": margin,
            "changed": baseline["verdict"] != verdict,
            "affected": bool(found["affected"]), "alternative": alternative["name"], "details": details}


def sentence(rows, cells, alternatives, conclusions):
    """The conclusions on the claim's checks, the open choices on which they depend, and the verdicts that change."""
    found = [conclusions[i] for i, _ in rows]
    words = dict.fromkeys(one["conclusion"] for one in found)
    depends = dict.fromkeys(choice for one in found for choice in one["depends_on"] if choice != TOGETHER)
    changes = dict.fromkeys(f"{alternatives[j]['name']}: {one['baseline']} \u2192 {cells[one['check'], j]['verdict']}"
                            for one in found for j, alternative in enumerate(alternatives)
                            if alternative["name"] in one["other"] + one["undecided"])
    text = ", ".join(words) + (f": depends on {', '.join(depends)}" if depends else "")
    return {"text": text, "changes": list(changes)}
