"""Samples, friction laws, designs, overrides, advised commands and archives of them, drawn at random.

studies.py BRISTLE SECONDS SEED FOLDER

What `validate` accepts, `run` computes; a table is read as it was meant or refused; an override changes the experiment
or is refused; a command that a message advises is accepted; every printed number is finite; no text of a library.
"""
import json
import pathlib
import random
import re
import shlex
import shutil
import subprocess
import sys

import h5py
import numpy

from common import Campaign, Failure, Program

bristle, seconds, seed, folder = Program(sys.argv[1]), float(sys.argv[2]), sys.argv[3], pathlib.Path(sys.argv[4]).resolve()
source = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(source / "python"))
from bristle import BristleError, run  # noqa: E402

r = random.Random(f"studies {seed}")
(folder / "experiments").mkdir(parents=True)
shutil.copy(source / "experiments/paper.json", folder / "experiments")

NUMBER = r"(?<![\w./-])[-+]?(nan|inf|infinity)(?![\w./-])"
LIBRARY = re.compile(r"Traceback|\bstod\b|\bstoi\b|boost::|std::|terminate|nlohmann::|json\.exception|H5[A-Z]|HDF5-DIAG|YAML::|fmt::")
WORDS = {"friction": ["nss", "coulomb", "stribeck", "custom"], "bending": ["polar", "polar_as_printed", "rod"],
         "pole_rule": ["reflect", "cross"], "initial_state": ["static_equilibrium", "at_slab", "unstretched", "upright"],
         "path": ["loading", "unloading"], "sampling": ["quadrature", "list", "lattice"], "contact": ["wall", "hertz"], "section": ["round", "oval"]}
RANGES = {"k_r": (3, 60), "k_phi": (1.5, 4), "k_theta": (0.5, 6), "tau_f": (1e4, 5e4), "phi_0_deg": (60, 88), "mu_c": (0.2, 2),
          "zeta_phi": (0.05, 1), "zeta_theta": (0.05, 1), "V_s": (0.001, 0.1), "A": (1.01, 3), "lambda_z": (5e-4, 5e-3), "R": (0.01, 0.12),
          "L_x": (1, 8), "spacing": (0.13, 0.3), "z_0": (0.1, 1.05), "R_n": (0.01, 6), "nominal_friction": (0.2, 2)}
VARIABLES = ["R_x", "R_n", "R_x_norm", "pinned_fraction", "z_0", "gamma_1", "N_c_ratio", "R_y", "root_strain", "stuck_share", "impacts"]


def said(code, out, error, shown):
    """Checks the texts of a command."""
    for text in (out, error):  # a message about a wrong value quotes it
        if found := LIBRARY.search(text) or code in (0, 1) and re.search(NUMBER, text, re.I):
            line = next(line for line in text.splitlines() if found.group(0) in line)
            raise Failure(f"{shown}: prints {found.group(0)!r}: {line[:400]}")
    return code, out, error


def command(*words, **options):
    shown = shlex.join(["bristle", *map(str, words)])
    return said(*bristle(*words, cwd=folder, seconds=300, **options), shown)


def value(name):
    low, high = RANGES[name]
    return float(f"{r.uniform(low, high):.4g}")


def base(name):
    """A quick experiment with a random law, model and load."""
    document = {"schema": "bristle-experiment/1", "extends": "paper.json", "name": name, "title": name,
                "load": r.choice([{"R_n": value("R_n")}, {"R_n": None, "path": None, "z_0": value("z_0")}]),
                "orientation": {"sampling": "list", "theta_0_deg": r.sample(range(5, 180, 5), r.randint(1, 3)), "rtol": None},
                "integrator": {"max_evaluations": 10000, "max_evaluations_per_point": 60000}, "model": {}}
    for choice in ("friction", "bending", "initial_state", "contact", "section"):
        if r.random() < 0.4:
            document["model"][choice] = r.choice(WORDS[choice])
    if document["model"].get("friction") == "custom" and r.random() < 0.9 or r.random() < 0.05:
        document["friction_law"] = law()
    for quantity in r.sample(["k_r", "k_phi", "k_theta", "zeta_phi", "lambda_z", "phi_0_deg"], r.randint(0, 2)):
        document["model"][quantity] = value(quantity)
    return document


