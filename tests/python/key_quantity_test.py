"""A key quantity of the paper under one reading of Eq. (17): its verdicts and its numbers are the reference's.

Arguments: result of the smoke tier, reference, reading, claim, variable.
"""

import json
import sys

import h5py
import numpy as np

path, reference_path, reading, claim, variable = sys.argv[1:]
with open(reference_path, encoding="utf-8") as stream:
    reference = json.load(stream)
file = h5py.File(path)


def texts(name):
    return [text.decode() for text in file["checks"][name][...]]


def grid(rows, shape):
    """Rows of the last axis, which end after their last value, or one number for all points, as an array."""
    if not isinstance(rows, list):
        return np.full(shape, rows)
    return np.array([row + [None] * (shape[-1] - len(row)) for row in rows], float).reshape(shape)


now = [(statement, verdict, measured)
       for name, word, statement, verdict, measured in zip(texts("claim"), texts("reading"), texts("statement"),
                                                           texts("verdict"), file["checks/measured"])
       if (name, word) == (claim, reading)]
before = [(c["statement"], c["verdict"]) for c in reference["claims"] if (c["claim"], c["reading"]) == (claim, reading)]
assert now, f"{path} has no check of claim {claim} under {reading}"
for statement, verdict, measured in now:
    print(f"{claim} ({reading}), {verdict}: {statement}: {measured:.4g}")
assert [check[:2] for check in now] == before, f"the verdicts of the reference are {before}"

shape = [len(values) for values in reference["axes"].values()]
stored = reference["variables"][variable]
values, tolerance = grid(stored["values"], shape), grid(stored["tolerance"], shape)
first = file["bending"].asstr()[...].tolist().index(reading)  # bending is the first axis
deviation = np.abs(file[variable][first] - values[first]) / tolerance[first]
print(f"{variable}: {deviation.size} values, at most {np.nanmax(deviation):.2g} tolerances from the reference")
assert (np.isfinite(values[first]) == np.isfinite(file[variable][first])).all()
assert np.nanmax(deviation) <= 1, f"{variable} deviates from {reference_path}"
