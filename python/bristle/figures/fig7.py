"""Fig. 7: friction and gap over the radial stiffness under both local friction laws, each also with the nominal
friction of the other."""

import numpy as np

from ..plotting.curves import (BANDS, curve_marks, draw_curve, draw_panels, jump_note, legend_below, log_axis,
                               read_curve, without_remarks)
from ..plotting.layout import Cell, across, corners, heading, place_cell, sheet
from ..plotting.page import lettered, paper_width
from ..plotting.readings import one_page, page_for_each_reading
from ..plotting.style import BLACK, GREY, Look, looks, symbol
from ..plotting.verdicts import number
from ..results import CHOICE_NAMES, axis_values, dataset

AXES = ["friction", "nominal_friction", "k_r"]
VARIABLES = ["R_x_norm", "z_0"]

# Of the factors of R_x_norm, the power with which each enters. Coulomb's friction is linear in the load: neither
# its fluctuation (gamma_3) nor the number of bristles that share it changes the force of a given load.
FACTORS = {"gamma_1": 1, "gamma_2": 1, "gamma_3": 1, "N_c_ratio": 1 / 3}
IN_COULOMB = ["gamma_1", "gamma_2"]
REST, REST_LOOK = "the rest", Look(GREY, "--", "")
PAPERS_NOMINAL = {"nss": -1, "coulomb": 0}  # index of the paper's local friction under each law: the higher, the lower
TITLES = {"parts": "Figure 7, continued: the friction as a product of its factors"}
PARTS_NOTE = r"""Black: the sum of the others. Grey dashed, the rest: the friction is a mean of products, not the product of means.
Coulomb's friction is linear in the load: neither $\tilde{\gamma}_3$ nor $N_c$ is a factor of it."""


@one_page
def draw(file):
    ratio = symbol(dataset(file, "nominal_friction"))
    curves = {f"{CHOICE_NAMES.get(law, law)}, {ratio} = {nominal:.2g}": {"friction": law, "nominal_friction": nominal}
              for law in axis_values(file, "friction") for nominal in axis_values(file, "nominal_friction")}
    return draw_panels(file, VARIABLES, "k_r", curves, finish=lambda axes, _: axes.set_ylim(0, 1.25))


@page_for_each_reading
def draw_parts(file, reading):
    """ln R_x_norm as the sum of the logarithms of its factors, a panel for each law."""
    laws = [law for law in axis_values(file, "friction") if law in PAPERS_NOMINAL]
    parts = {law: parts_of(file, law, reading) for law in laws}
    falls = "\n".join(fall(file, law, *parts[law]) for law in laws)
    note = f"{falls}\n{PARTS_NOTE}\n{BANDS} {jump_note(file, 'k_r')}"
    panels = lettered(laws)
    cell, columns = across(len(panels), Cell(5.6, 5.15, 0.95, 0.8, 4.4, 3.9), 0.8)
    below = 0.35 if paper_width() is None else 0  # of the legend
    figure, bottom = sheet(file, cell.width * columns, cell.height * -(-len(panels) // columns) + below, note, reading,
                           verdicts=False, title=TITLES["parts"])
    entries = {}
    for (letter, law), corner in zip(panels, corners(len(panels), columns, cell, bottom + below)):
        axes = place_cell(figure, corner, cell)
        total, terms = parts[law]
        entries |= draw_curve(axes, total, Look(BLACK, "-", ""), term_text(file, VARIABLES[0]))
        for (name, term), look in looks(terms.items()):
            entries |= draw_curve(axes, term, REST_LOOK if name == REST else look, term_text(file, name), 1.2)
        axes.axhline(0, color=GREY, linewidth=0.6, zorder=0)
        log_axis(axes, "x", dataset(file, "k_r"))
        axes.set_ylabel("terms of $\\ln$ " + symbol(dataset(file, VARIABLES[0])))
        heading(axes, letter, CHOICE_NAMES.get(law, law))
    most = max(figure.axes[:len(panels)], key=lambda axes: len(axes.get_legend_handles_labels()[0]))
    legend_below(most, entries, bottom + 0.15)
    return figure


def parts_of(file, law, reading):
    """ln R_x_norm and its terms by name, as curves over k_r, at the paper's local friction."""
    nominal = axis_values(file, "nominal_friction")[PAPERS_NOMINAL[law]]

    def logarithm(name, power=1):
        curve = read_curve(file, name, "k_r", friction=law, nominal_friction=nominal, **reading)
        with np.errstate(divide="ignore", invalid="ignore"):
            return curve._replace(y=power * np.log(curve.y), error=power * curve.error / curve.y)

    total = logarithm(VARIABLES[0])
    terms = {name: without_remarks(logarithm(name, power))
             for name, power in FACTORS.items() if law != "coulomb" or name in IN_COULOMB}
    error = np.sqrt(sum(curve.error ** 2 for curve in (total, *terms.values())))
    rest = total._replace(y=total.y - sum(term.y for term in terms.values()), error=error)
    return total, {**terms, REST: without_remarks(rest)}


def term_text(file, name):
    if name == REST:
        return REST
    power = "" if FACTORS.get(name, 1) == 1 else r"$\frac{1}{3}$ "
    return f"{power}$\\ln$ {symbol(dataset(file, name))}"


def fall(file, law, total, terms):
    """A sentence: the change of ln R_x_norm from the first to the last k_r with values, and its largest term."""
    there = np.flatnonzero(np.isfinite(total.y) & np.all([np.isfinite(term.y) for term in terms.values()], axis=0))
    name = CHOICE_NAMES.get(law, law)
    if there.size < 2:
        return f"{name}: no change can be stated."
    first, last = there[[0, -1]]
    change = total.y[last] - total.y[first]
    changes = {key: term.y[last] - term.y[first] for key, term in terms.items()}
    largest = max(changes, key=lambda key: changes[key] * np.sign(change))
    return (f"{name}: from {symbol(dataset(file, 'k_r'))} = {total.x[first]:.3g} to {total.x[last]:.3g} "
            f"$\\ln$ {symbol(dataset(file, VARIABLES[0]))} changes by {number(change, '+.2f')}, the largest part of it by "
            f"{term_text(file, largest)}: {number(changes[largest], '+.2f')}.")


FURTHER = {"parts": draw_parts}
MARKS = {"": curve_marks, "parts": lambda file: f"{PARTS_NOTE} {curve_marks(file)} Thin grey line: zero"}
