"""Random experiments give the same bits with any threads, instruction sets and shards.

ways.py BRISTLE SECONDS SEED FOLDER
"""
import json
import math
import pathlib
import random
import re
import sys

from common import Campaign, Failure, Program
from physics import experiment

bristle, seconds, seed, folder = Program(sys.argv[1]), float(sys.argv[2]), sys.argv[3], pathlib.Path(sys.argv[4])
r = random.Random(f"ways {seed}")
folder.mkdir(parents=True, exist_ok=True)
whole, other, path = folder / "whole.h5", folder / "other.h5", folder / "random.json"
SECONDS = 300  # for one run


def digest(result):
    out = bristle("info", result, allowed={0})[1]
    return re.search(r"^payload sha256 (\w+) \(verified\)$", out, re.M).group(1)


def sets():
    """The instruction sets of this machine, as the program names them when it refuses another one."""
    error = bristle("run", path, "-o", whole, "--instruction-set", "none", allowed={2})[2]
    return re.search(r"allowed: (.*)", error).group(1).split(", ")


def draw():
    """A random point of the physics campaign, swept over the friction law or the velocity."""
    document = experiment(f"{seed}/{r.random()}")
    axis, values = r.choice([("mu_c", [0.5, 1, 2]), ("friction", ["nss", "coulomb"]), ("phi_0_deg", [70, 75, 80])])
    document["sweep"] = {axis: {"values": values}}
    if axis == "phi_0_deg" and "z_0" in document["load"]:  # first contact is lower for the smallest angle
        document["load"]["z_0"] = min(document["load"]["z_0"], math.sin(math.radians(min(values))))
    document["integrator"]["max_evaluations_per_point"] = 3_000_000  # a point that takes longer has no values
    document["record"] += r.sample(["bristles"], r.randint(0, 1))
    return document


def step():
    for old in folder.glob("*.h5*"):
        old.unlink()
    document = draw()
    path.write_text(json.dumps(document))
    run = ["run", path, "--quiet"]
    code, _, error = bristle(*run, "-o", whole, "--threads", "1", seconds=SECONDS)
    if code != 0:
        if code == 3 and ("no static equilibrium" in error or "no point could be computed" in error):
            return "experiments without values"
        raise Failure(f"exit code {code}: {error}; {json.dumps(document)}")
    available = sets()
    ways = [["--instruction-set", name, "--threads", str(r.randint(1, 4))] for name in available]
    ways.append(["--threads", str(r.randint(2, 16))])
    for way in ways:
        bristle(*run, "--force", "-o", other, *way, seconds=SECONDS, allowed={0})
        if digest(other) != digest(whole):
            raise Failure(f"{' '.join(way)} gives other bits: {json.dumps(document)}")
    parts = r.randint(2, 3)
    for part in r.sample(range(1, parts + 1), parts):
        bristle(*run, "--force", "--shard", f"{part}/{parts}", "--instruction-set", r.choice(available),
                "-o", folder / "shards.h5", seconds=SECONDS, allowed={0, 3})
    bristle(*run, "--complete", "-o", folder / "shards.h5", seconds=SECONDS, allowed={0})
    if digest(folder / "shards.h5") != digest(whole):
        raise Failure(f"{parts} shards give other bits: {json.dumps(document)}")
    return f"experiments by {', '.join(available)}, several threads and shards"


campaign = Campaign("ways", seconds)
campaign.repeat(step)
sys.exit(0 if campaign.report() else 1)
