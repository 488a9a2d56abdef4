"""The first screen: the jump of the friction in one sentence, and a table with a column for each model of bending."""

from ..pages.quantities import READINGS, chosen_at, jump_of, percent, short, span
from ..pages.summary import readings_of
from ..plotting.verdicts import FURTHER_SYMBOLS
from ..results import as_text, axis_values
from . import symbols

NAMES = FURTHER_SYMBOLS | {"z_0": r"\tilde{z}_0", "gamma_3": r"\tilde{\gamma}_3", "R_x": "R_x", "F_n": r"\tilde{F}_n"}


def read(found):
    """found: (file, claims) of each result. Without Figure 7 under all three models there are no numbers of the jump."""
    file = next((file for file, _ in found if as_text(file.attrs["name"]) == "fig7"), None)
    if file is None or readings_of(found) != list(READINGS):
        return {"jump": "", "rows": []}
    jumps = {reading: jump_of(file, reading) for reading in READINGS}
    range_of_k_r = [chosen_at(axis_values(file, "k_r")[i]) for i in (0, -1)]
    return {"jump": symbols.prose(sentence(jumps.values()), NAMES),
            "rows": [{"what": symbols.prose(what, NAMES), "cells": {reading: symbols.prose(text(jump), NAMES)
                                                                    for reading, jump in jumps.items()}}
                     for what, text in numbers(*range_of_k_r)]}


def sentence(jumps):
    def of_all(text, name):
        return span([getattr(jump, name) for jump in jumps], text)
    return (f"Stiffer bristles cut the friction by a factor of {of_all(short, 'fall')}, and {of_all(percent, 'share')} of this fall is one jump, "
            f"near k_r = {of_all(chosen_at, 'place')}: the slab rises from one branch of gaps to another, and the load of a bristle becomes "
            "spiky.")


def numbers(low, high):
    """What a row states, and its cell for a model's jump; all are dimensionless."""
    def change(values):
        return " \u2192 ".join(map(short, values))
    return [(f"Friction R_x falls, k_r = {low} to {high}", lambda jump: f"{short(jump.fall)} times"),
            ("The jump is at k_r =", lambda jump: f"{chosen_at(jump.place)}, with {percent(jump.share)} of the fall"),
            ("There the gap z_0 rises", lambda jump: change(jump.gaps)),
            ("the spread of F_n over its mean rises", lambda jump: change(jump.spreads)),
            ("the contact area's factor gamma_3 falls", lambda jump: f"{short(jump.area)} times")]
