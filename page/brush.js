// The page: the brush at once, its curve, the bristles of the chosen point, and the buttons.

const STATUSES = {
  load_jump: "The gap jumps across this load; the numbers hold behind the jump.", unreachable: "No gap carries this load.",
  incomplete: "A bristle did not reach the trailing edge; there are no numbers.", not_converged: "The error is above the requested one.",
  work_limit: "The point needs more steps than its limit allows; there are no numbers.", failed: "The model has no numbers here.",
  ambiguous: "Within the errors, another gap may carry this load first.", inaccurate: "The energy budget does not close.",
  undefined: "Some numbers are ratios to a load or friction of zero.",
};
const THREE = { record: ["observables", "trajectories"], trajectories: { theta_0_deg: [60, 110, 150] } };
const LIMITS = JSON.parse(document.getElementById("limits").textContent);  // by flag, in words
const part = (id) => document.getElementById(id);
const state = { asked: 0, curve: null, curveNumber: 0, player: null, chosen: null, brush: null };
let first, others;

const units = (about) => (about.units && about.units !== "1" ? ` (${about.units.replaceAll(" ", "·").replace(/-(\d)/g, "⁻$1").replace(/⁻1/g, "⁻¹").replace(/⁻2/g, "⁻²")})` : "");
const number = ([value, error] = [null, null], unit = "") => {
  const [words, uncertain] = withError(value, error);
  return value === null ? "–" : `${words}${uncertain && uncertain !== "0" ? ` ± ${uncertain}` : ""}${unit && ` ${unit}`}`;
};

// A small or large quantity with a prefix of its unit: 2.5 mN.
function prefixed([value, error], unit) {
  const [factor, letter] = prefixOf(value);
  return number(value === null ? undefined : [value / factor, error / factor], `${letter}${unit}`);
}

function row(label, value, remark = "") {
  return element("div", { class: "fact" }, element("dt", { text: label }), element("dd", {}, element("b", { text: value }),
    ...(remark ? [element("small", { text: remark })] : [])));
}

// The numbers of one point: phase, friction, lift-off, limits.
function showFacts(answer) {
  const { values, phase, status } = answer, si = "R_x_in_N" in (values ?? {});
  const box = part("facts");
  if (!values) {
    box.replaceChildren(element("p", { class: "phase unknown", text: "no numbers" }), element("p", { text: `${STATUSES[status] ?? status} ${answer.failure ?? ""}` }));
    part("three").hidden = true;  // it shows another brush
    return;
  }
  const why = answer.carried ? `No gap carries this load: ${answer.carried}.` : STATUSES[status] ?? status;
  const off = values.off_slab_share[0], unknown = answer.lift_off_unknown;
  const words = { contact: "in contact", bouncing: "bouncing", mixed: "mixed", unknown: "no numbers" }[phase];
  const rigid = values.R_x[0] / values.R_x_norm[0] / values.R_n[0];
  const facts = [row("Friction coefficient", number(values.friction_coefficient), Number.isFinite(rigid) ? `rigid bristles: ${shortly(rigid)}` : "")];
  if (si) facts.push(row("Friction per bristle", prefixed(values.R_x_in_N, "N")));
  if (unknown) facts.push(row("Lift-off load", "unknown", answer.lift_off_unknown));
  else facts.push(row("Lift-off load", si ? prefixed(values.lift_off_load_in_N, "N") : number(values.lift_off_load), "of point masses: above it tips stay on the slab"));
  facts.push(row("Gap under the slab", number(values.z_0, "r₀")));
  box.replaceChildren(element("p", { class: `phase ${phase}`, text: words }),
    element("p", { class: "what", text: off === null ? why : `Tips are off the slab for ${Math.round(100 * off)} % of the time.` }),
    element("dl", {}, ...facts));
  if (status !== "ok" && off !== null) box.append(element("p", { class: "remark", text: why }));
  if (answer.exceeded.length) box.append(element("div", { class: "remark limits" }, element("b", { text: "Limits of the model exceeded" }),
    element("ul", {}, ...answer.exceeded.map((flag) => element("li", { text: LIMITS[flag] ?? flag })))));
}

function showPassages(passages, words) {
  if (!passages?.length) return;
  part("three").hidden = false;
  const box = part("three");
  box.dataset.length = passages[0].L_x;
  const ready = passages.map((passage) => ({ ...passage, first: 0, last: passage.xi.length - 1, end: passage.xi.at(-1) }));
  if (state.player) state.player(ready);
  else state.player = startPlayer(box, ready);
  part("three-at").textContent = words;
}

// Checks and computes the brush of the form; newer input replaces what waits. The curve then belongs to another brush.
let pending = 0;
function changed() {
  clearTimeout(pending);
  part("results").classList.toggle("stale", Boolean(state.curve));
  pending = setTimeout(computeBrush, 120);
}

// Describes the experiment, or says in its member `error` what is wrong in the form. pool: whose worker describes it.
async function describe(pool, experiment, withCurve) {
  const error = mistake(withCurve);
  return error ? { error } : pool.ask({ experiment });
}

