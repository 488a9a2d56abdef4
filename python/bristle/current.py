"""Whether drawn files show what a result and the drawing code are now. Each says what it was drawn from.

Also a program, which imports no plotting library: python3 -m bristle.current FIGURE RESULT.h5 DIRECTORY ends with 0 if
all files of the figure are current.
"""

import hashlib
import os
import re
import sys
from importlib.metadata import PackageNotFoundError, version

from .needs import BROKEN

LIBRARIES = ["matplotlib", "numpy", "xarray", "pillow"]
HERE = os.path.dirname(os.path.abspath(__file__))
NOT_DRAWING = ("pages", "report")  # folders of the package without code of figures


def code_digest(folder, without=()):
    """SHA-256 of all modules below the folder, but not in its folders `without`, and of the versions of the libraries that draw."""
    digest = hashlib.sha256()
    for path, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if path != folder or name not in without)
        for name in sorted(name for name in names if name.endswith(".py")):
            with open(os.path.join(path, name), "rb") as file:
                digest.update(f"{os.path.relpath(os.path.join(path, name), folder)}\n".encode() + file.read())
    for library in LIBRARIES:
        try:
            digest.update(f"{library} {version(library)}\n".encode())
        except PackageNotFoundError:
            pass
    return digest.hexdigest()


def origin(attributes, commit, form=""):
    """What a figure of a result is drawn from, as a text for the figure's file; attributes: of the result; form: empty for
    the default options of the drawing."""
    texts = {name: as_text(attributes.get(name, "none")) for name in ("payload_sha256", "experiment_sha256", "tier")}
    drawing = hashlib.sha256(f"{code_digest(HERE, without=NOT_DRAWING)} {texts} {form}".encode()).hexdigest()
    return f"payload_sha256 {texts['payload_sha256']}; bristle commit {commit or 'unknown'}; drawing {drawing[:16]}"


def as_text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def is_current(figure, text, directory):
    """Whether the figure's PDF names its files, and all of them are there and say that they were drawn from this."""
    main = os.path.join(directory, f"{figure}.pdf")
    found = re.search(rb"/Keywords \(([^)]*)\)", read(main))
    names = found[1].decode("ascii", "replace").split() if found else []
    return f"{figure}.pdf" in names and all(text.encode() in read(os.path.join(directory, name)) for name in names)


def read(path):
    try:
        with open(path, "rb") as file:
            return file.read()
    except OSError:
        return b""


def main(figure, result, directory):
    try:
        import h5py
    except BROKEN:
        return 1  # drawing the figure says what is wrong
    with h5py.File(result) as file:
        commit = as_text(file["provenance"].attrs.get("commit", "")) if "provenance" in file else ""
        return 0 if is_current(figure, origin(file.attrs, commit), directory) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
