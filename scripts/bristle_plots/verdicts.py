"""The verdicts on the paper's claims: reading, numbers as text, the strip at the foot of a figure."""

import re
from collections import namedtuple
from math import floor, isfinite, log10

from .errors import BristleError
from .results import CHOICE_NAMES, as_text, attribute, experiment, is_whole, place_of, read, readable, table
from .style import BLUE, GREEN, GREY, VERMILION, with_carons, wrapped

NUMBERS = ("measured", "uncertainty", "threshold", "band", "margin", "significance")
TEXTS = ("claim", "statement", "is", "verdict", "reading", "role", "claim_verdict")

# relation: how the measured value must compare with the threshold: at_most, at_least or near.
# reading: the reading of Eq. (17), if the experiment has several; declared: number of the check in the experiment.
# interpretation: of an ambiguous sentence of the paper, under which the check belongs to the claim.
# role: the claim's verdict under a reading rests on its main checks, not on further ones.
Claim = namedtuple("Claim", "claim statement relation verdict reading role claim_verdict " + " ".join(NUMBERS) +
                   " declared interpretation")

VERDICT_SIGNS = {"supported": ("\u2714", GREEN), "refuted": ("\u2718", VERMILION), "undecided": ("?", BLUE)}
RELATION_SIGNS = {"at_most": "\u2264", "at_least": "\u2265", "near": "near"}

# Predicates that compare both sides of "compare" in one number.
PAIRED_PREDICATES = ("ordering", "concordance", "equality")

# Of quantities that a sentence may name and the result may not have as a variable or an axis.
FURTHER_SYMBOLS = {"k_r": r"\tilde{k}_r", "k_theta": r"\tilde{k}_\theta", "k_phi": r"\tilde{k}_\varphi", "N_c": "N_c",
                   "N_0": "N_0", "N_c0": "N_{c,0}", "theta_0": r"\theta_0", "phi_0": r"\varphi_0", "mu_c": r"\mu_c",
                   "V_s": "V_s", "V_0": "V_0", "L_x": "L_x"}

LINE_INCHES = 0.2
BASELINE_INCHES = 0.13  # below the top of a line
STRIP = "strip"  # gid of the strip's axes
LETTERS_PER_INCH = 13.5  # of a statement
LEAST_STATEMENT = 3.4  # inches; in figures with less room the numbers are below the statement

# A row of the strip. verdicts: (verdict, text) by reading.
Row = namedtuple("Row", "claim statement measured threshold verdicts")


def read_claims(file):
    """The claims of the group /checks, one for each check and reading; none if there is no such group, and none for a
    part of the result's points, or without its file."""
    group = table(file, "checks")
    if group is None or not is_whole(file):
        return []
    columns = [read(group, name) for name in (*TEXTS, *NUMBERS, "declared")]
    if len({len(column) for column in columns}) > 1:
        raise BristleError(f"{place_of(file)}: the datasets of /checks differ in length")
    texts = len(TEXTS)
    declared = dict(enumerate(experiment(file).get("checks", [])))
    return [Claim(*map(as_text, row[:texts]), *map(float, row[texts:-1]), int(row[-1]),
                  declared.get(int(row[-1]), {}).get("interpretation", "")) for row in zip(*columns)]


def declared_checks(file):
    """The experiment's checks, each with its claim as measured; with several readings, once for each of them."""
    declared, measured = experiment(file).get("checks", []), read_claims(file)
    numbered = list(enumerate(check["claim"] for check in declared))
    if sorted({(claim.declared, claim.claim) for claim in measured}) != numbered:
        raise BristleError(f"{place_of(file)}: /checks is not that of the experiment; run `bristle run` again")
    return [(declared[claim.declared], claim) for claim in measured]


def by_check(claims):
    """For each check of the experiment, in its order, its claims by reading."""
    found = {}
    for claim in sorted(claims, key=lambda claim: claim.declared):
        found.setdefault(claim.declared, {})[claim.reading] = claim
    return list(found.values())


def by_claim(claims):
    """For each claim of the paper, its checks as of `by_check`: the main ones, then the further ones."""
    found = {}
    for check in by_check(claims):
        found.setdefault(first(check).claim, []).append(check)
    return [sorted(checks, key=lambda check: first(check).role != "main") for checks in found.values()]


def first(check):
    """A check under its first reading: the claim, statement, role and threshold are those of all readings."""
    return next(iter(check.values()))


def reading_words(claims):
    """The readings of the claims, in their order."""
    return list(dict.fromkeys(claim.reading for claim in claims))


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
        return f"{number(value, '.5g' if abs(value) > uncertainty else '.1e')} \u00b1 {number(uncertainty, '.1e')}"
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


def columns(readings, width):
    """Titles of the strip's columns after the statement, with their places (inches)."""
    if readings == [""]:
        return {"measured": width - 4.4, "threshold": width - 2.85, "verdict": width - 1.35}
    verdicts = {CHOICE_NAMES.get(word, f"verdict, {readable(word)}"): width - 2.05 * (len(readings) - i)
                for i, word in enumerate(readings)}
    return {"threshold": width - 2.05 * len(readings) - 1.3, **verdicts}


def statement_inches(readings, width):
    """Room for the statement beside the numbers, or 0 if they are below it."""
    room = min(columns(readings, width).values()) - 1.2
    return room if room >= LEAST_STATEMENT else 0


