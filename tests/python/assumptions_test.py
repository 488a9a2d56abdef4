"""The recorded matrix of assumptions agrees with the experiments and docs/assumptions.md, and a part computed again is equal.

assumptions_test.py SOURCE BRISTLE FOLDER
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys

source, program, folder = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
sys.path.append(str(source / "python"))
from bristle.pages.matrix import read_matrix  # noqa: E402

recorded = read_matrix(source / "reference/assumptions.json")
declared, pairs = [], []
for path in sorted((source / "experiments/assumptions").glob("*.json")):
    one = json.loads(path.read_text())
    declared += [a["name"] for a in one.get("alternatives", [])]
    pairs += [" + ".join(pair["members"]) for pair in one.get("pairs", [])]
names = [a["name"] for a in recorded["alternatives"]]
assert names == ["baseline", *declared, *pairs], "reference/assumptions.json has different alternatives: make assumptions"

checks = []
for path in sorted((source / "experiments").glob("*.json")):
    experiment = json.loads(path.read_text())
    if experiment.get("figure") or "study" in experiment.get("tiers", {}):
        checks += [(experiment["name"], c["claim"], c["statement"]) for c in experiment.get("checks", [])]
assert [(c["experiment"], c["claim"], c["statement"]) for c in recorded["checks"]] == checks, "reference/assumptions.json has different checks: make assumptions"
assert len(recorded["cells"]) == len(names) * len(checks)



def drawn(*words):
    """The finished process of bristle.pages.assumptions."""
    return subprocess.run([sys.executable, "-m", "bristle.pages.assumptions", *words], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": str(source / "python")})


shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
done = drawn(source / "reference/assumptions.json", "--text", folder / "made.md")
assert done.returncode == 0, done.stderr
assert (folder / "made.md").read_text() == (source / "docs/assumptions.md").read_text(), "docs/assumptions.md is not the text of this matrix"
# The page names the matrix if the matrix has a digest.
document = json.loads((source / "reference/assumptions.json").read_text())
(folder / "digest.json").write_text(json.dumps({**document, "payload_sha256": "0123456789abcdef0123"}))
assert drawn(folder / "digest.json", "--text", folder / "digest.md").returncode == 0
assert "Payload digest of the matrix: 0123456789abcdef." in " ".join((folder / "digest.md").read_text().split())
(folder / "wrong.json").write_text("{}")
for wrong in ("none.json", "wrong.json"):
    done = drawn(folder / wrong, "--text", folder / "wrong.md")
    assert done.returncode == 2 and "Traceback" not in done.stderr, done.stderr

# Computes Figure 8 under the other rules for the pole again.
part = folder / "experiments"
(part / "assumptions").mkdir(parents=True)
for name in ("paper.json", "fig8.json", "assumptions/axis.json"):
    shutil.copy(source / "experiments" / name, part / name)
subprocess.run([program, "assumptions", "--experiments", part, "-o", folder / "part.json", "--tier", recorded["tier"], "--quiet"],
               check=True, stdout=subprocess.DEVNULL)
again = read_matrix(folder / "part.json")
for cell in again["cells"]:
    check, name = again["checks"][cell["check"]], again["alternatives"][cell["alternative"]]["name"]
    row = checks.index((check["experiment"], check["claim"], check["statement"]))
    before = next(c for c in recorded["cells"] if c["check"] == row and c["alternative"] == names.index(name))
    for key in ("verdict", "measured", "uncertainty", "margin", "affected"):
        assert cell[key] == before[key], f"{check['claim']} under {name}: {key} is {cell[key]}, was {before[key]}"
