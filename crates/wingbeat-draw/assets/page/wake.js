// The wake: iso-surfaces of vorticity in two levels, smoke on the shed vortex filaments under them,
// the filaments themselves if asked for. Vorticity is that which was shed; that bound to the wings
// is not in it.
const SIGMA = 0.06; // width over which vorticity is spread, wing lengths
const CELL = 0.05; // of the grid
const MOST_CELLS = 5e5;
const BOX = 3.2; // half the edge of the box about the body in which surfaces are drawn
const LONGEST = 1.2; // filaments longer than this are not resolved, and left out of the surfaces
const CLEAR = 0.18; // longer ones are the fainter
const STRENGTH = flight.most.circulation > 0 ? 0.09 * flight.most.circulation : 1; // of a filament that is drawn fully [m2/s]
const PER_AREA = SCALE * SCALE; // m2 to square wing lengths
const CORE = 2.4; // level of the inner surface over that of the outer

// Every filament of a frame that is young enough: ends, difference of the rings' circulations either
// side, age in rows, step in which it was shed, wing that shed it. The front edge of the newest row is bound: not drawn.
// Edges along which the sheets of joined wings are one carry their common circulation, once.
function eachFilament(frame, step, oldest, use) {
  const joint = (id, c, side) => {
    const pair = flight.joined.find((p) => p[side][0] === id && p[side][1] === c), other = pair && pair[1 - side];
    return pair && { sheet: frame.sheets.find((s) => s.id === other[0]), column: other[1] };
  };
  const reaches = (one, r) => one && one.sheet && r < one.sheet.rows;
  const across = ({ sheet: s, column: c }, r) => (c < s.cols ? frame.rings[s.ring + r * s.cols + c] : 0) - (c > 0 ? frame.rings[s.ring + r * s.cols + c - 1] : 0);
  let node = 0, ring = 0;
  for (const { cols, rows, wing, id } of frame.sheets) {
    const first = [], second = []; // what edges of this sheet are one with: as the first of a pair, as the second
    if (flight.joined.length) for (const c of [0, cols]) { first[c] = joint(id, c, 0); second[c] = joint(id, c, 1); }
    const n = cols + 1, g = (r, c) => (r < 0 || r >= rows || c < 0 || c >= cols ? 0 : frame.rings[ring + r * cols + c]);
    for (let r = 0; r <= Math.min(rows, Math.ceil(oldest)); r++) for (let c = 0; c <= cols; c++) {
      const a = 3 * (node + r * n + c);
      if (r < rows && !reaches(second[c], r)) use(a, a + 3 * n, g(r, c) - g(r, c - 1) + (reaches(first[c], r) ? across(first[c], r) : 0), r + 0.5, step - r, wing);
      // The last row that is shown is not the last there is, where older rows are left out.
      if (c < cols && r > 0 && r < rows) use(a, a + 3, g(r - 1, c) - g(r, c), r, step - r, wing);
    }
    node += (rows + 1) * n;
    ring += rows * cols;
  }
}
const youthOf = (age) => { const x = 1 - age / (state.age * BEAT); return x <= 0 ? 0 : Math.pow(x, 1.5); };
// What a filament is coloured by: 1 downstroke, newest, or spin to the left; 0 the opposite.
function shareOf(step, age, left, wing) {
  if (state.colour === "stroke") return downOf(step, wing) ? 1 : 0;
  return state.colour === "age" ? 1 - Math.min(1, age / (state.age * BEAT)) : left;
}

// ---- smoke ----
const MOST_PUFFS = 40000;
const smoke = renderer && (() => {
  const g = new THREE.BufferGeometry();
  for (const [name, size] of [["position", 3], ["dye", 4], ["size", 1]]) g.setAttribute(name, new THREE.BufferAttribute(new Float32Array(size * MOST_PUFFS), size));
  const material = new THREE.ShaderMaterial({
    transparent: true, depthWrite: false, premultipliedAlpha: true, blending: THREE.CustomBlending, blendSrc: THREE.OneFactor, blendDst: THREE.OneMinusSrcAlphaFactor,
    uniforms: { height: { value: 1 }, opacity: { value: 1 }, cover: { value: 1 } },
    vertexShader: "attribute vec4 dye;attribute float size;varying vec4 vc;uniform float height;void main(){vec4 p=modelViewMatrix*vec4(position,1.);gl_Position=projectionMatrix*p;gl_PointSize=min(160.,size*projectionMatrix[1][1]*height/-p.z);vc=dye;}",
    fragmentShader: "varying vec4 vc;uniform float opacity,cover;void main(){vec2 d=gl_PointCoord*2.-1.;float r=dot(d,d);if(r>1.)discard;float a=max(0.,(exp(-3.5*r)-.03)*vc.a*opacity);gl_FragColor=vec4(vc.rgb*a,a*cover);}",
  });
  sized.push((_, h) => { material.uniforms.height.value = h; });
  const points = new THREE.Points(g, material);
  points.frustumCulled = false;
  points.renderOrder = 2;
  scene.add(points);
  return points;
})();
const filaments = renderer && hasWake && new Segments(24000, { order: 3, soft: true, thinnest: 1.3 });

