"""Reading JSON, and writing files so that they are complete or absent."""

import contextlib
import io
import json
import os

from .errors import NOT_WRITTEN, BristleError
from .style import METADATA

FIGURE_FORMATS = ("pdf", "png")


def read_json(path, remedy):
    """The document in the file; remedy: how to make the file, for the error message."""
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except OSError as error:
        raise BristleError(f"{path}: {error.strerror}; {remedy}") from error
    except ValueError as error:
        raise BristleError(f"{path}: not JSON ({error}); {remedy}") from error


def write_whole(path, content):
    """Writes the bytes, creating the folder; after an error there is no incomplete file."""
    try:
        os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
        with open(path + ".part", "wb") as part:
            part.write(content)
        os.replace(path + ".part", path)
    except OSError as error:
        with contextlib.suppress(OSError):
            os.remove(path + ".part")
        raise BristleError(f"{path}: cannot be written ({error.strerror})", NOT_WRITTEN) from error


def write_text(path, text):
    write_whole(path, text.encode())


def save_figure(figure, directory, name, formats=FIGURE_FORMATS, **options):
    """Writes the figure as name.pdf and name.png; equal figures give equal bytes."""
    for kind in formats:
        buffer = io.BytesIO()
        figure.savefig(buffer, format=kind, metadata=METADATA[kind], **options)
        write_whole(os.path.join(directory, f"{name}.{kind}"), buffer.getbuffer())
