"""The documents' links lead somewhere, and their commands run as they are written.

docs_test.py SOURCE BUILD [DOCUMENT.md...]

Commands are the lines of ```sh blocks, run in order, each document's in a copy of the source of its own.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

source, build = map(pathlib.Path, sys.argv[1:3])
documents = sorted([source / "README.md", *(source / "docs").glob("*.md")])
if len(sys.argv) > 3:  # only these
    documents = [d for d in documents if d.name in sys.argv[3:]]

FIGURES = "|".join(path.stem for path in sorted((source / "experiments").glob("*.json")))

# Run in another form, or by another test: the beginning of the command, and what stands for it.
INSTEAD = [
    (rf"make ({FIGURES})$", r"make \1 TIER=smoke"),  # the full tier takes minutes
    (r"make (figures|findings|report)$", r"make -n \1"),
    (r"make assumptions$", "make -n assumptions"),  # an hour; tests/assumptions_test.cpp computes a small one
    (r"make bench$", "make -n bench"),  # the test "benchmark: fast engine against Boost.Odeint" runs its engine part
    (r"make test$", "make -n test"),  # this is it
    (r"make (archive|verify\b.*|release\b.*)$", r"make -n \1"),  # tests/archive_test.sh, tests/release_test.sh
    (r"make (sanitize|tidy|coverage|fuzz)\b(.*)$", r"make -n \1\2"),  # hours, or tests of their own
    (r"(build/bristle run experiments/fig4.json --shard \S+)$", r"\1 --tier smoke"),
    (r"scripts/slurm/.*", "test -x scripts/slurm/array.sh"),  # tests/slurm_test.sh
]
ELSEWHERE = {"extending.md"}  # tests/extending_test.py


def anchors(path):
    """The anchors of a document's headings, as GitHub and others make them."""
    text = re.sub(r"^```.*?^```$", "", path.read_text(encoding="utf-8"), flags=re.M | re.S)
    titles = re.findall(r"^#+ (.+)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def check_links(path):
    text = re.sub(r"^```.*?^```$|`[^`\n]*`", "", path.read_text(encoding="utf-8"), flags=re.M | re.S)
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        assert not link.startswith("http") or link.startswith("https://"), f"{path.name}: {link} is not https"
        if link.startswith("https://"):
            continue
        name, _, anchor = link.partition("#")
        target = (path.parent / name) if name else path
        assert target.exists(), f"{path.name}: {link} leads nowhere"
        assert not anchor or anchor in anchors(target), f"{path.name}: {link}: no such heading"


def check_mentions(path):
    """Files that the text names in the source: docs/NAME.md, src/..., tests/..., experiments/..."""
    text = re.sub(r"^```.*?^```$", "", path.read_text(encoding="utf-8"), flags=re.M | re.S)
    for name in re.findall(r"(?<![\w/.])(?:docs|src|tests|scripts|experiments|reference)/[\w./-]+\.\w+", text):
        name = name.rstrip(".")
        assert (source / name).exists() or re.search("mine|NAME|figN", name), f"{path.name} names {name}, which is not there"


def commands(path):
    blocks = re.findall(r"^```sh\n(.*?)^```$", path.read_text(encoding="utf-8"), re.M | re.S)
    return [line.split("  #")[0].strip() for block in blocks for line in block.splitlines() if line.strip()]


def written_files(path):
    """Files that the document has its reader write: ```json PATH."""
    return re.findall(r"^```json (\S+)\n(.*?)^```$", path.read_text(encoding="utf-8"), re.M | re.S)


def run(path, folder):
    copy = folder / path.stem
    subprocess.run(["git", "clone", "-q", "--shared", str(source), str(copy)], check=True)
    for name in ("experiments", "scripts", "reference", "Makefile"):  # as they are now
        if (source / name).is_dir():
            shutil.copytree(source / name, copy / name, dirs_exist_ok=True)
        else:
            shutil.copy2(source / name, copy / name)
    for place in ("CMakeLists.txt", "tests/CMakeLists.txt", "benchmarks/CMakeLists.txt", "CMakePresets.json"):
        os.utime(copy / place, (0, 0))  # older than what was built of them
    (copy / "build").symlink_to(build, target_is_directory=True)
    for name, text in written_files(path):
        (copy / name).write_text(text, encoding="utf-8")
    for command in commands(path):
        for pattern, instead in INSTEAD:
            command = re.sub(f"^{pattern}", instead, command)
        done = subprocess.run(command, shell=True, cwd=copy, capture_output=True, text=True)
        assert done.returncode == 0, f"{path.name}: {command}: exit {done.returncode}\n{done.stdout}{done.stderr}"
        print(f"{path.name}: {command}")


for document in documents:
    check_links(document)
    check_mentions(document)
with tempfile.TemporaryDirectory() as folder:
    for document in documents:
        if document.name not in ELSEWHERE and commands(document):
            run(document, pathlib.Path(folder))
