// A bristle under the slab, in lengths of the bristle: side view, tilted so that the motion across is seen.

const PHASES = JSON.parse(document.getElementById("phases").textContent);  // by phase: [text, colour]
const UP = 0.85, BACK = 0.5, ASKEW = 0.28;  // on the screen: of z, and of y upwards and to the right
const LEFT = 1.15;  // from the left edge of a scene to the root
const FORCES = ["F_n", "F_fx", "F_fy"];
const RECENT = 0.04;  // time over which the arrows show the largest force

// The last row of the passage that is not after the time.
function rowAt({ xi, first, last }, time) {
  let [low, high] = [first, last];
  while (high > low) {
    const middle = Math.ceil((low + high) / 2);
    if (xi[middle] <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}

// The tip, its phase and the largest forces of the last moments.
function stateAt(passage, time) {
  const row = rowAt(passage, time), next = Math.min(row + 1, passage.last);
  const step = passage.xi[next] - passage.xi[row], share = step > 0 ? Math.min(1, (time - passage.xi[row]) / step) : 0;
  const between = (name) => passage[name][row] + share * (passage[name][next] - passage[name][row]);
  const state = Object.fromEntries(["x", "y", "z", ...FORCES].map((name) => [name, between(name)]));
  for (let i = row; i >= passage.first && passage.xi[i] > time - RECENT; --i)
    if (passage.F_n[i] > state.F_n) for (const name of FORCES) state[name] = passage[name][i];
  return { ...state, phase: passage.phase[row], left: time >= passage.end };
}

const long = (force) => Math.min(0.75, 0.16 * Math.sqrt(Math.abs(force)));  // of an arrow

// Scales that passages share: the end of time, the largest force, and the width of a scene, which holds the paths of all tips.
function scalesOf(passages) {
  const all = (name) => passages.flatMap((passage) => passage[name].slice(passage.first, passage.last + 1));
  const y = all("y"), right = Math.max(...all("x").map((x, i) => x + ASKEW * y[i]));
  return { end: Math.max(...all("xi")), most: Math.max(...all("F_n")), wide: LEFT + Math.max(2.15, right + 0.1) };
}

// Draws one passage into a group; returns the function that moves it to a time.
function makeLane(passage, { width, height, bottom, strip, length, words, wide }) {
  const unit = width / wide, origin = [LEFT * unit, bottom], edge = wide - 1.45;
  const place = (x, y, z) => [origin[0] + unit * (x + ASKEW * y), origin[1] - unit * (UP * z + BACK * y)];
  const path = (...points) => `M${points.map((point) => place(...point).map((number) => number.toFixed(1)).join(" ")).join("L")}`;
  const plate = (left, right, z) => `${path([left, -0.35, z], [right, -0.35, z], [right, 1.05, z], [left, 1.05, z])}z`;
  const group = element("g"), line = (name) => group.appendChild(element("path", { class: name }));
  group.append(element("path", { class: "ground", d: plate(-1.1, edge, 0) }));
  const { phi_0 = 1.396 } = passage, [s, up] = [Math.cos(phi_0), Math.sin(phi_0)];  // of the undeformed bristle; the paper's 80 degrees
  group.append(element("path", { class: "ghost", d: path([0, 0, 0], [s * Math.cos(passage.theta_0), s * Math.sin(passage.theta_0), up]) }));
  const slab = line("slab"), marks = line("marks");
  for (let from = passage.first; from < passage.last;) {
    let to = from;
    while (to < passage.last && passage.phase[to + 1] === passage.phase[from]) ++to;
    const rows = [...Array(Math.min(to + 1, passage.last) - from + 1).keys()].map((i) => from + i);
    group.append(element("path", { class: "trace", stroke: PHASES[passage.phase[from]][1],
      d: path(...rows.map((row) => [passage.x[row], passage.y[row], passage.z[row]])) }));
    from = to + 1;
  }
  const rod = line("rod"), normal = line("force normal"), friction = line("force friction");
  const tip = group.appendChild(element("circle", { class: "tip-of", r: 5.5 }));
  const text = group.appendChild(element("text", { x: 4, y: bottom - height + 14 }));
  const cursor = addStrip(group, passage, { width, top: bottom + 0.35 * BACK * unit + 4, ...strip });
  return { group, move(time) {
    const state = stateAt(passage, time), { x, y, z } = state;
    const [behind, front] = [passage.x[passage.first] + time - length, passage.x[passage.first] + time];
    const [left, right] = [Math.max(-1.1, behind), Math.min(edge, front)];
    slab.setAttribute("d", right > left ? plate(left, right, passage.z_0) : "");
    marks.setAttribute("d", [...Array(12).keys()].map((i) => front - i * 0.5).filter((at) => at > left && at < right)
      .map((at) => path([at, -0.35, passage.z_0], [at, 1.05, passage.z_0])).join(""));
    const colour = PHASES[state.phase][1], [px, py] = place(x, y, z);
    rod.setAttribute("d", path([0, 0, 0], [x, y, z]));
    for (const part of [rod, tip]) part.style.setProperty("--phase", colour);
    tip.setAttribute("cx", px);
    tip.setAttribute("cy", py);
    const size = Math.hypot(state.F_fx, state.F_fy) || 1, reach = long(size);
    normal.setAttribute("d", state.left ? "" : `${path([x, y, z + long(state.F_n)], [x, y, z])}m-4 -6l4 6l4 -6`);
    friction.setAttribute("d", state.left ? "" : path([x, y, z], [x + reach * state.F_fx / size, y + reach * state.F_fy / size, z]));
    text.textContent = words(passage, state);
    cursor(time);
  } };
}

// The normal force over time, on a scale of square roots, with the phases as colours.
function addStrip(group, passage, { width, top, tall, end, most }) {
  const across = (time) => (time / end) * width, high = (force) => top + tall - tall * Math.sqrt(Math.min(1, Math.max(0, force) / most));
  let d = "", from = passage.first;
  for (let row = passage.first; row <= passage.last; ++row) {
    d += `${d ? "L" : "M"}${across(passage.xi[row]).toFixed(1)} ${high(passage.F_n[row]).toFixed(1)}`;
    if (row < passage.last && passage.phase[row + 1] === passage.phase[from]) continue;
    group.append(element("rect", { x: across(passage.xi[from]), y: top, height: tall, opacity: 0.3, fill: PHASES[passage.phase[from]][1],
      width: Math.max(0, across(passage.xi[Math.min(row + 1, passage.last)]) - across(passage.xi[from])) }));
    from = row + 1;
  }
  group.append(element("path", { class: "curve", d }));
  const mark = group.appendChild(element("path", { class: "cursor" }));
  return (time) => mark.setAttribute("d", `M${across(Math.min(time, end))} ${top}v${tall}`);
}
