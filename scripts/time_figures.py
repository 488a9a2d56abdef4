"""Wall time and CPU time of every figure's full tier, computed anew: JSON on standard output.

time_figures.py BRISTLE FIGURE...
"""
import json
import os
import resource
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
        for figure in sys.argv[2:]:
            output = os.path.join(work, f"{figure}.h5")
            wall, cpu = time.perf_counter(), cpu_seconds()
            subprocess.run([sys.argv[1], "run", f"experiments/{figure}.json", "--force", "--quiet", "-o", output],
                           check=True, stdout=sys.stderr)
            times = {"seconds": round(time.perf_counter() - wall, 2), "cpu_seconds": round(cpu_seconds() - cpu, 2)}
            with h5py.File(output) as result:
                passages = result["passages"][()]
            rows.append({"figure": figure, "points": passages.size, "passages": int(passages.sum()), **times})
    print(json.dumps(rows, indent=1))


main()
