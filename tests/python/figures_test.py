"""Figures are drawn with the same bytes each time, explain why they cannot use a file, and fit into a paper.

figures_test.py FOLDER RESULTS [FIGURE...]: of RESULTS/FIGURE_smoke.h5. One process draws them all. Without names each
figure is drawn once, small, and some checks use one figure only; with names, everything is checked of these figures.
"""
import hashlib
import io
import pathlib
import re
import shutil
import sys

import h5py
import matplotlib
import numpy
import xarray
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

from in_process import called
from bristle import BristleError, open_result
from bristle.figures import fig4, module_of
from bristle.integrity import read_group
from bristle.plotting.page import LEAST_POINTS
from bristle.plotting.readings import pages

folder, results = map(pathlib.Path, sys.argv[1:3])
EVERY_COMMIT = ["fig2", "fig4", "fig7", "fig8", "figA1", "figA2"]
FULL = sys.argv[3:]
BY_COMMAND = ["fig8"]  # of every commit's: all pages, twice


def plot(name, source, target, *options):
    """Exit code and messages of the command."""
    done = called("bristle", name, source, "-o", target, *options)
    return done.code, done.messages


def drawn(name, result, target, *options):
    """The digests of the files that the command writes: a PDF with a page for each PNG."""
    code, messages = plot(name, result, target, *options)
    assert code == 0, messages
    made = sorted(target.glob(f"{name}*"))
    assert {f"{name}.pdf", f"{name}.png"} <= {p.name for p in made}, made
    assert {p.suffix for p in made} == {".pdf", ".png"}, made
    for pdf in target.glob(f"{name}*.pdf"):
        pngs = [pdf.with_name(f"{pdf.stem}{ending}.png") for ending in ("", "-polar-as-printed", "-rod")]
        pages = re.search(rb"/Count (\d+)", pdf.read_bytes()).group(1)
        assert int(pages) == sum(p in made for p in pngs), pdf
    assert all(p.stat().st_size > 5_000 for p in made)
    return [hashlib.sha256(p.read_bytes()).hexdigest() for p in made]


def check_draws(name, result):
    """A page of each of the figure's drawings."""
    with open_result(result) as ds:
        for draw in drawings(name):
            figure = draw(ds)
            figure.savefig(png := io.BytesIO(), format="png", dpi=40)
            assert len(png.getvalue()) > 5_000
            pixels, text = smallest_letter(figure)
            assert pixels > 8.9, f"{name}: letters of {pixels:.1f} pixels where the figure is 1000 pixels wide: {text}"


def smallest_letter(figure):
    """The size in pixels of the smallest letter where the figure is 1000 pixels wide, and its text; mathtext draws subscripts at 0.7."""
    def size(text):
        return text.get_fontsize() * (0.7 if re.search(r"\$.*[_^].*\$", text.get_text()) else 1)

    smallest = min((text for text in figure.findobj(Text) if text.get_visible() and text.get_text()), key=size)
    return size(smallest) * 1000 / 72 / figure.get_figwidth(), smallest.get_text()


def drawings(name):
    module = module_of(name)
    return [module.draw, *getattr(module, "FURTHER", {}).values()]


def named_in(module, result):
    """Datasets that the figure's module names, columns of tables first."""
    source = pathlib.Path(module.__file__).read_text(encoding="utf-8")
    with h5py.File(result) as f:
        named = [name for name in f if f'"{name}"' in source]
        columns = [f"{name}/{column}" for name in named if isinstance(f[name], h5py.Group)
                   for column in f[name] if f'"{column}"' in source and "CLASS" not in f[name][column].attrs]
        return columns + [name for name in named if isinstance(f[name], h5py.Dataset) and "CLASS" not in f[name].attrs]


def lacks(source, target, needed):
    """Copies a result without this dataset, lacking but not damaged."""
    shutil.copy(source, target)
    with h5py.File(target, "a") as f:
        for dimension in f[needed].dims:
            for scale in list(dimension.values()):
                dimension.detach_scale(scale)  # the scale would refer to what is no longer there
        del f[needed]
        digest = hashlib.sha256()
        read_group(f, "", 0, digest)
        f.attrs["payload_sha256"] = numpy.bytes_(digest.hexdigest())


def check_refusals(name, result):
    """A file that lacks a dataset that the figure needs."""
    refused = []
    for needed in named_in(module_of(name), result):
        lacks(result, folder / "lacking.h5", needed)
        code, message = plot(name, folder / "lacking.h5", folder / "lacking", "--format", "png", "--dpi", "30")
        refused += [needed] if code == 2 and needed in message else []
        assert code == 0 or refused, message
        if refused:
            break
    assert refused, f"{name} can be drawn without any of the datasets that it names"


