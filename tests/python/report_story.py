"""Checks of the report's story: the first screen, the height, letters, the tables of claims, the player and Figure 4 by hand."""
import h5py
import numpy as np

from browser import one, press, view

HIGHEST, LEAST_LETTER = 20_000, 9  # pixels
MOST_NODES = 60_000
# The least size of a letter (pixels) of text in HTML and in drawings of the page's own, with the text.
LETTERS = """let least = [99, ''];
  for (const e of document.querySelectorAll('body *:not(script, style, svg.plot *, .hidden, .hidden *)')) {
    if (![...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim()) || !e.checkVisibility()) continue;
    const matrix = e.ownerSVGElement?.getScreenCTM(), size = parseFloat(getComputedStyle(e).fontSize) * (matrix ? matrix.a : 1);
    if (size < least[0]) least = [size, e.textContent.slice(0, 40)];
  }
  return least"""
# What the page says of the bristles at the handle, the time, and of each: place of the tip from the root in lengths, phase.
LANES = """const numbers = e => e.getAttribute('d').match(/-?[0-9.]+/g).map(Number);
  const phases = Object.entries(JSON.parse(document.getElementById('phases').textContent));
  return [document.getElementById('recorded-at').textContent, /[0-9.]+/.exec(document.querySelector('#recorded output').textContent)[0],
    [...document.querySelectorAll('#recorded g')].map(lane => {
      const [left, , , , , , above] = numbers(lane.querySelector('.ground')), unit = (above - left) / (0.28 * 1.4);
      const rod = lane.querySelector('.rod'), [x, y, tipX, tipY] = numbers(rod), colour = rod.style.getPropertyValue('--phase');
      return [(tipX - x) / unit, (y - tipY) / unit, phases.find(([, found]) => found[1] === colour)[0]];
    })]"""
LOWER = "return Math.max(...[...document.querySelectorAll(arguments[0])].map(e => e.getBoundingClientRect().bottom + scrollY))"


def check_story(driver, page):
    """Drawing, five sentences, the jump and the models are on the first screen of a desktop; drawing and sentences on a phone's."""
    for width, height, inside in ((360, 740, ["#bristle", ".sentences-of-story"]),
                                  (1280, 900, ["#bristle", ".sentences-of-story", "#finding", ".models"])):
        view(driver, page, width, height)
        for selector in inside:
            assert driver.execute_script(LOWER, selector) <= height, (width, selector, driver.execute_script(LOWER, selector))
    assert len(driver.find_elements("css selector", ".sentences-of-story li")) == 5
    for width in (360, 768, 1024, 1280):
        view(driver, page, width, 900)
        least = driver.execute_script(LETTERS)
        assert least[0] >= LEAST_LETTER, (width, least)
    assert (tall := driver.execute_script("return document.documentElement.scrollHeight")) <= HIGHEST, tall
    nodes = driver.execute_script("return document.querySelectorAll('*').length")
    assert nodes <= MOST_NODES, nodes
    view(driver, page, 360, 740)
    beside = """return [...document.querySelectorAll('.models [data-model]')].filter(e => {
      const box = e.getBoundingClientRect(); return box.left < 0 || box.right > innerWidth || !e.checkVisibility(); }).length"""
    assert driver.execute_script(beside) == 0, "a model's numbers are cut off on a phone"
    view(driver, page, 1280, 900)
    cut = "return [...document.querySelectorAll('.overview, table.claims')].filter(e => e.getBoundingClientRect().right > innerWidth).length"
    assert driver.execute_script(cut) == 0, "a table of claims is cut off"


def check_tables(driver, named):
    """A row for each check with a column for each model, and the reason of every verdict that is not "supported"."""
    folded = "for (const part of document.querySelectorAll('#figures details.part')) part.open = arguments[0]"
    driver.execute_script(folded, True)
    for name, path in named.items():
        with h5py.File(path) as file:
            if "checks" not in file:
                continue
            checks = file["checks"]
            claim, reading, verdict = (checks[key][()].astype(str) for key in ("claim", "reading", "claim_verdict"))
            declared = len(np.unique(checks["declared"][()]))
        rows = driver.execute_script(f"return [...document.querySelectorAll('#{name} tr.check')].map(e => e.cells.length)")
        assert rows == [2 + len(set(reading))] * declared, (name, rows)
        why = driver.execute_script(f"""return [...document.querySelectorAll('#{name} tr.why[data-claim]')].filter(e =>
          e.checkVisibility() && e.textContent.length > 40).map(e => e.dataset.claim + ' ' + e.dataset.model)""")
        wanted = {f"{a} {b}" for a, b, c in zip(claim, reading, verdict) if c != "supported"}
        assert sorted(why) == sorted(wanted), (name, set(why) ^ wanted)
    driver.execute_script(folded, False)


