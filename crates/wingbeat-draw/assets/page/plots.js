// Plots over time: half-strokes as bands, what is past in full colour, values where the pointer is;
// a click goes there, the wheel or two fingers zoom, dragging with Shift moves.
const PAD = { left: 46, right: 9, top: 5, bottom: 18 };
const whole = (() => { const x = flight.charts[0]?.x || [0, 1]; return [x[0], x[x.length - 1] > x[0] ? x[x.length - 1] : x[0] + 1]; })();
const plots = { range: [...whole], hover: null, list: [] };
// Tabs: the first two charts together, the others each.
const TABS = [["Overview", flight.charts.filter((c) => ["forces", "trajectory"].includes(c.name))], ...flight.charts.filter((c) => !["forces", "trajectory"].includes(c.name)).map((c) => [c.name[0].toUpperCase() + c.name.slice(1), [c]])];
function openTab(n) {
  document.querySelectorAll("#tabs button").forEach((b, k) => b.setAttribute("aria-pressed", k === n));
  plots.list = TABS[n][1].flatMap((chart) => chart.panels.map((panel) => ({ chart, panel })));
  byId("plots").replaceChildren(...plots.list.map(plotBox));
  drawPlots();
}
function plotBox(p) {
  const box = document.createElement("figure"), words = document.createElement("figcaption");
  p.canvas = document.createElement("canvas"); p.words = words;
  p.canvas.setAttribute("role", "img");
  p.canvas.setAttribute("aria-label", `${p.panel.label} over ${p.chart.x_label}: ${p.panel.series.map((s) => s.label).join(", ")}`);
  box.className = "plot";
  box.append(words, p.canvas);
  listen(p.canvas);
  return box;
}
const toTime = (c, px) => plots.range[0] + (plots.range[1] - plots.range[0]) * (px - PAD.left) / (c.clientWidth - PAD.left - PAD.right);
// The frame nearest to a time on the axis.
function frameAt(x) {
  let low = 0, high = LAST;
  while (high - low > 1) { const m = (low + high) >> 1; if (flight.frames[m].x <= x) low = m; else high = m; }
  return Math.abs(flight.frames[high].x - x) < Math.abs(flight.frames[low].x - x) ? high : low;
}
function zoomPlots(factor, about = 0.5 * (plots.range[0] + plots.range[1])) {
  const span = Math.min(whole[1] - whole[0], Math.max((whole[1] - whole[0]) / 1000, (plots.range[1] - plots.range[0]) * factor)), share = (about - plots.range[0]) / (plots.range[1] - plots.range[0]);
  movePlots(about - share * span, span);
}
function movePlots(from, span = plots.range[1] - plots.range[0]) {
  const a = Math.max(whole[0], Math.min(whole[1] - span, from));
  plots.range = [a, a + span];
  drawPlots();
}
function listen(c) {
  const fingers = new Map();
  let tap = null; // where a finger came down that has not moved and is alone yet
  let moves = false; // whether the pointer moves the time
  const where = (e) => toTime(c, e.clientX - c.getBoundingClientRect().left);
  const goTo = (e) => { if (LAST >= 0) seek(frameAt(where(e))); };
  c.addEventListener("pointerdown", (e) => {
    fingers.set(e.pointerId, e);
    tap = fingers.size === 1 && e.pointerType === "touch" ? e : null;
    moves = fingers.size === 1 && !tap && !e.shiftKey;
    if (moves) goTo(e);
  });
  c.addEventListener("pointermove", (e) => {
    const before = fingers.get(e.pointerId);
    if (before && fingers.size === 2) {
      const other = [...fingers].find(([id]) => id !== e.pointerId)[1], gap = (a) => Math.max(8, Math.abs(a.clientX - other.clientX));
      zoomPlots(gap(before) / gap(e), where(other));
    } else if (before && e.shiftKey) movePlots(plots.range[0] - (where(e) - where(before)));
    else if (before && tap && Math.abs(e.clientX - tap.clientX) > 8) { tap = null; moves = true; }
    if (before && moves) goTo(e);
    if (before) fingers.set(e.pointerId, e);
    plots.hover = where(e);
    drawPlots();
  });
  for (const name of ["pointerup", "pointercancel", "pointerleave"]) c.addEventListener(name, (e) => { if (name === "pointerup" && tap) goTo(e); tap = null; moves = false; fingers.delete(e.pointerId); if (name === "pointerleave") { plots.hover = null; drawPlots(); } });
  c.addEventListener("wheel", (e) => { e.preventDefault(); zoomPlots(Math.exp(0.0015 * e.deltaY), where(e)); }, { passive: false });
  c.addEventListener("dblclick", () => movePlots(whole[0], whole[1] - whole[0]));
}
const height = (panel, v) => (v === null ? NaN : panel.logarithmic ? Math.log10(Math.abs(v)) : v);
function limits({ chart, panel }) {
  let low = Infinity, high = -Infinity;
  const [a, b] = plots.range;
  for (const s of panel.series) for (let i = 0; i < s.values.length; i++) {
    if (chart.x[i] < a - 1e-9 || chart.x[i] > b + 1e-9) continue;
    const y = height(panel, s.values[i]);
    if (!Number.isFinite(y)) continue;
    if (y < low) low = y;
    if (y > high) high = y;
  }
  if (!panel.logarithmic) { low = Math.min(0, low); high = Math.max(0, high); }
  if (!(high > low)) { low = Number.isFinite(low) ? low - 1 : -1; high = low + 2; }
  else if (high - low < panel.least) { const half = 0.5 * panel.least, middle = 0.5 * (low + high); low = middle - half; high = middle + half; }
  if (panel.logarithmic) low = Math.max(low, high - 18);
  const margin = 0.06 * (high - low);
  return [low - margin, high + margin];
}
function ticks(low, high, most) {
  const raw = (high - low) / most, p = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map((m) => m * p).find((s) => s >= raw * 0.999), out = [];
  for (let t = Math.ceil(low / step) * step; t <= high + step * 1e-9; t += step) out.push(Math.abs(t) < step / 1e6 ? 0 : +t.toPrecision(10));
  return out;
}
// A number at a tick, short enough for the margin; with either sign in the same form.
const tickWords = (t) => {
  const [plain, power] = [String(Math.abs(t)), Math.abs(t).toExponential()];
  return minus((t < 0 ? "-" : "") + (plain.length > 6 && power.length < plain.length ? power : plain));
};
// Least and largest value of a line near a time: one number, where every step is there.
function valuesAt({ chart }, s, x) {
  const list = chart.x;
  let low = 0, high = list.length - 1;
  while (high - low > 1) { const m = (low + high) >> 1; if (list[m] <= x) low = m; else high = m; }
  if (/, extremes of every \d+ (steps|of them)$/.test(chart.title)) { const a = low - low % 2, both = [s.values[a], s.values[Math.min(a + 1, list.length - 1)]]; return [Math.min(...both), Math.max(...both)]; }
  const v = s.values[Math.abs(list[high] - x) < Math.abs(list[low] - x) ? high : low];
  return [v, v];
}
const valueWords = ([a, b]) => (a === null ? "—" : a === b ? digits(a) : digits(a) + " to " + digits(b));
function splitLabel(label) {
  const found = /^(.*?) (?:\[(.+)\]|\/ (weight))$/.exec(label);
  return found ? [found[1][0].toUpperCase() + found[1].slice(1), found[2] === "deg" ? "°" : found[2] || "× weight"] : [label[0].toUpperCase() + label.slice(1), ""];
}
// Up is blue and forward orange wherever they are; other lines take their turn.
function lineColour(panel, k) {
  const own = { up: 0, forward: 1, right: 2 }, word = panel.series[k].label.split(" ")[0];
  return theme.lines[(panel.series.some((s) => s.label.split(" ")[0] === "up") && word in own ? own[word] : k) % theme.lines.length];
}
function drawPlots() { plots.list.forEach(drawPlot); }
function drawPlot(p) {
  const { canvas: c, chart, panel } = p, w = c.clientWidth, h = c.clientHeight, ratio = Math.min(2, window.devicePixelRatio || 1);
  if (!w || !h) return;
  if (c.width !== Math.round(w * ratio) || c.height !== Math.round(h * ratio)) { c.width = Math.round(w * ratio); c.height = Math.round(h * ratio); }
  const g = c.getContext("2d"), css = getComputedStyle(document.documentElement), of = (name) => css.getPropertyValue(name);
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, w, h);
  const [x0, x1] = plots.range, [y0, y1] = limits(p), X = (x) => PAD.left + (w - PAD.left - PAD.right) * (x - x0) / (x1 - x0), Y = (y) => h - PAD.bottom - (h - PAD.top - PAD.bottom) * (y - y0) / (y1 - y0);
  g.font = "10.5px system-ui, sans-serif";
  g.save();
  g.beginPath(); g.rect(PAD.left, 0, w - PAD.left - PAD.right, h); g.clip();
  g.fillStyle = of("--band");
  for (const [a, b] of panel.shaded || chart.shaded) g.fillRect(X(a), PAD.top, X(b) - X(a), h - PAD.top - PAD.bottom);
  g.restore();
  g.textBaseline = "middle"; g.textAlign = "right";
  for (const t of ticks(y0, y1, Math.max(4, Math.floor(h / 30)))) {
    g.strokeStyle = of("--line"); g.lineWidth = t === 0 && !panel.logarithmic ? 1.4 : 0.8;
    g.beginPath(); g.moveTo(PAD.left, Y(t)); g.lineTo(w - PAD.right, Y(t)); g.stroke();
    g.fillStyle = of("--muted");
    g.fillText(panel.logarithmic ? "1e" + minus(String(+t.toFixed(1))) : tickWords(t), PAD.left - 5, Y(t));
  }
  g.textAlign = "center"; g.textBaseline = "top"; g.fillStyle = of("--muted");
  const named = p === plots.list[plots.list.length - 1], last = w - (named ? PAD.right + g.measureText(chart.x_label).width + 14 : 0);
  for (const t of ticks(x0, x1, Math.max(2, Math.floor(w / 64)))) if (X(t) < last) g.fillText(tickWords(t), Math.min(X(t), w - 1 - g.measureText(tickWords(t)).width / 2), h - 13);
  g.textAlign = "right";
  if (named) g.fillText(chart.x_label, w - PAD.right, h - 13);
  const now = LAST >= 0 ? flight.frames[frameNow()].x : x1, at = plots.hover ?? now;
  g.save();
  g.beginPath(); g.rect(PAD.left, 0, w - PAD.left - PAD.right, h); g.clip();
  panel.series.forEach((s, k) => { g.strokeStyle = lineColour(panel, k); curve(g, chart, panel, s, X, Y, y0, now); });
  g.strokeStyle = of("--text"); g.lineWidth = 1;
  g.beginPath(); g.moveTo(X(now), PAD.top); g.lineTo(X(now), h - PAD.bottom); g.stroke();
  if (plots.hover !== null) { g.setLineDash([3, 3]); g.beginPath(); g.moveTo(X(at), PAD.top); g.lineTo(X(at), h - PAD.bottom); g.stroke(); g.setLineDash([]); }
  panel.series.forEach((s, k) => { const y = height(panel, valuesAt(p, s, at)[1]); if (Number.isFinite(y)) { g.fillStyle = lineColour(panel, k); g.beginPath(); g.arc(X(at), Y(y), 3, 0, 7); g.fill(); } });
  g.restore();
  const [name, unit] = splitLabel(panel.label);
  p.words.replaceChildren(...plotWords(p, name, unit, at));
}
// Full colour up to now, faint beyond.
function curve(g, chart, panel, s, X, Y, y0, now) {
  g.lineWidth = 1.6; g.lineJoin = "round";
  for (const [alpha, until] of [[0.38, Infinity], [1, now]]) {
    let pen = false;
    g.globalAlpha = alpha;
    g.beginPath();
    for (let i = 0; i < chart.x.length && chart.x[i] <= until + 1e-9; i++) {
      const y = height(panel, s.values[i]);
      if (!Number.isFinite(y) || y < y0) { pen = false; continue; }
      if (pen) g.lineTo(X(chart.x[i]), Y(y)); else g.moveTo(X(chart.x[i]), Y(y));
      pen = true;
    }
    g.stroke();
  }
  g.globalAlpha = 1;
}
function plotWords(p, name, unit, at) {
  const make = (tag, text, colour) => { const e = document.createElement(tag); e.textContent = text; if (colour) e.style.color = colour; return e; };
  p.most ??= Math.max(p.panel.least, ...p.panel.series.map((s) => s.values.reduce((a, v) => Math.max(a, Math.abs(v || 0)), 0)));
  const grain = p.panel.logarithmic || !p.most ? 0 : 10 ** (Math.floor(Math.log10(p.most)) - 3); // finer than the plot shows
  const round = (v) => (v === null || !grain ? v : Math.round(v / grain) * grain);
  const series = p.panel.series.map((s, k) => {
    const e = make("span", s.label.replace(/ [−-]?n\d$/, "") + " ", lineColour(p.panel, k));
    e.append(make("i", valueWords(valuesAt(p, s, at).map(round))));
    return e;
  });
  const title = make("b", name + " ");
  title.append(make("em", unit));
  return [title, ...series];
}
// For readers who listen: the values of this time as a table.
function valueTable(k) {
  const x = flight.frames[k].x, rows = [["time", whenWords(k)]];
  for (const [, charts] of TABS) for (const chart of charts) for (const panel of chart.panels) for (const s of panel.series) rows.push([`${panel.label}: ${s.label}`, valueWords(valuesAt({ chart }, s, x))]);
  byId("values").replaceChildren(...rows.map(([what, value]) => { const tr = document.createElement("tr"), th = document.createElement("th"), td = document.createElement("td"); th.scope = "row"; th.textContent = what; td.textContent = value; tr.append(th, td); return tr; }));
}
