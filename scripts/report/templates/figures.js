// The figures: enlarged in a dialog, saved as SVG, and the values of the points of their curves.

const dialog = document.getElementById("enlarged");

// The drawing itself is moved: a copy would have the same ids.
function enlarge(drawing) {
  const place = element("span");
  drawing.replaceWith(place);
  dialog.querySelector("b").textContent = drawing.dataset.label;
  dialog.querySelector(".whole").replaceChildren(drawing);
  dialog.addEventListener("close", () => {
    place.replaceWith(drawing);
    drawing.closest("figure").querySelector(".enlarge").focus({ preventScroll: true });
  }, { once: true });
  dialog.showModal();
}

function saveSvg(drawing) {
  const svg = drawing.querySelector("svg.plot").cloneNode(true);
  const [, , width, height] = svg.getAttribute("viewBox").split(" ");
  for (const [name, value] of Object.entries({ width: `${width}pt`, height: `${height}pt` })) svg.setAttribute(name, value);
  for (const name of ["class", "role"]) svg.removeAttribute(name);
  svg.querySelector("desc").after(element("rect", { width: "100%", height: "100%", fill: "#fff" }));
  save(`${drawing.dataset.name}.svg`, new XMLSerializer().serializeToString(svg), "image/svg+xml");
}

document.addEventListener("click", (event) => {
  const found = (selector) => event.target.closest(selector);
  const drawing = (found("figure, dialog") ?? document).querySelector(".drawing");
  if (found("button.enlarge") || (found(".drawing") && !found("dialog"))) enlarge(drawing);
  else if (found("button.save")) saveSvg(drawing);
  else if (found("button.close") || event.target === dialog) dialog.close();
});

// The values of a curve's point, in words.
function valuesOf(curve, [, , x, y, error, status]) {
  const [value, uncertain] = withError(y, error);
  const lines = [`${curve.along} = ${shortly(x)}`,
    `${curve.title} = ${value}${uncertain && ` ± ${uncertain}`}`, curve.chosen, status && `status: ${status}`];
  return lines.filter(Boolean).join("<br>");
}

// A layer over a drawing: the point nearest to the pointer, or chosen by the arrow keys, with its values.
async function addPoints(drawing) {
  const curves = JSON.parse(await inflate(drawing.dataset.points));
  const { width, height } = drawing.querySelector("svg.plot").viewBox.baseVal;
  const mark = element("circle", { r: 6, class: "mark" }), tip = element("div", { class: "tip" });
  const layer = element("svg", { viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true" }, mark);
  const all = curves.flatMap((curve, c) => curve.points.map((point, i) => ({ curve, point, c, i })));
  let current = null;
  function show(found) {
    current = found;
    drawing.classList.toggle("pointed", found !== null);
    if (!found) return;
    const [x, y] = found.point;
    mark.setAttribute("cx", x);
    mark.setAttribute("cy", y);
    tip.innerHTML = valuesOf(found.curve, found.point);
    tip.style.cssText = `${x < width / 2 ? "left" : "right"}:${100 * (x < width / 2 ? x : width - x) / width}%;` +
      `${y < height / 2 ? "top" : "bottom"}:${100 * (y < height / 2 ? y : height - y) / height}%`;
  }
  drawing.addEventListener("pointermove", (event) => {
    const box = layer.getBoundingClientRect(), scale = width / box.width;
    const [x, y] = [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
    const off = ({ point }) => Math.hypot(point[0] - x, point[1] - y);
    const best = all.reduce((a, b) => (off(b) < off(a) ? b : a));
    show(off(best) < 24 * scale ? best : null);
  });
  drawing.addEventListener("pointerleave", () => show(null));
  drawing.addEventListener("blur", () => show(null));
  drawing.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && !drawing.closest("dialog")) enlarge(drawing);
    if (!(event.key in STEPS)) return;
    const [down, right] = STEPS[event.key];
    const c = current ? (current.c + down + curves.length) % curves.length : 0;
    const i = current ? Math.max(0, Math.min(curves[c].points.length - 1, current.i + right)) : 0;
    show(all.find((point) => point.c === c && point.i === i));
    say(tip.innerText);
    event.preventDefault();
  });
  drawing.append(layer, tip);
}

// The points are made when a pointer or the keyboard first reaches the drawing.
for (const drawing of document.querySelectorAll(".drawing[data-points]")) {
  for (const [name, value] of Object.entries({ tabindex: 0, role: "application",
    "aria-label": `${drawing.dataset.label}: the arrow keys read the points of its curves, Enter enlarges it` }))
    drawing.setAttribute(name, value);
  const start = () => { drawing.ready ??= addPoints(drawing); };
  drawing.addEventListener("pointerenter", start);
  drawing.addEventListener("focus", start);
}
