"""The matrix of claims and alternative assumptions that `bristle assumptions` writes (JSON)."""

from .errors import BristleError
from .files import read_json

SCHEMA = "bristle-assumptions/2"
REMEDY = "`make assumptions` writes it"
TOGETHER = "together"  # the choice of alternatives that combine others


def read_matrix(path):
    """The document."""
    document = read_json(path, REMEDY)
    schema = document.get("schema") if isinstance(document, dict) else None
    if schema != SCHEMA:
        raise BristleError(f"{path}: schema {schema or 'none'}; this script reads {SCHEMA}; {REMEDY}")
    return document


def digest_line(document):
    """The paragraph by which `bristle archive` knows which matrix a page describes."""
    return f"Payload digest of the matrix: {document['payload_sha256'][:16]}.\n\n"


def cells_by_place(path, document):
    """(index of the check, index of the alternative) -> cell."""
    cells = {(cell["check"], cell["alternative"]): cell for cell in document["cells"]}
    known = {(i, j) for i in range(len(document["checks"])) for j in range(len(document["alternatives"]))}
    if len(cells) < len(document["cells"]) or not known.issuperset(cells):
        raise BristleError(f"{path}: a cell occurs twice, or its check or alternative is not there")
    return cells
