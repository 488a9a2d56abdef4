"""Reading JSON, and writing files so that they are complete or absent."""

import contextlib
import io
import json
import os
import re

from matplotlib.backends.backend_pdf import PdfPages

from .errors import NOT_WRITTEN, BristleError, system_reason
from .plotting.style import METADATA

FIGURE_FORMATS = ("pdf", "png")
# Of formats without lines: what names them, among numbers.
SIGNATURE = re.compile(rb"(GIF89a)")


def read_json(path, remedy):
    """The document in the file; remedy: how to make the file, for the error message."""
    if os.path.exists(path) and not os.path.isfile(path):
        raise BristleError(f"{path}: not a regular file; {remedy}")
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except OSError as error:
        raise BristleError(f"{path}: {system_reason(error)}; {remedy}") from error
    except ValueError as error:
        raise BristleError(f"{path}: not JSON ({error}); {remedy}") from error


def write_whole(path, content):
    """Writes the bytes, creating the folder; after an error there is no incomplete file."""
    require_replaceable(path, content)
    part = f"{path}.{os.getpid()}.part"
    try:
        os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
        with open(part, "xb") as file:  # never through a link
            file.write(content)
        os.replace(part, path)
    except OSError as error:
        with contextlib.suppress(OSError):
            if not isinstance(error, FileExistsError):
                os.remove(part)
        raise BristleError(f"{path}: cannot be written ({system_reason(error)})", NOT_WRITTEN) from error


def require_replaceable(path, content):
    """Raises BristleError unless nothing stands at path, or an empty file, or one with the same first line.

    The first line is the title of a page, or the signature of PDF and PNG. Animations have no lines, but a signature.
    """
    if not os.path.lexists(path):
        return
    if os.path.islink(path) or not os.path.isfile(path):
        raise BristleError(f"{path}: not a regular file, and would be replaced; choose another name for the output")
    try:
        with open(path, "rb") as file:
            found = beginning(file)
    except OSError as error:
        raise BristleError(f"{path}: cannot be read: {system_reason(error)}") from error
    if found and found != beginning(io.BytesIO(content)):
        raise BristleError(f"{path}: something else than this script writes, and would be replaced; "
                           "choose another name for the output")


def beginning(file):
    """The first line, or the signature."""
    start = file.read(1000)
    signature = SIGNATURE.match(start)
    if signature:
        return signature[signature.lastindex]
    return start[:start.find(b"\n") + 1] or start


def write_text(path, text):
    write_whole(path, text.encode())


def metadata(kind, about):
    """about: title, source, and for a PDF the names of all files, of a figure; none if empty."""
    keys = {"pdf": ("Title", "Subject", "Keywords"), "png": ("Title", "Source"), "svg": ("Title", "Source")}[kind]
    return {**METADATA[kind], **dict(zip(keys, about))}


def save_figure(figure, directory, name, formats=FIGURE_FORMATS, about=(), **options):
    """Writes the figure as name.pdf and name.png; equal figures give equal bytes."""
    for kind in formats:
        buffer = io.BytesIO()
        figure.savefig(buffer, format=kind, metadata=metadata(kind, about), **options)
        write_whole(os.path.join(directory, f"{name}.{kind}"), buffer.getbuffer())


def save_pages(pages, directory, name, formats, dpi, about=(), others=()):
    """Writes all pages (ending, reading, figure) as one PDF with the first one's ending, and each as a PNG and SVG.

    Returns the names of the files. The PDF, which is written last, states them, and the others.
    """
    images = [kind for kind in formats if kind != "pdf"]
    names = [f"{name}{ending}.{kind}" for ending, _, _ in pages for kind in images]
    for ending, _, figure in pages:
        save_figure(figure, directory, name + ending, images, about, dpi=dpi)
    if "pdf" in formats:
        names.insert(0, f"{name}{pages[0][0]}.pdf")
        buffer = io.BytesIO()
        with PdfPages(buffer, metadata=metadata("pdf", (*about, " ".join([*names, *others])))) as pdf:
            for _, _, figure in pages:
                pdf.savefig(figure, dpi=dpi)
        write_whole(os.path.join(directory, names[0]), buffer.getbuffer())
    return names
