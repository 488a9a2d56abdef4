// The player: play, pause and a slider over passages. It starts by itself only if the reader's system allows motion, and
// pauses while it is out of sight.

const calm = matchMedia("(prefers-reduced-motion: reduce)");
const SPEED = 0.7;  // units of time in a second
const STRIP = 34;  // pixels, height of the strip below a bristle

// Draws the passages below each other in the width of the box, so that letters keep their size. Returns move(time).
function drawScene(box, passages, scales) {
  const scenes = box.querySelector(".scenes"), width = scenes.clientWidth, unit = width / scales.wide;
  const height = 1.3 * unit, step = height + 0.2 * unit + STRIP + 14, length = Number(box.dataset.length);
  const words = laneWords(wordsOf(passages[0].units?.force, scales.most, 1));
  const lanes = passages.map((passage, i) => makeLane(passage, { width, height, bottom: i * step + height, length, words,
    wide: scales.wide, strip: { tall: STRIP, ...scales } }));
  const tall = step * passages.length;
  scenes.replaceChildren(element("svg", { class: "scene", role: "img", width, height: tall, viewBox: `0 0 ${width} ${tall}`,
    "aria-label": `${passages.length} recorded bristles under the slab` }, ...lanes.map(({ group }) => group)));
  return (time) => lanes.forEach((lane) => lane.move(time));
}

const phaseOf = ({ left, phase }) => (left ? "has left the slab" : PHASES[phase][0]);
const laneWords = (forces) => ({ theta_0 }, state) => `θ₀ ${Math.round(theta_0 * 180 / Math.PI)}°: ${phaseOf(state)}` +
  (state.left ? "" : `, Fₙ ${forces(state.F_n)}, F_f ${forces(Math.hypot(state.F_fx, state.F_fy))}`);

// Returns words(value): a dimensionless number with that many places, or, if [the unit's size, its name] is given, in the unit
// with the prefix and places that the largest value needs: 2.5 mN.
function wordsOf(unit, largest, places) {
  if (!unit) return (value) => value.toFixed(places);
  const [size, name] = unit, [factor, letter] = prefixOf(largest * size), whole = Math.floor(Math.log10(largest * size / factor));
  return (value) => `${(value * size / factor).toFixed(Math.max(0, 2 - whole))} ${letter}${name}`;
}

// Plays the passages, whose numbers are dimensionless, or in their `units` of force and time, each [size, name]. Returns a
// function that replaces them.
function startPlayer(box, passages) {
  let scales = scalesOf(passages), move, time = 0, playing = false, before = 0, seen = true;
  const button = box.querySelector(".start"), slider = box.querySelector("input"), output = box.querySelector("output");
  function show(next) {
    time = next;
    move(time);
    slider.value = Math.round(1000 * time / scales.end);
    const unit = passages[0].units?.time, words = wordsOf(unit, scales.end, 2), after = unit ? "" : " r₀/V₀";
    output.textContent = `t = ${words(time)}${after}`;
    slider.setAttribute("aria-valuetext", `time ${words(time)} of ${words(scales.end)}${after}`);
  }
  function showKey() {
    const unit = passages[0].units ? "" : ", in m V₀²/r₀";
    box.querySelector(".key").replaceChildren(
      ...Object.values(PHASES).map(([text, colour]) => element("span", { style: `--phase:${colour}`, text })),
      element("span", { class: "of-normal", text: `load Fₙ${unit}` }), element("span", { class: "of-friction", text: `friction F_f${unit}` }));
  }
  function draw() {
    showKey();
    move = drawScene(box, passages, scales);
    show(time);
  }
  function frame(now) {
    if (!playing) return;
    const next = time + SPEED * Math.min(0.1, (now - before) / 1000);
    before = now;
    if (seen) show(next > scales.end + 0.4 ? 0 : next);
    requestAnimationFrame(frame);
  }
  function play(on) {
    playing = on;
    button.textContent = on ? "Pause" : "Play";
    box.classList.toggle("playing", on);
    before = performance.now();
    if (on) requestAnimationFrame(frame);
  }
  button.addEventListener("click", () => play(!playing));
  slider.addEventListener("input", () => { play(false); show(scales.end * slider.value / 1000); });
  new IntersectionObserver(([entry]) => { seen = entry.isIntersecting; }).observe(box);
  let width = box.clientWidth;
  new ResizeObserver(() => {
    if (box.clientWidth === width || !box.clientWidth) return;
    width = box.clientWidth;
    draw();
  }).observe(box);
  box.querySelector(".play").hidden = false;
  draw();
  if (!calm.matches) play(true);
  return (others) => {
    passages = others;
    scales = scalesOf(passages);
    draw();
  };
}
