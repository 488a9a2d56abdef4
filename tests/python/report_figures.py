"""Checks of the report's figures in a browser: enlarging, values of points, files, the switch of readings, maps of curves."""
import re
import time
from xml.etree import ElementTree

import h5py
import numpy as np

from browser import one, press, resize, select, view

PHONE, DESKTOP = (360, 740), (1280, 900)
LEAST_LETTER = 9  # pixels, on a phone
# Of a drawing, where it is in the window: the width of its viewBox, its height over its width, its least letter (pixels).
LAYOUT = """const box = arguments[0].querySelector('svg.plot').viewBox.baseVal;
  const sizes = [...arguments[0].querySelectorAll('svg.plot g[transform]')]
    .map(e => /scale\\(([\\d.]+) -/.exec(e.getAttribute('transform'))).filter(Boolean).map(found => 100 * found[1]);
  const { width, height } = arguments[0].getBoundingClientRect();
  return [box.width, height / width, Math.min(...sizes) * width / box.width]"""
# Scrolls to the next drawing that is visible and has not its narrow layout yet; true if there is none.
NEXT_WIDE = """const next = [...document.querySelectorAll('.drawing')]
    .find(e => e.checkVisibility() && !(e.querySelector('svg.plot')?.viewBox.baseVal.width < 300));
  next?.scrollIntoView();
  return !next"""


def waited(driver, script, *arguments):
    """Waits until the script returns true."""
    for _ in range(200):
        if driver.execute_script(script, *arguments):
            return
        time.sleep(0.05)
    raise AssertionError(script)


def check_figures(driver, keys, fig5):
    """A figure is enlarged by click and keyboard, Escape closes it, and the arrow keys read its curves' points."""
    drawing, is_open = one(driver, "#fig5 .drawing"), "return document.getElementById('enlarged').open"
    x, y, error, k_phi = map(float, re.findall(r"[=±] ([\d.]+)", point_by_keys(driver, keys, drawing)))
    with h5py.File(fig5) as file:
        found = [np.argmin(abs(file[name][()] - value)) for name, value in (("k_phi", k_phi), ("k_r", x))]
        value, uncertain = (file[name][()][0][tuple(found)] for name in ("N_c_ratio", "N_c_ratio_err"))
        assert found[0] == 1 and abs(y - value) < uncertain and abs(error - uncertain) < 0.05 * uncertain, (y, value, error)
    for start in (lambda: press(driver, keys.ENTER), lambda: driver.execute_script("arguments[0].click()", drawing),
                  lambda: one(driver, "#fig5 .enlarge").send_keys(keys.ENTER)):
        start()
        assert driver.execute_script(is_open)
        wide = driver.execute_script("return document.querySelector('dialog .plot').getBoundingClientRect().width")
        assert wide >= 900, wide
        press(driver, keys.ESCAPE)
        assert not driver.execute_script(is_open)
        assert driver.execute_script("return document.activeElement === document.querySelector('#fig5 .enlarge')")
        driver.execute_script("arguments[0].focus()", drawing)


def point_by_keys(driver, keys, drawing):
    """The values of the first point of the second curve."""
    driver.execute_script("arguments[0].blur(); arguments[0].focus()", drawing)
    waited(driver, "return arguments[0].querySelector('.tip')", drawing)  # the points are decompressed first
    press(driver, keys.ARROW_RIGHT, keys.ARROW_DOWN)
    return one(driver, "#fig5 .pointed .tip").text


def show_narrow(driver):
    """Scrolls over the page, so that each visible figure gets its narrow layout."""
    waited(driver, NEXT_WIDE)


def check_phone(driver, keys, page, saved):
    """On a phone panels are below each other and readable, with values of points; in a wide window, in print and enlarged
    they are side by side."""
    view(driver, page, *DESKTOP)
    drawing = one(driver, "#fig5 .drawing")
    wide, values = driver.execute_script(LAYOUT, drawing), point_by_keys(driver, keys, drawing)
    resize(driver, *PHONE)
    show_narrow(driver)
    for found in driver.find_elements("css selector", ".drawing"):
        if not driver.execute_script("return arguments[0].checkVisibility()", found):
            continue
        box, shape, letter = driver.execute_script(LAYOUT, found)
        assert box == 252 and letter >= LEAST_LETTER, (found.get_attribute("data-name"), box, letter)
    assert driver.execute_script(LAYOUT, drawing)[1] > 2 * wide[1], "panels are not below each other"
    lost = """const ids = [...document.querySelectorAll('[id]')].map(e => e.id);
      return ids.filter((id, i) => ids.indexOf(id) < i).concat([...document.querySelectorAll('[aria-labelledby]')]
        .flatMap(e => e.getAttribute('aria-labelledby').split(' ')).filter(id => !ids.includes(id)))"""
    assert not (found := driver.execute_script(lost)), found
    assert one(driver, "#fig5 .foot").text.startswith("Bands"), "the note of the figure is missing"
    overflow = "return document.documentElement.scrollWidth - document.documentElement.clientWidth"
    assert driver.execute_script(overflow) <= 0, driver.execute_script(overflow)
    check_narrow_points(driver, keys, drawing, values)
    check_wide_on_phone(driver, keys, drawing, saved)
    resize(driver, *DESKTOP)
    waited(driver, "return [...document.querySelectorAll('svg.plot')].filter(e => e.checkVisibility()).every(e => e.viewBox.baseVal.width > 400)")
    assert driver.execute_script(LAYOUT, drawing) == wide and point_by_keys(driver, keys, drawing) == values


