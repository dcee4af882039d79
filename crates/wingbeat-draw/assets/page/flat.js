// Without WebGL: the same scene in the plane, wings and body as filled panels over the filaments of the wake.
const flat = { turn: -0.85, tilt: 0.27, zoom: 1, scale: 100 };
const FLAT_VIEWS = { quarter: [-0.85, 0.27], side: [-Math.PI / 2, 0.04], front: [0, 0.04], top: [-Math.PI / 2, Math.PI / 2], wake: [-2.2, 0.2] };
// Right, up, toward the reader.
function flatSeen([x, y, z]) {
  const [s, c, sin, cos] = [Math.sin(flat.turn), Math.cos(flat.turn), Math.sin(flat.tilt), Math.cos(flat.tilt)], ahead = x * c + y * s;
  return [-x * s + y * c, z * cos - ahead * sin, z * sin + ahead * cos];
}
function flatView(name) {
  [flat.turn, flat.tilt] = FLAT_VIEWS[name];
  flat.zoom = name === "wake" ? 0.7 : 1;
  redraw();
}
function drawFlat(k) {
  const ratio = Math.min(2, window.devicePixelRatio || 1), w = stage.clientWidth, h = stage.clientHeight, g = canvas.getContext("2d");
  canvas.width = w * ratio; canvas.height = h * ratio;
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  const sky = g.createLinearGradient(0, 0, 0, h);
  sky.addColorStop(0, theme.sky[0]); sky.addColorStop(1, theme.sky[1]);
  g.fillStyle = sky; g.fillRect(0, 0, w, h);
  flat.scale = flat.zoom * Math.min(w, h) / (hasWake ? 3.4 : 2.6) / REACH;
  const c = centreOf(k), up = hasWake ? 0.42 : 0.5;
  const at = (p) => { const [x, y, z] = flatSeen([p[0] - c[0], p[1] - c[1], p[2] - c[2]]); return [0.5 * w + flat.scale * x, up * h - flat.scale * y, z]; };
  const css = (colour, alpha) => `rgba(${colour.map((x) => Math.round(255 * Math.min(1, x))).join()},${alpha})`;
  const frame = unpack(k), dye = wakeDye(state.colour), P = frame.wake;
  if (state.filaments) eachFilament(frame, flight.frames[k].step, state.age * BEAT, (a, b, strength, age, shed, wing) => {
    const s = Math.min(1, Math.abs(strength) / STRENGTH) * youthOf(age);
    if (s < 0.05) return;
    const p = at(P.subarray(a, a + 3)), q = at(P.subarray(b, b + 3));
    g.strokeStyle = css(dye(shareOf(shed, age, spinOf(strength * (P[b + 1] - P[a + 1]), 1, strength), wing)), 0.5 * s * state.opacity);
    g.lineWidth = 0.6 + 1.6 * s;
    g.beginPath(); g.moveTo(p[0], p[1]); g.lineTo(q[0], q[1]); g.stroke();
  });
  const panels = [];
  for (const s of flight.solids) {
    const nodes = s.nodes.map((p) => at(placed(k, s.body, p)));
    for (const q of s.quads) panels.push({ p: q.map((n) => nodes[n]), colour: rgb(s.stand_in ? theme.standIn : theme.body), alpha: 1 });
  }
  for (const wing of WINGS) {
    const node = (j, i) => { const n = 3 * (wing.first + j * (wing.cols + 1) + i); return at(frame.wings.subarray(n, n + 3)); };
    for (let j = 0; j < wing.rows; j++) for (let i = 0; i < wing.cols; i++) panels.push({ p: [node(j, i), node(j, i + 1), node(j + 1, i + 1), node(j + 1, i)], colour: rgb(theme.plain), alpha: 0.6 });
  }
  for (const panel of panels) panel.depth = panel.p.reduce((s, p) => s + p[2], 0);
  panels.sort((a, b) => a.depth - b.depth);
  for (const { p, colour, alpha } of panels) {
    const u = p[2].map((x, i) => x - p[0][i]), v = p[3].map((x, i) => x - p[1][i]), n = [u[1] * v[2] * flat.scale - u[2] * flat.scale * v[1], u[2] * flat.scale * v[0] - u[0] * v[2] * flat.scale, u[0] * v[1] - u[1] * v[0]], light = Math.abs(n[2]) / (Math.hypot(...n) || 1);
    g.fillStyle = css(colour.map((x) => x * (0.45 + 0.6 * light)), alpha);
    g.strokeStyle = css(rgb(theme.edge), 0.35); g.lineWidth = 0.5;
    g.beginPath(); p.forEach(([x, y], i) => (i ? g.lineTo(x, y) : g.moveTo(x, y))); g.closePath(); g.fill(); g.stroke();
  }
  for (const arrow of forceArrows(k)) drawFlatForce(arrow, g, at);
}
function drawFlatForce({ from, size, way, alone }, g, at) {
  const p = at(from), q = at(from.map((x, c) => x + way[c])), d = Math.hypot(q[0] - p[0], q[1] - p[1]) || 1, u = [(q[0] - p[0]) / d, (q[1] - p[1]) / d];
  g.strokeStyle = g.fillStyle = theme.force; g.lineWidth = 3;
  g.beginPath(); g.moveTo(p[0], p[1]); g.lineTo(q[0], q[1]); g.stroke();
  g.beginPath(); g.moveTo(q[0] + 9 * u[0], q[1] + 9 * u[1]); g.lineTo(q[0] - 5 * u[1], q[1] + 5 * u[0]); g.lineTo(q[0] + 5 * u[1], q[1] - 5 * u[0]); g.fill();
  g.font = "600 12px system-ui, sans-serif";
  if (alone) g.fillText(forceWords(size), q[0] + 12, q[1]);
}
// The wake is one drawing here, of its filaments; pressure and paths are not drawn.
function flatState() {
  state.filaments = WAKES.some((name) => state[name]);
  state.vortices = state.smoke = state.pressure = false;
}
if (!renderer && LAST >= 0) {
  canvas.addEventListener("pointerdown", (e) => canvas.setPointerCapture(e.pointerId));
  canvas.addEventListener("pointermove", (e) => {
    if (!e.buttons) return;
    flat.turn -= 0.008 * e.movementX;
    flat.tilt = Math.max(-1.5, Math.min(1.57, flat.tilt + 0.008 * e.movementY));
    redraw();
  });
  canvas.addEventListener("wheel", (e) => { e.preventDefault(); flat.zoom = Math.max(0.2, Math.min(8, flat.zoom * Math.exp(-0.001 * e.deltaY))); redraw(); }, { passive: false });
}
