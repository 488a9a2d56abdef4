"""docs/findings.md has every claim of the experiments with the paper's sentence and its main checks, README.md has the page's
summary, and other documents repeat the numbers correctly."""
import json
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
page = (root / "docs/findings.md").read_text(encoding="utf-8")
in_one_line = " ".join(page.split())
VERDICT = r"\**(supported|refuted|undecided|depends)\**"

claims = set()
for path in sorted((root / "experiments").glob("*.json")):
    experiment = json.loads(path.read_text(encoding="utf-8"))
    for check in experiment.get("checks", []):
        statement = check["statement"][0].upper() + check["statement"][1:]
        if check.get("role") != "further":
            assert statement in in_one_line, f"{path.name}: claim {check['claim']}: docs/findings.md lacks a main check: `make findings`"
        if check["claim"] not in claims:
            assert "short" in check, f"{path.name}: claim {check['claim']} needs the key \"short\" in its first check"
        claims.add(check["claim"])
    for quote in [check["quote"] for check in experiment.get("checks", []) if "quote" in check]:
        assert quote in in_one_line, f"docs/findings.md lacks the paper's \"{quote}\": `make findings`"
# The table of claims, and the explanations below them.
rows = {row.group(1): row.groups()[2:] for row in re.finditer(rf"^\| (\w+) \| (.+) \| {VERDICT} \| {VERDICT} \| {VERDICT} \|$", page, re.M)}
own = {row.group(1) for row in re.finditer(r"^\| (F\d) \| .+ \| (?:supported|refuted|undecided|depends|corrected|rod)[^|]* \|$", page, re.M)}
assert set(rows) | own == claims, f"the tables of docs/findings.md lack {sorted(claims - set(rows) - own)}: `make findings`"
assert not own & set(rows), "findings of this project are not the paper's claims"
# Each claim of each result has a heading, and each that is not supported with every model an explanation.
headings = re.findall(r"^### \w+: (.+)$", page, re.M)
unsupported = sum(set(re.findall("supported|refuted|undecided|depends", heading)) != {"supported"} for heading in headings)
explained = len(re.findall(r"Why it (?:is refuted|is undecided|depends) with ", in_one_line))
assert explained == unsupported, f"{unsupported} claims are not \"supported\", {explained} are explained"

# The summary in README.md.
readme = (root / "README.md").read_text(encoding="utf-8")
summary, in_readme = (re.search("<!-- summary: .*?<!-- end of summary -->", text, re.S).group() for text in (page, readme))
assert in_readme == summary, "README.md's summary differs from docs/findings.md's: `make findings`"
said = re.search(r"the paper's (\d+) claims, (\d+) hold with every model of bending, (\d+) fails? with every model of bending .*? and (\d+) depend",
                 " ".join(summary.split())).groups()
alike = [set(verdicts) for verdicts in rows.values()]
found = [len(rows), alike.count({"supported"}), alike.count({"refuted"})]
found.append(found[0] - found[1] - found[2])
assert [int(number) for number in said] == found, f"the summary's numbers are {said}, those of the table {found}"
matrix = json.loads((root / "reference" / "assumptions.json").read_text(encoding="utf-8"))
conclusions, in_readme = matrix["conclusions"], " ".join(readme.split())
reversed_by_some = sum(bool(one["other"]) for one in conclusions if one["conclusion"] != "open")
said = re.search(r"another choice reverses the verdict of (\d+) of the (\d+) checks", in_readme).groups()
assert [int(number) for number in said] == [reversed_by_some, len(conclusions)], \
    f"README.md: alternatives reverse {said}, not {reversed_by_some} of {len(conclusions)} verdicts"
holding = [claim for claim, verdicts in rows.items() if set(verdicts) == {"supported"}]
of_claim = {claim: [one for one in conclusions if matrix["checks"][one["check"]]["claim"] == claim
                    and matrix["checks"][one["check"]]["role"] == "main"] for claim in holding}
kept = [claim for claim, found in of_claim.items()
        if found and all(one["baseline"] == "supported" and not one["other"] for one in found)]
number, said = re.search(r"Of the (\d+) claims that hold, no other choice reverses \w+: (.*?) \(", in_readme).groups()
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
