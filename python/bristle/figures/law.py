"""The friction laws of any result over the sliding speed, as the program evaluates them."""

from ..computing import find_program
from ..plotting.layout import Cell, across, legend_at_foot, place_cell, sheet
from ..plotting.page import drawn_on
from ..plotting.readings import OPTIONS
from ..plotting.style import LOOKS
from ..program import laws
from ..results import CHOICE_NAMES, as_result, experiment

AXES = []
MARKS = "Circles: the values that define the own law of the experiment"
OWN = "custom"


def draw(file, *, plain=True, width=None, panels=None, maps_only=False, cmap=None, style=None):
    """Always as for a paper, 7 inches wide unless there is a width."""
    with drawn_on(plain, 7 if width is None else width, panels, maps_only, cmap, style):
        return draw_laws(as_result(file))


draw.__doc__ = f"{__doc__}\n\n{draw.__doc__}{OPTIONS}"


def draw_laws(file):
    document = experiment(file)
    curves = laws(find_program(), document)
    speeds = curves.pop("V_R")
    speeds, unit = (curves.pop("V_R_m_per_s"), "m/s") if "V_R_m_per_s" in curves else (speeds, "")
    cell, _ = across(1, Cell(5, 4, 0.7, 0.5, 4, 3))
    figure, bottom = sheet(file, cell.width, cell.height)
    axes = place_cell(figure, (0, bottom), cell)
    entries = {}
    for look, (name, line) in zip(LOOKS, curves.items()):
        title = CHOICE_NAMES.get(name, "own" if name == OWN else name.capitalize())
        entries[title], = axes.plot(speeds[1:], line[1:], color=look.colour, linestyle=look.line)
    points = document.get("friction_law", {})
    if OWN in curves and "mu" in points:
        own = points["V_R_m_per_s" if unit else "V_R"]
        entries["own, values given"], = axes.plot(own[1:], points["mu"][1:], "o", color="black", fillstyle="none")
    axes.set_xscale("log")
    axes.set_ylim(bottom=0)
    axes.set_xlabel(f"Sliding speed $V_R$ ({unit})" if unit else "Sliding speed $V_R/V_0$ (dimensionless)")
    axes.set_ylabel(r"$\mu(V_R)$ (dimensionless)" if list(curves) == [OWN] else "Modulation of the friction (dimensionless)")
    legend_at_foot(figure, entries, bottom)
    return figure
