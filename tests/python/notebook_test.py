"""Executes the cells of docs/tutorial.ipynb in order: they print what the notebook has, and draw figures of the same sizes.

notebook_test.py BRISTLE FOLDER
"""
import base64
import copy
import io
import json
import os
import pathlib
import shutil
import sys

from PIL import Image

from in_process import SOURCE
from bristle import computing
from bristle.pages.tutorial import execute

bristle, folder = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
os.chdir(folder)
computing.find_program = lambda: bristle


def contents(cell):
    """The outputs of a cell; of a figure the size, because its bytes depend on the version of the fonts."""
    found = copy.deepcopy(cell["outputs"])
    for output in found:
        if "image/png" in output.get("data", {}):
            with Image.open(io.BytesIO(base64.b64decode(output["data"]["image/png"]))) as image:
                output["data"] = image.size
    return cell["execution_count"], found


stored = (SOURCE / "docs/tutorial.ipynb").read_bytes()
assert len(stored) < 100_000, len(stored)
notebook = json.loads(stored)
assert notebook["nbformat"] == 4 and len({cell["id"] for cell in notebook["cells"]}) == len(notebook["cells"])
before = {cell["id"]: contents(cell) for cell in notebook["cells"] if cell["cell_type"] == "code"}
variables = execute(notebook)
for cell in notebook["cells"]:
    if cell["cell_type"] == "code":
        now = contents(cell)
        assert now == before[cell["id"]], f"{cell['id']} gives {now}, the notebook has {before[cell['id']]}: `make tutorial`"
text = "".join(line for _, outputs in before.values() for output in outputs for line in output.get("text", []))
for words in ("R_x/R_rigid = ", "status ok", "polar: the gap jumps between k_r = ", "rod: the gap jumps between k_r = ", "/model/k_r: -1 is not allowed"):
    assert words in text, words
assert sum("data" in output for _, outputs in before.values() for output in outputs) == 3, "three figures"
assert (folder / "own.h5").exists() and variables["own"].sizes == {"mu_c": 4, "k_phi": 3}
