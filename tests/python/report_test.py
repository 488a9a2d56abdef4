"""The report in a browser without a network: numbers, sorting, filters, keyboard, phone, dark scheme, print and errors.

report_test.py ROOT PROGRAM FOLDER RESULT.h5...: results of the smoke tier, including fig4, fig6 and bristles. tests/assumptions.json
has invented numbers. Exits with 77 (skipped) without Chromium, its driver or Selenium, or axe-core, which npm fetches.
"""
import base64
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import h5py
import numpy as np

from browser import AXE, axe_core, browser, one, press, select, texts, view
from report_figures import check_curves_map, check_figures, check_phone, check_readings, check_saved, show_narrow, waited
from report_story import check_hand, check_player, check_recorded, check_story, check_tables

root, program, folder, *results = (pathlib.Path(word).absolute() for word in sys.argv[1:])
named = {re.split("[-_]", path.stem)[0]: path for path in results}
page = folder / "index.html"
LARGEST, MOST_PRINTED = 10e6, 30  # bytes of the file, pages in print
CONTRAST = (root / "tests/python/contrast.js").read_text()


def report(*files, **options):
    """Writes a report; options override the defaults."""
    options = {"o": page, "program": program, "assumptions": root / "tests/python/assumptions.json", "parts": folder / "parts", **options}
    words = [str(word) for key, value in options.items() for word in ("-o" if key == "o" else f"--{key}", value)]
    command = [sys.executable, "-m", "bristle.report", *files, *words]
    return subprocess.run(command, capture_output=True, text=True, cwd=root, env={**os.environ, "PYTHONPATH": str(root / "python")})


def check_output():
    """Equal inputs give equal pages, ids are unique, and links have targets."""
    digests = []
    for parts in ("parts", "parts", "others"):  # drawn, as drawn before, drawn again
        page.unlink(missing_ok=True)
        done = report(*results, parts=folder / parts)
        assert done.returncode == 0, done.stderr
        digests.append(page.read_bytes())
    assert len(set(digests)) == 1, "three runs gave different pages"
    assert len(digests[0]) < LARGEST, len(digests[0])
    content = re.sub(r"<script.*?</script>", "", digests[0].decode(), flags=re.DOTALL)
    ids = re.findall(r'\bid="([^"]*)"', content)
    assert len(ids) == len(set(ids)), sorted(i for i in set(ids) if ids.count(i) > 1)[:5]
    used = re.findall(r'href="#([^"]*)"|url\(#([^)]*)\)', content)
    lost = {a or b for a, b in used} - set(ids)
    assert not lost, f"no targets: {sorted(lost)[:5]}"
    words = [word for names in re.findall(r'aria-labelledby="([^"]*)"', content) for word in names.split()]
    assert set(words) <= set(ids)
    levels = [int(level) for level in re.findall(r"<h([1-6])[ >]", content)]
    assert levels[0] == 1 and all(b <= a + 1 for a, b in zip(levels, levels[1:])), "headings skip a level"
    linked = re.findall(r'(?:src|href)="((?:/|http)[^"]*)', content)
    assert all(link.startswith("https://doi.org/") for link in linked), linked
    for name in named:
        assert re.search(rf'<button type="button" class="data" data-name="{name}"', content), name
        assert f'<script type="application/json" id="columns-{name}">"' in digests[0].decode(), name


