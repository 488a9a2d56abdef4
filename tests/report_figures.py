"""Checks of the report's figures in a browser: enlarging, values of points, files, the switch of readings, maps of curves."""
import re
import time
from xml.etree import ElementTree

import h5py
import numpy as np

from browser import one, press, select, texts


def check_figures(driver, keys, fig5):
    """A figure is enlarged by click and keyboard, Escape closes it, and the arrow keys read its curves' points."""
    drawing, is_open = one(driver, "#fig5 .drawing"), "return document.getElementById('enlarged').open"
    driver.execute_script("arguments[0].focus()", drawing)
    for _ in range(50):  # the points are decompressed first
        press(driver, keys.ARROW_RIGHT)
        if driver.find_elements("css selector", "#fig5 .pointed"):
            break
        time.sleep(0.1)
    press(driver, keys.ARROW_DOWN)
    x, y, error, k_phi = map(float, re.findall(r"[=±] ([\d.]+)", one(driver, "#fig5 .pointed .tip").text))
    with h5py.File(fig5) as file:
        found = [np.argmin(abs(file[name][()] - value)) for name, value in (("k_phi", k_phi), ("k_r", x))]
        value, uncertain = (file[name][()][0][tuple(found)] for name in ("N_c_ratio", "N_c_ratio_err"))
        assert found[0] == 1 and abs(y - value) < uncertain and abs(error - uncertain) < 0.05 * uncertain, (y, value, error)
    for start in (lambda: press(driver, keys.ENTER), lambda: driver.execute_script("arguments[0].click()", drawing),
                  lambda: one(driver, "#fig5 .enlarge").send_keys(keys.ENTER)):
        start()
        assert driver.execute_script(is_open)
        wide = driver.execute_script("return document.querySelector('dialog .plot').getBoundingClientRect().width")
        assert wide >= 900, wide  # also on a phone, where it scrolls
        press(driver, keys.ESCAPE)
        assert not driver.execute_script(is_open)
        assert driver.execute_script("return document.activeElement === document.querySelector('#fig5 .enlarge')")
        driver.execute_script("arguments[0].focus()", drawing)


def check_saved(driver, saved, fig4):
    """The CSV has the numbers of the file, bit for bit; the SVG is a drawing by itself."""
    driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(saved)})
    for selector in ("#fig4 a.data", "#fig2 a.data:nth-of-type(2)", "#fig4 button.save"):
        driver.execute_script("document.querySelector(arguments[0]).click()", selector)
    wanted = [saved / name for name in ("fig4.csv", "fig2-trajectories.csv", "fig4-kinematic.svg")]
    for _ in range(100):
        if all(path.exists() for path in wanted):
            break
        time.sleep(0.1)
    rows = [line.split(",") for line in wanted[0].read_text().splitlines() if not line.startswith("#")]
    with h5py.File(fig4) as file:
        for name in ("R_x_norm", "R_x_norm_err", "gamma_3"):
            column = [float(row[rows[0].index(name)] or "nan") for row in rows[1:]]
            assert np.array_equal(column, np.ravel(file[name][()]), equal_nan=True), name
    assert "# theta_0 [rad]: " in wanted[1].read_text()
    image = ElementTree.parse(wanted[2]).getroot()
    assert image.tag.endswith("svg") and image.get("width").endswith("pt")


def check_readings(driver):
    """The switch leaves one reading of figures, verdicts and map."""
    readings = """return [...new Set([...document.querySelectorAll('main [data-reading]')]
      .filter(e => e.checkVisibility()).map(e => e.dataset.reading))].sort()"""
    assert driver.execute_script(readings) == ["as_printed", "kinematic"]
    for word in ("as_printed", "kinematic"):
        driver.execute_script(f"document.querySelector('[name=reading][value={word}]').click()")
        assert driver.execute_script(readings) == [word]
        assert len(set(texts(driver, "#all-claims tbody td:nth-child(8)"))) == 1
        axis = driver.execute_script("return document.querySelector('[data-axis=azimuth_rate]').value")
        assert axis == {"kinematic": "0", "as_printed": "1"}[word]
    driver.execute_script("document.querySelector('[name=reading][value=\"\"]').click()")
    assert driver.execute_script(readings) == ["as_printed", "kinematic"]


def check_curves_map(driver):
    """The map of traced curves lies over the gap, and colour bars have several ticks."""
    select(driver, "#choose-figure", "fig3")
    assert "z" in one(driver, "#map .x-title").text and "gap" in one(driver, "#map .x-title").text
    assert "node" not in one(driver, "#point h3").text
    assert len(driver.find_elements("css selector", "#map .ramp span")) >= 3
    places = driver.execute_script("""return [...document.querySelector('#map [role=row]').children]
      .filter(e => e.matches('rect')).map(e => [+e.getAttribute('x'), +e.getAttribute('width')])""")
    assert places == sorted(places) and len({round(width, 1) for _, width in places}) > 1, places
