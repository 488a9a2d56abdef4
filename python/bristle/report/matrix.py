"""The assumptions matrix on the page: how the verdicts change under alternatives to the baseline."""

import os
from itertools import groupby

from ..errors import BristleError
from ..pages.matrix import TOGETHER, read_matrix
from ..plotting.verdicts import FURTHER_SYMBOLS, number, threshold_text, with_uncertainty
from . import symbols
from .claims import sign

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
    """Rows grouped by claim, columns grouped by choice, a sentence for each claim; the details of all cells, row by row."""
    claims = [claim_rows(claim, rows, document, names) for claim, rows in by_claim(document["checks"])]
    return {
        "path": os.path.basename(path),
        "tier": document["tier"],
        "program": document["program"],
        "choices": [(symbols.prose(choice or "baseline", FURTHER_SYMBOLS), len(list(group)))
                    for choice, group in groupby(document["alternatives"], lambda alternative: alternative["choice"])],
        "alternatives": [{"name": symbols.prose(one["name"], FURTHER_SYMBOLS), "description": one["description"]}
                         for one in document["alternatives"]],
        "claims": claims,
        "details": [f"{claim['claim']}, {cell['alternative']}: {cell['details']}"
                    for claim in claims for check in claim["checks"] for cell in check["cells"]],
    }


def by_claim(checks):
    found = {}
    for i, check in enumerate(checks):
        found.setdefault(check["claim"], []).append((i, check))
    return found.items()


def claim_rows(claim, rows, document, names):
    """One claim: its sentence and its checks with their cells."""
    def statement(check):
        return check["statement"], names.get(check["experiment"], FURTHER_SYMBOLS)

    return {"claim": claim, "sentence": sentence(rows, document),
            "checks": [{"statement": symbols.prose(*statement(check)), "experiment": check["experiment"],
                        "plain": symbols.plain(*statement(check)),
                        "cells": [cell(found, document["grid"][i][0], alternative, check)
                                  for found, alternative in zip(document["grid"][i], document["alternatives"])]}
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


def sentence(rows, document):
    """The conclusions on the claim's checks, the open choices on which they depend, and the verdicts that change."""
    found = [document["conclusions"][i] for i, _ in rows]
    words = dict.fromkeys(one["conclusion"] for one in found)
    depends = dict.fromkeys(choice for one in found for choice in one["depends_on"] if choice != TOGETHER)
    changes = dict.fromkeys(f"{alternative['name']}: {one['baseline']} \u2192 {cell['verdict']}" for one in found
                            for alternative, cell in zip(document["alternatives"], document["grid"][one["check"]])
                            if alternative["name"] in one["other"] + one["undecided"])
    text = ", ".join(words) + (f": depends on {', '.join(depends)}" if depends else "")
    return {"text": symbols.prose(text, FURTHER_SYMBOLS), "changes": [symbols.prose(one, FURTHER_SYMBOLS) for one in changes]}
