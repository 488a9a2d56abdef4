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
AIM = 10  # times the speed of the fastest other solver at the error AT
FAST_ENGINE = ("SIMD", "lanes")  # beginning of its peers' names, and the older one
REFERENCE = "the reference engine"

FIGURES_AIM = 400  # s of processor time for all figures of the paper
COMMAND_AIM = 1  # s of processor time for a command that reads a finished result, without `report`
JOURNAL_AIM = 5  # s of processor time for a run whose points are all in the journal
BUILD_AIM, TEST_AIM = 85, 420  # s of processor time in a fresh clone for `make build`, and together with `make test`
# Aims for the CPU time of designs and indices on one core, in s.
DESIGN_AIMS = {"target": 15, "target_at_jump": 15, "robust": 240, "indices": 300}

# Phases of a step, and their shares of the kernel's time in %: samples of `perf record build/benchmarks/bench_engine
# --kernel`, taken by hand.
SAMPLED = "26 November 2026 on an AMD EPYC with AVX-512"
PHASES = {"first_stage": ("first stage of a step", 11.7),
          "predict": ("state of a stage from the stages before", 5.8),
          "locate": ("geometry, wall force and friction table of a stage", 33.0),
          "solve": ("its velocity, by a 2 x 2 system", 14.5),
          "evaluate": ("slopes of the stage", 14.0),
          "finish": ("new state and error of the step", 12.8),
          "control": ("step size, acceptance, events", 8.1)}


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


def times_limit(kernel):
    return kernel["cycles_per_lane_step"] / kernel["limit_cycles_per_lane_step"]


def clock_text(kernels):
    """The processor's clock in the run, on which all times depend; empty where it could not be measured."""
    return f", whose clock ran at {kernels['polar']['clock_GHz']:.1f} GHz" if kernels else ""


def kernel_text(kernels):
    """What the processor's instructions allow; empty where it could not be measured."""
    if not kernels:
        return ""
    kernel, rod = kernels["polar"], kernels["rod"]
    total = sum(kernel["phases"].values())
    rows = [[what, f"{kernel['phases'].get(phase, 0) / total:.0%}", f"{share:.0f}%"]
            for phase, (what, share) in PHASES.items()]
    return f"""One step of one vector of {kernel['width']} lanes executes {kernel['all_per_vector_step']:.0f} instructions.
{kernel['arithmetic_per_vector_step']:.0f} of them are vector arithmetic, the rest mostly move data;
{kernel['divisions_per_vector_step']:.0f} are divisions. The processor completes
{1 / kernel['cycles_per_multiply_add']:.1f} independent multiply-adds per cycle, and one division of a vector in
{kernel['cycles_per_division']:.1f} cycles (both measured in the same run). At these rates the arithmetic alone takes
{kernel['limit_cycles_per_lane_step']:.0f} cycles per step of one lane. The kernel takes
{kernel['cycles_per_lane_step']:.0f} cycles with all lanes full ({kernel['ns_per_lane_step']:.0f} ns at
{kernel['clock_GHz']:.1f} GHz), {times_limit(kernel):.2f} times this
limit. The limit is not strict where a processor adds beside its multiply-adds. The kernel of rods takes
{rod['cycles_per_lane_step']:.0f} cycles, {times_limit(rod):.2f} times its limit of {rod['limit_cycles_per_lane_step']:.0f},
with {rod['arithmetic_per_vector_step']:.0f} vector instructions of arithmetic of {rod['all_per_vector_step']:.0f}.

The phases of a step, with their shares of the vector arithmetic in this run, and of the time as sampled on {SAMPLED}:

{table(["phase", "arithmetic", "time"], *rows)}

"""


def evaluations(peer):
    """Evaluations of the equations per passage at the error AT, and ns per evaluation with its share of the step."""
    count = at_error(peer["curve"], "evaluations")
    return count, 1e6 * at_error(peer["curve"], "ms_per_bristle") / count


def fastest_other(peers):
    return min((p for p in peers if not p["name"].startswith((*FAST_ENGINE, REFERENCE))), key=lambda p: p["ratio"])