def law():
    n = r.randint(2, 9)
    speeds = [0, *sorted(float(f"{10 ** r.uniform(-3, 1):.3g}") for _ in range(n - 1))]
    return {"V_R": speeds, "mu": [0, *(float(f"{r.choice([1, 1, 1, 1e-9, 1e9, 1e-310]) * r.uniform(0.2, 2):.3g}") for _ in speeds[1:])],
            **({"between": r.choice(["pchip", "linear"])} if r.random() < 0.5 else {})}


def axes(document):
    """The quantities that a sample or a design may vary: of the load only the one that is given."""
    load = document["load"]
    other = "z_0" if load.get("R_n") else "R_n"
    return [name for name in RANGES if name != other and (name != "nominal_friction" or load.get("R_n"))]


def write_table(document):
    """A table of a random kind of writer. Returns its path and its values by column."""
    names = r.sample(axes(document), r.randint(1, 3))
    words = r.random() < 0.3
    rows = [[value(name) for name in names] + ([r.choice(WORDS["bending"])] if words else []) for _ in range(r.randint(1, 5))]
    header = names + (["bending"] if words else [])
    kinds = {"newline": r.choice(["\n", "\n", "\n", "\n", "\r\n", "\r\n", "\r"]), "separator": r.choice([",", ",", ",", ",", ",", ", ", ", ", ";", "\t"]),
             "bom": r.random() < 0.2, "quoted": r.random() < 0.2, "index": r.random() < 0.1, "comma": r.random() < 0.05,
             "number": r.choice(["{!r}", "{:.17g}", "{:e}", "{:+.6E}", " {!r} "]), "last": r.random() < 0.8,
             "bad": r.choice(["1e400", "1e-400", "nan", "inf", "", "x", "0x10", "1,5", "١", "1_0", "--1", "1e", "\0"]) if r.random() < 0.15 else None}
    lines = []
    for number, row in enumerate([header, *rows]):
        cells = [kinds["number"].format(cell) if isinstance(cell, float) else cell for cell in row]
        if kinds["comma"]:
            cells = [cell.replace(".", ",") if number else cell for cell in cells]
        if kinds["bad"] is not None and number == 1:
            cells[0] = kinds["bad"]
        if kinds["index"]:
            cells.insert(0, str(number - 1) if number else r.choice(["", "Unnamed: 0", "index"]))
        lines.append(kinds["separator"].join(f'"{cell}"' if kinds["quoted"] else cell for cell in cells))
        if r.random() < 0.1:
            lines.append(r.choice(["", "# a comment", "  "]))
    text = kinds["newline"].join(lines) + (kinds["newline"] if kinds["last"] else "")
    path = folder / "experiments" / r.choice(["rows.csv", "a table ü.csv"])
    path.write_bytes((b"\xef\xbb\xbf" if kinds["bom"] else b"") + text.encode())
    exact = kinds["bad"] is None and kinds["number"] in ("{!r}", "{:.17g}", " {!r} ")
    return path, {name: [row[i] for row in rows] for i, name in enumerate(names)} if exact else None


def distribution(name):
    low, high = sorted((value(name), value(name)))
    kind = r.choice(["uniform", "log", "normal", "values"])
    if kind == "normal":
        return {kind: [low, r.choice([0, 1e-9, 0.01, 0.1, 1]) * low]}
    return {kind: [low, high] if r.random() < 0.9 else [high, low]}


