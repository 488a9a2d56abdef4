// Numbers in the page: gzip files in base64, decompressed when they are needed.

const csvOf = (link) => inflate(link.href.split(",")[1]);

document.addEventListener("click", async (event) => {
  const link = event.target.closest("a.data");
  if (!link) return;
  event.preventDefault();  // without JavaScript the link saves the gzip file
  save(link.textContent, await csvOf(link), "text/csv");
});

// Columns of a CSV by name, as words; an empty cell is null.
function columnsOf(csv) {
  const rows = csv.split("\n").filter((line) => line && !line.startsWith("#")).map((line) => line.split(","));
  const cells = rows.slice(1);
  return Object.fromEntries(rows[0].map((name, i) => [name, cells.map((row) => row[i] || null)]));
}

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
  const columns = columnsOf(await csvOf(document.querySelector(`a.data[download="${name}.csv.gz"]`)));
  const key = (values) => values.join(" ");
  const rows = new Map(columns.status.map((_, row) => [key(data.axes.map((axis) => (
    axis.words ? columns[axis.name][row] : Number(columns[axis.name][row])))), row]));
  const count = data.axes.reduce((product, axis) => product * axis.keys.length, 1);
  const places = [...Array(count).keys()].map((point) => rows.get(key(
    positionOf(data, point).map((i, d) => data.axes[d].keys[i]))));
  return results[name] = fill(data, columns, places);
}
