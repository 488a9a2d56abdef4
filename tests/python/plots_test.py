"""Plotting scripts refuse damaged results, replace nothing but what they write.

plots_test.py RESULT FOLDER
"""
import hashlib
import inspect
import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys

import h5py
import matplotlib.figure
import matplotlib.image
import matplotlib.text
import numpy
import xarray
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PolyCollection
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from in_process import PACKAGE, SOURCE, called
from bristle import BristleError, draw, open_result
from bristle.figures import curve, fig4, law, ski
from bristle.figures import map as map_figure
from bristle.files import read_json, write_text, write_whole
from bristle.integrity import read_group
from bristle.plotting import captions
from bristle.plotting.curves import jump_note, read_curve
from bristle.plotting.jumps import jumps_between_neighbours, located_jumps, read_jumps
from bristle.plotting.maps import Grid, cells_at, draw_jumps, read_grid, torn_faces
from bristle.plotting.readings import pages
from bristle.plotting.style import displayed, unit_text
from bristle.plotting.verdicts import by_check, by_claim, declared_checks, draw_strip, in_symbols, read_claims, symbols

result, folder = sys.argv[1], pathlib.Path(sys.argv[2])
fig4.VARIABLES = fig4.VARIABLES[:2]  # two maps show what is tested here; figures_test.py draws all
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)


def refusal(action, *arguments):
    try:
        action(*arguments)
    except BristleError as error:
        return str(error)
    raise AssertionError(f"{arguments} caused no error")


def refusal_after(change):
    """What is said of the result after a change."""
    shutil.copy(result, folder / "changed.h5")
    with h5py.File(folder / "changed.h5", "a") as file:
        change(file)
    return refusal(open_result, folder / "changed.h5")


def change_number(file):
    file["z_0"][0, 0] += 1e-9


# Damaged results, and files that HDF5 would read without end or beyond themselves.
open_result(result).close()
assert "payload_sha256 does not match" in refusal_after(change_number)
assert "experiment_sha256" in refusal_after(lambda file: file.attrs.modify("experiment", numpy.bytes_("{}")))
assert "nested too deeply" in refusal_after(lambda file: file.__setitem__("loop", file["/"]))
assert "link" in refusal_after(lambda file: file.__setitem__("elsewhere", h5py.ExternalLink("/etc/passwd", "/x")))
assert "damaged" in refusal_after(lambda file: file.create_dataset("large", (1 << 40,), "f8"))
assert "damaged" in refusal_after(lambda file: file.create_dataset(
    "bomb", (1 << 33,), "i1", chunks=(1 << 24,), compression="gzip"))
os.mkfifo(folder / "pipe")
assert "pipe" in refusal(open_result, folder / "pipe")
assert "not a regular file" in refusal(read_json, folder / "pipe", "")

# A file of another kind at the output, or a link, is not replaced.
pdf = b"%PDF-1.4\nnew"
for name, mine in (("a.pdf", b"my notes\n"), ("b.pdf", pathlib.Path(result).read_bytes())):
    (folder / name).write_bytes(mine)
    assert "would be replaced" in refusal(write_whole, folder / name, pdf)
    assert (folder / name).read_bytes() == mine
(folder / "experiment.json").write_text('{"extends": "paper.json"}')
assert "would be replaced" in refusal(write_text, folder / "experiment.json", "# Findings\n")
(folder / "old.pdf").write_bytes(b"%PDF-1.4\nold")
(folder / "link.pdf").symlink_to(folder / "old.pdf")
for name in ("link.pdf", "pipe"):
    assert "not a regular file" in refusal(write_whole, folder / name, pdf)
write_whole(folder / "old.pdf", pdf)
write_whole(folder / "new/new.pdf", pdf)
(folder / "empty.pdf").touch()
write_whole(folder / "empty.pdf", pdf)
assert all((folder / name).read_bytes() == pdf for name in ("old.pdf", "new/new.pdf", "empty.pdf"))
assert not list(folder.rglob("*.part"))