def check_other_files(name, result):
    """A result of another version, and what is no result."""
    shutil.copy(result, folder / "old.h5")
    with h5py.File(folder / "old.h5", "a") as f:
        f.attrs["schema_version"] = "bristle-result/0"
    code, message = plot(name, folder / "old.h5", folder)
    assert code == 2 and "bristle-result/0" in message, message
    assert plot(name, folder / "none.h5", folder)[0] == 2
    (folder / "text.h5").write_text("not HDF5")
    assert plot(name, folder / "text.h5", folder)[0] == 2


def check_dataset(name, result):
    """draw() takes a Dataset that is not from a file, and leaves matplotlib's parameters as they are."""
    module = module_of(name)
    before = dict(matplotlib.rcParams)
    with xarray.open_dataset(result) as ds:
        ds.encoding = {}
        try:
            figure = module.draw(ds)
        except BristleError as error:
            assert "open_result" in str(error), error
        else:
            assert isinstance(figure, matplotlib.figure.Figure)
            assert "/" not in named_in(module, result)[0], "a missing table caused no error"
    assert dict(matplotlib.rcParams) == before, "drawing changed matplotlib's parameters"


def bare(figure):
    """Whether the figure has neither header nor table of verdicts."""
    return not any(text.get_text() == "statement" or text.get_fontsize() == 14 for text in figure.findobj(Text))


def check_edges(figure):
    """Nothing is cut off."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    box, (width, height) = figure.get_tightbbox(renderer), figure.get_size_inches()
    assert min(box.x0, box.y0, width - box.x1, height - box.y1) > -0.01, f"cut off: {box} of {width} x {height}"


def check_apart(figure):
    """No tick's text is over one of another axis or of its own axis, and no axis title is over a tick's text."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    lines = [line for axes in figure.axes if axes.axison for name in "xyz" if (line := getattr(axes, f"{name}axis", None))]
    texts = [text for line in lines for text in (*(tick.label1 if tick.label1.get_visible() else tick.label2
                                                    for tick in line._update_ticks()), line.label)]
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in texts if text.get_visible() and text.get_text()]
    over = [(one, other) for i, (one, a) in enumerate(boxes) for other, b in boxes[:i] if a.padded(-1).overlaps(b.padded(-1))]
    assert len(boxes) > 5 and not over, f"texts over each other: {over}"


def check_page(figure, inches):
    """A page for a paper has its width, letters of at least 7 points, and no images of pixels; nothing is cut off."""
    width, height = figure.get_size_inches()
    assert width == inches and height < 10, (width, height)
    assert bare(figure)
    check_edges(figure)
    check_apart(figure)
    texts = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text().strip()]
    small = [text.get_text() for text in texts if text.get_fontsize() < LEAST_POINTS]
    assert len(texts) > 5 and not small, f"smaller than {LEAST_POINTS} points: {small}"
    pdf = io.BytesIO()
    figure.savefig(pdf, format="pdf")
    page = [float(number) for number in re.search(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", pdf.getvalue()).groups()]
    assert abs(page[0] - 72 * inches) < 0.01, page
    assert b"/Subtype /Image" not in pdf.getvalue(), "pixels in the PDF"


def check_paper(name, result):
    module = module_of(name)
    with open_result(result) as ds:
        for draw in drawings(name):
            standard = draw(ds)
            assert not bare(standard) and bare(draw(ds, plain=True))
            check_edges(standard)
            for width, inches in (("3.5in", 3.5), ("17.78cm", 7)):
                for _, _, figure in pages(draw, ds, width=width):
                    check_page(figure, inches)
        # A part of a map: its short axes have ticks that do not touch.
        if "k_theta" in ds.sizes and "gamma_1" in getattr(module, "VARIABLES", []):
            for part in (ds.isel(k_theta=slice(0, 2)), ds.isel(k_theta=slice(-2, None)), ds.isel(k_r=slice(1, 3))):
                for width in (3.5, 7):
                    check_page(module.draw(part, width=width), width)


shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
for name in FULL or EVERY_COMMIT:
    result = results / f"{name}_smoke.h5"
    if FULL or name in BY_COMMAND:
        look = () if FULL else ("--dpi", "40")
        first = drawn(name, result, folder / "first", *look)
        assert drawn(name, result, folder / "second", *look) == first, "two runs gave different bytes"
        check_other_files(name, result)
    else:
        check_draws(name, result)
    check_refusals(name, result)
    if FULL or name in ("fig2", "fig7"):
        check_dataset(name, result)
    if FULL:
        check_paper(name, result)
if not FULL:
    with open_result(results / "fig4_smoke.h5") as ds:
        check_page(fig4.draw(ds, width="3.5in"), 3.5)
