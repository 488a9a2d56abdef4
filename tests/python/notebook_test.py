"""Executes the cells of docs/tutorial.ipynb in order; each number or figure that the text announces is there.

notebook_test.py BRISTLE FOLDER
"""
import contextlib
import io
import json
import os
import pathlib
import shutil
import sys

import matplotlib

matplotlib.use("Agg")
SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "python"))
from bristle import computing  # noqa: E402

bristle, folder = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
os.chdir(folder)
computing.find_program = lambda: bristle

notebook = json.loads((SOURCE / "docs/tutorial.ipynb").read_text(encoding="utf-8"))
assert notebook["nbformat"] == 4 and len({cell["id"] for cell in notebook["cells"]}) == len(notebook["cells"])
variables, printed = {}, io.StringIO()
for cell in notebook["cells"]:
    if cell["cell_type"] == "code":
        assert not cell["outputs"] and cell["execution_count"] is None, "the notebook is stored without outputs"
        with contextlib.redirect_stdout(printed):
            exec(compile("".join(cell["source"]), cell["id"], "exec"), variables)
text = printed.getvalue()
print(text)
for words in ("R_x/R_rigid = 0.762 +- 0.002", "status ok", "polar: the gap jumps between k_r = ", "rod: the gap jumps between k_r = ", "/model/k_r: -1 is not allowed"):
    assert words in text, words
assert (folder / "own.h5").exists() and variables["own"].sizes == {"mu_c": 4, "k_phi": 3}
