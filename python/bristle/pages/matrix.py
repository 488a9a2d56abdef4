"""The matrix of claims and alternative assumptions that `bristle assumptions` writes (JSON)."""

from ..errors import BristleError
from ..files import read_json

SCHEMA = "bristle-assumptions/4"
REMEDY = "`make assumptions` writes it"
TOGETHER = "together"  # the choice of alternatives that combine others


def read_matrix(path):
    """The document; cells: the cells with their place and the names of their values; grid[check][alternative]: the same cells.
    The first alternative is the baseline."""
    document = read_json(path, REMEDY)
    schema = document.get("schema") if isinstance(document, dict) else None
    if schema != SCHEMA:
        raise BristleError(f"{path}: schema {schema or 'none'}; this script reads {SCHEMA}; {REMEDY}")
    try:
        cells = list(cells_of(document))
        width = len(document["alternatives"])
        grid = [cells[i:i + width] for i in range(0, len(cells), width)]
        return {**document, "cells": cells, "grid": grid, "conclusions": document["conclusions"], "tier": document["tier"]}
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise BristleError(f"{path}: not valid as {schema} ({type(error).__name__}: {error})") from error


def cells_of(document):
    size = len(document["alternatives"])
    if missing := {"claim_verdict", "verdict"} - set(document["cell_keys"]):
        raise ValueError(f"the cells have no {' and no '.join(sorted(missing))}")
    if [row["check"] for row in document["cells"]] != list(range(len(document["checks"]))):
        raise ValueError("the rows of cells are not those of the checks")
    for row in document["cells"]:
        if len(row["under"]) != size:
            raise ValueError(f"check {row['check']} has {len(row['under'])} cells, not {size}")
        for i, cell in enumerate(row["under"]):
            # null: the alternative does not change the experiment, so the baseline's cell holds.
            values = zip(document["cell_keys"], row["under"][0] if cell is None else cell, strict=True)
            yield {"check": row["check"], "alternative": i, **dict(values), "affected": cell is not None}


def digest_line(document):
    """The paragraph by which `bristle archive` knows which matrix a page describes."""
    return f"Payload digest of the matrix: {document['payload_sha256'][:16]}.\n\n"


def reversed_verdict(cell, baseline):
    return {cell["verdict"], baseline["verdict"]} == {"supported", "refuted"}
