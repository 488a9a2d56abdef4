""".zenodo.json, the description of a release that Zenodo reads, from CITATION.cff."""

import argparse
import json
import re

import yaml

from bristle_plots.command_line import run
from bristle_plots.errors import BristleError
from bristle_plots.files import write_text

OUTPUT = ".zenodo.json"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("citation", metavar="CITATION.cff", nargs="?", default="CITATION.cff")
    parser.add_argument("-o", dest="output", metavar="FILE", default=OUTPUT, help="(default: %(default)s)")
    parser.add_argument("--check", action="store_true", help="write nothing; fail if FILE is out of date")
    arguments = parser.parse_args()
    text = json.dumps(metadata(arguments.citation), indent=2, ensure_ascii=False) + "\n"
    if not arguments.check:
        write_text(arguments.output, text)
    elif content(arguments.output) != text:
        raise BristleError(f"{arguments.output}: is not what {arguments.citation} gives; `make citation` writes it")


def content(path):
    try:
        with open(path, encoding="utf-8") as file:
            return file.read()
    except (OSError, UnicodeDecodeError):
        return None


def metadata(path):
    """The metadata of a software record, with the names of Zenodo's API."""
    try:
        with open(path, encoding="utf-8") as file:
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
            "related_identifiers": [
                {"identifier": article["doi"], "relation": "references", "scheme": "doi",
                 "resource_type": "publication-article"} for article in articles if "doi" in article],
        }
        return {key: value for key, value in found.items() if value}
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise BristleError(f"{path}: not a citation file ({error})") from error
    except KeyError as error:
        raise BristleError(f"{path}: lacks {error.args[0]}; Zenodo requires it") from error
    except (AttributeError, TypeError) as error:
        raise BristleError(f"{path}: not a citation file of version 1.2.0 ({error})") from error


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