// Smoke and filaments of a frame; returns how many puffs there are.
function drawFilaments(k) {
  const frame = unpack(k), step = flight.frames[k].step, dye = wakeDye(state.colour), P = frame.wake, share = isDark() ? 1 : 0.7;
  const { position: { array: place }, dye: { array: paint }, size: { array: size } } = smoke.geometry.attributes;
  let n = 0;
  const puff = (x, y, z, colour, alpha, width) => {
    if (n >= MOST_PUFFS) return;
    place.set([x, y, z], 3 * n); paint.set(colour, 4 * n); paint[4 * n + 3] = alpha; size[n] = width; n++;
  };
  filaments?.begin();
  const smoky = state.smoke && !hurried;
  if (smoky || state.filaments) eachFilament(frame, step, state.age * BEAT, (a, b, g, age, shed, wing) => {
    const dx = P[b] - P[a], dy = P[b + 1] - P[a + 1], dz = P[b + 2] - P[a + 2], length = Math.hypot(dx, dy, dz);
    const strong = Math.min(1, Math.abs(g) / STRENGTH), s = strong * youthOf(age) * Math.min(1, CLEAR / length);
    if (!(length > 1e-6) || s < 0.01) return;
    const colour = dye(shareOf(shed, age, spinOf(g * dy, length, g), wing));
    if (state.filaments && s > 0.015) filaments.add(P.subarray(a, a + 3), P.subarray(b, b + 3), colour, [Math.min(0.9, 0.6 * s), Math.min(0.9, 0.6 * s)], [0.005 + 0.012 * strong, 0.005 + 0.012 * strong]);
    if (!smoky) return;
    const parts = Math.min(4, Math.max(1, Math.ceil(length / 0.056)));
    for (let i = 0; i < parts; i++) {
      const t = (i + 0.5) / parts;
      puff(P[a] + t * dx, P[a + 1] + t * dy, P[a + 2] + t * dz, colour, 0.075 * Math.sqrt(s) * Math.min(1, length / parts / 0.04) * share, 0.064 + 0.064 * age / BEAT);
    }
  });
  if (smoky && flight.most.strength > 0) for (let i = 0; i < frame.particles.length / 3; i++) {
    const s = Math.min(1, Math.hypot(...frame.strengths.subarray(3 * i, 3 * i + 3)) / flight.most.strength);
    puff(frame.particles[3 * i], frame.particles[3 * i + 1], frame.particles[3 * i + 2], rgb(theme.plain), 0.06 * Math.sqrt(s) * share, 0.1);
  }
  filaments?.end();
  smoke.geometry.setDrawRange(0, n);
  for (const a of Object.values(smoke.geometry.attributes)) { a.clearUpdateRanges(); a.addUpdateRange(0, a.itemSize * n); a.needsUpdate = true; }
  return n;
}
// Sense of the spin about the lateral axis, 1 to the left: strengthLeft is its lateral part.
const spinOf = (strengthLeft, length, g) => 0.5 + 0.5 * Math.sign(strengthLeft) * Math.min(1, 1.5 * Math.abs(strengthLeft) / (Math.abs(g) * length || 1));

