"""A plotting script writes PDF and PNG with the same bytes each time, a PNG for each page, and explains why it cannot use a file.

figure_test.py SCRIPT RESULT FOLDER DATASET: a dataset that the script needs, such as trajectories/V_R.
"""
import hashlib
import importlib
import pathlib
import re
import shutil
import subprocess
import sys

import h5py
import numpy

script, result, folder, needed = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]), sys.argv[4]
shutil.rmtree(folder, ignore_errors=True)


def plot(source, target):
    return subprocess.run([sys.executable, script, str(source), "-o", str(target)], capture_output=True, text=True)


sys.path.insert(0, str(pathlib.Path(script).parent))
from bristle_plots import BristleError, apply_look, open_result  # noqa: E402
from bristle_plots.integrity import read_group  # noqa: E402

digests = []
for run in ("first", "second"):
    done = plot(result, folder / run)
    assert done.returncode == 0, done.stderr
    made = sorted((folder / run).iterdir())
    name = pathlib.Path(script).stem
    assert {f"{name}.pdf", f"{name}.png"} <= {p.name for p in made}, made
    assert {p.suffix for p in made} == {".pdf", ".png"}, made
    for pdf in folder.glob(f"{run}/*.pdf"):
        pngs = [pdf.with_suffix(".png"), pdf.with_name(f"{pdf.stem}-as-printed.png")]
        pages = re.search(rb"/Count (\d+)", pdf.read_bytes()).group(1)
        assert int(pages) == sum(p in made for p in pngs), pdf
    assert all(p.stat().st_size > 15_000 for p in made)
    digests.append([hashlib.sha256(p.read_bytes()).hexdigest() for p in made])
assert digests[0] == digests[1], "two runs gave different bytes"

assert plot(folder / "none.h5", folder).returncode == 2
(folder / "text.h5").write_text("not HDF5")
assert plot(folder / "text.h5", folder).returncode == 2
shutil.copy(result, folder / "lacking.h5")
with h5py.File(folder / "lacking.h5", "a") as f:
    del f[needed]
    digest = hashlib.sha256()
    read_group(f, "", 0, digest)
    f.attrs["payload_sha256"] = numpy.bytes_(digest.hexdigest())  # lacking, but not damaged
lacking = plot(folder / "lacking.h5", folder)
assert lacking.returncode == 2 and needed in lacking.stderr, lacking.stderr
assert "Traceback" not in lacking.stderr
shutil.copy(result, folder / "old.h5")
with h5py.File(folder / "old.h5", "a") as f:
    f.attrs["schema_version"] = "bristle-result/0"
old = plot(folder / "old.h5", folder)
assert old.returncode == 2 and "bristle-result/0" in old.stderr, old.stderr


# Use in a notebook: draw() returns a figure, and errors are exceptions.
figure = importlib.import_module(pathlib.Path(script).stem)
apply_look()
with open_result(result) as file:
    assert figure.draw(file).axes
try:
    with open_result(folder / "lacking.h5") as file:
        figure.draw(file)
except BristleError as error:
    assert needed in str(error), error
else:
    raise AssertionError("a missing dataset caused no error")
