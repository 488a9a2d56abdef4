"""Command lines: the only place where an error ends the program."""

import argparse
import os
import sys
from contextlib import ExitStack

from .errors import NOT_WRITTEN, BristleError, system_reason
from .figures import FIGURES, OF_ANY_RESULT, module_of
from .figures.curve import overlaid
from .files import save_pages
from .plotting.captions import captions, title_of
from .plotting.page import LEAST_POINTS, inches
from .plotting.readings import of_reading, pages
from .plotting.style import METADATA, apply_look
from .results import open_result, require_axes, source_of

PROGRAM = os.environ.get("BRISTLE_PLOT", "plot")  # the name by which scripts/plot was called
DPI_RANGE = 30, 2400

ANIMATED = ("fig2", "bristles")  # figures whose results have trajectories
OVERLAYING, DEFAULT_Y = "curve", "R_x_norm"  # the figure that may be of several results; the variable of figures of any result


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
    require_one_result(arguments)
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
    with ExitStack() as stack:
        files = [stack.enter_context(open_result(path)) for path in arguments.results]
        file = files[0]
        if arguments.labels or len(files) > 1:
            file = overlaid(files, labels_of(arguments), arguments.y or DEFAULT_Y)
        if arguments.reading:
            file = of_reading(file, arguments.reading)
        if arguments.caption:
            require_axes(file, arguments.figure, module.AXES)
            print("\n".join(captions(module, file, arguments.y, arguments.panels)))
            return
        further = {} if arguments.panels else getattr(module, "FURTHER", {})  # letters are as large as in the main figure
        source, written = "; ".join(source_of(one, form_of(arguments, parser)) for one in files), []
        # The main figure comes last: its PDF names all files, so that they are there if it is.
        for ending, function in reversed({"": module.draw, **further}.items()):
            drawn = pages(function, file, plain=arguments.plain, width=arguments.width, panels=arguments.panels,
                          maps_only=arguments.maps_only, cmap=arguments.cmap, **variable)
            written += save_pages(drawn, directory, "-".join(filter(None, [name_of(arguments), ending])), arguments.formats,
                                  arguments.dpi, (title_of(module, file, ending), source), written)
    print(", ".join(os.path.join(directory, name) for name in written))


def require_one_result(arguments):
    """Raises BristleError for several results, or labels of them, unless the picture can be of several."""
    if len(arguments.results) == 1 and not arguments.labels:
        return
    if arguments.figure != OVERLAYING:
        raise BristleError(f"{arguments.figure} is a picture of one result, without labels; {OVERLAYING} draws several results into one picture")
    if arguments.caption:
        raise BristleError("--caption is about one result, without labels")


def names_of(paths):
    """The names of files, without folders and endings."""
    return [os.path.splitext(os.path.basename(path))[0] for path in paths]


def labels_of(arguments):
    """A label for each result: the given ones, or the files' names."""
    labels = arguments.labels or names_of(arguments.results)
    if len(labels) != len(arguments.results):
        raise BristleError(f"--labels {','.join(labels)}: {len(labels)} labels for {len(arguments.results)} results; give one for each")
    if len(set(labels)) < len(labels):
        raise BristleError(f"--labels: {','.join(labels)} are not different; give each result a label of its own")
    return labels


def name_of(arguments):
    """How the names of the files begin: with the figure, or for a figure of any result with the result, the figure and the variable."""
    if arguments.figure not in OF_ANY_RESULT:
        return arguments.figure
    return "-".join([*names_of(arguments.results), arguments.figure, arguments.y or DEFAULT_Y])


def form_of(arguments, parser):
    """The options that are not the default ones, as a text."""
    given = {name: value for name, value in vars(arguments).items() if value != parser.get_default(name)}
    return " ".join(f"{name}={value}" for name, value in sorted(given.items()) if name not in ("figure", "results", "directory"))


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
    with open_result(arguments.results[0]) as file:
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
    parser.add_argument("results", metavar="RESULT.h5", nargs="+", help=f"result file of `bristle run`; {OVERLAYING} draws several into one picture")
    parser.add_argument("--labels", type=lambda text: text.split(","), metavar="LABEL,...",
                        help=f"what the legend of {OVERLAYING} calls the results (default: the files' names)")
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
                        help="only fig2 and bristles: the bristles under the moving slab instead of the figure, as FIGURE.gif or as the file "
                             "that -o names; of the other options it has --reading")
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
