"""The drawings of the documents: the bristle under the slab, with coordinates, gap and forces, and the rod (docs/images)."""

import argparse

import matplotlib
import numpy as np
from matplotlib import pyplot
from matplotlib.patches import Arc

ROD, SLAB, FORCE, GREY = "#0072b2", "#999999", "#d55e00", "#555555"
THETA, PHI = np.radians(35), np.radians(58)
GAP = 1.0
LENGTH = GAP / np.sin(PHI)  # of the bristle, whose tip is at the slab
UPRIGHT = np.radians(80)  # phi_0


def arrow(axes, start, vector, colour, text="", at=(0, 0), **look):
    end = np.add(start, vector)
    axes.annotate("", end, start, arrowprops=dict(arrowstyle="-|>", color=colour, shrinkA=0, shrinkB=0, **look))
    axes.text(*np.add(end, at), text, color=colour, ha="center", va="center")


def angle(axes, radius, start, end, text, at):
    axes.add_patch(Arc((0, 0), 2 * radius, 2 * radius, theta1=np.degrees(start), theta2=np.degrees(end), color=GREY))
    axes.text(radius * np.cos(at) * 1.2, radius * np.sin(at) * 1.2, text, ha="center", va="center")


def plain(axes, title, x, y):
    axes.set(xlim=x, ylim=y, aspect="equal")
    axes.set_title(title, fontsize=10)
    axes.axis("off")


def draw_side(axes):
    """The vertical plane through the bristle."""
    tip = LENGTH * np.array([np.cos(PHI), np.sin(PHI)])
    axes.fill_between([-0.55, 1.35], GAP + 0.03, GAP + 0.2, color=SLAB, alpha=0.4, linewidth=0)
    axes.text(-0.5, GAP + 0.115, "slab", va="center")
    axes.plot([-0.55, 1.35], [0, 0], color="black", linewidth=1.2)
    axes.text(-0.5, -0.09, "ground", va="center")
    axes.plot([0, 0], [0, GAP], ":", color=GREY)
    axes.text(-0.03, 0.62, "pole, $s = 0$", rotation=90, ha="right", va="center", color=GREY)
    axes.plot([0, np.cos(UPRIGHT)], [0, np.sin(UPRIGHT)], "--", color=ROD, alpha=0.5)
    axes.plot([0, tip[0]], [0, tip[1]], color=ROD, linewidth=3, solid_capstyle="round")
    axes.plot(*tip, "o", color=ROD, markersize=8)
    axes.text(0.40 * tip[0] + 0.09, 0.40 * tip[1], "$r$", color=ROD)
    angle(axes, 0.27, 0, PHI, r"$\varphi$", PHI / 2)
    angle(axes, 0.8, PHI, UPRIGHT, "", 0)
    axes.text(0.33, 0.83, r"$\varphi_0 - \varphi$", ha="center", fontsize=9)
    axes.text(0.03, 0.93, "undeformed", ha="left", color=ROD, alpha=0.8, fontsize=9)
    axes.annotate("", (1.15, GAP), (1.15, 0), arrowprops=dict(arrowstyle="<->", color=GREY, shrinkA=0, shrinkB=0))
    axes.text(1.2, GAP / 2, "$z_0$", va="center")
    axes.annotate("", (tip[0], -0.13), (0, -0.13),
                  arrowprops=dict(arrowstyle="<->", color=GREY, shrinkA=0, shrinkB=0))
    axes.text(tip[0] / 2, -0.2, "$s$", ha="center", va="center")
    arrow(axes, tip, (0, -0.42), FORCE, "$F_n$", (0.09, 0.05))
    plain(axes, "side view, in the bristle's vertical plane", (-0.6, 1.4), (-0.3, 1.3))


def draw_above(axes):
    s = 0.75
    tip = s * np.array([np.cos(THETA), np.sin(THETA)])
    arrow(axes, (0, 0), (1.35, 0), "black", "$x$", (0.07, 0), linewidth=0.8)
    arrow(axes, (0, 0), (0, 1.1), "black", "$y$", (0, 0.07), linewidth=0.8)
    axes.plot([0, tip[0]], [0, tip[1]], color=ROD, linewidth=3, solid_capstyle="round")
    axes.plot(*tip, "o", color=ROD, markersize=8)
    axes.plot(0, 0, "o", color=GREY, markersize=4)
    axes.text(-0.04, -0.08, "pole", ha="center", color=GREY)
    resting = np.radians(62)
    axes.plot([0, s * np.cos(resting)], [0, s * np.sin(resting)], "--", color=ROD, alpha=0.5)
    axes.text(s * np.cos(resting), s * np.sin(resting) + 0.06, r"undeformed, $\theta_0$", color=ROD, alpha=0.8)
    angle(axes, 0.32, 0, THETA, r"$\theta$", THETA / 2)
    axes.text(tip[0] / 2 - 0.03, tip[1] / 2 + 0.07, "$s$", color=ROD)
    velocity = np.array([-0.42, 0.16])  # of the tip, relative to the slab
    arrow(axes, tip, velocity * 0.85, GREY, r"$\mathbf{V}_R$", (-0.02, 0.08))
    arrow(axes, tip, -velocity * 0.85, FORCE, r"$\mathbf{F}_f$", (0.08, 0.02))
    arrow(axes, (0.25, -0.28), (0.55, 0), "black", "$V_0$, the slab's motion", (0.1, -0.1), linewidth=1.6)
    plain(axes, "view from above", (-0.3, 1.5), (-0.5, 1.25))


