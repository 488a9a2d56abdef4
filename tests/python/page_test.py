"""The page of a brush in a browser, from a file: presets, fields, curve, stop, mistakes, sharing, saving, keyboard, phone, dark.

page_test.py ROOT PROGRAM PAGE.html FOLDER: FOLDER has the results of the presets. Exits with 77 (skipped) without Chromium,
its driver or Selenium, or axe-core, which npm fetches.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

from browser import AXE, axe_core, browser, one, press, resize

root, program, page, folder = (pathlib.Path(word).absolute() for word in sys.argv[1:])
CONTRAST = (root / "tests/python/contrast.js").read_text()
NUMBERS = ["R_x", "R_x_norm", "z_0", "gamma_3", "F_n_peak"]
MOST, SIZE = 8, 2e6  # errors between program and page; bytes


def wait(driver, script, *arguments, seconds=120):
    for _ in range(10 * seconds):
        if found := driver.execute_script(script, *arguments):
            return found
        time.sleep(0.1)
    raise AssertionError(f"{script}: not within {seconds} s: {driver.execute_script('return document.body.innerText')[:2000]}")


def show(driver, fragment="", width=1280, scheme="light"):
    resize(driver, width, 900)
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": [
        {"name": "prefers-color-scheme", "value": scheme}, {"name": "prefers-reduced-motion", "value": "reduce"}]})
    driver.get("about:blank")
    driver.get(page.as_uri() + fragment)
    settled(driver)


def settled(driver):
    """Waits until the brush of the form is computed."""
    time.sleep(0.3)  # input is computed after a moment without further input
    wait(driver, "return document.getElementById('now').getAttribute('aria-busy') === 'false'")


def complete(driver):
    wait(driver, "return document.getElementById('stop').disabled && state.curve && state.curve.answers.filter(Boolean).length === state.curve.values.length")


def enter(driver, pointer, text):
    driver.execute_script("""const field = fieldOf(arguments[0]);
      field.value = arguments[1];
      field.dispatchEvent(new Event('input', { bubbles: true }));""", pointer, text)
    settled(driver)


def choose(driver, name, value):
    driver.execute_script("""const select = form.elements[arguments[0]];
      select.value = arguments[1];
      select.dispatchEvent(new Event('change', { bubbles: true }));""", name, value)


def far(values, file, index=0):
    """The largest distance of numbers of the page from those of a result, in errors of the result."""
    distances = {}
    for name in NUMBERS:
        value, error = (float(np.ravel(file[key][()])[index]) for key in (name, f"{name}_err"))
        if np.isfinite(value) and error > 0:
            distances[name] = abs(values[name][0] - value) / error
    assert len(distances) > 3, distances
    return max(distances.values())


def check_presets(driver):
    for name in ("ski", "seal", "paper"):
        show(driver, f"#preset={name}&count=3")
        with h5py.File(folder / f"{name}.h5") as file:
            assert far(driver.execute_script("return state.brush.values"), file) < MOST, name
        facts = one(driver, "#facts").text
        assert any(word in facts for word in ("in contact", "bouncing", "mixed")) and "Friction coefficient" in facts, facts
        complete(driver)


def check_fields(driver):
    """A slider changes the brush, and so do a field, the law, the contact and the model."""
    show(driver, "#preset=ski&count=3")
    before = driver.execute_script("return state.brush.values.friction_coefficient[0]")
    driver.execute_script("""const slider = fieldOf('/si/V0_m_per_s').closest('.field').querySelector('input[type=range]');
      slider.value = -60;
      slider.dispatchEvent(new Event('input', { bubbles: true }));""")
    settled(driver)
    assert driver.execute_script("return fieldOf('/si/V0_m_per_s').value") == "2.51"
    found = [before, driver.execute_script("return state.brush.values.friction_coefficient[0]")]
    for pointer, text in (("/si/r0_m", "0,02"), ("/model/friction", "coulomb"), ("/model/contact", "wall"), ("/model/bending", "polar")):
        enter(driver, pointer, text)
        assert not one(driver, "#form").find_elements("css selector", "[aria-invalid]"), pointer
        found.append(driver.execute_script("return state.brush.values.friction_coefficient[0]"))
    assert len(set(found)) == len(found), found
    assert one(driver, "[data-law=coulomb]").is_displayed()


def check_mistakes(driver):
    """The program's messages are beside the fields; the page goes on with the next input."""
    show(driver, "#preset=ski&count=3")
    for pointer, text, words in (("/si/r0_m", "-1", "greater than 0"), ("/si/nu", "0.7", "at most 0.5"), ("/si/E_Pa", "stiff", "number"),
                                 ("/si/R_m", "", "empty"), ("/si/E_Pa", "50,000", "50000"), ("/si/E_Pa", "1e999", "too large")):
        kept = driver.execute_script("return fieldOf(arguments[0]).value", pointer)
        enter(driver, pointer, text)
        said = driver.execute_script("return [...document.querySelectorAll('.wrong')].map(e => e.textContent).join('')")
        assert said and words in said, (pointer, said)
        enter(driver, pointer, kept)
        assert not driver.execute_script("return [...document.querySelectorAll('.wrong')].map(e => e.textContent).join('')")
    enter(driver, "/si/rho_kg_per_m3", "900")
    said = driver.execute_script("return [...document.querySelectorAll('.wrong')].map(e => e.textContent).join('')")
    assert "m_kg" in said, said
    # A message is beside the field that was emptied, or beside the end of the range or the number of points that is wrong.
    for preset, pointer in (("ski", "/si/R_n_N"), ("ski", "/si/R_m"), ("ski", "/si/nu"), ("paper", "/load/R_n")):
        show(driver, f"#preset={preset}&count=3")
        enter(driver, pointer, "")
        assert driver.execute_script("return fieldOf(arguments[0]).closest('.field').querySelector('.wrong').textContent", pointer), pointer
    for name, text, words in (("from", "-1", "greater than 0"), ("to", "0.01", "above its start"), ("count", "2.5", "positive integer"),
                              ("count", "501", "at most 500")):
        show(driver, "#preset=ski&count=3")
        complete(driver)
        driver.execute_script("form.elements[arguments[0]].value = arguments[1]", name, text)
        one(driver, "button.main").click()
        said = wait(driver, "return document.getElementById(`${arguments[0]}-wrong`).textContent", name)
        assert words in said and len(driver.find_elements("css selector", "[aria-invalid]")) == 1, (name, said)
    show(driver, "#preset=ski&count=3")
    enter(driver, "/si/rho_kg_per_m3", "900")
    # Nothing is saved of a brush that the program refuses, nor the numbers of the brush before.
    driver.execute_script("window.save = () => { window.savedWrong = true; }")
    for button in ("#experiment", "#numbers"):
        one(driver, button).click()
        time.sleep(1)
        assert not driver.execute_script("return window.savedWrong"), button


