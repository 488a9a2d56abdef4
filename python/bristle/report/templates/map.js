// A map of one variable over two axes: one cell for each point. The cells are equal, but for the cells of a traced curve,
// which lie at their gap.

const COLOURS = JSON.parse(document.getElementById("colours").textContent);

function colour(share) {
  return COLOURS[Math.round(Math.min(1, Math.max(0, share)) * (COLOURS.length - 1))];
}

// The label of a tick.
function tick(value) {
  return typeof value === "string" ? value : `${Number(value.toPrecision(3))}`;
}

// Index of a point from its position along every axis, the last axis fastest.
function pointAt(data, at) {
  return data.axes.reduce((index, axis, i) => index * axis.values.length + at[i], 0);
}

function valueOf(variable, point) {
  return variable.words ? variable.words[variable.codes[point]] : variable.values[point];
}

// The range of colours: over all slices, so that they can be compared.
function rangeOf(variable) {
  const numbers = (variable.codes ?? variable.values).filter((value) => value !== null);
  const low = numbers.reduce((a, b) => Math.min(a, b), Infinity);
  const high = numbers.reduce((a, b) => Math.max(a, b), -Infinity);
  return { low, high, share: (value) => (high > low ? (value - low) / (high - low) : 0.5) };
}

// Every n-th tick, so that labels of about this many pixels do not overlap.
function ticks(count, cell, room) {
  const step = Math.max(1, Math.ceil(room / cell));
  return [...Array(count).keys()].filter((i) => i % step === 0);
}

// The horizontal axis: an axis of the sweep, or for nodes of a curve the variable that places them.
function acrossOf(data) {
  return data.variables.find(({ name }) => name === data.along) ?? data.axes[data.map[0]];
}

// Round numbers from low to high, about five.
function roundNumbers(low, high) {
  const rough = (high - low) / 5, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 2.5, 5, 10].find((factor) => factor * power >= rough);
  const count = Math.floor(high / step + 1e-9) - Math.ceil(low / step - 1e-9) + 1;
  return [...Array(count).keys()].map((i) => Number(((Math.ceil(low / step - 1e-9) + i) * step).toPrecision(6)));
}

function layout(data, width) {
  const x = acrossOf(data), y = data.axes[data.map[1]];
  const longest = Math.max(...y.values.map((value) => tick(value).length));
  const left = 10 + 6.2 * longest, right = 8, top = 6, bottom = 24;
  const range = data.along && rangeOf(x);
  const cell = (width - left - right) / (data.along ? 12 : x.values.length);
  const row = Math.min(48, Math.max(18, Math.min(Math.max(cell, 200 / y.values.length),
    320 / y.values.length)));
  return { x, y, left, top, cell, row, range, width, inner: width - left - right, height: top + row * y.values.length + bottom };
}

function hatching() {
  const pattern = element("pattern", { id: "hatching", width: 6, height: 6, patternUnits: "userSpaceOnUse",
    patternTransform: "rotate(45)" });
  pattern.append(element("rect", { width: 6, height: 6, fill: "#ddd" }),
    element("rect", { width: 2, height: 6, fill: "#777" }));
  return element("defs", {}, pattern);
}

function drawTicks(svg, form) {
  const { x, y, left, top, cell, row, height, range } = form;
  const label = (place, value) => svg.append(element("text", { x: place, y: height - 8, "text-anchor": "middle",
    text: tick(value) }));
  if (range) for (const value of roundNumbers(range.low, range.high)) label(left + form.inner * range.share(value), value);
  else {
    const longest = Math.max(...x.values.map((value) => tick(value).length));
    for (const i of ticks(x.values.length, cell, 7 * longest + 8)) label(left + (i + 0.5) * cell, x.values[i]);
  }
  for (const j of ticks(y.values.length, row, 14))
    svg.append(element("text", { x: left - 6, y: top + (y.values.length - j - 0.5) * row + 4,
      "text-anchor": "end",
      text: tick(y.values[j]) }));
}

// The points of row j from left to right, each with the position and width of its cell.
function rowOf(data, form, at, j) {
  const points = data.axes[data.map[0]].values.map((_, i) => {
    const where = [...at];
    where[data.map[0]] = i;
    where[data.map[1]] = j;
    return { where, point: pointAt(data, where), x: form.left + i * form.cell, width: form.cell };
  });
  if (!form.range) return points;
  const place = ({ point }) => form.left + form.inner * form.range.share(form.x.values[point]);
  const there = points.filter(({ point }) => form.x.values[point] !== null).sort((a, b) => place(a) - place(b));
  const edge = (i) => (place(there[Math.max(i - 1, 0)]) + place(there[Math.min(i, there.length - 1)])) / 2;
  return there.map((found, i) => ({ ...found, x: edge(i), width: edge(i + 1) - edge(i) }));
}

