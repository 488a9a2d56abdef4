"""Provenance of the numbers, and citations."""

import hashlib
import re
from collections import defaultdict
from datetime import datetime

import yaml

from ..errors import BristleError
from ..results import as_text, table

FIRST = ["version", "commit", "dirty", "compiler", "flags", "started", "finished", "cpu", "instruction_set",
         "threads", "system", "command_line", "points_computed", "points_commits"]
LONG = ["command line", "finished", "dirty", "points computed", "points commits"]  # not in the table of what differs
DIGESTS = ["payload_sha256", "experiment_sha256", "inputs_sha256", "numerics_version"]


def provenance(file, path):
    """Digests of the file, and all of /provenance with the entries of FIRST first."""
    stored = {} if table(file, "provenance") is None else table(file, "provenance").attrs
    found = defaultdict(str, {key: as_text(value) for key, value in stored.items()})
    names = [name for name in FIRST if name in found] + sorted(set(found) - set(FIRST))
    return {
        "file_sha256": sha256(path),
        "digests": [(name, as_text(file.attrs[name])) for name in DIGESTS if name in file.attrs],
        "cells": {"commit": re.sub("^([0-9a-f]{10})[0-9a-f]*", r"\1", found["commit"]),
                  "started": found["started"][:16].replace("T", " ")},
        "all": {name.replace("_", " "): found[name].strip() for name in names},
        "duration": duration(found),
    }


def compare(provenances):
    """What is the same in all results, and the names of the entries that differ: of a table, and all."""
    names = list(dict.fromkeys(name for found in provenances for name in found["all"]))
    values = {name: {found["all"].get(name, "") for found in provenances} for name in names}
    differ = [name for name in names if len(values[name]) > 1]
    return {"same": {name: words.pop() for name, words in values.items() if len(words) == 1},
            "columns": [name for name in differ if name not in LONG], "differ": differ}


def sha256(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def duration(found):
    try:
        start, end = (datetime.fromisoformat(found[name].replace("Z", "+00:00"))
                      for name in ("started", "finished"))
    except (KeyError, ValueError):
        return "\u2013"
    minutes, seconds = divmod(int((end - start).total_seconds()), 60)
    return f"{minutes} min {seconds} s" if minutes else f"{seconds} s"


def citation(path, commit=""):
    """The software, with the commit that computed all results if they have one, and the paper, as text."""
    try:
        with open(path, encoding="utf-8") as file:
            cff = yaml.safe_load(file)
        software = {**cff, "year": str(cff["date-released"])[:4], "kind": "software"}
        if commit and "doi" not in cff:
            software["commit"] = f"commit {commit}"
        entries = [software, *({**reference, "kind": "article"} for reference in cff.get("references", []))]
        return [{"text": citation_text(entry), "kind": entry["kind"], "link": link(entry)} for entry in entries]
    except (OSError, yaml.YAMLError, KeyError, TypeError) as error:
        raise BristleError(f"{path}: not a citation file ({type(error).__name__}: {error})") from error


def authors(entry):
    return [author.get("name") or f"{author['given-names']} {author['family-names']}"
            for author in entry["authors"]]


def citation_text(entry):
    where = ", ".join(filter(None, [f"Version {entry['version']}", entry.get("commit")])) \
        if entry["kind"] == "software" else journal_text(entry)
    who = ", ".join(authors(entry))
    return f"{who[0].upper()}{who[1:]} ({entry['year']}). {entry['title']}. {where}."


def journal_text(entry):
    parts = [entry["journal"]] + [f"{word} {entry[key]}" for key, word in (("volume", "vol."), ("issue", "no."))
                                  if key in entry]
    return ", ".join(parts + ([f"pp. {entry['start']}\u2013{entry['end']}"] if "end" in entry else []))


def link(entry):
    """Where the work is, as far as the file says."""
    return f"https://doi.org/{entry['doi']}" if "doi" in entry else entry.get("url", "")
