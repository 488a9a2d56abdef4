// A point of Figure 4 computed again: the program's number, the page's, and their distance in units of the program's error.

function startAgain(pool) {
  const stored = JSON.parse(document.getElementById("stored").textContent), box = document.getElementById("again");
  const select = box.querySelector("select"), button = box.querySelector("button"), body = box.querySelector("tbody"), said = box.querySelector(".outcome");
  select.append(...stored.points.map((point, i) => element("option", { value: i, text: point.place })));
  function show(values) {
    const { numbers } = stored.points[select.value];
    body.replaceChildren(...Object.entries(numbers).map(([name, [value, error]]) => {
      const mine = values?.[name], far = mine && Math.abs(mine[0] - value) / error;
      return element("tr", {}, element("th", { scope: "row", text: stored.meanings[name] }, element("code", { text: name })),
        element("td", { text: withError(value, error).join(" ± ") }), element("td", { text: mine ? withError(...mine).join(" ± ") : "" }),
        element("td", { text: mine ? far.toPrecision(2) : "" }));
    }));
  }
  select.addEventListener("change", () => { show(); said.textContent = ""; });
  button.addEventListener("click", async () => {
    button.disabled = true;
    said.textContent = "computing …";
    const index = stored.points[select.value].index, before = performance.now();
    const answer = await pool.ask({ experiment: stored.experiment, point: index });
    button.disabled = false;
    if (!answer?.values) { said.textContent = answer ? answer.error ?? STATUSES[answer.status] ?? answer.status : "stopped"; return; }
    show(answer.values);
    const far = Object.entries(stored.points[select.value].numbers).map(([name, [value, error]]) => Math.abs(answer.values[name][0] - value) / error);
    said.textContent = `Computed in ${((performance.now() - before) / 1000).toFixed(1)} s. The largest distance is ${Math.max(...far).toPrecision(2)} errors.`;
    say(said.textContent);
  });
  show();
}
