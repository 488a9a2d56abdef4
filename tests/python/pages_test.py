"""The modules of bristle.pages that no other test runs write their pages, with the numbers of what they read.

pages_test.py BRISTLE FOLDER DESIGN RESULT...: results of the smoke tier: design, then others, fig7 first. The matrix and the benchmarks are
invented.
"""
import json
import pathlib
import shutil
import subprocess
import sys
from types import SimpleNamespace
from xml.etree import ElementTree

import h5py
import numpy as np
from matplotlib.figure import Figure
from matplotlib.text import Text

from in_process import SOURCE, called
from bristle import BristleError, draw, open_result
from bristle.figures.design import draw_profile, in_units
from bristle.pages import quantities
from bristle.plotting.verdicts import measured_text, read_claims
from bristle.program import measure
from bristle.results import table

bristle, folder, design, *results = [pathlib.Path(word).absolute() for word in sys.argv[1:]]
SUMMARY = "<!-- summary: written by `make findings` -->", "<!-- end of summary -->"


def written(module, page, *words):
    """What the module of bristle.pages writes to the page, in one line."""
    done = called(f"bristle.pages.{module}", *words)
    assert done.code == 0, done.messages
    return " ".join((folder / page).read_text(encoding="utf-8").split())


def write(name, document):
    (folder / name).write_text(json.dumps(document), encoding="utf-8")
    return folder / name


def check_findings():
    """Each digest is in the page, what each main check measured, and the summary in README.md."""
    (folder / "README.md").write_text("\n".join(["before", *SUMMARY, "after"]))
    page = written("findings", "findings.md", *results, "-o", folder / "findings.md", "--readme", folder / "README.md", "--program", bristle)
    for path in results:
        with h5py.File(path) as file:
            assert f"`{file.attrs['payload_sha256'].decode()[:16]}`" in page, path
        for claim in (one for one in read_claims(open_result(path)) if one.role == "main"):
            assert f"({claim.required}): " in page and measured_text(claim) in page, (path, claim)
    readme = " ".join((folder / "README.md").read_text(encoding="utf-8").split())
    summary = readme[readme.index(SUMMARY[0]):readme.index(SUMMARY[1])]
    assert "Of the paper's" in summary and summary in page and readme.startswith("before") and readme.endswith("after")
    (folder / "README.md").write_text("no place")
    done = called("bristle.pages.findings", *results[:1], "-o", folder / "findings.md", "--readme", folder / "README.md")
    assert done.code == 2 and "README.md: has no place to write to" in done.messages, done.messages


def check_guide():
    """The guide has what a design found, word for word, and refuses another result."""
    begin, end = "<!-- design: written by `make guide` -->", "<!-- end of design -->"
    (folder / "guide.md").write_text("\n".join(["before", begin, "old", end, "after"]))
    done = called("bristle.pages.guide", results[0], "-o", folder / "guide.md")
    assert done.code == 2 and "is no result of a design" in done.messages, done.messages
    page = written("guide", "guide.md", design, "-o", folder / "guide.md")
    assert page.startswith("before") and page.endswith("after") and "old" not in page
    with h5py.File(design) as file:
        lines = file["trials"].attrs["summary"].decode().split("\n")
        found = file["verification"]
        number = f"{found['objective'][0]:.2f} ± {found['objective_err'][0]:.2f}"
        assert found["objective"].attrs["statistic"] == b"q95" and "statistic" not in found["objective_err"].attrs
        brushes = found["brushes"][0]
    assert " ".join(" ".join(lines).split()) in page
    assert f"Of {brushes} brushes made like it" in page and number in page, (number, page)


def check_profile():
    """A curve of the figure of a design is broken at a jump beside the recommended brush."""
    with open_result(design) as file:
        name = str(table(file, "margins")["quantity"].values[0])
        profile = in_units(table(file, f"profile_{name}"))
    x, axes = profile[name].values, Figure().add_subplot()
    jump = (x[1] + 2 * x[2]) / 3
    draw_profile(axes, profile, name, 4, SimpleNamespace(margin_below=1 - jump / x[4], margin_above=np.nan))
    curve, _, dashed, _ = axes.lines
    assert np.flatnonzero(np.isnan(curve.get_ydata())).tolist() == [2] and np.allclose(dashed.get_xdata(), jump), curve.get_xydata()


