"""The recommended brush of a design to scale, with its dimensions for a workshop."""

import re

import numpy as np
from matplotlib import patches

from ..errors import BristleError
from ..plotting.layout import Cell, across, heading, place_cell, sheet
from ..plotting.lift_off import PHASES
from ..plotting.page import points
from ..plotting.readings import one_page
from ..plotting.remarks import limits_everywhere
from ..plotting.style import BLACK, VERMILION, lines_within
from ..results import attribute, experiment, flags, place_of, table, table_with

AXES = []
STATUSES = False  # no point is marked
BRISTLES = 4
GREATEST = "greatest deviation"  # what a tolerance is that is no standard deviation
ARROW = dict(arrowstyle="<->", color=BLACK, linewidth=0.8, shrinkA=0, shrinkB=0)
DRAWN = ("length", "diameter", "angle", "tip_radius", "spacing")  # dimensions that the brush is drawn with
LINE = 0.2  # inches


def MARKS(file):
    """What is drawn and how, and the abbreviations that the lines have."""
    one_way = experiment(file).get("orientation", {}).get("distribution") == "von_mises"
    parts = ["To scale, undeformed, lengths in millimetres.",
             "" if one_way else "Bristles lean in all directions; here all lean to the right.",
             "The slab is drawn where it first touches them."]
    rows = dimensions(file)
    if any(row.tolerance_is != GREATEST and np.isfinite([row.tolerance, row.band]).any() for row in rows):
        parts.append("s.d.: standard deviation.")
    if any(np.isfinite(row.band) for row in rows):
        parts.append("99 % stay with: with such deviations of this dimension alone 99 % of the brushes stay on this side of the jump.")
    return " ".join(filter(None, parts))


def dimensions(file):
    """The rows of the group `drawing`, with its codes as words."""
    group = table_with(file, "drawing", "tolerance", "tolerance_is", "margin_below", "margin_above", "band", "meaning", "shown", "shown_unit")
    for name in ("tolerance_is", "meaning", "shown_unit"):
        words, codes = flags(group[name])
        group = group.assign({name: ("dimension", [words[code].replace("_", " ") for code in codes])})
    return list(group.to_dataframe().reset_index().itertuples())


def warnings(file):
    """What the title block warns of: constraints that the brush violates, and limits of the model that every point exceeds."""
    lines = []
    if (violated := table(file, "violated")) is not None:
        for row in violated.to_dataframe().reset_index().itertuples():
            made = f" ({row.brushes} of {int(table(file, 'verification').brushes[0])} brushes as made)" if row.brushes else ""
            constraint = attribute(table(file, "comparison")[row.constraint], "long_name")
            lines.append(f"VIOLATES {constraint}: {row.value:.4g}{made}")
    beyond = limits_everywhere(file)
    if beyond:
        lines.append(f"TREND ONLY: {', '.join(beyond)}")
    return lines


@one_page
def draw(file):
    if table(file, "drawing") is None:
        raise BristleError(f"{place_of(file)}: has no drawing; `bristle design` writes it for an experiment in SI units in which a "
                           "trial meets the constraints")
    rows = dimensions(file)
    range_of = table_with(file, "working_range", "velocity", "load", "phase", "load_over_lift_off")
    phases = dict(enumerate(flags(range_of["phase"])[0]))
    lines = "\n".join([*(line_of(row) for row in rows), *(working(row, phases) for row in range_of.to_dataframe().itertuples())])
    height = max(4.0, LINE * (1 + lines.count("\n")))
    cell, _ = across(1, Cell(9.4, height + 0.6, 0.4, 0.2, 8.8, height))
    look = dict(fontsize=points(11), weight="bold", color=VERMILION)
    block = [line for text in warnings(file) for line in lines_within(text, cell.inner_width, look)]
    figure, bottom = sheet(file, cell.width, cell.height + LINE * len(block), MARKS(file), verdicts=False)
    axes = place_cell(figure, (0, bottom), cell)
    right = draw_brush(axes, **{row.dimension: row.shown for row in rows if row.dimension in DRAWN})
    low, inch = bottom + cell.low, 1 / figure.get_figheight()
    axes.annotate(lines, (right + 0.4 * rows[0].shown, (low + cell.inner_height / 2) * inch), xycoords=("data", "figure fraction"),
                  fontsize=points(10), va="center", linespacing=1.4)
    for i, line in enumerate(reversed(block)):
        figure.text(0.5, (low + cell.inner_height + 0.2 + LINE * i) * inch, line, ha="center", va="center", **look)
    heading(axes, "", labels=["the recommended brush"])
    return figure


