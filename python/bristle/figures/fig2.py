"""Fig. 2: time histories of bristles of different azimuth, with the phase of the tip at each time."""

import re
from collections import namedtuple

import numpy as np
from matplotlib import patches, ticker
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D

from ..errors import BristleError
from ..plotting.contour_labels import HALO
from ..plotting.curves import true_runs
from ..plotting.layout import legend_at_foot, place, sheet
from ..plotting.page import paper_width, points
from ..plotting.readings import page_for_each_reading
from ..plotting.style import BLACK, BLUE, GREY, ORANGE, PURPLE, VERMILION, label
from ..plotting.tip_path import draw_space
from ..results import attribute, constant, dataset, flags, place_of, point_numbers, read, setting

AXES = []
TABLE = "trajectories"
COLUMNS = ["xi", "x", "y", "z", "F_n", "F_fx", "F_fy", "V_R"]
PHASES = {"stick": ("sticking", BLUE), "slip": ("sliding", GREY), "side_slip": ("side-slip", ORANGE),
          "off_slab": ("rebound", PURPLE)}
NOTE = """Sticking: $V_R < V_s$. Side-slip: $V_R$ turned by more than SIDE_SLIP\u00b0 from the slab's motion. \
Rebound: tip more than WALL_RANGES wall ranges $\\lambda_z$ off the slab. Of several, rebound comes first, then \
sticking.
$t_0$, $t_1$, $t_2$: where the three longest spells of sticking begin. In space: grey, the bristle at equal intervals of \
time; dashed, before the slab arrives; plane, the slab. Dotted: mean load per bristle, $\\tilde{R}_n/N_{c,0}$."""

# In inches: the figure; the columns, one for each bristle; by how much the view in space is wider, lower end and height of
# this view and of that from above; and of the histories lower end, height and distance.
Arrangement = namedtuple("Arrangement", "width height left column gap wider space above rows")
NARROW = 1.5  # inches of a column with fewer numbers and letters
LEAST_SPEED, LEAST_FORCE = 1e-4, 0.03  # lower ends of the logarithmic plots

# theta_0 and phi_0 in radians; numbers: the columns by name; phase: the word for each row.
Passage = namedtuple("Passage", "theta_0 phi_0 numbers phase")


def MARKS(file):
    """The legend in words, for a caption."""
    return ("Rows: the tip's path in space, from above, the speed relative to the slab, the normal force and the friction force. Colours of "
            "paths and areas: blue, sticking; grey or none, sliding; orange, side-slip; purple, rebound. Cross, and dot in space: the root. In the "
            f"last row, linear between -1 and 1, black is $F_{{f,x}}$ and vermilion $F_{{f,y}}$. Vertical dashed lines: the times below. {note(file)}")


@page_for_each_reading
def draw(file, reading):
    return passages_page(file, reading, point_numbers(file).sel(reading))


def passages_page(file, reading, selected, more=""):
    """The page of the passages of the first of the selected points, with a further line in its note."""
    numbers = point_numbers(file)
    passages, point = read_passages(file, selected)
    inches = arrangement(len(passages))
    figure, bottom = sheet(file, inches.width, inches.height, note(file) + more, reading)
    gap, load = (float(dataset(file, name).where(numbers == point).max()) for name in ("z_0", "R_n"))
    symbol = attribute(dataset(file, f"{TABLE}/theta_0"), "symbol")
    for i, passage in enumerate(passages):
        x, column = inches.left + i * (inches.column + inches.gap), inches.column
        space = place(figure, x - inches.wider / 2, bottom + inches.space[0], column + inches.wider, inches.space[1],
                      projection="3d")
        draw_space(space, passages, passage, gap, path_colours(passage),
                   [label(dataset(file, f"{TABLE}/{name}")) for name in "xyz"])
        figure.text((x + column / 2) / figure.get_figwidth(), (bottom + inches.height - 0.1) / figure.get_figheight(),
                    f"${symbol}$ = {np.degrees(passage.theta_0):.0f}\u00b0", ha="center", va="top", fontsize=points(12))
        above = place(figure, x, bottom + inches.above[0], column, inches.above[1])
        draw_top_view(above, file, passages, passage, first=i == 0)
        low, tall, step = inches.rows
        rows = [place(figure, x, bottom + low + row * step, column, tall) for row in (2, 1, 0)]
        draw_history(rows, file, passages, passage, load, first=i == 0)
    draw_legend(figure, file, bottom)
    return figure


