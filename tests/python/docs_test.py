"""Links of the documents resolve, the code contains the names that they mention, and their commands run as written.

docs_test.py SOURCE BUILD [DOCUMENT.md...]

Commands are the lines of ```sh blocks (a backslash continues a line). They run in order, in a separate copy of the source
for each document, and after them its ```python blocks as one script. The lines of ```printed blocks are among what they print.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

source, build = map(pathlib.Path, sys.argv[1:3])
HISTORY = "CHANGELOG.md"  # may name files that no longer exist
documents = sorted([*(source / name for name in ("README.md", "CONTRIBUTING.md", HISTORY)), *(source / "docs").glob("*.md")])
if len(sys.argv) > 3:  # only these
    documents = [d for d in documents if d.name in sys.argv[3:]]

FIGURES = "|".join(path.stem for path in sorted((source / "experiments").glob("*.json")))

COLUMNS = 100

# Commands that are replaced because they take long or have their own tests: a pattern for the start of the command,
# and the replacement.
INSTEAD = [
    (rf"make ({FIGURES})$", r"make \1 TIER=smoke"),  # the full tier takes minutes
    (r"make (figures|findings|report)$", r"make -n \1"),
    (r"make assumptions$", "make -n assumptions"),  # long; tests/unit/assumptions/assumptions_test.cpp computes a small one
    (r"make bench$", "make -n bench"),  # the test "benchmark: fast engine against Boost.Odeint" runs its engine part
    (r"make accuracy$", "make -n accuracy"),  # tests/python/accuracy_test.py
    (r"make (build|build-tests|test|test-all)$", r"make -n \1"),  # this test is part of them
    (r"ctest (.*)$", r"ctest --show-only \1"),  # the log of the tests in progress must stay
    (r"make (archive|verify\b.*|deposit\b.*|release\b.*)$", r"make -n \1"),  # tests/program/archive_test.sh, tests/program/release_test.sh
    (r"make (sanitize|tidy|coverage|fuzz|stress)\b(.*)$", r"make -n \1\2"),  # take hours, or have their own tests
    (rf"scripts/plot (\w+) results/({FIGURES})\.h5(.*)$", r"scripts/plot \1 results/\2-smoke.h5\3"),
    (rf"(build/bristle (?:value|export)) results/({FIGURES})\.h5(.*)$", r"\1 results/\2-smoke.h5\3"),
    (r"(build/bristle run experiments/fig4.json --(shard \S+|complete))$", r"\1 --tier smoke"),
    (r"scripts/slurm/.*", "test -x scripts/slurm/array.sh"),  # tests/program/slurm_test.sh
]
TESTED_ELSEWHERE = {"extending.md"}  # tests/python/extending_test.py


def anchors(path):
    """Anchors of the headings of a document, in the form of GitHub."""
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
        assert target.exists(), f"{path.name}: {link} does not exist"
        assert not anchor or anchor in anchors(target), f"{path.name}: {link}: no such heading"


def check_mentions(path):
    """Source files that the text mentions, such as docs/NAME.md, exist, or a command of the page writes them."""
    page = path.read_text(encoding="utf-8")
    text = re.sub(r"^```.*?^```$", "", page, flags=re.M | re.S)
    written = {f"experiments/{name}.json" for name in re.findall(r"^build/bristle new ([\w-]+)", page, re.M)}
    written |= {name for name, _ in written_files(path)}
    for name in re.findall(r"(?<![\w/.])(?:docs|src|tests|scripts|python|experiments|reference)/[\w./-]+\.\w+", text):
        name = name.rstrip(".")
        known = (source / name).exists() or name in written or re.search("mine|NAME|figN", name)
        assert known, f"{path.name} names {name}, which does not exist"


def check_width(path):
    """Lines are at most COLUMNS wide, except in blocks that other tests compare with source files."""
    text = re.sub(r"^```\w+ \S+\n.*?^```$", "", path.read_text(encoding="utf-8"), flags=re.M | re.S)
    wide = [line for line in text.splitlines() if len(line) > COLUMNS]
    assert not wide, f"{path.name}: more than {COLUMNS} columns: {wide[0]}"


def table_cells(path, heading):
    """Rows of the table below a heading, as lists of cells."""
    section = path.read_text(encoding="utf-8").split(f"\n## {heading}\n")[1].split("\n## ")[0]
    rows = [line.strip("|").split("|") for line in section.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in row] for row in rows[2:]]


def names_in(cell):
    return re.findall(r"`([^`]+)`", cell)


def defines(text, name):
    """Whether the text contains the name as a whole word."""
    return re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text) is not None


def check_architecture(path):
    """Every folder of src/ has a row, in the order of the layers. The files that the document names exist and contain the
    names in the table."""
    text = path.read_text(encoding="utf-8")
    rows = table_cells(path, "The folders")
    listed = [names_in(folder)[0] for folder, _, _ in rows]
    folders = {f"{folder.relative_to(source / 'src')}" for parent in (source / "src", source / "src/bristle")
               for folder in parent.iterdir() if folder.is_dir()} - {"bristle"}
    assert set(listed) == folders, f"{path.name}: the folders differ from those of src/: {set(listed) ^ folders}"
    order = re.search(r"in\s+this\s+order:([^.]*)\.", text).group(1)
    assert names_in(order) == [folder.split("/")[-1] for folder in listed], f"{path.name}: the rows are not in the order of the layers"
    for folder, (_, _, files) in zip(listed, rows):
        for name in names_in(files):
            assert (source / "src" / folder / name).exists(), f"{path.name}: there is no src/{folder}/{name}"
    for folder, _, files in table_cells(path, "The Python package"):
        for name in names_in(files):
            assert (source / "python/bristle" / names_in(folder)[0] / name).exists(), f"{path.name}: {folder} has no {name}"
    rows = table_cells(path, "Where to find")
    assert len(rows) > 10, f"{path.name}: the table has too few rows"
    for what, file, names in rows:
        content = (source / names_in(file)[0]).read_text(encoding="utf-8")
        for name in names_in(names):
            assert defines(content, name), f"{path.name}: {what}: {file} has no {name}"


def check_model(path):
    """The files in the table of equations contain the functions named there."""
    rows = table_cells(path, "One bristle")
    assert len(rows) > 10, f"{path.name}: the table has too few rows"
    for equation, file, function, _ in rows:
        place = source / names_in(file)[0]
        files = [place] if place.is_file() else sorted(place.glob("*.hpp"))
        for name in names_in(function):
            assert any(defines(one.read_text(encoding="utf-8"), name) for one in files), \
                f"{path.name}: {equation}: {file} has no {name}"


def check_glossary(path):
    """The code contains the names in the glossary."""
    code = "\n".join(file.read_text(encoding="utf-8") for file in sorted((source / "src").rglob("*.?pp")))
    for symbol, in_code, in_files, meaning, _ in table_cells(path, "Symbols"):
        for name in [*names_in(in_code), *names_in(in_files)]:
            word = re.split(r"::|/", name)[-1]
            word = re.sub(r"^pinned_share_|_(unpinned|in_N)$", "", word)  # made from the rows of kObservables
            assert defines(code, word), f"{path.name}: {symbol or meaning}: no {name} in src/"


def words_of(schema):
    """All keys and words that a schema allows."""
    if isinstance(schema, list):
        return set().union(*map(words_of, schema))
    if not isinstance(schema, dict):
        return set()
    words = set(schema.get("properties", {})) | {word for word in schema.get("enum", []) if isinstance(word, str)}
    return words.union(*map(words_of, schema.values()))


def check_experiments(path):
    """The pages on experiments and claims mention every key and word of the schema."""
    schema = json.loads(subprocess.run([build / "bristle", "schema"], capture_output=True, check=True).stdout)
    of_checks = words_of(schema["definitions"].pop("checks"))
    schema["properties"] = {}  # repeats the names of the definitions
    for page, words in ((path, words_of(schema)), (path.with_name("claims.md"), of_checks)):
        prose = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
        text = " ".join(re.findall(r"`([^`]+)`", prose))
        missing = sorted(word for word in words if not defines(text, word))
        assert not missing, f"{page.name} lacks {', '.join(missing)}"


def commands(path):
    blocks = re.findall(r"^```sh\n(.*?)^```$", path.read_text(encoding="utf-8"), re.M | re.S)
    lines = [line for block in blocks for line in block.replace("\\\n", " ").splitlines()]
    return [line.split("  #")[0].strip() for line in lines if line.strip()]


def written_files(path):
    """Files that the reader is to write: blocks of ```json PATH and ```csv PATH."""
    return re.findall(r"^```(?:json|csv) (\S+)\n(.*?)^```$", path.read_text(encoding="utf-8"), re.M | re.S)


def check_printed(path, printed):
    """Every line of a ```printed block is among what the page's commands have printed; ... stands for any text."""
    for block in re.findall(r"^```printed\n(.*?)^```$", path.read_text(encoding="utf-8"), re.M | re.S):
        for line in block.splitlines():
            pattern = ".*".join(re.escape(part.strip()) for part in line.split("..."))
            assert re.search(pattern, printed), f"{path.name}: no command of the page prints\n{line}"


def run(path, folder):
    copy = folder / path.stem
    subprocess.run(["git", "clone", "-q", "--shared", str(source), str(copy)], check=True)
    for name in ("experiments", "scripts", "python", "reference", "Makefile"):  # including uncommitted changes
        if (source / name).is_dir():
            shutil.copytree(source / name, copy / name, dirs_exist_ok=True)
        else:
            shutil.copy2(source / name, copy / name)
    for place in ("CMakeLists.txt", "tests/CMakeLists.txt", "benchmarks/CMakeLists.txt", "CMakePresets.json"):
        os.utime(copy / place, (0, 0))  # older than the build, so that CMake does not run again
    (copy / "build").symlink_to(build, target_is_directory=True)
    for name, text in written_files(path):
        (copy / name).write_text(text, encoding="utf-8")
    printed = ""
    for command in commands(path):
        for pattern, instead in INSTEAD:
            command = re.sub(f"^{pattern}", instead, command)
        done = subprocess.run(command, shell=True, cwd=copy, capture_output=True, text=True)
        assert done.returncode == 0, f"{path.name}: {command}: exit {done.returncode}\n{done.stdout}{done.stderr}"
        printed += done.stdout
        print(f"{path.name}: {command}")
    check_printed(path, printed)
    if code := "".join(re.findall(r"^```python\n(.*?)^```$", path.read_text(encoding="utf-8"), re.M | re.S)):
        code = re.sub(rf"results/({FIGURES})\.h5", r"results/\1-smoke.h5", code)
        done = subprocess.run([sys.executable, "-c", code], cwd=copy, env={**os.environ, "PYTHONPATH": "python"},
                              capture_output=True, text=True)
        assert done.returncode == 0, f"{path.name}: python: {done.stderr}"
        print(f"{path.name}: the blocks of Python")


for document in documents:
    check_links(document)
    if document.name != HISTORY:
        check_mentions(document)
    check_width(document)
for name, check in (("architecture.md", check_architecture), ("model.md", check_model), ("glossary.md", check_glossary),
                    ("experiments.md", check_experiments)):
    check(source / "docs" / name)
with tempfile.TemporaryDirectory() as folder:
    for document in documents:
        if document.name not in TESTED_ELSEWHERE and (commands(document) or "```python" in document.read_text(encoding="utf-8")):
            run(document, pathlib.Path(folder))
