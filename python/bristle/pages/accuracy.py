"""docs/generated/accuracy.md from the output of build/benchmarks/accuracy."""

import argparse
import os

from ..command_line import run
from ..files import read_json, write_text
from .markdown import filled, table

HERE = os.path.dirname(os.path.abspath(__file__))
QUANTITIES = ("N_c_ratio", "R_n", "R_x", "gamma_1", "gamma_2", "gamma_3")


def one_digit(value):
    """An error with one digit."""
    return f"{value:.0e}".replace("e-0", "e-")


def two_digits(value):
    return f"{float(f'{value:.2g}'):g}"


def integration(rows):
    cells = [[row["engine"], one_digit(row["rtol"]), *(one_digit(row[name]) for name in QUANTITIES)]
             for row in rows]
    return table(["engine", "relative tolerance", *QUANTITIES], *cells)


def stiffness(rows):
    cells = [[f"{row['k_r']:g}", f"{row['z_0']:g}",
              *(f"{two_digits(low)} to {two_digits(high)}" for low, high in (row["median"], row["peak"]))]
             for row in rows]
    return table(["k_r", "z_0", "median over the time in contact", "peak"], *cells)


def quadrature(measured):
    cells = [[one_digit(row["rtol"]), str(row["within"]), str(row["within_two"]), f"{row['worst']:.1f}"]
             for row in measured["rows"]]
    return table(["tolerance", f"within one unit, of {measured['values']}", "within two", "largest"], *cells)


def random_means(sets):
    share = lambda part, row: f"{100 * part / row['values']:.1f} %"
    cells = [["near the paper's values" if row["near"] else "the whole range", str(row["points"]), str(row["values"]),
              share(row["within"], row), share(row["within_two"], row), str(row["beyond_eight"]),
              f"{row['passages']:.0f}"] for row in sets]
    return table(["random points", "points", "values", "within 1 x", "within 2 x", "beyond 8 x", "passages per point"],
                 *cells)


def another_processor(agreement):
    cells = [[row["name"], *(str(row[key]) for key in ("points", "same_status", "values")),
              *(f"{100 * row[key] / row['values']:.1f} %" for key in ("within", "within_two")), str(row["beyond_eight"])]
             for row in agreement["results"]]
    return f"""
## Another processor, compiler and library

The engine of the page ([running.md](../running.md#in-a-browser)) is the library compiled for WebAssembly by Emscripten
{agreement["compiler"]}, with the C library's elementary functions and without fused multiply-add. Deviation
of its values from the program's, in units of the program's estimated error, for every variable with an
error at all points of the smoke tiers and of the page's presets; `make page-agreement` measures it.

{table(["result", "points", "same status", "values", "within 1 x", "within 2 x", "beyond 8 x"], *cells)}
"""


def document(m, agreement):
    bristles, head_on, lattice = m["bristles"], m["head_on"], m["lattice"]
    explicit, implicit = (one_digit(bristles[f"{kind}_error"]) for kind in ("explicit", "implicit"))
    scatter = {engine: one_digit(value) for engine, value in head_on["scatter"].items()}
    deviations = [[name, f"{value:.2f}"] for name, value in lattice["deviation"].items()]
    azimuths = lattice["azimuths"]
    return f"""# Accuracy

For those who rely on an error estimate, or choose a tolerance.

`make accuracy` measures the errors of the methods of [numerics.md](../numerics.md) and writes this page.
The numbers depend on neither time nor processor; a test computes them again and compares them with this
page.

## Integration

Relative errors of the means over 200 equidistant azimuths, compared with Boost.Odeint at a tolerance of
1e-9: the largest of three points (k_r of 10, 25 and 50, each near its gap at R_n = 2). The absolute
tolerance is twice the relative one.

{integration(m["integration"])}

Single bristles of both friction laws over the paper's ranges, fast engine at 1e-4: 90 in 100 have
impulses of normal force and friction with errors below {explicit} ({bristles["explicit"]} that stayed
far from the pole) and {implicit} ({bristles["implicit"]} that came near the pole).

A bristle that points exactly against the motion is reflected at the pole up to
{head_on["reflections"]["fast"]} times, which amplifies errors: over tolerances of 1e-5 to 1e-8 its
contact time scatters by up to {scatter["fast"]} (fast engine) and {scatter["reference"]} (reference).

## Stiffness

The fastest decay rate -Re(eigenvalue) of the equations along a passage, in units of V_0/r_0; ranges over
18 azimuths, NSS friction.

{stiffness(m["stiffness"])}

## The mean over theta_0

Deviation of the ensemble mean from one computed with tolerance 2e-4, in units of the sum of both error
estimates; for N_c_ratio, R_n, R_x and gamma_1 to gamma_3, at nine k_r from 2 to 100, two k_theta (1 and
5) and five gaps from 0.1 to 0.9.

{quadrature(m["quadrature"])}

Intervals of azimuths whose bristles are pinned or chatter may lie between the nodes. So means at random
points and gaps are compared with the mean over 2161 equidistant azimuths, and further ones where the outcome
changes, at a tenth of the integrator's tolerance; in units of the sum of both error estimates (the estimate of the
azimuths is a third of the difference to every second one). Near the paper's values, both laws and readings,
k_r 4 to 200, k_theta 0.1 to 3, k_phi 1 to 4, phi_0 72 to 84 degrees; over the whole range, k_r 1 to 1000,
k_theta 0.05 to 20, k_phi 0.1 to 10, phi_0 30 to 87 degrees, all starts, both pole rules, and other lambda,
s_min, alpha, V_s, L_x and tolerances. Of 300 points drawn for each, those are counted at which no passage
fails and the status is `ok`; the values are R_n, R_x, N_c_ratio, gamma_1 to gamma_3, pinned_fraction, and
R_n and R_x of unpinned bristles.

{random_means(m["random_means"])}

## The lattice's standard errors

Root mean square, over {lattice["seeds"]} seeds of {lattice["rows"]} rows ({lattice["bristles"]}
bristles), of the deviation from the ensemble mean, in standard errors. Independent contributions would
give 1 ± {(2 * lattice["seeds"]) ** -0.5:.2f}.

{table(["", "deviation"], *deviations)}

R_y is odd in theta_0. The sum of sin(theta_0) alone deviates, in its own standard error, by
{azimuths["seeds"]:.2f} with the azimuths of these seeds and by {azimuths["all"]:.3f} with the azimuths of
{azimuths["draws"]}.
{another_processor(agreement)}"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("measured", metavar="ACCURACY.json")
    parser.add_argument("--page", metavar="AGREEMENT.json", default=os.path.join(HERE, "../../../page/agreement.json"))
    parser.add_argument("-o", dest="output", metavar="FILE", default="docs/generated/accuracy.md")
    arguments = parser.parse_args()
    measured = read_json(arguments.measured, "`make accuracy` writes it")
    agreement = read_json(arguments.page, "`make page-agreement` writes it")
    write_text(arguments.output, filled(document(measured, agreement)))
    print(arguments.output)


if __name__ == "__main__":
    run(main)
