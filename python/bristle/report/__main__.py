"""The report: one static page with figures, claims, limits and provenance, from result files alone."""

import argparse
import json
import os
import re

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from .. import program
from ..command_line import run
from ..errors import BristleError
from ..files import write_text, write_whole
from ..pages import summary
from ..pages.quantities import PROGRAM
from ..plotting import remarks, verdicts
from ..plotting.style import apply_look
from ..results import as_text, experiment, open_result, status_counts
from . import claims, drawings, sources
from .symbols import emphasised, prose

TEMPLATES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "templates")
BRUSH, SOURCES = "brush.html", "sources.json"  # beside the report


def main():
    parser = argparse.ArgumentParser(prog="report", description=__doc__)
    parser.add_argument("results", metavar="RESULT.h5", nargs="+",
                        help="result files in the figures' order; a missing file is named on the page")
    parser.add_argument("-o", dest="output", metavar="FILE", default="report/index.html",
                        help=f"the page (default: %(default)s); {SOURCES} beside it says what it was made from")
    parser.add_argument("--program", default=program.DEFAULT, help="what measures on the results (default: %(default)s)")
    parser.add_argument("--brush", metavar="FILE", default="page/brush.html",
                        help="the page of a brush, copied beside the report if it was built (default: %(default)s)")
    arguments = parser.parse_args()
    apply_look()
    PROGRAM.set(arguments.program)
    files = {path: open_result(path) for path in arguments.results if os.path.exists(path)}
    if not files:
        raise BristleError(f"no such files: {', '.join(arguments.results)}; `make figures` computes them")
    brush = os.path.isfile(arguments.brush)
    styles = {}
    figures = [figure(path, files[path], styles) if path in files else missing(path) for path in arguments.results]
    page = render(figures, list(files.values()), styles, BRUSH if brush else "", program.cite(arguments.program))
    folder = os.path.dirname(arguments.output)
    write_text(arguments.output, page)
    if brush:
        with open(arguments.brush, "rb") as file:
            write_whole(os.path.join(folder, BRUSH), file.read())
    write_text(os.path.join(folder, SOURCES), json.dumps(sources.of_page(page, files.values()), indent=1) + "\n")
    print(f"{arguments.output}: {len(files)} of {len(figures)} figures, {len(page.encode()) / 1e6:.1f} MB")


def figure(path, file, styles):
    """What the page says of one result; styles: of its drawings."""
    name, names = as_text(file.attrs["name"]), verdicts.symbols(file)
    said = [*experiment(file).get("notes", []), remarks.start_note(file), remarks.pinned_note(file), remarks.validity_note(file)]
    return {
        "name": name, "path": path, "present": True, "title": prose(as_text(file.attrs["title"])),
        "caption": prose(as_text(file.attrs.get("caption", ""))),
        "tier": as_text(file.attrs.get("tier", "full")), "drawings": drawings.draw(name, file, styles),
        "notes": [prose(note, names) for note in said if note], "claims": claims.read(name, file, names),
        "limits": remarks.limits(file), "statuses": status_counts(file), **sources.provenance(file, path),
    }


def missing(path):
    """A figure without a result, with the command that computes it."""
    stem = os.path.splitext(os.path.basename(path))[0]
    name = re.split("[-_]", stem)[0]
    tier = " TIER=smoke" if stem.endswith("smoke") else ""
    return {"name": name, "path": path, "present": False, "command": f"make {name}{tier}"}


def findings(files):
    """The findings to know first, and what belongs to them, as docs/findings.md has them."""
    judged = [file for file in files if verdicts.read_claims(file) or not experiment(file).get("checks")]
    found = [(file, summary.claims_of(file)) for file in judged]
    return [[emphasised(line.replace("`", ""), verdicts.FURTHER_SYMBOLS) for line in part]
            for part in (summary.in_short(found), summary.in_context(found))]


def limits(figures):
    """For each limit of the model, the figures with points beyond it: name, points beyond it, points with a value."""
    found = {}
    for one in figures:
        for meaning, beyond, judged in one["limits"]:
            if beyond:
                found.setdefault(meaning, []).append((one["name"], beyond, judged))
    return found


def render(figures, files, styles, brush, bibtex):
    environment = Environment(loader=FileSystemLoader(TEMPLATES), autoescape=True, undefined=StrictUndefined,
                              trim_blocks=True, lstrip_blocks=True)
    with open(os.path.join(TEMPLATES, "page.css"), encoding="utf-8") as file:
        css = Markup(file.read() + "".join(f".{name} {{ {style} }}\n" for style, name in styles.items()))
    shown = [one for one in figures if one["present"]]
    first, context = findings(files)
    return environment.get_template("page.html.j2").render(
        css=css, figures=figures, shown=shown, missing=[one for one in figures if not one["present"]],
        findings=first, context=context, overview=claims.overview(shown), limits=limits(shown), brush=brush,
        bibtex=bibtex.strip(), tiers=sorted({one["tier"] for one in shown}))


if __name__ == "__main__":
    run(main, "report")
