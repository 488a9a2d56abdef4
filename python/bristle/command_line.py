"""Command lines: the only place where an error ends the program."""

import argparse
import os
import sys

from .errors import NOT_WRITTEN, BristleError, system_reason
from .figures import FIGURES, module_of
from .files import save_pages
from .plotting.captions import captions, title_of
from .plotting.page import LEAST_POINTS, inches
from .plotting.readings import of_reading, pages
from .plotting.style import METADATA, apply_look
from .results import open_result, require_axes, source_of

PROGRAM = os.environ.get("BRISTLE_PLOT", "plot")  # the name by which scripts/plot was called
DPI_RANGE = 30, 2400

ANIMATED = ("fig2", "bristles")  # figures whose results have trajectories
OF_ANY_RESULT, DEFAULT_Y = ("curve", "map"), "R_x_norm"  # figures of a variable of any result


def run(main, program=None):
    """Calls main(); an error becomes one line on stderr and the exit code (2: wrong input, 3: not written)."""
    name = program or os.path.basename(sys.argv[0])
    try:
        main()
        print(end="", flush=True)  # what is printed must be written, unless standard output is closed
    except BristleError as error:
        print(f"{name}: error: {error}", file=sys.stderr)
        raise SystemExit(error.exit_code) from None
    except OSError as error:
        if error.filename is not None:  # a file, not standard output
            raise
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # for what is left to print when Python ends
        print(f"{name}: error: standard output: cannot be written ({system_reason(error)})", file=sys.stderr)
        raise SystemExit(NOT_WRITTEN) from None


def draw_figure():
    """FIGURE RESULT.h5: all pages of a figure, and its further figures."""
    parser = figure_parser()
    arguments = parser.parse_args(with_values(sys.argv[1:]))
    if arguments.animate:
        draw_animation(arguments, parser)
        return
    for_paper = arguments.plain or arguments.width is not None
    directory = arguments.directory or ("figures/paper" if for_paper else "figures")
    variable = {} if arguments.y is None else {"y": arguments.y}
    if variable and arguments.figure not in OF_ANY_RESULT:
        raise BristleError(f"--y {arguments.y}: only the figures curve and map have a variable to choose, not {arguments.figure}")
    apply_look()
    module = module_of(arguments.figure)
    with open_result(arguments.result) as file:
        if arguments.reading:
            file = of_reading(file, arguments.reading)
        if arguments.caption:
            require_axes(file, arguments.figure, module.AXES)
            print("\n".join(captions(module, file, arguments.y, arguments.panels)))
            return
        further = {} if arguments.panels else getattr(module, "FURTHER", {})  # letters are as large as in the main figure
        source, written = source_of(file, form_of(arguments, parser)), []
        # The main figure comes last: its PDF names all files, so that they are there if it is.
        for ending, function in reversed({"": module.draw, **further}.items()):
            drawn = pages(function, file, plain=arguments.plain, width=arguments.width, panels=arguments.panels,
                          maps_only=arguments.maps_only, cmap=arguments.cmap, **variable)
            written += save_pages(drawn, directory, "-".join(filter(None, [name_of(arguments), ending])), arguments.formats,
                                  arguments.dpi, (title_of(module, file, ending), source), written)
    print(", ".join(os.path.join(directory, name) for name in written))


def name_of(arguments):
    """How the names of the files begin: with the figure, or for a figure of any result with the result, the figure and the variable."""
    if arguments.figure not in OF_ANY_RESULT:
        return arguments.figure
    result = os.path.splitext(os.path.basename(arguments.result))[0]
    return "-".join([result, arguments.figure, arguments.y or DEFAULT_Y])


def form_of(arguments, parser):
    """The options that are not the default ones, as a text."""
    given = {name: value for name, value in vars(arguments).items() if value != parser.get_default(name)}
    return " ".join(f"{name}={value}" for name, value in sorted(given.items()) if name not in ("figure", "result", "directory"))


