"""docs/tutorial.ipynb with the outputs of its cells, which are executed in order. The text before a cell stays as it is."""

import argparse
import ast
import base64
import contextlib
import io
import json
import os
import tempfile

import matplotlib
from PIL import Image

from ..command_line import run
from ..files import read_json, write_text

DPI, COLOURS = 80, 48  # of the figures, so that the notebook stays small


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("notebook", nargs="?", default="docs/tutorial.ipynb", help="(default: %(default)s)")
    path = os.path.abspath(parser.parse_args().notebook)
    notebook = read_json(path, "it is part of the source")
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):  # for the files that cells write
        execute(notebook)
    write_text(path, f"{json.dumps(notebook, indent=1, ensure_ascii=False)}\n")


def execute(notebook):
    """Replaces the outputs of the notebook, a dict of its JSON, by the outputs of an execution; returns the cells' variables."""
    matplotlib.use("agg")
    variables = {}
    for count, cell in enumerate((cell for cell in notebook["cells"] if cell["cell_type"] == "code"), 1):
        cell["execution_count"], cell["outputs"] = count, outputs("".join(cell["source"]), cell["id"], count, variables)
    return variables


def outputs(source, name, count, variables):
    """What Jupyter shows below a cell: printed text, the value of a last expression without semicolon, and open figures."""
    from matplotlib import pyplot

    with contextlib.redirect_stdout(io.StringIO()) as printed:
        value = executed(source, name, variables)
    found = []
    if printed.getvalue():
        found.append({"name": "stdout", "output_type": "stream", "text": printed.getvalue().splitlines(keepends=True)})
    if value is not None:
        found.append({"data": shown(value), "execution_count": count, "metadata": {}, "output_type": "execute_result"})
    found += [{"data": shown(pyplot.figure(number)), "metadata": {}, "output_type": "display_data"}
              for number in pyplot.get_fignums()]
    pyplot.close("all")
    return found


def executed(source, name, variables):
    """The value of the last expression; None if there is none, or if a semicolon hides it."""
    tree = ast.parse(source, name)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) and not source.endswith(";") else None
    exec(compile(tree, name, "exec"), variables)
    return None if last is None else eval(compile(ast.Expression(last.value), name, "eval"), variables)


def shown(value):
    """The value as text, and a figure also as an image."""
    data = {"text/plain": repr(value).splitlines(keepends=True)}
    if isinstance(value, matplotlib.figure.Figure):
        value.savefig(buffer := io.BytesIO(), dpi=DPI, format="png")
        small = Image.open(buffer).convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
        small.save(png := io.BytesIO(), format="PNG", optimize=True)
        data = {"image/png": base64.b64encode(png.getvalue()).decode(), **data}
    return data


if __name__ == "__main__":
    run(main, "tutorial")
