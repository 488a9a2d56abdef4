"""CPU time (s) of `make build` and `make test`, one after the other, in a fresh clone: JSON on standard output.

time_build.py [SOURCE]
"""
import json
import os
import subprocess
import sys
import tempfile


def cpu_seconds(target, folder):
    process = subprocess.Popen(["make", target], cwd=folder, stdout=sys.stderr)
    _, status, used = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"make {target} failed")
    return round(used.ru_utime + used.ru_stime)


source = sys.argv[1] if len(sys.argv) > 1 else "."
with tempfile.TemporaryDirectory() as folder:
    subprocess.run(["git", "clone", "--quiet", source, folder], check=True)
    print(json.dumps({target: cpu_seconds(target, folder) for target in ("build", "test")}))
