"""The numbers of a result as `bristle export` writes them, with the digits that their errors leave."""

import base64
import gzip
import math

from .. import program
from ..results import axis_names, dataset

ERROR = "_err"
DIGITS, DIGITS_OF_ERROR = 5, 2


def read(executable, path, file):
    """The comments of the exported table, an empty line, and a line for each column: its name and its cells. Compressed, in base64."""
    return packed(by_column(program.export(executable, path), axis_names(dataset(file, "status"))))


def by_column(text, axes):
    """Of a CSV: errors have two digits, values those down to the second digit of their errors, other numbers five, axes all."""
    lines = text.splitlines()
    head = [line for line in lines if line.startswith("#")]
    names, *rows = [line.split(",") for line in lines[len(head):]]
    columns = dict(zip(names, zip(*rows))) if rows else {name: () for name in names}
    return "\n".join([*head, "", *(",".join([name, *cells(name, columns, axes)]) for name in names)])


def cells(name, columns, axes):
    words = columns[name]
    if name in axes:
        return words
    if name.endswith(ERROR):
        return [rounded(word, DIGITS_OF_ERROR) for word in words]
    return [rounded(word, DIGITS, error) for word, error in zip(words, columns.get(name + ERROR, [""] * len(words)))]


def rounded(word, digits, error=""):
    """A number with this many digits, or with those down to the second digit of its error; another word as it is."""
    try:
        value, uncertain = float(word), float(error or "nan")
    except ValueError:
        return word
    if not math.isfinite(value) or value == 0:
        return word
    if uncertain > 0:
        digits = max(1, math.floor(math.log10(abs(value))) - math.floor(math.log10(uncertain)) + 2)
    return f"{value:.{digits}g}"


def packed(text):
    return base64.b64encode(gzip.compress(text.encode(), 6, mtime=0)).decode()