// Cells by row, the largest y on top, each with its position and point. describe(point): its text for
// screen readers.
function drawCells(svg, data, form, variable, at, describe) {
  const range = rangeOf(variable), cells = [];
  for (let j = form.y.values.length - 1; j >= 0; --j) {
    const group = element("g", { role: "row" });
    const line = [];
    for (const { where, point, x, width } of rowOf(data, form, at, j)) {
      const value = valueOf(variable, point);
      const box = { x, y: form.top + (form.y.values.length - 1 - j) * form.row, width, height: form.row };
      const fill = value === null ? "url(#hatching)" : colour(range.share(variable.codes?.[point] ?? value));
      const cell = element("rect", { ...box, fill, role: "gridcell", tabindex: -1,
        "aria-label": describe(where, value),
        "data-point": point });
      line.push({ cell, box, where, point });
      group.append(cell);
      if (value !== null && data.status.codes[point] > 0)
        group.append(element("circle", { class: "dot", r: 2.5, cx: box.x + box.width / 2,
          cy: box.y + box.height / 2 }));
    }
    svg.append(group);
    cells.push(line);
  }
  return cells;
}

function key(mark, words) {
  const svg = element("svg", { viewBox: "0 0 16 16", "aria-hidden": "true" }, mark);
  return element("span", { class: "key" }, svg, ` ${words}`);
}

function legend(data, variable) {
  const scale = element("div", { class: "scale" });
  const range = rangeOf(variable);
  if (variable.words) {
    variable.words.forEach((word, code) => {
      if (variable.codes.includes(code))
        scale.append(key(element("rect", { width: 16, height: 16, fill: colour(range.share(code)) }), word));
    });
    return scale;
  }
  const ramp = element("span", { class: "ramp", role: "img",
    "aria-label": `Colours from ${shortly(range.low)} to ${shortly(range.high)}`,
    style: `background:linear-gradient(to right,${COLOURS.join(",")})` });
  for (const value of range.high > range.low ? roundNumbers(range.low, range.high) : [range.low])
    ramp.append(element("span", { style: `left:${100 * range.share(value)}%`, text: shortly(value) }));
  scale.append(ramp);
  if (variable.values.includes(null))
    scale.append(key(element("rect", { width: 16, height: 16, fill: "url(#hatching)" }), "no value"));
  if (variable.values.some((value, point) => value !== null && data.status.codes[point] > 0))
    scale.append(key(element("circle", { class: "dot", r: 3, cx: 8, cy: 8, fill: "#fff", stroke: "#000" }),
      "status other than ok"));
  return scale;
}

// Draws into the box; choose(where, focus) is called for a click or a key. Returns mark(where, focus).
function drawMap(box, data, variable, at, choose) {
  const form = layout(data, Math.max(260, box.clientWidth));
  const name = `${variable.title} over ${form.x.title} and ${form.y.title}`;
  const svg = element("svg", { viewBox: `0 0 ${form.width} ${form.height}`, role: "grid",
    "aria-label": `Map: ${name}`, class: data.along ? "curves" : "" });
  svg.append(hatching());
  const describe = (where, value) => `${placeOf(data, where)}: ${variable.name} ${shortly(value)}`;
  const cells = drawCells(svg, data, form, variable, at, describe);
  drawTicks(svg, form);
  const halo = element("rect", { class: "chosen" }), frame = element("rect", { class: "chosen" });
  svg.append(halo, frame);
  const find = (where) => cells.flat().find((cell) => cell.where.every((i, d) => i === where[d]));
  svg.addEventListener("click", (event) => {
    const found = cells.flat().find(({ cell }) => cell === event.target);
    if (found) choose(found.where, true);
  });
  svg.addEventListener("keydown", (event) => {
    const found = cells.flat().find(({ cell }) => cell === event.target);
    if (!found || !(event.key in STEPS || event.key === "Enter" || event.key === " ")) return;
    const j = cells.findIndex((line) => line.includes(found)), i = cells[j].indexOf(found);
    const [down, right] = STEPS[event.key] ?? [0, 0];
    choose((cells[j + down]?.[i + right] ?? found).where, true);
    event.preventDefault();
  });
  box.replaceChildren(
    element("p", { class: "y-title", html: `↑ ${form.y.title} ${form.y.symbol}` }), svg,
    element("p", { class: "x-title", html: `${form.x.title} ${form.x.symbol} →` }), legend(data, variable));
  return (where, focus) => {
    const found = find(where) ?? cells.flat()[0];
    for (const { cell } of cells.flat()) cell.tabIndex = -1;
    found.cell.tabIndex = 0;
    for (const [name, value] of Object.entries(found.box))
      for (const mark of [halo, frame]) mark.setAttribute(name, value);
    if (focus) found.cell.focus();
  };
}