def check_shortened():
    """Paths of the drawings keep their points, lines that continue each other become one, letters are told from markers, and numbers
    keep the digits that their errors leave."""
    sys.path.insert(0, str(root / "python"))
    from bristle.report import svg, tables
    lines = ' d="M 678 2906 \nL 684.4 2906.2 \nL 684.41 2906.2 \nL 684.4 -0.3 \nz\nM 1 2 \nL 0.5 2.5 "'
    curved = ' d="M 1 2 \nQ 3 4 5 -6 \nL 5 -6 \nM 7 7 \nL 7 7"'
    assert svg.compact(lines + curved) == ' d="M678 2906l6.4 .2l0-2906.5zM1 2l-.5 .5" d="M1 2q2 2 4-8M7 7l0 0"'
    look = ' clip-path="url(#p)" style="fill: none; stroke: #000"/>'
    parts = "".join(f'<path d="M {a} 0 \nL {b} 0.5 \nL {b} 0 \n"{look}\n' for a, b in ((1, 2), (2, 3), (4, 5))) + f'<path d="M 5 0 \nL 6 0 \nz\n"{look}<path d=""{look}'
    assert svg.compact(parts) == f'<path d="M1 0l1 .5l0-.5l1 .5l0-.5M4 0l1 .5l0-.5M5 0l1 0z"{look}'
    letter = '<defs><path id="Sans-30" d="M0 0" transform="scale(0.015625)"/></defs><use xlink:href="#Sans-30" x="1.04" y="2"/>'
    made, letters = svg.inline(f'<svg viewBox="0 0 1 1">{letter}<path id="m" d="M1 1"/><use xlink:href="#m"/></svg>', "fig", "a", "b")
    assert letters == {"Sans-30": "M0 0"}
    assert made.endswith('<use xlink:href="#letter-Sans-30" x="1.04" y="2"/><path id="fig-m" d="M1 1"/><use xlink:href="#fig-m"/></svg>')
    assert tables.by_column("# a\nk_r,x,x_err,y,phase\n5.1234567,1.234567,0.0123,9.87654321,contact\n6.1234567,,,,unknown\n", ["k_r"]) == (
        "# a\n\nk_r,5.1234567,6.1234567\nx,1.235,\nx_err,0.012,\ny,9.8765,\nphase,contact,unknown")


def check_parts():
    """Of two figures only the one whose result changed is drawn again, also if what is kept of the other one is damaged later."""
    copies = [shutil.copy(named[name], folder / named[name].name) for name in ("fig4", "fig5")]
    parts = {name: folder / "few" / f"{named[name].stem}.pickle" for name in ("fig4", "fig5")}
    few = {"o": folder / "few.html", "parts": folder / "few"}
    assert report(*copies, **few).returncode == 0
    kept = {name: part.stat().st_mtime_ns for name, part in parts.items()}
    with h5py.File(copies[1], "r+") as file:
        file.attrs["caption"] = "another caption"
    assert report(*copies, **few).returncode == 0
    assert parts["fig4"].stat().st_mtime_ns == kept["fig4"] and parts["fig5"].stat().st_mtime_ns > kept["fig5"]
    made = (folder / "few.html").read_text()
    assert "another caption" in made
    parts["fig4"].write_bytes(parts["fig4"].read_bytes()[:1000])
    (folder / "few.html").unlink()
    assert report(*copies, **few).returncode == 0
    assert (folder / "few.html").read_text() == made


