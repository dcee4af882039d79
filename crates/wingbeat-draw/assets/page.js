// The flight page: unpacks the flight, draws the scene of a frame, keeps plots and scene in step.
"use strict";
const flight = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const blob = (() => {
  const text = atob(flight.blob), bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
  return bytes.buffer;
})();
const last = flight.frames.length - 1;
let frame = 0, playing = false, coloured = "circulation";

// ---- words ----
byId("name").textContent = flight.name;
byId("about").textContent = [flight.description, "wingbeat " + flight.version, flight.outcome].filter(Boolean).join(" · ");
byId("summary").textContent = flight.summary;
byId("thinned").textContent = flight.thinned;
byId("case").textContent = flight.case;

// ---- numbers of a frame: 16-bit whole numbers, scaled by the box of the frame ----
function unpack(k) {
  const f = flight.frames[k];
  let at = f.at;
  const take = (kind, n) => { const a = new kind(blob, at, n); at += 2 * n; return a; };
  const points = (n) => {
    const whole = take(Uint16Array, 3 * n), out = new Float32Array(3 * n);
    for (let i = 0; i < 3 * n; i++) out[i] = (f.low[i % 3] + whole[i] * f.step_m) * flight.scale;
    return out;
  };
  const signed = (n, share) => { const w = take(Int16Array, n), out = new Float32Array(n); for (let i = 0; i < n; i++) out[i] = w[i] / 32767 * share; return out; };
  const circulation = f.circulation / flight.most.circulation, pressure = f.pressure / flight.most.pressure;
  const cells = flight.surfaces.reduce((n, s) => n + s.quads.length / 4, 0);
  const nodes = flight.surfaces.reduce((n, s) => n + s.nodes, 0);
  const surfaces = { points: points(nodes), circulation: signed(cells, circulation), pressure: signed(cells, pressure) };
  const sheets = flight.sheets.map((cols, s) => ({ cols, rows: f.rows[s] || 0 }));
  const wakeNodes = sheets.reduce((n, s) => n + (s.rows ? (s.rows + 1) * (s.cols + 1) : 0), 0);
  const rings = sheets.reduce((n, s) => n + s.rows * s.cols, 0);
  const wake = { points: points(wakeNodes), circulation: signed(rings, circulation) };
  return { surfaces, sheets, wake, particles: { points: points(f.particles), strength: signed(f.particles, f.strength / flight.most.strength) } };
}

// Blue, white, red: told apart by colour-blind readers.
const BLUE = [0.13, 0.40, 0.67], WHITE = [0.95, 0.95, 0.95], RED = [0.70, 0.09, 0.17];
function colour(v, out, at) {
  const x = Math.sign(v) * Math.sqrt(Math.min(1, Math.abs(v))), end = x < 0 ? BLUE : RED, w = Math.abs(x);
  for (let c = 0; c < 3; c++) out[at + c] = WHITE[c] + w * (end[c] - WHITE[c]);
}

// ---- the scene ----
const canvas = byId("view");
let renderer = null;
try { renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true }); }
catch (e) { byId("where").textContent = "This browser cannot draw in 3-D (no WebGL); the plots work without it."; }
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xffffff);
const camera = new THREE.PerspectiveCamera(40, 1, 0.01, 1000);
camera.up.set(0, 0, 1);
scene.add(new THREE.AmbientLight(0xffffff, 2.2));
const sun = new THREE.DirectionalLight(0xffffff, 1.6);
sun.position.set(2, -3, 5);
scene.add(sun);
const controls = new THREE.OrbitControls(camera, canvas);
const moving = new THREE.Group();
scene.add(moving);

