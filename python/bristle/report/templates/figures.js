// The figures: laid out for the page's width, enlarged in a dialog, saved as SVG.

const dialog = document.getElementById("enlarged"), drawings = document.querySelectorAll(".drawing");
const frame = document.querySelector("main"), WIDEST = 1008;  // pixels of a drawing that is not enlarged, in parts.css 63rem

// A drawing's two layouts, wide and narrow, with the points of their curves. They are decompressed when the drawing is first
// shown. Both have the same ids, so the document has one of them at a time.
async function unpack(drawing) {
  const { wide, narrow, curves } = JSON.parse(await inflate(drawing.dataset.layouts));
  const points = (places) => curves.map((curve, c) => ({ ...curve, points: curve.points.flatMap((values, i) => (
    places[c][i] ? [[...places[c][i], ...values]] : [])) })).filter((curve) => curve.points.length);
  drawing.layouts = { wide: { svg: wide.svg, points: points(wide.places) }, narrow: { svg: narrow.svg, points: points(narrow.places) } };
  put(drawing);
}

function put(drawing) {
  const layout = drawing.layouts?.[drawing.matches(".narrow") ? "narrow" : "wide"];
  if (!layout || drawing.shown === layout) return;
  layout.plot ??= element("template", { html: layout.svg }).content.firstElementChild;
  drawing.shown?.plot.remove();
  drawing.prepend(layout.plot);
  drawing.shown = layout;
  removePoints(drawing);
}

// However far away it is: a page is printed without being scrolled. A drawing within a closed part is not on the page yet.
const onPage = new IntersectionObserver((seen) => {
  for (const { target, isIntersecting } of seen) {
    if (!isIntersecting) continue;
    onPage.unobserve(target);
    target.ready();
  }
}, { rootMargin: "9999999px" });

function fit(drawing, narrow) {
  drawing.classList.toggle("narrow", narrow);  // makes room for it
  put(drawing);
}

// The wide layout where its letters can be read there.
const isNarrow = (drawing) => Math.min(frame.clientWidth - 66, WIDEST) < Number(drawing.dataset.least);

function fitAll(printed) {
  for (const drawing of drawings) if (!drawing.closest("dialog")) fit(drawing, !printed && isNarrow(drawing));
}

for (const drawing of drawings) {
  drawing.ready = () => (drawing.unpacking ??= unpack(drawing));
  onPage.observe(drawing);
}
addEventListener("resize", () => fitAll(false));
addEventListener("beforeprint", () => fitAll(true));
addEventListener("afterprint", () => fitAll(false));
fitAll(false);

// The drawing itself is moved: a copy would have the same ids. Enlarged it is the wide one.
function enlarge(drawing) {
  fit(drawing, false);
  const place = element("span");
  drawing.replaceWith(place);
  dialog.querySelector("b").textContent = drawing.dataset.label;
  dialog.querySelector(".whole").replaceChildren(drawing);
  dialog.addEventListener("close", () => {
    place.replaceWith(drawing);
    fit(drawing, isNarrow(drawing));
    drawing.closest("figure").querySelector(".enlarge").focus({ preventScroll: true });
  }, { once: true });
  dialog.showModal();
}

function saveSvg(drawing) {
  const svg = drawing.shown.plot.cloneNode(true);
  const [, , width, height] = svg.getAttribute("viewBox").split(" ");
  for (const [name, value] of Object.entries({ width: `${width}pt`, height: `${height}pt` })) svg.setAttribute(name, value);
  for (const name of ["class", "role"]) svg.removeAttribute(name);
  const letters = [...document.querySelectorAll("path[id^=letter-]")].filter((shape) => svg.querySelector(`use[*|href="#${shape.id}"]`));
  svg.querySelector("desc").after(element("defs", {}, ...letters.map((shape) => shape.cloneNode())),
    element("rect", { width: "100%", height: "100%", fill: "#fff" }));
  const ending = drawing.shown === drawing.layouts.narrow ? "-narrow" : "";
  save(`${drawing.dataset.name}${ending}.svg`, new XMLSerializer().serializeToString(svg), "image/svg+xml");
}

document.addEventListener("click", (event) => {
  const found = (selector) => event.target.closest(selector);
  const drawing = (found("figure, dialog") ?? document).querySelector(".drawing");
  if (found("button.enlarge") || (found(".drawing") && !found("dialog"))) enlarge(drawing);
  else if (found("button.save")) saveSvg(drawing);
  else if (found("button.close") || event.target === dialog) dialog.close();
});
