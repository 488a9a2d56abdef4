"""docs/performance.md and its figures from what the benchmarks of `make bench` measured."""

import argparse
import json
import os

import numpy as np

import style
from document import table, write
import matplotlib.pyplot as plt

AT = 1e-4  # error at which solvers are compared


def ms_at_error(curve):
    """Milliseconds per bristle at the error AT, between the curve's points on log axes."""
    points = sorted((p["error"], p["ms_per_bristle"]) for p in curve)
    error, ms = np.log([p[0] for p in points]), np.log([p[1] for p in points])
    return float(np.exp(np.interp(np.log(AT), error, ms)))


def work_precision(peers, path):
    figure, axes = plt.subplots(figsize=(7.2, 4.6), layout="constrained")
    for i, peer in enumerate(peers):
        own = peer["name"].startswith("lanes")
        axes.loglog([p["error"] for p in peer["curve"]], [p["ms_per_bristle"] for p in peer["curve"]],
                    "-" if own else "--", marker="osv^Dx+*<>1"[i % 11], markersize=5, label=peer["name"])
    axes.set_xlabel("relative error of the impulses\nthat 90 in 100 bristles stay below")
    axes.set_ylabel("CPU time per bristle, ms")
    axes.invert_xaxis()
    axes.grid(alpha=0.3)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, path)


def quadrature(cases, path):
    figure, all_axes = plt.subplots(1, len(cases), figsize=(10.5, 3.6), sharey=True, layout="constrained")
    for axes, case in zip(all_axes, cases):
        for key, label, marker in (("lattice", "random lattice (rms of 8)", "s"), ("grid", "equidistant grid", "^"),
                                   ("quadrature", "adaptive quadrature", "o")):
            axes.loglog([p["passages"] for p in case[key]], [p["error"] for p in case[key]], marker=marker, markersize=5,
                        label=label)
        axes.loglog([p["passages"] for p in case["quadrature"]], [p["estimate"] for p in case["quadrature"]], ":o",
                    color=style.GREEN, markerfacecolor="none", markersize=5, label="its own estimate")
        axes.set_title(rf"$k_r = {case['k_r']:g}$, $z_0 = {case['z_0']:g}$", fontsize=10)
        axes.set_xlabel("passages")
        axes.grid(alpha=0.3)
    all_axes[0].set_ylabel(r"larger relative error of $R_n$, $R_x$")
    figure.legend(*all_axes[0].get_legend_handles_labels(), loc="upper center", ncol=4, bbox_to_anchor=(0.5, 0))
    save(figure, path)


def save(figure, path):
    figure.savefig(path, bbox_inches="tight", metadata=style.METADATA["png"])
    plt.close(figure)


def document(engine, peers, cases, figures):
    everything = engine["all_kinds"]
    solvers = [["solver", f"ms per bristle at {AT:g}", "times the fast engine's"]]
    for peer in peers:
        solvers.append([peer["name"], f"{ms_at_error(peer['curve']):.3g}", f"{peer['ratio']:.3g}"])
    passages = [["k_r", "z_0", "quadrature", "its error", "grid of", "its error", "lattice of", "its error"]]
    for case in cases:
        own = next(p for p in case["quadrature"] if p["estimate"] <= 1.05e-3)
        grid, lattice = case["grid"][-1], case["lattice"][-1]
        passages.append([f"{case['k_r']:g}", f"{case['z_0']:g}", str(own["passages"]), f"{own['error']:.1e}",
                         str(grid["passages"]), f"{grid['error']:.1e}", str(lattice["passages"]), f"{lattice['error']:.1e}"])
    scaling = [["bristles", "threads", "ms per bristle"]]
    scaling += [[str(s["bristles"]), str(s["threads"]), f"{s['ms_per_bristle']:.3f}"] for s in engine["scaling"]]
    tiers = [["figure", "points", "passages", "wall time, s"]]
    tiers += [[f["figure"], str(f["points"]), str(f["passages"]), f"{f['seconds']:.1f}"] for f in figures]
    return f"""# Performance

Written by `make bench` from one run on one machine: {engine['processor']}, {os.cpu_count()} cores, instruction set
{engine['instruction_set']} (Highway's names: AVX3 is AVX-512, eight numbers in a vector). Ratios are medians of pairs in that run; times are for orientation.

## Solvers at equal error

256 bristles of both friction laws over the paper's ranges, none of them pinned; every solver is given the tolerance at which
90 in 100 bristles have their impulses of normal force and friction right to {AT:g}. All integrate the same
compiled equations; a Python solver calls them.

{table(*solvers)}

![Work and precision of the solvers](images/work-precision.png)

With the pinned and the reflected bristles ({everything['bristles']} of all kinds, Odeint with its implicit method for the stiff), at
errors of {everything['error']:.1e} and {everything['odeint_error']:.1e}: the fast engine takes {everything['ms_per_bristle']:.3f} ms per bristle
and Odeint {everything['ratio']:.1f} times as long. {everything['lane_utilisation']:.0%} of the steps its lanes made were of a passage.

## Passages for a mean

Relative error, the larger of R_n and R_x, against a mean to 3e-5.

{table(*passages)}

![Error against number of passages](images/quadrature.png)

## Scaling

{table(*scaling)}

Few bristles leave lanes empty; a sweep has several points under way on each thread for that.

## Figures, full tier

{table(*tiers)}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("measured", help="directory with engine.json, quadrature.json, scipy.json, figures.json")
    parser.add_argument("-o", "--output", default="docs", help="directory of performance.md and images/")
    arguments = parser.parse_args()

    def measured(name):
        with open(os.path.join(arguments.measured, name), encoding="utf-8") as file:
            return json.load(file)

    engine, cases = measured("engine.json"), measured("quadrature.json")
    peers = [dict(p, ratio=p["ratio_at_1e-4"]) for p in engine["ordinary"]]
    own = ms_at_error(peers[0]["curve"])
    peers += [dict(p, ratio=ms_at_error(p["curve"]) / own) for p in measured("scipy.json")]
    plt.rcParams.update(style.LOOK)
    images = os.path.join(arguments.output, "images")
    os.makedirs(images, exist_ok=True)
    work_precision(peers, os.path.join(images, "work-precision.png"))
    quadrature(cases, os.path.join(images, "quadrature.png"))
    path = os.path.join(arguments.output, "performance.md")
    write(path, document(engine, peers, cases, measured("figures.json")))
    print(path)


main()
