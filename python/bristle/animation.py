"""An animation of recorded trajectories: bristles under the moving slab, for each model of bending, or in contact beside bouncing."""

import io
import os
import tempfile
from collections import namedtuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import patches
from matplotlib.animation import PillowWriter
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from PIL import Image, ImageSequence

from .errors import BristleError
from .figures.fig2 import PHASES, TABLE, path_colours, read_passages
from .files import write_whole
from .plotting.layout import place
from .plotting.readings import reading_name, readings
from .plotting.style import BLACK, GREY, SKY, VERMILION
from .results import attribute, axis_names, axis_values, dataset, flags, point_numbers, setting

FRAMES, PER_SECOND, DPI = 90, 12, 100
GIF = ".gif"
COLOURS = 64  # of all frames, so that the file is small
# In inches: the width of a view, and with what is between them; places for the azimuths, for time and names, and for the legend.
WIDE, SIDE, START, HEAD, FOOT = 3.35, 3.45, 0.95, 0.7, 0.8
LEGEND_PANELS, LEGEND_LINE = 3, 0.2  # panels below which the legend has one line; height of a further line
LEFT, RIGHT = -0.85, 3.95  # of the view along the motion; the tips start at 0
ROW = 1.15  # distance of the bristles across the motion
FORCE = 0.07  # length of an arrow for a force of 1
LEGEND_FORCE = 10
SHEAR, ACROSS, UP = 0.2, 0.62, 0.75  # of the oblique view
STRIPES = 0.5  # distance of the lines on the slab, by which its motion is seen
ARROW = dict(arrowstyle="-|>", mutation_scale=10, shrinkA=0, shrinkB=0, color=VERMILION, linewidth=1.6)

View = namedtuple("View", "title chosen")  # chosen: values of axes

# What moves with a bristle; origin: its root.
Moving = namedtuple("Moving", "passage origin shaft path tip force")


def film_path(output, name):
    """The file to write: `output`, or name.gif in it if it is a folder or has no ending."""
    ending = os.path.splitext(output)[1]
    if os.path.isdir(output) or not ending:
        return os.path.join(output, f"{name}.gif")
    if ending != GIF:
        raise BristleError(f"{output}: an animation has the ending {GIF}, not {ending}")
    return output


def write_animation(file, path):
    """Writes the GIF."""
    with tempfile.TemporaryDirectory() as folder:
        film = os.path.join(folder, "film.gif")
        draw_frames(file, film, PillowWriter(fps=PER_SECOND))
        write_whole(path, with_few_colours(film))