def check_errors():
    """Errors give one line and exit code 2 or 3; a missing figure or matrix is not an error."""
    (folder / "text.h5").write_text("not HDF5")
    (folder / "wrong.json").write_text('{"schema": "bristle-assumptions/0"}')
    (folder / "torn.json").write_text('{"schema": "bristle-assumptions/3", "checks": [{}]')
    document = json.loads((root / "tests/python/assumptions.json").read_text())
    document["cells"][0]["under"].pop()
    (folder / "cell.json").write_text(json.dumps(document))
    fig4, other, steeper = named["fig4"], {"o": folder / "other.html"}, folder / "steeper.h5"
    subprocess.run([program, "run", root / "experiments/bristles.json", "--tier", "smoke", "--set", "/model/phi_0_deg=85", "--quiet",
                    "-o", steeper], check=True)
    for files, options, words in (
            ([folder / "none.h5"], {}, "make figures"),
            ([folder / "text.h5"], {}, "not an HDF5 file"),
            ([fig4], {"program": folder / "none"}, "cannot be run"),
            ([fig4, steeper], {}, "they differ in /model of their experiments"),
            ([fig4], {"assumptions": folder / "wrong.json"}, "bristle-assumptions/0"),
            ([fig4], {"assumptions": folder / "torn.json"}, "torn.json"),
            ([fig4], {"assumptions": folder / "cell.json"}, "check 0 has 6 cells, not 7"),
            ([fig4], {"citation": folder / "text.h5"}, "not a citation file")):
        done = report(*files, **{**other, **options})
        assert done.returncode == 2 and words in done.stderr, (words, done.stderr)
        assert done.stderr.count("\n") == 1, done.stderr
    citation = (root / "CITATION.cff").read_text()
    (folder / "cited.cff").write_text(re.sub("(title: Exploiting.*)", r"\1\n    doi: 10.1000/invented", citation))
    done = report(fig4, "/proc/none/fig5-smoke.h5", **other, assumptions=folder / "none.json",
                  citation=folder / "cited.cff")
    made = (folder / "other.html").read_text()
    assert 'id="jump"' in made and 'id="recorded"' not in made
    assert made.count('<a href="https://doi.org/10.1000/invented">') == 2
    assert "@article{menga2022," in made
    assert done.returncode == 0 and "make fig5 TIER=smoke" in made and "make assumptions" in made, done.stderr
    assert report(fig4, o="/proc/none/index.html").returncode == 3
    assert report(fig4, parts="/proc/none", **other).returncode == 0


def check_table(driver, keys):
    """Sorting the points by click and by keyboard, and filtering them."""
    select(driver, "#choose-figure", "fig4")
    driver.execute_script("document.getElementById('explorer').open = true; document.getElementById('table-of-points').open = true")
    waited(driver, "return document.querySelectorAll('#points tbody tr').length > 9")
    everything = texts(driver, "#points tbody tr td:nth-child(2)")
    header, button = "#points th:nth-child(4)", "document.querySelector('#points th:nth-child(4) button')"
    driver.execute_script(f"{button}.click()")
    assert one(driver, header).get_attribute("aria-sort") == "ascending"
    values = """return [...document.querySelectorAll('#points tbody td:nth-child(4)')].map(e => e.dataset.value)
      .filter(Boolean).map(Number)"""
    found = driver.execute_script(values)
    assert found == sorted(found) and found[0] < found[-1], found
    driver.execute_script(f"{button}.focus()")
    press(driver, keys.ENTER)
    assert one(driver, header).get_attribute("aria-sort") == "descending"
    assert driver.execute_script(values) == found[::-1]
    words = one(driver, "[data-table=points] input[type=search]")
    words.send_keys("ok corrected")
    left = texts(driver, "#points tbody tr td:nth-child(2)")
    assert 0 < len(left) < len(everything)
    assert f"{len(left)} of {len(everything)}" in one(driver, "[data-table=points] .shown").text
    words.send_keys(keys.CONTROL, "a")
    words.send_keys(keys.DELETE)


def shown_numbers(driver):
    """Numbers in the panel of a point: name -> value and error."""
    script = """return Object.fromEntries([...document.querySelectorAll('#point tr[data-name]')].map(row =>
      [row.dataset.name, [...row.cells].slice(1).map(cell => cell.querySelector('data')?.value ?? null)]))"""
    return driver.execute_script(script)


def check_point(driver, name, point, replay):
    """The panel shows all numbers of the file and the command of the point."""
    shown = shown_numbers(driver)
    with h5py.File(named[name]) as file:
        expected = [key for key in file if f"{key}_err" in file and np.isfinite(file[key][()]).any()]
        assert len(expected) > 10
        for key in expected:
            value, error = (float(np.ravel(file[dataset][()])[point]) for dataset in (key, f"{key}_err"))
            assert [word is None for word in shown[key]] == [np.isnan(value), np.isnan(error)], (key, shown[key])
            if np.isfinite(value):
                assert abs(float(shown[key][0]) - value) <= max(0.06 * error, 1e-4 * abs(value) * (not error > 0)), (key, shown[key], value)
            if np.isfinite(error):
                assert abs(float(shown[key][1]) - error) <= 0.06 * error, (key, shown[key], error)
    assert one(driver, "#replay").text == replay[point]


