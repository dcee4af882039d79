// Body and wings. Rigid parts are smoothed once and posed in every frame; wings are smoothed anew, as
// they may bend. Eyes, bands and veins are decoration, and the page says so.
const ANIMAL = { stencilWrite: true, stencilRef: 1 }; // their pixels are marked: wakes are dimmed there

// ---- smoothing: Catmull-Clark subdivision, moved until it passes through the given nodes ----
function subdivide(points, faces) {
  const n = points.length, sum = new Map(), edges = new Map(), out = points.map((p) => [...p]), quads = [];
  const key = (a, b) => (a < b ? a * 1e6 + b : b * 1e6 + a);
  const mean = (list) => [0, 1, 2].map((c) => list.reduce((s, p) => s + p[c], 0) / list.length);
  const touch = points.map(() => ({ faces: [], middles: [] }));
  const centres = faces.map((f) => mean(f.map((i) => points[i])));
  faces.forEach((f, k) => f.forEach((a, i) => {
    const b = f[(i + 1) % f.length], id = key(a, b);
    if (!edges.has(id)) edges.set(id, { a, b, faces: [] });
    edges.get(id).faces.push(k);
    touch[a].faces.push(centres[k]);
  }));
  const firstEdge = n;
  let at = firstEdge;
  for (const e of edges.values()) {
    e.node = at++;
    const ends = [points[e.a], points[e.b]], middle = mean(ends);
    out.push(e.faces.length === 2 ? mean([...ends, centres[e.faces[0]], centres[e.faces[1]]]) : middle);
    touch[e.a].middles.push(middle); touch[e.b].middles.push(middle);
  }
  const firstFace = at;
  centres.forEach((c) => out.push(c));
  touch.forEach((t, i) => {
    const m = t.middles.length;
    if (m < 3 || t.faces.length !== m) return;
    const f = mean(t.faces), r = mean(t.middles);
    out[i] = [0, 1, 2].map((c) => (f[c] + 2 * r[c] + (m - 3) * points[i][c]) / m);
  });
  faces.forEach((f, k) => f.forEach((a, i) => {
    const before = edges.get(key(f[(i + f.length - 1) % f.length], a)).node, after = edges.get(key(a, f[(i + 1) % f.length])).node;
    quads.push([a, after, firstFace + k, before]);
  }));
  return [out, quads];
}
function subdivided(points, faces, levels) {
  for (let k = 0; k < levels; k++) [points, faces] = subdivide(points, faces);
  return [points, faces];
}
// Whether neighbouring faces meet at more than 78 degrees: a box is meant to have edges.
function isSharp(points, faces) {
  const normal = (f) => {
    const [a, b, c] = [points[f[0]], points[f[1]], points[f[2]]], u = b.map((x, k) => x - a[k]), v = c.map((x, k) => x - a[k]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]], s = Math.hypot(...n) || 1;
    return n.map((x) => x / s);
  };
  const normals = faces.map(normal), seen = new Map();
  let sharp = 0;
  faces.forEach((f, k) => f.forEach((a, i) => {
    const b = f[(i + 1) % f.length], id = Math.min(a, b) + "," + Math.max(a, b);
    if (seen.has(id)) { const other = normals[seen.get(id)]; if (normals[k].reduce((s, x, c) => s + x * other[c], 0) < 0.2) sharp++; }
    seen.set(id, k);
  }));
  return sharp > 0.08 * seen.size;
}
function smoothed(solid) {
  const points = solid.nodes.map((p) => p.map((x) => x * SCALE)), faces = solid.quads.map((q) => q.filter((n, i) => q.indexOf(n) === i));
  const levels = faces.length <= 80 ? 3 : faces.length <= 400 ? 2 : faces.length <= 1500 ? 1 : 0;
  if (levels === 0) return { points, faces, flat: false };
  if (isSharp(points, faces)) return { points, faces, flat: true };
  let control = points.map((p) => [...p]);
  for (let k = 0; k < 8; k++) {
    const [fine] = subdivided(control, faces, levels);
    control = control.map((p, i) => p.map((x, c) => x + points[i][c] - fine[i][c]));
  }
  const [fine, quads] = subdivided(control, faces, levels);
  return { points: fine, faces: quads, flat: false };
}