def check_wide_on_phone(driver, keys, drawing, saved):
    """Enlarged and printed a drawing is the wide one, and the narrow one afterwards; what is shown is saved."""
    driver.execute_script("arguments[0].click()", drawing)
    assert driver.execute_script(LAYOUT, drawing)[0] > 400
    assert driver.execute_script("return document.querySelector('dialog .plot').getBoundingClientRect().width") >= 900
    press(driver, keys.ESCAPE)
    waited(driver, "return arguments[0].closest('figure')", drawing)
    assert driver.execute_script(LAYOUT, drawing)[0] == 252
    one(driver, "#fig5 button.save").send_keys(keys.ENTER)
    name = f"{drawing.get_attribute('data-name')}-narrow.svg"
    for _ in range(100):
        if (saved / name).exists():
            break
        time.sleep(0.1)
    assert ElementTree.parse(saved / name).getroot().get("width") == "252pt"
    driver.execute_script("""addEventListener('beforeprint', () => { document.body.dataset.printed =
      Math.min(...[...document.querySelectorAll('svg.plot')].map(e => e.viewBox.baseVal.width)) })""")
    driver.execute_cdp_cmd("Page.printToPDF", {})
    assert float(driver.execute_script("return document.body.dataset.printed")) > 400, "a narrow drawing is printed"
    assert driver.execute_script(LAYOUT, drawing)[0] == 252


def check_narrow_points(driver, keys, drawing, values):
    """Keyboard and pointer give the same values as on the wide drawing, at the point's place on the narrow one."""
    assert point_by_keys(driver, keys, drawing) == values
    place = """arguments[0].scrollIntoView();
      const box = arguments[0].querySelector('.mark').getBoundingClientRect();
      return [box.left + box.width / 2, box.top + box.height / 2]"""
    x, y = driver.execute_script(place, drawing)
    driver.execute_script("arguments[0].blur()", drawing)
    assert not driver.find_elements("css selector", "#fig5 .pointed")
    driver.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": "mouseMoved", "x": x + 2, "y": y})
    waited(driver, "return arguments[0].matches('.pointed')", drawing)
    assert one(driver, "#fig5 .tip").text == values
    tip = driver.execute_script("return document.querySelector('#fig5 .tip').getBoundingClientRect().toJSON()")
    assert tip["left"] >= 0 and tip["right"] <= PHONE[0], tip


def check_saved(driver, saved, fig4):
    """The CSV has the numbers of the file within a twentieth of their errors; the SVG is a drawing by itself, with its letters."""
    driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(saved)})
    for selector in ("#fig4 button.data", "#fig4 button.save"):
        driver.execute_script("document.querySelector(arguments[0]).click()", selector)
    wanted = [saved / name for name in ("fig4.csv", "fig4-polar.svg")]
    for _ in range(100):
        if all(path.exists() for path in wanted):
            break
        time.sleep(0.1)
    rows = [line.split(",") for line in wanted[0].read_text().splitlines() if not line.startswith("#")]
    with h5py.File(fig4) as file:
        for name, error in (("R_x_norm", "R_x_norm_err"), ("R_x_norm_err", "R_x_norm_err"), ("gamma_3", "gamma_3_err"), ("k_r", None)):
            column = np.array([float(row[rows[0].index(name)] or "nan") for row in rows[1:]])
            if error is None:
                assert set(column) == set(file[name][()])
                continue
            values, errors = np.ravel(file[name][()]), np.ravel(file[error][()])
            assert np.array_equal(np.isnan(column), np.isnan(values)), name
            assert np.nanmax(np.abs(column - values) / errors) <= 0.06, name
    assert "# k_r [1]: " in wanted[0].read_text()
    image = ElementTree.parse(wanted[1]).getroot()
    assert image.tag.endswith("svg") and image.get("width").endswith("pt")
    used = {use.get("{http://www.w3.org/1999/xlink}href")[1:] for use in image.iter("{http://www.w3.org/2000/svg}use")}
    ids = [shape.get("id") for shape in image.iter() if shape.get("id")]
    assert any(name.startswith("letter-") for name in used) and used <= set(ids) and len(ids) == len(set(ids)), used - set(ids)


def check_readings(driver):
    """The switch leaves one model of figures, verdicts and map."""
    readings = """return [...new Set([...document.querySelectorAll('main [data-reading]')]
      .filter(e => e.checkVisibility()).map(e => e.dataset.reading))].sort()"""
    assert driver.execute_script(readings) == ["polar"]
    for word in ("polar_as_printed", "polar", "rod"):
        driver.execute_script(f"document.querySelector('[name=reading][value={word}]').click()")
        assert driver.execute_script(readings) == [word]
        axis = driver.execute_script("return document.querySelector('[data-axis=bending]').value")
        assert axis == {"polar": "0", "polar_as_printed": "1", "rod": "2"}[word]
    driver.execute_script("document.querySelector('[name=reading][value=\"\"]').click()")
    assert driver.execute_script(readings) == ["polar", "polar_as_printed", "rod"]


def check_curves_map(driver):
    """The map of traced curves lies over the gap, and colour bars have several ticks."""
    select(driver, "#choose-figure", "fig3")
    assert "z" in one(driver, "#map .x-title").text and "gap" in one(driver, "#map .x-title").text
    assert "node" not in one(driver, "#point h4").text
    assert len(driver.find_elements("css selector", "#map .ramp span")) >= 3
    places = driver.execute_script("""return [...document.querySelector('#map [role=row]').children]
      .filter(e => e.matches('rect')).map(e => [+e.getAttribute('x'), +e.getAttribute('width')])""")
    assert places == sorted(places) and len({round(width, 1) for _, width in places}) > 1, places
