// The players: play, pause and a slider over recorded passages. They start by themselves only if the reader's system allows
// motion, and pause while they are out of sight.

const MODELS = { polar: "corrected", polar_as_printed: "as printed", rod: "rod" };
const calm = matchMedia("(prefers-reduced-motion: reduce)");
const SPEED = 0.7;  // units of time in a second
const BEGIN = { bristle: 1.2, recorded: 2.4 };  // time of a player that has not started

// One scene for each model: a drawing of its own width, so that letters keep their size. Returns move(time).
function drawScenes(box, passages, only, scales) {
  const scenes = box.querySelector(".scenes"), lanes = [], hero = Boolean(only);
  scenes.replaceChildren();
  const made = Object.keys(MODELS).filter((model) => (only ? model === only : true))
    .map((model) => ({ model, mine: passages.filter((passage) => passage.model === model) })).filter(({ mine }) => mine.length);
  for (const found of made) {
    found.panel = element("div", { class: "model" });
    if (!hero && made.length > 1) found.panel.append(element("h3", { text: MODELS[found.model] }));
    scenes.append(found.panel);
  }
  for (const { panel, mine } of made) {
    const width = panel.clientWidth, unit = width / scales.wide, tall = hero ? 0 : 34;
    const shown = hero ? mine.slice(1, 2) : mine, height = 1.3 * unit, step = height + 0.2 * unit + tall + 14;
    const svg = element("svg", { class: "scene", role: "img", width, height: step * shown.length, viewBox: `0 0 ${width} ${step * shown.length}`,
      "aria-label": `${shown.length} recorded bristles under the slab` });
    shown.forEach((passage, i) => {
      const lane = makeLane(passage, { width, height, bottom: i * step + height, length: Number(box.dataset.length), words: hero ? heroWords : laneWords(wordsOf(mine[0].units?.force, scales.most, 1)),
        wide: scales.wide,
        strip: hero ? null : { tall, ...scales } });
      svg.append(lane.group);
      lanes.push(lane);
    });
    if (hero) addLabels(svg, width, height);
    panel.append(svg);
  }
  return (time) => lanes.forEach((lane) => lane.move(time));
}

function addLabels(svg, width, height) {
  svg.append(element("text", { x: width - 4, y: 0.42 * height, "text-anchor": "end", text: "slab, V₀ →" }),
    element("text", { x: 4, y: height - 6, text: "ground" }), element("text", { x: width * 0.46, y: 14, text: "dashed: undeformed" }));
}

const phaseOf = ({ left, phase }) => (left ? "has left the slab" : PHASES[phase][0]);
const heroWords = (_, state) => `tip: ${phaseOf(state)}`;
const laneWords = (forces) => ({ theta_0 }, state) => `θ₀ ${Math.round(theta_0 * 180 / Math.PI)}°: ${phaseOf(state)}` +
  (state.left ? "" : `, Fₙ ${forces(state.F_n)}, F_f ${forces(Math.hypot(state.F_fx, state.F_fy))}`);

// Returns words(value): a dimensionless number with that many places, or, if [the unit's size, its name] is given, in the unit
// with the prefix and places that the largest value needs: 2.5 mN.
function wordsOf(unit, largest, places) {
  if (!unit) return (value) => value.toFixed(places);
  const [size, name] = unit, [factor, letter] = prefixOf(largest * size), whole = Math.floor(Math.log10(largest * size / factor));
  return (value) => `${(value * size / factor).toFixed(Math.max(0, 2 - whole))} ${letter}${name}`;
}

// Plays the passages for which choose(passage) is true. Numbers are dimensionless, or in the passage's `units` of force and time,
// each [size, name]. The returned function replaces choose, and the passages if it is given others.
function startPlayer(box, passages, choose = () => true) {
  const only = box.dataset.models;
  let scales = scalesOf(passages), move, time = BEGIN[box.id] ?? 0, playing = false, before = 0, seen = true;
  const button = box.querySelector(".start"), slider = box.querySelector("input"), output = box.querySelector("output");
  function show(next) {
    time = next;
    move(time);
    slider.value = Math.round(1000 * time / scales.end);
    const unit = passages[0]?.units?.time, words = wordsOf(unit, scales.end, 2), after = unit ? "" : " r₀/V₀";
    output.textContent = `t = ${words(time)}${after}`;
    slider.setAttribute("aria-valuetext", `time ${words(time)} of ${words(scales.end)}${after}`);
  }
  function showKey() {
    const unit = only || passages[0]?.units ? "" : ", in m V₀²/r₀";
    box.querySelector(".key").replaceChildren(
      ...Object.values(PHASES).map(([text, colour]) => element("span", { style: `--phase:${colour}`, text })),
      element("span", { class: "of-normal", text: `load Fₙ${unit}` }), element("span", { class: "of-friction", text: `friction F_f${unit}` }));
  }
  function draw() {
    showKey();
    move = drawScenes(box, passages.filter(choose), only, scales);
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
  box.dataset.ready = "true";
  return (next, others = passages) => {
    [choose, passages] = [next, others];
    scales = scalesOf(passages);
    draw();
  };
}