def draw_bending(axes):
    """The rod in the plane of its direction n and its undeformed direction d."""
    undeformed, bent = np.radians(80), np.radians(38)
    d, n = (np.array([np.cos(one), np.sin(one)]) for one in (undeformed, bent))
    axes.plot([-0.4, 1.35], [0, 0], color="black", linewidth=1.2)
    axes.text(-0.35, -0.09, "ground", va="center")
    axes.plot([0, d[0]], [0, d[1]], "--", color=ROD, alpha=0.5)
    axes.plot([0, n[0]], [0, n[1]], color=ROD, linewidth=3, solid_capstyle="round")
    axes.plot(*n, "o", color=ROD, markersize=8)
    axes.text(d[0] / 2 - 0.06, d[1] / 2, "undeformed", ha="right", va="center", color=ROD, alpha=0.8)
    arrow(axes, d, 0.25 * d, GREY, r"$\mathbf{d}$", (0.06, 0))
    arrow(axes, n, 0.25 * n, GREY, r"$\mathbf{n}$", (0.06, 0))
    angle(axes, 0.5, bent, undeformed, r"$\gamma$", (bent + undeformed) / 2)
    across = np.array([np.sin(bent), -np.cos(bent)])
    arrow(axes, n, -0.4 * across, FORCE, "force of\nbending", (-0.14, 0.14))
    plain(axes, "side view, in the plane of the bending", (-0.6, 1.4), (-0.3, 1.4))


def draw_angles(axes):
    """The two bending angles, seen along the undeformed direction."""
    u_p, u_s = -0.8, 0.6
    for radius in (0.5, 1.0):
        axes.add_patch(Arc((0, 0), 2 * radius, 2 * radius, color=GREY, alpha=0.4, linestyle=":"))
    arrow(axes, (0, 0), (0, 1.2), "black", r"$\mathbf{e}_p$: up", (0, 0.08), linewidth=0.8)
    arrow(axes, (0, 0), (1.2, 0), "black", r"$\mathbf{e}_s$: sideways", (0.22, -0.1), linewidth=0.8)
    axes.plot([u_s, u_s, 0], [0, u_p, u_p], "--", color=GREY, linewidth=1)
    axes.plot([0, u_s], [0, u_p], color=ROD, linewidth=3, solid_capstyle="round")
    axes.plot(u_s, u_p, "o", color=ROD, markersize=8)
    axes.plot(0, 0, "o", color=GREY, markersize=4)
    axes.text(-0.06, 0.08, r"$\mathbf{d}$", ha="right", color=GREY)
    axes.text(u_s / 2, 0.06, "$u_s$", ha="center")
    axes.text(-0.06, u_p / 2, "$u_p$", ha="right", va="center")
    axes.text(u_s / 2 + 0.06, u_p / 2 + 0.04, r"$\gamma$", color=ROD)
    axes.text(-1.15, -1.15, r"energy $= k_\varphi u_p^2/2 + k_\theta u_s^2/2$", fontsize=10)
    plain(axes, r"bending angles, seen along $\mathbf{d}$", (-1.2, 1.7), (-1.25, 1.4))


DRAWINGS = {"bristle": (draw_side, draw_above), "rod": (draw_bending, draw_angles)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("drawing", choices=DRAWINGS)
    parser.add_argument("-o", dest="path", help="file to write (default: docs/images/DRAWING.svg)")
    arguments = parser.parse_args()
    path = arguments.path or f"docs/images/{arguments.drawing}.svg"
    matplotlib.rcParams.update({"font.size": 11, "svg.hashsalt": "bristle", "mathtext.fontset": "dejavusans"})
    figure, panels = pyplot.subplots(1, 2, figsize=(8.6, 3.6), layout="constrained")
    for draw, axes in zip(DRAWINGS[arguments.drawing], panels):
        draw(axes)
    figure.savefig(path, metadata={"Date": None} if path.endswith(".svg") else None)


if __name__ == "__main__":
    main()
