"""Processor time and memory of the commands on finished results of many points: JSON on standard output.

time_commands.py BRISTLE [KIND:POINTS...], of the kinds sweep and sample; by default both with 1e3 and 1e5 points.
"""
import glob
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

PYTHON = sys.executable
HERE = os.path.dirname(os.path.abspath(__file__))
os.environ["PYTHONPATH"] = os.path.join(os.path.dirname(HERE), "python")
# One azimuth at a gap near first contact: a point takes a fraction of a millisecond.
QUICK = {"extends": "paper.json", "figure": "0", "load": {"z_0": 0.97, "R_n": None, "path": None},
         "orientation": {"sampling": "list", "theta_0_deg": [160], "rtol": None},
         "checks": [{"claim": "x", "statement": "R_x is positive", "predicate": "level", "variable": "R_x", "along": "k_r",
                     "is": "at_least", "threshold": 0}]}


def experiments(points):
    """An experiment of each kind: name and document, and the text of its table."""
    rows = "".join(f"{5 + 35 * i / points!r},{1e4 + 3e4 * ((7919 * i) % points) / points!r}\n" for i in range(points))
    sweep = {"k_r": {"logspace": [5, 40, points // 10]}, "k_theta": {"linspace": [1, 2, 10]}}
    sample = {**QUICK, "checks": None, "sweep": {"sample": {"table": "rows.csv"}}}
    return {"sweep": {**QUICK, "sweep": sweep}, "sample": sample}, "k_r,tau_f\n" + rows


def timed(arguments, allowed=(0,)):
    """Processor time (s) of a command and its children, and its largest memory (MB); None if it was refused."""
    process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    error = process.stderr.read().decode()
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in allowed:
        print(f"{' '.join(arguments)}: {error}", file=sys.stderr)
        return None
    return {"seconds": round(used.ru_utime + used.ru_stime, 2), "MB": round(used.ru_maxrss / 1024)}


def repository(bristle):
    """Makes the working folder a repository from which an archive can be made."""
    source = os.path.dirname(HERE)
    for name in ("CITATION.cff", "LICENSE", "LICENSE-DATA"):
        shutil.copy(os.path.join(source, name), ".")
    for folder in ("experiments", "figures", "reference"):
        os.makedirs(folder)
    shutil.copy(os.path.join(source, "experiments/paper.json"), "experiments")
    version = subprocess.run([bristle, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
    with open("CITATION.cff", encoding="utf-8") as file:
        lines = [f"version: {version}\n" if line.startswith("version:") else line for line in file]
    with open("CITATION.cff", "w", encoding="utf-8") as file:
        file.writelines(lines)
    with open(".gitignore", "w", encoding="utf-8") as file:
        file.write("/results/\n/figures/\n/report/\n/dist/\n")


def commit():
    identity = ["-c", "user.name=n", "-c", "user.email=e"]
    for command in (["init", "-q"], ["add", "."], [*identity, "commit", "-qm", "m"]):
        subprocess.run(["git", *command], check=True)


def draw(name, result):
    """Figures that say of which result they are, as `scripts/plot` writes them."""
    info = subprocess.run([BRISTLE, "info", result], capture_output=True, text=True, check=True).stdout
    digest = next(line.split()[2] for line in info.splitlines() if line.startswith("payload sha256"))
    for ending in ("pdf", "png"):
        with open(f"figures/{name}.{ending}", "w", encoding="utf-8") as file:
            file.write(f"payload_sha256 {digest}")


def measure(kind, document, table):
    """Times of all commands on one result."""
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        repository(BRISTLE)
        with open("experiments/rows.csv", "w", encoding="utf-8") as file:
            file.write(table)
        with open(f"experiments/{kind}.json", "w", encoding="utf-8") as file:
            json.dump({"schema": "bristle-experiment/1", "name": kind, "title": kind, **document,
                       "tiers": {"smoke": {}}}, file)
        commit()
        result, smoke = f"results/{kind}.h5", f"results/{kind}-smoke.h5"
        run = [BRISTLE, "run", f"experiments/{kind}.json", "--quiet"]
        rows = {"run": timed([*run, "-o", result]), "run, up to date": timed([*run, "-o", result])}
        os.remove(result)
        rows["run, all points in the journal"] = timed([*run, "-o", result])
        subprocess.run([*run, "--tier", "smoke", "-o", smoke], check=True)
        rows["info"] = timed([BRISTLE, "info", result])
        rows["check --claims-only"] = timed([BRISTLE, "check", "--claims-only", result], (0, 1))
        rows["check --json"] = timed([BRISTLE, "check", "--json", result], (0, 1))
        rows["export"] = timed([BRISTLE, "export", result])
        rows["diff"] = timed([BRISTLE, "diff", result, smoke])
        with h5py.File(smoke, "r+") as file:  # as if by a program without uncommitted changes
            for name in ("commit", "points_commits"):
                file["provenance"].attrs[name] = np.bytes_("0123456789")
        rows["reference update"] = timed([BRISTLE, "reference", "update", smoke, "--reason", "first"])
        rows["check"] = timed([BRISTLE, "check", "--report-only", result], (0, 1))
        draw(kind, result)
        rows["archive"] = timed([BRISTLE, "archive", "--allow-dirty"])
        rows["verify"] = timed([BRISTLE, "verify", *glob.glob("dist/*.tar")])
        rows["run --point"] = timed([BRISTLE, "run", result, "--quiet", "--point", "7", "-o", "results/replay.h5"])
        rows["report"] = timed([PYTHON, "-m", "bristle.report", result, "--program", BRISTLE])
        os.chdir("/")
    return rows


BRISTLE = os.path.abspath(sys.argv[1])
begin = time.time()
out = []
for wanted in sys.argv[2:] or [f"{name}:{10 ** power}" for power in (3, 5) for name in ("sweep", "sample")]:
    kind_of, count = wanted.split(":")
    documents, csv = experiments(int(count))
    out.append({"kind": kind_of, "points": int(count), "commands": measure(kind_of, documents[kind_of], csv)})
print(json.dumps({"results": out, "seconds": round(time.time() - begin)}, indent=1))
