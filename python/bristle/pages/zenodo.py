""".zenodo.json, the description of a release that Zenodo reads, from CITATION.cff; with --archive, the description of the
dataset of `make archive`, for Zenodo's deposit API or its form."""

import argparse
import hashlib
import json
import re
import tarfile

import yaml

from ..command_line import run
from ..errors import BristleError
from ..files import write_text

OUTPUT = ".zenodo.json"
PLACEHOLDER = "The bristle developers"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("citation", metavar="CITATION.cff", nargs="?", default="CITATION.cff")
    parser.add_argument("-o", dest="output", metavar="FILE", help=f"(default: {OUTPUT}, or ARCHIVE.zenodo.json)")
    parser.add_argument("--archive", metavar="ARCHIVE", help="the archive: its citation and SHA-512, in place of CITATION.cff")
    parser.add_argument("--check", action="store_true", help="write nothing; fail if FILE is out of date")
    arguments = parser.parse_args()
    output = arguments.output or (f"{arguments.archive}.zenodo.json" if arguments.archive else OUTPUT)
    found = of_archive(arguments.archive) if arguments.archive else metadata(arguments.citation)
    text = json.dumps(found, indent=2, ensure_ascii=False) + "\n"
    if not arguments.check:
        write_text(output, text)
    elif content(output) != text:
        raise BristleError(f"{output}: is not what {arguments.citation} gives; `make citation` writes it")


def content(path):
    try:
        with open(path, encoding="utf-8") as file:
            return file.read()
    except (OSError, UnicodeDecodeError):
        return None


def of_archive(path):
    """The metadata of the dataset's record: the entries of the citation in the archive, and the archive's SHA-512."""
    try:
        with open(path, "rb") as file:
            digest = hashlib.file_digest(file, "sha512").hexdigest()
        with tarfile.open(path) as archive:
            name = next(name for name in archive.getnames() if name.count("/") == 2 and name.endswith("/data/CITATION.cff"))
            found = described(archive.extractfile(name), name)
            title = yaml.load(archive.extractfile(name), Loader=yaml.BaseLoader)["references"][0]["title"]
    except (OSError, tarfile.TarError) as error:
        raise BristleError(f"{path}: not an archive of `make archive` ({error})") from error
    except StopIteration:
        raise BristleError(f"{path}: not an archive of `make archive` (no data/CITATION.cff)") from None
    if any(creator["name"] == PLACEHOLDER for creator in found["creators"]):
        raise BristleError(f"{path}: a dataset names people, and its authors are \"{PLACEHOLDER}\"; enter them in CITATION.cff "
                           "(docs/archive.md), and archive again")
    text = (f"{found['description']} Software: {title}, version {found['version']}. SHA-512 of the file: {digest}. "
            "`bristle verify` checks it, and computes points again.")
    return {**found, "upload_type": "dataset", "license": "cc-by-4.0", "description": text}


def metadata(path):
    """The metadata of a software record, with the names of Zenodo's API."""
    try:
        with open(path, encoding="utf-8") as file:
            return described(file, path)
    except OSError as error:
        raise BristleError(f"{path}: not a citation file ({error})") from error


def described(file, path):
    """What Zenodo's API asks for, from an open citation file."""
    try:
        cff = yaml.load(file, Loader=yaml.BaseLoader)  # dates and versions stay text
        articles = [reference for reference in cff.get("references", []) if reference["type"] == "article"]
        found = {
            "title": cff["title"],
            "upload_type": "software",
            "version": cff["version"],
            "publication_date": cff["date-released"],
            "creators": [creator(author) for author in cff["authors"]],
            "description": cff["abstract"],
            "keywords": cff["keywords"],
            "license": cff["license"],
            "references": [reference_text(article) for article in articles],
            "related_identifiers": related(cff),
        }
        return {key: value for key, value in found.items() if value}
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise BristleError(f"{path}: not a citation file ({error})") from error
    except KeyError as error:
        raise BristleError(f"{path}: lacks {error.args[0]}; Zenodo requires it") from error
    except (AttributeError, TypeError) as error:
        raise BristleError(f"{path}: not a citation file of version 1.2.0 ({error})") from error


# By the type of a reference: how Zenodo calls the relation and the type.
RELATIONS = {"article": ("references", "publication-article"), "software": ("isSupplementTo", "software"),
             "dataset": ("isSupplementedBy", "dataset")}


def related(cff):
    """The works with a DOI: the references, and the dataset, which is among the identifiers of the software."""
    works = [*cff.get("references", []), *({"type": "dataset", "doi": i["value"]} for i in cff.get("identifiers", []))]
    return [{"identifier": work["doi"], "relation": RELATIONS[work["type"]][0], "scheme": "doi",
             "resource_type": RELATIONS[work["type"]][1]} for work in works if "doi" in work]


def name_of(author):
    return author["name"] if "name" in author else f"{author['family-names']}, {author['given-names']}"


def creator(author):
    found = {"name": name_of(author), "affiliation": author.get("affiliation"),
             "orcid": re.sub("^https://orcid.org/", "", author.get("orcid", ""))}
    return {key: value for key, value in found.items() if value}


def reference_text(article):
    people = "; ".join(name_of(author) for author in article["authors"])
    where = article["journal"]
    for key, text in (("volume", " {volume}"), ("issue", ", no. {issue}"), ("end", ", pp. {start}-{end}"),
                      ("doi", ", https://doi.org/{doi}")):
        where += text.format(**article) if key in article else ""
    return f"{people} ({article['year']}). {article['title']}. {where}"


if __name__ == "__main__":
    run(main)
