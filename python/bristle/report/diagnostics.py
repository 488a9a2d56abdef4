"""The accuracy of a result: energy residual, error estimates, pinned bristles, points by status."""

import numpy as np

from ..results import read as values
from ..results import status_counts

RELATIVE = ["R_n", "R_x", "gamma_1", "gamma_2", "gamma_3"]
DECADES = range(-10, 1)  # of the histograms; values beyond are counted in the outermost bars
WIDTH, HEIGHT = 80, 22  # of a histogram


def read(file):
    """Points by status, the pinned fraction, and statistics with a histogram for each error."""
    quantities = [statistics("energy residual", values(file, "energy_residual"))]
    quantities += [statistics(name, relative(file, name)) for name in RELATIVE if f"{name}_err" in file]
    pinned = values(file, "pinned_fraction")
    pinned = pinned[np.isfinite(pinned)]
    return {"statuses": status_counts(file), "quantities": quantities,
            "pinned": f"{np.median(pinned):.1%}, at most {pinned.max():.1%}" if pinned.size else "\u2013"}


def relative(file, name):
    """Error estimate over value, where both exist."""
    number, error = (values(file, key) for key in (name, f"{name}_err"))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.abs(error / number)


def statistics(name, numbers):
    numbers = np.abs(np.ravel(numbers))
    numbers = numbers[np.isfinite(numbers)]
    if not numbers.size:
        return {"name": name, "median": "\u2013", "worst": "\u2013", "bars": [], "summary": "no values"}
    median, worst = power(np.median(numbers)), power(numbers.max())
    return {"name": name, "median": median, "worst": worst, "bars": histogram(numbers),
            "summary": f"{numbers.size} values, median {median}, worst {worst}"}


def power(number):
    """Two digits, as 1.2·10⁻⁵."""
    if number == 0:
        return "0"
    mantissa, exponent = f"{number:.1e}".split("e")
    if -2 <= int(exponent) <= 2:
        return f"{number:.2g}"
    raised = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{mantissa}·10{raised}"


def histogram(numbers):
    """Bars of half a decade each: x, y, width, height."""
    logs = np.log10(np.maximum(numbers, 1e-300))
    edges = np.arange(DECADES[0], DECADES[-1] + 0.25, 0.5)
    counts, _ = np.histogram(np.clip(logs, edges[0], edges[-1] - 1e-9), edges)
    step = WIDTH / len(counts)
    return [{"x": f"{i * step:.2f}", "width": f"{step - 0.6:.2f}", "y": f"{HEIGHT * (1 - share):.2f}",
             "height": f"{HEIGHT * share:.2f}"}
            for i, share in enumerate(counts / counts.max()) if share > 0]
