"""The assumptions matrix: how the verdicts change when what the paper leaves open is settled otherwise."""

import json
import os
from itertools import groupby

import symbols
from claims import sign
from style import fail
from verdicts import number, with_uncertainty

SCHEMA = "bristle-assumptions/1"
TOGETHER = "together"  # the choice of alternatives that are assumed at once
LETTERS = {"supported": "S", "refuted": "R", "undecided": "U"}


def read(paths):
    """The matrix of the first file that is there; None without one."""
    for path in paths:
        if os.path.exists(path):
            return matrix(path, load(path))
    return None


def load(path):
    try:
        with open(path, encoding="utf-8") as file:
            document = json.load(file)
    except (OSError, ValueError) as error:
        fail(f"{path}: not a file of assumptions ({error})")
    schema = document.get("schema") if isinstance(document, dict) else None
    if schema != SCHEMA:
        fail(f"{path}: schema {schema or 'none'}; this script reads {SCHEMA}")
    return document


def matrix(path, document):
    """Rows grouped by claim, columns grouped by choice, a sentence for each claim."""
    try:
        checks, alternatives = document["checks"], document["alternatives"]
        cells = {(cell["check"], cell["alternative"]): cell for cell in document["cells"]}
        known = {(i, j) for i in range(len(checks)) for j in range(len(alternatives))}
        if len(cells) < len(document["cells"]) or not known.issuperset(cells):
            fail(f"{path}: a cell is there twice, or is of a check or an alternative that is not there")
        settled = [j for j, alternative in enumerate(alternatives) if alternative["choice"] == ""]
        if len(settled) != 1:
            fail(f"{path}: {len(settled)} alternatives without a choice; the settled one is needed")
        order = settled + [j for j in range(len(alternatives)) if j not in settled]
        return {
            "path": os.path.basename(path),
            "tier": document.get("tier", ""),
            "program": {"version": "", "commit": "", **document.get("program", {})},
            "choices": [(choice or "settled", len(list(group)))
                        for choice, group in groupby(order, lambda j: alternatives[j]["choice"])],
            "alternatives": [{**alternatives[j], "index": j} for j in order],
            "claims": [claim_rows(claim, rows, cells, alternatives, order, settled[0])
                       for claim, rows in by_claim(checks)],
        }
    except (KeyError, TypeError, IndexError, AttributeError) as error:
        fail(f"{path}: not as {SCHEMA} says ({type(error).__name__}: {error})")


def by_claim(checks):
    found = {}
    for i, check in enumerate(checks):
        found.setdefault(check["claim"], []).append((i, check))
    return found.items()


def claim_rows(claim, rows, cells, alternatives, order, settled):
    return {"claim": claim, "sentence": sentence(rows, cells, alternatives, settled),
            "checks": [{"statement": symbols.prose(check["statement"]), "experiment": check["experiment"],
                        "plain": symbols.plain(check["statement"]),
                        "cells": [cell(cells.get((i, j)), cells.get((i, settled)), alternatives[j], check)
                                  for j in order]}
                       for i, check in rows]}


def value(found, key):
    return float("nan") if found.get(key) is None else float(found[key])


def cell(found, settled, alternative, check):
    """What a cell shows, and what it says when it is chosen."""
    if found is None:
        return {"letter": "\u2013", "verdict": "missing", "changed": False, "affected": True,
                "margin": "", "alternative": alternative["name"], "says": "not computed"}
    verdict = found["verdict"]
    margin = number(value(found, "margin"), "+.3f")
    measured = with_uncertainty(value(found, "measured"), value(found, "uncertainty"))
    says = f"{sign(verdict)} {verdict}: measured {measured}, asked {asked(check)}, margin {margin}"
    if not found["affected"]:
        says += "; this choice is not in the experiment's input, the numbers are those of the settled one"
    return {"letter": LETTERS.get(verdict, "?"), "verdict": verdict, "margin": margin,
            "changed": settled is not None and settled["verdict"] != verdict,
            "affected": bool(found["affected"]), "alternative": alternative["name"], "says": says}


def asked(check):
    words = {"at_most": "at most", "at_least": "at least"}.get(check["is"], check["is"])
    band = f" \u00b1 {number(float(check['band']), '.4g')}" if check.get("band") is not None else ""
    return f"{words} {number(float(check['threshold']), '.4g')}{band}"


def sentence(rows, cells, alternatives, settled):
    """Whether the claim's verdicts stand under every alternative that was computed, and what they hang on."""
    changed, reversing, computed = {}, set(), set()
    for i, _ in rows:
        base = cells.get((i, settled))
        for j in range(len(alternatives)):
            found = cells.get((i, j))
            if j == settled or found is None or base is None or not found["affected"]:
                continue
            computed.add(j)
            if found["verdict"] != base["verdict"]:
                changed.setdefault(j, []).append(f"{base['verdict']} \u2192 {found['verdict']}")
                if "undecided" not in (found["verdict"], base["verdict"]):
                    reversing.add(j)
    if not computed:
        return {"robust": None, "text": "no alternative that concerns it was computed", "changes": []}
    if not changed:
        return {"robust": True, "text": f"robust: the same under each of {len(computed)} alternatives",
                "changes": []}
    text = f"hangs on {choices(reversing, alternatives)}" if reversing else \
        f"not reversed, but decided otherwise or not with {choices(changed, alternatives)}"
    return {"robust": False, "text": text,
            "changes": [f"{alternatives[j]['name']}: {', '.join(dict.fromkeys(words))}"
                        for j, words in changed.items()]}


def choices(found, alternatives):
    """The open choices of these alternatives; those taken together if there are no others."""
    single = dict.fromkeys(alternatives[j]["choice"] for j in sorted(found) if alternatives[j]["choice"] != TOGETHER)
    return ", ".join(single) or "some taken together"
