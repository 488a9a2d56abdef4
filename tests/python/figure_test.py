"""A figure's command writes PDF and PNG with the same bytes each time, a PNG for each page, and explains why it cannot use a file.

figure_test.py SCRIPTS FIGURE RESULT FOLDER DATASET: a dataset that the figure needs, such as trajectories/V_R.
"""
import hashlib
import pathlib
import re
import shutil
import subprocess
import sys

import h5py
import matplotlib
import numpy
import xarray

scripts, name, result, folder, needed = pathlib.Path(sys.argv[1]), *sys.argv[2:4], pathlib.Path(sys.argv[4]), sys.argv[5]
shutil.rmtree(folder, ignore_errors=True)


def plot(source, target):
    return subprocess.run([scripts / "plot", name, str(source), "-o", str(target)], capture_output=True, text=True)


sys.path.insert(0, str(scripts))
import bristle_plots  # noqa: E402
from bristle_plots import BristleError, open_result  # noqa: E402
from bristle_plots.integrity import read_group  # noqa: E402

digests = []
for run in ("first", "second"):
    done = plot(result, folder / run)
    assert done.returncode == 0, done.stderr
    made = sorted((folder / run).iterdir())
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
    for dimension in f[needed].dims:
        dimension.detach_scale(dimension[0])  # the scale would refer to what is no longer there
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


# In a notebook, draw() returns a figure, also of a Dataset that is not from a file; errors are exceptions.
figure = getattr(bristle_plots, name)


def texts(ds):
    drawn = figure.draw(ds)
    assert isinstance(drawn, matplotlib.figure.Figure)
    return [text.get_text() for text in drawn.findobj(matplotlib.text.Text)]


before = dict(matplotlib.rcParams)
with open_result(result) as ds:
    expected = texts(ds)
with xarray.open_dataset(result) as ds:
    ds.encoding = {}  # as of a Dataset that was not opened from a file
    if "/" in needed:
        try:
            figure.draw(ds)
        except BristleError as error:
            assert "open_result" in str(error), error
        else:
            raise AssertionError("a missing table caused no error")
    else:
        assert set(texts(ds)) <= set(expected)
assert dict(matplotlib.rcParams) == before, "drawing changed matplotlib's parameters"
try:
    with open_result(folder / "lacking.h5") as ds:
        figure.draw(ds)
except BristleError as error:
    assert needed in str(error), error
else:
    raise AssertionError("a missing dataset caused no error")
