"""Another processor, compiler and library: every value of some results, computed by the page's engine in node.

agreement_test.py ROOT ENGINE.wasm RESULT.h5...: of the values, 97 in 100 must be within two of the program's errors, none
beyond eight, and the counts those of docs/generated/accuracy.md. Exits with 77 (skipped) without the engine.
"""
import json
import pathlib
import sys

root, engine, *results = (pathlib.Path(word).absolute() for word in sys.argv[1:])
sys.path.append(str(root / "page"))

import agreement  # noqa: E402

if not engine.exists():
    print("skipped: no engine; `make page` compiles it")
    sys.exit(77)
stored = json.loads((root / "page/agreement.json").read_text())
rows = []
for path in results:
    about, distances = agreement.compare(engine, path)
    rows.append(agreement.counts(about, distances))
    worst = sorted(distances.items(), key=lambda one: -one[1])[:3]
    print(rows[-1], worst)
    assert not rows[-1]["beyond_eight"], worst
    assert rows[-1]["same_status"] >= 0.97 * rows[-1]["points"], rows[-1]
within, values = (sum(row[key] for row in rows) for key in ("within_two", "values"))
assert values > 3000 and within >= 0.97 * values, (within, values)
if stored["compiler"] == agreement.compiler():
    assert rows == stored["results"], f"{rows}\n`make page-agreement accuracy` updates the numbers of docs/generated/accuracy.md"
# The comparison itself: a value that is off by more than eight errors is found.
about, distances = agreement.compare(engine, results[-1])
distances[next(iter(distances))] = 8.1
assert agreement.counts(about, distances)["beyond_eight"] == 1
