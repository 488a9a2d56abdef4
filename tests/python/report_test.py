"""The report: its numbers are those of the results, it is whole HTML without scripts, and a browser shows it on phone, desktop and paper.

report_test.py ROOT PROGRAM FOLDER RESULT.h5...: results of the smoke tier. Exits with 77 (skipped) without Chromium, its driver or
Selenium, or axe-core, which npm fetches.
"""
import base64
import hashlib
import html.parser
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import h5py

from browser import AXE, axe_core, browser, resize

root, program, folder, *results = (pathlib.Path(word).absolute() for word in sys.argv[1:])
page = folder / "index.html"
LARGEST, MOST_PRINTED = 4e6, 80  # bytes of the file, pages in print


class Page(html.parser.HTMLParser):
    """Ids, references to them, tags, levels of headings, and what the page says of each check and file."""
    def __init__(self, text):
        super().__init__()
        self.ids, self.used, self.tags, self.levels, self.rows, self.digests, self.linked = [], set(), set(), [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        self.tags.add(tag)
        self.ids += [found["id"]] if "id" in found else []
        self.used |= {words[1:] for words in [found.get("href", "")] if words.startswith("#")}
        self.used |= set(found.get("aria-labelledby", "").split()) | set(re.findall(r"url\(#([^)]*)\)", " ".join(filter(None, found.values()))))
        self.linked += [words for words in (found.get("href", ""), found.get("src", "")) if re.match("/|http", words)]
        if re.fullmatch("h[1-6]", tag):
            self.levels.append(int(tag[1]))
        if "data-check" in found:
            self.rows.append([int(found["data-check"]), found["data-reading"], found["data-verdict"]])
        elif tag == "data":
            self.rows[-1].append(float(found["value"]))
        elif "data-payload-sha256" in found:
            self.digests.append(found["data-payload-sha256"])


def report(*files, **options):
    """Writes a report; options override the defaults."""
    options = {"o": page, "program": program, "brush": folder / "none.html", **options}
    words = [str(word) for key, value in options.items() for word in ("-o" if key == "o" else f"--{key}", value)]
    return subprocess.run([sys.executable, "-m", "bristle.report", *files, *words], capture_output=True, text=True, cwd=root,
                          env={**os.environ, "PYTHONPATH": str(root / "python")})


def check_output():
    """Equal inputs give equal pages, ids are unique, links have targets, nothing is loaded, and there are no scripts."""
    digests = []
    for _ in range(2):
        done = report(*results)
        assert done.returncode == 0, done.stderr
        digests.append(page.read_bytes())
    assert digests[0] == digests[1], "two runs gave different pages"
    assert len(digests[0]) < LARGEST, len(digests[0])
    found = Page(digests[0].decode())
    assert len(found.ids) == len(set(found.ids)), sorted(i for i in set(found.ids) if found.ids.count(i) > 1)[:5]
    assert found.used <= set(found.ids), sorted(found.used - set(found.ids))[:5]
    assert "script" not in found.tags and not found.linked, found.linked
    assert found.levels[0] == 1 and all(b <= a + 1 for a, b in zip(found.levels, found.levels[1:])), "headings skip a level"
    return found


def check_numbers(found):
    """Verdict and number of each check under each model are the result's, digests are there as data, and the file beside has them."""
    wanted, digests = [], {}
    for path in results:
        with h5py.File(path) as file:
            digests[file.attrs["name"].decode()] = file.attrs["payload_sha256"].decode()
            if "checks" in file:
                columns = [file["checks"][name][()] for name in ("declared", "reading", "verdict", "measured")]
                wanted += [(path.name, int(a), b.decode(), c.decode(), float(d)) for a, b, c, d in zip(*columns)]
    assert len(wanted) > 100
    same = lambda rows: sorted(map(repr, rows))
    assert same(row[1:] for row in wanted) == same(map(tuple, found.rows)), set(same(row[1:] for row in wanted)) ^ set(same(map(tuple, found.rows)))
    assert found.digests == list(digests.values())
    made = json.loads((folder / "sources.json").read_text())
    assert made == {"page_sha256": hashlib.sha256(page.read_bytes()).hexdigest(), "payload_sha256": digests}, made


def check_errors():
    """Errors give one line and exit code 2 or 3; a missing figure is named with the command that computes it."""
    (folder / "text.h5").write_text("not HDF5")
    fig4, other = next(path for path in results if path.name.startswith("fig4")), {"o": folder / "other/index.html"}
    damaged = folder / "damaged.h5"
    shutil.copy(fig4, damaged)
    with h5py.File(damaged, "r+") as file:
        file["R_x"][...] = 1
    for files, options, words in (
            ([folder / "none.h5"], {}, "make figures"), ([folder / "text.h5"], {}, "not an HDF5 file"), ([damaged], {}, "does not match the numbers"),
            ([fig4], {"program": folder / "none"}, "cannot be run")):
        done = report(*files, **{**other, **options})
        assert done.returncode == 2 and words in done.stderr, (words, done.stderr)
        assert done.stderr.count("\n") == 1, done.stderr
    (folder / "brush.html").write_text("a brush")
    done = report(fig4, "/proc/none/fig5-smoke.h5", **other, brush=folder / "brush.html")
    made = (folder / "other/index.html").read_text()
    assert done.returncode == 0 and "make fig5 TIER=smoke" in made and "@article{menga2022," in made, done.stderr
    assert '<a href="brush.html">' in made and (folder / "other/brush.html").read_text() == "a brush"
    assert report(fig4, o="/proc/none/index.html").returncode == 3


def check_views(driver, axe):
    """No horizontal scrolling on a phone and a desktop, even with all details open, and no violation found by axe-core."""
    driver.set_script_timeout(600)
    for width, height in ((360, 740), (1280, 900)):
        resize(driver, width, height)
        driver.get(page.as_uri())
        for opening in ("", "for (const part of document.querySelectorAll('details')) part.open = true"):
            driver.execute_async_script(f"{opening}; setTimeout(arguments[0], 300)")
            wide = driver.execute_script("return document.documentElement.scrollWidth")
            assert wide <= width, (width, opening, wide)
        if axe:
            driver.execute_script(axe)
            # What is within an image is not read by assistive technology, and takes axe-core minutes.
            driver.execute_script("document.querySelectorAll('svg.plot > *').forEach(e => e.remove())")
            found = driver.execute_async_script("""const done = arguments[0];
              axe.run().then(({violations}) => done(violations.map(v => [v.id, v.nodes[0].html.slice(0, 300)])))""")
            assert not found, (width, found)


def check_paper(driver):
    """Print has the checks, which are behind a click on the screen."""
    driver.get(page.as_uri())
    pdf = base64.b64decode(driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})["data"])
    pages = len(re.findall(rb"/Type\s*/Page\b", pdf))
    assert len(results) < pages <= MOST_PRINTED, f"{pages} pages"
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    hidden = "return [...document.querySelectorAll('.checks li')].filter(e => !e.checkVisibility({ contentVisibilityAuto: true })).length"
    assert driver.execute_script(hidden) == 0, "checks are not printed"


def check_requests(driver):
    """The page requests no other resource, and the browser logs no message."""
    log = [json.loads(entry["message"])["message"] for entry in driver.get_log("performance")]
    asked = {message["params"]["request"]["url"] for message in log if message["method"] == "Network.requestWillBeSent"}
    assert all(url.startswith((page.as_uri(), "data:")) for url in asked), [url[:80] for url in asked]
    complaints = driver.get_log("browser")
    assert not complaints, complaints


shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
check_numbers(check_output())
check_errors()
axe_source = axe_core(folder.parent)
with browser() as chromium:
    check_views(chromium, axe_source)
    check_paper(chromium)
    check_requests(chromium)
if not axe_source:
    print(f"skipped: accessibility. All else passed, but axe-core is missing: `npm pack axe-core@{AXE}` in {folder.parent} gets it")
    sys.exit(77)