// ---- body ----
const bodies = new Map(); // body -> group posed in every frame
const solids = !renderer ? [] : flight.solids.map((s) => {
  const { points, faces, flat } = smoothed(s), index = faces.flatMap((f) => f.slice(1, -1).flatMap((_, i) => [f[0], f[i + 1], f[i + 2]]));
  let g = new THREE.BufferGeometry();
  g.setAttribute("position", new THREE.Float32BufferAttribute(points.flat(), 3));
  g.setIndex(index);
  g.computeVertexNormals();
  const material = new THREE.MeshPhysicalMaterial({
    vertexColors: true, roughness: s.stand_in ? 0.7 : 0.42, clearcoat: s.stand_in ? 0 : 0.45, clearcoatRoughness: 0.32, sheen: s.stand_in ? 0 : 0.35, sheenRoughness: 0.6, sheenColor: "#ffdca8", side: THREE.DoubleSide, flatShading: flat,
    ...ANIMAL, stencilFunc: THREE.AlwaysStencilFunc, stencilZPass: THREE.ReplaceStencilOp,
  });
  if (!bodies.has(s.body)) { const group = new THREE.Group(); bodies.set(s.body, group); scene.add(group); }
  const mesh = new THREE.Mesh(g, material);
  bodies.get(s.body).add(mesh);
  return { s, mesh, points, near: s.first_panel === null ? null : nearest(s, points) };
});
// For every point of the smooth surface, the three panels nearest to it and their weights.
function nearest(s, points) {
  const middles = s.quads.map((q) => [0, 1, 2].map((c) => q.reduce((sum, n) => sum + s.nodes[n][c] * SCALE / 4, 0)));
  return points.map((p) => {
    const close = middles.map((m, q) => [q, Math.hypot(m[0] - p[0], m[1] - p[1], m[2] - p[2])]).sort((a, b) => a[1] - b[1]).slice(0, 3);
    const weights = close.map(([, d]) => 1 / (d * d + 1e-12)), sum = weights.reduce((a, b) => a + b, 0);
    return close.map(([q], i) => [q, weights[i] / sum]);
  });
}
function paintBodies() {
  const base = new THREE.Color(), stripe = new THREE.Color(theme.stripe), eye = new THREE.Color(theme.eye), c = new THREE.Color();
  for (const solid of solids) {
    const { s, mesh, points } = solid;
    base.set(s.stand_in ? theme.standIn : theme.body);
    const low = [0, 1, 2].map((k) => Math.min(...points.map((p) => p[k]))), high = [0, 1, 2].map((k) => Math.max(...points.map((p) => p[k])));
    const paint = new Float32Array(3 * points.length);
    points.forEach((p, i) => {
      const u = p.map((x, k) => 2 * (x - low[k]) / (high[k] - low[k] || 1) - 1);
      c.copy(base);
      if (!s.stand_in) decorate(s.name, u, c, stripe, eye);
      paint.set([c.r, c.g, c.b], 3 * i);
    });
    solid.paint = paint;
    mesh.geometry.setAttribute("color", new THREE.BufferAttribute(paint.slice(), 3));
  }
}
// Bands, stripes and eyes of insects, by the name of the part; u runs from -1 to 1 along its box.
function decorate(name, u, c, stripe, eye) {
  if (/abdomen/.test(name)) {
    let d = 0;
    for (const band of [0.42, 0.05, -0.32]) d = Math.max(d, 1 - smooth(0.05, 0.11, Math.abs(u[0] - band)));
    d = Math.max(d, 1 - smooth(-0.72, -0.58, u[0])) * smooth(-0.75, 0.1, u[2]);
    c.multiplyScalar(1.08).lerp(stripe, 0.85 * d);
  }
  if (/thorax/.test(name)) c.multiplyScalar(0.92).lerp(stripe, 0.22 * (1 - smooth(0.04, 0.14, Math.abs(Math.abs(u[1]) - 0.28))) * smooth(0.2, 0.7, u[2]));
  if (/head/.test(name)) c.lerp(eye, smooth(0.5, 0.62, Math.abs(u[1]) + 0.16 * u[0] + 0.06 * u[2]));
}
function poseBodies(k) {
  for (const [body, group] of bodies) {
    const { place, turn } = poseOf(k, body);
    group.position.set(...place);
    group.quaternion.set(...turn);
  }
  for (const solid of solids) if (solid.near) pressBody(solid, state.pressure ? unpack(k).pressure : null);
}
// Pressure jumps over the paint of a body; the paint alone without them.
function pressBody({ s, mesh, near, paint }, jumps) {
  const colours = mesh.geometry.attributes.color, high = linear(rgb(theme.high)), low = linear(rgb(theme.low));
  colours.array.set(paint);
  colours.needsUpdate = true;
  if (jumps) near.forEach((list, i) => {
    const x = list.reduce((sum, [q, w]) => sum + w * jumps[s.first_panel + q], 0) / flight.most.pressure, share = Math.sqrt(Math.min(1, Math.abs(x))), end = x > 0 ? high : low;
    for (let c = 0; c < 3; c++) colours.array[3 * i + c] += share * (end[c] - colours.array[3 * i + c]);
  });
}
const linear = (c) => { const x = new THREE.Color().setRGB(...c, THREE.SRGBColorSpace); return [x.r, x.g, x.b]; };

