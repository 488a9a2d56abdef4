"""The load of bouncing bristles: its maximum beside a formula, and the share of time off the slab and the load over the gap."""

import numpy as np
from matplotlib.lines import Line2D

from ..plotting.curves import BANDS, Curve, draw_curve, draw_points, log_range, read_curve, title_axis, with_symbol
from ..plotting.layout import Cell, across, corners, heading, legend_at_foot, place_cell, sheet
from ..plotting.lift_off import LIFT_OFF, in_percent, scatter
from ..plotting.page import lettered, paper_width
from ..plotting.readings import one_page, reading_name, readings
from ..plotting.style import BLACK, COLOURS, GREY, Look, described
from ..results import axis_values, dataset, select, select_errors, select_flags

AXES = ["contact", "sample", "z_0_target"]
VARIABLES = [LIFT_OFF, "off_slab_share", "R_n"]
# Of each panel: its heading, and the name of y before the symbol.
TITLES_OF = {LIFT_OFF: ("largest load of bouncing bristles", "largest load"),
             "off_slab_share": ("share of time with the tip off the slab", "share of time"),
             "R_n": ("load", "load")}
BRUSHES = ["k_r", "k_phi", "mu_c"]  # quantities that tell brushes apart
SHOWN = 4  # brushes over the gap
MARKERS = "os^D"
HOLLOW = "hertz"  # the contact of open marks
LIMITS = {"off_slab_share": 0.5}  # grey lines
LEGEND_INCHES = 0.35
NOTES = ["All brushes on which the formula was tested. Black: equality; grey band: the scatter of the formula, {}. {}",
         "Above the grey line bristles count as bouncing.",
         "Triangles at the right: the lift-off load by the formula. Only brushes on which the formula was tested."]


def MARKS(file):
    return f"{panel_notes(file)} {BANDS}"


def panel_notes(file):
    """What the panels show, of those that are drawn."""
    notes = [NOTES[0].format(in_percent(scatter(file)), agreement(file)), *NOTES[1:]]
    panels = "\n".join(f"({letter}) {note}" if letter else note for letter, note in lettered(notes))
    return f"{panels}\n{of_curves(file)}"


