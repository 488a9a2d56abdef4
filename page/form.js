// The form: what it says as an experiment, as the fragment of an address, and the program's messages beside its fields.

const PRESETS = JSON.parse(document.getElementById("presets").textContent);  // by name: title, experiment
const form = document.getElementById("form");
const fieldOf = (pointer) => form.querySelector(`[name="${pointer}"]:not(:disabled)`);
const fields = () => [...form.querySelectorAll("[name^='/']:not(:disabled)")];

function at(json, pointer) {
  return pointer.split("/").slice(1).reduce((part, key) => part?.[key], json);
}

// Sets, or without a value removes, what the pointer names.
function put(json, pointer, value) {
  const keys = pointer.split("/").slice(1), last = keys.pop();
  const part = keys.reduce((into, key) => (into[key] ??= {}), json);
  if (value === undefined) delete part[last];
  else part[last] = value;
}

const NUMBER = /^[-+]?(\d+[.,]?\d*|[.,]\d+)(e[-+]?\d+)?$/i;
const THOUSANDS = /^[-+]?[1-9]\d{0,2}(,\d{3})+$/;  // 50,000 is 50 with a decimal comma for one reader, and 50000 for another

// A number with a point or a comma; undefined for an empty field; the text if it is no number.
function valueOf(field) {
  const text = field.value.trim();
  if (text === "") return undefined;
  const number = Number(text.replace(",", "."));
  return NUMBER.test(text) && !THOUSANDS.test(text) && Number.isFinite(number) ? number : text;
}

// Whether the field is empty although the preset has a number there. Mass and density may stand for each other.
function isMissing(field) {
  const other = fields().find(({ name, dataset }) => dataset.instead === field.name || name === field.dataset.instead);
  return valueOf(field) === undefined && at(PRESETS[presetName()].experiment, field.name) !== undefined && !other?.value.trim();
}

// What is wrong with the text of an input of a number; empty if nothing is.
function mistakeIn(field, isEmpty) {
  const text = field.value.trim();
  if (isEmpty) return "empty: give a number";
  if (typeof valueOf(field) !== "string") return "";
  if (THOUSANDS.test(text)) return `${text} may be ${text.replaceAll(",", "")} or a number with a decimal comma: write it without a comma, or with a point`;
  return NUMBER.test(text) ? `${text} is too large` : `"${text}" is not a number: write digits, such as 0.017 or 1e8`;
}

// The first mistake of the form's texts, with the pointer of its field; empty if there is none.
function mistake(withCurve) {
  const inputs = fields().filter(({ tagName }) => tagName === "INPUT").map((field) => [field.name, field, isMissing(field)]);
  for (const [part, name] of withCurve ? RANGE.entries() : [])
    inputs.push([`/sweep/${keyOf(form.elements.over.value)}/points/${part}`, form.elements[name], valueOf(form.elements[name]) === undefined]);
  for (const [pointer, field, isEmpty] of inputs) {
    const words = mistakeIn(field, isEmpty);
    if (words) return `${pointer}: ${words}`;
  }
  return "";
}

const RANGE = ["from", "to", "count"];
const keyOf = (pointer) => pointer.split("/")[2];
const presetName = () => form.elements.preset.value;

// The brush as an experiment of one point; with the curve's axis if it is asked for. The program refuses texts that are no numbers.
function experimentOf(withCurve) {
  const experiment = structuredClone(PRESETS[presetName()].experiment);
  for (const field of fields()) put(experiment, field.name, isMissing(field) ? "" : valueOf(field));
  if (experiment.model.bending === "rod") experiment.model.section ??= "round";
  if (withCurve) {
    const [from, to, count] = RANGE.map((name) => valueOf(form.elements[name]) ?? "");
    experiment.sweep = { [keyOf(form.elements.over.value)]: { [form.elements.spacing.value]: [from, to, count] } };
  }
  return experiment;
}

// A number as one writes it: 1e8, 0.4, 5e-5.
function written(value) {
  const far = typeof value === "number" && value !== 0 && (Math.abs(value) >= 1e5 || Math.abs(value) < 1e-3);
  return far ? value.toExponential().replace("e+", "e") : value ?? "";
}

