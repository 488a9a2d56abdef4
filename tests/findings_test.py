"""docs/findings.md has an item with a verdict for every check of the experiments, the experiments check every claim of the
paper, and other documents repeat the numbers correctly."""
import json
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
page = (root / "docs" / "findings.md").read_text(encoding="utf-8")
lines = re.sub(r"\n +(?! |- )", " ", page).splitlines()  # list items are wrapped
# (claim, statement, verdict): an item and the item below it.
checks = [(*item.groups(), verdict.group(1)) for item, verdict in
          ((re.match(r"- \*\*(\w+)\*\*: (.*)", line), re.match(r"  - \**(supported|refuted|undecided)\**: ", below))
           for line, below in zip(lines, lines[1:])) if item and verdict]
claims = set()
for path in sorted((root / "experiments").glob("fig*.json")):
    for check in json.loads(path.read_text())["checks"] if "checks" in path.read_text() else []:
        found = [one for one in checks if one[:2] == (check["claim"], check["statement"])]
        assert len(found) == 1, f"{path.name}: claim {check['claim']} is missing in docs/findings.md: `make findings`"
        claims.add(check["claim"])
paper = {"3a", "3b", "3c", "3d", "4a", "4b", "4c", "4d", "4e", "4f", "5a", "5b", "5c", "6a", "6b", "7a", "7b", "8a", "8b",
         "A1", "A2", "A3"}
assert claims == paper, f"not checked: {sorted(paper - claims)}; not in the paper: {sorted(claims - paper)}"

# The summary in README.md.
verdicts = [verdict for _, _, verdict in checks]
conclusions = json.loads((root / "reference" / "assumptions.json").read_text())["conclusions"]
reversed_by_some = sum(bool(one["other"]) for one in conclusions if one["conclusion"] != "open")
summary = re.search(r"(\d+) claims are tested by (\d+) checks: (\d+) are supported, (\d+) refuted and (\d+) undecided"
                    r".*reverses (\d+) of the (\d+) verdicts",
                    " ".join((root / "README.md").read_text(encoding="utf-8").split()))
found = [len(claims), len(verdicts), *map(verdicts.count, ("supported", "refuted", "undecided")), reversed_by_some, len(conclusions)]
assert [int(number) for number in summary.groups()] == found, f"README.md's summary is {summary.group()}, the findings are {found}"

# Numbers that other documents quote rounded.
figure_4 = page.split("## Figure 4")[1]
passages, contact = re.search(r"(\d+) passages, ensemble mean of the contact time at most ([\d.]+) L_x/V_0",
                              " ".join(figure_4.split())).groups()
for document, pattern, number in (("README.md", r"the ([\d ]+) passages of Figure 4", round(int(passages), -3)),
                                  ("docs/model.md", r"stay for up to ([\d.]+) L_x/V_0", round(float(contact), 1))):
    said = re.findall(pattern, (root / document).read_text(encoding="utf-8"))
    assert [float(one.replace(" ", "")) for one in said] == [number], f"{document} has {said}, docs/findings.md has {number}"
