"""The Python and the libraries that the package needs, and what to do where one is missing."""

import sys
from importlib import import_module
from importlib.util import find_spec

PYTHON = 3, 11
FIGURES_NEED = ("numpy", "h5py", "matplotlib", "xarray", "h5netcdf")
BROKEN = ImportError, OSError, AttributeError, RuntimeError, ValueError  # what libraries raise that do not fit together
PACKAGES = {"yaml": "pyyaml"}  # of libraries whose module has another name


def need(*modules):
    """Raises ImportError, which says what to install, unless this Python is new enough and has all of the modules."""
    missing = [name for name in modules if name not in sys.modules and find_spec(name) is None]
    if sys.version_info < PYTHON:
        fail(f"{here()} is too old: bristle needs Python {'.'.join(map(str, PYTHON))} or newer")
    if missing:
        fail(f"{here()} has no {', '.join(missing)}, which bristle needs; {remedy(missing)}")


def load(name, package):
    """Imports a module of this package. Raises ImportError, which says what to install, if the libraries that it needs
    are there, but cannot be imported."""
    try:
        import_module("numpy")  # Debian's h5py hides why numpy cannot be imported
        return import_module(name, package)
    except BROKEN as error:
        fail(f"{here()} cannot import what the figures need ({error}); {remedy(FIGURES_NEED)}", error)


def fail(message, cause=None):
    """Raises ImportError with the message. Ends a program that is started by python3 -m, with the message alone."""
    if sys.argv[:1] == ["-m"]:  # as long as Python looks for the module of -m
        print(f"bristle: error: {message}", file=sys.stderr)
        raise SystemExit(2)
    raise ImportError(message) from cause


def here():
    return f"{sys.executable} (Python {'.'.join(map(str, sys.version_info[:3]))})"


def remedy(modules):
    """How to get the modules, in words."""
    return (f"on Debian and Ubuntu, install {' '.join(f'python3-{name}' for name in modules)} and use /usr/bin/python3; "
            f"elsewhere, {sys.executable} -m pip install {' '.join(PACKAGES.get(name, name) for name in modules)}")