def line_of(row):
    """A dimension with its tolerance, and where the gap jumps."""
    unit = "" if row.shown_unit == "1" else " " + re.sub(r"\^(\d+)", r"$^\1$", row.shown_unit)
    lines, limits = [f"{row.meaning}: {row.shown:.4g}{unit}"], []

    def deviation(relative):
        kind = "\u00b1" if row.tolerance_is == GREATEST else "s.d."
        return f"{kind} {relative * abs(row.shown):.2g}{unit}"

    if np.isfinite(row.tolerance):
        limits.append(deviation(row.tolerance))
    jumps = [f"{(1 + change) * row.shown:.4g}{unit}" for change in (-row.margin_below, row.margin_above) if np.isfinite(change)]
    if jumps:
        limits.append(f"the gap jumps at {' and '.join(jumps)}")
    if limits:
        lines.append("; ".join(limits))
    if np.isfinite(row.band):
        lines.append(f"99 % stay with {deviation(row.band)}")
    return "\n    ".join(lines)


def working(row, phases):
    """What the brush does in a scenario."""
    phase = phases[row.phase]
    found = f"at {row.velocity:.3g} m/s under {row.load:.3g} N: {PHASES.get(phase, phase)}"
    if np.isfinite(row.load_over_lift_off):
        found += f", {100 * row.load_over_lift_off:.0f} % of its lift-off load"
    return found


def draw_brush(axes, length, diameter, angle, tip_radius, spacing):
    """A row of bristles on their base under the slab, with the dimensions; returns its right end."""
    lean = np.radians(angle)
    along, across_shaft = np.array([np.cos(lean), np.sin(lean)]), np.array([np.sin(lean), -np.cos(lean)])
    roots = [np.array([i * spacing, 0]) for i in range(BRISTLES)]
    height, right = length * np.sin(lean), roots[-1][0] + length * np.cos(lean)
    left, thick = -0.7 * spacing, 0.12 * length
    for low, name in ((-thick, "base"), (height, "slab")):
        axes.add_patch(patches.Rectangle((left, low), right - left + 0.7 * spacing, thick, facecolor="0.9", edgecolor=BLACK, hatch="///",
                                         linewidth=0.8))
        axes.annotate(name, (left, low + thick / 2), (-4, 0), textcoords="offset points", ha="right", va="center", fontsize=points(9))
    for root in roots:
        axes.add_patch(patches.Circle(root + (length - tip_radius) * along, tip_radius, facecolor="0.75", edgecolor=BLACK, linewidth=0.8))
        corners = [root + side * diameter / 2 * across_shaft + end * (length - tip_radius) * along for side, end in ((-1, 0), (1, 0), (1, 1), (-1, 1))]
        axes.add_patch(patches.Polygon(corners, facecolor="0.75", edgecolor=BLACK, linewidth=0.8))
    middle = roots[0] + 0.5 * length * along
    measure(axes, roots[-1] + 1.4 * diameter * across_shaft, roots[-1] + length * along + 1.4 * diameter * across_shaft, f"{length:.4g}",
            (6, -2), "left")
    measure(axes, middle - diameter / 2 * across_shaft, middle + diameter / 2 * across_shaft, f"\u2300 {diameter:.3g}", (-18, 6), "right")
    low = np.array([0, -thick * 1.35])
    measure(axes, roots[0] + low, roots[1] + low, f"{spacing:.4g}", (0, -11), "center")
    axes.add_patch(patches.Arc(roots[-1], 0.6 * length, 0.6 * length, theta1=0, theta2=angle, linewidth=0.8))
    axes.text(*(roots[-1] + [0.33 * length, 0.1 * length]), f"{angle:.3g}\u00b0", fontsize=points(9), va="center")
    axes.plot([roots[-1][0], roots[-1][0] + 0.4 * length], [0, 0], color=BLACK, linewidth=0.8)
    axes.set_aspect("equal")
    axes.set_xlim(left - 1.5 * spacing, right + 2.2 * length)
    axes.set_ylim(-thick * 2.2, height + 1.2 * thick)
    axes.axis("off")
    return right


def measure(axes, start, end, string, offset, align):
    """An arrow between two points, with its length."""
    axes.annotate("", end, start, arrowprops=ARROW)
    axes.annotate(string, (np.array(start) + end) / 2, offset, textcoords="offset points", ha=align, va="center", fontsize=points(9))
