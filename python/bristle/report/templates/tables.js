// Tables with class "sortable": a button in each header sorts, a form with data-table filters by words.

function sortKey(row, column) {
  const cell = row.cells[column];
  const value = cell.dataset.value;
  return value === undefined ? cell.textContent.trim() : value === "" ? NaN : Number(value);
}

// Numbers by value, missing ones last; texts in natural order.
function compare(a, b) {
  if (typeof a === "number" && typeof b === "number") return isNaN(a) - isNaN(b) || a - b;
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

function sortBy(table, column) {
  const header = table.tHead.rows[0].cells[column];
  const up = header.getAttribute("aria-sort") !== "ascending";
  for (const cell of table.tHead.rows[0].cells) cell.setAttribute("aria-sort", "none");
  header.setAttribute("aria-sort", up ? "ascending" : "descending");
  const keyed = [...table.tBodies[0].rows].map((row) => [sortKey(row, column), row]);
  const empty = (key) => typeof key === "number" && isNaN(key);
  keyed.sort(([a], [b]) => (empty(a) || empty(b) || up ? compare(a, b) : compare(b, a)));
  table.tBodies[0].append(...keyed.map(([, row]) => row));
  say(`Sorted by ${header.textContent.trim()}, ${up ? "ascending" : "descending"}.`);
}

// Puts the buttons into the headers.
function makeSortable(table) {
  [...table.tHead.rows[0].cells].forEach((header, column) => {
    const button = element("button", { type: "button" }, ...header.childNodes);
    button.addEventListener("click", () => sortBy(table, column));
    header.append(button);
    header.setAttribute("aria-sort", "none");
  });
}

function filter(form) {
  const rows = [...document.getElementById(form.dataset.table).tBodies[0].rows];
  const words = form.elements.words.value.toLowerCase().split(/\s+/).filter(Boolean);
  let shown = 0;
  for (const row of rows) {
    const content = row.textContent.toLowerCase();
    row.hidden = !words.every((word) => content.includes(word));
    shown += !row.hidden;
  }
  form.querySelector(".shown").textContent = `${shown} of ${rows.length} shown`;
}

for (const form of document.querySelectorAll("form.filters")) {
  form.addEventListener("input", () => filter(form));
  form.addEventListener("submit", (event) => event.preventDefault());
}