// ---- surfaces ----
// Vorticity of a frame as points: filaments cut into pieces shorter than their width.
function vorticityOf(k, sigma) {
  const frame = unpack(k), step = flight.frames[k].step, P = frame.wake, out = [];
  eachFilament(frame, step, state.age * BEAT, (a, b, g, age, shed, wing) => {
    const d = [P[b] - P[a], P[b + 1] - P[a + 1], P[b + 2] - P[a + 2]], length = Math.hypot(...d), youth = youthOf(age);
    if (youth <= 0 || length > LONGEST || length < 1e-6 || Math.abs(g) < 0.06 * STRENGTH) return;
    const parts = Math.min(10, Math.max(1, Math.ceil(length / (1.2 * sigma)))), share = shareOf(shed, age, spinOf(g * d[1], length, g), wing), w = g * PER_AREA / parts;
    for (let i = 0; i < parts; i++) { const t = (i + 0.5) / parts; out.push(P[a] + t * d[0], P[a + 1] + t * d[1], P[a + 2] + t * d[2], w * d[0], w * d[1], w * d[2], share, youth); }
  });
  const n = frame.particles.length / 3, volume = PER_AREA * SCALE;
  for (let i = 0; i < n; i++) {
    const w = [0, 1, 2].map((c) => frame.strengths[3 * i + c] * volume), size = Math.hypot(...w);
    out.push(...frame.particles.subarray(3 * i, 3 * i + 3), ...w, state.colour === "age" ? 0.2 : state.colour === "spin" ? spinOf(w[1], 1, size) : 0.5, 0.5);
  }
  return new Float32Array(out);
}
// One grid for the whole flight, so that its surfaces do not flicker: fine enough for the largest wake.
const gridCell = (() => {
  if (!renderer || !hasWake) return CELL;
  let most = 0;
  for (const part of [0.25, 0.5, 0.75, 1]) {
    const points = vorticityOf(Math.round(part * LAST), SIGMA), low = [9, 9, 9], high = [-9, -9, -9], c = centreOf(Math.round(part * LAST));
    for (let i = 0; i < points.length; i += 8) for (let a = 0; a < 3; a++) { const x = Math.max(-BOX, Math.min(BOX, points[i + a] - c[a])); low[a] = Math.min(low[a], x); high[a] = Math.max(high[a], x); }
    most = Math.max(most, [0, 1, 2].reduce((v, a) => v * Math.max(0.5, high[a] - low[a] + 6 * SIGMA), 1));
  }
  return Math.max(CELL, Math.cbrt(most / MOST_CELLS));
})();
const gridSigma = Math.max(SIGMA, 1.2 * gridCell);
// The usual level of |omega| [1/s]: a third of the circulation over wing length and width.
const usualLevel = 0.3 * flight.most.circulation * PER_AREA / gridSigma;
const levelNow = () => usualLevel * state.level;

