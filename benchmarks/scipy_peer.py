"""SciPy's solve_ivp on the first bristles of the benchmark's sample; JSON on standard output.

The equations are the compiled ones of the project (scipy_slopes.cpp), so that the times are those of SciPy's stepping.
"""

import ctypes
import json
import sys
import time

import numpy as np

try:
    from scipy.integrate import solve_ivp
except ImportError:
    print("SciPy is not installed (package python3-scipy) and is omitted", file=sys.stderr)
    print("[]")
    raise SystemExit(0)

COMPONENTS, BRISTLES, L_X, LATEST = 15, 12, 5.0, 1000.0
POINTER = ctypes.POINTER(ctypes.c_double)
library = ctypes.CDLL(sys.argv[1])


def passage(index, method, rtol):
    y_0, out = np.zeros(COMPONENTS), np.zeros(COMPONENTS)
    library.bristle_start(index, y_0.ctypes.data_as(POINTER))

    def slope(_, y):
        at = np.ascontiguousarray(y)
        library.bristle_slope(index, at.ctypes.data_as(POINTER), out.ctypes.data_as(POINTER))
        return out.copy()

    def exit_slip(t, y):
        return L_X - (t - (y[0] - y_0[0]))

    exit_slip.terminal = True
    end = solve_ivp(slope, (0, LATEST), y_0, method=method, rtol=rtol, atol=rtol / 100, events=exit_slip)
    return end.y[[8, 9], -1]  # the impulses of normal force and friction


def main():
    exact = [passage(i, "DOP853", 1e-11) for i in range(BRISTLES)]
    peers = []
    for method in ("RK45", "DOP853", "LSODA"):
        curve = []
        for rtol in (1e-4, 1e-5, 1e-6):
            start = time.perf_counter()
            ends = [passage(i, method, rtol) for i in range(BRISTLES)]
            ms = 1e3 * (time.perf_counter() - start) / BRISTLES
            errors = sorted(float(np.max(np.abs(e / x - 1))) for e, x in zip(ends, exact))
            curve.append({"rtol": rtol, "error": errors[int(0.9 * BRISTLES)], "ms_per_bristle": ms})
        peers.append({"name": f"SciPy solve_ivp, {method}", "curve": curve})
    print(json.dumps(peers, indent=1))


main()