// ---- wings: Catmull-Rom splines through the nodes, along the span and along the chord ----
const INSECT = flight.length_m < 0.1; // larger wings are drawn without veins
function splineWeights(n, m) {
  return Array.from({ length: m }, (_, i) => {
    const x = i / (m - 1) * (n - 1), k = Math.max(0, Math.min(n - 2, Math.floor(x))), t = x - k, t2 = t * t, t3 = t2 * t, out = new Array(n).fill(0);
    if (n === 1) return [1];
    [-0.5 * t3 + t2 - 0.5 * t, 1.5 * t3 - 2.5 * t2 + 1, -1.5 * t3 + 2 * t2 + 0.5 * t, 0.5 * t3 - 0.5 * t2].forEach((w, a) => {
      const j = k - 1 + a;
      if (j < 0) { out[0] += 2 * w; out[1] -= w; } else if (j > n - 1) { out[n - 1] += 2 * w; out[n - 2] -= w; } else out[j] += w;
    });
    return out;
  });
}
const wings = !renderer ? [] : WINGS.map((w) => {
  const across = Math.min(65, 4 * w.cols + 1), along = Math.min(33, 3 * w.rows + 1), g = new THREE.BufferGeometry(), uv = [], index = [];
  for (let j = 0; j < along; j++) for (let i = 0; i < across; i++) uv.push(i / (across - 1), j / (along - 1));
  for (let j = 0; j < along - 1; j++) for (let i = 0; i < across - 1; i++) { const a = j * across + i; index.push(a, a + 1, a + across + 1, a, a + across + 1, a + across); }
  g.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * across * along), 3));
  g.setAttribute("uv", new THREE.Float32BufferAttribute(uv, 2));
  g.setAttribute("color", new THREE.BufferAttribute(new Float32Array(4 * across * along).fill(1), 4));
  g.setIndex(index);
  const mesh = new THREE.Mesh(g, new THREE.MeshPhysicalMaterial({
    vertexColors: true, transparent: true, side: THREE.DoubleSide, roughness: 0.28, iridescence: INSECT ? 0.55 : 0, iridescenceIOR: 1.35, depthWrite: false, forceSinglePass: true,
    ...ANIMAL, stencilFunc: THREE.AlwaysStencilFunc, stencilZPass: THREE.ReplaceStencilOp,
  }));
  mesh.renderOrder = 6;
  mesh.frustumCulled = false;
  scene.add(mesh);
  return { w, across, along, mesh, spanwise: splineWeights(w.cols + 1, across), chordwise: splineWeights(w.rows + 1, along) };
});
const outline = renderer && new Segments(Math.max(4, wings.reduce((n, w) => n + 2 * (w.across + w.along), 0)), { order: 7 });
function wingTexture(w) {
  const c = document.createElement("canvas"), x = c.getContext("2d");
  c.width = 1024; c.height = 512;
  x.fillStyle = INSECT ? theme.membrane : theme.membrane.replace(/[\d.]+\)$/, ".55)");
  x.fillRect(0, 0, c.width, c.height);
  x.strokeStyle = theme.vein; x.lineCap = "round";
  const vein = (width, [a, b, d, e]) => { x.lineWidth = width; x.beginPath(); x.moveTo(1024 * a[0], 512 * a[1]); x.bezierCurveTo(1024 * b[0], 512 * b[1], 1024 * d[0], 512 * d[1], 1024 * e[0], 512 * e[1]); x.stroke(); };
  if (INSECT) for (const [width, ...p] of VEINS) vein(width, p);
  else { // lines of the mesh
    x.globalAlpha = 0.5; x.lineWidth = 3;
    for (let k = 1; k < w.cols; k++) { x.beginPath(); x.moveTo(1024 * k / w.cols, 0); x.lineTo(1024 * k / w.cols, 512); x.stroke(); }
    for (let k = 1; k < w.rows; k++) { x.beginPath(); x.moveTo(0, 512 * k / w.rows); x.lineTo(1024, 512 * k / w.rows); x.stroke(); }
  }
  const t = new THREE.CanvasTexture(c);
  t.colorSpace = THREE.SRGBColorSpace; t.anisotropy = 8; t.flipY = false;
  return t;
}
// Longitudinal veins 2 to 6 and two cross veins of a fly's wing, from root to tip, leading to trailing edge.
const VEINS = [
  [15, [0, 0.4], [0.12, 0.14], [0.35, 0.1], [0.62, 0.015]], [10, [0.02, 0.44], [0.2, 0.3], [0.6, 0.24], [0.93, 0.06]],
  [12, [0.02, 0.48], [0.25, 0.46], [0.6, 0.5], [0.985, 0.46]], [10, [0.02, 0.54], [0.2, 0.66], [0.45, 0.72], [0.74, 0.985]],
  [7, [0.02, 0.6], [0.08, 0.8], [0.16, 0.86], [0.3, 0.985]], [7, [0.4, 0.305], [0.405, 0.36], [0.405, 0.42], [0.4, 0.475]],
  [8, [0.62, 0.5], [0.61, 0.6], [0.6, 0.7], [0.585, 0.8]],
];
function dressWings() {
  for (const { w, mesh } of wings) { mesh.material.map?.dispose(); mesh.material.map = wingTexture(w); mesh.material.needsUpdate = true; }
}
function drawWings(k) {
  const { wings: nodes, pressure } = unpack(k);
  let panel = 0;
  outline.begin();
  for (const { w, across, along, mesh, spanwise, chordwise } of wings) {
    const g = mesh.geometry, place = g.attributes.position.array, n = w.cols + 1, half = new Float32Array(3 * across * (w.rows + 1));
    for (let j = 0; j <= w.rows; j++) for (let i = 0; i < across; i++) for (let c = 0; c < 3; c++) {
      let s = 0;
      for (let a = 0; a < n; a++) if (spanwise[i][a]) s += spanwise[i][a] * nodes[3 * (w.first + n * j + a) + c];
      half[3 * (j * across + i) + c] = s;
    }
    for (let j = 0; j < along; j++) for (let i = 0; i < across; i++) for (let c = 0; c < 3; c++) {
      let s = 0;
      for (let a = 0; a <= w.rows; a++) if (chordwise[j][a]) s += chordwise[j][a] * half[3 * (a * across + i) + c];
      place[3 * (j * across + i) + c] = s;
    }
    g.attributes.position.needsUpdate = true;
    g.computeVertexNormals();
    paintWing(w, across, along, g.attributes.color, state.pressure && pressure.length ? pressure.subarray(panel, panel + w.rows * w.cols) : null);
    panel += w.rows * w.cols;
    edgeWing(place, across, along);
  }
  outline.end();
}
function edgeWing(place, across, along) {
  const at = (j, i) => place.subarray(3 * (j * across + i), 3 * (j * across + i) + 3), colour = rgb(theme.edge);
  for (let i = 0; i < across - 1; i++) {
    outline.add(at(0, i), at(0, i + 1), colour, [0.95, 0.95], [0.009, 0.009 - 0.004 * i / across]);
    outline.add(at(along - 1, i), at(along - 1, i + 1), colour, [0.7, 0.7], [0.004, 0.004]);
  }
  for (const i of [0, across - 1]) for (let j = 0; j < along - 1; j++) outline.add(at(j, i), at(j + 1, i), colour, [0.8, 0.8], [0.0045, 0.0045]);
}
// Pressure jumps, from means at the nodes; without them the wing is clear.
function paintWing(w, across, along, colours, jumps) {
  colours.needsUpdate = true;
  if (!jumps) { colours.array.fill(1); return; }
  const n = w.cols + 1, sum = new Float32Array(n * (w.rows + 1)), count = new Float32Array(sum.length);
  for (let j = 0; j < w.rows; j++) for (let i = 0; i < w.cols; i++) for (const k of [n * j + i, n * j + i + 1, n * (j + 1) + i, n * (j + 1) + i + 1]) { sum[k] += jumps[j * w.cols + i]; count[k]++; }
  for (let j = 0; j < along; j++) for (let i = 0; i < across; i++) {
    const x = i / (across - 1) * w.cols, y = j / (along - 1) * w.rows, a = Math.min(w.cols - 1, x | 0), b = Math.min(w.rows - 1, y | 0), s = x - a, t = y - b;
    const node = (k) => sum[k] / count[k], p = (1 - t) * ((1 - s) * node(n * b + a) + s * node(n * b + a + 1)) + t * ((1 - s) * node(n * (b + 1) + a) + s * node(n * (b + 1) + a + 1));
    const z = Math.max(-1, Math.min(1, p / flight.most.pressure));
    colours.array.set([...linear(signDye(z)), 1 + 2.6 * Math.sqrt(Math.abs(z))], 4 * (j * across + i));
  }
}
