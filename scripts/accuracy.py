"""docs/accuracy.md from what build/benchmarks/accuracy measured."""

import argparse
import json

from document import table, write
from style import fail

QUANTITIES = ("N_c_ratio", "R_n", "R_x", "gamma_1", "gamma_2", "gamma_3")


def size(value):
    """An error's size: one digit."""
    return f"{value:.0e}".replace("e-0", "e-")


def two_digits(value):
    return f"{float(f'{value:.2g}'):g}"


def integration(rows):
    cells = [[row["engine"], size(row["rtol"]), *(size(row[name]) for name in QUANTITIES)] for row in rows]
    return table(["engine", "relative tolerance", *QUANTITIES], *cells)


def stiffness(rows):
    cells = [[f"{row['k_r']:g}", f"{row['z_0']:g}",
              *(f"{two_digits(low)} to {two_digits(high)}" for low, high in (row["median"], row["peak"]))] for row in rows]
    return table(["k_r", "z_0", "median over the time in contact", "peak"], *cells)


def quadrature(measured):
    cells = [[size(row["rtol"]), str(row["within"]), str(row["within_two"]), f"{row['worst']:.1f}"] for row in measured["rows"]]
    return table(["tolerance", f"within it, of {measured['values']}", "within twice", "worst, times"], *cells)


def document(m):
    bristles, head_on, lattice = m["bristles"], m["head_on"], m["lattice"]
    deviations = [[name, f"{value:.2f}"] for name, value in lattice["deviation"].items()]
    azimuths = lattice["azimuths"]
    return f"""# Accuracy

Written by `make accuracy`, which measures what the methods of [numerics.md](numerics.md) leave of error. No clock and no processor is in
these numbers; a test computes them again and holds this page against them.

## Integration

Relative errors of the means over 200 equidistant azimuths, against Boost.Odeint at a tolerance of 1e-9: the largest of three points (k_r of
10, 25 and 50, each near its gap at R_n = 2). The absolute tolerance is a hundredth of the relative one.

{integration(m["integration"])}

Single bristles of both friction laws over the paper's ranges, fast engine at 1e-5: 90 in 100 have their impulses of normal force and friction right
to {size(bristles["explicit_error"])} ({bristles["explicit"]} that explicit steps finished) and {size(bristles["implicit_error"])} \
({bristles["implicit"]} that came near the axis).

A bristle that points exactly against the motion is reflected up to {head_on["reflections"]["fast"]} times at the pole, which amplifies errors: over tolerances of
1e-5 to 1e-8 its contact time scatters by up to {size(head_on["scatter"]["fast"])} (fast engine) and {size(head_on["scatter"]["reference"])} (reference).

## Stiffness

The fastest decay rate -Re(eigenvalue) of the equations along a passage, in units of V_0/r_0; ranges over 18 azimuths, NSS friction.

{stiffness(m["stiffness"])}

## The mean over theta_0

How far the mean is from one to 2e-4, in units of both error estimates together; N_c_ratio, R_n, R_x and gamma_1 to gamma_3, at nine k_r from 2 to
100, two k_theta (1 and 5) and five gaps from 0.1 to 0.9.

{quadrature(m["quadrature"])}

## The lattice's standard errors

Root mean square, over {lattice["seeds"]} seeds of {lattice["rows"]} rows ({lattice["bristles"]} bristles), of the deviation from the mean over theta_0, in standard errors. \
Independent ones would give 1 ± {(2 * lattice["seeds"]) ** -0.5:.2f}.

{table(["", "deviation"], *deviations)}

R_y is odd in theta_0. The sum of sin(theta_0) alone deviates, in its own standard error, by {azimuths["seeds"]:.2f} with the azimuths of these seeds and by
{azimuths["all"]:.3f} with those of {azimuths["draws"]}.
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("measured", metavar="ACCURACY.json")
    parser.add_argument("-o", dest="output", metavar="FILE", default="docs/accuracy.md")
    arguments = parser.parse_args()
    try:
        with open(arguments.measured, encoding="utf-8") as file:
            measured = json.load(file)
    except (OSError, ValueError) as error:
        fail(f"{arguments.measured}: not what build/benchmarks/accuracy prints ({error}); `make accuracy` makes it anew")
    write(arguments.output, document(measured))
    print(arguments.output)


if __name__ == "__main__":
    main()