def check_map(driver, keys):
    """Clicking a cell, arrow keys, selecting a slice and a variable, and a row of the table."""
    done = subprocess.run([program, "check", named["fig6"], "--json", "--report-only"], capture_output=True,
                          text=True, cwd=root)
    replay = json.loads(done.stdout)["replay"]
    for selector, value in (("#choose-figure", "fig6"), ("#choose-variable", "gamma_1"), ("#slices [data-axis=friction]", "0")):
        select(driver, selector, value)
    with h5py.File(named["fig6"]) as file:
        models, laws, k_r, k_theta = file["status"].shape
    assert (models, laws) == (3, 2)
    cells = driver.find_elements("css selector", "#map [role=gridcell]")
    assert len(cells) == k_r * k_theta
    cell = one(driver, '#map [data-point="4"]')
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", cell)  # not below the switch of readings
    cell.click()
    check_point(driver, "fig6", 4, replay)
    press(driver, keys.ARROW_RIGHT)
    check_point(driver, "fig6", 4 + k_theta, replay)
    press(driver, keys.ARROW_DOWN, keys.ENTER)
    check_point(driver, "fig6", 3 + k_theta, replay)
    stops = driver.find_elements("css selector", '#map [tabindex="0"]')
    assert len(stops) == 1 and stops[0].get_attribute("data-point") == str(3 + k_theta)
    driver.execute_script("document.getElementById('table-of-points').open = true")
    driver.implicitly_wait(5)
    one(driver, f'#points tr[data-point="{k_r * k_theta + 1}"]').send_keys(keys.ENTER)
    check_point(driver, "fig6", k_r * k_theta + 1, replay)
    slices = driver.find_elements("css selector", "#slices select")
    assert [found.get_attribute("value") for found in slices] == ["0", "1"]
    one(driver, "#point button.copy").click()
    driver.implicitly_wait(0)
    said = "The command: copied."
    for _ in range(50):  # the clipboard is asynchronous
        if one(driver, "#said").get_attribute("textContent") == said:
            break
        time.sleep(0.1)
    assert one(driver, "#said").get_attribute("textContent") == said
    return replay[4]


def check_every_figure(driver):
    """Every figure has a selected point with a command."""
    for name in named:
        select(driver, "#choose-figure", name)
        assert shown_numbers(driver) and one(driver, "#replay").text.split()[0].endswith("bristle"), name


def check_replay(command):
    """The command computes point 4 of Figure 6 with the same bits."""
    target = folder / "replay.h5"
    command = command.replace("build/bristle", str(program), 1).replace("results/replay.h5", str(target))
    subprocess.run(f"{command} --force --quiet", shell=True, check=True, cwd=root)
    with h5py.File(named["fig6"]) as all_points, h5py.File(target) as alone:
        names = [name for name in alone if f"{name}_err" in alone]
        assert len(names) > 10
        for name in names:
            assert np.ravel(alone[name][()])[0].tobytes() == np.ravel(all_points[name][()])[4].tobytes(), name


def check_matrix(driver, keys):
    driver.execute_script("document.getElementById('assumptions').open = true")
    cells = driver.find_elements("css selector", "#matrix td")
    driver.execute_script("arguments[0].click()", cells[0])
    said = "return document.getElementById('matrix-details').textContent.startsWith(arguments[0])"
    waited(driver, said, "4a, baseline: ✔ supported: measured 0.35")
    press(driver, keys.ARROW_RIGHT)
    waited(driver, said, "4a, phi_0=70:")
    assert {cell.text[0] for cell in cells} == {"S", "R", "U"}