def check_measure():
    """What the program measures for a sentence is what a check of the result measured, under each reading."""
    with h5py.File(results[0]) as file:
        columns = {name: file[f"checks/{name}"][()] for name in ("claim", "declared", "reading", "measured")}
    first = columns["declared"] == columns["declared"][list(columns["claim"]).index(b"7a")]
    measured = {reading.decode(): value for reading, value in zip(columns["reading"][first], columns["measured"][first])}
    end_ratio = {"predicate": "end_ratio", "variable": "R_x_norm", "along": "k_r",
                 "where": {"friction": "nss", "nominal_friction": 6.1984}}
    assert len(measured) == 3 and measure(bristle, results[0], end_ratio) == measured, measured
    try:
        measure(bristle, results[0], {**end_ratio, "variable": "R_z"})
    except BristleError as error:
        assert "R_z" in str(error), error
    else:
        raise AssertionError("an unknown variable was measured")


def check_sentences():
    """The numbers between braces: values at the ends and at the nearest values of axes, ranges, conditions, ratios, and formats."""
    quantities.PROGRAM.set(str(bristle))
    with open_result(results[0]) as file:
        friction = file["R_x_norm"].sel(friction="nss").isel(nominal_friction=-1)
        first = float(friction.sel(bending="rod").isel(k_r=0))
        ratios = [float(one.isel(k_r=-1) / one.isel(k_r=0)) for one in (friction.sel(bending=word) for word in quantities.READINGS)]
        bouncing = file["R_x_norm"].where(quantities.holds(file, "phase", ["bouncing"])).values
        every = "friction=nss nominal_friction=last"
        for sentence, expected in (
                (f"R_x_norm bending=rod k_r=5.1 {every}:.4f", f"{first:.4f}"),
                (f"k_r k_r=first:axis}} to {{k_r:most axis", "5 to 100"),
                (f"end_ratio R_x_norm along k_r {every} each:.3f", f"{ratios[0]:.3f} (as printed {ratios[1]:.3f}, rod {ratios[2]:.3f})"),
                (f"1 / end_ratio R_x_norm along k_r {every} all:.2f", f"{min(1 / one for one in ratios):.2f} to {max(1 / one for one in ratios):.2f}"),
                ("R_x_norm phase=bouncing:range .3f", f"{np.nanmin(bouncing):.3f} to {np.nanmax(bouncing):.3f}"),
                ("count phase=bouncing", str(np.isfinite(bouncing).sum())), ("steps k_r", str(file.sizes["k_r"] - 1)),
                ("setting load/R_n:g", "2")):
            assert (said := quantities.filled_in(f"{{{sentence}}}", file)) == expected, (sentence, said, expected)