def distance_text(peers, kernels):
    """How far the fastest other solver is behind, and why not farther."""
    best = fastest_other(peers)
    text = f"The fastest other solver, {best['name']}, takes {best['ratio']:.1f} times as long as the fast engine. "
    if kernels:
        reach = best["ratio"] * times_limit(kernels["polar"])
        text += f"""A kernel at the limit above would be {reach:.0f} times as fast as that solver. """
    if best["curve"][0].get("evaluations"):
        (ours, our_ns), (theirs, their_ns) = evaluations(peers[0]), evaluations(best)
        text += f"""Per passage the engine evaluates the equations {ours:.0f} times, that solver {theirs:.0f} times; an
evaluation with its share of the step takes {our_ns:.1f} ns in one lane, and {their_ns:.1f} ns in that solver. """
    return text + """More would have to come from fewer steps or from fewer instructions per step: the vectors are as wide
as the processor has them, and nearly all of their lanes are in use. Moreover, a step solves an implicit system in each
stage, which an explicit solver does not, and the slopes of its stages do not fit into the registers, so that much is
stored and loaded again."""


def aims_table(peers, figures, build):
    """What the speed should be, and what it is."""
    rows = [["the fastest other solver over the fast engine, at equal error", f"at least {AIM}", f"{fastest_other(peers)['ratio']:.1f}"],
            ["all figures of the paper, CPU, s", f"at most {FIGURES_AIM}", f"{sum(f['cpu_seconds'] for f in figures):.0f}"],
            ["`make build` in a fresh clone, CPU, s", f"at most {BUILD_AIM}", f"{build['build']:.0f}"],
            ["`make build` and `make test` in a fresh clone, CPU, s", f"at most {TEST_AIM}", f"{build['build'] + build['test']:.0f}"]]
    return table(["what", "aim", "measured"], *rows)


WITHDRAWN = """The dearest file of `make build` is the reference engine, with Boost.Odeint's templates for each model and law. The aims
of designs (above) are from a machine with a clock of 4.2 GHz.

Earlier aims were withdrawn: 14 times the fastest other solver, and Figure 4 in 50 s of processor time. The ideas for both
were tried one after the other ([numerics.md](../numerics.md#what-was-tried)). What a point costs beyond that are
checks which its numbers need: a scan for all gaps that carry the load, and values computed again for their errors."""


def figure_table(figures):
    return table(["figure", "points", "passages", "CPU, s", "wall, s", "MB"],
                 *([f["name"], str(f["points"]), str(f["passages"]), f"{f['cpu_seconds']:.1f}", f"{f['seconds']:.1f}", str(f["MB"])]
                   for f in figures))


def design_table(designs):
    return table(["experiment", "what", "points", "CPU, s", "aim, s"],
                 *([d["name"], d["title"], str(d["points"]), f"{d['cpu_seconds']:.0f}", str(DESIGN_AIMS[d["name"]])]
                   for d in designs))


COMMANDS = ["run, up to date", "run, all points in the journal", "run --point", "info", "check", "check --json", "export", "diff",
            "reference update", "report", "archive", "verify"]


def command_table(measured):
    """Processor time (s) and memory (MB) of each command, for each number of points, of a sweep and of a sample, and the aims
    that are missed."""
    by_place = {(one["kind"], one["points"]): one["commands"] for one in measured["results"]}
    counts = sorted({points for _, points in by_place})

    def cell(kind, points, command, unit):
        found = by_place[kind, points].get(command)
        return "\u2013" if found is None else f"{found[unit]:.2f}" if unit == "seconds" else str(found[unit])

    rows = [[command, *(cell(kind, points, command, "seconds") for kind in ("sweep", "sample") for points in counts),
             cell("sample", counts[-1], command, "MB")] for command in COMMANDS]
    heads = [f"{kind} {points:.0e}".replace("e+0", "e") for kind in ("sweep", "sample") for points in counts]
    return table(["command", *heads, f"MB {counts[-1]:.0e}".replace("e+0", "e")], *rows) + "\n\n" + command_aims(measured)


