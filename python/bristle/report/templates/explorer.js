// The explorer: chosen figure, variable and slice; the map, the point's numbers, the table of points.

const chosen = { data: null, variable: null, at: [], mark: null, table: null };
const control = (name) => document.getElementById(name);

// The coordinates of a point; a node of a curve has its gap instead of its number. part: "name" or "symbol".
function placeOf(data, where, part = "name") {
  return data.axes.map((axis, i) => {
    const gap = data.along && i === data.map?.[0];
    const found = gap ? acrossOf(data) : axis;
    return `${found[part]} = ${shortly(found.values[gap ? pointAt(data, where) : where[i]])}`;
  }).join(", ");
}

// Position along every axis of the point with this index.
function positionOf(data, point) {
  const at = [];
  for (let i = data.axes.length - 1; i >= 0; --i) {
    at[i] = point % data.axes[i].values.length;
    point = Math.floor(point / data.axes[i].values.length);
  }
  return at;
}

function statusOf(data, point) {
  return data.status.words[data.status.codes[point]];
}

function numberRow(data, variable, point) {
  const value = valueOf(variable, point), error = variable.errors?.[point];
  const [shown, uncertain] = variable.words ? [value, ""] : withError(value, error);
  const row = element("tr", { "data-name": variable.name });
  row.classList.toggle("current", variable === chosen.variable);
  const cell = (content, exact) => element("td", { class: "number" },
    (exact ?? null) === null ? content : element("data", { value: exact, title: exact, text: content }));
  const head = element("th", { scope: "row", html: variable.symbol });
  head.append(element("small", { text: [variable.title, variable.equation, variable.unit].filter(Boolean).join(", ") }));
  row.append(head, cell(shown, value), cell(uncertain && `± ${uncertain}`, error));
  return row;
}

function showPoint() {
  const { data, at } = chosen, point = pointAt(data, at);
  const table = element("table", {}, element("caption", { class: "hidden", text: "Numbers of the point" }));
  const head = element("tr");
  for (const text of ["Quantity", "Value", "Error"]) head.append(element("th", { scope: "col", text }));
  table.append(element("thead", {}, head));
  const body = element("tbody");
  for (const variable of data.variables) body.append(numberRow(data, variable, point));
  table.append(body);
  const command = element("div", { class: "copyable" }, element("pre", { tabindex: 0, id: "replay",
    text: data.replay[Math.floor(point / data.nodes)] }),
  element("button", { type: "button", class: "copy", "data-what": "The command", text: "Copy" }));
  control("point").replaceChildren(
    element("h4", { html: placeOf(data, at, "symbol") || "The point" }),
    element("p", { class: "caption",
      text: `Status: ${statusOf(data, point)}. Rest on a number to see all its digits.` }),
    element("div", { class: "scroll", tabindex: 0, role: "group", "aria-label": "Its numbers" }, table),
    element("p", { class: "caption", text: data.nodes > 1 ? "The curve that it is on, computed again:"
      : "The point alone, computed again (with --force even if results/ has it):" }), command);
}

function choosePoint(where, focus) {
  chosen.at = where;
  chosen.mark?.(where, focus);
  const table = control("points"), point = pointAt(chosen.data, where);
  table.querySelector("[aria-selected=true]")?.removeAttribute("aria-selected");
  table.querySelector(`[data-point="${point}"]`)?.setAttribute("aria-selected", "true");
  showPoint();
}

function showMap() {
  const { data, variable, at } = chosen, box = control("map");
  chosen.mark = null;
  if (data.map) chosen.mark = drawMap(box, data, variable, at, choosePoint);
  else box.replaceChildren(element("p", { text: data.axes.length
    ? "One axis: its points are in the table below." : "This figure is of one point." }));
  choosePoint(at, false);
}

// A selection for each axis that the map does not show.
function showSlices() {
  const { data } = chosen;
  const selections = data.axes.map((axis, i) => {
    if (data.map?.includes(i)) return null;
    const select = element("select", { "data-axis": axis.name });
    axis.values.forEach((value, k) => select.append(element("option", { value: k,
      text: `${axis.name} = ${shortly(value)}` })));
    select.value = chosen.at[i];
    select.addEventListener("change", () => {
      chosen.at[i] = Number(select.value);
      showMap();
    });
    return element("label", {}, `${axis.title[0].toUpperCase()}${axis.title.slice(1)} `, select);
  });
  control("slices").replaceChildren(...selections.filter(Boolean));
}

