"""Pages, figures and captions of results with any texts or with damage: no traceback, and texts stay texts.

pages.py BRISTLE SECONDS SEED FOLDER
"""
import html.parser
import json
import os
import pathlib
import random
import subprocess
import sys

from common import Campaign, Failure, Program, damaged

bristle, seconds, seed, folder = Program(sys.argv[1]), float(sys.argv[2]), sys.argv[3], pathlib.Path(sys.argv[4])
source = pathlib.Path(__file__).resolve().parents[2]
small = json.loads((source / "tests/hostile/small.json").read_text(encoding="utf-8"))
r = random.Random(f"pages {seed}")
folder.mkdir(parents=True, exist_ok=True)
(folder / "paper.json").write_text((source / "experiments/paper.json").read_text(encoding="utf-8"), encoding="utf-8")
SECONDS = 120  # for one command

MARK = "x-hostile"  # a tag that no page has
PIECES = [f"<{MARK}>", f"</script><{MARK}>", f"--><{MARK}>", f'"><{MARK} a="', f"'><{MARK}>", "&amp;", "&lt;", "{{ 7*7 }}", "{% raw %}",
          "$", "$$", r"\input{/etc/passwd}", "%", "#", "_", "^", "{", "}", "~", "\\", "\\(", "\x1b[2J", "\n", "\r\n", "\t",
          "=1+2", "@x", "\u202e", "\u2028", "é", "Ř", "漢", "😀", "a" * 300, " ", "k_r", "http://example.org", "`", "*", "|"]


def text(most):
    return "".join(r.choice(PIECES) for _ in range(r.randint(1, 8)))[:most]


class Tags(html.parser.HTMLParser):
    def handle_starttag(self, tag, attrs):
        if tag == MARK or any(name.startswith("on") and "x-h" in (value or "") for name, value in attrs):
            raise Failure(f"a text became the tag {tag}")


def python(*command):
    """Runs a script, which must end with 0, or with 2 or 3 and a message; returns exit code and both outputs."""
    done = subprocess.run(list(map(str, command)), cwd=source, capture_output=True, timeout=SECONDS,
                          env={**os.environ, "PYTHONPATH": str(source / "python")})
    out, error = done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")
    if done.returncode not in (0, 2, 3) or "Traceback" in error:
        raise Failure(f"{command}: exit code {done.returncode}: {error[-1500:]}")
    if done.returncode and not error.strip():
        raise Failure(f"{command}: exit code {done.returncode} without a message")
    return done.returncode, out, error


def draw():
    """An experiment of three quick points with random texts wherever texts are allowed."""
    document = dict(small)
    document |= {"title": text(100), "notes": [text(500) for _ in range(r.randint(0, 3))], "institution": text(100),
                 "figure": r.choice(["4", text(10)])}
    document["checks"] = [
        {"claim": text(20), "statement": text(300), "short": text(60), "quote": text(300), "leaves_open": text(100),
         "predicate": "end_ratio", "variable": "R_n", "along": "k_r", "is": r.choice(["at_least", "at_most"]),
         "threshold": r.uniform(0, 3)} for _ in range(r.randint(0, 3))]
    return {key: value for key, value in document.items() if r.random() < 0.8 or key in small}


def step():
    for old in folder.glob("r.h5*"):
        old.unlink()
    path, result, page = folder / "random.json", folder / "r.h5", folder / "index.html"
    path.write_text(json.dumps(draw()), encoding="utf-8")
    code, _, _ = bristle("run", path, "-o", result, "--quiet", allowed={0, 2}, seconds=SECONDS)
    if code == 2:
        return "experiments refused"
    broken = r.random() < 0.2
    if broken:
        result.write_bytes(damaged(result.read_bytes(), r))
    plot = [source / "scripts/plot", "curve", result]
    done = [python(*plot, "-o", folder / "figures", "--format", "png,svg"), python(*plot, "--caption")]
    if "\\input{" in done[1][1] or "\x1b" in done[1][1]:
        raise Failure(f"a text became a command of LaTeX or of the terminal: {done[1][1]}")
    page.unlink(missing_ok=True)
    done.append(python(sys.executable, "-m", "bristle.report", result, "-o", page, "--program", bristle.path))
    if page.exists():
        Tags().feed(page.read_text(encoding="utf-8"))
    if not broken and any(code for code, _, _ in done):
        raise Failure(f"a whole result is refused: {[error for _, _, error in done]}")
    return "damaged results" if broken else "results"


campaign = Campaign("pages", seconds)
campaign.repeat(step)
sys.exit(0 if campaign.report() else 1)