# The command line: the result as its own output.
before = pathlib.Path(result).read_bytes()
done = subprocess.run([SOURCE / "scripts/plot", "curve", result, "-o", result, "--dpi", "30"], capture_output=True, text=True)
assert done.returncode != 0 and "Traceback" not in done.stderr, done.stderr
assert pathlib.Path(result).read_bytes() == before
# Nobody can read which files were written: they are there all the same.
with open("/dev/full", "w", encoding="utf-8") as full:
    done = subprocess.run([SOURCE / "scripts/plot", "curve", result, "-o", folder / "unread", "--dpi", "30"], stdout=full,
                          stderr=subprocess.PIPE, text=True)
assert done.returncode == 3 and "error: standard output: cannot be written (No space left" in done.stderr, done.stderr
assert "Traceback" not in done.stderr and len(list((folder / "unread").iterdir())) == 2, done.stderr

# The friction laws over the speed, of the result's experiment and of one with its own law.
own = {"V_R": [0, 0.01, 0.1, 1], "mu": [0, 1.2, 0.8, 0.7], "between": "linear"}
with open_result(result) as file:
    document = json.loads(file.attrs["experiment"])
    axes, = law.draw(file).axes
    assert abs(axes.lines[0].get_ydata()[-1] - 1) < 1e-3 and len(axes.lines) == 1  # chi, far above V_s
    document["model"]["friction"], document["friction_law"] = "custom", own
    axes, = law.draw(file.assign_attrs(experiment=json.dumps(document))).axes
    mu, points = (line.get_xydata() for line in axes.lines)
    assert points.tolist() == [[0.01, 1.2], [0.1, 0.8], [1, 0.7]] and abs(mu[-1, 1] - 0.7) < 1e-12
    assert numpy.allclose(numpy.interp(points[:, 0], *mu.T), points[:, 1], atol=0.02)
    # Speeds in m/s, in a sweep over the velocity: the law is over m/s, too.
    for key in ("checks", "checks_for_each", "locate_jumps"):
        document.pop(key, None)
    si = {"m_kg": 1e-4, "r0_m": 0.017, "V0_m_per_s": 10}
    document |= {"si": si, "sweep": {"V0_m_per_s": {"values": [3, 30]}},
                 "friction_law": {"V_R_m_per_s": own["V_R"], "mu": own["mu"], "between": "linear"}}
    axes, = law.draw(file.assign_attrs(experiment=json.dumps(document))).axes
    mu, points = (line.get_xydata() for line in axes.lines)
    assert points.tolist() == [[0.01, 1.2], [0.1, 0.8], [1, 0.7]] and "m/s" in axes.get_xlabel()
    assert numpy.allclose(numpy.interp(points[:, 0], *mu.T), points[:, 1], atol=0.02)

# Verdicts with each model of bending.
with open_result(result) as file:
    claims, pairs = read_claims(file), declared_checks(file)
    assert all(set(check) == {"polar", "polar_as_printed", "rod"} for check in by_check(claims))
    assert all(check["statement"] == claim.statement for check, claim in pairs) and len(pairs) == len(claims)
    for checks in by_claim(claims):
        roles = [check["polar"].role for check in checks]
        assert roles == sorted(roles, key=lambda role: role != "main")

# Their texts neither touch each other nor leave the figure, with the numbers beside the statement or below it.
for width in (7, 11, 15):
    figure = matplotlib.figure.Figure((width, 8))
    draw_strip(figure, claims)
    renderer = FigureCanvasAgg(figure).get_renderer()
    lines = {}
    for text in filter(matplotlib.text.Text.get_text, figure.axes[0].texts):
        lines.setdefault(text.get_position()[1], []).append(text.get_window_extent(renderer))
    for boxes in lines.values():
        ends = [0, *(end for box in sorted(boxes, key=lambda box: box.x0) for end in (box.x0, box.x1)), renderer.width]
        assert len(lines) > 10 and ends == sorted(ends), (width, ends)