def sample(document):
    """Adds a sample to the experiment; returns the values of its columns if they are known."""
    known = None
    if r.random() < 0.6:
        path, known = write_table(document)
        block = {"table": path.name}
        if r.random() < 0.1:
            block["take"], known = [0], None
    else:
        over = {name: distribution(name) for name in r.sample(axes(document), r.randint(1, 3))}
        if r.random() < 0.3:
            choice = r.choice(list(WORDS))
            over[choice] = {"values": r.sample(WORDS[choice], 2)}
        block = {"sobol": r.choice([1, 2, 8, 16, 32]), "seed": r.randint(0, 9), "over": over}
    document["sweep"] = {"sample": block}
    if r.random() < 0.3:
        document["sweep"]["bending"] = {"values": r.sample(WORDS["bending"], 2)}
    if r.random() < 0.6:
        document["analysis"] = {"quantiles": r.sample(VARIABLES, r.randint(1, 2))}
        if "sobol" in block:
            document["analysis"]["sobol_indices"] = r.sample(VARIABLES, r.randint(1, 2))
    return known


def design(document):
    names = r.sample(axes(document), r.randint(1, 2))
    block = {"variables": {name: sorted((value(name), value(name))) for name in names}, "budget": r.randint(1, 6), "seed": r.randint(0, 99)}
    goal, tolerances = r.choice(["minimise", "maximise", "target"]), r.random() < 0.5
    block["objective"] = {goal: r.choice(VARIABLES), **({"value": r.choice([0, 1, 0.3, -1, 1e300])} if goal == "target" else {}),
                          **({"of": r.choice(["nominal", "mean", "q05", "q95", "least", "greatest"])} if tolerances else {})}
    if tolerances:
        block["tolerances"] = {name: {r.choice(["normal", "uniform"]): r.choice([1e-9, 0.01, 0.05, 0.2])}
                               for name in r.sample([*names, "k_theta", "zeta_phi"], r.randint(1, 2))}
        block["tolerance_samples"] = r.choice([2, 4, 8])
    if r.random() < 0.4:
        block["constraints"] = [r.choice([{"variable": r.choice(VARIABLES), r.choice(["min", "max"]): r.choice([-1, 0, 0.5, 2, 1e300])},
                                          {"jump_margin": r.choice([0.01, 0.1, 0.5])}])]
    document["design"] = block
    if r.random() < 0.3:
        document["sweep"] = {"V_s": {"values": [0.01, 0.05]}}


def attributes(result):
    with h5py.File(result) as file:
        return {name: file.attrs[name] for name in ("inputs_sha256", "payload_sha256")}


def follow_advice(texts, path):
    """Executes some of the options that messages advise, and the commands in them, on the same experiment."""
    for option in sorted(set(re.findall(r"(?<![\w`])--set (/\S+=[\w.+-]+)(?=[ ;,:)])", texts)))[:2]:
        code, _, error = command("validate", path, "--set", option)
        if code == 2 and "sample" not in error and "has no effect" not in error:
            raise Failure(f"the advised --set {option} is refused: {error}")
    for line in sorted(set(re.findall(r"^ *(?:build/)?bristle (run [^\n;]*)$", texts, re.M)))[:2]:
        code, _, error = command(*shlex.split(line), "--quiet")
        if code == 2:
            raise Failure(f"the advised command {line!r} is refused: {error}")


def override(path, document, result):
    """One value changed by --set and, in the same way, by Python."""
    name = r.choice(list(RANGES))
    block = "load" if name in ("R_n", "z_0", "nominal_friction") else "model"
    number = value(name)
    other = folder / "results/other.h5"
    other.unlink(missing_ok=True)
    code, out, error = command("run", path, "--set", f"/{block}/{name}={number}", "-o", other, "--quiet")
    if code == 2:
        kind = "refused overrides"
    elif code in (0, 1):
        kind = "overrides"
        if attributes(result)["inputs_sha256"] == attributes(other)["inputs_sha256"]:
            raise Failure(f"--set /{block}/{name}={number} changes nothing and is not refused: {json.dumps(document)}")
    else:
        kind = "overrides without values"
    if "design" in document or r.random() < 0.7:
        return kind
    from_python = folder / "results/python.h5"
    from_python.unlink(missing_ok=True)
    typed = r.choice([float, numpy.float64, numpy.array])(number)
    try:
        run(str(path), output=str(from_python), program=bristle.path, quiet=True, **{name: typed}).close()
    except BristleError as message:
        said(2, "", str(message), f"run({name}={number})")
        return "refused overrides in Python"
    if attributes(result)["inputs_sha256"] == attributes(from_python)["inputs_sha256"]:
        raise Failure(f"run(..., {name}={number}) changes nothing and is not refused: {json.dumps(document)}")
    return "overrides in Python"


