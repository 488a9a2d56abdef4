"""Executes the steps of docs/extending.md: applied to the source without the friction law, they give the source.

extending_test.py SOURCE BUILD
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

source, build = map(pathlib.Path, sys.argv[1:3])
LAW = "stribeck"
PLACES = ["src", "tests", "experiments", "scripts", "cmake", "benchmarks", "Makefile", "CMakeLists.txt", "packages.txt",
          "CMakePresets.json"]
# The first contains the name of the law to search for it, the others use all laws.
EXCEPTIONS = {"tests/python/extending_test.py", "tests/program/arm_test.sh", "tests/stress/physics.py"}

page = (source / "docs/extending.md").read_text(encoding="utf-8")
blocks = re.findall(r"^```(\w+) ?(\S*)\n(.*?)^```$", page, re.M | re.S)
files = [(path, text) for kind, path, text in blocks if path and kind != "diff"]
diffs = [(path, text) for kind, path, text in blocks if kind == "diff"]
commands = [line for kind, _, text in blocks if kind == "sh" for line in text.splitlines()]
assert len(files) >= 4 and len(diffs) >= 5 and len(commands) >= 5, "the document has too few steps"


def sides(text):
    """The text before and after a diff."""
    lines = text.splitlines(keepends=True)
    return ["".join(line[1:] for line in lines if line[0] in " " + sign) for sign in "-+"]


def replace(path, old, new):
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1, f"{path.name}: the step's lines occur {text.count(old)} times:\n{old}"
    path.write_text(text.replace(old, new), encoding="utf-8")


with tempfile.TemporaryDirectory() as folder:
    copy = pathlib.Path(folder)
    for place in PLACES:
        if (source / place).is_dir():
            shutil.copytree(source / place, copy / place, ignore=shutil.ignore_patterns("__pycache__", "*.png"))
        else:
            shutil.copy2(source / place, copy / place)
    copies = [path for path in copy.rglob("*") if path.is_file()]
    times = {path: path.stat().st_mtime for path in copies}

    for path, text in files:
        assert (copy / path).read_text(encoding="utf-8") == text, f"{path} differs from the document"
        (copy / path).unlink()
    for path, text in reversed(diffs):
        before, after = sides(text)
        replace(copy / path, after, before)
    left = [str(path.relative_to(copy)) for path in copies
            if path.exists() and LAW in path.read_text(encoding="utf-8", errors="ignore").lower()]
    assert set(left) <= EXCEPTIONS, f"the document lacks the steps that add the law to {left}"

    for path, text in files:
        (copy / path).write_text(text, encoding="utf-8")
    for path, text in diffs:
        before, after = sides(text)
        replace(copy / path, before, after)
    for path in copies:
        assert path.read_bytes() == (source / path.relative_to(copy)).read_bytes(), path
        os.utime(path, (times[path], times[path]))

    shutil.copytree(source / "reference", copy / "reference")
    # The copy equals the source and can use its build.
    (copy / "build").symlink_to(build, target_is_directory=True)
    for command in commands:
        done = subprocess.run(command, shell=True, cwd=copy, capture_output=True, text=True)
        assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    assert (copy / f"figures-smoke/{LAW}.png").stat().st_size > 15_000