# Jumps of the gap between neighbours, but not on a grid that is too coarse to tell them from a slope.
gaps = numpy.array([[0.1, 0.6, 0.61], [0.1, numpy.nan, 0.6]])
assert jumps_between_neighbours(gaps, [1, 1.1, 1.2], 1).tolist() == [[True, False], [False, False]]
assert not jumps_between_neighbours(gaps, [1, 2, 4], 1).any()

# A line is broken between contact and bouncing at any step, but not where it passes through `mixed`, nor without phases.
with open_result(result) as file:
    words, along = file["phase"].attrs["flag_meanings"].split(), file.sizes["k_r"]
    assert along >= 4 and file["phase"].attrs["flag_values"].tolist() == list(range(len(words)))
    sides = [words.index(word) for word in ["contact", "bouncing", *["mixed"] * (along - 3), "contact"]]
    rows = numpy.empty(file["phase"].shape, dtype=int)
    numpy.moveaxis(rows, file["phase"].dims.index("k_r"), -1)[...] = sides
    file = file.assign(phase=file["phase"].copy(data=rows)).isel(k_theta=[0]).sel(bending="polar", drop=True)
    file["R_x_norm"][...] = 0.5
    broken_at = read_curve(file, "R_x_norm", "k_r").jumps
    assert numpy.flatnonzero(broken_at).tolist() == [0], broken_at
    line = curve.draw(file).axes[0].lines[0]
    assert numpy.isnan(line.get_ydata()).tolist() == [False, True, *[False] * (along - 1)], line.get_ydata()
    assert "between contact and bouncing" in jump_note(file, "k_r")
    file = file.drop_vars("phase")
    assert not read_curve(file, "R_x_norm", "k_r").jumps.any() and jump_note(file, "k_r") == ""

# A surface has no face with a jump along an edge.
jumps = [numpy.array([[True, False, False]]), numpy.array([[False, False], [False, True]])]
assert torn_faces(Grid(*[None] * 6, jumps, None)).tolist() == [[True, True]]

# Jumps that the run located break the lines and faces, also those of a part of the result, and are drawn at their places.
shutil.copy(result, folder / "jumps.h5")
with h5py.File(folder / "jumps.h5", "a") as file:
    k_r = file["k_r"][()]
    shape = file["status"].shape  # bending, k_r, k_theta
    at = numpy.ravel_multi_index([[0, 0, 1], [1, 2, 1], [0, 2, 1]], shape)
    group = file.create_group("jumps")
    group.attrs["along"] = numpy.bytes_("k_r")
    columns = {"point": at, "before": [1.2 * k_r[1], 1.1 * k_r[2], 1.2 * k_r[1]],
               "after": [1.21 * k_r[1], 1.11 * k_r[2], 1.21 * k_r[1]], "from": [1.1 * k_r[1], 1.1 * k_r[2], 1.2 * k_r[1]], "to": [1.25 * k_r[1], 1.11 * k_r[2], 1.21 * k_r[1]],
               "z_0_before": [0.1, 0.1, 0.1],
               "z_0_after": [0.6, numpy.nan, 0.6], "jump": [0, 1, 2]}
    for name, column in columns.items():
        group[name] = column
    group["jump"].make_scale("jump")
    for name in columns:
        if name != "jump":
            group[name].dims[0].attach_scale(group["jump"])
    digest = hashlib.sha256()
    read_group(file, "", 0, digest)
    file.attrs["payload_sha256"] = numpy.bytes_(digest.hexdigest())
