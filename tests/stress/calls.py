"""Makes every system call by which bristle writes files fail once, and looks at what is left.

usage: calls.py BRISTLE [SECONDS]: at most about this long (default 60); the calls are then a random selection.

After each failure the program must have ended by itself, with exit code 3 (or 2) and a message that names a file, or
with 0 and the whole new file; the file must be the old or the new one; and the same command must then succeed.
"""
import collections
import errno
import hashlib
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

bristle, seconds = os.path.abspath(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 60
here = pathlib.Path(__file__).parent
seed = int(os.environ.get("SEED", random.randrange(10**6)))
random.seed(seed)

CALLS = {"open": (errno.ENOSPC, errno.EIO), "write": (errno.ENOSPC, errno.EIO, errno.EINTR),
         "fsync": (errno.ENOSPC, errno.EIO), "rename": (errno.ENOSPC, errno.EIO), "ftruncate": (errno.EIO,),
         "close": (errno.EIO, errno.ENOSPC)}
SMALL = ["--quiet", "--set", '/sweep={"k_r":{"values":[2,5,10]}}', "--set", '/load={"R_n":null,"z_0":0.5}',
         "--set", '/orientation={"sampling":"list","theta_0_deg":[10,100]}', "--set", "/integrator/engine=reference"]


def run(command, folder, fail=None):
    environment = {**os.environ, **(fail or {})}
    if fail:
        environment.update(LD_PRELOAD=str(library), FAIL_PROGRAM="bristle")
    return subprocess.run([bristle, *command], cwd=folder, env=environment, capture_output=True, text=True, timeout=120)


def expect(command, folder):
    done = run(command, folder)
    assert done.returncode == 0, (command, done.stderr)


# The digest of a whole output; none if it is not there, cannot be read or does not verify.
def of_result(path):
    lines = run(["info", str(path)], path.parent).stdout.splitlines()
    return next((line for line in lines if line.endswith("(verified)")), None)


def of_archive(path):
    verified = run(["verify", str(path)], path.parent).returncode == 0
    return hashlib.sha256(path.read_bytes()).hexdigest() if verified else None


# Each prepares a folder and returns the command, its output and the digest of that.
def prepare_run(folder):
    expect(["run", paper, *SMALL, "-o", "r.h5", "--set", "/model/k_phi=2.5"], folder)
    (folder / "r.h5.journal").unlink()
    return ["run", paper, *SMALL, "-o", "r.h5"], "r.h5", of_result


def prepare_complete(folder):
    prepare_run(folder)
    for part in ("1", "2"):
        expect(["run", paper, *SMALL, "--shard", f"{part}/2", "-o", "r.h5"], folder)
    return ["run", paper, *SMALL, "--complete", "-o", "r.h5"], "r.h5", of_result


def prepare_archive(folder):
    """The archive of before had other figures."""
    subprocess.run([here / "../program/small_repository.sh", bristle, here.parents[1]], cwd=folder, check=True)
    expect(["run", "experiments/quick.json", "--quiet"], folder)
    expect(["assumptions", "--tier", "full", "-q"], folder)
    for content in ("before", "now"):
        for ending in ("pdf", "png"):
            (folder / f"figures/quick.{ending}").write_text(content + run(["info", "results/quick.h5"], folder).stdout)
        if content == "before":
            expect(["archive", "--allow-dirty", "-o", "a.tar"], folder)
    return ["archive", "--allow-dirty", "-o", "a.tar"], "a.tar", of_archive


def attempt(name, command, output, digest, start, call, at, error):
    """What is wrong after this failure; none if nothing is."""
    folder = scratch / "here"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(start, folder)
    done = run(command, folder, {"FAIL_CALL": call, "FAIL_AT": str(at), "FAIL_ERRNO": str(error)})
    left, (old, new) = digest(folder / output), digests[name]
    outcomes[name, call, done.returncode] += 1
    if done.returncode not in (0, 2, 3):
        return f"exit code {done.returncode}: {done.stderr[-300:]}"
    if done.returncode and not any(word in done.stderr for word in (output, "results", "figures")):
        return f"the message names no file: {done.stderr[-300:]}"
    if left not in (old, new) or (done.returncode == 0 and left != new):
        return f"exit code {done.returncode}, and the output is neither the old nor the new one: {left}"
    again = run(command, folder)
    if again.returncode or digest(folder / output) != new:
        return f"the same command again: exit code {again.returncode}: {again.stderr[-300:]}"
    if any(path.name.endswith(".partial") for path in folder.iterdir()):
        return "a partial file is left"
    return None


with tempfile.TemporaryDirectory() as name:
    scratch = pathlib.Path(name)
    library = scratch / "failing_calls.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library, here / "failing_calls.c", "-ldl"], check=True)
    paper = str((here / "../../experiments/paper.json").resolve())
    digests, jobs, outcomes, failures = {}, [], collections.Counter(), []
    for name, prepare in (("run", prepare_run), ("complete", prepare_complete), ("archive", prepare_archive)):
        start = scratch / name
        start.mkdir()
        command, output, digest = prepare(start)
        old = digest(start / output)
        for call, errors in CALLS.items():
            count = scratch / "count"
            shutil.copytree(start, scratch / "tried")
            done = run(command, scratch / "tried", {"FAIL_CALL": call, "FAIL_AT": "0", "FAIL_COUNT": str(count)})
            assert done.returncode == 0, done.stderr
            digests[name] = old, digest(scratch / "tried" / output)
            total = int(count.read_text())
            print(f"{name}: {total} calls of {call}")
            jobs += [(name, command, output, digest, start, call, at, error) for at in range(1, total + 1) for error in errors]
            shutil.rmtree(scratch / "tried")
        assert None not in digests[name] and len({*digests[name]}) == 2, digests
    random.shuffle(jobs)
    end, tried = time.monotonic() + seconds, 0
    for job in jobs:
        if time.monotonic() > end:
            break
        tried += 1
        wrong = attempt(*job)
        if wrong:
            failures.append(f"{job[0]}: {job[-3]} number {job[-2]} fails with {errno.errorcode[job[-1]]}: {wrong}")
            print("FAILED:", failures[-1])

for (name, call, code), count in sorted(outcomes.items()):
    print(f"{name}, {call}: exit code {code} {count} times")
print(f"{tried} of {len(jobs)} failures were tried, seed {seed}; {len(failures)} are wrong")
sys.exit(bool(failures))
