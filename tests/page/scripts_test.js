// The page's scripts without a browser: where the curve's line is broken.
// scripts_test.js ROOT
const assert = require("assert"), fs = require("fs"), path = require("path"), vm = require("vm");

// Functions of a script, by name.
function run(script, context, names) {
  vm.createContext(context);
  vm.runInContext(`${fs.readFileSync(path.join(process.argv[2], "page", script), "utf8")}; this.found = { ${names} };`, context);
  return context.found;
}

function checkLine() {
  const { joined } = run("chart.js", {}, ["joined"]);
  const runs = (phases) => joined(phases.map((phase, x) => ({ x, phase }))).map((run) => run.map(({ x }) => x));
  assert.deepEqual(runs(["bouncing", "bouncing", "contact", "contact"]), [[0, 1], [2, 3]]);
  assert.deepEqual(runs(["contact", "bouncing", "contact", "contact"]), [[2, 3]]);
  assert.deepEqual(runs(["contact", "mixed", "bouncing", "unknown"]), [[0, 1, 2, 3]]);
  assert.deepEqual(runs([]), []);
}

for (const check of [checkLine]) {
  check();
  console.log(check.name);
}
