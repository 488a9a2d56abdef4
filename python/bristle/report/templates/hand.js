// Figure 4 by hand: a handle moves over the maps of the three models, and the stored numbers of that point are shown, with
// the recorded bristles of the nearest point that has them.

const SHOWN = ["z_0", "R_x", "R_x_norm", "gamma_1", "gamma_2", "gamma_3", "F_n_spread"];

function pointOf(data, model, at) {
  const words = { bending: model, ...at };
  return pointAt(data, data.axes.map((axis) => (axis.name === "bending" ? axis.keys.indexOf(model) : words[axis.name])));
}

// The map of R_x_norm of one model, with dots where bristles are recorded; returns mark(at).
function handMap(panel, data, model, choose, passages) {
  const variable = data.variables.find(({ name }) => name === "R_x_norm"), range = rangeOf(variable);
  const [k_r, k_theta] = ["k_r", "k_theta"].map((name) => data.axes.find((axis) => axis.name === name));
  const width = panel.clientWidth, tall = 130, cell = [width / k_r.values.length, tall / k_theta.values.length];
  const svg = element("svg", { class: "scene", width, height: tall, viewBox: `0 0 ${width} ${tall}`, role: "img",
    "aria-label": `Map of the friction, ${MODELS[model]}` });
  k_r.values.forEach((_, i) => k_theta.values.forEach((_, j) => {
    const value = variable.values[pointOf(data, model, { k_r: i, k_theta: j })];
    svg.append(element("rect", { x: i * cell[0], y: tall - (j + 1) * cell[1], width: cell[0] + 0.5, height: cell[1] + 0.5,
      fill: value === null ? "#ddd" : colour(range.share(value)) }));
  }));
  for (const at of passages.filter((passage) => passage.model === model))
    svg.append(element("circle", { class: "dot", r: 2, cx: (at.k_r + 0.5) * cell[0], cy: tall - (at.k_theta + 0.5) * cell[1] }));
  const handle = [0, 1].map((i) => svg.appendChild(element("path", { class: `handle rim${i}` })));
  const drag = (event) => {
    const box = svg.getBoundingClientRect(), within = (share, count) => Math.max(0, Math.min(count - 1, Math.floor(share * count)));
    choose({ k_r: within((event.clientX - box.left) / box.width, k_r.values.length),
      k_theta: within(1 - (event.clientY - box.top) / box.height, k_theta.values.length) });
  };
  svg.addEventListener("pointerdown", (event) => { svg.setPointerCapture(event.pointerId); drag(event); });
  svg.addEventListener("pointermove", (event) => event.buttons && drag(event));
  panel.append(element("p", { class: "what", html: `friction ${variable.symbol}, dimensionless: ${k_r.symbol} →, ${k_theta.symbol} ↑` }), svg);
  return (at) => handle.forEach((part) => part.setAttribute("d", `M${(at.k_r + 0.5) * cell[0]} 0V${tall}` +
    `M${(at.k_r + 0.5) * cell[0] - 5} ${tall - (at.k_theta + 0.5) * cell[1]}h10`));
}

// The stored values over k_r as dots, and the value at the handle; returns mark(at).
function handCurve(panel, data, model, variable) {
  const count = data.axes.find((axis) => axis.name === "k_r").values.length, range = rangeOf(variable);
  const width = panel.clientWidth, tall = 34, svg = element("svg", { class: "scene", width, height: tall, viewBox: `0 0 ${width} ${tall}`, "aria-hidden": "true" });
  const [label, value] = [element("span", { html: `${variable.symbol} ${variable.title}` }), element("b", { class: "number" })];
  panel.append(element("p", { class: "reading-of", "data-name": variable.name }, label, value), svg);
  return (at) => {
    const of = (k_r) => variable.values[pointOf(data, model, { ...at, k_r })];
    svg.replaceChildren(...[...Array(count).keys()].filter((i) => of(i) !== null).map((i) => element("circle", { r: i === at.k_r ? 4 : 1.6,
      class: i === at.k_r ? "here" : "stored", cx: (i + 0.5) * width / count, cy: tall - 5 - (tall - 10) * range.share(of(i)) })));
    value.textContent = shortly(of(at.k_r));
  };
}

// The gap between slab and ground, to scale.
function handGap(panel, data, model, gap) {
  const width = panel.clientWidth, tall = 60, bar = element("rect", { class: "slab", width, height: 10 });
  panel.append(element("svg", { class: "scene", width, height: tall, viewBox: `0 0 ${width} ${tall}`, role: "img", "aria-label": `Gap, ${MODELS[model]}` },
    element("path", { class: "ground", d: `M0 ${tall - 2}H${width}` }), bar, element("text", { x: 4, y: 10, text: "slab over ground, gap to scale" })));
  return (at) => bar.setAttribute("y", tall - 12 - 38 * (gap.values[pointOf(data, model, at)] ?? 0));
}

// The player of the recorded bristles; returns mark(at).
function handBristles(passages, axes) {
  const change = startPlayer(document.getElementById("recorded"), passages), words = document.getElementById("recorded-at");
  const apart = (passage, at) => Math.hypot(...axes.map(({ name }) => passage[name] - at[name]));
  const pointInWords = (at) => axes.map((axis) => `${axis.symbol} = ${shortly(axis.values[at[axis.name]])}`).join(", ");
  return (at) => {
    const nearest = passages.reduce((a, b) => (apart(b, at) < apart(a, at) ? b : a));
    change((passage) => apart(passage, nearest) === 0);
    words.innerHTML = `Recorded at ${pointInWords(nearest)}, ` +
      (apart(nearest, at) === 0 ? "the handle's point." : "the nearest of the dots in the maps.");
  };
}

async function startHand(section) {
  const data = await read("fig4"), box = document.getElementById("jump-models");
  const passages = document.getElementById("recorded") ? await readPassages("recorded") : [];
  const sliders = [...section.querySelectorAll(".hand input")], axes = sliders.map(({ name }) => data.axes.find((axis) => axis.name === name));
  const follow = passages.length ? handBristles(passages, axes) : () => {};
  let at = Object.fromEntries(axes.map((axis) => [axis.name, Math.floor(axis.values.length / 2)])), marks = [];
  function choose(next) {
    at = { ...at, ...next };
    [...marks, follow].forEach((mark) => mark(at));
    sliders.forEach((slider, i) => {
      const value = shortly(axes[i].values[at[slider.name]]);
      slider.value = at[slider.name];
      slider.setAttribute("aria-valuetext", value);
      slider.parentElement.querySelector("output").textContent = value;
    });
  }
  function draw() {
    const variables = SHOWN.map((name) => data.variables.find((variable) => variable.name === name)).filter(Boolean);
    box.replaceChildren();
    marks = data.axes.find((axis) => axis.name === "bending").keys.flatMap((model) => {
      const panel = box.appendChild(element("div", { class: "model" }, element("h3", { text: MODELS[model] })));
      return [handMap(panel, data, model, choose, passages), handGap(panel, data, model, variables[0]),
        ...variables.map((variable) => handCurve(panel, data, model, variable))];
    });
    choose({});
  }
  sliders.forEach((slider, i) => {
    slider.max = axes[i].values.length - 1;
    slider.addEventListener("input", () => choose({ [slider.name]: Number(slider.value) }));
  });
  draw();
  let width = box.clientWidth;
  new ResizeObserver(() => { if (box.clientWidth !== width && box.clientWidth) { width = box.clientWidth; draw(); } }).observe(box);
  section.dataset.ready = "true";
}

if (document.getElementById("jump")) startHand(document.getElementById("jump"));
