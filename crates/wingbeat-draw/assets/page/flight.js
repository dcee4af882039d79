// The flight: the data of the page, and the numbers of a frame unpacked from 16-bit whole numbers.
// Lengths of the scene are counted in wing lengths (flight.length_m); axes x forward, y left, z up.
const byId = (id) => document.getElementById(id);
const flight = JSON.parse(byId("data").textContent);
// Of bodies without shape, those whose ellipsoid has a size one can look at: held bodies may have any inertia.
flight.solids = flight.solids.filter((s) => {
  const size = Math.max(...[0, 1, 2].map((c) => Math.max(...s.nodes.map((p) => p[c])) - Math.min(...s.nodes.map((p) => p[c])))) / flight.length_m;
  return !s.stand_in || !flight.wings.length || (size > 0.03 && size < 4);
});
const LAST = flight.frames.length - 1;
const SCALE = 1 / flight.length_m;
// Steps in a wingbeat; without wingbeats, in a quarter of the flight: ages are counted in these.
const BEAT = flight.period ? flight.period / flight.step_s : Math.max(1, (LAST >= 0 ? flight.frames[LAST].step : 4) / 4);
const hasWake = flight.sheets.length > 0 || flight.frames.some((f) => f.particles > 0);

const bytes = (() => {
  const text = atob(flight.blob), out = new Uint8Array(text.length);
  for (let k = 0; k < text.length; k++) out[k] = text.charCodeAt(k);
  return out.buffer;
})();

// Whether a wing goes down in a step: the flight begins with an upstroke and turns at flight.turns of the wing. The last
// wing that beats stands for those that are not named or do not beat.
const REFERENCE = flight.turns.reduce((found, turns, k) => (turns.length ? k : found), -1);
const downOf = (() => {
  const steps = LAST >= 0 ? flight.frames[LAST].step : 0;
  const downs = flight.turns.map((turns) => {
    const down = new Uint8Array(steps + 1);
    let now = 0, next = 0;
    for (let k = 0; k <= steps; k++) {
      while (next < turns.length && turns[next] <= k) { now = 1 - now; next++; }
      down[k] = now;
    }
    return down;
  });
  return (step, wing = REFERENCE) => (REFERENCE < 0 ? 0 : downs[flight.turns[wing]?.length ? wing : REFERENCE][Math.max(0, Math.min(steps, step))]);
})();
const hasStrokes = REFERENCE >= 0;

const WINGS = (() => {
  let first = 0;
  return flight.wings.map((w) => {
    const nodes = (w.rows + 1) * (w.cols + 1), own = { ...w, first, nodes };
    first += nodes;
    return own;
  });
})();
const wingNodes = WINGS.reduce((n, w) => n + w.nodes, 0);
const PANELS = flight.lattice ? flight.wings.reduce((n, w) => n + w.rows * w.cols, 0) + flight.solids.reduce((n, s) => n + (s.first_panel === null ? 0 : s.quads.length), 0) : 0;

const unpacked = new Map();
function unpack(k) {
  if (unpacked.has(k)) return unpacked.get(k);
  const f = flight.frames[k];
  let at = f.at;
  const take = (kind, n) => { const a = new kind(bytes, at, n); at += 2 * n; return a; };
  const points = (n) => {
    const whole = take(Uint16Array, 3 * n), out = new Float32Array(3 * n);
    for (let i = 0; i < 3 * n; i++) out[i] = (f.low[i % 3] + whole[i] * f.step_m) * SCALE;
    return out;
  };
  const signed = (n, most) => {
    const whole = take(Int16Array, n), out = new Float32Array(n);
    for (let i = 0; i < n; i++) out[i] = whole[i] / 32767 * most;
    return out;
  };
  const frame = { wings: points(wingNodes), pressure: signed(PANELS, f.pressure) };
  frame.sheets = flight.sheets.map((cols, s) => ({ cols, rows: f.rows[s] || 0, wing: flight.shedding[s], id: s })).filter((s) => s.rows > 0);
  let ring = 0;
  for (const s of frame.sheets) { s.ring = ring; ring += s.rows * s.cols; }
  frame.wake = points(frame.sheets.reduce((n, s) => n + (s.rows + 1) * (s.cols + 1), 0));
  frame.rings = signed(frame.sheets.reduce((n, s) => n + s.rows * s.cols, 0), f.circulation);
  frame.particles = points(f.particles);
  frame.strengths = signed(3 * f.particles, f.strength);
  if (unpacked.size > 24) unpacked.delete(unpacked.keys().next().value);
  unpacked.set(k, frame);
  return frame;
}

// Place (wing lengths) and quaternion of a body in a frame.
function poseOf(k, body) {
  const p = flight.frames[k].poses[flight.posed.indexOf(body)];
  return { place: p.slice(0, 3).map((x) => x * SCALE), turn: p.slice(3) };
}
// The node of each wing farthest from its first one in the first frame: the tip.
const TIPS = LAST < 0 ? [] : WINGS.map((w) => {
  const p = unpack(0).wings, from = 3 * w.first;
  let best = 0, far = -1;
  for (let k = 0; k < w.nodes; k++) {
    const d = Math.hypot(p[from + 3 * k] - p[from], p[from + 3 * k + 1] - p[from + 1], p[from + 3 * k + 2] - p[from + 2]);
    if (d > far) { far = d; best = k; }
  }
  return w.first + best;
});
// Tips of a frame without unpacking its wake.
function tipsOf(k) {
  const f = flight.frames[k];
  return TIPS.map((t) => {
    const whole = new Uint16Array(bytes, f.at + 6 * t, 3);
    return [0, 1, 2].map((c) => (f.low[c] + whole[c] * f.step_m) * SCALE);
  });
}
// Sum of the forces of the air [N].
const totalForce = (k) => flight.frames[k].forces.reduce((s, f) => s.map((x, c) => x + f[c]), [0, 0, 0]);
