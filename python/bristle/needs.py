"""The Python and the libraries that the package needs, and what to do where one is missing."""

import sys
from importlib.util import find_spec

PYTHON = 3, 11
FIGURES_NEED = ("numpy", "h5py", "matplotlib", "xarray", "h5netcdf")
PACKAGES = {"yaml": "pyyaml"}  # of libraries whose module has another name


def need(*modules):
    """Raises ImportError, which says what to install, unless this Python is new enough and has all of the modules."""
    missing = [name for name in modules if name not in sys.modules and find_spec(name) is None]
    if sys.version_info < PYTHON:
        raise ImportError(f"{here()} is too old: bristle needs Python {'.'.join(map(str, PYTHON))} or newer")
    if missing:
        raise ImportError(f"{here()} has no {', '.join(missing)}, which bristle needs; {remedy(missing)}")


def here():
    return f"{sys.executable} (Python {'.'.join(map(str, sys.version_info[:3]))})"


def remedy(modules):
    """How to get the modules, in words."""
    return (f"on Debian and Ubuntu, install {' '.join(f'python3-{name}' for name in modules)} and use /usr/bin/python3; "
            f"elsewhere, {sys.executable} -m pip install {' '.join(PACKAGES.get(name, name) for name in modules)}")
