// The page's scripts without a browser: what the form reads from its fields, and where the curve's line is broken.
// scripts_test.js ROOT
const assert = require("assert"), fs = require("fs"), path = require("path"), vm = require("vm");

const PRESETS = { paper: { title: "paper", experiment: { model: { k_r: 10, bending: "polar" }, si: { m_kg: 1e-4 } } } };
const input = (name, text, dataset = {}) => ({ name, dataset, tagName: "INPUT", closest: () => null,
  get value() { return text; }, set value(value) { text = String(value); } });

// The form of a page with these fields; its functions by name.
function formWith(fields) {
  const elements = { preset: { value: "paper" }, over: { value: "/model/k_r", replaceChildren() {} }, spacing: { value: "linspace" }, quantity: {} };
  for (const [name, value] of [["from", "1"], ["to", "2"], ["count", "5"]]) elements[name] = input(name, value);
  const form = { elements, dataset: {}, addEventListener() {},
    querySelectorAll: (selector) => (selector.startsWith("[name") ? fields : []),
    querySelector: (selector) => fields.find(({ name }) => selector.includes(`"${name}"`)) ?? input("", "") };
  const document = { getElementById: (id) => (id === "form" ? form : { textContent: JSON.stringify(PRESETS) }), querySelectorAll: () => [] };
  return { elements, ...run("form.js", { document, structuredClone, URLSearchParams, element: () => ({}), say() {} }, ["experimentOf", "mistake", "showFragment"]) };
}

// Functions of a script, by name.
function run(script, context, names) {
  vm.createContext(context);
  vm.runInContext(`${fs.readFileSync(path.join(process.argv[2], "page", script), "utf8")}; this.found = { ${names} };`, context);
  return context.found;
}

function checkNumbers() {
  const field = input("/model/k_r", "10"), page = formWith([field]);
  for (const [text, number] of [["10", 10], ["0,02", 0.02], ["0,017", 0.017], ["1234,567", 1234.567], [".5", 0.5], ["1e8", 1e8], [" -3 ", -3], ["2,5e-3", 0.0025]]) {
    field.value = text;
    assert.strictEqual(page.experimentOf(false).model.k_r, number, text);
    assert.strictEqual(page.mistake(true), "", text);
  }
  for (const [text, words] of [["50,000", "50000"], ["1,234", "1234"], ["1,234,567", "1234567"], ["1e999", "too large"], ["-1e999", "too large"], ["", "empty"],
    [" ", "empty"], ["0x10", "not a number"], ["Infinity", "not a number"], ["NaN", "not a number"], ["1.2.3", "not a number"], ["stiff", "not a number"]]) {
    field.value = text;
    const said = page.mistake(false), { k_r } = page.experimentOf(false).model;
    assert(said.startsWith("/model/k_r: ") && said.includes(words), `${text}: ${said}`);
    assert.strictEqual(k_r, text.trim(), `${text} was sent as ${k_r}`);  // a text, which the program refuses
  }
}

function checkAlternatives() {
  const mass = input("/si/m_kg", ""), density = input("/si/rho_kg_per_m3", "", { instead: "/si/m_kg" }), page = formWith([mass, density]);
  assert.strictEqual(page.mistake(false), "/si/m_kg: empty: give a number");
  density.value = "900";
  assert.strictEqual(page.mistake(false), "");
  const { si } = page.experimentOf(false);
  assert(!("m_kg" in si) && si.rho_kg_per_m3 === 900, JSON.stringify(si));
}

function checkRange() {
  const page = formWith([input("/model/k_r", "10")]);
  for (const [part, name] of ["from", "to", "count"].entries()) {
    const kept = page.elements[name].value;
    for (const text of ["", "1e999", "1,000", "0x10"]) {
      page.elements[name].value = text;
      assert.strictEqual(page.mistake(false), "");
      assert(page.mistake(true).startsWith(`/sweep/k_r/points/${part}: `), page.mistake(true));
    }
    page.elements[name].value = kept;
  }
}

// An address names a preset; what is no preset begins with the first one.
function checkAddress() {
  for (const name of ["toString", "constructor", "__proto__", "nothing", "paper"]) {
    const field = input("/model/k_r", "1"), page = formWith([field, input("/model/friction", "nss")]);
    page.showFragment(`#preset=${name}`);
    assert.strictEqual(page.elements.preset.value, "paper", name);
    assert.strictEqual(field.value, "10", name);
  }
}

function checkLine() {
  const { joined } = run("chart.js", {}, ["joined"]);
  const runs = (phases) => joined(phases.map((phase, x) => ({ x, phase }))).map((run) => run.map(({ x }) => x));
  assert.deepEqual(runs(["bouncing", "bouncing", "contact", "contact"]), [[0, 1], [2, 3]]);
  assert.deepEqual(runs(["contact", "bouncing", "contact", "contact"]), [[2, 3]]);
  assert.deepEqual(runs(["contact", "mixed", "bouncing", "unknown"]), [[0, 1, 2, 3]]);
  assert.deepEqual(runs([]), []);
}

for (const check of [checkNumbers, checkAlternatives, checkRange, checkAddress, checkLine]) {
  check();
  console.log(check.name);
}
