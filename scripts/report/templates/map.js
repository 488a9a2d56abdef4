// A map of one variable over two axes: equal cells, one for each point.

const COLOURS = JSON.parse(document.getElementById("colours").textContent);

function colour(share) {
  return COLOURS[Math.round(Math.min(1, Math.max(0, share)) * (COLOURS.length - 1))];
}

// To four digits; flags as words.
function shortly(value) {
  return typeof value === "string" ? value : value === null ? "no value"
    : `${Number(value.toPrecision(4))}`.replace("-", "−");
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

function layout(data, width) {
  const [x, y] = data.map.map((i) => data.axes[i]);
  const longest = Math.max(...y.values.map((value) => tick(value).length));
  const left = 10 + 6.2 * longest, right = 8, top = 6, bottom = 24;
  const cell = (width - left - right) / x.values.length;
  const row = Math.min(48, Math.max(18, Math.min(Math.max(cell, 200 / y.values.length),
    320 / y.values.length)));
  return { x, y, left, top, cell, row, width, height: top + row * y.values.length + bottom };
}

function hatching() {
  const pattern = element("pattern", { id: "hatching", width: 6, height: 6, patternUnits: "userSpaceOnUse",
    patternTransform: "rotate(45)" });
  pattern.append(element("rect", { width: 6, height: 6, fill: "#ddd" }),
    element("rect", { width: 2, height: 6, fill: "#777" }));
  return element("defs", {}, pattern);
}

function drawTicks(svg, form) {
  const { x, y, left, top, cell, row, height } = form;
  const longest = Math.max(...x.values.map((value) => tick(value).length));
  for (const i of ticks(x.values.length, cell, 7 * longest + 8))
    svg.append(element("text", { x: left + (i + 0.5) * cell, y: height - 8, "text-anchor": "middle",
      text: tick(x.values[i]) }));
  for (const j of ticks(y.values.length, row, 14))
    svg.append(element("text", { x: left - 6, y: top + (y.values.length - j - 0.5) * row + 4,
      "text-anchor": "end",
      text: tick(y.values[j]) }));
}

// Cells by row, the largest y on top, each with its position and point. describe(point): its text for
// screen readers.
function drawCells(svg, data, form, variable, at, describe) {
  const range = rangeOf(variable), cells = [];
  for (let j = form.y.values.length - 1; j >= 0; --j) {
    const group = element("g", { role: "row" });
    const line = [];
    for (let i = 0; i < form.x.values.length; ++i) {
      const where = [...at];
      where[data.map[0]] = i;
      where[data.map[1]] = j;
      const point = pointAt(data, where), value = valueOf(variable, point);
      const box = { x: form.left + i * form.cell, y: form.top + (form.y.values.length - 1 - j) * form.row,
        width: form.cell, height: form.row };
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
  const ramp = element("span", { class: "ramp",
    style: `background:linear-gradient(to right,${COLOURS.join(",")})` });
  scale.append(shortly(range.low), ramp, shortly(range.high));
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
    "aria-label": `Map: ${name}` });
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
    const found = find(where);
    for (const { cell } of cells.flat()) cell.tabIndex = -1;
    found.cell.tabIndex = 0;
    for (const [name, value] of Object.entries(found.box))
      for (const mark of [halo, frame]) mark.setAttribute(name, value);
    if (focus) found.cell.focus();
  };
}