def command_aims(measured):
    """Which commands take longer than their aims, each with its longest time. `report` draws figures and has no aim here."""
    slow = {}
    for one in measured["results"]:
        for command in COMMANDS:
            found, aim = one["commands"].get(command), JOURNAL_AIM if command == "run, all points in the journal" else COMMAND_AIM
            if found is not None and command != "report" and found["seconds"] > max(aim, slow.get(command, (0, 0))[0]):
                slow[command] = found["seconds"], one["points"]
    missed = ", ".join(f"`{command}` ({seconds:.1f} s at {points:.0e} points)".replace("e+0", "e")
                       for command, (seconds, points) in slow.items())
    return (f"The aim is {COMMAND_AIM} s for a command, and {JOURNAL_AIM} s for a run that finds all points in the journal. "
            + (f"It is missed by {missed}: they read or write each of the numbers, some fifty for a point, or each line of the "
               "journal with its digest." if missed else "All meet it."))


# The tables that are also written alone: each has comments around it, which name the file of its numbers.
ALONE = {"commands": command_table}


def marked(name, measured):
    return f"<!-- {name} -->\n\n{ALONE[name](measured)}\n\n<!-- end of {name} -->"


def replaced(page, name, measured):
    """The page with this table anew."""
    before, rest = page.split(f"<!-- {name} -->")
    return before + filled(marked(name, measured)).rstrip("\n") + rest.split(f"<!-- end of {name} -->")[1]


def passage_table(cases):
    rows = []
    for case in cases:
        # The first quadrature of the default tolerance, 1e-3.
        adaptive = next(p for p in case["quadrature"] if p["estimate"] <= 1.05e-3)
        cells = [f"{case['k_r']:g}", f"{case['z_0']:g}"]
        for p in (adaptive, case["grid"][-1], case["lattice"][-1]):
            cells += [str(p["passages"]), f"{p['error']:.1e}"]
        rows.append(cells)
    return table(["k_r", "z_0", "quadrature", "its error", "grid of", "its error", "lattice of", "its error"], *rows)


def purposes_text(purposes):
    parts = {"to decide on which side of the load the mean at a gap lies": purposes["scan"],
             "to locate the crossing, whose passages the values reuse": purposes["crossing"], "more for the values": purposes["values"]}
    total = sum(parts.values())
    shares = ", ".join(f"{part / total:.0%} {purpose}" for purpose, part in parts.items())
    return (f"A point of Figure 4 takes {total / purposes['points']:.0f} passages in the mean over "
            f"{purposes['points']} points of its map: {shares}, which includes those that are repeated with a quarter "
            "of the tolerance for the error.")


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


def contact_rows(engine):
    return [[one["bending"], f"{one['steps_wall']:.0f}", f"{one['steps_hertz']:.0f}", f"{one['hertz_over_wall']:.2f}"]
            for one in engine["contacts"]]


