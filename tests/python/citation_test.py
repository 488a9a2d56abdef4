"""CITATION.cff gives .zenodo.json, which is up to date, and the report's citations. citation_test.py SOURCE"""
import json
import pathlib
import sys
import tempfile

import yaml

from in_process import called
import sources

source = pathlib.Path(sys.argv[1])
folder = pathlib.Path(tempfile.mkdtemp())

cff = yaml.load((source / "CITATION.cff").read_text(encoding="utf-8"), Loader=yaml.BaseLoader)


def zenodo(citation, *options):
    """The exit code, the message and the metadata of scripts/zenodo.py for a citation."""
    path, output = folder / "CITATION.cff", folder / "zenodo.json"
    path.write_text(citation if isinstance(citation, str) else json.dumps(citation), encoding="utf-8")
    done = called("zenodo.py", path, "-o", output, *options)
    return done.code, done.messages, json.loads(output.read_text()) if output.exists() else None


def article(**changes):
    return {**cff, "references": [{**cff["references"][0], **changes}]}


done = called("zenodo.py", source / "CITATION.cff", "-o", source / ".zenodo.json", "--check")
assert done.code == 0, done.messages

code, message, found = zenodo(article(doi="10.1000/1", volume="7"))
assert code == 0, message
assert found["title"] == cff["title"] and found["version"] == cff["version"] and found["license"] == "MIT"
assert found["keywords"] == cff["keywords"] and found["description"] == cff["abstract"]
assert [one["identifier"] for one in found["related_identifiers"]] == ["10.1000/1"]
assert found["references"] == [
    "Menga, N.; Bottiglione, F.; Carbone, G. (2022). Exploiting surface textures dynamics for dry friction control. "
    "Nonlinear Dynamics 7, no. 4, pp. 3099-3112, https://doi.org/10.1000/1"], found["references"]

people = [{"family-names": "A", "given-names": "B", "orcid": "https://orcid.org/0000-0001-2345-6789"},
          {"name": "A group", "affiliation": "C"}]
found = zenodo({**cff, "authors": people})[2]
assert found["creators"] == [{"name": "A, B", "orcid": "0000-0001-2345-6789"},
                             {"name": "A group", "affiliation": "C"}], found["creators"]
assert zenodo({**cff, "authors": people}, "--check")[0] == 0
code, message, _ = zenodo({**cff, "title": "another"}, "--check")
assert code == 2 and "zenodo.json: is not what" in message and "`make citation` writes it" in message, message

for wrong, text in [({**cff, "authors": [{"family-names": "A"}]}, "lacks given-names"), ("a: [", "not a citation file ("),
                    ("[]", "not a citation file of version"), ({"title": "x"}, "lacks version")]:
    code, message, _ = zenodo(wrong)
    assert code == 2 and text in message and len(message.splitlines()) <= 6, message

paper = sources.citation(source / "CITATION.cff")[1]
assert paper["text"].endswith(" Nonlinear Dynamics, no. 4, pp. 3099\u20133112."), paper["text"]
for line in ("number = {4}", "pages = {3099--3112}"):
    assert line in paper["bibtex"], paper["bibtex"]