with open_result(folder / "jumps.h5") as file:
    found = located_jumps(file, ["k_theta", "k_r"], bending="polar")
    assert [jump.index for jump in found] == [(0, 1)]  # the second has no gap on one side, the third another reading
    assert abs(found[0].place / k_r[1] - 1.205) < 1e-3
    assert numpy.allclose([found[0].start / k_r[1], found[0].end / k_r[1]], [1.1, 1.25])
    along_y, along_x = read_jumps(file, ["k_theta", "k_r"], bending="polar")
    assert numpy.argwhere(along_x).tolist() == [[0, 1]]
    part = file.isel(k_r=[0, 2, 3], k_theta=[0, 1])
    assert located_jumps(part, ["k_theta", "k_r"], bending="polar")[0][0] == (0, 0)
    grid = read_grid(file, "k_r", "k_theta", {"bending": "polar"})
    axes = matplotlib.figure.Figure().add_subplot()
    assert ["located to 1 %" in text for text in draw_jumps(axes, grid)] == [True, False]  # the line and the band
    (line,) = axes.lines
    assert numpy.allclose(line.get_xdata()[:2], numpy.log10(found[0][1]))
    rim = line.get_path_effects()[0]._gc  # in grey, only a rim tells the line from the map
    assert rim["foreground"] == "white" and rim["linewidth"] > line.get_linewidth()
    (left, right) = cells_at(grid, [(0, 1), (0, 2)])  # cells end at the located jump between them
    assert numpy.allclose([left[2], right[0]], numpy.log10(found[0][1])), (left, right)
    assert cells_at(grid, [(1, 1)])[0][2] == (grid.x[1] + grid.x[2]) / 2


# In a notebook: a part of a result is drawn, without the verdicts, which are about the whole; choices by word or by code.
def texts(figure):
    return [text.get_text() for text in figure.findobj(matplotlib.text.Text)]


def has_verdicts(figure):
    return "statement" in texts(figure)


def grey_ones(figure):
    """What the colour map colours."""
    figure.draw(FigureCanvasAgg(figure).get_renderer())
    return [artist for axes in figure.axes if axes.get_label() != "<colorbar>" for artist in axes.collections
            if isinstance(artist, (Poly3DCollection, PolyCollection))]


with xarray.open_dataset(result) as ds:
    assert has_verdicts(fig4.draw(ds))
    floats = ds["status"].astype(float).assign_attrs(ds["status"].attrs)  # as xarray decodes with a _FillValue
    expected = texts(fig4.draw(ds))
    assert texts(fig4.draw(ds.assign(status=floats))) == expected
    for engine in ("netcdf4", "h5netcdf"):
        with xarray.open_dataset(result, engine=engine) as same:
            assert texts(fig4.draw(same)) == expected, engine
    printed = [ds.sel(bending="polar_as_printed"), ds.isel(bending=[1]).transpose("k_theta", ...)]
    drawn = [texts(fig4.draw(part, plain=True)) for part in printed]
    assert drawn[0] == drawn[1] == texts(pages(fig4.draw, open_result(result), plain=True)[1][2])
    assert not any(has_verdicts(fig4.draw(part)) for part in printed)
    assert "k_theta" in refusal(fig4.draw, ds.isel(k_theta=0)) and "at least 2 values" in refusal(fig4.draw, ds.isel(k_theta=0))
    assert "axis 'k_r' has no values" in refusal(fig4.draw, ds.sel(k_r=slice(200, 300)))
    assert "gamma_1" in refusal(fig4.draw, ds.drop_vars("gamma_1"))
    assert "DataArray" in refusal(fig4.draw, ds["R_x"])
    assert "schema version none" in refusal(fig4.draw, ds.assign_attrs(schema_version=""))
    # A reading by its word; the options of the look.
    assert texts(fig4.draw(ds, reading="polar_as_printed")) == texts(fig4.draw(ds, reading={"bending": "polar_as_printed"}))
    assert "no reading 'printed'" in (said := refusal(lambda: fig4.draw(ds, reading="printed"))) and "polar_as_printed" in said
    assert list(inspect.signature(fig4.draw).parameters) == ["file", "reading", "plain", "width", "panels", "maps_only", "cmap", "style"]
    assert "Fig. 4" in fig4.draw.__doc__ and "cmap" in fig4.draw.__doc__ and "energy budget" in fig4.draw_energy.__doc__
    assert "did you mean viridis?" in refusal(lambda: fig4.draw(ds, cmap="virids"))
    assert "did you mean axes.linewidth?" in refusal(lambda: fig4.draw(ds, style={"axes.linewidht": 1}))
    assert "is not allowed" in refusal(lambda: fig4.draw(ds, style={"axes.linewidth": "wide"}))
    thick = fig4.draw(ds, style={"axes.linewidth": 3})
    assert {3} == {axes.spines["left"].get_linewidth() for axes in thick.axes if axes.name == "rectilinear"}
    grey = [numpy.atleast_2d(collection.get_facecolor()) for collection in grey_ones(fig4.draw(ds, cmap="gray"))]
    assert len(grey) == 4 and all((numpy.ptp(colours[:, :3], axis=1) < 1e-9).all() for colours in grey)

    # Maps have the sweep's range, without a margin.
    for drawn in (fig4.draw(ds), fig4.draw_energy(ds)):
        (least, *_), (most, *_) = zip(*(axes.get_xlim() for axes in drawn.axes if axes.get_xlabel() and axes.name != "3d"))
        assert (least, most) == tuple(numpy.log10(ds.k_r.values[[0, -1]])), (least, most)

    # A copy by another program: its digest does not hold, but the Dataset is drawn, without verdicts.
    ds.to_netcdf(folder / "copy.nc")
    assert "written by another program" in (said := refusal(open_result, folder / "copy.nc")) and "copy.nc')" in said, said
    with xarray.open_dataset(folder / "copy.nc") as copy:
        assert not has_verdicts(drawn := fig4.draw(copy)) and len(texts(drawn)) > 50

    # A figure by its name, or that of the result's experiment; wrong names of figures, options and variables.
    assert texts(draw(ds)) == expected and texts(draw(ds, "fig4", plain=True)) == texts(fig4.draw(ds, plain=True))
    assert texts(draw(ds.assign_attrs(name="mine"))) == texts(curve.draw(ds))
    assert "the result comes first" in refusal(draw, "fig4", ds)
    assert "there is no figure fg4; did you mean fig4?; known: bouncing, " in refusal(draw, ds, "fg4")
    assert "widht is not an option of this figure; did you mean width?; known: reading, " in refusal(lambda: draw(ds, widht=3))
    assert "there is no variable gama_1; did you mean gamma_1?" in refusal(lambda: draw(ds, "curve", y="gama_1"))
    assert "no reading 'polr'; did you mean polar?; it has: " in refusal(lambda: draw(ds, reading="polr"))
    assert "not from a str" in refusal(draw, result)

    # A result without the axes that a figure needs.
    assert "figure ski needs the axes friction, R_n_N, V0_m_per_s; this result has bending, k_r" in refusal(ski.draw, ds)
    table = symbols(ds)
