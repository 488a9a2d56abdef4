// The figures: laid out for the page's width, enlarged in a dialog, saved as SVG.

const dialog = document.getElementById("enlarged"), drawings = document.querySelectorAll(".drawing");
const frame = document.querySelector("main");

// Shows one of a drawing's two layouts: they have the same ids, so the other one is not in the document.
function put(drawing, layout) {
  if (drawing.shown === layout) return;
  drawing.shown.svg.replaceWith(layout.svg);
  drawing.shown = layout;
  removePoints(drawing);
}

// The narrow layout is decompressed when the drawing comes near the window.
async function unpack(drawing) {
  const { svg, points } = JSON.parse(await inflate(drawing.dataset.narrow));
  drawing.narrow ??= { svg: element("template", { html: svg }).content.firstElementChild, points };
  if (drawing.classList.contains("narrow")) put(drawing, drawing.narrow);
}

const near = new IntersectionObserver((seen) => {
  for (const { target, isIntersecting } of seen) {
    if (!isIntersecting) continue;
    near.unobserve(target);
    unpack(target);
  }
}, { rootMargin: "100%" });

function fit(drawing, narrow) {
  drawing.classList.toggle("narrow", narrow);  // makes room for it
  near.unobserve(drawing);
  if (!narrow) put(drawing, drawing.wide);
  else if (drawing.narrow) put(drawing, drawing.narrow);
  else near.observe(drawing);
}

// The wide layout where its letters can be read there.
const isNarrow = (drawing) => frame.clientWidth - 66 < Number(drawing.dataset.least);

function fitAll(printed) {
  for (const drawing of drawings) if (!drawing.closest("dialog")) fit(drawing, !printed && isNarrow(drawing));
}

for (const drawing of drawings) drawing.wide = drawing.shown = { svg: drawing.querySelector("svg.plot") };
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
  const svg = drawing.shown.svg.cloneNode(true);
  const [, , width, height] = svg.getAttribute("viewBox").split(" ");
  for (const [name, value] of Object.entries({ width: `${width}pt`, height: `${height}pt` })) svg.setAttribute(name, value);
  for (const name of ["class", "role"]) svg.removeAttribute(name);
  svg.querySelector("desc").after(element("rect", { width: "100%", height: "100%", fill: "#fff" }));
  const ending = drawing.shown === drawing.narrow ? "-narrow" : "";
  save(`${drawing.dataset.name}${ending}.svg`, new XMLSerializer().serializeToString(svg), "image/svg+xml");
}

document.addEventListener("click", (event) => {
  const found = (selector) => event.target.closest(selector);
  const drawing = (found("figure, dialog") ?? document).querySelector(".drawing");
  if (found("button.enlarge") || (found(".drawing") && !found("dialog"))) enlarge(drawing);
  else if (found("button.save")) saveSvg(drawing);
  else if (found("button.close") || event.target === dialog) dialog.close();
});
