"""Mutated experiments: what `validate` accepts, `run` computes or gives a status; all else has a message.

experiments.py BRISTLE SECONDS SEED FOLDER
"""
import copy
import json
import pathlib
import random
import sys

from common import Campaign, Failure, Program

bristle, seconds, seed, folder = Program(sys.argv[1]), float(sys.argv[2]), sys.argv[3], pathlib.Path(sys.argv[4])
sources = sorted((pathlib.Path(__file__).resolve().parents[2] / "experiments").glob("*.json"))
r = random.Random(f"experiments {seed}")
folder.mkdir(parents=True, exist_ok=True)

NUMBERS = [0, -1, 1, 0.5, 2, 1e-300, 1e-12, 1e-6, 1e6, 1e12, 1e300, -1e300, 10**18, 10**30, 7, 90, 0.985]
OTHERS = [None, True, "", "x", "nss", "coulomb", [], {}, [1], [1, 2], [2, 1], {"values": [1]}, "\u2028"]


def places(value, at=()):
    """Paths to all values of a document."""
    yield at
    if isinstance(value, dict):
        for key in value:
            yield from places(value[key], at + (key,))
    elif isinstance(value, list):
        for i in range(len(value)):
            yield from places(value[i], at + (i,))


def mutate(document):
    at = r.choice([p for p in places(document) if p and (p[0] != "checks" or r.random() < 0.1)])
    parent = document
    for key in at[:-1]:
        parent = parent[key]
    old = parent[at[-1]]
    kind = r.random()
    if kind < 0.8 and isinstance(old, (int, float)):
        parent[at[-1]] = r.choice([r.choice(NUMBERS), old * 10 ** r.uniform(-1, 1), old * 10 ** r.uniform(-3, 3)])
    elif kind < 0.85:
        parent[at[-1]] = r.choice(NUMBERS + OTHERS)
    elif kind < 0.9:
        del parent[at[-1]]
    elif kind < 0.95 and isinstance(parent, dict):
        parent[r.choice(["k_r", "z_0", "x", str(at[-1]) + "_", "R_n"])] = copy.deepcopy(old)
    else:
        others = [p for p in places(document) if p]
        other = r.choice(others)
        source = document
        for key in other:
            source = source[key]
        parent[at[-1]] = copy.deepcopy(source)


def step():
    document = json.loads(r.choice(sources).read_text())
    document.pop("tiers", None)
    for _ in range(r.choice([1, 1, 2, 4])):
        mutate(document)
    path, result = folder / "mutated.json", folder / "mutated.h5"
    (folder / "paper.json").write_text(next(s for s in sources if s.name == "paper.json").read_text())
    path.write_text(json.dumps(document))
    if r.random() < 0.05:
        data = bytearray(path.read_bytes())
        data[r.randrange(len(data))] = r.randrange(256)
        path.write_bytes(bytes(data))
    for old in folder.glob("mutated.h5*"):
        old.unlink()
    # A small amount of work for each point, so that many experiments can be tried.
    bounds = ["--set", "/integrator/max_evaluations=20000", "--set", "/integrator/max_evaluations_per_point=100000"]
    code, out, error = bristle("validate", path, *bounds, seconds=60)
    if code != 0:
        if code != 2:
            raise Failure(f"validate: exit code {code}: {error}; {json.dumps(document)}")
        return "refused"
    points = int(out.split("valid. ")[1].split(": ")[1].split()[0])
    if points > 60 or '"lattice"' in path.read_text():
        return "valid, too large to compute here"
    code, out, error = bristle("run", path, *bounds, "-o", result, "--quiet", seconds=300)
    if code == 3 and "no point could be computed" not in error or code == 2:
        raise Failure(f"run: exit code {code} after validate accepted it: {error}; {json.dumps(document)}")
    bristle("info", result, allowed={0})
    return "computed" if code == 0 else "without any point that can be computed"


campaign = Campaign("experiments", seconds)
campaign.repeat(step)
print(f"slowest: {bristle.slowest[0]:.1f} s: {bristle.slowest[1]}")
sys.exit(0 if campaign.report() else 1)
