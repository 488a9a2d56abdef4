"""The verdicts on the paper's claims: reading, numbers as text, the strip at the foot of a figure."""

import re
from collections import namedtuple
from math import floor, isfinite, log10

from ..errors import BristleError
from ..results import CHOICE_NAMES, as_text, attribute, experiment, is_whole, place_of, read, readable, table
from .style import BLUE, GREEN, GREY, VERMILION, lines_within, text_inches, with_carons

NUMBERS = ("measured", "uncertainty", "threshold", "band", "margin", "significance")
TEXTS = ("claim", "statement", "is", "verdict", "reading", "role", "claim_verdict", "required", "found", "interpretation")

# relation: how the measured value must compare with the threshold: at_most, at_least or near.
# reading: the reading of Eq. (17), if the experiment has several; declared: number of the check in the experiment.
# interpretation: of an ambiguous sentence of the paper, under which the check belongs to the claim.
# role: the claim's verdict under a reading rests on its main checks, not on further ones.
# symbols: of the quantities that the statement and the interpretation may name.
# required, found: what the check requires and what was measured, in words.
Claim = namedtuple("Claim", "claim statement relation verdict reading role claim_verdict required found interpretation " +
                   " ".join(NUMBERS) + " declared symbols")

VERDICT_SIGNS = {"supported": ("\u2714", GREEN), "refuted": ("\u2718", VERMILION), "undecided": ("?", BLUE),
                 "depends": ("\u2194", BLUE)}
RELATION_SIGNS = {"at_most": "\u2264", "at_least": "\u2265", "near": "near"}

# Of quantities that a sentence may name and the result may not have as a variable or an axis.
FURTHER_SYMBOLS = {"k_r": r"\tilde{k}_r", "k_theta": r"\tilde{k}_\theta", "k_phi": r"\tilde{k}_\varphi", "N_c": "N_c",
                   "N_0": "N_0", "N_c0": "N_{c,0}", "theta_0": r"\theta_0", "phi_0": r"\varphi_0", "mu_c": r"\mu_c",
                   "V_s": "V_s", "V_0": "V_0", "L_x": "L_x", "F_n": "F_n", "tau_f": r"\tau_f", "lambda_z": r"\lambda_z",
                   "t_1": "t_1", "t_2": "t_2"}

LINE_INCHES = 0.2
BASELINE_INCHES = 0.13  # below the top of a line
RULE_INCHES = 0.06  # below the titles
MARGIN, STATEMENT = 0.3, 0.85  # inches, where claims and statements begin
GAP = 0.25  # inches between columns
LEAST_STATEMENT = 2.6  # inches; in figures with less room the numbers are below the statement
TITLE, TEXT = dict(color=GREY, fontsize=10), dict(fontsize=10)  # looks of texts

# A row of the strip. statement: a text, and in the Strip its lines; cells: (text, look) in each column after it.
Row = namedtuple("Row", "claim statement cells look")

# places: of the columns after the statement (inches); below: whether these are below the statement. The first row has titles.
Strip = namedtuple("Strip", "rows places below")


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
    names = symbols(file)
    return [Claim(*map(as_text, row[:texts]), *map(float, row[texts:-1]), int(row[-1]), names) for row in zip(*columns)]


def declared_checks(file):
    """The experiment's checks, each with its claim as measured; with several readings, once for each of them."""
    declared, measured = experiment(file).get("checks", []), read_claims(file)
    numbered = list(enumerate(check["claim"] for check in declared))
    if sorted({(claim.declared, claim.claim) for claim in measured}) != numbered:
        raise BristleError(f"{place_of(file)}: /checks does not belong to the experiment; run `bristle run` again")
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
    """A check under its first reading: the claim, statement, role and threshold are the same for all readings."""
    return next(iter(check.values()))


def reading_words(claims):
    """The readings of the claims, in their order."""
    return list(dict.fromkeys(claim.reading for claim in claims))


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


def is_share(claim):
    """Whether the check counts points, or pairs of them: its numbers are shares then."""
    return claim.required.endswith("needed")


def needed(claim):
    """What the check requires, without what it measures: "95 % needed", or "≤ 0.5"."""
    return claim.required.partition(" of ")[0] + " needed" if is_share(claim) else threshold_text(claim.relation, claim.threshold, claim.band)


def measured_text(claim):
    """What was measured: a share in per cent, or a number with two digits of its uncertainty."""
    return claim.found.replace("+-", "±") if is_share(claim) else with_uncertainty(claim.measured, claim.uncertainty)


def p_text(claim):
    """The significance, if the claim has one, to follow the measured value."""
    if not isfinite(claim.significance):
        return ""
    return f", p = {claim.significance:.1g}" if claim.significance >= 1e-4 else ", p < 0.0001"


def strip_of(claims, width):
    """The strip for a figure of this width (inches): columns as wide as their texts, and the rest for the statement."""
    rows = strip_rows(claims)
    widths = [max(text_inches(*cell) for cell in column) + GAP for column in zip(*(row.cells for row in rows))]
    places = [width - MARGIN + GAP - sum(widths[i:]) for i in range(len(widths))]
    whole, beside = width - MARGIN - STATEMENT, places[0] - GAP - STATEMENT
    below = beside < LEAST_STATEMENT
    rooms = [whole if below or not has_cells(row) else beside for row in rows]
    return Strip([row._replace(statement=lines_within(row.statement, room, row.look)) for row, room in zip(rows, rooms)],
                 places, below)