// Each quadrilateral becomes two triangles with their own corners, so that a panel has one colour.
// Wakes are the more transparent the weaker and the older they are, so that they do not hide the animal.
function mesh(points, corners, values, material, youth) {
  const n = corners.length / 4, parts = youth ? 4 : 3, position = new Float32Array(18 * n), paint = new Float32Array(6 * parts * n);
  const order = [0, 1, 2, 0, 2, 3];
  for (let q = 0; q < n; q++) {
    for (let t = 0; t < 6; t++) {
      const p = 3 * corners[4 * q + order[t]], at = 18 * q + 3 * t;
      position[at] = points[p]; position[at + 1] = points[p + 1]; position[at + 2] = points[p + 2];
      const dye = parts * (6 * q + t);
      if (values) colour(values[q], paint, dye); else paint.set([0.82, 0.80, 0.74], dye);
      if (parts === 4) paint[dye + 3] = (0.02 + 0.3 * Math.min(1, Math.abs(values[q]))) * youth[q];
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(paint, parts));
  geometry.computeVertexNormals();
  const out = new THREE.Mesh(geometry, material);
  out.renderOrder = youth ? 0 : 1; // the animal is drawn over its wakes
  return out;
}
function edges(points, corners) {
  const position = [];
  for (let q = 0; q < corners.length; q += 4)
    for (let e = 0; e < 4; e++)
      for (const c of [corners[q + e], corners[q + (e + 1) % 4]]) position.push(points[3 * c], points[3 * c + 1], points[3 * c + 2]);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(position, 3));
  const out = new THREE.LineSegments(geometry, EDGE);
  out.renderOrder = 2;
  return out;
}
function line(points, material) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  return new THREE.Line(geometry, material);
}
// Vortex particles: from pale to dark violet, the stronger the darker and the less transparent.
const PALE = [0.80, 0.72, 0.90], DARK = [0.28, 0.04, 0.42];
function particles({ points, strength }) {
  const paint = new Float32Array(4 * strength.length);
  strength.forEach((s, k) => {
    const x = Math.sqrt(Math.min(1, s));
    for (let c = 0; c < 3; c++) paint[4 * k + c] = PALE[c] + x * (DARK[c] - PALE[c]);
    paint[4 * k + 3] = 0.1 + 0.7 * x;
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(paint, 4));
  return new THREE.Points(geometry, PARTICLE);
}
const PARTICLE = new THREE.PointsMaterial({ vertexColors: true, size: 0.035, transparent: true, depthWrite: false });
const SOLID = new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide, transparent: true });
const WAKE = new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide, transparent: true, depthWrite: false });
const EDGE = new THREE.LineBasicMaterial({ color: 0x333333, transparent: true, opacity: 0.35 });
const TRAIL = new THREE.LineBasicMaterial({ color: 0x009e73 });
const PATH = new THREE.LineBasicMaterial({ color: 0x222222 });

