"""Wall time, CPU time and memory of experiments' full tiers, computed anew: JSON on standard output.

time_experiments.py BRISTLE EXPERIMENT.json... [OPTION of `bristle run`...]
An experiment outside the folder experiments/ extends one there by its name.
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
            start = time.perf_counter()
            process = subprocess.Popen([sys.argv[1], "run", os.path.join(work, f"{name}.json"), "--force", "--quiet", "-o", output,
                                        *options], stdout=sys.stderr)
            _, status, used = os.wait4(process.pid, 0)
            if status != 0:
                sys.exit(f"{file}: the run failed")
            found = {"seconds": round(time.perf_counter() - start, 2), "cpu_seconds": round(used.ru_utime + used.ru_stime, 2),
                     "MB": round(used.ru_maxrss / 1024)}
            with h5py.File(output) as result:
                passages, title = result["passages"][()], result.attrs["title"].decode()
            rows.append({"name": name, "title": title, "points": passages.size, "passages": int(passages.sum()), **found})
    print(json.dumps(rows, indent=1))


main()