function showField(field, value) {
  field.value = written(value);
  const slider = field.closest(".field")?.querySelector("input[type=range]");
  if (!slider) return;
  slider.dataset.middle ||= value;
  const middle = Number(slider.dataset.middle), number = Number(value);
  if (middle > 0 && number > 0) slider.value = Math.round(100 * Math.log10(number / middle));
}

// Shows the preset, with changes by pointer.
function showPreset(name, changes = {}) {
  form.elements.preset.value = name;
  const { experiment } = PRESETS[name], kind = experiment.si ? "si" : "dimensionless";
  for (const group of form.querySelectorAll("[data-kind]")) {
    group.hidden = group.dataset.kind !== kind;
    for (const field of group.querySelectorAll("input, select")) field.disabled = group.hidden;
  }
  for (const field of fields()) {
    const slider = field.closest(".field")?.querySelector("input[type=range]");
    if (slider) slider.dataset.middle = at(experiment, field.name);
    showField(field, field.name in changes ? changes[field.name] : at(experiment, field.name));
  }
  const over = form.elements.over, shown = fields().filter((field) => field.tagName === "INPUT");
  over.replaceChildren(...shown.map((field) => element("option", { value: field.name, text: field.dataset.label })));
  showLaw();
  showRange();
}

// Only the strength of the chosen friction law is shown; the other one stays what it is.
function showLaw() {
  const law = fieldOf("/model/friction").value;
  for (const box of form.querySelectorAll("[data-law]")) box.hidden = box.dataset.law !== law;
}

// Shows a range around the brush's value, which it follows until a range is typed.
function showRange() {
  form.dataset.range = "follows";
  const value = Number(valueOf(fieldOf(form.elements.over.value)) ?? 1);
  form.elements.from.value = written(Number((value / 5).toPrecision(2)));
  form.elements.to.value = written(Number((value * 2.5).toPrecision(2)));
}

// The state in the address: the preset, what differs from it, and the curve.
function fragmentOf() {
  const words = new URLSearchParams({ preset: presetName() });
  for (const field of fields()) {
    const value = valueOf(field);
    if (value !== at(PRESETS[presetName()].experiment, field.name)) words.set(field.name, field.value.trim());
  }
  for (const name of ["over", ...(form.dataset.range === "typed" ? ["from", "to"] : []), "count", "spacing", "quantity"])
    words.set(name, form.elements[name].value);
  return `#${words}`;
}

function showFragment(fragment) {
  const words = new URLSearchParams(fragment.slice(1)), name = words.get("preset");
  const changes = Object.fromEntries([...words].filter(([key]) => key.startsWith("/")));
  showPreset(Object.hasOwn(PRESETS, name) ? name : Object.keys(PRESETS)[0], changes);
  for (const key of ["over", "from", "to", "count", "spacing", "quantity"])
    if (words.has(key)) form.elements[key].value = words.get(key);
  if (words.has("over") && !words.has("from")) showRange();
  if (words.has("from") || words.has("to")) form.dataset.range = "typed";
}

// The field beside which a message with this pointer stands: the field of the pointer, or of a part of the curve's range.
function fieldOfMessage(pointer) {
  const [, block, key, , part] = pointer.split("/");
  return block === "sweep" && key === keyOf(form.elements.over.value) ? form.elements[RANGE[part ?? 0]] : fieldOf(pointer);
}

// Shows a message of the program beside its field, or where messages without a field are.
function showError(message) {
  for (const field of document.querySelectorAll("[aria-invalid]")) field.removeAttribute("aria-invalid");
  for (const place of document.querySelectorAll(".wrong")) place.textContent = "";
  if (!message) return;
  const pointer = /^(\/[\w/]+)/.exec(message)?.[1] ?? "", words = message.slice(pointer.length).replace(/^:? /, "");
  const field = fieldOfMessage(pointer);
  if (field && !field.closest("[hidden]")) {
    const group = field.closest("details");
    if (group) group.open = true;
    field.setAttribute("aria-invalid", "true");
    field.closest(".field").querySelector(".wrong").textContent = words;
  } else {
    form.querySelector(".wrong.of-all").textContent = message;
  }
  say(message);
}

form.addEventListener("input", ({ target }) => {
  if (target.type !== "range") return;
  const field = target.closest(".field").querySelector("input[name]");
  field.value = written(Number((Number(target.dataset.middle) * 10 ** (target.value / 100)).toPrecision(3)));
});