assert in_symbols("R_x_norm falls as k_r grows", table) == "$\u0158_x$" r" falls as $\tilde{k}_r$ grows"
assert in_symbols("R_n(z_0), N_c/N_c0", table) == r"$\tilde{R}_n$($\tilde{z}_0$), $N_c$/$N_{c,0}$"

# Options of the command line.
def plot(*options):
    return called("bristle", "fig4", result, "-o", folder / "paper", *options)


done = plot("--width", "89mm", "--format", "svg,png", "--dpi", "100")
assert done.code == 0, done.messages
made = {path.name for path in (folder / "paper").iterdir()}
assert made == {f"fig4{ending}.{kind}" for ending in ("", "-polar-as-printed", "-rod", "-energy-polar-as-printed") for kind in ("svg", "png")}, made
pixels = matplotlib.image.imread(folder / "paper/fig4.png").shape[1]
assert pixels == int(100 * 8.9 / 2.54), pixels
svg = (folder / "paper/fig4.svg").read_text(encoding="utf-8")
assert "<image" not in svg and f'width="{72 * 8.9 / 2.54:.6f}'.rstrip("0") in svg, svg[:500]
for options, words in ((["--width", "3"], "a number with its unit"), (["--width", "-1in"], "from 3in to 20in"),
                       (["--width", "2in"], "from 3in to 20in"), (["--width", "nanin"], "a number with its unit"),
                       (["--dpi", "0"], "from 30 to 2400"), (["--dpi", "-1"], "from 30 to 2400"), (["--dpi", "1e3"], "from 30 to 2400"),
                       (["--format", "jpg"], "allowed are pdf, png, svg")):
    done = plot(*options)
    assert done.code == 2 and words in done.messages and options[-1] in done.messages, done.messages