// The first point with a value, under the reading shown by the page; Figure 6 starts with the Coulomb law, which its maps show.
function start(data) {
  const values = data.variables[0].values;
  const about = data.name === "fig6" ? data.axes.findIndex((axis) => axis.name === "friction") : -1;
  for (let point = 0; point < values.length; ++point) {
    const at = positionOf(data, point);
    const other = data.axes.some(({ keys }, i) => keys.includes(readingShown()) && keys[at[i]] !== readingShown());
    if (!other && values[point] !== null && (about < 0 || at[about] === data.axes[about].values.length - 1)) return at;
  }
  return data.axes.map(() => 0);
}

// aria-busy: until the numbers are decompressed.
async function chooseFigure(name) {
  control("explorer").setAttribute("aria-busy", "true");
  const data = await read(name);
  Object.assign(chosen, { data, variable: data.variables[0], at: start(data), table: null });
  control("choose-figure").value = name;
  control("choose-variable").replaceChildren(...data.variables.map((variable) =>
    element("option", { value: variable.name, text: `${variable.name}: ${variable.title}` })));
  control("points").tHead.replaceChildren();
  control("points").tBodies[0].replaceChildren();
  showSlices();
  showMap();
  if (!data.map) control("table-of-points").open = true;
  if (control("table-of-points").open) showTable();
  control("explorer").setAttribute("aria-busy", "false");
}

// Rows are made when the table is opened: some figures have more than a thousand.
function showTable() {
  const { data } = chosen, table = control("points");
  if (chosen.table === data) return;
  chosen.table = data;
  const shown = data.variables.filter((variable) => variable.errors).slice(0, 8);
  const head = element("tr");
  for (const { symbol: html } of [...data.axes, ...shown]) head.append(element("th", { scope: "col", html }));
  head.append(element("th", { scope: "col", text: "status" }));
  table.tHead.replaceChildren(head);
  const absent = data.status.words.indexOf("absent");
  const there = [...data.status.codes.keys()].filter((point) => data.status.codes[point] !== absent);
  table.tBodies[0].replaceChildren(...there.map((point) => pointRow(data, shown, point)));
  makeSortable(table);
  filter(document.querySelector("[data-table=points]"));
}

function pointRow(data, shown, point) {
  const at = positionOf(data, point);
  const row = element("tr", { "data-point": point, tabindex: 0 });
  data.axes.forEach((axis, i) => row.append(element("td", { class: "number",
    text: shortly(axis.values[at[i]]),
    ...(axis.words ? {} : { "data-value": axis.values[at[i]] }) })));
  for (const variable of shown)
    row.append(element("td", { class: "number", "data-value": variable.values[point] ?? "",
      text: withError(variable.values[point], variable.errors[point])[0] }));
  row.append(element("td", { text: statusOf(data, point) }));
  return row;
}

function pickRow(row) {
  const { data } = chosen;
  chosen.at = positionOf(data, Number(row.dataset.point));
  showSlices();
  showMap();
  say(`${placeOf(data, chosen.at)}: its numbers are above the table.`);
  control("point").scrollIntoView({ block: "nearest" });
}

control("choose-figure").addEventListener("change", (event) => chooseFigure(event.target.value));
control("choose-variable").addEventListener("change", (event) => {
  chosen.variable = chosen.data.variables.find(({ name }) => name === event.target.value);
  showMap();
});
control("controls").addEventListener("submit", (event) => event.preventDefault());
control("table-of-points").addEventListener("toggle", (event) => event.target.open && showTable());
control("points").addEventListener("click", (event) => {
  const row = event.target.closest("tbody tr");
  if (row) pickRow(row);
});
control("points").addEventListener("keydown", (event) => {
  const row = event.target.closest("tbody tr");
  if (row && event.key === "Enter") pickRow(row);
});
for (const link of document.querySelectorAll("a.explore"))
  link.addEventListener("click", () => chooseFigure(link.dataset.figure));

let width = 0;
new ResizeObserver(([entry]) => {
  if (Math.abs(entry.contentRect.width - width) < 1) return;
  width = entry.contentRect.width;
  if (chosen.data) showMap();
}).observe(control("map"));
chooseFigure(control("choose-figure").value);
