"""The claims beside a figure, with their checks and verdicts for each model of bending, in words."""

import re

from ..errors import BristleError
from ..pages.explanations import what_was_measured
from ..pages.findings import reason
from ..pages.quantities import READINGS
from ..pages.summary import claims_of, joint, verdicts_of
from ..plotting.verdicts import VERDICT_SIGNS, measured_text, p_text
from ..results import readable, table
from .symbols import prose


def read(figure, file, names):
    """The claims in the order of the experiment; figure: its name; names: the symbols of quantities."""
    if table(file, "checks") is None:
        return []
    return [{"place": re.sub(r"\W+", "-", f"{figure}-{claim}"), **claim_of(file, claim, checks, names)}
            for claim, checks in claims_of(file).items()]


def claim_of(file, claim, checks, names):
    """What the paper says, the main and the further checks, the verdicts, and the reason of one that is not "supported"."""
    def texts(key):
        return [prose(text, names) for text in dict.fromkeys(check[key] for check, _ in checks if key in check)]

    main, further = ([check_of(check, rows, names) for check, rows in checks if (rows[0].role == "main") == of_main]
                     for of_main in (True, False))
    verdicts = verdicts_of(checks)
    return {"claim": claim, "short": next(iter(texts("short")), ""), "quotes": texts("quote"), "left_open": texts("leaves_open"),
            "main": main, "further": further, "verdicts": verdicts, "words": in_words(verdicts),
            "reason": prose(reason_of(file, checks), names)}


def reason_of(file, checks):
    """The reason; for an experiment that lacks what it reads, only what was measured."""
    try:
        return reason(file, checks)
    except (BristleError, LookupError, ValueError):
        return what_was_measured([(check, row) for check, rows in checks for row in rows if row.role == "main"])


def check_of(check, rows, names):
    """One check: what it states and requires, and for each model the verdict with what was measured."""
    meaning = check.get("interpretation", "")
    return {"declared": rows[0].declared, "statement": prose(rows[0].statement, names), "required": rows[0].required,
            "interpretation": prose(meaning, names),
            "rows": [{"reading": row.reading, "model": model(row.reading), "verdict": row.verdict, "sign": sign(row.verdict),
                      "value": row.measured, "measured": measured_text(row) + p_text(row)} for row in rows]}


def overview(figures):
    """A row for each claim in their order: where it is, and the verdict of all results that decide it."""
    rows = {}
    for figure in figures:
        for claim in figure["claims"]:
            row = rows.setdefault(claim["claim"], {**claim, "verdicts": {}, "figures": []})
            row["figures"].append({"name": figure["name"], "place": claim["place"]})
            for reading, verdict in claim["verdicts"].items():
                row["verdicts"][reading] = joint(verdict, row["verdicts"].get(reading, verdict))
    return [{**row, "words": in_words(row["verdicts"])} for _, row in sorted(rows.items())]


def in_words(verdicts):
    """For each different verdict: it, its sign, and the models that have it."""
    found = {}
    for reading, verdict in verdicts.items():
        found.setdefault(verdict, []).append(model(reading))
    if len(found) == 1 and len(verdicts) > 1:
        return [{"verdict": verdict, "sign": sign(verdict), "models": "with every model"} for verdict in found]
    return [{"verdict": verdict, "sign": sign(verdict), "models": f"({', '.join(models)})" if any(models) else ""}
            for verdict, models in found.items()]


def model(reading):
    return READINGS.get(reading, readable(reading))


def sign(verdict):
    return VERDICT_SIGNS.get(verdict, ("\u2022",))[0]
