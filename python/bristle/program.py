"""Calls of the program: measurements, exported tables, friction laws, citations."""

import csv
import json
import os
import subprocess
import tempfile

from .errors import BristleError

DEFAULT = "build/bristle"


def run(arguments, text=None):
    """The finished process, which reads the text; exit codes 0 and 1 are results."""
    try:
        done = subprocess.run(arguments, input=text, capture_output=True, text=True, check=False)
    except OSError as error:
        raise BristleError(f"{arguments[0]}: cannot be run ({error.strerror}); `make build` makes it") from error
    if done.returncode not in (0, 1):
        command = " ".join(map(str, arguments))
        raise BristleError(f"`{command}` ended with {done.returncode}: {done.stderr.strip()}")
    return done


def cite(program):
    """BibTeX entries of the software and the paper."""
    return run([program, "cite"]).stdout


def export(program, path, *options):
    """The text of an exported table."""
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "table.csv")
        done = run([program, "export", path, "-o", output, *options])
        if done.returncode:
            raise BristleError(f"{path}: not exported: {done.stderr.strip()}")
        with open(output, encoding="utf-8") as file:
            return file.read()


def measure(program, path, check):
    """What the program measures on a result for the keys of a check (docs/claims.md), by reading; NaN without a value."""
    unjudged = {"claim": "-", "statement": "-", "is": "at_least", "threshold": 0}
    with tempfile.NamedTemporaryFile("w", suffix=".json", encoding="utf-8") as file:
        json.dump({"checks": [{**unjudged, **check}]}, file, default=float)
        file.flush()
        lines = export(program, path, "--group", "checks", "--checks", file.name).splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return {row["reading"]: float(row["measured"] or "nan") for row in rows}


def laws(program, experiment):
    """The modulation of each friction law of the experiment (a document) over V_R: name and numbers of each column."""
    lines = run([program, "law", "-"], json.dumps(experiment)).stdout.splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}
