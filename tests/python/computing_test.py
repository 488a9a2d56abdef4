"""bristle.run: results as Datasets, changes by name, errors of the program as exceptions.

computing_test.py BRISTLE FOLDER
"""
import contextlib
import io
import json
import os
import pathlib
import shutil
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from bristle import BristleError, run  # noqa: E402

bristle, folder = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
os.chdir(folder)
POINT = {"extends": "paper.json", "name": "point", "orientation": {"sampling": "list", "theta_0_deg": [20, 80, 150], "rtol": None}}


def computed(*arguments, **changes):
    """The Dataset, and what was printed."""
    with contextlib.redirect_stderr(io.StringIO()) as printed:
        return run(*arguments, program=bristle, **changes), printed.getvalue()


def refused(*arguments, **changes):
    try:
        computed(*arguments, **changes)
    except BristleError as error:
        return str(error)
    raise AssertionError(f"accepted: {arguments} {changes}")


one, printed = computed(POINT)
assert np.isfinite(one["R_x_norm"]) and "1 ok" in printed, (one, printed)
assert computed(POINT, quiet=True)[1] == ""

# A list is an axis, with words and numbers; a single value takes the place of an axis.
axes, _ = computed(POINT, k_r=np.array([10, 20]), friction=["nss", "coulomb"])
assert axes["R_x_norm"].dims == ("k_r", "friction") and list(axes["friction"].values) == ["nss", "coulomb"]
assert axes["R_x_norm"].sel(k_r=10, friction="nss").item() == one["R_x_norm"].item()
(folder / "swept.json").write_text(json.dumps({**POINT, "sweep": {"k_r": {"logspace": [5, 50, 5]}, "mu_c": {"values": [1, 2]}}}))
swept, _ = computed("swept.json", mu_c=1, k_r=[10, 20])
assert swept["R_x_norm"].dims == ("k_r",) and swept["R_x_norm"].values[0] == one["R_x_norm"]
assert swept.sizes["k_r"] == 2

swept, _ = computed(POINT, k_r=range(10, 21, 10), mu_c=np.array(1), k_theta=np.float64(1))  # an array without dimensions
assert swept["R_x_norm"].dims == ("k_r",) and swept["R_x_norm"].values[0] == one["R_x_norm"]
for wrong, meant in (("K_R", "k_r"), ("k_teta", "k_theta"), ("Friction", "friction")):
    assert f"{wrong} is not a key of an experiment; did you mean {meant}?" in refused(POINT, **{wrong: 1})

# Points of a result in the same folder are not computed again.
kept = folder / "kept.h5"
computed(POINT, output=kept, k_r=[10, 20])
_, printed = computed(POINT, output=kept, k_r=[10, 20, 30])
assert "2 computed before" in printed and kept.exists(), printed

# One that comes with the program, by name; a gap instead of a load; the tier.
gap, _ = computed("paper", z_0=0.5, R_n=None, path=None, orientation=POINT["orientation"])
assert gap["z_0"] == 0.5
tier, _ = computed({**POINT, "sweep": {"k_r": {"values": [5, 10]}}, "tiers": {"smoke": {"sweep": {"k_r": {"take": [1]}}}}}, tier="smoke")
assert tier.sizes["k_r"] == 1

SAMPLE = {**POINT, "sweep": {"sample": {"sobol": 2, "seed": 1, "over": {"k_r": {"uniform": [5, 20]}}}}}
for wanted, call in (("/model/k_r: -1 is not allowed", lambda: refused(POINT, k_r=-1)),
                     ("k_rr is not a key of an experiment; did you mean k_r?", lambda: refused(POINT, k_rr=1)),
                     ("neither the path or name of a file nor a dict", lambda: refused(5)),
                     ("qwertz is not a key of an experiment; known: ", lambda: refused(POINT, qwertz=1)),
                     ("/model/k_r: has no effect, because /sweep/sample/over/k_r varies k_r", lambda: refused(SAMPLE, k_r=3)),
                     ("rtol is a key of orientation and of integrator; write orientation={'rtol': ...}", lambda: refused(POINT, rtol=1)),
                     ("{1} is neither a number, a word, a list nor a dict", lambda: refused(POINT, k_r={1})),
                     ('"none.json" does not exist', lambda: refused("none")),
                     ('"papr.json" does not exist (did you mean paper.json?)', lambda: refused("papr.json")),
                     ("outptu is not a key of an experiment; did you mean output?", lambda: refused(POINT, outptu=1)),
                     ("NaN and infinity are no values of an experiment", lambda: refused(POINT, k_r=float("nan")))):
    assert wanted in call(), (wanted, call())
try:
    run(POINT, program=folder / "none")
    raise AssertionError("a program that does not exist was run")
except BristleError as error:
    assert "none: cannot be run" in str(error), error
