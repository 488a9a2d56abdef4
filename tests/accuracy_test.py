"""docs/accuracy.md is what is measured: computed again, and compared.

accuracy_test.py SOURCE PROGRAM DIRECTORY
"""
import difflib
import pathlib
import subprocess
import sys

source, program, directory = map(pathlib.Path, sys.argv[1:4])
directory.mkdir(parents=True, exist_ok=True)
measured, page = directory / "accuracy.json", directory / "accuracy.md"
with open(measured, "wb") as file:
    subprocess.run([program], stdout=file, check=True)
subprocess.run([sys.executable, source / "scripts" / "accuracy.py", measured, "-o", page], check=True)
said, found = ((path.read_text(encoding="utf-8").splitlines()) for path in (source / "docs" / "accuracy.md", page))
difference = "\n".join(difflib.unified_diff(said, found, "docs/accuracy.md", "measured", lineterm=""))
assert not difference, f"{difference}\n`make accuracy` writes the page anew"
