"""Commands of scripts/ called in this process: a process for each would import matplotlib and xarray for each."""
import contextlib
import io
import pathlib
import runpy
import sys
from collections import namedtuple

SCRIPTS = pathlib.Path(__file__).parents[2] / "scripts"
sys.path[:0] = map(str, (SCRIPTS, SCRIPTS / "report"))

Done = namedtuple("Done", "code out messages")


def called(script, *words):
    """The exit code, standard output and standard error of SCRIPTS/script; "plot" is scripts/plot, which a shell starts."""
    out, messages, code = io.StringIO(), io.StringIO(), 0
    before = sys.argv
    sys.argv = [script, *map(str, words)]
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(messages):
            if script == "plot":
                runpy.run_module("bristle_plots", run_name="__main__")
            else:
                runpy.run_path(str(SCRIPTS / script), run_name="__main__")
    except SystemExit as end:
        code = end.code or 0
    finally:
        sys.argv = before
    return Done(code, out.getvalue(), messages.getvalue())
