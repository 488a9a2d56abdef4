"""Modules of the package called in this process: a process for each would import matplotlib and xarray for each."""
import contextlib
import io
import pathlib
import runpy
import sys
from collections import namedtuple

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = SOURCE / "python"  # the folder in which Python finds the package
sys.path.insert(0, str(PACKAGE))

Done = namedtuple("Done", "code out messages")


def called(module, *words):
    """The exit code, standard output and standard error of `python3 -m MODULE WORDS`."""
    out, messages, code = io.StringIO(), io.StringIO(), 0
    before = sys.argv
    sys.argv = [module, *map(str, words)]
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(messages):
            runpy.run_module(module, run_name="__main__")
    except SystemExit as end:
        code = end.code or 0
    finally:
        sys.argv = before
    return Done(code, out.getvalue(), messages.getvalue())
