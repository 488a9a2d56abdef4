"""The part of docs/your-own-brush.md that a design prints, from its result."""

import argparse

from ..command_line import run
from ..errors import BristleError
from ..results import as_text, open_result, table
from .markdown import replace_between

BEGIN, END = "<!-- design: written by `make guide` -->", "<!-- end of design -->"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("result", metavar="RESULT.h5", help="result of `bristle design`")
    parser.add_argument("-o", dest="output", metavar="FILE", default="docs/your-own-brush.md")
    arguments = parser.parse_args()
    provenance = table(open_result(arguments.result), "provenance")
    if provenance is None or "design" not in provenance.attrs:
        raise BristleError(f"{arguments.result}: is no result of a design; `make design` computes one")
    text = as_text(provenance.attrs["design"]).rstrip()
    replace_between(arguments.output, BEGIN, END, f"\n```text {arguments.result}\n{text}\n```\n")
    print(f"{arguments.output}: has what {arguments.result} found")


if __name__ == "__main__":
    run(main)
