"""What the page was made from: digests and provenance of the results."""

import hashlib

from ..results import as_text, table

DIGESTS = ["payload_sha256", "experiment_sha256", "inputs_sha256", "numerics_version"]


def provenance(file, path):
    """Digests of the file, and all of /provenance."""
    stored = {} if table(file, "provenance") is None else table(file, "provenance").attrs
    found = {key: as_text(value).strip() for key, value in stored.items()}
    with open(path, "rb") as content:
        digests = {"sha256": hashlib.sha256(content.read()).hexdigest()}
    digests |= {name: as_text(file.attrs[name]) for name in DIGESTS if name in file.attrs}
    return {"digests": digests, "provenance": found, "commit": found.get("commit", ""), "started": found.get("started", "")}


def of_page(page, files):
    """For `bristle archive`: the digest of the page, and by name those of the numbers of the results that it shows."""
    return {"page_sha256": hashlib.sha256(page.encode()).hexdigest(),
            "payload_sha256": {as_text(file.attrs["name"]): as_text(file.attrs["payload_sha256"]) for file in files}}
