"""The verdicts on the paper's claims, as a strip of text at the bottom of a figure."""

from collections import namedtuple
from math import floor, isfinite, log10

import h5py

from style import BLUE, GREEN, GREY, VERMILION, dataset, fail, prose, text, values

Claim = namedtuple("Claim", "claim statement measured threshold uncertainty band is_ verdict")

SYMBOLS = {"supported": ("\u2714", GREEN), "refuted": ("\u2718", VERMILION), "undecided": ("?", BLUE)}

# How the measured value has to compare with the threshold.
SIGNS = {"at_most": "\u2264", "at_least": "\u2265", "near": "near"}

LINE_INCHES = 0.2
NARROW_INCHES = 9  # a figure that has the numbers below the statement


def read_claims(file):
    """The claims of the group /checks; none if there is no such group."""
    group = file.get("checks")
    if not isinstance(group, h5py.Group):
        return []
    without_band = [float("nan")] * len(values(dataset(group, "threshold")))  # older files
    columns = [values(dataset(group, name.strip("_"))) if name != "band" or name in group else without_band
               for name in Claim._fields]
    if len({len(column) for column in columns}) > 1:
        fail(f"{file.filename}: the datasets of /checks differ in length")
    return [Claim(text(row[0]), text(row[1]), *map(float, row[2:6]), *map(text, row[6:]))
            for row in zip(*columns)]


def rows(claims, width):
    """The claims with their statements broken to fit a figure of this width (inches)."""
    room = width - (1.2 if width < NARROW_INCHES else 5.6)
    return [claim._replace(statement=prose(claim.statement, int(14 * room))) for claim in claims]


def lines(row, width):
    """How many lines the claim takes."""
    return row.statement.count("\n") + (2 if width < NARROW_INCHES else 1)


def strip_height(claims, width):
    """Inches that the strip takes at the bottom of a figure."""
    if not claims:
        return 0
    return (sum(lines(row, width) for row in rows(claims, width)) + 1) * LINE_INCHES + 0.2


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


def demand(row):
    """What the claim asks of the measured value."""
    band = f" \u00b1 {number(row.band, '.4g')}" if isfinite(row.band) else ""
    return f"{SIGNS.get(row.is_, '')} {number(row.threshold, '.4g')}{band}"


def draw_strip(figure, claims):
    """One line per claim in the bottom of the figure: what the paper says, what the run says."""
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
    for row in rows(claims, width):
        draw_row(strip, row, columns.values(), line + LINE_INCHES / 2, width < NARROW_INCHES)
        line -= lines(row, width) * LINE_INCHES


def draw_row(strip, row, columns, top, narrow):
    symbol, colour = SYMBOLS.get(row.verdict, ("\u2022", GREY))
    cells = (row.claim, row.statement, with_uncertainty(row.measured, row.uncertainty), demand(row),
             f"{symbol} {row.verdict}")
    below = top - (row.statement.count("\n") + 1) * LINE_INCHES if narrow else top
    for i, (x, cell) in enumerate(zip(columns, cells)):
        look = dict(color=colour, weight="bold") if i == len(cells) - 1 else {}
        strip.text(x, top if i < 2 else below, cell, va="top", fontsize=9.5, linespacing=1.55, **look)
