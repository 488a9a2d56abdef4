"""Damaged and crafted files: every command that reads one ends within seconds with 0 to 3, and says what is wrong.

files.py BRISTLE SECONDS SEED FOLDER
"""
import pathlib
import random
import shutil
import sys

import h5py
import numpy

from common import Campaign, Failure, Program, damaged

bristle, seconds, seed, folder = Program(sys.argv[1]), float(sys.argv[2]), sys.argv[3], pathlib.Path(sys.argv[4])
experiments = pathlib.Path(__file__).resolve().parents[2] / "experiments"
r = random.Random(f"files {seed}")
SECONDS = 30  # for one command

folder.mkdir(parents=True, exist_ok=True)
few = ["--set", '/sweep={"k_r":{"values":[5,20]}}', "--set", '/load={"R_n":null,"path":null,"z_0":0.5}', "--set",
       '/orientation={"sampling":"list","theta_0_deg":[10,100,170]}', "--quiet"]
whole = folder / "whole.h5"
bristle("run", experiments / "paper.json", *few, "--set", '/record=["bristles"]', "-o", whole, allowed={0})
journal = pathlib.Path(f"{whole}.journal")
intact = {"result": whole, "journal": journal}
digest = {whole: bristle("info", whole, allowed={0})[1].split("payload sha256 ")[1].split()[0]}


def crafted(path):
    """A valid HDF5 file with something that no result has. Returns what it is."""
    shutil.copy(whole, path)
    kind = r.choice(["cycle", "soft link", "external link", "virtual dataset", "huge", "bomb", "deep", "many groups",
                     "changed value", "NaN", "experiment", "wrong type", "long attribute", "missing", "old version"])
    with h5py.File(path, "r+") as f:
        name = r.choice([n for n in f if isinstance(f[n], h5py.Dataset)])
        if kind == "cycle":
            f["provenance/again"] = f["/"]
        elif kind == "soft link":
            f["link"] = h5py.SoftLink("/link")
        elif kind == "external link":
            f["link"] = h5py.ExternalLink("/dev/zero", "/")
        elif kind == "virtual dataset":
            layout = h5py.VirtualLayout(shape=(1 << 20,), dtype="f8")
            layout[:] = h5py.VirtualSource("/dev/zero", "x", shape=(1 << 20,))
            f.create_virtual_dataset("virtual", layout)
        elif kind == "huge":
            f.create_dataset("huge", shape=(1 << 40,), dtype="f8", chunks=(1 << 16,))
        elif kind == "bomb":
            f.create_dataset("bomb", data=numpy.zeros(1 << 22), compression="gzip", compression_opts=9)
        elif kind == "deep":
            f.create_group("/".join("deep" for _ in range(r.choice([10, 200, 2000]))))
        elif kind == "many groups":
            for i in range(12000):
                f.create_group(f"g{i}")
        elif kind in ("changed value", "NaN"):
            while f[name].dtype.kind != "f" or f[name].size == 0:
                name = r.choice([n for n in f if isinstance(f[n], h5py.Dataset)])
            values = f[name][...]
            values.flat[r.randrange(values.size)] = r.random() if kind == "changed value" else numpy.nan
            if numpy.array_equal(values, f[name][...], equal_nan=True):
                return "no change"
            f[name][...] = values
        elif kind == "experiment":
            text = f.attrs["experiment"]
            f.attrs["experiment"] = numpy.bytes_(damaged(text if isinstance(text, bytes) else text.encode(), r))
        elif kind == "wrong type":
            f.attrs[r.choice(list(f.attrs))] = r.choice([1, 2.5, [1, 2, 3], "x", numpy.zeros(3)])
        elif kind == "long attribute":
            f.attrs["title"] = "x" * 60000
        elif kind == "missing":
            del f[name]
        else:
            f.attrs["schema_version"] = "bristle-result/0"
    return kind


# What leaves the numbers and the experiment as they are, and so may go unnoticed.
HARMLESS = {"no change", "long attribute", "wrong type"}


def step():
    what, source = r.choice(list(intact.items()))
    victim = folder / "victim.h5"
    for old in folder.glob("victim*"):
        old.unlink()
    if what == "result" and r.random() < 0.5:
        kind = crafted(victim)
        code, out, error = bristle("info", victim, seconds=SECONDS)
        if code == 0 and kind not in HARMLESS:
            raise Failure(f"info says nothing about {kind}: {out[:200]}")
        for command in (["check", "--claims-only", victim], ["diff", victim, whole]):
            code, out, error = bristle(*command, seconds=SECONDS)
            if code == 0 and kind not in HARMLESS:
                raise Failure(f"{command[0]} says nothing about {kind}: {out[:200]}")
        return f"crafted files"
    if what == "journal":
        ending = r.choice(["journal", "1-of-2.journal"])  # its own, or one of which it takes over points
        pathlib.Path(f"{victim}.{ending}").write_bytes(damaged(journal.read_bytes(), r))
        code, out, error = bristle("run", experiments / "paper.json", *few, "--set", '/record=["bristles"]', "-o", victim,
                                   seconds=SECONDS)
        if code == 0 and digest[whole] not in bristle("info", victim)[1]:
            raise Failure(f"a damaged journal changed the numbers: {out}{error}")
        return "damaged journals"
    victim.write_bytes(damaged(source.read_bytes(), r))
    for command in [["info", victim], ["check", "--claims-only", victim], ["diff", whole, victim],
                    ["run", experiments / "paper.json", *few, "--set", '/record=["bristles"]', "-o", victim]]:
        code, out, error = bristle(*command, seconds=SECONDS)
        if command[0] == "run" and code == 0 and digest[whole] not in bristle("info", victim)[1]:
            raise Failure("run accepted a damaged result")
    return f"damaged {what}s"


campaign = Campaign("files", seconds)
campaign.repeat(step)
print(f"slowest: {bristle.slowest[0]:.1f} s: {bristle.slowest[1]}")
sys.exit(0 if campaign.report() else 1)
