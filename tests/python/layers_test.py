"""Files in src/ include only files of their own folder and of folders before it in the order of docs/architecture.md.

layers_test.py SOURCE
"""
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
page = (source / "docs/architecture.md").read_text(encoding="utf-8")
order = re.findall(r"`(\w+)`", re.search(r"in\s+this\s+order:([^.]*)\.", page).group(1))
wrong = []
for file in sorted((source / "src").rglob("*.?pp")):
    folder = file.relative_to(source / "src").parts[0]
    for included in re.findall(r'^#include "(\w+)/', file.read_text(encoding="utf-8"), re.M):
        if order.index(included) > order.index(folder):
            wrong.append(f"{file.relative_to(source)} includes {included}/, a later layer")
assert not wrong, "\n".join(wrong)
