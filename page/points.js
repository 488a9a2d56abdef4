// Computes points in node. usage: node points.js ENGINE.wasm QUESTIONS.json >ANSWERS.json: a list of {experiment, point}; an
// answer also has the seconds that it took.
const { readFileSync, writeSync } = require("node:fs");
const { join } = require("node:path");

const makeEngine = Function(`${readFileSync(join(__dirname, "engine.js"))}; return makeEngine;`)();

async function main([engine, questions]) {
  const answer = await makeEngine(readFileSync(engine));
  const answers = JSON.parse(readFileSync(questions)).map((question) => {
    const before = performance.now(), found = answer(question);
    return { ...found, seconds: (performance.now() - before) / 1000 };
  });
  const text = Buffer.from(JSON.stringify(answers));
  for (let at = 0; at < text.length;) at += writeSync(1, text, at);
}

main(process.argv.slice(2));
