"""The verdicts on the paper's claims: reading, numbers as text, the strip at the foot of a figure."""

from collections import namedtuple
from math import floor, isfinite, log10

import h5py
import numpy as np

from .errors import BristleError
from .results import as_text, experiment, read
from .style import BLUE, GREEN, GREY, VERMILION, wrapped

NUMBERS = ("measured", "uncertainty", "threshold", "band", "margin", "significance")
TEXTS = ("claim", "statement", "is", "verdict")
OPTIONAL = ("band", "margin", "significance")  # older files are without them
# Of files whose claims have several readings or checks: the value of the choice "checks_for_each", whether the
# check is one of those that decide the claim, the verdict on the claim, the number of the check in the experiment.
LATER = ("reading", "role", "claim_verdict", "declared")

# relation: how the measured value must compare with the threshold: at_most, at_least or near.
Claim = namedtuple("Claim", "claim statement relation verdict " + " ".join(NUMBERS + LATER))

VERDICT_SIGNS = {"supported": ("\u2714", GREEN), "refuted": ("\u2718", VERMILION), "undecided": ("?", BLUE)}
RELATION_SIGNS = {"at_most": "\u2264", "at_least": "\u2265", "near": "near"}

# Predicates that compare both sides of "compare" in one number.
PAIRED_PREDICATES = ("ordering", "concordance", "equality")

LINE_INCHES = 0.2
NARROW_INCHES = 9  # narrower figures have the numbers below the statement


def read_claims(file):
    """The claims of the group /checks; none if there is no such group."""
    group = file.get("checks")
    if not isinstance(group, h5py.Group):
        return []
    missing = np.full(len(read(group, "threshold")), np.nan)
    columns = [read(group, name) for name in TEXTS]
    columns += [missing if name in OPTIONAL and name not in group else read(group, name) for name in NUMBERS]
    if len({len(column) for column in columns}) > 1:
        raise BristleError(f"{file.filename}: the datasets of /checks differ in length")
    texts, end = len(TEXTS), len(TEXTS) + len(NUMBERS)
    return [Claim(*map(as_text, row[:texts]), *map(float, row[texts:end]), *later)
            for row, later in zip(zip(*columns), later_columns(group, columns[TEXTS.index("verdict")]))]


def later_columns(group, verdicts):
    """The values of LATER for each row; in older files every check decides its own claim."""
    if "declared" not in group:
        return [("", "main", as_text(verdict), i) for i, verdict in enumerate(verdicts)]
    reading, role, verdict, declared = (read(group, name) for name in LATER)
    return [(*map(as_text, row), int(number)) for *row, number in zip(reading, role, verdict, declared)]


def declared_checks(file):
    """(check, claim as measured) for each check of the experiment and each reading."""
    declared, measured = experiment(file).get("checks", []), read_claims(file)
    pairs = [(declared[claim.declared], claim) for claim in measured if claim.declared < len(declared)]
    if (len(pairs) < len(measured) or {claim.declared for claim in measured} != set(range(len(declared)))
            or any(check["claim"] != claim.claim for check, claim in pairs)):
        raise BristleError(f"{file.filename}: /checks is not that of the experiment; run `bristle run` again")
    return pairs


def quantity(check):
    """The quantity that a check measures, in words."""
    what = check["predicate"].replace("_", " ")
    if "compare" in check and check["predicate"] not in PAIRED_PREDICATES:
        return f"{check.get('by', 'ratio')} of {what}"
    return what


def number(value, form):
    return f"{value:{form}}".replace("-", "\u2212") if isfinite(value) else "\u2013"


def with_uncertainty(value, uncertainty):
    """Two digits of the uncertainty, and the value to the same place."""
    if not (isfinite(value) and isfinite(uncertainty) and uncertainty > 0):
        return number(value, ".4g")
    digits = max(0, 1 - floor(log10(uncertainty)))
    if digits > 5:
        return f"{number(value, '.5g')} \u00b1 {number(uncertainty, '.1e')}"
    return f"{number(value, f'.{digits}f')} \u00b1 {number(uncertainty, f'.{digits}f')}"


def threshold_text(relation, threshold, band):
    """The relation to the threshold that supports the claim."""
    range_text = f" \u00b1 {number(band, '.4g')}" if band is not None and isfinite(band) else ""
    return f"{RELATION_SIGNS.get(relation, '')} {number(threshold, '.4g')}{range_text}"


def p_text(claim):
    """The significance, if the claim has one, to follow the measured value."""
    if not isfinite(claim.significance):
        return ""
    return f", p = {claim.significance:.1g}" if claim.significance >= 1e-4 else ", p < 0.0001"


def wrapped_claims(claims, width):
    """The claims with their statements wrapped to a figure of this width (inches)."""
    room = width - (1.2 if width < NARROW_INCHES else 5.6)
    return [claim._replace(statement=wrapped(claim.statement, int(14 * room))) for claim in claims]


def line_count(claim, width):
    return claim.statement.count("\n") + (2 if width < NARROW_INCHES else 1)


def strip_height(claims, width):
    """Height of the strip in inches."""
    if not claims:
        return 0
    return (sum(line_count(claim, width) for claim in wrapped_claims(claims, width)) + 1) * LINE_INCHES + 0.2


def draw_strip(figure, claims):
    """A row for each claim at the foot of the figure: statement, measured value, threshold, verdict."""
    if not claims:
        return
    width, height = figure.get_size_inches()
    tall = strip_height(claims, width)
    strip = figure.add_axes((0, 0, 1, tall / height), xlim=(0, width), ylim=(0, tall))
    strip.axis("off")
    columns = {"claim": 0.3, "statement": 0.85, "measured": width - 4.4,
               "threshold": width - 2.85, "verdict": width - 1.35}
    line = tall - LINE_INCHES / 2
    for title, x in columns.items():
        strip.text(x, line, title, color=GREY, va="center", fontsize=9)
    strip.axhline(line - LINE_INCHES / 2, 0.3 / width, 1 - 0.3 / width, color=GREY, linewidth=0.6)
    line -= 1.3 * LINE_INCHES
    for claim in wrapped_claims(claims, width):
        draw_row(strip, claim, columns.values(), line + LINE_INCHES / 2, width < NARROW_INCHES)
        line -= line_count(claim, width) * LINE_INCHES


def draw_row(strip, claim, columns, top, narrow):
    sign, colour = VERDICT_SIGNS.get(claim.verdict, ("\u2022", GREY))
    cells = (claim.claim, claim.statement, with_uncertainty(claim.measured, claim.uncertainty),
             threshold_text(claim.relation, claim.threshold, claim.band), f"{sign} {claim.verdict}")
    below = top - (claim.statement.count("\n") + 1) * LINE_INCHES if narrow else top
    for i, (x, cell) in enumerate(zip(columns, cells)):
        look = dict(color=colour, weight="bold") if i == len(cells) - 1 else {}
        strip.text(x, top if i < 2 else below, cell, va="top", fontsize=9.5, linespacing=1.55, **look)
