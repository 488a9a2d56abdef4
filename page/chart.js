// The curve: points over the axis, with errors, coloured by phase.

const ROOM = { left: 62, right: 14, top: 14, bottom: 44 };

// About `count` round numbers from low to high, as a scale of logarithms or an even one has them.
function roundNumbers(low, high, log, count) {
  if (log) {
    const decades = [];
    for (let n = Math.floor(Math.log10(low)) - 1; n <= Math.ceil(Math.log10(high)); ++n)
      for (const first of high / low > 30 ? [1, 3] : high / low > 8 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 7]) decades.push(first * 10 ** n);
    return decades.filter((x) => x >= low * 0.999 && x <= high * 1.001);
  }
  const raw = (high - low) / count, unit = 10 ** Math.floor(Math.log10(raw));
  const step = unit * [1, 2, 5, 10].find((n) => n * unit >= raw);
  return [...Array(Math.floor(high / step + 1e-9) - Math.ceil(low / step - 1e-9) + 1).keys()].map((i) => (Math.ceil(low / step - 1e-9) + i) * step);
}

// The points in runs that a line may join: it is broken between contact and bouncing.
function joined(points) {
  const runs = [];
  points.forEach((point, i) => {
    const phases = [points[i - 1]?.phase, point.phase];
    if (!runs.length || (phases.includes("contact") && phases.includes("bouncing"))) runs.push([]);
    runs.at(-1).push(point);
  });
  return runs.filter((run) => run.length > 1);
}

function scaleOf(low, high, log, from, to) {
  const f = log ? Math.log : (x) => x;
  return (x) => from + (to - from) * (f(x) - f(low)) / (f(high) - f(low));
}

// Draws points, [{ x, y, error, phase, status, index }], whose y is null without a number, over the range xs of the axis, which
// may be logarithmic; a mark, { x, error, text }, across; and the chosen point larger.
function drawChart(box, { points, axis, quantity, log, xs, mark, chosen }) {
  const width = Math.max(280, box.clientWidth), height = Math.min(420, Math.max(260, 0.62 * width));
  const good = points.filter(({ y }) => y !== null), lows = good.map(({ y, error }) => y - (error ?? 0)), highs = good.map(({ y, error }) => y + (error ?? 0));
  let [low, high] = good.length ? [Math.min(...lows), Math.max(...highs)] : [0, 1];
  if (low > 0 && low < 0.6 * high) low = 0;
  const room = high > low ? 0.06 * (high - low) : Math.abs(high) || 1;
  [low, high] = [low === 0 ? 0 : low - room, high + room];
  const beside = log ? (xs[1] / xs[0]) ** 0.03 : 0.03 * (xs[1] - xs[0]);  // room beside the first and the last point
  xs = log ? [xs[0] / beside, xs[1] * beside] : [xs[0] - beside, xs[1] + beside];
  const X = scaleOf(xs[0], xs[1], log, ROOM.left, width - ROOM.right), Y = scaleOf(low, high, false, height - ROOM.bottom, ROOM.top);
  const svg = element("svg", { class: "plot chart", viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${quantity} over ${axis}, ${good.length} points` });
  const line = (d, name) => svg.appendChild(element("path", { class: name, d }));
  const text = (x, y, words, more = {}) => svg.appendChild(element("text", { x, y, text: words, ...more }));
  let d = "";
  for (const y of roundNumbers(low, high, false, 8)) {
    d += `M${ROOM.left} ${Y(y).toFixed(1)}H${width - ROOM.right}`;
    text(ROOM.left - 6, Y(y) + 4, shortly(Number(y.toPrecision(6))), { "text-anchor": "end" });
  }
  for (const x of roundNumbers(xs[0], xs[1], log, 6)) {
    d += `M${X(x).toFixed(1)} ${ROOM.top}V${height - ROOM.bottom}`;
    text(X(x), height - ROOM.bottom + 16, shortly(Number(x.toPrecision(6))), { "text-anchor": "middle" });
  }
  svg.prepend(element("path", { class: "grid", d }));
  text((ROOM.left + width - ROOM.right) / 2, height - 8, axis, { "text-anchor": "middle", class: "title" });
  text(0, 0, quantity, { "text-anchor": "middle", class: "title", transform: `translate(13 ${(ROOM.top + height - ROOM.bottom) / 2}) rotate(-90)` });
  if (mark && mark.x > xs[0] && mark.x < xs[1]) {
    const edge = (x) => X(Math.min(xs[1], Math.max(xs[0], x)));
    svg.append(element("rect", { class: "band", x: edge(mark.x - mark.error), y: ROOM.top, height: height - ROOM.bottom - ROOM.top, width: edge(mark.x + mark.error) - edge(mark.x - mark.error) }));
    line(`M${X(mark.x)} ${ROOM.top}V${height - ROOM.bottom}`, "lift-off");
    const left = X(mark.x) > width - 130;
    text(X(mark.x) + (left ? -5 : 5), ROOM.top + 12, mark.text, { "text-anchor": left ? "end" : "start", class: "of-lift-off" });
  }
  for (const run of joined(good)) line(`M${run.map(({ x, y }) => `${X(x).toFixed(1)} ${Y(y).toFixed(1)}`).join("L")}`, "through");
  for (const point of points) {
    const cx = X(point.x), cy = point.y === null ? height - ROOM.bottom : Y(point.y);
    if (point.y !== null && point.error > 0) line(`M${cx} ${Y(point.y - point.error)}V${Y(point.y + point.error)}m-3 0h6M${cx - 3} ${Y(point.y - point.error)}h6`, "error");
    if (point.y === null) line(`M${cx - 4} ${cy - 4}l8 8m0 -8l-8 8`, "without");
    else svg.append(element("circle", { cx, cy, r: point.index === chosen ? 6.5 : 4.5, class: `phase-${point.phase}${point.index === chosen ? " chosen" : ""}`, "data-index": point.index }));
  }
  line(`M${ROOM.left} ${ROOM.top}V${height - ROOM.bottom}H${width - ROOM.right}`, "axis");
  box.querySelector("svg.plot")?.remove();
  box.prepend(svg);
  const shown = points.filter(({ y }) => y !== null);
  box.shown = { plot: svg, points: [{ along: axis, title: quantity, points: shown.map((p) => [X(p.x), Y(p.y), p.x, p.y, p.error, p.status === "ok" ? "" : p.status.replaceAll("_", " ")]) }], indices: shown.map(({ index }) => index) };
  renewPoints(box);
}
