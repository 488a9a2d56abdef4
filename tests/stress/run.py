"""The stress campaign: random physics, samples and designs, equal bits, damaged and crafted files, archives and pages, mutated
experiments, kills, failing system calls, job arrays.

run.py BRISTLE [--seconds S] [--seed SEED] [PART ...]: runs the parts one after the other, each for its share of the
time, and ends with their counts. Exit code 1 if a part found a failure; its files then stay in the printed folder.
"""
import argparse
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
# The share of the time of each part.
SHARES = {"physics": 0.25, "studies": 0.1, "ways": 0.1, "files": 0.1, "archives": 0.07, "pages": 0.1, "experiments": 0.1,
          "kills": 0.06, "calls": 0.06, "slurm": 0.06}
SKIPPED = 77  # exit code of a test whose programs are not installed


def python(script, *arguments):
    return subprocess.run([sys.executable, str(HERE / script), *map(str, arguments)]).returncode


def kills(bristle, seconds, seed):
    """Repeats the survival test with few kills each, so that it ends in time."""
    killed, begin, times = 0, time.monotonic(), 0
    while times == 0 or time.monotonic() - begin < seconds:
        done = subprocess.run([str(ROOT / "tests/program/survive_test.sh"), bristle, "8"], cwd=ROOT, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              env={"PATH": "/usr/bin:/bin", "SEED": str((seed + times) % 32768)})
        times += 1
        killed += 8
        if done.returncode != 0:
            print(f"kills: FAILED with SEED={(seed + times - 1) % 32768}:\n{done.stdout}")
            return 1
    print(f"kills: at least {killed} kills of running programs, {times} times each: interrupts, limited file sizes, "
          "a full disk, two runs at once")
    return 0


def slurm(bristle, seconds):
    """Repeats the test of a cluster of one node, in which tasks fail and are cancelled."""
    begin, times = time.monotonic(), 0
    while times == 0 or time.monotonic() - begin < seconds:
        done = subprocess.run([str(ROOT / "tests/program/slurm_test.sh"), bristle], cwd=ROOT, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode == SKIPPED:
            print(f"slurm: {done.stdout.strip()}")
            return 0
        times += 1
        if done.returncode != 0:
            print(f"slurm: FAILED:\n{done.stdout}")
            return 1
    print(f"slurm: {times} job arrays with failed and cancelled tasks, each completed by the same command")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bristle")
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("parts", nargs="*", help=f"of {', '.join(SHARES)} [all]")
    o = parser.parse_intermixed_args()
    parts = o.parts or list(SHARES)
    if set(parts) - set(SHARES):
        parser.error(f"unknown part; allowed: {', '.join(SHARES)}")
    seed = o.seed if o.seed is not None else random.SystemRandom().randrange(1 << 31)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="bristle-stress-"))
    bristle = shutil.copy(o.bristle, folder / "bristle")  # a build beside the campaign does not disturb it
    print(f"seed {seed}; files in {folder}", flush=True)
    whole, failed = sum(SHARES[p] for p in parts), []
    for part in parts:
        seconds = o.seconds * SHARES[part] / whole
        sys.stdout.flush()
        if part == "physics":
            code = python("physics.py", bristle, "--points", 10**9, "--seconds", seconds, "--seed", seed,
                          "--folder", folder / part)
        elif part == "kills":
            code = kills(str(bristle), seconds, seed)
        elif part == "slurm":
            code = slurm(str(bristle), seconds)
        elif part == "calls":
            os.environ["SEED"] = str(seed)
            code = python("calls.py", bristle, seconds)
        else:
            code = python(f"{part}.py", bristle, seconds, seed, folder / part)
        if code != 0:
            failed.append(part)
    if failed:
        print(f"stress: FAILED: {', '.join(failed)}; seed {seed}; files in {folder}")
        return 1
    shutil.rmtree(folder)
    print(f"stress: nothing found in {o.seconds:g} s, seed {seed}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
