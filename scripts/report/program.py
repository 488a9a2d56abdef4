"""What the program says of a result: drift, replay commands, whether the numbers are intact."""

import json
import subprocess

from style import fail


def run(arguments):
    try:
        return subprocess.run(arguments, capture_output=True, text=True, check=False)
    except OSError as error:
        fail(f"{arguments[0]}: cannot be run ({error.strerror}); `make build` makes it")


def check(program, path, reference):
    """Drift and replay commands of the result."""
    done = run([program, "check", path, "--json", "--report-only", "--reference", reference])
    if done.returncode not in (0, 1):
        fail(f"{path}: `bristle check --json` ended with {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def intact(program, path):
    """Whether the payload has the digest that the file says."""
    done = run([program, "info", path])
    if done.returncode not in (0, 1):
        fail(f"{path}: `bristle info` ended with {done.returncode}: {done.stderr.strip()}")
    return done.returncode == 0


def outcome(drift):
    """Sign, kind and words for the comparison with the reference."""
    if drift is None:
        return {"sign": "\u2013", "kind": "missing", "text": "no reference"}
    if drift["failed"]:
        return {"sign": "\u2718", "kind": "refuted",
                "text": f"{drift['above']} beyond tolerance, {len(drift['failures'])} other failures"}
    if drift["differ"] == 0:
        return {"sign": "\u2714", "kind": "supported", "text": "the same, bit for bit"}
    worst = drift["worst"][0]["tolerances"]
    return {"sign": "\u2714", "kind": "supported",
            "text": f"within tolerance: {drift['differ']} differ, by at most {worst:.2g} of it"}