done = called("bristle", "fig4", result, "-o", folder / "one", "--reading", "rod", "--format", "png", "--dpi", "60", "--width", "7in")
assert done.code == 0 and {path.name for path in (folder / "one").iterdir()} == {"fig4.png", "fig4-energy.png"}, done.messages
done = plot("--caption", "--reading", "rod")
assert done.out.count("\\caption{") == 2 and "Model of bending: rod." in done.out and "as printed" not in done.out, done.out
done = plot("--reading", "rodd")
assert done.code == 2 and "no reading 'rodd'; did you mean rod?; it has: polar, polar_as_printed, rod" in done.messages, done.messages
done = plot("--y", "gamma_1")
assert done.code == 2 and "only the figures curve and map" in done.messages, done.messages
with xarray.open_dataset(result) as ds:
    drawn = curve.draw(ds, "gamma_1")
    assert len(drawn.axes) == 3 and r"$\tilde{\gamma}_1$" in texts(drawn), texts(drawn)
    line = drawn.axes[0].lines[0].get_ydata()
    assert numpy.array_equal(line[numpy.isfinite(line)][:1], ds["gamma_1"].values[0, :1, 0])
    assert "there is no variable gamma_9" in refusal(lambda: curve.draw(ds, "gamma_9"))
    assert "a curve needs" in refusal(lambda: curve.draw(ds, "status"))
# Several results in one picture.
shutil.copy(result, folder / "other.h5")
with h5py.File(folder / "other.h5", "a") as file:
    file["gamma_1"][...] *= 0.5
    digest = hashlib.sha256()
    read_group(file, "", 0, digest)
    file.attrs["payload_sha256"] = numpy.bytes_(digest.hexdigest())
with open_result(result) as one, open_result(folder / "other.h5") as other:
    both = curve.overlaid([one.isel(k_theta=[0]), other.isel(k_theta=[0])], ["Coulomb", "NSS"], "gamma_1")
    drawn = curve.draw(both, "gamma_1")
    assert {"Coulomb", "NSS"} <= {word for text in texts(drawn) for word in text.split(", ")}, texts(drawn)
    first, second = (line.get_ydata()[:1] for line in drawn.axes[0].lines[:2])
    assert numpy.allclose(second, 0.5 * first) and first[0] == one["gamma_1"].values[0, 0, 0], (first, second)
    assert "axis k_r has other values than" in refusal(lambda: curve.overlaid([one, other.isel(k_r=[0, 1])], ["a", "b"], "gamma_1"))
    assert "one picture needs results over the same axes" in refusal(lambda: curve.overlaid([one, other.isel(k_r=0, drop=True)], ["a", "b"], "gamma_1"))
two = [result, folder / "other.h5"]
done = called("bristle", "curve", *two, "--labels", "Coulomb,NSS", "--y", "gamma_1", "-o", folder / "two", "--dpi", "60")
assert done.code == 0 and {path.name for path in (folder / "two").iterdir()} == {
    f"{pathlib.Path(result).stem}-other-curve-gamma_1.{kind}" for kind in ("pdf", "png")}, done.messages
for figure, options, words in (("curve", ["--labels", "a"], "--labels a: 1 labels for 2 results"), ("curve", ["--labels", "a,a"], "a,a are not different"),
                               ("map", [], "map is a picture of one result"), ("fig4", [], "fig4 is a picture of one result"),
                               ("curve", ["--caption"], "--caption is about one result")):
    done = called("bristle", figure, *two, *options)
    assert done.code == 2 and words in done.messages, done.messages
done = plot("--animate")
assert done.code == 2 and "--animate: only fig2 and bristles have recorded trajectories, not fig4" in done.messages, done.messages
for options, words in ((["--panels", "z"], "there is no panel z; this figure has the panels a to b"), (["--panels", "A"], "no letter")):
    done = plot(*options)
    assert done.code == 2 and words in done.messages, done.messages
