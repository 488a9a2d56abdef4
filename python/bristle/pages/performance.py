"""docs/generated/performance.md and its figures from the output of the benchmarks of `make bench`."""

import argparse
import os

import numpy as np
from matplotlib.figure import Figure

from ..command_line import run
from ..files import read_json, save_figure, write_text
from ..plotting.style import GREEN, apply_look
from .markdown import filled, table

AT = 1e-4  # error at which solvers are compared
FAST_ENGINE = "lanes"  # beginning of the names of the fast engine's rows


def at_error(curve, key):
    """A quantity of the curve at the error AT, between its points on log axes."""
    points = sorted((p["error"], p[key]) for p in curve)
    error, value = np.log([p[0] for p in points]), np.log([p[1] for p in points])
    return float(np.exp(np.interp(np.log(AT), error, value)))


def work_precision(peers):
    figure = Figure(figsize=(7.2, 4.6), layout="constrained")
    axes = figure.subplots()
    for i, peer in enumerate(peers):
        fast = peer["name"].startswith(FAST_ENGINE)
        axes.loglog([p["error"] for p in peer["curve"]], [p["ms_per_bristle"] for p in peer["curve"]],
                    "-" if fast else "--", marker="osv^Dx+*<>1"[i % 11], markersize=5, label=peer["name"])
    axes.set_xlabel("relative error of the impulses\n(90th percentile of the bristles)")
    axes.set_ylabel("CPU time per bristle, ms")
    axes.invert_xaxis()
    axes.grid(alpha=0.3)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def quadrature(cases):
    figure = Figure(figsize=(9.6, 3.4), layout="constrained")
    all_axes = figure.subplots(1, len(cases), sharey=True)
    for axes, case in zip(all_axes, cases):
        for key, label, marker in (("lattice", "random lattice (rms of 8)", "s"),
                                   ("grid", "equidistant grid", "^"),
                                   ("quadrature", "adaptive quadrature", "o")):
            axes.loglog([p["passages"] for p in case[key]], [p["error"] for p in case[key]], marker=marker,
                        markersize=5, label=label)
        axes.loglog([p["passages"] for p in case["quadrature"]], [p["estimate"] for p in case["quadrature"]],
                    ":o", color=GREEN, markerfacecolor="none", markersize=5, label="its own estimate")
        axes.set_title(rf"$k_r = {case['k_r']:g}$, $z_0 = {case['z_0']:g}$", fontsize=10)
        axes.set_xlabel("passages")
        axes.grid(alpha=0.3)
    all_axes[0].set_ylabel(r"larger relative error of $R_n$, $R_x$")
    figure.legend(*all_axes[0].get_legend_handles_labels(), loc="upper center", ncol=4, bbox_to_anchor=(0.5, 0))
    return figure


def solver_table(peers):
    rows = [[peer["name"], f"{at_error(peer['curve'], 'ms_per_bristle'):.3g}", f"{peer['ratio']:.3g}"] for peer in peers]
    return table(["solver", f"ms per bristle at {AT:g}", "ratio to the fast engine"], *rows)


def figure_table(figures):
    return table(["figure", "points", "passages", "CPU, s", "wall, s", "MB"],
                 *([f["name"], str(f["points"]), str(f["passages"]), f"{f['cpu_seconds']:.1f}", f"{f['seconds']:.1f}", str(f["MB"])]
                   for f in figures))


COMMANDS = ["run, up to date", "run, all points in the journal", "run --point", "info", "check", "check --json", "export", "diff",
            "reference update", "report", "archive", "verify"]


def command_table(measured):
    """Processor time (s) and memory (MB) of each command, for each number of points, of a sweep and of a sample."""
    by_place = {(one["kind"], one["points"]): one["commands"] for one in measured["results"]}
    counts = sorted({points for _, points in by_place})

    def cell(kind, points, command, unit):
        found = by_place[kind, points].get(command)
        return "\u2013" if found is None else f"{found[unit]:.2f}" if unit == "seconds" else str(found[unit])

    rows = [[command, *(cell(kind, points, command, "seconds") for kind in ("sweep", "sample") for points in counts),
             cell("sample", counts[-1], command, "MB")] for command in COMMANDS]
    heads = [f"{kind} {points:.0e}".replace("e+0", "e") for kind in ("sweep", "sample") for points in counts]
    return table(["command", *heads, f"MB {counts[-1]:.0e}".replace("e+0", "e")], *rows)


