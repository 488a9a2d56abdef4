// The numbers of the figures: columns, compressed, read when they are needed.

// The lines before the columns, and the columns by name, as words; an empty cell is null.
async function columnsOf(name) {
  const [head, columns] = (await inflate(JSON.parse(document.getElementById(`columns-${name}`).textContent))).split("\n\n");
  return { head, columns: Object.fromEntries(columns.split("\n").map((line) => {
    const [title, ...words] = line.split(",");
    return [title, words.map((word) => word || null)];
  })) };
}

document.addEventListener("click", async (event) => {
  const { name } = event.target.closest("button.data")?.dataset ?? {};
  if (!name) return;
  const { head, columns } = await columnsOf(name), titles = Object.keys(columns);
  const rows = columns[titles[0]].map((_, row) => titles.map((title) => columns[title][row] ?? "").join(","));
  save(`${name}.csv`, `${[head, titles.join(","), ...rows].join("\n")}\n`, "text/csv");
});

const numbersOf = (words) => words.map((word) => (word === null ? null : Number(word)));

// The values of every point of the sweep; rows: the row of the CSV for each point.
function fill(data, columns, rows) {
  const words = (name) => rows.map((row) => (row === undefined ? null : columns[name][row]));
  const codes = (name, meanings, missing) => words(name).map((word) => (
    word === null ? missing : meanings.indexOf(word.replaceAll("_", " "))));
  data.status = { words: data.status, codes: codes("status", data.status, data.status.indexOf("absent")) };
  for (const variable of data.variables) {
    if (variable.words) variable.codes = codes(variable.name, variable.words, 0);
    else variable.values = numbersOf(words(variable.name));
    if (`${variable.name}_err` in columns) variable.errors = numbersOf(words(`${variable.name}_err`));
  }
  return data;
}

const results = {};

// The result of a figure: axes and variables with the values of all points.
async function read(name) {
  if (results[name]) return results[name];
  const data = JSON.parse(await inflate(JSON.parse(document.getElementById(`points-${name}`).textContent)));
  const { columns } = await columnsOf(name);
  const key = (values) => values.join(" ");
  const rows = new Map(columns.status.map((_, row) => [key(data.axes.map((axis) => (
    axis.words ? columns[axis.name][row] : Number(columns[axis.name][row])))), row]));
  const count = data.axes.reduce((product, axis) => product * axis.keys.length, 1);
  const places = [...Array(count).keys()].map((point) => rows.get(key(
    positionOf(data, point).map((i, d) => data.axes[d].keys[i]))));
  return results[name] = fill(data, columns, places);
}
