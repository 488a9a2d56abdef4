"""Captions of all figures compile with LaTeX; lines are told apart in grey; files name the result they are of; the animation.

captions_test.py FOLDER RESULTS FIGURE...: of RESULTS/FIGURE_smoke.h5. Without pdflatex the test counts as skipped (77).
"""
import itertools
import pathlib
import re
import shutil
import subprocess
import sys

import h5py
import matplotlib.colors
from PIL import Image

from in_process import called
from bristle import open_result
from bristle.figures import FIGURES, module_of

folder, results = map(pathlib.Path, sys.argv[1:3])
LEAST_LIGHTNESS = 0.2  # of 1, between two lines that are alike else


def lightness(colour):
    red, green, blue = matplotlib.colors.to_rgb(colour)
    return 0.299 * red + 0.587 * green + 0.114 * blue


def alike(a, b):
    """Whether two lines of a legend cannot be told apart in grey."""
    look = [(line.get_marker(), line._unscaled_dash_pattern, line.get_markerfacecolor() == "white") for line in (a, b)]
    return look[0] == look[1] and abs(lightness(a.get_color()) - lightness(b.get_color())) < LEAST_LIGHTNESS


def check_grey(figure):
    for axes in figure.axes:
        lines = [line for line in axes.lines if not line.get_label().startswith("_")]
        for a, b in itertools.combinations(lines, 2):
            assert not alike(a, b), (a.get_label(), b.get_label())


def check_captions(name, result):
    """A caption for each page of each figure of the module, which says what its marks mean."""
    module = module_of(name)
    assert module.MARKS, name
    endings = ["", *getattr(module, "FURTHER", {})]
    done = called("bristle", name, result, "--caption")
    assert done.code == 0, done.messages
    found = re.findall(r"\\caption\{.*\}", done.out)
    assert len(found) >= len(endings) and all(f"% {ending}\n" in done.out for ending in endings[1:]), done.out
    return found


def check_first_panel(name, result):
    """Its caption for each page, where the figure has panels; it is then drawn alone, without a letter."""
    done = called("bristle", name, result, "--caption", "--panels", "a")
    if done.code == 2 and "has no panels with letters" in done.messages:
        return []
    assert done.code == 0, done.messages
    with open_result(result) as ds:
        figure = module_of(name).draw(ds, panels="a")
    assert [axes.panel[0] for axes in figure.axes if hasattr(axes, "panel")] == [""], name
    return re.findall(r"\\caption\{.*\}", done.out)


def check_metadata(name, result):
    done = called("bristle", name, result, "-o", folder, "--dpi", "30")
    assert done.code == 0, done.messages
    with h5py.File(result) as file:
        told = [file.attrs["payload_sha256"], file["provenance"].attrs["commit"]]
    told = [word.decode() if isinstance(word, bytes) else str(word) for word in told]
    with Image.open(folder / f"{name}.png") as image:
        assert image.text["Title"] and all(word in image.text["Source"] for word in told), image.text
    pdf = (folder / f"{name}.pdf").read_bytes()
    assert b"/Title" in pdf and all(word.encode() in pdf for word in told)


def animate(result, *options):
    return called("bristle", "fig2", result, "--animate", "-o", *options)


def check_animation(result):
    """Written twice over itself, with equal bytes, small, with all frames, repeated without end."""
    for output, path in ((folder, folder / "fig2.gif"), (folder / "film.gif", folder / "film.gif")):
        done = animate(result, output)
        assert done.code == 0, done.messages
        with Image.open(path) as image:
            assert 60 <= image.n_frames <= 120 and image.info["loop"] == 0, (image.n_frames, image.info)
        assert path.stat().st_size <= 2_000_000, path.stat().st_size
        before = path.read_bytes()
        done = animate(result, output)
        assert done.code == 0 and path.read_bytes() == before, done.messages
    for output, options, words in (("film.avi", [], "an animation has the ending .gif, not .avi"),
                                   (".", ["--plain", "--caption"], "it has no --plain, --caption")):
        done = animate(result, folder / output, *options)
        assert done.code == 2 and words in done.messages, done.messages


shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
assert all(hasattr(module_of(name), "MARKS") for name in FIGURES)
check_animation(results / "fig2_smoke.h5")
captions = []
for name in sys.argv[3:]:
    result = results / f"{name}_smoke.h5"
    captions += check_captions(name, result) + check_first_panel(name, result)
    with open_result(result) as ds:
        check_grey(module_of(name).draw(ds))
    check_metadata(name, result)
if not shutil.which("pdflatex"):
    print("no pdflatex: captions are not compiled")
    sys.exit(77)
pages = "\n".join(f"\\begin{{figure}}{caption}\\end{{figure}}\\clearpage" for caption in captions)
(folder / "all.tex").write_text(f"\\documentclass{{article}}\\begin{{document}}{pages}\\end{{document}}", encoding="utf-8")
done = subprocess.run(["pdflatex", "-halt-on-error", "-interaction=nonstopmode", "all.tex"], cwd=folder, capture_output=True, check=False)
assert done.returncode == 0, done.stdout.decode(errors="replace")[-2000:]