def expectations(figures, peers):
    """What a user waits for."""
    older = next((peer["ratio"] for peer in peers if peer["name"] == "lanes, AVX2"), 0)
    without = f"\n- Processors without AVX-512 take {older:.1f} times as long (the row of AVX2 below)." if older > 1 else ""
    cpu, wall = (sum(figure[key] for figure in figures) for key in ("cpu_seconds", "seconds"))
    dearest = max(figures, key=lambda figure: figure["cpu_seconds"])
    per_point = 1e3 * dearest["cpu_seconds"] / dearest["points"]
    return f"""All figures below take {cpu:.0f} s of processor time together, {wall:.0f} s on {os.cpu_count()} cores;
drawing adds a few seconds each. A point of the dearest one, {dearest['name']}, takes {per_point:.0f} ms of a core.

- Time is proportional to the number of points, and shorter in proportion to the number of cores.
- A second run computes only the points that no result or journal in the folder has.
- Stiff bristles that bounce often, gaps near a jump, and bristles pinned at the pole take longest: some points take
  many times as long as others. `run` names a point that takes longer than five minutes.
- `--tier smoke` takes seconds. A larger `orientation.rtol` saves little, as most panels of azimuths are as wide as they may be.{without}"""


def document(engine, peers, figures, build, commands, note=""):
    everything = engine['all_kinds']
    return f"""# Performance

For those who wait for a computation, and for those who want to make it faster.

Written by `make bench` from one run on one machine: {engine['processor']}, {os.cpu_count()} cores,
instruction set {engine['instruction_set']} (Highway's names: AVX3 is AVX-512, eight numbers in a
vector). Ratios are medians of pairs in that run; times are for orientation. {note}

## What to expect

{expectations(figures, peers)}

Every point is computed anew. The times of fig4 to fig7 include the location of jumps, whose passages
are not counted here.

{figure_table(figures)}

## Commands on many points

Commands on finished results of a sweep of two quantities, and of a sample by table, processor time in s,
child processes included, and the most memory of a process. A dash: not measured, or not possible,
such as reading a reference of more than 64 MB.

{command_table(commands)}

## Build

In a fresh clone `make build` takes {build['build']:.0f} s of processor time, and `make test` {build['test']:.0f} s more.

## Solvers at equal error

256 bristles of both friction laws over the paper's ranges, none of them pinned; the tolerance of each
solver is the one at which the impulses of normal force and friction of 90 in 100 bristles have errors
below {AT:g}. All solvers integrate the same compiled equations; a Python solver calls them. The two rows
of Boost.Odeint are compiled for this processor, take the elementary functions of the C library, and
control their steps without dense output. The reference engine is Odeint with dense output, and with
functions that give the same bits on every processor.

{solver_table(peers)}

![Work and precision of the solvers](../images/work-precision.png)

With pinned and reflected bristles ({everything['bristles']} of all kinds, the reference engine with its
implicit method for the stiff), at errors of {everything['error']:.1e} and {everything['odeint_error']:.1e}: the
fast engine takes {everything['ms_per_bristle']:.3f} ms per bristle and the reference
engine {everything['ratio']:.1f} times as long. {everything['lane_utilisation']:.0%} of the steps of its SIMD lanes advanced a passage.
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("measured", help="directory with the JSON files of the benchmarks")
    parser.add_argument("-o", "--output", default="docs", help="directory of generated/performance.md and images/")
    parser.add_argument("--note", default="", help="a sentence on the run, such as that the machine was busy")
    arguments = parser.parse_args()
    engine, quadratures, scipy, figures, build, commands = (
        read_json(os.path.join(arguments.measured, f"{name}.json"), "`make bench` writes it")
        for name in ("engine", "quadrature", "scipy", "figures", "build", "commands"))
    peers = [dict(p, ratio=p["ratio_at_1e-4"]) for p in engine["ordinary"]]
    fastest = at_error(peers[0]["curve"], "ms_per_bristle")
    peers += [dict(p, ratio=at_error(p["curve"], "ms_per_bristle") / fastest) for p in scipy]
    apply_look()
    images = os.path.join(arguments.output, "images")
    save_figure(work_precision(peers), images, "work-precision", formats=("png",), bbox_inches="tight")
    save_figure(quadrature(quadratures["cases"]), images, "quadrature", formats=("png",), bbox_inches="tight")
    path = os.path.join(arguments.output, "generated", "performance.md")
    write_text(path, filled(document(engine, peers, figures, build, commands, note=arguments.note)))
    print(path)


if __name__ == "__main__":
    run(main)
