"""The recommended brush of a design to scale, with its dimensions for a workshop."""

import numpy as np
from matplotlib import patches

from ..errors import BristleError
from ..layout import Cell, across, heading, place_cell, sheet
from ..page import points
from ..readings import one_page
from ..results import place_of, table, table_with
from ..style import BLACK, GREY

AXES = []
BRISTLES = 4
ARROW = dict(arrowstyle="<->", color=BLACK, linewidth=0.8, shrinkA=0, shrinkB=0)
NOTE = ("To scale, undeformed, in millimetres. Bristles lean in all directions; here all lean to the right. The slab is drawn "
        "where it first touches them. Tolerances: sd, standard deviation; +-, greatest deviation.")
MARKS = NOTE


@one_page
def draw(file):
    if table(file, "drawing") is None:
        raise BristleError(f"{place_of(file)}: has no drawing; `bristle design` writes it for an experiment in SI units in which a "
                           "trial meets the constraints")
    group = table_with(file, "drawing", "value", "tolerance")
    sizes = {str(name): float(value) for name, value in zip(group["dimension"].values, group["value"].values)}
    cell, _ = across(1, Cell(9.4, 4.6, 0.4, 0.2, 8.8, 4.0))
    figure, bottom = sheet(file, cell.width, cell.height, NOTE, verdicts=False)
    axes = place_cell(figure, (0, bottom), cell)
    draw_brush(axes, **sizes)
    heading(axes, "", labels=["the recommended brush"])
    return figure


def draw_brush(axes, length, diameter, angle, tip_radius, spacing, density):
    """A row of bristles on their base under the slab, with the dimensions."""
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
        corners = [root + side * diameter / 2 * across_shaft + end * length * along for side, end in ((-1, 0), (1, 0), (1, 1), (-1, 1))]
        axes.add_patch(patches.Polygon(corners, facecolor="0.75", edgecolor=BLACK, linewidth=0.8))
    middle = roots[0] + 0.5 * length * along
    measure(axes, roots[-1] + 1.4 * diameter * across_shaft, roots[-1] + length * along + 1.4 * diameter * across_shaft, f"{length:.4g}",
            (6, -2), "left")
    measure(axes, middle - diameter / 2 * across_shaft, middle + diameter / 2 * across_shaft, f"{diameter:.3g} diameter", (-18, 6), "right")
    low = np.array([0, -thick * 1.35])
    measure(axes, roots[0] + low, roots[1] + low, f"{spacing:.4g}", (0, -11), "center")
    axes.add_patch(patches.Arc(roots[2], 0.5 * length, 0.5 * length, theta1=0, theta2=angle, linewidth=0.8))
    at = roots[2] + 0.29 * length * np.array([np.cos(lean / 2), np.sin(lean / 2)])
    axes.text(*at, f"{angle:.3g} degrees", fontsize=points(9), backgroundcolor="white", va="center")
    axes.text(right + spacing, height / 2, f"tip radius {tip_radius:.3g} mm\n{density:,.0f} bristles per m$^2$", fontsize=points(10), va="center",
              color=GREY)
    axes.set_aspect("equal")
    axes.set_xlim(left - 0.5 * spacing, right + spacing + 0.9 * length)
    axes.set_ylim(-thick * 2.2, height + 1.2 * thick)
    axes.axis("off")


def measure(axes, start, end, string, offset, align):
    """An arrow between two points, with its length."""
    axes.annotate("", end, start, arrowprops=ARROW)
    axes.annotate(string, (np.array(start) + end) / 2, offset, textcoords="offset points", ha=align, va="center", fontsize=points(9))
