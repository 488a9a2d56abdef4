"""The bristle under the slab: coordinates, gap and forces, for the documents (docs/images/bristle.svg)."""

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


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", dest="path", default="docs/images/bristle.svg", help="file to write (default: %(default)s)")
    path = parser.parse_args().path
    matplotlib.rcParams.update({"font.size": 11, "svg.hashsalt": "bristle", "mathtext.fontset": "dejavusans"})
    figure, panels = pyplot.subplots(1, 2, figsize=(8.6, 3.6), layout="constrained")
    draw_side(panels[0])
    draw_above(panels[1])
    figure.savefig(path, metadata={"Date": None} if path.endswith(".svg") else None)


if __name__ == "__main__":
    main()