def check_player(driver, keys):
    """Without motion the player rests; keys start, pause and move it, and all three models follow."""
    button, slider = one(driver, "#passages .start"), one(driver, "#passages input")
    poses = "return [...document.querySelectorAll('#passages .rod')].map(e => e.getAttribute('d'))"
    before = driver.execute_script(poses)
    assert button.text == "Play" and len(before) == 9 and len(driver.find_elements("css selector", "#passages .model")) == 3
    driver.execute_script("arguments[0].focus()", slider)
    press(driver, *[keys.ARROW_RIGHT] * 30)
    after = driver.execute_script(poses)
    assert slider.get_attribute("value") == "30" and all(a != b for a, b in zip(before, after))
    assert "NaN" not in "".join(after) and slider.get_attribute("aria-valuetext").startswith("time ")
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'}); arguments[0].focus()", button)
    press(driver, keys.SPACE)
    assert button.text == "Pause"
    driver.execute_async_script("setTimeout(arguments[0], 1000)")
    press(driver, keys.SPACE)
    assert button.text == "Play" and driver.execute_script(poses) != after
    still = driver.execute_script(poses)
    driver.execute_async_script("setTimeout(arguments[0], 300)")
    assert driver.execute_script(poses) == still


def check_hand(driver, keys, fig4):
    """The slider moves k_r, and the numbers are those of the result at that point."""
    driver.execute_script("document.querySelector('#jump [name=k_r]').focus()")
    with h5py.File(fig4) as file:
        for key, k_r in ((keys.END, -1), (keys.HOME, 0)):
            press(driver, key)
            for name in ("z_0", "gamma_3"):
                shown = driver.execute_script(f"""return [...document.querySelectorAll('#jump [data-name={name}] b')]
                  .map(e => Number(e.textContent))""")
                values = file[name][()]
                wanted = values[:, k_r, values.shape[2] // 2]
                assert np.allclose(shown, wanted, rtol=1e-3), (name, shown, wanted)


def check_recorded(driver, keys, fig4, bristles):
    """At each k_r of the handle the bristles are those recorded there, or at the nearest k_r that has them; and the page says so."""
    driver.execute_script("document.querySelector('#jump [name=k_r]').focus()")
    with h5py.File(fig4) as file, h5py.File(bristles) as recorded:
        grid, places = file["k_r"][()], [list(file["k_r"][()]).index(value) for value in recorded["k_r"][()]]
        for column in range(len(grid)):
            press(driver, keys.ARROW_RIGHT if column else keys.HOME)
            place = min(range(len(places)), key=lambda i: abs(places[i] - column))
            words, time, lanes = driver.execute_script(LANES)
            assert f"= {grid[places[place]]:.4g}" in words and ("the handle's point" in words) == (places[place] == column), words
            wanted = recorded_at(recorded, place, float(time))
            assert np.allclose([lane[:2] for lane in lanes], [lane[:2] for lane in wanted], atol=0.1), (column, lanes, wanted)
            assert [lane[2] for lane in lanes] == [lane[2] for lane in wanted], (column, lanes, wanted)


def recorded_at(file, place, time):
    """Of each model and azimuth at the k_r with this place: the tip as the page's side view shows it, and the tip's phase."""
    rows = {name: data[()] for name, data in file["trajectories"].items()}
    words = file["trajectories/phase"].attrs["flag_meanings"].decode().split()
    out = []
    for point in np.arange(file["status"].size).reshape(file["status"].shape)[:, place, 0]:
        for theta_0 in np.unique(rows["theta_0"]):
            here = (rows["point"] == point) & (rows["theta_0"] == theta_0)
            x, y, z = (np.interp(time, rows["xi"][here], rows[name][here]) for name in "xyz")
            phase = rows["phase"][here][np.searchsorted(rows["xi"][here], time, "right") - 1]
            out.append([x + 0.28 * y, 0.85 * z + 0.5 * y, words[phase]])
    return out
