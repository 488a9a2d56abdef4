"""What was drawn for a page before, kept in files so that a page draws anew only what changed."""

import contextlib
import os
import pickle

from ..errors import BristleError
from ..files import write_whole

FIRST_LINE = b"bristle report part\n"


def remembered(folder, name, origin, make):
    """Returns what make() returned for the same origin before, from a file of this name in the folder; else make()'s result, kept there.

    origin: a text that changes with everything on which the result depends. A damaged file is written anew; where no file can be
    written, nothing is kept.
    """
    path = os.path.join(folder, f"{name}.pickle")
    with contextlib.suppress(Exception):  # whatever is wrong with the file
        with open(path, "rb") as file:
            if file.readline() == FIRST_LINE and pickle.load(file) == origin:
                return pickle.load(file)
    made = make()
    with contextlib.suppress(BristleError):
        write_whole(path, FIRST_LINE + pickle.dumps(origin) + pickle.dumps(made))
    return made
