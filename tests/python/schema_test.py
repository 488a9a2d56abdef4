"""The schema for editors, `bristle schema`, against the program: all experiments, and 200 changes of them.

schema_test.py BRISTLE FOLDER
"""
import copy
import json
import pathlib
import random
import re
import shutil
import subprocess
import sys

import jsonschema

bristle, folder = sys.argv[1], pathlib.Path(sys.argv[2])
experiments = pathlib.Path(__file__).parents[2] / "experiments"
MUTATIONS = 200
VALUES = ["word", -1, 0, 2.5, 1e9, None, True, [], {}, [1, 1], ["nss", "coulomb"]]
BLOCKS = ["model", "si", "load", "orientation", "scatter", "integrator", "sweep", "design", "record", "trajectories", "tiers"]

# What the program refuses and the schema does not: its message, and the reason.
PROGRAM_ONLY = {
    "neither R_n nor z_0 is given|R_n and z_0 are both given|is given, and so is R_n_N": "whether the extended file gives a load",
    "found (none|.* and )|needs \"values\" alone": "whether the extended file has this axis",
    "ascending indices": "order of the indices, and number of the axis's values",
    "the values must ascend|must end above its start": "order of the values",
    "cannot (start|begin) at": "what a logarithmic axis or distribution needs",
    "is missing": "what the extended file or another value requires",
    "a lattice needs a whole number|lattice\" only": "what a lattice requires of other blocks",
    "/si/.* (need it|needs either|with R_m only)": "which quantities in SI units belong together",
    "above first contact": "a bound that depends on other values",
    "not a number that the sweep varies": "whether the sweep has the axis of the jumps",
    "is not below .*; (swap them|give a range)": "order of the ends of a distribution",
    "gives 0 distributions": "whether the extended file has this distribution",
    "has no effect on round rods": "which section the extended file gives rods",
    r"is not a number, which \w+ needs": "which quantity a column of a table has",
    r"/sweep/sample/table/rows/.* (is out of range for|has \d+ values)": "which columns a table has",
    r"/sweep/sample/over/\w+: \w+ cannot be swept": "which quantities a sample can vary",
    r"/design/variables/.* is out of range for": "which values a variable can have",
    "needs exactly one of table and sobol": "whether the extended file has a table",
    "needs either jump_margin alone|goals are given": "what a constraint or an objective needs together",
    "shafts overlap": "whether radius and spacing fit",
    r"could reach (zero|90 degrees)": "how far a distribution reaches",
    "is no variable of the design|has no multiple between": "which variables a design has, and their bounds",
    "appears twice": "whether the words of an axis differ",
    r"\d\.0 is not allowed; (write \d+; )?allowed: an integer": "that an integer is written without a decimal point",
    r"/sweep/\w+: \d+\.\d+ is out of range for .*; allowed: an integer": "whether the steps of an axis are integers",
}


def schema():
    found = json.loads(subprocess.run([bristle, "schema"], capture_output=True, text=True, check=True).stdout)
    jsonschema.Draft7Validator.check_schema(found)
    return jsonschema.Draft7Validator(found)


def refusal(path):
    """The program's message; empty if the experiment is valid with all its tiers, which it may be with other warnings."""
    done = subprocess.run([bristle, "validate", path], capture_output=True, text=True)
    assert done.returncode in (0, 2), (path, done.returncode, done.stderr)
    return done.stderr.strip() if done.returncode or "cannot be computed: " in done.stderr else ""


def places(value, path=()):
    """Paths of all values in the blocks."""
    if isinstance(value, dict):
        for key, inner in value.items():
            if path or key in BLOCKS:
                yield (*path, key)
                yield from places(inner, (*path, key))
    elif isinstance(value, list):
        for index, inner in enumerate(value[:3]):
            yield (*path, index)
            yield from places(inner, (*path, index))


def value_at(document, path):
    for step in path:
        document = document[step]
    return document


