"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const $ = (id) => document.getElementById(id);
const state = $("state").dataset;
state.errors = 0;
addEventListener("error", () => { state.errors = +state.errors + 1; });
// Colours from low to high, all of them apart from the panel behind; grey where there is no number.
const RAMPS = { dark: ["#6f5fe0", "#c458ae", "#f58746", "#fff0b8"], light: ["#9f90d0", "#b0549c", "#b8330f", "#4a0d05"] };
const GREY = { dark: "#55647a", light: "#b3bdc9" };
const ALARM = { dark: "#ff9d8a", light: "#a3200f" };
const LINES_AT_MOST = 4000, ROWS_AT_MOST = 500;

const columns = data.columns.map((c, k) => ({ ...c, k, label: c.name + (c.unit && c.unit !== "1" ? ` [${c.unit}]` : "") }));
const rows = data.rows;
for (const c of columns) {
  const values = rows.map((r) => r.cells[c.k]).filter((v) => v !== null);
  c.words = values.some((v) => typeof v === "string");
  if (c.words) {
    const found = new Set(values.map(String));
    c.names = c.names ? c.names.filter((name) => found.has(name)) : [...found];
    c.of = (row) => row.cells[c.k] === null ? null : c.names.indexOf(String(row.cells[c.k]));
    c.range = [0, Math.max(1, c.names.length - 1)];
  } else {
    c.of = (row) => row.cells[c.k];
    let low = Infinity, high = -Infinity;
    for (const v of values) { if (v < low) low = v; if (v > high) high = v; }
    if (low > high) [low, high] = [0, 1];
    if (low === high) { const d = Math.abs(low) * 0.01 || 1; [low, high] = [low - d, high + d]; }
    c.range = [low, high];
  }
  c.share = (row) => { const v = c.of(row); return v === null ? null : (v - c.range[0]) / (c.range[1] - c.range[0]); };
}
const keys = columns.filter((c) => c.kind === "key"), numbers = columns.filter((c) => c.kind === "number");
const first = (list, k) => (list[k] || list[0] || columns[0]).k;
const shown = { across: first(keys, 0), up: keys.length > 1 ? first(keys, 1) : first(numbers, 0), colour: first(numbers, keys.length > 1 ? 0 : 1), point: null, sort: null, falls: false, limits: {} };

const theme = () => document.documentElement.dataset.theme;
const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const parts = (hex) => { const n = parseInt(hex.slice(1), 16); return [n >> 16, n >> 8 & 255, n & 255]; };
function dye(t) {
  if (t === null || !Number.isFinite(t)) return GREY[theme()];
  const stops = RAMPS[theme()].map(parts), x = Math.max(0, Math.min(2.9999, 3 * t));
  return `rgb(${stops[x | 0].map((a, c) => Math.round(a + (stops[(x | 0) + 1][c] - a) * (x % 1))).join(",")})`;
}
function text(value) {
  if (value === null || value === undefined) return "–";
  if (typeof value === "string") return value;
  if (value === 0 || Number.isInteger(value) && Math.abs(value) < 1e6) return String(value);
  const size = Math.abs(value);
  return size >= 1e5 || size < 1e-3 ? value.toExponential(3) : String(+value.toPrecision(5));
}
const atEnd = (c, end) => c.words ? c.names[end ? c.names.length - 1 : 0] : text(c.range[end]);
const isIn = (row) => Object.entries(shown.limits).every(([k, [low, high]]) => { const t = columns[k].share(row); return t !== null && t >= low && t <= high; });
const chosen = () => rows.filter(isIn);

function canvas(id) {
  const box = $(id), width = box.clientWidth, height = box.clientHeight, ratio = devicePixelRatio || 1;
  box.width = width * ratio; box.height = height * ratio;
  const pen = box.getContext("2d");
  pen.scale(ratio, ratio);
  pen.font = "11px system-ui, sans-serif";
  return { pen, width, height };
}

// Ticks at round numbers.
function ticks([low, high], most) {
  const step = 10 ** Math.floor(Math.log10((high - low) / most)), by = [1, 2, 5, 10].find((m) => (high - low) / (m * step) <= most) * step;
  const list = [];
  for (let k = Math.ceil(low / by); k * by <= high + 1e-9 * by; k++) list.push(+(k * by).toPrecision(12));
  return list;
}