async function computeBrush() {
  const asked = ++state.asked, experiment = experimentOf(false);
  if (first.busy() && performance.now() - (state.since ?? 0) > 2000) first.stop();
  first.forget();
  part("now").setAttribute("aria-busy", "true");
  const about = await describe(first, experiment, false);
  if (asked !== state.asked || !about) return;
  if (about.error) {
    showError(about.error);
    part("now").setAttribute("aria-busy", "false");
    part("now").classList.add("stale");
    if (!state.brush) part("facts").replaceChildren(element("p", { text: "The form has a mistake: see the message beside its field." }));
    return;
  }
  showError("");
  showQuantities(about.variables);
  part("warnings").textContent = about.warnings.join(" ");
  state.since = performance.now();
  const answer = await first.ask({ experiment: { ...experiment, ...THREE }, point: 0 });
  if (asked !== state.asked || !answer) return;
  part("now").setAttribute("aria-busy", "false");
  part("now").classList.remove("stale");
  if (answer.error) return showError(answer.error);
  state.brush = answer;
  part("took").textContent = `Computed in ${((performance.now() - state.since) / 1000).toFixed(2)} s.`;
  showFacts(answer);
  if (state.chosen === null) showPassages(answer.passages, "of the brush");
}

function showQuantities(variables) {
  const select = form.elements.quantity, before = select.value, wanted = JSON.parse(select.dataset.first);
  const found = [...wanted.map((name) => variables.find((one) => one.name === name)).filter(Boolean), ...variables.filter(({ name }) => !wanted.includes(name))];
  if (select.dataset.shown !== (select.dataset.shown = found.map(({ name }) => name).join()))
    select.replaceChildren(...found.map((one) => element("option", { value: one.name, text: `${one.meaning}${units(one)}` })));
  select.value = [before, select.dataset.shared, found[0].name].find((name) => found.some((one) => one.name === name));
}

// Both ends, the middle, and then the middle of each gap, so that the curve is seen before it is complete.
function coarseFirst(count) {
  const order = [0, count - 1].slice(0, count);
  for (let step = count - 1; step > 1;) {
    step = Math.ceil(step / 2);
    for (let i = 0; i < count; i += step) if (!order.includes(i)) order.push(i);
  }
  return order;
}

// More points take hours in a browser.
const MOST_POINTS = 500;

async function computeCurve() {
  stopCurve();
  const experiment = experimentOf(true), about = await describe(others, experiment, true), mine = ++state.curveNumber;
  if (!about) return;
  showError(about.error ?? "");
  if (about.error) return;
  const [axis] = about.axes, over = form.elements.over;
  if (axis.values.length > MOST_POINTS) return showError(`/sweep/${axis.name}/points/2: a curve has at most ${MOST_POINTS} points; save the experiment and run it by the program`);
  state.chosen = null;
  state.curve = { experiment, about, values: axis.values, answers: [], axis: over.selectedOptions[0].textContent, unit: fieldOf(over.value).dataset.unit, name: axis.name, begun: performance.now() };
  part("results").classList.remove("stale");
  part("stop").disabled = false;
  showCurve();
  await Promise.all(coarseFirst(axis.values.length).map(async (index) => {
    const answer = await others.ask({ experiment: { ...experiment, ...THREE }, point: index });
    if (mine !== state.curveNumber || !answer) return;
    state.curve.answers[index] = answer;
    showCurve();
  }));
  if (mine !== state.curveNumber) return;
  part("stop").disabled = true;
  say("The curve is complete.");
}

function stopCurve() {
  if (!others.busy()) return;
  ++state.curveNumber;
  others.stop();
  part("stop").disabled = true;
  if (state.curve) showCurve(`stopped at ${state.curve.answers.filter(Boolean).length} of ${state.curve.values.length} points`);
}

// The lift-off load of the brush, if it is on the axis.
function markOf(curve) {
  const name = { R_n_N: "lift_off_load_in_N", R_n: "lift_off_load" }[curve.name];
  const found = curve.answers.find((answer) => answer?.values?.[name]?.[0] != null)?.values[name];
  return found && { x: found[0], error: found[1], text: "lift-off" };
}

function showCurve(words) {
  const { curve } = state;
  if (!curve) return;
  const name = form.elements.quantity.value, about = curve.about.variables.find((one) => one.name === name);
  if (!about) return;
  const points = curve.values.map((x, index) => ({ x, index, answer: curve.answers[index] })).filter(({ answer }) => answer)
    .map(({ x, index, answer }) => ({ x, index, y: answer.values?.[name]?.[0] ?? null, error: answer.values?.[name]?.[1] ?? 0, phase: answer.phase ?? "unknown", status: answer.error ?? answer.status }));
  const span = [curve.values[0], curve.values.at(-1)];
  drawChart(part("chart"), { points, axis: curve.axis, quantity: `${about.meaning}${units(about)}`, log: span[0] > 0 && form.elements.spacing.value === "logspace", xs: span, mark: markOf(curve), chosen: state.chosen });
  const lost = points.filter(({ y }) => y === null), why = [...new Set(lost.map(({ status }) => STATUSES[status] ?? ""))].join(" ");
  part("progress").textContent = words ?? `${points.length} of ${curve.values.length} points in ${((performance.now() - curve.begun) / 1000).toFixed(1)} s` + (lost.length ? `; ${lost.length} without this number. ${why}` : "");
}

