"""How a figure is drawn: as the standard figure, plain, or for a paper, where the width of the page decides the layout.

Set by `drawn_on` around a drawing function, as matplotlib's parameters are by rc_context.
"""

import re
from collections import namedtuple
from contextlib import contextmanager
from contextvars import ContextVar
from math import isfinite

import matplotlib

from ..errors import BristleError, did_you_mean
from .style import apply_look

# plain: without title, notes and verdicts; width: of the page of a paper in inches, None for the standard figure; panels:
# the letters of those to draw, empty for all; maps_only: maps without the surfaces above them.
Page = namedtuple("Page", "plain width panels maps_only")
_page = ContextVar("page", default=Page(False, None, (), False))
LETTERS = "abcdefghijklmnopqrstuvwxyz"

LEAST_POINTS, SHRUNK = 7, 0.78  # of letters in a paper; their sizes there over those in the standard figure
NARROWEST, WIDEST = 3, 20  # inches
INCHES = {"in": 1, "cm": 1 / 2.54, "mm": 1 / 25.4}


@contextmanager
def drawn_on(plain=False, width=None, panels=None, maps_only=False, cmap=None, style=None):
    """Figures made within have this page and the look; matplotlib's parameters are afterwards as they were.

    cmap: of maps and surfaces; style: matplotlib's parameters, which replace the look's.
    """
    width = None if width is None else inches(width)
    token = _page.set(Page(plain or width is not None, width, chosen_letters(panels), maps_only))
    try:
        with matplotlib.rc_context():
            apply_look()
            matplotlib.rcParams.update({name: points(matplotlib.rcParams[name]) for name in
                                        ("font.size", "axes.labelsize", "xtick.labelsize", "ytick.labelsize",
                                         "legend.fontsize")})
            if cmap is not None:
                set_parameter("image.cmap", colour_map(cmap))
            for name, value in (style or {}).items():
                set_parameter(name, value)
            yield
    finally:
        _page.reset(token)


def colour_map(cmap):
    """A Colormap, or the name of one of matplotlib's."""
    if isinstance(cmap, str) and cmap not in matplotlib.colormaps:
        raise BristleError(f"no colour map {cmap}{did_you_mean(cmap, matplotlib.colormaps)}")
    return cmap


def set_parameter(name, value):
    """Sets a parameter of matplotlib."""
    if name not in matplotlib.rcParams:
        raise BristleError(f"style: matplotlib has no parameter {name}{did_you_mean(str(name), matplotlib.rcParams)}")
    try:
        matplotlib.rcParams[name] = value
    except (ValueError, TypeError) as error:
        raise BristleError(f"style: {name}: {value!r} is not allowed ({error})") from error


def inches(width):
    """A width with its unit, such as "89mm"; a number is in inches."""
    found = re.fullmatch(r"([\d.]+) *(in|cm|mm)", width.strip()) if isinstance(width, str) else None
    try:
        value = float(found.group(1)) * INCHES[found.group(2)] if found else float(None if isinstance(width, str) else width)
    except (TypeError, ValueError):
        value = float("nan")
    if not (isfinite(value) and NARROWEST - 1e-9 <= value <= WIDEST + 1e-9):
        raise BristleError(f"width {width}: a width is a number with its unit, in, cm or mm, from {NARROWEST}in to "
                           f"{WIDEST}in; for example 3.5in or 89mm")
    return value


def chosen_letters(panels):
    """The letters in "a,d", or in a list of letters."""
    letters = tuple(dict.fromkeys(panels.split(",") if isinstance(panels, str) else panels or ()))
    if wrong := [letter for letter in letters if len(letter) != 1 or letter not in LETTERS]:
        raise BristleError(f"panels {panels}: {wrong[0] or 'nothing'} is no letter of a panel; write for example a,d")
    return letters


def lettered(items):
    """(letter, item) of each panel to draw: of all items, or of those that the page has chosen.

    The letters of chosen panels are counted anew. A panel alone has no letter.
    """
    items, chosen = list(items), _page.get().panels
    if beyond := [letter for letter in chosen if letter not in LETTERS[:len(items)]]:
        there = f"the panels {LETTERS[0]} to {LETTERS[len(items) - 1]}" if len(items) > 1 else "one panel only, without a letter"
        raise BristleError(f"panels {','.join(chosen)}: there is no panel {beyond[0]}; this figure has {there}")
    items = [item for letter, item in zip(LETTERS, items) if not chosen or letter in chosen]
    return list(zip(LETTERS if len(items) > 1 else [""], items))


def maps_only():
    return _page.get().maps_only


def is_plain():
    return _page.get().plain


def paper_width():
    """Width of the paper's page in inches; None for the standard figure."""
    return _page.get().width


def points(standard):
    """The size of letters that have this size in the standard figure."""
    return standard if paper_width() is None else max(LEAST_POINTS, SHRUNK * standard)