// Names within a width, cut in the middle, such that names that differ still do.
function shortened(pen, names, room) {
  const fits = (words) => pen.measureText(words).width <= room, differ = new Set(names).size;
  const cut = (name, share) => {
    const signs = [...name];
    if (fits(name)) return name;
    for (let n = signs.length - 1; n > 2; n--) {
      const head = Math.max(1, Math.round(share * n)), words = signs.slice(0, head).join("") + "…" + signs.slice(signs.length - n + head).join("");
      if (fits(words)) return words;
    }
    return "…";
  };
  for (const share of [0.5, 0.7, 0.3, 0.9, 0.1, 1]) {
    const list = names.map((name) => cut(name, share));
    if (new Set(list).size === differ) return list;
  }
  const all = [...new Set(names)]; // counted, where nothing else tells them apart
  return names.map((name) => cut(`${all.indexOf(name) + 1}: ${name}`, 0.7));
}

let spots = [];
function drawMap() {
  const { pen, width, height } = canvas("map"), [x, y, c] = [columns[shown.across], columns[shown.up], columns[shown.colour]];
  const right = 14, top = 10, bottom = 40, h = height - top - bottom, aside = 26; // aside: the title of the axis and gaps
  const marks = (column, most) => column.words ? column.names.map((name, k) => [k, name]) : ticks(column.range, most).map((v) => [v, text(v)]);
  const share = (column, v) => (v - column.range[0]) / (column.range[1] - column.range[0]);
  const ups = marks(y, Math.max(2, h / 50)), wanted = aside + Math.max(0, ...ups.map(([, name]) => pen.measureText(name).width));
  const left = Math.max(74, Math.min(width / 3, wanted)), w = width - left - right;
  const inset = Math.min(34, 0.12 * h), px = (t) => left + inset + t * (w - 2 * inset), py = (t) => top + inset + (1 - t) * (h - 2 * inset);
  pen.strokeStyle = style("--grid"); pen.fillStyle = style("--muted");
  pen.textAlign = "center";
  const overs = marks(x, Math.max(2, w / 90)), overNames = overs.map(([, name]) => name);
  const each = (w - 2 * inset) / Math.max(1, overs.length - 1), beside = inset + right; // the last name is moved in where it is wider
  const overWords = x.words ? shortened(pen, overNames, Math.min(each - 8, (each + beside - 8) / 1.5)) : overNames;
  overs.forEach(([v], k) => {
    const at = px(share(x, v)), half = pen.measureText(overWords[k]).width / 2;
    pen.beginPath(); pen.moveTo(at, top); pen.lineTo(at, top + h); pen.stroke();
    pen.fillText(overWords[k], Math.max(half, Math.min(width - half, at)), top + h + 14);
  });
  pen.textAlign = "right";
  const upWords = shortened(pen, ups.map(([, name]) => name), left - aside);
  ups.forEach(([v], k) => { const at = py(share(y, v)); pen.beginPath(); pen.moveTo(left, at); pen.lineTo(left + w, at); pen.stroke(); pen.fillText(upWords[k], left - 6, at + 4); });
  pen.textAlign = "center"; pen.fillStyle = style("--text");
  pen.fillText(x.label, left + w / 2, height - 6);
  pen.save(); pen.translate(12, top + h / 2); pen.rotate(-Math.PI / 2); pen.fillText(y.label, 0, 0); pen.restore();
  const list = chosen(), apart = Math.sqrt(w * h / Math.max(1, list.length)), radius = Math.max(2, Math.min(7, apart / 4));
  spots = [];
  const at = new Map(); // points at the same place are fanned out in a spiral around it
  for (const row of list) {
    const [a, b] = [x.share(row), y.share(row)];
    if (a === null || b === null && row.failed === null) continue;
    const [sx, sy] = [px(a), b === null ? top + h - inset / 2 : py(b)];
    const place = `${Math.round(sx)} ${Math.round(sy)}`, k = at.get(place) || 0;
    at.set(place, k + 1);
    spots.push([sx, sy, row, k]);
  }
  const pile = Math.max(1, ...at.values()), away = Math.min(1.25 * radius, (inset - radius) / Math.sqrt(pile));
  for (const spot of spots) {
    const [, , row, k] = spot, bad = row.failed !== null, turn = 2.4 * k, far = away * Math.sqrt(k);
    spot[0] += far * Math.cos(turn);
    spot[1] += far * Math.sin(turn);
    const [sx, sy] = spot;
    if (bad) {
      pen.strokeStyle = ALARM[theme()]; pen.lineWidth = 1.6; pen.beginPath();
      pen.moveTo(sx - 4, sy - 4); pen.lineTo(sx + 4, sy + 4); pen.moveTo(sx - 4, sy + 4); pen.lineTo(sx + 4, sy - 4); pen.stroke(); pen.lineWidth = 1;
      continue;
    }
    pen.fillStyle = dye(c.share(row)); pen.beginPath(); pen.arc(sx, sy, radius, 0, 7); pen.fill();
  }
  const mine = spots.find((s) => s[2] === shown.point);
  if (mine) { pen.strokeStyle = style("--text"); pen.lineWidth = 2; pen.beginPath(); pen.arc(mine[0], mine[1], radius + 3, 0, 7); pen.stroke(); pen.lineWidth = 1; }
  const scale = canvas("scale");
  for (let k = 0; k < scale.width; k++) { scale.pen.fillStyle = dye(k / scale.width); scale.pen.fillRect(k, 0, 1, scale.height); }
  $("least").textContent = atEnd(c, 0); $("most").textContent = atEnd(c, 1);
  state.spots = spots.length;
}

