"""The path of a bristle's tip in space, with the bristle and the slab."""

import numpy as np
from matplotlib import ticker
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from .page import paper_width, points
from .style import BLACK, GREY, SKY

SNAPSHOTS = 9  # of the bristle, at equal intervals of time


def draw_space(space, passages, passage, gap, colours, titles):
    """Draws one passage; all passages have the same limits. colours: one for each segment of the path."""
    x, y, z = (passage.numbers[name] for name in "xyz")
    tip = undeformed(passage)
    limits = box(passages)
    draw_slab(space, limits, gap)
    xi = passage.numbers["xi"]
    for row in np.searchsorted(xi, np.linspace(0, xi[-1], SNAPSHOTS)):
        space.plot(*zip((0, 0, 0), (x[row], y[row], z[row])), color=GREY, linewidth=0.7, alpha=0.6)
    space.plot(*zip((0, 0, 0), tip), color=BLACK, linewidth=1.3, linestyle="--")
    points = np.column_stack([x, y, z])
    space.add_collection3d(Line3DCollection(np.stack([points[:-1], points[1:]], axis=1), colors=colours,
                                            linewidths=2))
    space.scatter(0, 0, 0, color=BLACK, s=14, depthshade=False)
    space.set(xlim=limits[0], ylim=limits[1], zlim=limits[2])
    space.set_box_aspect([high - low for low, high in limits], zoom=1.18)
    label_axes(space, titles)
    space.view_init(elev=22, azim=-65)


def label_axes(space, titles):
    for name, title, pad in zip("xyz", titles, (3, -6, -9)):
        axis = getattr(space, f"{name}axis")
        axis.set_major_locator(ticker.MultipleLocator(0.5))
        axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
        axis.set_pane_color((0.97, 0.97, 0.97, 1))
        axis.set_rotate_label(False)
        axis.set_label_text(title)
        axis.labelpad = pad
    space.tick_params(pad=-3, labelsize=points(8.5))
    if paper_width() is not None:  # too small for numbers and names, which the view from above has
        space.tick_params(labelbottom=False, labelleft=False, labelright=False)
        for axis in (space.xaxis, space.yaxis, space.zaxis):
            axis.label.set_visible(False)
        space.patch.set_visible(False)


def undeformed(passage):
    """The tip of the undeformed bristle, of length one."""
    level = np.cos(passage.phi_0)
    return level * np.cos(passage.theta_0), level * np.sin(passage.theta_0), np.sin(passage.phi_0)


def box(passages):
    """Limits of x, y and z over all passages, the bristles' roots and undeformed tips."""
    ends = np.array([(0, 0, 0), (0, 0, 1), *map(undeformed, passages)])
    out = []
    for i, name in enumerate("xyz"):
        found = np.concatenate([ends[:, i], *(passage.numbers[name] for passage in passages)])
        room = 0 if name == "z" else 0.05 * np.ptp(found)
        out.append((found.min() - room, found.max() + room))
    return out


def draw_slab(space, limits, gap):
    (left, right), (front, back) = limits[:2]
    corners = [(left, front, gap), (right, front, gap), (right, back, gap), (left, back, gap)]
    space.add_collection3d(Poly3DCollection([corners], facecolors=SKY, edgecolors=GREY, linewidths=0.5,
                                            alpha=0.18))
