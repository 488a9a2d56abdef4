"""The part of docs/your-own-brush.md that a design prints, and what it means, from its result."""

import argparse
import textwrap

from ..command_line import run
from ..errors import BristleError
from ..results import as_text, open_result, table, table_with
from .markdown import COLUMNS, filled, replace_between

BEGIN, END = "<!-- design: written by `make guide` -->", "<!-- end of design -->"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("result", metavar="RESULT.h5", help="result of `bristle design`")
    parser.add_argument("-o", dest="output", metavar="FILE", default="docs/your-own-brush.md")
    arguments = parser.parse_args()
    file = open_result(arguments.result)
    trials = table(file, "trials")
    if trials is None:
        raise BristleError(f"{arguments.result}: is no result of a design; `make design` computes one")
    text = "\n".join(map(wrapped, as_text(trials.attrs["summary"]).splitlines()))
    replace_between(arguments.output, BEGIN, END, f"\n```text {arguments.result}\n{text}\n```\n\n{filled(story(file))}\n")
    print(f"{arguments.output}: has what {arguments.result} found")


def wrapped(line):
    """A sentence as the terminal shows it; a row of a table stays."""
    if "  " in line.strip():
        return line
    begin = " " * (len(line) - len(line.lstrip()))
    return textwrap.fill(line.strip(), COLUMNS, initial_indent=begin, subsequent_indent=begin + "    ", break_on_hyphens=False)


def story(file):
    """What the design of the example means: friction is its objective, jump_margin its second constraint, R_m its first quantity."""
    start = table_with(file, "comparison", "constraint_2").set_index(brush="brush").sel(brush="start")
    margins = table_with(file, "margins", "margin_below").set_index(quantity="quantity")
    found = table_with(file, "verification", "objective", "brushes", "bouncing").isel(brush=0)
    return f"""The gap of the start jumps if one of its dimensions changes by {percent(start.constraint_2)}, less than the constraint allows. The
recommended brush, as made, jumps if its radius is {percent(margins.margin_below.sel(quantity="R_m"))} smaller. Of
{int(found.brushes)} brushes made like it {percent(found.bouncing / found.brushes)} bounce; five in a hundred have a friction
above {float(found.objective):.2f} ± {float(found.objective_err):.2f}. The drawing is of the nominal brush, without deviations, which
carries {percent(table_with(file, "working_range", "load_over_lift_off").load_over_lift_off.item())} of its lift-off load."""


def percent(share):
    return f"{100 * float(share):.0f} %"


if __name__ == "__main__":
    run(main)