with xarray.open_dataset(result) as ds:
    (second,) = [axes.panel for axes in fig4.draw(ds, panels="b").axes if hasattr(axes, "panel")]
    assert second[0] == "" and "gamma" in second[1][0], second
    assert not any(axes.name == "3d" for axes in fig4.draw(ds, maps_only=True).axes)
    assert "no surfaces" in refusal(lambda: curve.draw(ds, maps_only=True))
    assert len([axes for axes in map_figure.draw(ds, "gamma_1").axes if hasattr(axes, "panel")]) == ds.sizes["bending"]
done = plot("--caption")
assert done.code == 0 and done.out.count("\\caption{") == 4 and done.out.count("{") == done.out.count("}"), done.out
corrected, printed = done.out.split("% page 2")
assert r"$\check{R}_x$; (b) " in corrected and r"$\tilde{k}_r =$ 5, " in corrected and "corrected" in corrected and "as printed" not in corrected
assert "as printed" in printed and "corrected" not in printed
done = plot("--caption", "--panels", "b")
assert done.code == 0 and done.out.count("\\caption{") == 3 and r"\tilde{\gamma}_1$. Plotted over" in done.out and "check{R}" not in done.out, done.out
done = called("bristle", "map", result, "--caption", "--panels", "b")
assert done.code == 0 and r"$\check{R}_x$, as printed. Plotted over" in done.out and "corrected" not in done.out, done.out
assert "Contact: exponential wall, Eq. (3). " in corrected and "two gaps carry this load (" in corrected, corrected
with xarray.open_dataset(result) as ds:
    assert "two gaps carry this load" in texts(fig4.draw(ds, "polar_as_printed")) + texts(fig4.draw(ds))
    # A result of one model names it; a caption does not say the variable twice, nor explain breaks where nothing jumps.
    alone = ds.sel(bending="rod", drop=True).isel(k_theta=[1])
    said = captions.captions(curve, alone, "gamma_1")[0]
    assert said.count("odulation of friction by the sliding speed") == 1 and "Model of bending: corrected. " in said, said
    assert jump_note(alone.drop_vars("phase"), "k_r") == ""  # the grid is coarse
    finer = 5 * 1.1 ** numpy.arange(alone.sizes["k_r"])
    gaps = numpy.where(finer > 6, 0.6, 0.1)
    jumping = alone.assign_coords(k_r=("k_r", finer, alone["k_r"].attrs))
    jumping = jumping.assign(z_0=jumping["z_0"].copy(data=numpy.resize(gaps, alone["z_0"].shape[::-1]).T))
    jumping.encoding = {}  # without the jumps that the run located
    assert "Lines are broken between contact and bouncing, and where" in jump_note(jumping.drop_vars("phase"), "k_r")
    # Units that a reader of figures expects.
    power = ds["gamma_1"].copy(data=2.5e6 + 0 * ds["gamma_1"].values).assign_attrs(units="W m-2", symbol="P")
    drawn = curve.draw(ds.assign(gamma_1=power, gamma_1_err=power), "gamma_1")
    assert "$P$ [MW/m$^2$]" in texts(drawn) and drawn.axes[0].lines[0].get_ydata()[0] == 2.5, texts(drawn)
    assert unit_text("m s-1") == "m/s" and unit_text("m-2") == "m$^{-2}$" and unit_text("J m-1") == "J/m"
    (length,) = displayed(xarray.DataArray([0.0015], attrs={"units": "m"})).values
    assert abs(length - 1.5) < 1e-12
told = captions.in_latex(captions.plain(r"50 % of \input{x} & $ # x_y"))  # a stranger's title
assert told == r"50 \% of \textbackslash{}input\{x\} \& \$ \# x\_y", told
told = captions.in_latex(captions.plain("a\x1b[2J\u2028b\nc"))  # control characters reach neither LaTeX nor a terminal
assert told == r"a\textbackslash{}x1b[2J b c", told
told = [captions.in_latex(captions.with_symbols(text)) for text in (r"$\tilde{k}_r = 2$, 3 %", r"5 $, $\input{x}$")]
assert told[0] == r"$\tilde{k}_r = 2$, 3 \%" and told[1].startswith(r"5 \$, \$\textbackslash{}input"), told
assert captions.latex_symbol(r"\tilde{k}_r") == r"$\tilde{k}_r$" and "$" not in captions.latex_symbol(r"\input{x}")
assert "width 3: " in refusal(lambda: fig4.draw(open_result(result), width="3"))