let axes = [];
function drawLines() {
  const { pen, width, height } = canvas("lines"), colour = columns[shown.colour];
  // Where axes stand close, their words are turned.
  const apart = (width - 120) / Math.max(1, columns.length - 1), turned = apart < 72, ends = columns.map((c) => [atEnd(c, 0), atEnd(c, 1)]);
  const longest = (end) => Math.max(0, ...ends.map((words) => pen.measureText(words[end]).width));
  const [top, bottom, side] = turned ? [116, Math.max(40, Math.min(104, longest(0) + 10)), 18] : [34, 18, 60], h = height - top - bottom;
  const x = (k) => columns.length < 2 ? width / 2 : side + k * (width - 2 * side) / (columns.length - 1);
  axes = columns.map((c, k) => ({ k, x: x(k), top, h }));
  const draw = (row, paint, width) => {
    pen.strokeStyle = paint; pen.lineWidth = width; pen.beginPath();
    let open = false;
    columns.forEach((c, k) => { const t = c.share(row); if (t === null) { open = false; return; } const y = top + h * (1 - t); open ? pen.lineTo(x(k), y) : pen.moveTo(x(k), y); open = true; });
    pen.stroke();
  };
  const list = chosen(), stride = Math.ceil(list.length / LINES_AT_MOST);
  pen.globalAlpha = Math.max(0.12, Math.min(0.9, 60 / list.length));
  for (let k = 0; k < list.length; k += stride) draw(list[k], dye(colour.share(list[k])), 1.2);
  pen.globalAlpha = 1;
  if (shown.point) draw(shown.point, style("--text"), 2);
  const names = shortened(pen, columns.map((c) => c.name), turned ? top - 8 : apart - 8);
  const fit = (pair) => (turned ? [shortened(pen, pair, bottom - 8)[0], shortened(pen, pair, top - 8)[1]] : shortened(pen, pair, apart - 8));
  const upright = (words, at, y, align) => { pen.save(); pen.translate(at, y); pen.rotate(-Math.PI / 2); pen.textAlign = align; pen.fillText(words, 0, 0); pen.restore(); };
  columns.forEach((c, k) => {
    const [low, high] = fit(ends[k]);
    pen.strokeStyle = style("--muted"); pen.lineWidth = 1; pen.beginPath(); pen.moveTo(x(k), top); pen.lineTo(x(k), top + h); pen.stroke();
    const limits = shown.limits[k];
    if (limits) { pen.fillStyle = style("--accent"); pen.fillRect(x(k) - 3, top + h * (1 - limits[1]), 6, Math.max(2, h * (limits[1] - limits[0]))); }
    const ink = style(c.kind === "key" ? "--accent" : "--text");
    if (turned) {
      pen.fillStyle = ink; upright(names[k], x(k) - 3, top - 5, "left");
      pen.fillStyle = style("--muted"); upright(high, x(k) + 11, top - 5, "left"); upright(low, x(k) + 4, top + h + 5, "right");
      return;
    }
    pen.textAlign = k === 0 ? "left" : k === columns.length - 1 ? "right" : "center";
    const at = k === 0 ? 4 : k === columns.length - 1 ? width - 4 : x(k);
    pen.fillStyle = ink; pen.fillText(names[k], at, 13);
    pen.fillStyle = style("--muted"); pen.fillText(high, at, 27); pen.fillText(low, at, height - 5);
  });
}