def mutations(document):
    """(description, document, path, change of the value there): of thousands few are made."""
    for path in places(document):
        removes = value_at(document, path) is None
        for value in VALUES:
            yield f"{path} = {json.dumps(value)}", document, path, lambda at, key, v=value: at.__setitem__(key, v)
        yield f"{path} removed", document, path, lambda at, key: at.pop(key)
        if isinstance(path[-1], str):
            if not removes:  # the program merges the files first: null under an unknown key removes nothing
                yield f"{path} misspelt", document, path, lambda at, key: at.__setitem__(key + "x", at.pop(key))
            yield f"{path} beside another axis", document, path, add_range
    for key in ("R_n", "z_0"):
        for value in (None, 0.5, {}):
            yield (f"/load/{key} = {value}", document, ("load",),
                   lambda at, _, k=key, v=value: at.update(load={**(at.get("load") or {}), k: v}))


def add_range(at, key):
    at["logspace" if key != "logspace" else "linspace"] = [1, 2, 3]


def changed(document, path, change):
    out = copy.deepcopy(document)
    at = out
    for step in path[:-1]:
        at = at[step]
    change(at, path[-1])
    return out


def check_experiments(validator):
    files = sorted(experiments.glob("*.json"))
    assert len(files) > 10
    for path in files:
        errors = [f"{list(e.absolute_path)}: {e.message}" for e in
                  validator.iter_errors(json.loads(path.read_text(encoding="utf-8")))]
        assert not errors, (path.name, errors)


def check_mutations(validator):
    found = []
    for path in sorted(experiments.glob("*.json")):
        document = json.loads(path.read_text(encoding="utf-8"))
        document.pop("checks", None)
        document.pop("checks_for_each", None)
        found += [(f"{path.name}: {what}", *change) for what, *change in mutations(document)]
    refused, excused = 0, dict.fromkeys(PROGRAM_ONLY, 0)
    wrong = []
    for what, *change in random.Random(18).sample(found, MUTATIONS):
        document = changed(*change)
        (folder / "mutated.json").write_text(json.dumps(document), encoding="utf-8")
        by_schema, by_program = not validator.is_valid(document), refusal(folder / "mutated.json")
        refused += bool(by_program)
        if by_schema == bool(by_program):
            continue
        reasons = [text for text in PROGRAM_ONLY if re.search(text, by_program)]
        if by_schema or not reasons:
            wrong.append(f"{what}: by the schema {'refused' if by_schema else 'valid'}; the program: {by_program or 'valid'}")
        for text in reasons:
            excused[text] += 1
    assert not wrong, "\n".join([f"{len(wrong)} disagreements:", *wrong])
    assert MUTATIONS / 4 < refused < MUTATIONS, refused
    print(f"{MUTATIONS} mutations, {refused} refused by both but for {sum(excused.values())}:")
    for text, count in excused.items():
        print(f"  {count}: {PROGRAM_ONLY[text]}")


def check_key(validator):
    """The program ignores "$schema", in the digest, too."""
    digests = []
    for extra in ({}, {"$schema": "experiment.schema.json"}):
        document = {"extends": "paper.json", "name": "keyed", "orientation": {"rtol": 0.2}, **extra}
        assert validator.is_valid(document)
        (folder / "keyed.json").write_text(json.dumps(document), encoding="utf-8")
        subprocess.run([bristle, "run", folder / "keyed.json", "-o", folder / "keyed.h5", "--force", "--quiet"], check=True)
        info = json.loads(subprocess.run([bristle, "info", "--json", folder / "keyed.h5"], capture_output=True, check=True).stdout)
        digests.append((info["payload_sha256"], info["experiment"]))
    assert digests[0] == digests[1] and "$schema" not in digests[1][1]


folder.mkdir(parents=True, exist_ok=True)
shutil.copy(experiments / "paper.json", folder)
checker = schema()
check_experiments(checker)
check_key(checker)
check_mutations(checker)
