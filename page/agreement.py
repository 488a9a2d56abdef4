"""How well the page's engine agrees with the program: every value of some results, computed again in node."""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(os.path.dirname(HERE), "python"))

from bristle.command_line import run  # noqa: E402
from bristle.files import write_text  # noqa: E402
from bristle.results import as_text, experiment, flags, open_result, point_numbers, read  # noqa: E402

WITHIN, MOST = 2, 8  # of a value's error


def computed(engine, questions):
    """The page's answers to questions, in node."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "questions.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(questions, file)
        done = subprocess.run(["node", os.path.join(HERE, "points.js"), engine, path], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def compare(engine, path):
    """The values of one result and of the page: counts, and the distance of each value with an error, in errors."""
    with open_result(path) as file:
        name, document = as_text(file.attrs["name"]), experiment(file)
        indices = [int(index) for index in np.ravel(point_numbers(file))]
        answers = computed(engine, [{"experiment": document, "point": index} for index in indices])
        if wrong := [answer["error"] for answer in answers if "error" in answer]:
            raise AssertionError(f"{path}: {wrong[0]}")
        words, codes = flags(file["status"])
        statuses = [words[code] for code in np.ravel(codes)]
        distances = {}
        for variable in (key for key in file if f"{key}_err" in file):
            for index, value, error, answer in zip(indices, np.ravel(read(file, variable)), np.ravel(read(file, f"{variable}_err")), answers):
                mine = answer.get("values", {}).get(variable, [None])[0]
                if np.isfinite(value) and error > 0:
                    distances[variable, index] = np.inf if mine is None else abs(mine - value) / error
                elif np.isfinite(value) != (mine is not None) or np.isfinite(value) and not np.isclose(mine, value, rtol=1e-9, atol=1e-9):
                    distances[variable, index] = np.inf
    same = sum(answer["status"] == status for answer, status in zip(answers, statuses))
    return {"name": name, "points": len(indices), "same_status": same, "seconds": [answer["seconds"] for answer in answers]}, distances


def counts(about, distances):
    """A row of the document."""
    found = np.array(list(distances.values()))
    return {"name": about["name"], "points": about["points"], "same_status": about["same_status"], "values": len(found),
            "within": int((found <= 1).sum()), "within_two": int((found <= WITHIN).sum()), "beyond_eight": int((found > MOST).sum())}


def compiler():
    """Emscripten's version; numbers of another one may differ within their errors."""
    words = subprocess.run(["em++", "--version"], capture_output=True, text=True, check=True).stdout
    return re.search(r"\d+\.\d+\.\d+", words).group()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("engine", help="engine.wasm")
    parser.add_argument("results", metavar="RESULT.h5", nargs="+")
    parser.add_argument("-o", dest="output", metavar="FILE", default=os.path.join(HERE, "agreement.json"))
    parser.add_argument("--times", action="store_true", help="also print the seconds of a point, and the values that agree least")
    arguments = parser.parse_args()
    found = [compare(arguments.engine, path) for path in arguments.results]
    rows = [counts(*one) for one in found]
    write_text(arguments.output, json.dumps({"compiler": compiler(), "results": rows}, indent=1) + "\n")
    for row in rows:
        print(row)
    if arguments.times:
        for about, distances in found:
            print(about["name"], "seconds:", np.percentile(about["seconds"], [50, 90, 100]).round(2),
                  sorted(distances.items(), key=lambda one: -one[1])[:5])


if __name__ == "__main__":
    run(main)
