"""Upright contour labels that overlap neither each other nor markers nor the frame, and names of regions.

matplotlib places its labels on the vertices of a line, which on a coarse grid are at the frame.
"""

import numpy as np
from matplotlib import patheffects

from .page import points

FONT_SIZE = 9
MARKER_INCHES = 0.06
HALO = [patheffects.withStroke(linewidth=1.5, foreground="white")]

# Fractions of a line's length at which a label is tried, in this order.
FRACTIONS = (0.5, 0.35, 0.65, 0.2, 0.8)


def label_contours(axes, contours, markers):
    """Labels each line once, where there is room, clear of the markers (rows of x, y)."""
    frame = axes.get_window_extent()
    to_inches = 1 / axes.figure.dpi
    size = np.array([frame.width, frame.height]) * to_inches
    taken = [(place, MARKER_INCHES)
             for place in (axes.transData.transform(markers) - frame.min) * to_inches]
    for level, lines in zip(contours.levels, contours.allsegs):
        room = label_size(f"{level:g}")
        for line in lines:
            path = (axes.transData.transform(line) - frame.min) * to_inches
            place = free_place(path, room, size, taken)
            if place is not None:
                taken.append((place, room))
                axes.text(*place / size, f"{level:g}", transform=axes.transAxes, ha="center",
                          va="center", fontsize=points(FONT_SIZE), path_effects=HALO)


def label_size(string):
    """Width and height in inches, with a margin."""
    return np.array([0.68 * len(string) + 0.4, 1.6]) * points(FONT_SIZE) / 72


def free_place(path, room, size, taken):
    """The first place along the path (inches) where a label of size `room` fits, or None."""
    lengths = np.hypot(*np.diff(path, axis=0).T)
    travelled = np.concatenate([[0], np.cumsum(lengths)])
    if travelled[-1] < room[0]:
        return None
    for fraction in FRACTIONS:
        place = np.array([np.interp(fraction * travelled[-1], travelled, along) for along in path.T])
        inside = (place > room / 2).all() and (place < size - room / 2).all()
        if inside and not any((abs(place - other) < (room + space) / 2).all()
                              for other, space in taken):
            return place
    return None


def label_region(axes, x, y, region, string):
    """Writes a text into a region of a map, where it has most room, upright if it fits so only; nothing without room.

    region: whether each point belongs to it, over y and x.
    """
    frame = axes.get_window_extent()
    size = np.array([frame.width, frame.height]) / axes.figure.dpi
    places = [(line - line[0]) / (line[-1] - line[0]) * inches for line, inches in zip((x, y), size)]
    places = np.stack(np.meshgrid(*places), axis=-1)
    if not region.any():
        return
    others = [(place, 0) for place in places[~region]]
    others += [(size * text.get_position(), label_size(text.get_text())) for text in axes.texts]
    lines = string.split("\n")
    flat = np.array([0.62 * max(map(len, lines)) + 0.5, 1.3 * len(lines)]) * points(10) / 72
    for room, angle in ((flat, 0), (flat[::-1], 90)):
        slack = np.min([np.minimum(places[region], size - places[region]) / room], axis=(0, 2))
        for other, space in others:
            slack = np.minimum(slack, (abs(places[region] - other) / (room + space)).max(axis=1))
        if slack.max() > 0.5:
            axes.text(*places[region][slack.argmax()] / size, string, transform=axes.transAxes, ha="center", va="center",
                      rotation=angle, fontsize=points(10), weight="bold", path_effects=HALO)
            return