function csvOfCurve({ about, answers, values, name }) {
  const quoted = (words) => `"${String(words).replaceAll('"', '""')}"`;
  const lines = ["# computed in a browser: the numbers agree with those of `bristle run` within their errors, and not in every bit",
    ...about.variables.map((one) => `# ${one.name}: ${one.meaning}${units(one)}`),
    [name, "status", "phase", ...about.variables.flatMap((one) => [one.name, `${one.name}_err`])].join(",")];
  values.forEach((x, i) => {
    if (answers[i]) lines.push([x, answers[i].status ?? quoted(answers[i].error), answers[i].phase ?? "", ...about.variables.flatMap((one) => (answers[i].values?.[one.name] ?? [null, null]).map((value) => value ?? ""))].join(","));
  });
  return `${lines.join("\n")}\n`;
}

// Whether the program takes the experiment of the fields; what it refuses is shown.
async function isValid() {
  const about = await describe(first, experimentOf(true), true);
  if (about?.error) say("Correct the fields first.");
  showError(about?.error ?? "");
  return Boolean(about) && !about.error;
}

async function saveExperiment() {
  if (!(await isValid())) return;
  save(`${presetName()}.json`, `${JSON.stringify({ ...experimentOf(true), name: presetName() }, null, 1)}\n`, "application/json");
}

function saveNumbers() {
  if (!state.curve || part("results").classList.contains("stale")) say("Compute the curve of this brush first.");
  else save(`${presetName()}.csv`, csvOfCurve(state.curve), "text/csv");
}

async function share() {
  if (!(await isValid())) return;
  history.replaceState(null, "", fragmentOf());
  part("address").textContent = location.href;
  part("address").hidden = false;
  await copy(part("address"), "The address");
}

const BUTTONS = {
  curve: computeCurve, stop: stopCurve, share,
  experiment: saveExperiment, numbers: saveNumbers,
};

async function start() {
  const bytes = Uint8Array.from(atob(part("engine").textContent), (letter) => letter.charCodeAt(0));
  const engine = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  const source = part("worker").textContent;
  first = makePool(1, source, engine);
  others = makePool(Math.max(1, Math.min(4, (navigator.hardwareConcurrency ?? 2) - 1)), source, engine);
  form.elements.preset.addEventListener("change", async () => { showPreset(presetName()); await computeBrush(); await computeCurve(); });
  form.elements.over.addEventListener("change", showRange);
  for (const name of ["from", "to"]) form.elements[name].addEventListener("input", () => { form.dataset.range = "typed"; });
  form.elements.quantity.addEventListener("change", () => showCurve());
  form.addEventListener("input", ({ target }) => {
    const { name } = target.closest(".field").querySelector("[name]");  // also of a slider beside it
    if (name === "/model/friction") showLaw();
    if (name === form.elements.over.value && form.dataset.range === "follows") showRange();
    if (target.closest("[data-kind]")) changed();
  });
  form.addEventListener("submit", (event) => { event.preventDefault(); computeCurve(); });
  for (const [name, act] of Object.entries(BUTTONS)) if (name !== "curve") part(name).addEventListener("click", act);
  const chart = part("chart");
  for (const name of ["pointerenter", "focus"]) chart.addEventListener(name, () => chart.shown && startPoints(chart));
  chart.addEventListener("pointed", ({ detail }) => {
    if (!detail) return;
    const index = chart.shown.indices[detail.i], { curve } = state;
    if (state.chosen === index) return;
    state.chosen = index;
    for (const circle of chart.querySelectorAll("circle[data-index]")) circle.classList.toggle("chosen", Number(circle.dataset.index) === index);
    showPassages(curve.answers[index].passages, `at ${shortly(curve.values[index])} ${curve.unit}`);
  });
  new ResizeObserver(() => state.curve && showCurve(part("progress").textContent)).observe(chart);
  addEventListener("hashchange", () => { showFragment(location.hash); changed(); });
  if (matchMedia("(max-width: 40rem)").matches) for (const group of form.querySelectorAll(".group")) group.open = false;
  showFragment(location.hash);
  form.elements.quantity.dataset.shared = new URLSearchParams(location.hash.slice(1)).get("quantity") ?? "";
  startAgain(others);
  form.dataset.ready = "true";
  await computeBrush();
  await computeCurve();
}

start().catch((error) => {  // a browser without what the page needs
  part("facts").replaceChildren(element("p", { class: "wrong", text: `This browser cannot compute a brush: ${error.message}` }));
});