def check_accessibility(driver):
    """axe-core finds no violation, on a phone, a tablet and a desktop, in both colour schemes. False without axe-core."""
    if (axe := axe_core(folder.parent)) is None:
        return False
    driver.set_script_timeout(600)
    for width in (360, 768, 1280):
        for scheme in ("light", "dark"):
            view(driver, page, width, 900, scheme)
            if width == 360:
                show_narrow(driver)
            driver.execute_script(axe)
            # What is within an image is not read by assistive technology, and takes axe-core minutes.
            driver.execute_script("document.querySelectorAll('svg.plot > g, svg.plot > defs').forEach(e => e.remove())")
            found = driver.execute_async_script("""const done = arguments[0];
              axe.run().then(({violations}) => done(violations.map(v => [v.id, v.nodes[0].html.slice(0, 300)])))""")
            assert not found, (width, scheme, found)
    return True


def check_views(driver):
    """No horizontal scrolling on phone and desktop in both colour schemes, even with all details open; contrast of text."""
    papers = set()
    widths = "const root = document.documentElement; return [root.scrollWidth, root.clientWidth]"
    for width, height in ((360, 740), (768, 1000), (1280, 900)):
        for scheme in ("light", "dark"):
            view(driver, page, width, height, scheme)
            for opening in ("", "for (const d of document.querySelectorAll('details')) d.open = true"):
                driver.execute_async_script(f"{opening}; setTimeout(arguments[0], 300)")
                wide = driver.execute_script(widths)
                assert wide[0] <= wide[1], (width, scheme, opening, wide)
            assert not (poor := driver.execute_script(CONTRAST)), (scheme, poor)
            papers.add(driver.execute_script("return getComputedStyle(document.body).backgroundColor"))
    assert len(papers) == 2, papers


def check_paper(driver):
    view(driver, page, 1280, 900, "dark")
    pdf = base64.b64decode(driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})["data"])
    pages = len(re.findall(rb"/Type\s*/Page\b", pdf))
    assert len(named) < pages <= MOST_PRINTED, f"{pages} pages"
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    hidden = "return [...document.querySelectorAll('.interactive')].every(e => !e.checkVisibility())"
    assert driver.execute_script(hidden), "interactive elements are printed"
    paper = "return getComputedStyle(document.body).backgroundColor"
    assert driver.execute_script(paper) == "rgb(255, 255, 255)"


def check_requests(driver):
    """The page requests no other resource, and the browser logs no message."""
    log = [json.loads(entry["message"])["message"] for entry in driver.get_log("performance")]
    asked = {message["params"]["request"]["url"] for message in log
             if message["method"] == "Network.requestWillBeSent"}
    assert page.as_uri() in {url.split("#")[0] for url in asked}, asked
    assert all(url.startswith((page.as_uri(), "data:", "blob:")) for url in asked), [url[:80] for url in asked]
    complaints = driver.get_log("browser")
    assert not complaints, complaints


shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
check_shortened()
check_output()
check_parts()
check_errors()
with browser() as chromium:
    from selenium.webdriver.common.keys import Keys
    view(chromium, page, 1280, 900)
    check_story(chromium, page)
    check_tables(chromium, named)
    check_player(chromium, Keys)
    check_hand(chromium, Keys, named["fig4"])
    check_recorded(chromium, Keys, named["fig4"], named["bristles"])
    check_table(chromium, Keys)
    check_matrix(chromium, Keys)
    check_replay(check_map(chromium, Keys))
    check_every_figure(chromium)
    check_curves_map(chromium)
    check_readings(chromium)
    check_figures(chromium, Keys, named["fig5"])
    check_saved(chromium, folder, named["fig4"])
    check_phone(chromium, Keys, page, folder)
    check_views(chromium)
    accessible = check_accessibility(chromium)
    check_paper(chromium)
    check_requests(chromium)
if not accessible:
    print(f"skipped: accessibility. All else passed, but axe-core is missing: `npm pack axe-core@{AXE}` in {folder.parent} "
          "gets it")
    sys.exit(77)
