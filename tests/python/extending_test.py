"""Executes docs/extending.md: the friction law and its figure are the source's; the other additions are built and run.
Without BUILD only compares the document with the source.

extending_test.py SOURCE [BUILD]
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import h5py

source, *builds = map(pathlib.Path, sys.argv[1:])
LAW = "stribeck"
PART_OF_SOURCE = ["A figure", "A friction law"]
PLACES = ["src", "tests", "experiments", "scripts", "python", "cmake", "benchmarks", "Makefile", "CMakeLists.txt", "packages.txt",
          "CMakePresets.json", "README.md", "LICENSE", "CITATION.cff", "CHANGELOG.md"]
# The first contains the name of the law to search for it, the others use all laws.
EXCEPTIONS = {"tests/python/extending_test.py", "tests/program/arm_test.sh", "tests/stress/physics.py",
              "tests/stress/studies.py", "tests/hostile/extremum.json"}

page = (source / "docs/extending.md").read_text(encoding="utf-8")
sections = {}  # (files that the heading states, blocks) by title
for title, count, text in re.findall(r"^## ([^\n]*): (\d) files?\n(.*?)(?=^## |\Z)", page, re.M | re.S):
    sections[title] = int(count), re.findall(r"^```(\w+) ?(\S*)\n(.*?)^```$", text, re.M | re.S)
assert list(sections) == ["A parameter", "An observable", "A figure", "A claim", "A friction law"], list(sections)
for title, (count, blocks) in sections.items():
    assert len({path for _, path, _ in blocks if path}) == count, f"{title} touches another number of files than it says"


def blocks_of(titles, *kinds):
    return [(path, text) for title in titles for kind, path, text in sections[title][1] if kind in kinds]


def sides(text):
    """The text before and after a diff."""
    lines = text.splitlines(keepends=True)
    return ["".join(line[1:] for line in lines if line[0] in " " + sign) for sign in "-+"]


def replace(path, old, new):
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1, f"{path.name}: the step's lines occur {text.count(old)} times:\n{old}"
    path.write_text(text.replace(old, new), encoding="utf-8")


def run(command, folder, code=0):
    done = subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True)
    assert done.returncode == code, f"{command}: {done.returncode}: {done.stdout[-3000:]}{done.stderr[-3000:]}"
    return done.stdout + done.stderr


with tempfile.TemporaryDirectory() as folder:
    copy = pathlib.Path(folder)
    for place in PLACES:
        if (source / place).is_dir():
            shutil.copytree(source / place, copy / place, ignore=shutil.ignore_patterns("__pycache__", "*.png"))
        else:
            shutil.copy2(source / place, copy / place)
    copies = [path for path in copy.rglob("*") if path.is_file()]
    times = {path: path.stat().st_mtime for path in copies}
    files = blocks_of(PART_OF_SOURCE, "cpp", "json", "python")
    diffs = blocks_of(PART_OF_SOURCE, "diff")
    assert len(files) == 3 and len(diffs) == 2

    # The friction law and its figure.
    for path, text in files:
        assert (copy / path).read_text(encoding="utf-8") == text, f"{path} differs from the document"
        (copy / path).unlink()
    for path, text in reversed(diffs):
        before, after = sides(text)
        replace(copy / path, after, before)
    left = [str(path.relative_to(copy)) for path in copies
            if path.exists() and LAW in path.read_text(encoding="utf-8", errors="ignore").lower()]
    assert set(left) <= EXCEPTIONS | {"CHANGELOG.md", "README.md"}, f"the document lacks the steps that add the law to {left}"
    for path, text in files:
        (copy / path).write_text(text, encoding="utf-8")
    for path, text in diffs:
        before, after = sides(text)
        replace(copy / path, before, after)
    for path in copies:
        assert path.read_bytes() == (source / path.relative_to(copy)).read_bytes(), path
        os.utime(path, (times[path], times[path]))
    if not builds:
        sys.exit()
    build = builds[0]
    shutil.copytree(source / "reference", copy / "reference")
    # The copy equals the source and can use its build.
    (copy / "build").symlink_to(build, target_is_directory=True)
    commands = [line for _, text in blocks_of(PART_OF_SOURCE, "sh") for line in text.splitlines()]
    assert len(commands) >= 5
    for command in commands:
        run(command, copy)
    assert (copy / f"figures-smoke/{LAW}.png").stat().st_size > 15_000

    # The other additions, with a build of their own.
    for path, text in blocks_of([title for title in sections if title not in PART_OF_SOURCE], "diff"):
        replace(copy / path, *sides(text))
    (copy / "build").unlink()
    run("cmake --preset release -G Ninja && ninja -C build --quiet bristle", copy)
    run(f"build/bristle run experiments/{LAW}.json --tier smoke --set /model/creep_ratio=4 -o new.h5", copy)
    with h5py.File(copy / "new.h5") as file:
        peak, error = file["side_travel"], file["side_travel_err"][()]
        assert peak.attrs["long_name"] == b"largest distance of the tip from the root across the motion" and (peak[()] > 0).all()
        assert (error < 0.05 * peak[()]).all(), (peak[()], error)
    assert "creep_ratio: -1" in run(f"build/bristle validate experiments/{LAW}.json --set /model/creep_ratio=-1", copy, 2)
    checked = run("build/bristle check --report-only --reference reference new.h5 || true", copy)
    assert re.search(r"^S1 ", checked, re.M), checked