// A name that may be broken after its points and underscores.
const breakable = (name) => name.split(/(?<=[._])/).flatMap((part) => [part, document.createElement("wbr")]);

function fillTable() {
  const heads = [{ name: "point", of: (r) => r.point }, ...columns.map((c) => ({ name: c.label, about: c.about, of: c.of }))];
  const head = document.createElement("tr");
  heads.forEach((h, k) => {
    const cell = document.createElement("th"), button = document.createElement("button");
    button.append(...breakable(h.name), shown.sort === k ? (shown.falls ? " ▼" : " ▲") : ""); button.title = h.about || "sort";
    button.onclick = () => { shown.falls = shown.sort === k && !shown.falls; shown.sort = k; fillTable(); };
    cell.setAttribute("aria-sort", shown.sort !== k ? "none" : shown.falls ? "descending" : "ascending");
    cell.append(button); head.append(cell);
  });
  $("table").tHead.replaceChildren(head);
  const list = chosen();
  if (shown.sort !== null) {
    const of = heads[shown.sort].of, sign = shown.falls ? -1 : 1;
    list.sort((a, b) => { const [x, y] = [of(a), of(b)]; return x === null ? 1 : y === null ? -1 : sign * (x - y) || a.point - b.point; });
  }
  const body = list.slice(0, ROWS_AT_MOST).map((row) => {
    const line = document.createElement("tr");
    line.dataset.point = row.point; line.className = row === shown.point ? "chosen" : "";
    for (const value of [row.point, ...row.cells]) { const cell = document.createElement("td"); cell.textContent = text(value); line.append(cell); }
    if (row.failed !== null) line.classList.add("failed");
    line.onclick = () => choose(row, true);
    return line;
  });
  $("table").tBodies[0].replaceChildren(...body);
  const failed = rows.filter((r) => r.failed !== null).length, missing = rows.filter((r) => !r.flown).length;
  const judged = columns.find((c) => c.kind === "verdict");
  const doubtful = ["red", "amber"].map((word) => [judged ? rows.filter((r) => r.cells[judged.k] === word).length : 0, word]).filter(([n]) => n);
  $("count").textContent = `${list.length} of ${rows.length} points` + (list.length > ROWS_AT_MOST ? `, the first ${ROWS_AT_MOST} of them listed` : "") + (failed ? `, ${failed} failed` : "") + (missing ? `, ${missing} not flown yet` : "") + doubtful.map(([n, word]) => `, ${n} ${word}`).join("");
  state.rows = body.length; state.first = list.length ? list[0].point : "";
}