def check_curve(driver, keys):
    show(driver, "#preset=ski&over=/si/V0_m_per_s&from=3&to=30&count=5")
    complete(driver)
    circles = driver.find_elements("css selector", "#chart circle[data-index]")
    assert len(circles) == 5 and one(driver, "#progress").text.startswith("5 of 5 points")
    chart = one(driver, "#chart")
    driver.execute_script("arguments[0].focus()", chart)
    wait(driver, "return document.querySelector('#chart .tip')")
    press(driver, keys.ARROW_RIGHT, keys.ARROW_RIGHT)
    tip = one(driver, "#chart .tip").text
    assert "friction" in tip and "Slab velocity, m/s" in tip and "±" in tip, tip
    assert driver.execute_script("return state.chosen") == 1 and one(driver, "#three-at").text.endswith("m/s")
    poses = "return [...document.querySelectorAll('#three .rod')].map(e => e.getAttribute('d'))"
    before = driver.execute_script(poses)
    assert len(before) == 3 and "NaN" not in "".join(before)
    driver.execute_script("document.querySelector('#three input').focus()")
    press(driver, *[keys.ARROW_RIGHT] * 40)
    assert driver.execute_script(poses) != before
    words = driver.execute_script("return document.getElementById('three').textContent")
    assert re.search(r"Fₙ [\d.]+ m?N, F_f [\d.]+ m?N", words) and re.search(r"t = [\d.]+ ms", words) and "₀/" not in words, words
    choose(driver, "quantity", "off_slab_share")
    assert "off the slab" in one(driver, "#chart svg.plot").get_attribute("aria-label")
    for name, value in (("count", "60"),):
        driver.execute_script("form.elements[arguments[0]].value = arguments[1]", name, value)
    one(driver, "button.main").click()
    wait(driver, "return state.curve.values.length === 60 && state.curve.answers.filter(Boolean).length > 1")
    one(driver, "#stop").click()
    computed = driver.execute_script("return state.curve.answers.filter(Boolean).length")
    time.sleep(2)
    assert computed == driver.execute_script("return state.curve.answers.filter(Boolean).length") < 60
    assert one(driver, "#progress").text.startswith("stopped at "), one(driver, "#progress").text
    enter(driver, "/si/R_n_N", "0.5")  # the workers are there again


def check_range(driver):
    """The range of the curve follows the brush until a range is typed."""
    ends = "return ['from', 'to'].map(name => form.elements[name].value)"
    show(driver, "#preset=ski&over=/si/V0_m_per_s&count=3")
    assert driver.execute_script(ends) == ["2", "25"]
    enter(driver, "/si/V0_m_per_s", "20")
    assert driver.execute_script(ends) == ["4", "50"]
    driver.execute_script("""form.elements.to.value = '30';
      form.elements.to.dispatchEvent(new Event('input', { bubbles: true }));""")
    enter(driver, "/si/V0_m_per_s", "10")
    assert driver.execute_script(ends) == ["4", "30"]
    one(driver, "#share").click()
    address = wait(driver, "return document.getElementById('address').textContent")
    show(driver, "#" + address.split("#")[1])
    assert driver.execute_script(ends) == ["4", "30"]


