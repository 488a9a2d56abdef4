"use strict";

// Elements, announcements, numbers in words, files to be saved.

// element("p", { class: "x", text: "..." }, children...): `text` is the content, the rest are attributes.
function element(name, attributes = {}, ...children) {
  const svg = ["svg", "g", "rect", "text", "circle", "path"].includes(name);
  const made = svg ? document.createElementNS("http://www.w3.org/2000/svg", name)
    : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "text") made.textContent = value;
    else made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

function say(words) {
  document.getElementById("said").textContent = words;
}

// A page opened from disk may have no access to the clipboard: then the selection is copied.
async function copy(source, what) {
  try {
    await navigator.clipboard.writeText(source.textContent);
  } catch {
    const selection = getSelection();
    selection.removeAllRanges();
    const range = document.createRange();
    range.selectNodeContents(source);
    selection.addRange(range);
    if (!document.execCommand("copy")) return say("It could not be copied; it is selected.");
    selection.removeAllRanges();
  }
  say(`${what}: copied.`);
  return true;
}

// Steps of the arrow keys in a grid: [rows, columns].
const STEPS = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] };

// To four digits; flags as words.
function shortly(value) {
  return typeof value === "string" ? value : value === null ? "no value"
    : `${Number(value.toPrecision(4))}`.replace("-", "−");
}

// The factor and the letter of the prefix with which a number is read: [0.001, "m"] of 0.0025.
function prefixOf(value) {
  const power = value ? Math.max(-3, Math.min(3, Math.floor(Math.log10(Math.abs(value)) / 3))) : 0;
  return [1000 ** power, ["n", "µ", "m", "", "k", "M", "G"][power + 3]];
}

// Two digits of the uncertainty, and the value to the same place.
function withError(value, error) {
  if (value === null) return ["–", ""];
  const minus = (words) => words.replace("-", "−");
  if (!(error > 0)) return [minus(`${Number(value.toPrecision(6))}`), error === 0 ? "0" : ""];
  const digits = Math.max(0, 1 - Math.floor(Math.log10(error)));
  if (digits > 8) return [minus(value.toPrecision(6)), minus(error.toPrecision(2))];
  return [minus(value.toFixed(digits)), minus(error.toFixed(digits))];
}

function save(name, text, type) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  element("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
  say(`${name} is saved.`);
}
