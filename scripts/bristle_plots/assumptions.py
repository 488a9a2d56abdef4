"""The matrix of claims and alternative assumptions that `bristle assumptions` writes (JSON)."""

from .errors import BristleError
from .files import read_json

SCHEMA, OLD_SCHEMA = "bristle-assumptions/2", "bristle-assumptions/1"
REMEDY = "`make assumptions` writes it"
TOGETHER = "together"  # the choice of alternatives that combine others


def read_matrix(path):
    """The document, in the current schema."""
    document = read_json(path, REMEDY)
    schema = document.get("schema") if isinstance(document, dict) else None
    if schema not in (SCHEMA, OLD_SCHEMA):
        raise BristleError(f"{path}: schema {schema or 'none'}; this script reads {SCHEMA}; {REMEDY}")
    try:
        return upgraded(document) if schema == OLD_SCHEMA else document
    except (KeyError, TypeError, AttributeError) as error:
        raise BristleError(f"{path}: not valid as {schema} ({type(error).__name__}: {error})") from error


def upgraded(document):
    """A document of bristle-assumptions/1 with the names of bristle-assumptions/2."""
    keys, conclusions = {"settled": "baseline", "hangs_on": "depends_on"}, {"hangs": "assumption-dependent"}

    def conclusion(old):
        new = {keys.get(key, key): value for key, value in old.items()}
        return {**new, "conclusion": conclusions.get(old["conclusion"], old["conclusion"])}

    def alternative(old):
        return {**old, "name": "baseline"} if (old["choice"], old["name"]) == ("", "settled") else old

    return {**document, "schema": SCHEMA, "alternatives": [*map(alternative, document["alternatives"])],
            "conclusions": [*map(conclusion, document.get("conclusions", []))]}


def digest_line(document):
    """The paragraph by which `bristle archive` knows which matrix a page describes; earlier matrices have no digest."""
    digest = document.get("payload_sha256")
    return f"Payload digest of the matrix: {digest[:16]}.\n\n" if digest else ""


def cells_by_place(path, document):
    """(index of the check, index of the alternative) -> cell."""
    cells = {(cell["check"], cell["alternative"]): cell for cell in document["cells"]}
    known = {(i, j) for i in range(len(document["checks"])) for j in range(len(document["alternatives"]))}
    if len(cells) < len(document["cells"]) or not known.issuperset(cells):
        raise BristleError(f"{path}: a cell occurs twice, or its check or alternative is not there")
    return cells


def reversed_verdict(cell, baseline):
    return {cell["verdict"], baseline["verdict"]} == {"supported", "refuted"}