def check_performance():
    """The times of a figure are those that time_experiments.py measures."""
    experiments = folder / "experiments"
    shutil.rmtree(experiments, ignore_errors=True)
    experiments.mkdir()
    shutil.copy(SOURCE / "experiments/paper.json", experiments)
    (experiments / "one.json").write_text('{"extends": "paper.json", "name": "one", "orientation": {"rtol": 0.1}}')
    done = subprocess.run([sys.executable, SOURCE / "scripts/time_experiments.py", bristle, "experiments/one.json", "--threads", "1"], cwd=folder,
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    (folder / "figures.json").write_text(done.stdout)
    (figure,) = json.loads(done.stdout)
    assert figure["points"] == 1 and figure["passages"] > 10 and 0 < figure["seconds"] < 60, figure
    curve = [{"error": error, "ms_per_bristle": cost, "evaluations": 100} for error, cost in ((1e-5, 0.4), (1e-4, 0.2), (1e-3, 0.1))]
    slow = [{**point, "ms_per_bristle": 7 * point["ms_per_bristle"]} for point in curve]
    write("engine.json", {
        "processor": "a processor", "instruction_set": "AVX2",
        "ordinary": [{"name": "SIMD, 8 lanes", "curve": curve, "ratio_at_1e-4": 1}, {"name": "Odeint", "curve": slow, "ratio_at_1e-4": 7}],
        "all_kinds": {"bristles": 321, "error": 1e-5, "odeint_error": 2e-5, "ms_per_bristle": 0.456, "ratio": 9.8, "lane_utilisation": 0.87}})
    write("scipy.json", [{"name": "SciPy", "curve": [{**point, "ms_per_bristle": 50 * point["ms_per_bristle"]} for point in curve]}])
    means = [{"passages": 128, "error": 1e-3, "estimate": 1e-3}, {"passages": 543, "error": 3e-4, "estimate": 4e-4}]
    write("quadrature.json", {"cases": [{"k_r": 10, "z_0": 0.5, **dict.fromkeys(("quadrature", "grid", "lattice"), means)}] * 2})
    commands = [{"kind": kind, "points": points, "commands": {"check": {"seconds": seconds, "MB": 41}, "archive": None,
                                                              "run, all points in the journal": {"seconds": 0.2, "MB": 9}, **(
        {"diff": {"seconds": 0.5, "MB": 98}} if points == 1000 else {})}}
        for kind, points, seconds in (("sweep", 1000, 0.12), ("sweep", 100000, 0.34), ("sample", 1000, 0.56), ("sample", 100000, 0.78))]
    write("commands.json", {"seconds": 1, "results": commands})
    write("build.json", {"build": 81, "test": 222})
    page = written("performance", "generated/performance.md", folder, "-o", folder)
    for words in ("| Odeint | 1.4 | 7 |", "| SciPy | 10 | 50 |", "321 of all kinds", "takes 0.456 ms per bristle", "9.8 times as long",
                  "`make build` takes 81 s of processor time, and `make test` 222 s more",
                  "| check | 0.12 | 0.34 | 0.56 | 0.78 | 41 |", "| diff | 0.50 | \u2013 | 0.50 | \u2013 | \u2013 |",
                  f"| one | 1 | {figure['passages']} | {figure['cpu_seconds']:.1f} | {figure['seconds']:.1f} | {figure['MB']} |"):
        assert words in page, (words, page)
    assert {path.name for path in (folder / "images").iterdir()} >= {"work-precision.png", "quadrature.png"}


# Loads deviate by 10 %, and two deviations of each trial keep the limit of 9 %, which 256 do not.
MARKED = {"extends": "ski.json", "name": "marked", "title": "marked",
          "si": {"m_kg": None, "rho_kg_per_m3": 1100, "pressure_Pa": 50000, "spacing_m": 0.004, "R_n_N": None, "tau_f_Pa": 5e7},
          "orientation": {"sampling": "list", "theta_0_deg": [20, 110], "rtol": 0.5},
          "sweep": {"friction": None, "R_n_N": None, "V0_m_per_s": None}, "tiers": {"smoke": None},
          "design": {"variables": {"rho_kg_per_m3": [1000, 1200]}, "tolerances": {"pressure_Pa": {"uniform": 0.1}},
                     "tolerance_samples": 2, "objective": {"minimise": "friction_coefficient", "of": "nominal"},
                     "constraints": [{"variable": "R_n_in_N", "max": 0.872}], "budget": 1}}


def check_drawing_of_brush():
    """The drawing has all that varies and the words of the result, is marked if a constraint is violated, and explains what it has."""
    for name in ("paper.json", "ski.json"):
        shutil.copy(SOURCE / "experiments" / name, folder)
    done = subprocess.run([bristle, "design", write("marked.json", MARKED), "-o", folder / "marked.h5"], capture_output=True, text=True)
    assert done.returncode == 1 and "VIOLATES R_n_in_N <= 0.872: 0.8" in done.stdout, done
    shown = [texts_of(folder / "marked.h5"), texts_of(design)]
    for text, has, lacks in ((shown[0], ["density of the shaft: ", "mean pressure of the slab on the lattice: 50 kPa\n    \u00b1 5 kPa",
                                         "VIOLATES R_n_in_N <= 0.872: 0.8", "of 256 brushes as made", "TREND ONLY: "],
                              ["s.d.", "99 %"]),
                             (shown[1], ["diameter of its shaft: ", "s.d.: standard deviation"], ["VIOLATES", "99 %", "density of"])):
        assert all(part in text for part in has) and not any(part in text for part in lacks), text


def texts_of(result):
    with open_result(result) as ds:
        return "\n".join(text.get_text() for text in draw(ds, "drawing").findobj(Text))


def check_drawings():
    for drawing in ("bristle", "rod"):
        done = called("bristle.pages.schematics", drawing, "-o", folder / f"{drawing}.svg")
        assert done.code == 0, done.messages
        assert len(list(ElementTree.parse(folder / f"{drawing}.svg").iter())) > 100


folder.mkdir(parents=True, exist_ok=True)
check_findings()
check_guide()
check_profile()
check_measure()
check_sentences()
check_performance()
check_drawings()
check_drawing_of_brush()
