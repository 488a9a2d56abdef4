"""Files in src/ include only files of their own folder and of folders before it in the order of docs/architecture.md.
The folders of the library, src/bristle, are named by their last name. The same holds for the folders of python/bristle.

layers_test.py SOURCE
"""
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
page = (source / "docs/architecture.md").read_text(encoding="utf-8")
order = ["bristle"] + re.findall(r"`(\w+)`", re.search(r"in\s+this\s+order:([^.]*)\.", page).group(1))
wrong = []
for file in sorted((source / "src").rglob("*.?pp")):
    parts = file.relative_to(source / "src").parts
    folder = parts[1] if parts[0] == "bristle" and len(parts) > 2 else parts[0]
    for path in re.findall(r'^#include "([\w/]+)/\w+\.hpp"', file.read_text(encoding="utf-8"), re.M):
        names = path.split("/")
        included = names[1] if names[0] == "bristle" and len(names) > 1 else names[0]
        if order.index(included) > order.index(folder):
            wrong.append(f"{file.relative_to(source)} includes {included}/, a later layer")
rooms = re.search(r"A module of ([^;]*?) imports\s+none", page).group(1)
rooms = re.findall(r"`(\w+)`", rooms)
assert len(rooms) == 4, rooms
for room in rooms:
    for file in sorted((source / "python/bristle" / room).glob("*.py")):
        for imported in re.findall(r"^\s*from \.\.(\w+)", file.read_text(encoding="utf-8"), re.M):
            if imported in rooms and rooms.index(imported) > rooms.index(room):
                wrong.append(f"{file.relative_to(source)} imports {imported}, a later folder")
assert not wrong, "\n".join(wrong)
