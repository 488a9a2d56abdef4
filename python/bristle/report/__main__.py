"""The report: one page with figures, claims, points, diagnostics and provenance, from result files alone."""

import argparse
import hashlib
import os
import re

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup
from matplotlib import colormaps, colors

from .. import current, program
from ..command_line import run
from ..errors import BristleError
from ..figures.fig2 import PHASES
from ..files import read_json, write_text
from ..pages import summary
from ..pages.matrix import DEFAULT, REMEDY
from ..pages.quantities import MATRIX, PROGRAM, READINGS
from ..plotting import verdicts
from ..plotting.style import COLORMAP, apply_look
from ..results import as_text, experiment, open_result, readable
from . import bristles, claims, diagnostics, matrix, plots, points, sources, story, symbols, tables
from .remembered import remembered

HERE = os.path.dirname(os.path.abspath(__file__))
ASSETS = {"css": ["base.css", "parts.css", "story.css", "print.css"],
          "js": ["elements.js", "page.js", "tables.js", "data.js", "figures.js", "curves.js", "map.js", "explorer.js",
                 "readings.js", "scene.js", "player.js", "moving.js", "hand.js"]}
ENDINGS = (".py", ".js", ".css", ".j2")  # of the files that make the page; the figures need only the first
BRUSH = "brush.html"  # beside the report
# The parts behind a click: the template and the title of each.
REST = [("explorer", "Single points"), ("assumptions", "Assumptions"), ("deviations", "Deviations from the references"),
        ("diagnostics", "Diagnostics"), ("provenance", "Provenance"), ("citing", "Verify and cite")]


def main():
    parser = argparse.ArgumentParser(prog="report", description=__doc__)
    parser.add_argument("results", metavar="RESULT.h5", nargs="+",
                        help="result files in the figures' order; a missing file is named on the page")
    parser.add_argument("-o", dest="output", metavar="FILE", default="report/index.html")
    parser.add_argument("--program", default=program.DEFAULT,
                        help="for the comparison with the references (default: %(default)s)")
    parser.add_argument("--reference", default="reference",
                        help="folder of the references (default: %(default)s)")
    parser.add_argument("--assumptions", metavar="FILE", nargs="+", help="the first that exists is shown",
                        default=DEFAULT)
    parser.add_argument("--citation", default="CITATION.cff", help="(default: %(default)s)")
    parser.add_argument("--parts", metavar="FOLDER", default="build/report",
                        help="keeps what was drawn, so that the next page draws only what changed (default: %(default)s)")
    parser.add_argument("--brush", metavar="FILE", default="page/brush.html",
                        help="the page of a brush, copied beside the report if it was built (default: %(default)s)")
    arguments = parser.parse_args()
    apply_look()
    PROGRAM.set(arguments.program)
    MATRIX.set(next(filter(os.path.exists, arguments.assumptions), None))
    present = [path for path in arguments.results if os.path.exists(path)]
    if not present:
        raise BristleError(f"no such files: {', '.join(arguments.results)}; `make figures` computes them")
    origin = origin_of(arguments)
    if os.path.isfile(arguments.output) and origin in read_text(arguments.output):
        print(f"{arguments.output}: is up to date")
        return
    files = {path: open_result(path) for path in present}
    figures = [drawn(path, files[path], arguments) if path in files else missing(path) for path in arguments.results]
    page = render(figures, findings(files.values(), figures), passages(files.values()), origin, arguments)
    write_text(arguments.output, page)
    if os.path.isfile(arguments.brush):
        write_text(os.path.join(os.path.dirname(arguments.output), BRUSH), read_text(arguments.brush))
    print(f"{arguments.output}: {len(present)} of {len(figures)} figures, {len(page.encode()) / 1e6:.1f} MB")


def origin_of(arguments):
    """What the page is made from, as a text that it contains: a digest of all files, and the digest of the matrix's numbers."""
    matrix_file = MATRIX.get()
    others = [*arguments.results, matrix_file, arguments.citation, arguments.brush]
    numbers = "none" if matrix_file is None else read_json(matrix_file, REMEDY).get("payload_sha256", "none")
    return f"drawing {digest_of(others, arguments, ENDINGS)}; matrix {numbers}"


def drawn(path, file, arguments):
    """The figure of a result: of an earlier page if nothing changed on which it depends."""
    stem = os.path.splitext(os.path.basename(path))[0]
    return remembered(arguments.parts, stem, digest_of([path, MATRIX.get()], arguments, ENDINGS[:1]), lambda: figure(path, file, arguments))


def digest_of(paths, arguments, endings):
    """A digest of the code in files with these endings, the program, the references and the files at these paths, which
    may be None or missing."""
    digest = hashlib.sha256(current.code_digest(os.path.dirname(HERE), endings).encode())
    references = [os.path.join(arguments.reference, name) for name in sorted(os.listdir(arguments.reference))] \
        if os.path.isdir(arguments.reference) else []
    for path in [*paths, arguments.program, *references]:
        digest.update(f"{path} {sources.sha256(path) if path and os.path.isfile(path) else 'none'}\n".encode())
    return digest.hexdigest()[:32]