function sheetCorners(sheets) {
  const corners = [];
  let first = 0;
  for (const { cols, rows } of sheets) {
    if (!rows) continue;
    const node = (i, j) => first + i * (cols + 1) + j;
    for (let i = 0; i < rows; i++) for (let j = 0; j < cols; j++) corners.push(node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
    first += (rows + 1) * (cols + 1);
  }
  return corners;
}
// From 1 for the newest row to 0.15 for rows older than a wingbeat.
function youthOf(sheets) {
  const beat = last > 0 ? flight.trail * (flight.frames[1].step - flight.frames[0].step) : 1, out = [];
  for (const { cols, rows } of sheets) for (let i = 0; i < rows; i++) for (let j = 0; j < cols; j++) out.push(Math.max(0.15, 1 - i / beat));
  return out;
}
function slices() {
  let node = 0, cell = 0;
  return flight.surfaces.map((s) => {
    const at = { node, cell, nodes: s.nodes, cells: s.quads.length / 4 };
    node += s.nodes; cell += at.cells;
    return at;
  });
}
const SLICES = slices();
const pointOf = (points, slice, k) => [0, 1, 2].map((c) => points[3 * (slice.node + k) + c]);
// Mean node of the surfaces of a body.
function centre(points, body) {
  const own = SLICES.filter((_, k) => flight.surfaces[k].body === body), sum = [0, 0, 0];
  const nodes = own.reduce((n, s) => n + s.nodes, 0);
  for (const s of own) for (let k = 0; k < s.nodes; k++) pointOf(points, s, k).forEach((x, c) => { sum[c] += x / nodes; });
  return sum;
}
// The node of each wing farthest from its first one: the tip.
const TIPS = (() => {
  if (last < 0) return [];
  const p = unpack(0).surfaces.points;
  return SLICES.slice(0, flight.wings).map((s) => {
    const root = pointOf(p, s, 0);
    let best = 0, far = -1;
    for (let k = 0; k < s.nodes; k++) {
      const d = Math.hypot(...pointOf(p, s, k).map((x, c) => x - root[c]));
      if (d > far) { far = d; best = k; }
    }
    return best;
  });
})();
const tipPaths = TIPS.map(() => []);
for (let k = 0; k <= last; k++) {
  const p = unpack(k).surfaces.points;
  TIPS.forEach((tip, w) => tipPaths[w].push(...pointOf(p, SLICES[w], tip)));
}

function dispose() {
  for (const child of [...moving.children]) {
    moving.remove(child);
    child.traverse((o) => { if (o.geometry) o.geometry.dispose(); });
  }
}
let target = null;
function drawScene() {
  if (last < 0) return;
  dispose();
  const now = unpack(frame), points = now.surfaces.points;
  const values = coloured === "pressure" ? now.surfaces.pressure : now.surfaces.circulation;
  flight.surfaces.forEach((s, k) => {
    const slice = SLICES[k], corners = s.quads.map((n) => n + slice.node);
    // The circulation of a closed body is known but for a constant: it is not shown.
    const painted = flight.air && (k < flight.wings || coloured === "pressure");
    moving.add(mesh(points, corners, painted ? values.subarray(slice.cell, slice.cell + slice.cells) : null, SOLID));
    moving.add(edges(points, corners));
  });
  if (byId("wakes").checked) moving.add(mesh(now.wake.points, sheetCorners(now.sheets), now.wake.circulation, WAKE, youthOf(now.sheets)));
  if (byId("wakes").checked && now.particles.strength.length) moving.add(particles(now.particles));
  if (byId("trails").checked) {
    const from = Math.max(0, frame - flight.trail);
    tipPaths.forEach((path) => moving.add(line(path.slice(3 * from, 3 * frame + 3), TRAIL)));
    moving.add(line(flight.path.slice(0, 3 * (frame + 1)).map((x) => x * flight.scale), PATH));
  }
  if (byId("forces").checked) flight.frames[frame].forces.forEach((f, k) => {
    const size = Math.hypot(...f) / flight.force_scale, body = k + 1;
    if (size > 0.02 && flight.surfaces.some((s) => s.body === body)) moving.add(new THREE.ArrowHelper(new THREE.Vector3(...f).normalize(), new THREE.Vector3(...centre(points, body)), size, 0xd55e00, 0.22 * Math.max(size, 0.4), 0.12 * Math.max(size, 0.4)));
  });
  const here = flight.path.slice(3 * frame, 3 * frame + 3).map((x) => x * flight.scale);
  if (!target) {
    const far = Math.max(1, 0.8 * canvas.clientHeight / Math.max(1, canvas.clientWidth)); // narrow screens
    camera.position.set(here[0] + 2.6 * far, here[1] - 3.6 * far, here[2] + 1.5 * far);
    controls.target.set(...here);
  } else if (byId("camera").value === "follow") {
    const shift = new THREE.Vector3(here[0] - target[0], here[1] - target[1], here[2] - target[2]);
    camera.position.add(shift);
    controls.target.add(shift);
  }
  target = here;
  controls.update();
  render();
  say(tipPaths.map((p) => p.slice(3 * frame, 3 * frame + 3).map((x) => (x / flight.scale).toExponential(4)).join(" ")).join(" | "));
}
function render() {
  if (!renderer) return;
  const w = canvas.clientWidth, h = canvas.clientHeight;
  renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
  renderer.setSize(w, h, false);
  camera.aspect = w / Math.max(1, h);
  camera.updateProjectionMatrix();
  renderer.render(scene, camera);
}
controls.addEventListener("change", render);

function say(tips) {
  const f = flight.frames[frame], state = byId("state");
  const time = (f.time * 1e3).toFixed(3) + " ms";
  byId("where").textContent = (flight.period ? "beat " + (f.time / flight.period).toFixed(2) + (f.down ? ", downstroke · " : ", upstroke · ") : "") + time + " · step " + f.step;
  state.dataset.frame = frame;
  state.dataset.tip = tips;
  state.dataset.triangles = renderer ? renderer.info.render.triangles : "no WebGL";
  const [unit, most] = coloured === "pressure" ? ["Pa", flight.most.pressure] : ["m²/s", flight.most.circulation];
  byId("legend").style.display = flight.air ? "" : "none";
  byId("low").textContent = (coloured === "pressure" ? "pressure jump " : "circulation ") + (-most).toPrecision(2);
  byId("high").textContent = most.toPrecision(2) + " " + unit + " (square-root scale)";
  state.dataset.particles = f.particles;
  byId("dots").style.display = f.particles ? "" : "none";
  byId("dots").textContent = "particles, the stronger the darker: 0 to " + flight.most.strength.toExponential(1) + " m³/s and more";
}

// ---- plots ----
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"];
const plots = [];
for (const chart of flight.charts) for (const panel of chart.panels) {
  const c = document.createElement("canvas");
  c.setAttribute("role", "img");
  c.setAttribute("aria-label", panel.label);
  byId("plots").append(c);
  const plot = { c, chart, panel };
  plots.push(plot);
  const seek = (e) => {
    const r = c.getBoundingClientRect(), x = toX(plot, (e.clientX - r.left));
    let best = 0;
    flight.frames.forEach((f, k) => { if (Math.abs(f.x - x) < Math.abs(flight.frames[best].x - x)) best = k; });
    show(best);
  };
  c.addEventListener("pointerdown", seek);
  c.addEventListener("pointermove", (e) => { if (e.buttons) seek(e); });
}
const LEFT = 62, RIGHT = 10, BOTTOM = 18, ROW = 15;
// Where the legend's entries stand: after the name of the axis, in more rows where one is too short.
function legend(p, g, w) {
  let at = 14 + g.measureText(p.panel.label).width, row = 0;
  return p.panel.series.map((s) => {
    const text = "— " + s.label + (s.values.every((v) => v === 0) ? " = 0" : ""), width = g.measureText(text).width + 10;
    if (at + width > w && at > LEFT) { at = LEFT; row += 1; }
    at += width;
    return { text, x: at - width, y: 14 + ROW * row };
  });
}
const span = (p) => [p.chart.x[0], p.chart.x[p.chart.x.length - 1]];
const toX = (p, px) => { const [a, b] = span(p); return a + (b - a) * (px - LEFT) / (p.c.clientWidth - LEFT - RIGHT); };
function range(panel) {
  let lo = Infinity, hi = -Infinity;
  for (const s of panel.series) for (const v of s.values) {
    if (v === null) continue;
    const y = panel.logarithmic ? (v === 0 ? NaN : Math.log10(Math.abs(v))) : v;
    if (y < lo) lo = y;
    if (y > hi) hi = y;
  }
  if (!(hi > lo)) { lo = Number.isFinite(lo) ? lo - 1 : -1; hi = lo + 2; }
  if (panel.logarithmic) lo = Math.max(lo, hi - 18);
  const margin = 0.06 * (hi - lo);
  return [lo - margin, hi + margin];
}
function ticks(lo, hi) {
  const raw = (hi - lo) / 6, p = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map((m) => m * p).find((s) => s >= raw);
  const out = [];
  for (let t = Math.ceil(lo / step) * step; t <= hi; t += step) out.push(Math.abs(t) < step / 1e6 ? 0 : t);
  return out;
}
function drawPlot(p) {
  const ratio = window.devicePixelRatio || 1, w = p.c.clientWidth, h = p.c.clientHeight, g = p.c.getContext("2d");
  p.c.width = w * ratio; p.c.height = h * ratio;
  g.scale(ratio, ratio);
  const [x0, x1] = span(p), [y0, y1] = range(p.panel);
  const X = (x) => LEFT + (w - LEFT - RIGHT) * (x - x0) / (x1 - x0 || 1), Y = (y) => h - BOTTOM - (h - TOP - BOTTOM) * (y - y0) / (y1 - y0);
  g.font = "11px system-ui, sans-serif";
  const entries = legend(p, g, w), TOP = 8 + Math.max(14, ...entries.map((e) => e.y));
  g.fillStyle = "#ececf0";
  for (const [a, b] of p.chart.shaded) g.fillRect(X(a), TOP, X(b) - X(a), h - TOP - BOTTOM);
  g.strokeStyle = "#d5d9e0"; g.fillStyle = "#374151"; g.lineWidth = 1;
  g.textAlign = "right"; g.textBaseline = "middle";
  for (const t of ticks(y0, y1)) {
    g.beginPath(); g.moveTo(LEFT, Y(t)); g.lineTo(w - RIGHT, Y(t)); g.stroke();
    g.fillText(p.panel.logarithmic ? "1e" + (+t.toFixed(1)) : String(+t.toPrecision(4)), LEFT - 5, Y(t));
  }
  g.textAlign = "center"; g.textBaseline = "alphabetic";
  const free = w - RIGHT - g.measureText(p.chart.x_label).width - 12;
  for (const t of ticks(x0, x1)) if (X(t) < free) g.fillText(String(+t.toPrecision(4)), X(t), h - 5);
  g.textAlign = "right"; g.fillText(p.chart.x_label, w - RIGHT, h - 5);
  g.textAlign = "left"; g.fillText(p.panel.label, 6, 14);
  p.panel.series.forEach((s, k) => {
    g.strokeStyle = g.fillStyle = COLOURS[k % COLOURS.length];
    g.fillText(entries[k].text, entries[k].x, entries[k].y);
    g.lineWidth = 1.5;
    g.beginPath();
    let pen = false;
    s.values.forEach((v, i) => {
      const y = v === null ? NaN : p.panel.logarithmic ? Math.log10(Math.abs(v)) : v;
      if (!Number.isFinite(y) || y < y0) { pen = false; return; }
      if (pen) g.lineTo(X(p.chart.x[i]), Y(y)); else g.moveTo(X(p.chart.x[i]), Y(y));
      pen = true;
    });
    g.stroke();
  });
  if (last >= 0) {
    g.strokeStyle = "#111"; g.lineWidth = 1;
    g.beginPath(); g.moveTo(X(flight.frames[frame].x), TOP); g.lineTo(X(flight.frames[frame].x), h - BOTTOM); g.stroke();
  }
}

// ---- one frame everywhere ----
function show(k) {
  frame = Math.max(0, Math.min(last, k));
  byId("time").value = frame;
  drawScene();
  plots.forEach(drawPlot);
}
byId("time").max = Math.max(0, last);
byId("time").addEventListener("input", () => show(+byId("time").value));
byId("colour").addEventListener("change", () => { coloured = byId("colour").value; drawScene(); });
for (const id of ["wakes", "trails", "forces", "camera"]) byId(id).addEventListener("change", drawScene);
let begun = 0, from = 0;
function tick(now) {
  if (!playing) return;
  const next = from + Math.floor((now - begun) / 1000 * +byId("speed").value);
  if (next !== frame) show(next);
  if (frame >= last) return stop();
  requestAnimationFrame(tick);
}
function stop() { playing = false; byId("play").textContent = "Play"; }
function play() {
  if (playing) return stop();
  playing = true;
  byId("play").textContent = "Pause";
  from = frame >= last ? 0 : frame;
  begun = performance.now();
  requestAnimationFrame(tick);
}
byId("play").addEventListener("click", play);
byId("speed").addEventListener("change", () => { from = frame; begun = performance.now(); });
window.addEventListener("keydown", (e) => {
  if (e.target.tagName === "SELECT") return;
  if (e.key === " ") { e.preventDefault(); play(); }
  if (e.key === "ArrowRight" && e.target.id !== "time") show(frame + 1);
  if (e.key === "ArrowLeft" && e.target.id !== "time") show(frame - 1);
});
window.addEventListener("resize", () => show(frame));
// A frame can be linked to: flight.html#frame=12 moves the slider there.
function linked() {
  const wanted = /frame=(\d+)/.exec(location.hash);
  if (!wanted) return;
  byId("time").value = wanted[1];
  byId("time").dispatchEvent(new Event("input"));
}
window.addEventListener("hashchange", linked);
show(0);
linked();
