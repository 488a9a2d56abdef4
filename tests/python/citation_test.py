"""CITATION.cff gives .zenodo.json, which is up to date. citation_test.py SOURCE"""
import hashlib
import json
import pathlib
import sys
import tarfile
import tempfile

import yaml

from in_process import called

source = pathlib.Path(sys.argv[1])
folder = pathlib.Path(tempfile.mkdtemp())

cff = yaml.load((source / "CITATION.cff").read_text(encoding="utf-8"), Loader=yaml.BaseLoader)


def zenodo(citation, *options):
    """The exit code, the message and the metadata of bristle.pages.zenodo for a citation."""
    path, output = folder / "CITATION.cff", folder / "zenodo.json"
    path.write_text(citation if isinstance(citation, str) else json.dumps(citation), encoding="utf-8")
    done = called("bristle.pages.zenodo", path, "-o", output, *options)
    return done.code, done.messages, json.loads(output.read_text()) if output.exists() else None


def article(**changes):
    return {**cff, "references": [{**cff["references"][0], **changes}]}


done = called("bristle.pages.zenodo", source / "CITATION.cff", "-o", source / ".zenodo.json", "--check")
assert done.code == 0, done.messages

code, message, found = zenodo(article(doi="10.1000/1", volume="7"))
assert code == 0, message
assert found["title"] == cff["title"] and found["version"] == cff["version"] and found["license"] == "MIT"
assert found["keywords"] == cff["keywords"] and found["description"] == cff["abstract"]
assert [one["identifier"] for one in found["related_identifiers"]] == ["10.1000/1"]
assert found["references"] == [
    "Menga, N.; Bottiglione, F.; Carbone, G. (2022). Exploiting surface textures dynamics for dry friction control. "
    "Nonlinear Dynamics 7, no. 4, pp. 3099-3112, https://doi.org/10.1000/1"], found["references"]

archived = {**cff, "identifiers": [{"type": "doi", "value": "10.5281/zenodo.12", "description": "the archive"}]}
relation = lambda found: [(one["identifier"], one["relation"]) for one in found["related_identifiers"]]
assert relation(zenodo(archived)[2]) == [("10.5281/zenodo.12", "isSupplementedBy")]

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

# The dataset's record: from the citation in the archive, with its hash; it names people.
def deposit(authors):
    data = folder / "bristle-1/data"
    data.mkdir(parents=True, exist_ok=True)
    program = {"type": "software", "title": "t", "authors": authors, "doi": "10.5281/zenodo.99"}
    (data / "CITATION.cff").write_text(json.dumps({**cff, "type": "dataset", "title": "Data of t", "authors": authors,
                                                   "references": [program, *cff["references"]]}))
    with tarfile.open(folder / "bristle-1.tar", "w") as archive:
        archive.add(folder / "bristle-1", "bristle-1")
    done = called("bristle.pages.zenodo", "--archive", folder / "bristle-1.tar")
    output = folder / "bristle-1.tar.zenodo.json"
    return done.code, done.messages, json.loads(output.read_text()) if output.exists() else None


code, message, found = deposit([{"name": "The bristle developers"}])
assert code == 2 and found is None and "a dataset names people" in message, message
code, message, found = deposit(people)
assert code == 0 and found["upload_type"] == "dataset" and found["license"] == "cc-by-4.0", message
assert relation(found) == [("10.5281/zenodo.99", "isSupplementTo")]
assert found["title"] == "Data of t" and found["creators"][1] == {"name": "A group", "affiliation": "C"}
assert hashlib.sha512((folder / "bristle-1.tar").read_bytes()).hexdigest() in found["description"]
done = called("bristle.pages.zenodo", "--archive", source / "CITATION.cff")
assert done.code == 2 and "not an archive of `make archive`" in done.messages, done.messages