def arrangement(columns):
    if paper_width() is None:
        return Arrangement(1.3 + columns * 3.1, 10.9, 0.85, 2.8, 0.3, 0.5, (7.75, 2.9), (6.05, 1.55), (0.9, 1.45, 1.55))
    left, gap = 0.62, 0.1
    column = (paper_width() - left - 0.08) / columns - gap
    tall, from_above = 0.35 * column + 0.5, 0.6 * column + 0.2
    above = 0.4 + 3 * (tall + 0.08) + 0.4
    space = above + from_above, 0.85 * column + 0.25
    return Arrangement(paper_width(), sum(space) + 0.22, left, column, gap, 0, space, (above, from_above),
                       (0.4, tall, tall + 0.08))


def is_narrow(axes):
    return axes.get_position().width * axes.figure.get_figwidth() < NARROW


def few_numbers(axes, which, most):
    """Fewer numbers at the axis of a narrow column."""
    if is_narrow(axes):
        getattr(axes, f"{which}axis").set_major_locator(ticker.MaxNLocator(most, steps=[1, 2, 5, 10]))


def note(file):
    """The legend in words; the file states the limits of the phases."""
    phase = dataset(file, f"{TABLE}/phase")
    numbers = {"SIDE_SLIP": np.degrees(constant(phase, "side_slip_rad")),
               "WALL_RANGES": constant(phase, "off_slab_wall_ranges")}
    return re.sub("|".join(numbers), lambda found: f"{numbers[found.group()]:g}", NOTE)


def read_passages(file, points):
    """The passages of the first of these points, in the order of the file; and the point's index."""
    columns = {name: read(file, f"{TABLE}/{name}") for name in [*COLUMNS, "theta_0", "point"]}
    words, numbers = flags(dataset(file, f"{TABLE}/phase"))
    if unknown := set(words) - set(PHASES):
        raise BristleError(f"{place_of(file)}: dataset '/{TABLE}/phase' has unknown phases: "
                           f"{', '.join(sorted(unknown))}")
    if len({len(column) for column in [*columns.values(), numbers]}) > 1 or not numbers.size:
        raise BristleError(f"{place_of(file)}: the datasets of /{TABLE} are empty or differ in length")
    for name, column in columns.items():
        if not np.isfinite(column).all():
            raise BristleError(f"{place_of(file)}: dataset '/{TABLE}/{name}' has values that are not finite")
    here = columns["point"][np.isin(columns["point"], points)]
    if not here.size:
        raise BristleError(f"{place_of(file)}: the table /{TABLE} has no rows of this reading")
    first = columns["point"] == here[0]
    azimuths = dict.fromkeys(columns["theta_0"][first])
    phi_0 = np.radians(setting(file, "model", "phi_0_deg"))
    out = []
    for azimuth in azimuths:
        rows = first & (columns["theta_0"] == azimuth)
        out.append(Passage(azimuth, phi_0, {name: columns[name][rows] for name in COLUMNS},
                           np.array(words)[numbers[rows]]))
    return out, int(here[0])


def spells(passage, phase):
    """First and last row of each spell of the phase; the last is where the next begins."""
    final = len(passage.phase) - 1
    return [(first, min(last + 1, final)) for first, last in true_runs(passage.phase == phase)]


def path_colours(passage):
    return [PHASES[phase][1] for phase in passage.phase[:-1]]


def marked_times(passage):
    """Rows at which the three longest spells of sticking begin, in time."""
    xi = passage.numbers["xi"]
    longest = sorted(spells(passage, "stick"), key=lambda spell: xi[spell[0]] - xi[spell[1]])[:3]
    return sorted(first for first, _ in longest)


def extent(passages, names, room=0.06):
    """The range of the columns over all passages, with some room."""
    found = np.concatenate([passage.numbers[name] for passage in passages for name in names])
    low, high = found.min(), found.max()
    return low - room * (high - low), high + room * (high - low)


def draw_top_view(axes, file, passages, passage, first):
    x, y = passage.numbers["x"], passage.numbers["y"]
    points = np.column_stack([x, y])
    axes.add_collection(LineCollection(np.stack([points[:-1], points[1:]], axis=1), linewidths=1.6,
                                       colors=path_colours(passage), capstyle="round"))
    axes.plot(0, 0, "+", color=BLACK, markersize=7)
    for number, row in enumerate(marked_times(passage)):
        axes.plot(x[row], y[row], "o", color=BLACK, markersize=3, zorder=5)
        axes.annotate(f"$t_{number}$", (x[row], y[row]), (3, (4, 4, -11)[number]), textcoords="offset points",
                      path_effects=HALO, zorder=6)
    equal_scales(axes, passages)
    few_numbers(axes, "x", 3)
    axes.set_xlabel(label(dataset(file, f"{TABLE}/x")), labelpad=1)
    titles(axes, file, ["y"], first)