def strip_rows(claims, width):
    """The rows of the strip: the main checks of each claim, and with readings a row for a claim of several of them."""
    readings = reading_words(claims)
    room = statement_inches(readings, width) or width - 1.2
    out = []
    for checks in by_claim([claim for claim in claims if claim.role == "main"]):
        name, interpretation = first(checks[0]).claim, ""
        repeated = name if readings == [""] else ""
        for check in checks:
            if first(check).interpretation not in ("", interpretation):
                interpretation = first(check).interpretation
                empty = {word: ("", "") for word in check}
                statement = wrapped(f"if {interpretation}:", int(LETTERS_PER_INCH * room))
                out.append(Row(name, statement, "", "", empty))
                name = repeated
            out.append(check_row(check, name, int(LETTERS_PER_INCH * room)))
            name = repeated
        if readings != [""] and len(checks) > 1:
            whole = {word: (claim.claim_verdict, claim.claim_verdict) for word, claim in checks[0].items()}
            out.append(Row("", f"claim {first(checks[0]).claim}, by its main checks", "", "", whole))
    return out


def check_row(check, claim, characters):
    """One check. With several readings, the number measured takes the place of the verdict's word."""
    one = first(check)
    measured = {word: with_uncertainty(found.measured, found.uncertainty) for word, found in check.items()}
    verdicts = {word: (found.verdict, measured[word] if word else found.verdict) for word, found in check.items()}
    statement = wrapped(one.statement, characters)
    return Row(claim, statement, measured.get("", ""), threshold_text(one.relation, one.threshold, one.band), verdicts)


def line_count(row, width):
    numbers_below = any(cell for _, cell in row.verdicts.values()) and not statement_inches(list(row.verdicts), width)
    return row.statement.count("\n") + 1 + numbers_below


def strip_height(claims, width):
    """Height of the strip in inches."""
    if not claims:
        return 0
    lines = sum(line_count(row, width) for row in strip_rows(claims, width))
    return (lines + 1 + bool(key_of_signs(claims))) * LINE_INCHES + 0.2


def symbols(file):
    """The symbols of quantities by their names in sentences: those of the axes of the panels."""
    found = {name: attribute(data, "symbol") for name, data in file.variables.items() if "symbol" in data.attrs}
    return FURTHER_SYMBOLS | {name: symbol for name, symbol in found.items() if symbol not in ("", name)}


def in_symbols(text, symbols):
    """A sentence with $...$ for the names of quantities, as mathtext and the report's HTML read it."""
    def symbol(found):
        name = symbols[found.group()]
        if text[found.end():].startswith(("(", "/", "^")):  # R_n(z_0), R_n/N_c0: the quantity without its unit
            name = name.partition("/")[0]
        return f"${with_carons(name)}$"

    names = "|".join(map(re.escape, sorted(symbols, key=len, reverse=True)))
    return re.sub(rf"(?<!\w)(?:{names})(?!\w)", symbol, text)


def draw_strip(figure, claims, symbols):
    """A row for each main check at the foot of the figure: statement, threshold, and the verdict under each reading."""
    if not claims:
        return
    width, height = figure.get_size_inches()
    tall = strip_height(claims, width)
    strip = figure.add_axes((0, 0, 1, tall / height), xlim=(0, width), ylim=(0, tall))
    strip.axis("off")
    strip.set_gid(STRIP)
    readings, rows = reading_words(claims), strip_rows(claims, width)
    places = {"claim": 0.3, "statement": 0.85, **columns(readings, width)}
    line = tall - LINE_INCHES / 2
    for title, x in places.items():
        strip.text(x, line, title, color=GREY, va="center", fontsize=9)
    strip.axhline(line - LINE_INCHES / 2, 0.3 / width, 1 - 0.3 / width, color=GREY, linewidth=0.6)
    line -= 1.3 * LINE_INCHES
    for row in rows:
        narrow = not statement_inches(readings, width)
        row = row._replace(statement=in_symbols(row.statement, symbols))
        draw_row(strip, row, readings, list(places.values()), line + LINE_INCHES / 2, narrow)
        line -= line_count(row, width) * LINE_INCHES
    strip.text(places["statement"], line, key_of_signs(claims), color=GREY, va="center", fontsize=9)


def key_of_signs(claims):
    """What the signs mean in a strip without the words of the verdicts, and where the further checks are."""
    signs = ", ".join(f"{sign} {verdict}" for verdict, (sign, _) in VERDICT_SIGNS.items())
    further = sum(first(check).role != "main" for check in by_check(claims))
    return "; ".join(filter(None, [signs if reading_words(claims) != [""] else "",
                                   f"further checks, on which no verdict rests: {further}, in docs/findings.md" if further else ""]))


def draw_row(strip, row, readings, places, top, narrow):
    text = dict(va="baseline", fontsize=9.5)
    lines = row.statement.split("\n")
    line = top - BASELINE_INCHES
    strip.text(places[0], line, row.claim, **text)
    for i, part in enumerate(lines):
        strip.text(places[1], line - i * LINE_INCHES, part, **text)
    below = line - len(lines) * LINE_INCHES if narrow else line
    numbers = [row.threshold] if readings != [""] else [row.measured, row.threshold]
    for x, cell in zip(places[2:], numbers):
        strip.text(x, below, cell, **text)
    for x, word in zip(places[2 + len(numbers):], readings):
        verdict, cell = row.verdicts.get(word, ("", "\u2013"))
        if not cell:
            continue
        sign, colour = VERDICT_SIGNS.get(verdict, ("\u2022", GREY))
        strip.text(x, below, f"{sign} {cell}", color=colour, weight="bold", **text)
