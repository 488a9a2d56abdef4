"""The numbers of a result as the CSV files of `bristle export`: one for its points, one for each recorded table that a
figure draws."""

import base64
import gzip
import re

from .. import program
from ..results import as_text, table

RECORDED = ["trajectories", "slab_force"]


def read(executable, path, file, recorded):
    """For each table: the name of its file, and the gzip file in base64; recorded: names of the recorded ones."""
    name = as_text(file.attrs["name"])
    found = [(f"{name}.csv", program.export(executable, path))]
    found += [(f"{name}-{group}.csv", shortened(program.export(executable, path, "--group", group)))
              for group in recorded if table(file, group) is not None]
    return [{"name": name, "gzip": packed(text)} for name, text in found]


def shortened(text):
    """Recorded tables are long: seven digits of each number."""
    return re.sub(r"-?\d+\.\d+(e[-+]?\d+)?", lambda found: f"{float(found[0]):.7g}", text)


def packed(text):
    return base64.b64encode(gzip.compress(text.encode(), 9, mtime=0)).decode()