def equal_scales(axes, passages):
    """Limits that hold all paths and the root, with the same scale in both directions."""
    low, high = np.transpose([(min(low, 0), max(high, 0)) for low, high in
                              (extent(passages, [name], 0) for name in "xy")])
    box = axes.get_window_extent()
    scale = 1.35 * max((high - low) / (box.width, box.height))
    for which, middle, size in zip("xy", (low + high) / 2, (box.width, box.height)):
        getattr(axes, f"set_{which}lim")(middle - scale * size / 2, middle + scale * size / 2)


def titles(axes, file, names, first):
    """Title of the vertical axis, in the first column only."""
    if first:
        axes.set_ylabel(", ".join(label(dataset(file, f"{TABLE}/{name}")) for name in names))
    else:
        axes.tick_params(labelleft=False)


def draw_history(rows, file, passages, passage, load, first):
    speed, normal, friction = rows
    numbers = passage.numbers
    xi = numbers["xi"]
    speed.plot(xi, numbers["V_R"], color=BLACK, linewidth=0.9)
    normal.plot(xi, numbers["F_n"], color=BLACK, linewidth=0.9)
    normal.axhline(load, color=BLACK, linewidth=1, linestyle=":")
    for name, colour in (("F_fx", BLACK), ("F_fy", VERMILION)):
        friction.plot(xi, numbers[name], color=colour, linewidth=0.9)
    scale_rows(rows, passages)
    for axes, names in zip(rows, (["V_R"], ["F_n"], ["F_fx", "F_fy"])):
        axes.set_xlim(0, max(p.numbers["xi"][-1] for p in passages))
        titles(axes, file, names, first)
        axes.tick_params(labelbottom=axes is friction)
        shade(axes, passage)
    few_numbers(friction, "x", 4)
    friction.set_xlabel(label(dataset(file, f"{TABLE}/xi")), labelpad=1)
    for number, row in enumerate(marked_times(passage)):
        for axes in rows:
            axes.axvline(xi[row], color=BLACK, linewidth=0.6, linestyle=(0, (4, 2)))
        side = -1 if number == 1 else 1  # the times may be close
        if is_narrow(speed) and number == 1:
            continue
        speed.annotate(f"$t_{number}$", (xi[row], 1), (2 * side, -10), xycoords=("data", "axes fraction"),
                       textcoords="offset points", path_effects=HALO, ha="right" if side < 0 else "left")


def scale_rows(rows, passages):
    """The same logarithmic ranges in all columns; friction has both signs."""
    speed, normal, friction = rows
    for axes in rows:
        axes.tick_params(axis="y", labelsize=points(10))  # powers of ten, whose exponents are small
    for axes, name, least in ((speed, "V_R", LEAST_SPEED), (normal, "F_n", LEAST_FORCE)):
        low, high = extent(passages, [name], 0)
        axes.set_yscale("log")
        axes.set_ylim(max(0.7 * low, least), 2.5 * high)
    low, high = extent(passages, ["F_fx", "F_fy"], 0.1)
    friction.set_yscale("symlog", linthresh=1)
    friction.set_ylim(min(low, -1), max(1.4 * high, 1))
    friction.yaxis.get_major_locator().set_params(numticks=4)


def shade(axes, passage):
    xi = passage.numbers["xi"]
    for phase, (_, colour) in PHASES.items():
        if phase != "slip":
            bars = [(xi[first], xi[last] - xi[first]) for first, last in spells(passage, phase)]
            axes.broken_barh(bars, (0, 1), transform=axes.get_xaxis_transform(), color=colour, alpha=0.25,
                             linewidth=0, zorder=0)


def draw_legend(figure, file, bottom):
    entries = {text: (patches.Patch(color=colour, alpha=0.6) if phase != "slip" else
                      Line2D([], [], color=colour, linewidth=2)) for phase, (text, colour) in PHASES.items()}
    for name, colour in (("F_fx", BLACK), ("F_fy", VERMILION)):
        entries[label(dataset(file, f"{TABLE}/{name}"))] = Line2D([], [], color=colour, linewidth=1)
    legend_at_foot(figure, entries, bottom + 0.1)