def with_few_colours(path):
    """The GIF with the same colours in all frames, without dots that mix them."""
    with Image.open(path) as made:
        frames = [Image.fromarray(np.asarray(frame.convert("RGB"))) for frame in ImageSequence.Iterator(made)]
        every = made.info["duration"]
    most = sorted(frames[len(frames) // 2].getcolors(1 << 24), reverse=True)[:COLOURS]
    palette = Image.new("P", (1, 1))
    palette.putpalette([level for _, colour in most for level in colour])
    first, *others = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    out = io.BytesIO()
    first.save(out, save_all=True, append_images=others, duration=every, loop=0, format="GIF")
    return out.getvalue()


def draw_frames(file, path, writer):
    models = [read_passages(file, point_numbers(file).sel(view.chosen))[0] for view in views(file)]
    figure, panels = panels_of(file, models)
    end = max(passage.numbers["xi"][-1] for passages in models for passage in passages)
    time = figure.text(0.5, 1 - 0.06 / figure.get_figheight(), "", ha="center", va="top", fontsize=14)
    symbol = attribute(dataset(file, f"{TABLE}/xi"), "symbol")
    length = setting(file, "model", "L_x")
    bristles = [start_bristles(axes, passages) for axes, passages in zip(panels, models)]
    slabs = [start_slab(axes, gap, len(passages)) for axes, gap, passages in zip(panels, gaps(file), models)]
    with writer.saving(figure, path, DPI):
        for xi in np.linspace(0, end, FRAMES):
            time.set_text(f"time since the slab's edge arrived: ${symbol}$ = {xi:.2f}")
            for slab in slabs:
                move_slab(*slab, xi, length)
            for moving in (one for column in bristles for one in column):
                move_bristle(moving, xi)
            writer.grab_frame()
    plt.close(figure)


def views(file):
    """What the panels show: each model of bending; of a sweep over k_r, the softest bristles in contact and the stiffest that
    bounce, of the last model."""
    models = readings(file)
    if "k_r" not in axis_names(dataset(file, "status")):
        return [View(reading_name(reading), reading) for reading in models]
    k_r, phase = axis_values(file, "k_r"), dataset(file, "phase").sel(models[-1])
    words, numbers = flags(phase.isel({name: 0 for name in phase.dims if name != "k_r"}))
    phases = np.asarray(words)[numbers]
    ends = [(word, np.flatnonzero(phases == word)) for word in ("contact", "bouncing")]
    symbol = attribute(dataset(file, "k_r"), "symbol")
    return [View(f"{word}, ${symbol}$ = {k_r[at]:.3g}", {**models[-1], "k_r": k_r[at]})
            for word, found in ends if found.size for at in [found[0 if word == "contact" else -1]]]


def gaps(file):
    return [float(dataset(file, "z_0").sel(view.chosen).max()) for view in views(file)]


def panels_of(file, models):
    """The figure with what does not move, and the axes of each model."""
    rows = max(map(len, models))
    low, high = seen(0, -0.35, 0)[1], seen(0, rows * ROW, 0)[1] + max(0.25, UP * max(gaps(file)))
    tall = WIDE * (high - low) / (RIGHT - LEFT)
    foot = FOOT + LEGEND_LINE * (len(models) < LEGEND_PANELS)
    figure = plt.figure(figsize=(START + SIDE * len(models), HEAD + tall + foot), dpi=DPI)
    panels = []
    for i, (view, gap, passages) in enumerate(zip(views(file), gaps(file), models)):
        axes = place(figure, START + i * SIDE, foot, WIDE, tall)
        axes.set(xlim=(LEFT, RIGHT), ylim=(low, high), xticks=[], yticks=[])
        symbol = attribute(dataset(file, "z_0"), "symbol")
        axes.set_title(", ".join(filter(None, [view.title, f"${symbol}$ = {gap:.2f}"])), fontsize=12, pad=5)
        axes.add_patch(patches.Polygon(corners(LEFT - 2, RIGHT + 2, rows, 0), color="0.93", zorder=0))
        panels.append(axes)
    name_rows(file, panels[0], models[0])
    draw_legend(figure, models)
    return figure, panels


def name_rows(file, axes, passages):
    theta = attribute(dataset(file, f"{TABLE}/theta_0"), "symbol")
    for row, passage in enumerate(passages):
        axes.annotate(f"${theta}$ = {np.degrees(passage.theta_0):.0f}\u00b0", (0, seen(0, row * ROW + 0.35, 0)[1]), (-5, 0),
                      xycoords=("axes fraction", "data"), textcoords="offset points", ha="right", va="center", fontsize=11)


def draw_legend(figure, models):
    present = {phase for passages in models for passage in passages for phase in passage.phase}
    entries = {f"tip {text}": Line2D([], [], color=colour, linewidth=3)
               for phase, (text, colour) in PHASES.items() if phase in present}
    entries |= {"bristle": Line2D([], [], color=BLACK, linewidth=2, marker="o", markersize=4, markevery=[0]),
                "bristle after its passage": Line2D([], [], color=GREY, linewidth=1, linestyle=":"),
                "slab": patches.Patch(facecolor=SKY, alpha=0.35, edgecolor=GREY)}
    figure.legend(entries.values(), entries, loc="lower center",
                  ncol=len(entries) if len(models) >= LEGEND_PANELS else -(-len(entries) // 2), fontsize=11, frameon=False,
                  bbox_to_anchor=(0.5, 0.36 / figure.get_figheight()), borderaxespad=0, columnspacing=1.4, handlelength=2)
    # The arrow of the legend is as long as one in the panels.
    inches = FORCE * LEGEND_FORCE * WIDE / (RIGHT - LEFT)
    width, level = figure.get_figwidth(), 0.2 / figure.get_figheight()
    start = 0.5 - 3.1 / width
    arrow = patches.FancyArrowPatch((start, level), (start + inches / width, level), **ARROW)
    figure.add_artist(arrow)
    figure.text(start + (inches + 0.12) / width, level, f"force of the slab on the tip, dimensionless: this arrow is {LEGEND_FORCE} along the "
                "motion", va="center", fontsize=11)


def seen(x, y, z):
    """A place in the oblique view from above."""
    return x + SHEAR * y, ACROSS * y + UP * z


def corners(left, right, rows, z):
    front, back = -0.25, rows * ROW
    return [seen(left, front, z), seen(right, front, z), seen(right, back, z), seen(left, back, z)]


def start_bristles(axes, passages):
    """The roots stand so that all tips start in a line across the motion, which the slab's edge reaches at time 0."""
    out = []
    for row, passage in enumerate(passages):
        origin = np.array([-passage.numbers["x"][0], row * ROW])
        axes.plot(*seen(*origin, 0), "o", color=BLACK, markersize=4, zorder=4)
        path = axes.add_collection(LineCollection([], linewidths=2.6, capstyle="round", zorder=3))
        (shaft,), (tip,) = axes.plot([], [], color=BLACK, zorder=5), axes.plot([], [], "o", markersize=6, zorder=7)
        force = axes.add_patch(patches.FancyArrowPatch((0, 0), (0, 0), zorder=8, **ARROW))
        out.append(Moving(passage, origin, shaft, path, tip, force))
    return out


def move_bristle(moving, xi):
    """At the time xi; after the end of the passage there is no force, and the bristle's motion is not recorded."""
    numbers = moving.passage.numbers
    times, under = numbers["xi"], xi <= numbers["xi"][-1]
    x, y, z, *force = (np.interp(xi, times, numbers[name]) for name in ("x", "y", "z", "F_fx", "F_fy", "F_n"))
    row = int(np.searchsorted(times, xi, side="right"))  # rows before this one are past
    (root_x, root_y), path = moving.origin, np.column_stack(seen(
        moving.origin[0] + numbers["x"][:row], moving.origin[1] + numbers["y"][:row], numbers["z"][:row]))
    place_of_tip = seen(root_x + x, root_y + y, z)
    path = np.vstack([path, place_of_tip])
    colours = [*path_colours(moving.passage), GREY]
    moving.path.set(segments=np.stack([path[:-1], path[1:]], axis=1), color=colours[:len(path) - 1])
    moving.shaft.set_data(*zip(seen(root_x, root_y, 0), place_of_tip))
    moving.shaft.set(color=BLACK if under else GREY, linewidth=2 if under else 1, linestyle="-" if under else ":")
    moving.tip.set_data(*([value] for value in place_of_tip))
    moving.tip.set(color=PHASES[moving.passage.phase[row - 1]][1], visible=under)
    end = seen(root_x + x + FORCE * force[0], root_y + y + FORCE * force[1], z - FORCE * force[2])
    moving.force.set_positions(place_of_tip, end)
    moving.force.set_visible(under)


def start_slab(axes, gap, rows):
    outline = axes.add_patch(patches.Polygon([(0, 0)], facecolor=SKY, edgecolor=GREY, alpha=0.35, linewidth=1.2, zorder=6))
    lines = axes.add_collection(LineCollection([], colors=GREY, linewidths=0.6, alpha=0.5, zorder=6))
    return outline, lines, gap, rows


def move_slab(outline, lines, gap, rows, xi, length):
    left, right = xi - length, xi
    outline.set_xy(corners(left, right, rows, gap))
    stripes = [corners(x, x, rows, gap) for x in np.arange(left, right + STRIPES / 2, STRIPES)]
    lines.set_segments([(stripe[0], stripe[2]) for stripe in stripes])