def document(engine, kernels, peers, cases, purposes, figures, designs, build, commands, note=""):
    everything = engine["all_kinds"]
    scaling = [[str(s["bristles"]), str(s["threads"]), f"{s['ms_per_bristle']:.3f}"] for s in engine["scaling"]]
    return f"""# Performance

For those who wait for a computation, and for those who want to make it faster.

Written by `make bench` from one run on one machine: {engine['processor']}, {os.cpu_count()} cores,
instruction set {engine['instruction_set']} (Highway's names: AVX3 is AVX-512, eight numbers in a
vector){clock_text(kernels)}. Ratios are medians of pairs in that run; times are for orientation. {note}

## What to expect

{expectations(figures, peers)}

Every point is computed anew. The times of fig4 to fig7 include the location of jumps, whose passages
are not counted here.

{figure_table(figures)}

Designs and indices (the experiments of `benchmarks/designs/`), on one core:

{design_table(designs)}

Commands on finished results of a sweep of two quantities, and of a sample by table, processor time in s,
child processes included, and the most memory of a process. A dash: not measured, or not possible,
such as reading a reference of more than 64 MB.

{marked("commands", commands)}

The rest of this page is for developers.

## Aims

{aims_table(peers, figures, build)}

{WITHDRAWN}

## Solvers at equal error

256 bristles of both friction laws over the paper's ranges, none of them pinned; the tolerance of each
solver is the one at which the impulses of normal force and friction of 90 in 100 bristles have errors
below {AT:g}. All solvers integrate the same compiled equations; a Python solver calls them. The two rows
of Boost.Odeint are compiled for this processor, take the elementary functions of the C library, and
control their steps without dense output. The reference engine is Odeint with dense output, and with
functions that give the same bits on every processor. GNU Octave has no row: its solvers call compiled
equations only by means of its development package, and equations in its own language would measure
its interpreter.

{solver_table(peers)}

![Work and precision of the solvers](../images/work-precision.png)

With pinned and reflected bristles ({everything['bristles']} of all kinds, the reference engine with its
implicit method for the stiff), at errors of {everything['error']:.1e} and {everything['odeint_error']:.1e}: the
fast engine takes {everything['ms_per_bristle']:.3f} ms per bristle and the reference
engine {everything['ratio']:.1f} times as long. {everything['lane_utilisation']:.0%} of the steps of its SIMD lanes advanced a passage.

## What limits the speed

{kernel_text(kernels)}{distance_text(peers, kernels)}

## The two contacts

Hertz's contact beside the paper's wall, the same 1024 bristles of each model, none of them pinned; cycles
are per passage, as a ratio in the same run.

{table(["bending", "steps, wall", "steps, Hertz", "cycles, Hertz over wall"], *contact_rows(engine))}

## Passages for an ensemble mean

Relative error, the larger of R_n and R_x, compared with a mean of tolerance 3e-5.

{passage_table(cases)}

![Error over number of passages](../images/quadrature.png)

{purposes_text(purposes)}

## Scaling

{table(["bristles", "threads", "ms per bristle"], *scaling)}

A few bristles do not fill the SIMD lanes; a sweep therefore works on several points per thread.
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("measured", help="directory with the JSON files of the benchmarks")
    parser.add_argument("-o", "--output", default="docs", help="directory of generated/performance.md and images/")
    parser.add_argument("--note", default="", help="a sentence on the run, such as that the machine was busy")
    parser.add_argument("--only", choices=ALONE, help="replace only this table in performance.md")
    arguments = parser.parse_args()
    path = os.path.join(arguments.output, "generated", "performance.md")
    alone = {name: read_json(os.path.join(arguments.measured, f"{name}.json"), f"`make bench-{name}` writes it")
             for name in ALONE if arguments.only in (None, name)}
    if arguments.only:
        with open(path, encoding="utf-8") as file:
            page = file.read()
        write_text(path, replaced(page, arguments.only, alone[arguments.only]))
        print(path)
        return
    engine, kernels, quadratures, scipy, figures, designs, build = (
        read_json(os.path.join(arguments.measured, f"{name}.json"), "`make bench` writes it")
        for name in ("engine", "kernel", "quadrature", "scipy", "figures", "designs", "build"))
    cases = quadratures["cases"]
    peers = [dict(p, ratio=p["ratio_at_1e-4"]) for p in engine["ordinary"]]
    fastest = at_error(peers[0]["curve"], "ms_per_bristle")
    peers += [dict(p, ratio=at_error(p["curve"], "ms_per_bristle") / fastest) for p in scipy]
    apply_look()
    images = os.path.join(arguments.output, "images")
    save_figure(work_precision(peers), images, "work-precision", formats=("png",), bbox_inches="tight")
    save_figure(quadrature(cases), images, "quadrature", formats=("png",), bbox_inches="tight")
    write_text(path, filled(document(engine, kernels, peers, cases, quadratures["purposes"], figures, designs, build, **alone, note=arguments.note)))
    print(path)


if __name__ == "__main__":
    run(main)
