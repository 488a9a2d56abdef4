// The points of a drawing's curves: their values, by pointer and by keyboard.

// The values of a curve's point, in words.
function valuesOf(curve, [, , x, y, error, status]) {
  const [value, uncertain] = withError(y, error);
  const lines = [`${curve.along} = ${shortly(x)}`, `${curve.title} = ${value}${uncertain && ` ± ${uncertain}`}`, status && `status: ${status}`];
  return lines.filter(Boolean).join("\n");
}

// Adds a layer over a drawing: the point nearest to the pointer, or chosen by the arrow keys, with its values. Returns what removes it.
function addPoints(drawing) {
  const stop = new AbortController(), { signal } = stop;
  const { plot, points: curves } = drawing.shown, { width, height } = plot.viewBox.baseVal;
  const mark = element("circle", { r: 6, class: "mark" }), tip = element("div", { class: "tip" });
  const layer = element("svg", { viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true" }, mark);
  const all = curves.flatMap((curve, c) => curve.points.map((point, i) => ({ curve, point, c, i })));
  let current = null;
  function show(found) {
    current = found;
    drawing.dispatchEvent(new CustomEvent("pointed", { detail: found }));
    drawing.classList.toggle("pointed", found !== null);
    if (!found) return;
    const [x, y] = found.point;
    mark.setAttribute("cx", x);
    mark.setAttribute("cy", y);
    tip.textContent = valuesOf(found.curve, found.point);
    tip.style.cssText = `${x < width / 2 ? "left" : "right"}:${100 * (x < width / 2 ? x : width - x) / width}%;` +
      `${y < height / 2 ? "top" : "bottom"}:${100 * (y < height / 2 ? y : height - y) / height}%`;
  }
  drawing.addEventListener("pointermove", (event) => {
    const box = drawing.getBoundingClientRect(), scale = width / box.width;
    const [x, y] = [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
    const off = ({ point }) => Math.hypot(point[0] - x, point[1] - y);
    const best = all.reduce((a, b) => (off(b) < off(a) ? b : a));
    show(off(best) < 24 * scale ? best : null);
  }, { signal });
  drawing.addEventListener("pointerleave", () => show(null), { signal });
  drawing.addEventListener("blur", () => show(null), { signal });
  drawing.addEventListener("keydown", (event) => {
    if (!(event.key in STEPS)) return;
    const [down, right] = STEPS[event.key];
    const c = current ? (current.c + down + curves.length) % curves.length : 0;
    const i = current ? Math.max(0, Math.min(curves[c].points.length - 1, current.i + right)) : 0;
    show(all.find((point) => point.c === c && point.i === i));
    say(tip.textContent);
    event.preventDefault();
  }, { signal });
  signal.addEventListener("abort", () => { show(null); layer.remove(); tip.remove(); });
  drawing.append(layer, tip);
  return stop;
}

// The points are made when a pointer or the keyboard reaches the drawing, and again if it is drawn anew.
function startPoints(drawing) {
  drawing.stop ??= addPoints(drawing);
}

function renewPoints(drawing) {
  if (!drawing.stop) return;
  drawing.stop.abort();
  drawing.stop = addPoints(drawing);
}
