"""The page page/brush.html: one file with the engine, the presets, and points of Figure 4 that it can compute again."""

import argparse
import base64
import gzip
import json
import os
import re
import subprocess
import sys
from itertools import product

import numpy as np
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

HERE = os.path.dirname(os.path.abspath(__file__))
PYTHON = os.path.join(os.path.dirname(HERE), "python")
sys.path.append(PYTHON)

from bristle.command_line import run  # noqa: E402
from bristle.figures.fig2 import PHASES  # noqa: E402
from bristle.files import write_text  # noqa: E402
from bristle.results import as_text, axis_names, axis_values, dataset, experiment, open_result, read  # noqa: E402

SCRIPTS = ["elements.js", "curves.js", "scene.js", "player.js", "pool.js", "form.js", "chart.js", "again.js", "brush.js"]
WORKER = ["engine.js", "worker.js"]
COMPARED = ["z_0", "R_x", "R_x_norm", "N_c_ratio", "gamma_1", "gamma_2", "gamma_3", "off_slab_share", "F_n_peak", "root_strain"]
LIMITS = {"exclusiveMinimum": ">", "minimum": "≥", "exclusiveMaximum": "<", "maximum": "≤"}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="with engine.wasm, the results of the presets, and fig4.h5")
    parser.add_argument("-o", dest="output", metavar="FILE", default=os.path.join(HERE, "brush.html"))
    parser.add_argument("--program", default="build/bristle")
    arguments = parser.parse_args()
    layout = json.loads(text_of(HERE, "fields.json"))
    schema = json.loads(output_of(arguments.program, "schema"))
    files = {name: open_result(os.path.join(arguments.folder, f"{name}.h5")) for name in [*layout["presets"], "fig4"]}
    with open(os.path.join(arguments.folder, "engine.wasm"), "rb") as file:
        engine = base64.b64encode(gzip.compress(file.read(), 9, mtime=0)).decode()
    pointers = [pointer for kind in ("si", "dimensionless") for group in layout[kind] for pointer, *_ in group["fields"]]
    environment = Environment(loader=FileSystemLoader(HERE), autoescape=True, undefined=StrictUndefined,
                              trim_blocks=True, lstrip_blocks=True)
    version, commit = re.search(r"(\S+) \((\w+)", output_of(arguments.program, "--version")).groups()
    page = environment.get_template("brush.html.j2").render(
        layout=layout, fields={pointer: about(schema, pointer, layout["labels"]) for pointer in pointers},
        presets={name: {"title": title, "experiment": experiment(files[name])} for name, title in layout["presets"].items()},
        stored=stored(files["fig4"]), phases=embedded(PHASES), embedded=embedded, engine=Markup(engine),
        version=version, commit=commit[:10], worker=source(WORKER), css=source(["brush.css"]), js=source(SCRIPTS))
    write_text(arguments.output, page)
    print(f"{arguments.output}: {len(page.encode()) / 1e6:.2f} MB")


def output_of(*command):
    return subprocess.run(command, capture_output=True, check=True, text=True).stdout


def text_of(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return file.read()


def source(names):
    return Markup("\n".join(text_of(HERE, name) for name in names))


def embedded(data):
    """JSON for the content of a script element."""
    words = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return Markup(words.replace("<", "\\u003c"))


def about(schema, pointer, labels):
    """Label, unit and limits of a field, as the program's schema has them."""
    _, block, key = pointer.split("/")
    found = schema["definitions"][block]["properties"][key]
    words, _, remark = found["description"].partition("; ")
    label, _, unit = words.rpartition(", ")
    label = labels.get(pointer, label)
    unit = re.sub(r"^(dimensionless|Eq\..*)$", "", unit).replace("in units of r0", "r₀").replace("in units of V0", "V₀").replace("^3", "³")
    limits = [f"{words} {found[key]:g}" for key, words in LIMITS.items() if key in found]
    return {"id": pointer[1:].replace("/", "-"), "label": label[:1].upper() + label[1:], "unit": unit,
            "allowed": ", ".join(limits), "remark": remark}


def stored(file):
    """The points of Figure 4 with their numbers, as the program computed them."""
    axes = axis_names(dataset(file, "status"))
    lines = [axis_values(file, name) for name in axes]
    numbers = {name: (np.ravel(read(file, name)), np.ravel(read(file, f"{name}_err"))) for name in COMPARED}
    found = []
    for index, at in enumerate(product(*lines)):
        of = {name: [float(value[index]), float(error[index])] for name, (value, error) in numbers.items() if error[index] > 0}
        found.append({"index": index, "place": ", ".join(f"{name} = {words(value)}" for name, value in zip(axes, at)), "numbers": of})
    document = {key: value for key, value in experiment(file).items() if key not in ("checks", "checks_for_each")}
    return {"experiment": document, "points": found, "meanings": {name: as_text(file[name].attrs["long_name"]) for name in COMPARED}}


def words(value):
    return value.replace("polar_as_printed", "as printed").replace("polar", "corrected") if isinstance(value, str) else f"{value:.4g}"


if __name__ == "__main__":
    run(main)
