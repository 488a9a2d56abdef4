"""docs/generated/checks.md has an item for every check of the experiments with a verdict under every reading, docs/findings.md
every claim with the paper's sentence, README.md has the page's summary, and other documents repeat the numbers correctly."""
import json
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
page, of_checks = ((root / "docs" / name).read_text(encoding="utf-8") for name in ("findings.md", "generated/checks.md"))
READINGS = {"polar": "corrected", "polar_as_printed": "as printed", "rod": "rod"}
VERDICT = r"\**(supported|refuted|undecided|depends)\**"

# (claim, statement with what is measured, readings below it)
checks = []
for line in re.sub(r"\n +(?! |- )", " ", of_checks).splitlines():  # list items are wrapped
    if heading := re.match(r"### (\w+): ", line):
        claim = heading.group(1)
    elif line.startswith("#"):
        claim = None
    elif item := re.match(r"- (.*)", line):
        checks.append((claim, item.group(1), []))
    elif verdict := re.match(rf"  - (?:([\w ]+): )?{VERDICT}, ", line):
        checks[-1][2].append(verdict.group(1))
claims = set()
for path in sorted((root / "experiments").glob("*.json")):
    experiment = json.loads(path.read_text(encoding="utf-8"))
    axis = experiment.get("sweep", {}).get(experiment.get("checks_for_each"), {"values": [None]})
    readings = [READINGS.get(word, word) for word in axis["values"]]
    for check in experiment.get("checks", []):
        found = [of for claim, text, of in checks if claim == check["claim"] and text.startswith(f"{check['statement']} (")]
        assert found == [readings], f"{path.name}: claim {check['claim']}: docs/generated/checks.md lacks a check: `make findings`"
        if check["claim"] not in claims:
            assert "short" in check, f"{path.name}: claim {check['claim']} needs the key \"short\" in its first check"
        claims.add(check["claim"])
    for quote in [check["quote"] for check in experiment.get("checks", []) if "quote" in check]:
        assert quote in " ".join(page.split()), f"docs/findings.md lacks the paper's \"{quote}\": `make findings`"
# The table of claims, and the explanations below them.
rows = {row.group(1): row.groups()[2:] for row in re.finditer(rf"^\| (\w+) \| (.+) \| {VERDICT} \| {VERDICT} \| {VERDICT} \|$", page, re.M)}
own = {row.group(1) for row in re.finditer(r"^\| (F\d) \| .+ \| (?:supported|refuted|undecided|depends|corrected|rod)[^|]* \|$", page, re.M)}
assert set(rows) | own == claims, f"the tables of docs/findings.md lack {sorted(claims - set(rows) - own)}: `make findings`"
assert not own & set(rows), "findings of this project are not the paper's claims"
# A finding of this project has a heading in each result that has checks of it.
headings = re.findall(r"^### F\d: (.+)$", of_checks, re.M)
assert re.findall(r"^### (\w+): ", page, re.M) == re.findall(r"^### (\w+): ", of_checks, re.M), "the pages have other claims"
unsupported = sum(verdict != "supported" for verdicts in rows.values() for verdict in verdicts)
unsupported += sum(3 * ("with every model" in heading) or len(re.findall("refuted|undecided|depends", heading))
                   for heading in headings if not heading.startswith("supported"))
explained = len(re.findall(r"^Why it (?:is refuted|is undecided|depends) with ", of_checks, re.M))
assert explained == unsupported, f"{unsupported} verdicts are not \"supported\", {explained} are explained"

# The summary in README.md.
readme = (root / "README.md").read_text(encoding="utf-8")
summary, in_readme = (re.search("<!-- summary: .*?<!-- end of summary -->", text, re.S).group() for text in (page, readme))
assert in_readme == summary, "README.md's summary differs from docs/findings.md's: `make findings`"
said = re.search(r"the paper's (\d+) claims, (\d+) hold with every model of bending, (\d+) fail with every model of bending .*? and (\d+) depend",
                 " ".join(summary.split())).groups()
alike = [set(verdicts) for verdicts in rows.values()]
found = [len(rows), alike.count({"supported"}), alike.count({"refuted"})]
found.append(found[0] - found[1] - found[2])
assert [int(number) for number in said] == found, f"the summary's numbers are {said}, those of the table {found}"
matrix = json.loads((root / "reference" / "assumptions.json").read_text(encoding="utf-8"))
conclusions, in_one_line = matrix["conclusions"], " ".join(readme.split())
reversed_by_some = sum(bool(one["other"]) for one in conclusions if one["conclusion"] != "open")
said = re.search(r"another choice reverses the verdict of (\d+) of the (\d+) checks", in_one_line).groups()
assert [int(number) for number in said] == [reversed_by_some, len(conclusions)], \
    f"README.md: alternatives reverse {said}, not {reversed_by_some} of {len(conclusions)} verdicts"
holding = [claim for claim, verdicts in rows.items() if set(verdicts) == {"supported"}]
of_claim = {claim: [one for one in conclusions if matrix["checks"][one["check"]]["claim"] == claim
                    and matrix["checks"][one["check"]]["role"] == "main"] for claim in holding}
kept = [claim for claim, found in of_claim.items()
        if found and all(one["baseline"] == "supported" and not one["other"] for one in found)]
number, said = re.search(r"Of the (\d+) claims that hold, no other choice reverses \w+: (.*?) \(", in_one_line).groups()
assert (int(number), re.findall(r"\w+", said.replace(" and ", " "))) == (len(holding), kept), \
    f"README.md: no alternative reverses {said}, not {', '.join(kept)} of {len(holding)} claims"

# Numbers that other documents quote rounded.
figure_4 = page.split("## Figure 4")[1]
passages, contact = re.search(r"(\d+) passages, ensemble mean of the contact time at most ([\d.]+) L_x/V_0",
                              " ".join(figure_4.split())).groups()
for document, pattern, number in (("README.md", r"the ([\d ]+) passages of Figure 4", round(int(passages), -3)),
                                  ("docs/model.md", r"stay for up to ([\d.]+) L_x/V_0", round(float(contact), 1))):
    said = re.findall(pattern, (root / document).read_text(encoding="utf-8"))
    assert [float(one.replace(" ", "")) for one in said] == [number], f"{document} has {said}, docs/findings.md has {number}"