@one_page
def draw(file):
    panels = lettered(VARIABLES)
    cell, columns = across(min(len(panels), 2), Cell(5.2, 4.0, 0.9, 0.75, 4.0, 2.9), 0.52)
    below = LEGEND_INCHES if paper_width() is None else 0
    figure, bottom = sheet(file, cell.width * columns, cell.height * -(-len(panels) // columns) + below,
                           f"{panel_notes(file)} {BANDS}")
    marks, marked, lines, statuses = {}, None, {}, {}
    for (letter, name), corner in zip(panels, corners(len(panels), columns, cell, bottom + below)):
        axes = place_cell(figure, corner, cell)
        title, y_name = TITLES_OF[name]
        if name == LIFT_OFF:
            marks, marked = draw_maxima(axes, file), axes
        else:
            statuses |= draw_over_gap(axes, file, name)
            lines = dict(zip(*axes.get_legend_handles_labels()[::-1])) | lines
        title_axis(axes, "y", dataset(file, "R_n" if name == LIFT_OFF else name), y_name)
        heading(axes, letter, title, [described(dataset(file, name))])
    if marks and paper_width() is None:
        marked.legend(marks.values(), marks.keys(), loc="upper left")
        marks = {}
    legend_at_foot(figure, marks | lines | statuses, bottom + LEGEND_INCHES / 2)
    return figure


def draw_maxima(axes, file):
    """The largest load of bouncing bristles over the load of the formula; returns the legend's entries by text."""
    entries, ends = {}, []
    for reading, marker, colour in zip(readings(file), MARKERS, COLOURS):
        for contact in axis_values(file, "contact"):
            curve = maxima(file, contact, reading)
            draw_points(axes, curve, colour, marker=marker, filled=contact != HOLLOW)
            ends += [curve.x, curve.y]
        entries[reading_name(reading) or "bristles"] = Line2D([], [], linestyle="", marker=marker, color=colour, markersize=4.5)
    for contact in axis_values(file, "contact"):
        filled = "white" if contact == HOLLOW else GREY
        entries[contact_text(file, contact)] = Line2D([], [], linestyle="", marker="o", color=GREY, markerfacecolor=filled, markersize=4.5)
    both = np.concatenate(ends)
    line = np.array([0.8 * both.min(initial=1), 1.25 * both.max(initial=2)])
    axes.plot(line, line, color=BLACK, linewidth=0.8, zorder=0)
    axes.fill_between(line, line * (1 - scatter(file)), line * (1 + scatter(file)), color=GREY, alpha=0.2, linewidth=0, zorder=0)
    for which in "xy":
        log_range(axes, which, *np.log10(line))
    title_axis(axes, "x", dataset(file, LIFT_OFF), "lift-off load by the formula")
    return entries


def contact_text(file, contact):
    return f"contact: {with_symbol(dataset(file, 'contact'), contact)}"


def maxima(file, contact, reading):
    """The largest load of bouncing bristles over the lift-off load by the formula, a point for each brush.

    Brushes without a value of the formula, or of the load at a gap at which they bounce, are left out.
    """
    chosen, along = {"contact": contact, **reading}, ["sample", "z_0_target"]
    words, phase = select_flags(file, "phase", along, **chosen)
    load, formula = (select(dataset(file, name), along, **chosen) for name in ("R_n", LIFT_OFF))
    inside = np.isin(phase, [words.index(word) for word in ("bouncing", "unknown")])
    bouncing = np.logical_and.accumulate(inside[:, ::-1], axis=1)[:, ::-1]  # from first contact downwards
    valued = (np.isfinite(load) | ~bouncing).all(axis=1) & bouncing.any(axis=1) & np.isfinite(formula).any(axis=1)
    at = np.flatnonzero(valued), np.where(bouncing, load, -np.inf).argmax(axis=1)[valued]
    nothing = np.zeros(valued.sum(), dtype=int)
    return Curve(formula[at], load[at], select_errors(file, "R_n", along, **chosen)[at], nothing, ["ok"], nothing[1:] > 0, [])


def agreement(file):
    """A sentence: how far the computed loads are from the formula."""
    found = [maxima(file, contact, reading) for reading in readings(file) for contact in axis_values(file, "contact")]
    off = np.concatenate([curve.y / curve.x - 1 for curve in found])
    if not off.size:
        return "No curve has a load at every gap at which the bristles bounce."
    tested = np.isfinite(dataset(file, LIFT_OFF).max("z_0_target").values).sum()
    return (f"The {off.size} of {tested} curves with a load at every gap at which the bristles bounce are "
            f"{in_percent(np.sqrt((off ** 2).mean()))} off, root mean square, {in_percent(abs(off).max())} at most.")


def shown_brushes(file):
    """By text, the choice of axes of each brush that is drawn over the gap: with the last model and contact."""
    reading, contact = readings(file)[-1], axis_values(file, "contact")[-1]
    samples = axis_values(file, "sample")[:SHOWN]
    tell = [name for name in BRUSHES if name in file and np.unique(dataset(file, name).sel(sample=samples)).size > 1]
    return {", ".join(with_symbol(dataset(file, name), float(dataset(file, name).sel(sample=sample))) for name in tell)
            or f"brush {sample}": {"contact": contact, "sample": sample, **reading} for sample in samples}


def of_curves(file):
    """A sentence with the model and the contact of the curves over the gap."""
    reading, contact = readings(file)[-1], axis_values(file, "contact")[-1]
    return f"Curves over the gap: {', '.join(filter(None, [reading_name(reading), contact_text(file, contact)]))}."


def draw_over_gap(axes, file, name):
    """A line for each shown brush; returns legend entries of the statuses."""
    entries = {}
    for (text, chosen), colour, marker in zip(shown_brushes(file).items(), COLOURS, MARKERS):
        curve, along = read_curve(file, name, "z_0_target", **chosen), ["z_0_target"]
        if name == "R_n":
            load = select(dataset(file, LIFT_OFF), along, **chosen)
            if not np.isfinite(load).any():
                continue
            axes.plot(1.02, np.nanmax(load), "<", color=colour, markersize=7, transform=axes.get_yaxis_transform(), clip_on=False)
        entries |= draw_curve(axes, curve, Look(colour, "-", marker), text, 1.2)
    if name in LIMITS:
        axes.axhline(LIMITS[name], color=GREY, linewidth=0.8, zorder=0)
    axes.set_ylim(bottom=0)
    axes.set_xlim(0, 1)
    title_axis(axes, "x", dataset(file, "z_0_target"), "gap")
    return entries