def step():
    try:
        return attempt()
    except Failure as failure:
        kept = folder / f"failure-{campaign.counts['FAILED']}"
        shutil.copytree(folder / "experiments", kept)
        raise Failure(f"{failure} ({kept})") from None


def attempt():
    shutil.rmtree(folder / "results", ignore_errors=True)
    (folder / "results").mkdir()
    document, known = base("study"), None
    kind = r.choice(["sample", "sample", "design"])
    if kind == "sample":
        known = sample(document)
    else:
        design(document)
    path, result = folder / "experiments/study.json", folder / "results/study.h5"
    path.write_text(json.dumps(document))
    code, out, error = command("validate", path)
    if code != 0:
        if code != 2:
            raise Failure(f"validate: exit code {code}: {error}; {json.dumps(document)}")
        return f"{kind}s refused"
    code, out, error = command("run", path, "-o", result)
    if code == 2 or code == 3 and "no point could be computed" not in error:
        raise Failure(f"run: exit code {code} after validate accepted it: {error}; {json.dumps(document)}")
    if code == 3:
        return f"{kind}s without any point that can be computed"
    with h5py.File(result) as file:
        for name, values in (known or {}).items():
            stored = file[{"R_n": "R_n_target", "z_0": "z_0_target"}.get(name, name)][...]
            if not numpy.array_equal(stored, numpy.array(values)):
                raise Failure(f"the column {name} was read as {stored} for {values}: {json.dumps(document)}")
    texts = out + error
    for words in (["info", result], ["check", result, "--report-only"], ["run", path, "-o", result], ["export", result]):
        code, out, error = command(*words, allowed={0, 1})
        texts += out + error
    follow_advice(texts, path)
    if r.random() < 0.5:
        return override(path, document, result)
    if r.random() < 0.2:
        return archived(path)
    return f"{kind}s"


def archived(path):
    """The experiment in an archive, whose points are computed again."""
    repository = folder / "repository"
    shutil.rmtree(repository, ignore_errors=True)
    repository.mkdir()
    subprocess.run([source / "tests/program/small_repository.sh", bristle.path, source], cwd=repository, check=True)
    for file in path.parent.iterdir():
        if file.name != "paper.json":
            shutil.copy(file, repository / "experiments")
    for name in ("quick", "study"):
        bristle("run", f"experiments/{name}.json", "--quiet", cwd=repository, allowed={0, 1}, seconds=300)
        for ending in ("pdf", "png"):
            (repository / f"figures/{name}.{ending}").write_bytes(attributes(repository / f"results/{name}.h5")["payload_sha256"])
    bristle("assumptions", "--tier", "full", "-q", cwd=repository, allowed={0}, seconds=300)
    for words in (["archive", "--allow-dirty", "-o", "whole.tar"], ["verify", "whole.tar", "--rerun", "20"]):
        code, out, error = said(*bristle(*words, cwd=repository, seconds=300), shlex.join(words))
        if code != 0:
            raise Failure(f"{shlex.join(words)}: exit code {code}: {out[-500:]}{error[-500:]}; {path.read_text()}")
    return "archives"


campaign = Campaign("studies", seconds)
campaign.repeat(step)
print(f"slowest: {bristle.slowest[0]:.1f} s: {bristle.slowest[1]}")
sys.exit(0 if campaign.report() else 1)