# Few file descriptors are no damage.
limits = resource.getrlimit(resource.RLIMIT_NOFILE)
for more in range(5):
    resource.setrlimit(resource.RLIMIT_NOFILE, (max(map(int, os.listdir("/proc/self/fd"))) + more, limits[1]))
    try:
        open_result(result).close()
    except BristleError as error:
        assert "Too many open files; raise the limit of the shell" in str(error) and "damaged" not in str(error), error
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, limits)

# What is missing for an import, with the remedy: libraries, a newer Python, the program.
def imported(code, **environment):
    return subprocess.run([sys.executable, *code], capture_output=True, text=True, check=False, cwd=folder,
                          env={**os.environ, "PYTHONPATH": str(PACKAGE), **environment})


bare = ["-S", "-c"]  # without the folders of libraries
done = imported([*bare, "import bristle"])
assert done.returncode != 0 and "has no numpy, h5py, matplotlib, xarray, h5netcdf, which bristle needs; " in done.stderr, done.stderr
assert sys.executable in done.stderr and "install python3-numpy python3-h5py" in done.stderr, done.stderr
done = imported([*bare, "import sys; sys.version_info = (3, 10, 1); import bristle"])
assert "(Python 3.10.1) is too old: bristle needs Python 3.11 or newer" in done.stderr, done.stderr
installed = folder / "installed"  # away from the source tree and its program
shutil.copytree(PACKAGE, installed)
done = imported(["-c", "import bristle; bristle.run('paper.json')"], PYTHONPATH=str(installed), PATH="/nowhere")
assert "the program bristle is neither built in this source tree nor on PATH: `make build` builds it" in done.stderr, done.stderr
done = imported(["-c", "import bristle; bristle.opn_result"])
assert "module bristle has no opn_result; did you mean open_result?" in done.stderr, done.stderr
done = called("bristle", "fg4", result)
assert done.code == 2 and "argument FIGURE: there is no figure fg4; did you mean fig4?" in done.messages, done.messages
for words in (["mine"], ["mine", result]):
    done = called("bristle", *words)
    assert done.code == 2 and "; curve and map draw a variable of any result" in done.messages, done.messages

# Modules that cannot be imported, and a backend of matplotlib that does not exist: a message, or no difference.
broken = folder / "broken"
broken.mkdir()
for module, error in ("numpy", "ImportError"), ("h5py", "OSError"), ("matplotlib", "ImportError"), ("xarray", "AttributeError"):
    (broken / f"{module}.py").write_text(f"raise {error}('it is broken')")
    path = os.pathsep.join(map(str, (broken, PACKAGE)))
    for words in ("bristle", "fig4", result, "-o", broken), ("bristle.report", result), ("bristle.pages.findings", result):
        done = imported(["-m", *map(str, words)], PYTHONPATH=path)
        assert done.returncode == 2 and "cannot import what the figures need (it is broken)" in done.stderr, done
        assert "Traceback" not in done.stderr and done.stderr.count("\n") == 1, done.stderr
    done = imported(["-m", "bristle.current", "fig4", result, broken], PYTHONPATH=path)
    assert done.returncode == 1 and done.stderr == "", done
    done = imported(["-c", "from bristle import open_result"], PYTHONPATH=path)
    assert module == "matplotlib" or "cannot import what the figures need (it is broken)" in done.stderr.splitlines()[-1], done.stderr
    (broken / f"{module}.py").unlink()
done = subprocess.run([sys.executable, "-m", "bristle", "fig4", result, "--caption"], capture_output=True, text=True, check=False,
                      env={**os.environ, "PYTHONPATH": str(PACKAGE), "MPLBACKEND": "nonsense"})
assert done.returncode == 0, done.stderr
