// The switch between the models of bending: figures and the explorer's map show one of them, or figures all.

function showReading(word) {
  const sections = [...document.querySelectorAll("main article, main section")].reverse();
  const seen = sections.find((found) => found.getBoundingClientRect().top < innerHeight / 3);
  const before = seen?.getBoundingClientRect().top;
  for (const found of document.querySelectorAll("[data-reading]"))
    found.hidden = word !== "" && found.dataset.reading !== word;
  const axis = chosen.data?.axes.findIndex(({ keys }) => keys.includes(word)) ?? -1;
  if (axis >= 0) {
    chosen.at[axis] = chosen.data.axes[axis].keys.indexOf(word);
    showSlices();
    showMap();
  }
  if (seen) scrollBy({ top: seen.getBoundingClientRect().top - before, behavior: "instant" });
}

function readingShown() {
  return document.querySelector("[name=reading]:checked")?.value ?? "";
}

document.querySelector("form.readings")?.addEventListener("change", () => showReading(readingShown()));
if (readingShown()) showReading(readingShown());  // kept by the browser when the page is loaded again