const surfacesMade = new Map(); // what was asked for -> surfaces
const MOST_MADE = 48;
const asker = (() => {
  if (!renderer || !hasWake) return null;
  try {
    const source = byId("vortices").textContent + byId("worker").textContent;
    const worker = new Worker(URL.createObjectURL(new Blob([source], { type: "text/javascript" })));
    worker.onerror = () => { asked.worker = null; };
    return worker;
  } catch (e) { return null; }
})();
const asked = { worker: asker, busy: null, next: null, took: 50 };
const surfaceKey = (k) => [k, state.colour, state.age, state.level].join(" ");
function question(k) {
  const c = centreOf(k), factor = (CELL / gridCell) ** 2;
  return {
    id: surfaceKey(k), points: vorticityOf(k, gridSigma), levels: [levelNow(), CORE * levelNow()], least: [220 * factor, 90 * factor],
    grid: { h: gridCell, sigma: gridSigma, low: c.map((x) => x - BOX), high: c.map((x) => x + BOX), most: 160 },
  };
}
function keep(id, surfaces) {
  if (surfacesMade.size >= MOST_MADE) surfacesMade.delete(surfacesMade.keys().next().value);
  surfacesMade.set(id, surfaces);
}
// Asks for the surfaces of a frame; of several that wait, only the last is made.
function ask(k) {
  const id = surfaceKey(k);
  if (surfacesMade.has(id) || asked.busy === id) return;
  if (!asked.worker) { keep(id, vortices(question(k)).surfaces); return; }
  if (asked.busy) { asked.next = k; return; }
  const q = question(k);
  asked.busy = id; asked.next = null;
  asked.worker.onmessage = ({ data }) => {
    asked.busy = null;
    asked.took = 0.7 * asked.took + 0.3 * data.took;
    keep(data.id, data.surfaces);
    if (asked.next !== null) ask(asked.next);
    redraw();
  };
  asked.worker.postMessage(q, [q.points.buffer]);
}
const shells = renderer && hasWake ? [[9, 10], [8, 8]].map(([first, order], inner) => {
  const g = new THREE.BufferGeometry();
  const vertex = "attribute vec4 dye;varying vec3 n,v;varying vec4 vc;void main(){vec4 p=modelViewMatrix*vec4(position,1.);n=normalMatrix*normal;v=-p.xyz;vc=dye;gl_Position=projectionMatrix*p;}";
  const uniforms = { opacity: { value: 1 }, rim: { value: new THREE.Vector2() }, dark: { value: 1 } };
  const skin = (dim, stencilFunc) => new THREE.ShaderMaterial({
    transparent: true, depthWrite: false, depthFunc: THREE.LessEqualDepth, side: THREE.DoubleSide, premultipliedAlpha: true, blending: THREE.CustomBlending, blendSrc: THREE.OneFactor, blendDst: THREE.OneMinusSrcAlphaFactor,
    uniforms: { ...uniforms, dim: { value: dim } }, vertexShader: vertex, ...ANIMAL, stencilFunc,
    fragmentShader: `varying vec3 n,v;varying vec4 vc;uniform float opacity,dark,dim;uniform vec2 rim;void main(){vec3 N=normalize(n),V=normalize(v);float f=abs(dot(N,V));if(dot(N,V)<0.)N=-N;float r=pow(1.-f,1.8);
      vec3 L=normalize(vec3(-.35,.75,.6));float d=.5+.5*dot(N,L);float sp=pow(max(0.,dot(reflect(-L,N),V)),40.);
      vec3 c=vc.rgb*mix(mix(.62,.85,dark),1.08,d);c=dark>.5?c*(.55+.55*d)+r*.35*vc.rgb:mix(c,c*.55,r);c+=sp*.25;
      float a=opacity*dim*vc.a*mix(rim.x,rim.y,r);gl_FragColor=vec4(min(c,vec3(1.))*a,a*mix(1.,.45,dark));}`,
  });
  // First the depth alone, then the front skin: no fog of skins behind each other. Over the animal, less.
  const before = new THREE.ShaderMaterial({ transparent: true, colorWrite: false, side: THREE.DoubleSide, vertexShader: vertex, fragmentShader: "void main(){gl_FragColor=vec4(1.);}" });
  const meshes = [...(inner ? [] : [[first, before]]), [order, skin(1, THREE.NotEqualStencilFunc)], [order, skin(0.4, THREE.EqualStencilFunc)]].map(([renderOrder, material]) => {
    const m = new THREE.Mesh(g, material);
    m.renderOrder = renderOrder; m.frustumCulled = false; m.visible = false;
    scene.add(m);
    return m;
  });
  return { g, meshes, uniforms, shown: "" };
}) : [];
// Shows the surfaces of a frame, or the last ones until they are made; returns their vertices.
function drawSurfaces(k) {
  if (!shells.length) return 0;
  const visible = state.vortices && usualLevel > 0 && state.opacity > 0;
  if (visible) {
    ask(k);
    const ahead = state.playing ? Math.min(LAST, k + Math.max(1, Math.ceil(asked.took / 1e3 * framesPerSecond()))) : k;
    if (asked.worker && surfacesMade.has(surfaceKey(k))) ask(ahead);
  }
  const id = surfaceKey(k), made = surfacesMade.get(id);
  shells.forEach((shell, i) => {
    shell.meshes.forEach((m) => { m.visible = visible && shell.shown !== ""; });
    if (!visible || !made || shell.shown === id + state.theme) return;
    const s = made[i], dye = wakeDye(state.colour), paint = new Float32Array(4 * s.shares.length);
    s.shares.forEach((share, v) => { paint.set(dye(share), 4 * v); paint[4 * v + 3] = s.youths[v]; });
    shell.g.setAttribute("position", new THREE.BufferAttribute(s.places, 3));
    shell.g.setAttribute("normal", new THREE.BufferAttribute(s.normals, 3));
    shell.g.setAttribute("dye", new THREE.BufferAttribute(paint, 4));
    shell.g.setIndex(new THREE.BufferAttribute(s.faces, 1));
    shell.shown = id + state.theme;
    shell.meshes.forEach((m) => { m.visible = true; });
  });
  return visible && made ? made[0].shares.length : 0;
}
function dressWake() {
  smoke.material.uniforms.cover.value = theme.cover;
  if (filaments) filaments.material.blending = isDark() ? THREE.AdditiveBlending : THREE.NormalBlending;
  shells.forEach((s, inner) => { s.uniforms.dark.value = isDark() ? 1 : 0; s.uniforms.rim.value.set(...(inner ? theme.core : theme.rim)); });
}
function opaqueWake() {
  smoke.material.uniforms.opacity.value = state.opacity;
  if (filaments) filaments.material.uniforms.opacity.value = state.opacity;
  shells.forEach((s) => { s.uniforms.opacity.value = state.opacity; });
}