def read_text(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.read()


def findings(files, figures):
    """The first screen's numbers, and the findings to know first, as docs/findings.md has them."""
    judged = [file for file in files if verdicts.read_claims(file) or not experiment(file).get("checks")]
    found = [(file, summary.claims_of(file)) for file in judged]
    names = {name: text for figure in figures if figure["present"] for name, text in figure["symbols"].items()}
    lines, context = ([symbols.emphasised(line.replace("`", ""), names) for line in part]
                      for part in (summary.in_short(found), summary.in_context(found)))
    there = {as_text(file.attrs["name"]) for file in files}
    first = {"jump": lines[0]} if "load" in there and lines else {}  # two phases; without this result, the jump of Figure 7
    return {**story.read(found), **first, "findings": lines, "context": context}


def figure(path, file, arguments):
    """All data of one result for the page."""
    name = as_text(file.attrs["name"])
    names = verdicts.symbols(file)
    found = claims.read(name, file, names)
    deviation, replay = program.check(arguments.program, path, arguments.reference)
    drawings = plots.draw(name, file, claims.by_reading(found))
    return {
        "name": name, "path": path, "present": True, "symbols": names, **labels(name, as_text(file.attrs.get("figure", ""))),
        "title": symbols.prose(heading(file)),
        "caption": symbols.prose(as_text(file.attrs.get("caption", ""))),
        "tier": as_text(file.attrs.get("tier", "full")),
        "notes": [symbols.prose(note, names) for note in experiment(file).get("notes", [])],
        "drawings": drawings, "claims": found,
        "points": points.collect(file, replay),
        "columns": tables.read(arguments.program, path, file),
        "deviation": deviation, "outcome": program.outcome(deviation),
        "diagnostics": diagnostics.read(file), "provenance": sources.provenance(file, path),
    }


def labels(name, number):
    """Name and short name of a figure; one that is not of the paper is a study."""
    return {"label": f"Figure {number}" if number else f"Study {name}", "number": number or name}


def heading(file):
    """The title without the figure's number, which is printed before it."""
    title = as_text(file.attrs["title"])
    return re.sub(r"^(Figure \w+|Appendix \w+)[:,] (.)", lambda found: found.group(2).upper(), title)


def missing(path):
    """A figure without a result, with the command that computes it."""
    stem = os.path.splitext(os.path.basename(path))[0]
    name = re.split("[-_]", stem)[0]
    tier = " TIER=smoke" if stem.endswith("smoke") else ""
    number = name.removeprefix("fig") if name.startswith("fig") else ""
    return {"name": name, "path": path, "present": False, **labels(name, number), "claims": [],
            "command": f"make {name}{tier}"}


def passages(files):
    """What the page's players show."""
    return {"played": bristles.played(files), "recorded": bristles.recorded(files)}


def render(figures, story_found, moving, origin, arguments):
    environment = Environment(loader=FileSystemLoader(os.path.join(HERE, "templates")), autoescape=True,
                              undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    all_claims = [claim for figure in figures for claim in figure["claims"]]
    shown = [figure for figure in figures if figure["present"]]
    provenance = sources.compare([figure["provenance"] for figure in shown])
    citation = sources.citation(arguments.citation, provenance["same"].get("commit", ""))
    names = {figure["name"]: figure["symbols"] for figure in shown}
    drawings = [drawing for figure in shown for drawing in figure["drawings"]]
    words = [drawing["reading"] for drawing in drawings if drawing["reading"]]
    letters = {name: shape for drawing in drawings for name, shape in drawing["letters"].items()}
    parts = [*["findings"] * bool(story_found["findings"]), *["player"] * bool(moving["played"]), *["jump"] * ("fig4" in names),
             *["claims"] * bool(all_claims)]
    return environment.get_template("page.html.j2").render(
        origin=origin, figures=figures, shown=shown, letters=sorted(letters.items()), missing=[figure for figure in figures if not figure["present"]], names=names,
        story=story_found, parts=parts, rest=REST, readings={word: READINGS.get(word, readable(word)) for word in words},
        claims=claims.overview(all_claims), count=claims.count(all_claims),
        tiers=sorted({figure["tier"] for figure in shown}),
        matrix=matrix.read(arguments.assumptions, names), citation=citation, bibtex=program.cite(arguments.program),
        brush=BRUSH if os.path.isfile(arguments.brush) else "",
        paper=next((entry["link"] for entry in citation if entry["kind"] == "article"), ""),
        provenance=provenance, played=moving["played"], recorded=moving["recorded"], phases=points.embedded(PHASES),
        colours=points.embedded([colors.to_hex(colormaps[COLORMAP](i / 32)) for i in range(33)]),
        packed=lambda data: tables.packed(points.embedded(data)), **{kind: asset(names) for kind, names in ASSETS.items()})


def asset(names):
    parts = []
    for name in names:
        with open(os.path.join(HERE, "templates", name), encoding="utf-8") as file:
            parts.append(file.read())
    return Markup("\n".join(parts))


if __name__ == "__main__":
    run(main, "report")
