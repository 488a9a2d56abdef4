"""Computing an experiment from Python by the program: a Dataset from a file or a dict, with changes by name.

    from bristle import run
    ds = run("fig8.json", tier="smoke")
    ds = run({"extends": "paper.json", "name": "mine"}, k_r=[5, 10, 20], friction="coulomb")
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from functools import lru_cache
from itertools import count

from .errors import NOT_WRITTEN, BristleError, did_you_mean
from .program import run as program_run
from .results import open_result

NO_TRIAL = 1  # exit code of a design without a trial that meets the constraints: the result is complete
BLOCKS = ("model", "si", "load", "orientation", "integrator")
ARGUMENTS = ("output", "tier", "threads", "quiet", "program")  # of run()
AXIS = ("values", "linspace", "logspace", "take")  # keys of an axis in a sweep

FOLDER = tempfile.TemporaryDirectory(prefix="bristle-")  # of results without a name; removed when Python ends
NUMBER = count()


def run(experiment, *, output=None, tier="full", threads=None, quiet=False, program=None, **changes):
    """Computes an experiment and returns its result as an xarray Dataset.

    experiment: the path of an experiment file, the name of one that comes with the program, or a dict of its content.
    changes: values by the names of their keys, such as k_r=20 or friction="coulomb"; a list makes an axis of the sweep,
    a single value takes the place of such an axis, and None removes a key. Keys of the outermost level, such as
    record=["observables"], are replaced.
    output: file of the result; without one, it is kept until Python ends. Points that a result in the same folder has
    are not computed again, so a call with more values computes only these.
    threads: all cores by default. program: path of bristle; by default the program of this source tree or the installed one.
    Raises BristleError with the program's message.
    """
    program = os.fspath(program or find_program())
    document, folder = document_of(experiment)
    patch = changes_by_block(program, changes)
    document = merged(document, patch)
    path = os.path.abspath(output or os.path.join(FOLDER.name, f"{next(NUMBER)}.h5"))
    command = [program, "run", "-", "-o", path, "--tier", tier, *(["--threads", str(threads)] if threads else []), *(f"--set={change}" for change in single_values(patch))]
    code, message = followed(command, as_json(document), folder, quiet)
    if code not in (0, NO_TRIAL):
        for place in ("standard input: ", *(f"--set {change}: " for change in single_values(patch))):
            message = message.removeprefix(place)
        raise BristleError(message if output else message.replace(path, "the result"), exit_code=code if code > 0 else NOT_WRITTEN)
    return open_result(path)


def find_program():
    built = os.path.join(os.path.dirname(__file__), "../../build/bristle")
    found = os.path.realpath(built) if os.path.exists(built) else shutil.which("bristle")
    if not found:
        raise BristleError("the program bristle is neither built in this source tree nor on PATH: `make build` builds it, "
                           "`make install` installs it (docs/running.md), and program=PATH names another")
    return found


def document_of(experiment):
    """The document to compute, and the folder in which the files that it names are looked for."""
    if isinstance(experiment, dict):
        return experiment, None
    if not isinstance(experiment, (str, os.PathLike)):
        raise BristleError("the experiment is neither the path or name of a file nor a dict of its content")
    if os.path.isfile(experiment):
        folder, name = os.path.split(os.path.abspath(experiment))
        return {"extends": name}, folder
    name = os.fspath(experiment)
    return {"extends": name if name.endswith(".json") else name + ".json"}, None


def changes_by_block(program, changes):
    blocks, patch = blocks_of(program), {}
    for name, value in changes.items():
        owners = [block for block in BLOCKS if name in blocks[block]]
        if name in blocks:
            patch[name] = value
        elif not owners:
            known = sorted({*blocks, *(key for block in BLOCKS for key in blocks[block]), *ARGUMENTS})
            raise BristleError(f"{name} is not a key of an experiment{did_you_mean(name, known) or '; known: ' + ', '.join(known)}")
        elif len(owners) > 1:
            raise BristleError(f"{name} is a key of {' and of '.join(owners)}; write {owners[0]}={{'{name}': ...}}")
        elif listed(value) and name in blocks["sweep"]:
            patch.setdefault("sweep", {})[name] = {**dict.fromkeys(AXIS), "values": value}
        else:
            patch.setdefault(owners[0], {})[name] = value
            if name in blocks["sweep"]:
                patch.setdefault("sweep", {})[name] = None
    return patch


def single_values(patch):
    """The single values of the patch as changes of --set, by which the program refuses to set what a sample of the
    experiment varies."""
    return [f"/{block}/{key}={as_json(value)}" for block, values in patch.items() if block in BLOCKS and isinstance(values, dict)
            for key, value in values.items() if block != "sweep" and isinstance(value, (int, float, str))]


def listed(value):
    """Whether the value is a list of values: an array without dimensions is a single one."""
    return not isinstance(value, (str, dict)) and hasattr(value, "__len__") and getattr(value, "ndim", 1) > 0


@lru_cache
def blocks_of(program):
    """The keys of an experiment, and of those that are blocks, the keys within."""
    schema = json.loads(program_run([program, "schema"]).stdout)
    return {name: schema["definitions"].get(name, {}).get("properties", {}) for name in schema["properties"]}


def merged(document, patch):
    """The document with the patch; None stays, as it removes a key of the file that the document extends."""
    both = {key: merged(document[key], patch[key]) for key in document.keys() & patch.keys()
            if isinstance(document[key], dict) and isinstance(patch[key], dict)}
    return {**document, **patch, **both}


def as_json(document):
    try:
        return json.dumps(document, default=plain, allow_nan=False)
    except ValueError:
        raise BristleError("NaN and infinity are no values of an experiment") from None


def plain(value):
    """JSON of ranges, and of NumPy's arrays and numbers."""
    if isinstance(value, range):
        return list(value)
    if not hasattr(value, "tolist"):
        raise BristleError(f"{value!r} is neither a number, a word, a list nor a dict")
    return value.tolist()


def followed(command, text, folder, quiet):
    """The exit code, and the program's error message; the rest of what it prints goes to standard error at once."""
    with subprocess.Popen(command, cwd=folder, text=True, encoding="utf-8", stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT) as process:
        try:
            process.stdin.write(text)
            process.stdin.close()
            message = ""
            for line in process.stdout:
                if line.startswith("bristle: "):
                    message = line.removeprefix("bristle: ").strip()
                elif not quiet:
                    sys.stderr.write(line)
        except BaseException:
            process.terminate()  # the points so far are in the journal
            raise
    return process.returncode, message
