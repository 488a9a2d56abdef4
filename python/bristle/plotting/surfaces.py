"""A quantity over the two stiffnesses as a surface in space."""

import numpy as np
from matplotlib.cm import ScalarMappable
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from .page import paper_width, points
from .style import log_ticks, value_ticks

CORNER = 0.18  # of an axis' length, without ticks


def draw_surface(space, grid, field, norm):
    """Faces between neighbouring points with values and without a jump, coloured by their mean."""
    x, y = np.meshgrid(grid.x, grid.y)
    nodes = np.stack([x, y, field.filled(np.nan)], axis=-1)
    faces = []
    torn = torn_faces(grid)
    for j in range(len(grid.y) - 1):
        for i in range(len(grid.x) - 1):
            if torn[j, i]:
                continue
            corners = nodes[[j, j, j + 1, j + 1], [i, i + 1, i + 1, i]]
            corners = corners[np.isfinite(corners[:, 2])]
            if len(corners) >= 3:
                faces.append(corners)
    if faces:
        shades = ScalarMappable(norm).to_rgba([face[:, 2].mean() for face in faces])
        space.add_collection3d(Poly3DCollection(faces, facecolors=shades, edgecolors="#00000070",
                                                linewidths=0.35))


def torn_faces(grid):
    """Whether the loading path jumps along any edge of the face between four points."""
    along_y, along_x = grid.jumps
    return along_x[:-1] | along_x[1:] | along_y[:, :-1] | along_y[:, 1:]


def label_surface(space, grid, norm, titles, z_title):
    for axis, line, title in zip("xy", (grid.x, grid.y), titles):
        places, texts = log_ticks(line[0], line[-1])
        if axis == "y":
            places, texts = clear_of_corner(places, texts, line)
        getattr(space, f"set_{axis}lim")(line[0], line[-1])
        getattr(space, f"set_{axis}ticks")(places, texts)
        getattr(space, f"set_{axis}label")(title, labelpad=-3)
    space.set_zlim(norm.vmin, norm.vmax)
    space.zaxis.set_major_locator(value_ticks(5 if paper_width() is None else 4))
    space.text2D(0.97, 0.83, z_title, transform=space.transAxes, ha="center", fontsize=points(11))
    space.tick_params(pad=-3, labelsize=points(8.5))
    space.tick_params(axis="z", pad=0)
    for axis in (space.xaxis, space.yaxis, space.zaxis):
        axis.set_pane_color((0.97, 0.97, 0.97, 1))
        axis.set_rotate_label(False)
    space.patch.set_visible(False)  # it would hide what is beside the surface
    # Seen from large k_r and small k_theta: a decrease with k_r faces the reader.
    space.view_init(elev=24, azim=-52)
    space.set_box_aspect((1.15, 1.0, 0.95))


def clear_of_corner(places, texts, line):
    """The ticks without those at the axis' lower end, where the texts of both horizontal axes meet."""
    clear = places > line[0] + CORNER * (line[-1] - line[0])
    return (places[clear], [text for text, kept in zip(texts, clear) if kept]) if clear.any() else (places, texts)