def strip_rows(claims):
    """Titles, the main checks of each claim, with readings a row for a claim of several of them, and a key."""
    readings = reading_words(claims)
    titles = ["measured", "threshold", "verdict"] if readings == [""] else [
        "threshold", *(CHOICE_NAMES.get(word, f"verdict, {readable(word)}") for word in readings)]
    empty = [("", TEXT)] * len(titles)
    out = [Row("claim", "statement", [(title, TITLE) for title in titles], TITLE)]
    for checks in by_claim([claim for claim in claims if claim.role == "main"]):
        name, interpretation = first(checks[0]).claim, ""
        repeated = name if readings == [""] else ""
        for check in checks:
            if first(check).interpretation not in ("", interpretation):
                interpretation = first(check).interpretation
                out.append(Row(name, f"if {in_symbols(interpretation, first(check).symbols)}:", empty, TEXT))
                name = repeated
            out.append(Row(name, in_symbols(first(check).statement, first(check).symbols), check_cells(check, readings), TEXT))
            name = repeated
        if readings != [""] and len(checks) > 1:
            whole = [verdict_cell(checks[0][word].claim_verdict) if word in checks[0] else ("", TEXT) for word in readings]
            out.append(Row("", f"claim {first(checks[0]).claim}, by its main checks", [("", TEXT), *whole], TEXT))
    if key := key_of_signs(claims):
        out.append(Row("", key, empty, TITLE))
    return out


def check_cells(check, readings):
    """One check. With several readings, the number measured takes the place of the verdict's word."""
    one = first(check)
    threshold = needed(one), TEXT
    if readings == [""]:
        return [(measured_text(one), TEXT), threshold, verdict_cell(one.verdict)]
    return [threshold, *(verdict_cell(check[word].verdict, measured_text(check[word]))
                         if word in check else verdict_cell("", "\u2013") for word in readings)]


def verdict_cell(verdict, text=None):
    """The sign of a verdict with a text, or with its word."""
    sign, colour = VERDICT_SIGNS.get(verdict, ("\u2022", GREY))
    return f"{sign} {text or verdict}", dict(TEXT, color=colour, weight="bold")


def has_cells(row):
    return any(text for text, _ in row.cells)


def line_count(row, below):
    return len(row.statement) + (below and has_cells(row))


def strip_height(claims, width):
    """Height of the strip in inches."""
    if not claims:
        return 0
    strip = strip_of(claims, width)
    return sum(line_count(row, strip.below) for row in strip.rows) * LINE_INCHES + RULE_INCHES + 0.14


def symbols(file):
    """The symbols of quantities by their names in sentences: the symbols of the axes of the panels."""
    found = {name: attribute(data, "symbol") for name, data in file.variables.items() if "symbol" in data.attrs}
    return FURTHER_SYMBOLS | {name: symbol for name, symbol in found.items() if symbol not in ("", name)}


def in_symbols(text, symbols):
    """A sentence with $...$ for the names of quantities, as mathtext and the report's HTML read it; what is between $ already
    stays as it is."""
    def symbol(found):
        name = symbols[found.group()]
        if found.string[found.end():].startswith(("(", "/", "^")):  # R_n(z_0), R_n/N_c0: the quantity without its unit
            name = name.partition("/")[0]
        return f"${with_carons(name)}$"

    names = "|".join(map(re.escape, sorted(symbols, key=len, reverse=True)))
    parts = text.split("$")
    parts[::2] = [re.sub(rf"(?<!\w)(?:{names})(?!\w)", symbol, part) for part in parts[::2]]
    return "$".join(parts)


def draw_strip(figure, claims):
    """A row for each main check at the foot of the figure: statement, threshold, and the verdict under each reading."""
    if not claims:
        return
    width, height = figure.get_size_inches()
    strip, tall = strip_of(claims, width), strip_height(claims, width)
    axes = figure.add_axes((0, 0, 1, tall / height), xlim=(0, width), ylim=(0, tall))
    axes.axis("off")
    titles, *rows = strip.rows
    draw_row(axes, titles, strip, tall)
    top = tall - line_count(titles, strip.below) * LINE_INCHES
    axes.axhline(top, MARGIN / width, 1 - MARGIN / width, color=GREY, linewidth=0.6)
    top -= RULE_INCHES
    for row in rows:
        draw_row(axes, row, strip, top)
        top -= line_count(row, strip.below) * LINE_INCHES


def key_of_signs(claims):
    """What the signs mean in a strip without the words of the verdicts, and where the further checks are."""
    signs = ", ".join(f"{sign} {verdict}" for verdict, (sign, _) in VERDICT_SIGNS.items())
    further = sum(first(check).role != "main" for check in by_check(claims))
    return "; ".join(filter(None, [signs if reading_words(claims) != [""] else "",
                                   f"further checks, on which no verdict rests: {further}, printed by `bristle check --all`" if further else ""]))


def draw_row(axes, row, strip, top):
    line = top - BASELINE_INCHES
    axes.text(MARGIN, line, row.claim, **row.look)
    for i, part in enumerate(row.statement):
        axes.text(STATEMENT, line - i * LINE_INCHES, part, **row.look)
    if strip.below:
        line -= len(row.statement) * LINE_INCHES
    for x, (text, look) in zip(strip.places, row.cells):
        axes.text(x, line, text, **look)