def check_shared(driver):
    show(driver, "#preset=seal&count=3")
    enter(driver, "/si/r0_m", "0.011")
    enter(driver, "/model/contact", "wall")
    one(driver, "#share").click()
    address = wait(driver, "return document.getElementById('address').textContent")
    fields = "return [...fields()].map(field => [field.name, field.value])"
    shown = driver.execute_script(fields)
    show(driver, "#" + address.split("#")[1])
    assert driver.execute_script(fields) == shown and ["/si/r0_m", "0.011"] in shown and ["/model/contact", "wall"] in shown
    assert driver.execute_script("return form.elements.preset.value") == "seal"


def check_saved(driver):
    """The program computes the saved experiment, and its numbers agree with the curve."""
    for fragment in ("#preset=ski&over=/si/R_n_N&from=0.2&to=1.2&count=4", "#preset=paper&over=/model/k_r&from=6&to=60&count=4",
                     "#preset=seal&over=/si/V0_m_per_s&from=30&to=80&count=2"):
        show(driver, fragment)
        complete(driver)
        driver.execute_script("window.save = (name, text) => { window.saved = text; }")
        one(driver, "#experiment").click()
        with tempfile.TemporaryDirectory() as there:
            experiment, result = pathlib.Path(there) / "saved.json", pathlib.Path(there) / "saved.h5"
            experiment.write_text(wait(driver, "return window.saved"))
            done = subprocess.run([program, "run", experiment, "-o", result, "--quiet"], capture_output=True, text=True, check=False)
            assert done.returncode == 0, done.stderr
            answers = driver.execute_script("return state.curve.answers")
            with h5py.File(result) as file:
                distances = [far(answer["values"], file, i) for i, answer in enumerate(answers)]
            assert max(distances) < MOST, (fragment, distances)
        one(driver, "#numbers").click()
        rows = [line for line in driver.execute_script("return window.saved").splitlines() if not line.startswith("#")]
        assert len(rows) == 1 + len(answers) and len({row.count(",") for row in rows}) == 1, rows
        column = rows[0].split(",").index("friction_coefficient")
        assert float(rows[1].split(",")[column]) == answers[0]["values"]["friction_coefficient"][0]


def check_again(driver):
    show(driver, "#preset=ski&count=3")
    select = one(driver, "#again select")
    for i in (0, len(select.find_elements("css selector", "option")) - 1):
        driver.execute_script("arguments[0].selectedIndex = arguments[1]; arguments[0].dispatchEvent(new Event('change'))", select, i)
        one(driver, "#again button").click()
        said = wait(driver, "const words = document.querySelector('#again .outcome').textContent; return words.startsWith('Computed') && words")
        assert float(said.split()[-2]) < MOST, said
        assert len(driver.find_elements("css selector", "#again tbody tr")) > 5
    assert "within their errors, and not in every bit" in " ".join(one(driver, "#again p").text.split())


def check_views(driver):
    """No horizontal scrolling, contrast of text, axe-core without violations. False without axe-core."""
    axe = axe_core(pathlib.Path(tempfile.gettempdir()))
    for width in (360, 768, 1280):
        for scheme in ("light", "dark"):
            show(driver, "#preset=ski&count=3", width, scheme)
            complete(driver)
            wide = driver.execute_script("const root = document.documentElement; return [root.scrollWidth, root.clientWidth]")
            assert wide[0] <= wide[1], (width, wide)
            assert not (poor := driver.execute_script(CONTRAST)), (width, scheme, poor)
            if axe is None:
                continue
            driver.execute_script(axe)
            driver.set_script_timeout(300)
            found = driver.execute_async_script("""const done = arguments[0];
              axe.run().then(({violations}) => done(violations.map(v => [v.id, v.nodes[0].html.slice(0, 300)])))""")
            assert not found, (width, scheme, found)
    return axe is not None


def check_requests(driver):
    log = [json.loads(entry["message"])["message"] for entry in driver.get_log("performance")]
    asked = {message["params"]["request"]["url"] for message in log if message["method"] == "Network.requestWillBeSent"}
    strangers = [url[:80] for url in asked if not url.startswith((page.as_uri(), "data:", "blob:", "about:"))]
    assert not strangers, strangers
    complaints = driver.get_log("browser")
    assert not complaints, complaints


assert page.stat().st_size <= SIZE, page.stat().st_size
with browser() as chromium:
    from selenium.webdriver.common.keys import Keys
    for check in (check_presets, check_fields, check_mistakes, check_range, check_shared, check_saved, check_again):
        check(chromium)
        print(check.__name__)
    check_curve(chromium, Keys)
    whole = check_views(chromium)
    check_requests(chromium)
if not whole:
    print(f"skipped: no axe-core {AXE}; everything else passed")
    sys.exit(77)
