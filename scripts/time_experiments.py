"""Wall time and CPU time of experiments' full tiers, computed anew: JSON on standard output.

time_experiments.py BRISTLE EXPERIMENT.json... [OPTION of `bristle run`...]
An experiment outside the folder experiments/ extends one there by its name.
"""
import glob
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time

import h5py


def cpu_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main():
    rows = []
    with tempfile.TemporaryDirectory() as work:
        files = [argument for argument in sys.argv[2:] if argument.endswith(".json")]
        options = sys.argv[2 + len(files):]
        for file in [*glob.glob("experiments/*.json"), *files]:
            shutil.copy(file, work)
        for file in files:
            name = os.path.splitext(os.path.basename(file))[0]
            output = os.path.join(work, f"{name}.h5")
            wall, cpu = time.perf_counter(), cpu_seconds()
            subprocess.run([sys.argv[1], "run", os.path.join(work, f"{name}.json"), "--force", "--quiet", "-o", output, *options],
                           check=True, stdout=sys.stderr)
            times = {"seconds": round(time.perf_counter() - wall, 2), "cpu_seconds": round(cpu_seconds() - cpu, 2)}
            with h5py.File(output) as result:
                passages, title = result["passages"][()], result.attrs["title"].decode()
            rows.append({"name": name, "title": title, "points": passages.size, "passages": int(passages.sum()), **times})
    print(json.dumps(rows, indent=1))


main()
