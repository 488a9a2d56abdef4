"""Computes docs/generated/accuracy.md again and compares it.

accuracy_test.py SOURCE PROGRAM DIRECTORY
"""
import difflib
import os
import pathlib
import subprocess
import sys

source, program, directory = map(pathlib.Path, sys.argv[1:4])
directory.mkdir(parents=True, exist_ok=True)
measured, page = directory / "accuracy.json", directory / "accuracy.md"
with open(measured, "wb") as file:
    subprocess.run([program], stdout=file, check=True)
subprocess.run([sys.executable, "-m", "bristle.pages.accuracy", measured, "-o", page], check=True,
               env={**os.environ, "PYTHONPATH": str(source / "python")})
documented, measured_now = ((path.read_text(encoding="utf-8").splitlines()) for path in (source / "docs" / "generated" / "accuracy.md", page))
difference = "\n".join(difflib.unified_diff(documented, measured_now, "docs/generated/accuracy.md", "measured", lineterm=""))
assert not difference, f"{difference}\n`make accuracy` updates the page"