// Shows a point; asked to, opens its flight page where it is kept.
function choose(row, opens) {
  shown.point = row;
  $("point-name").textContent = `Point ${row.point}`;
  const words = row.failed !== null ? `failed, ${row.failed}` : !row.flown ? "not flown yet" : row.page ? "its flight page is kept" : "its flight page is not kept; this command flies it:";
  $("point-words").textContent = words; $("point-words").className = row.failed !== null ? "failed" : "muted";
  $("open").hidden = !row.page;
  if (row.page) $("open").href = row.page;
  $("command").textContent = row.command; $("command").hidden = $("copy").hidden = Boolean(row.page);
  $("values").replaceChildren(...columns.map((c) => { const line = document.createElement("tr"), th = document.createElement("th"), td = document.createElement("td"); th.append(...breakable(c.label)); th.title = c.about || ""; td.textContent = text(row.cells[c.k]); line.append(th, td); return line; }));
  state.point = row.point; state.opened = opens && row.page || "";
  if (opens && row.page) window.open(row.page, "_blank");
  drawMap(); drawLines();
  for (const line of $("table").tBodies[0].rows) line.classList.toggle("chosen", +line.dataset.point === row.point);
}

function nearest(event) {
  const box = $("map").getBoundingClientRect(), [x, y] = [event.clientX - box.left, event.clientY - box.top];
  let best = null, least = 15 ** 2;
  for (const spot of spots) { const d = (spot[0] - x) ** 2 + (spot[1] - y) ** 2; if (d < least) [best, least] = [spot[2], d]; }
  return best;
}
$("map").addEventListener("click", (event) => { const row = nearest(event); if (row) choose(row, true); });
$("map").addEventListener("mousemove", (event) => { const row = nearest(event); $("map").title = row ? `point ${row.point}: ${columns.map((c) => `${c.name} ${text(row.cells[c.k])}`).join(", ")}` : ""; });
$("map").addEventListener("keydown", (event) => {
  const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key], list = chosen();
  if (step && list.length) { event.preventDefault(); const at = list.indexOf(shown.point); choose(list[(at + step + list.length) % list.length], false); }
  if (event.key === "Enter" && shown.point) choose(shown.point, true);
});
let drag = null;
$("lines").addEventListener("pointerdown", (event) => {
  const box = $("lines").getBoundingClientRect(), x = event.clientX - box.left;
  const axis = axes.reduce((a, b) => Math.abs(b.x - x) < Math.abs(a.x - x) ? b : a);
  const share = (e) => Math.max(0, Math.min(1, 1 - (e.clientY - box.top - axis.top) / axis.h));
  drag = { axis, share, from: share(event) };
  $("lines").setPointerCapture(event.pointerId);
});
$("lines").addEventListener("pointermove", (event) => {
  if (!drag) return;
  const to = drag.share(event);
  if (Math.abs(to - drag.from) > 0.01) { shown.limits[drag.axis.k] = [Math.min(drag.from, to), Math.max(drag.from, to)]; drawLines(); drawMap(); }
});
$("lines").addEventListener("pointerup", (event) => {
  if (drag && Math.abs(drag.share(event) - drag.from) <= 0.01) delete shown.limits[drag.axis.k];
  drag = null;
  draw();
});
function draw() { drawLines(); drawMap(); fillTable(); }
function turn() {
  document.documentElement.dataset.theme = theme() === "dark" ? "light" : "dark";
  try { localStorage.setItem("wingbeat-theme", theme()); } catch { /* a page from a file may not keep anything */ }
  draw();
}
$("theme").onclick = turn;
addEventListener("keydown", (event) => { if (event.key.toLowerCase() === "t" && !/^(SELECT|INPUT)$/.test(event.target.tagName)) turn(); });
addEventListener("resize", draw);
$("copy").onclick = () => navigator.clipboard?.writeText($("command").textContent);

$("name").textContent = data.name;
$("about").textContent = [`${data.points} points of ${data.case}`, data.stride > 1 ? `every ${data.stride}th shown` : "", data.description].filter(Boolean).join("; ");
for (const [id, k] of [["across", shown.across], ["up", shown.up], ["colour", shown.colour]]) {
  $(id).append(...columns.map((c) => new Option(c.label, c.k)));
  $(id).value = k;
  $(id).onchange = () => { shown[id] = +$(id).value; draw(); };
}
const light = matchMedia("(prefers-color-scheme: light)").matches;
let kept = null;
try { kept = localStorage.getItem("wingbeat-theme"); } catch { /* likewise */ }
if ((kept || (light ? "light" : "dark")) === "light") document.documentElement.dataset.theme = "light";
draw();
state.ready = "yes";