def draw_animation(arguments, parser):
    """Of figures with recorded trajectories, and without most of the options."""
    if arguments.figure not in ANIMATED:
        raise BristleError(f"--animate: only {' and '.join(ANIMATED)} have recorded trajectories, not {arguments.figure}")
    without = {"plain": "plain", "width": "width", "panels": "panels", "maps_only": "maps-only", "cmap": "cmap", "y": "y",
               "caption": "caption", "formats": "format", "dpi": "dpi"}
    if given := [f"--{option}" for name, option in without.items() if getattr(arguments, name) != parser.get_default(name)]:
        raise BristleError(f"--animate has one size; it has no {', '.join(given)}")
    from . import animation
    path = animation.film_path(arguments.directory or "figures", arguments.figure)
    apply_look()
    with open_result(arguments.result) as file:
        animation.write_animation(of_reading(file, arguments.reading) if arguments.reading else file, path)


def with_values(words):
    """The words of the command line, where --width -1in is --width=-1in: a wrong value, not a missing one."""
    out = []
    for word in words:
        if out and out[-1] in ("--width", "--dpi") and word.startswith("-"):
            out[-1] += f"={word}"
        else:
            out.append(word)
    return out


def figure_parser():
    parser = argparse.ArgumentParser(prog=PROGRAM, description="Draws a figure from a result file.")
    parser.add_argument("figure", metavar="FIGURE", type=figure, help=", ".join(FIGURES))
    parser.add_argument("result", metavar="RESULT.h5", help="result file of `bristle run`")
    parser.add_argument("-o", dest="directory", metavar="DIRECTORY",
                        help="where to write FIGURE.pdf and FIGURE.png (of curve and map RESULT-FIGURE-VARIABLE.pdf, .png), and "
                             "a PNG for each further page (default: "
                             "figures; with --plain or --width: figures/paper); with --animate also a file")
    parser.add_argument("--plain", action="store_true", help="without title, notes and verdicts")
    parser.add_argument("--width", type=width, metavar="WIDTH",
                        help="width of the page, such as 3.5in, 7in, 9cm or 180mm: panels are arranged for it and letters "
                             f"have at least {LEAST_POINTS} points; implies --plain")
    parser.add_argument("--reading", metavar="MODEL",
                        help="only this model of bending: polar (corrected), polar_as_printed or rod")
    parser.add_argument("--panels", metavar="LETTER,...", help="only these panels of the figure, with letters anew, such as a,d")
    parser.add_argument("--maps-only", action="store_true", help="maps without the surfaces above them")
    parser.add_argument("--cmap", metavar="NAME", help="matplotlib's colour map for maps and surfaces (default: viridis)")
    parser.add_argument("--y", metavar="VARIABLE", help=f"what the figures curve and map draw (default: {DEFAULT_Y})")
    parser.add_argument("--caption", action="store_true", help="draws nothing, but prints a caption in LaTeX for each page")
    parser.add_argument("--animate", action="store_true",
                        help="only fig2 and bristles: the bristles under the moving slab instead of the figure, as FIGURE.gif or as the .gif, .webp or "
                             ".mp4 that -o names; of the other options it has --reading")
    parser.add_argument("--format", dest="formats", type=formats, metavar="FORMAT,...", default=["pdf", "png"],
                        help=f"of {', '.join(METADATA)} (default: pdf,png)")
    parser.add_argument("--dpi", type=dpi, default=300, help="pixels per inch of a PNG (default: %(default)s)")
    return parser


def figure(name):
    try:
        module_of(name)
    except BristleError as error:
        raise argparse.ArgumentTypeError(str(error)) from error
    return name


def width(text):
    try:
        return inches(text)
    except BristleError as error:
        raise argparse.ArgumentTypeError(str(error).removeprefix("width ")) from error


def dpi(text):
    if not (text.isdecimal() and DPI_RANGE[0] <= int(text) <= DPI_RANGE[1]):
        raise argparse.ArgumentTypeError(f"{text}: a whole number from {DPI_RANGE[0]} to {DPI_RANGE[1]} is needed")
    return int(text)


def formats(text):
    found = list(dict.fromkeys(text.split(",")))
    if unknown := [kind for kind in found if kind not in METADATA]:
        raise argparse.ArgumentTypeError(f"{', '.join(unknown) or text}: allowed are {', '.join(METADATA)}, with commas "
                                         "between them")
    return found
