// The report's page: copying, printing, links to parts behind a click, and the assumptions matrix.

document.addEventListener("click", async (event) => {
  const button = event.target.closest("button.copy");
  if (!button) return;
  if (!(await copy(button.parentElement.querySelector("pre"), button.dataset.what))) return;
  button.textContent = "Copied";
  setTimeout(() => { button.textContent = "Copy"; }, 1500);
});

// A link to a part behind a click opens it; the lists of the contents close.
function openTarget() {
  const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const part = target && target.closest("details");
  if (!part || part.open) return;
  part.open = true;
  target.scrollIntoView();
}
addEventListener("hashchange", openTarget);
addEventListener("DOMContentLoaded", openTarget);
document.querySelector(".contents").addEventListener("click", (event) => {
  if (event.target.closest("a")) for (const list of document.querySelectorAll(".contents details")) list.open = false;
});

// The assumptions matrix: one tab stop, arrow keys within, the chosen cell's numbers below.
function startMatrix(table) {
  const rows = [...table.querySelectorAll("tbody tr")].map((row) => [...row.querySelectorAll("td")]);
  const details = document.getElementById("matrix-details");
  const numbers = inflate(JSON.parse(document.getElementById("matrix-numbers").textContent)).then(JSON.parse);
  let current = rows[0][0];
  table.setAttribute("role", "grid");
  for (const cell of rows.flat()) {
    cell.setAttribute("role", "gridcell");
    cell.tabIndex = cell === current ? 0 : -1;
  }
  async function choose(cell) {
    current.tabIndex = -1;
    current = cell;
    current.tabIndex = 0;
    current.focus({ preventScroll: false });
    details.textContent = (await numbers)[rows.flat().indexOf(cell)];
  }
  table.addEventListener("click", (event) => {
    const cell = event.target.closest("td");
    if (cell) choose(cell);
  });
  table.addEventListener("keydown", (event) => {
    const j = rows.findIndex((row) => row.includes(current)), i = rows[j].indexOf(current);
    if (event.key === "Enter" || event.key === " ") choose(current);
    else if (event.key in STEPS) choose(rows[j + STEPS[event.key][0]]?.[i + STEPS[event.key][1]] ?? current);
    else return;
    event.preventDefault();
  });
}

const assumptions = document.getElementById("matrix");
if (assumptions?.querySelector("tbody td")) startMatrix(assumptions);
