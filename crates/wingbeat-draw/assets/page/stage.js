// The stage: renderer, camera, light, ground, and the shapes that the others draw with.
const REACH = LAST < 0 ? 1 : reach(); // radius of the animal, wing lengths
function reach() {
  const centre = centreOf(0), far = (p) => Math.hypot(p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]);
  let most = 0.4;
  const p = unpack(0).wings;
  for (let i = 0; i < p.length; i += 3) most = Math.max(most, far([p[i], p[i + 1], p[i + 2]]));
  for (const s of flight.solids) for (const node of s.nodes) most = Math.max(most, far(placed(0, s.body, node)));
  return most;
}
// A point of a body in a frame.
function placed(k, body, node) {
  const { place, turn: [x, y, z, w] } = poseOf(k, body), [a, b, c] = node.map((v) => v * SCALE);
  const t = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * t[0] + y * t[2] - z * t[1] + place[0], b + w * t[1] + z * t[0] - x * t[2] + place[1], c + w * t[2] + x * t[1] - y * t[0] + place[2]];
}
// Middle of the central body.
var bodyMiddle; // in its axes [m]
function centreOf(k) {
  if (!bodyMiddle) {
    const nodes = flight.solids.filter((s) => s.body === 0).flatMap((s) => s.nodes);
    bodyMiddle = [0, 1, 2].map((c) => (nodes.length ? 0.5 * (Math.min(...nodes.map((p) => p[c])) + Math.max(...nodes.map((p) => p[c]))) : 0));
  }
  return placed(k, 0, bodyMiddle);
}

const stage = byId("stage"), canvas = byId("gl");
const renderer = (() => {
  if (LAST < 0) return null;
  try { return new THREE.WebGLRenderer({ canvas, antialias: true, stencil: true, powerPreference: "high-performance" }); } catch (e) { return null; }
})();
const scene = renderer && new THREE.Scene(), camera = renderer && new THREE.PerspectiveCamera(30, 1, 0.05, 200);
const orbit = renderer && new THREE.OrbitControls(camera, canvas);
const sized = []; // shaders that need the size of the stage in pixels
const GROUND = -Math.max(2.4, 1.9 * REACH);
let ground = null, room = null;
const rooms = new Map(); // theme -> what bodies and wings mirror: made once, it takes longer than all other drawing
if (renderer) {
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  renderer.toneMappingExposure = 0.95;
  camera.up.set(0, 0, 1);
  orbit.enableDamping = false;
  const key = new THREE.DirectionalLight("#fff3df", 1.7), rim = new THREE.DirectionalLight("#9ccbff", 1.5);
  key.position.set(3, -4, 6); rim.position.set(-5, 4, 2);
  scene.add(key, rim, new THREE.HemisphereLight("#dfeaff", "#6b5a48", 0.35));
  room = new THREE.PMREMGenerator(renderer);
  ground = makeGround();
}

// A room of soft boxes, which bodies and wings mirror.
function roomScene() {
  const s = new THREE.Scene();
  s.background = new THREE.Color(theme.roomColour);
  for (const [colour, light, place, size] of [["#fff4e2", 14, [3, -5, 7], 5], ["#cfe4ff", 6, [-7, 4, 3], 5], ["#ffffff", 5, [6, 6, 1], 3], ["#ffe0b8", 2.5, [0, 0, -8], 6]]) {
    const box = new THREE.Mesh(new THREE.PlaneGeometry(size, size), new THREE.MeshBasicMaterial({ color: new THREE.Color(colour).multiplyScalar(light), side: THREE.DoubleSide }));
    box.position.set(...place); box.lookAt(0, 0, 0); s.add(box);
  }
  return s;
}
function skyTexture() {
  const c = document.createElement("canvas"), g = c.getContext("2d"), ramp = g.createLinearGradient(0, 0, 0, 256);
  c.width = 16; c.height = 256;
  ramp.addColorStop(0, theme.sky[0]); ramp.addColorStop(1, theme.sky[1]);
  g.fillStyle = ramp; g.fillRect(0, 0, 16, 256);
  const t = new THREE.CanvasTexture(c);
  t.colorSpace = THREE.SRGBColorSpace;
  return t;
}
function makeGround() {
  const cell = roundDown(0.45 * flight.length_m) * SCALE;
  const material = new THREE.ShaderMaterial({
    transparent: true, depthWrite: false, side: THREE.DoubleSide,
    uniforms: { colour: { value: new THREE.Color() }, share: { value: 0.3 }, middle: { value: new THREE.Vector2() }, shadow: { value: 0.3 }, cell: { value: cell }, reach: { value: REACH } },
    vertexShader: "varying vec2 p;void main(){vec4 w=modelMatrix*vec4(position,1.);p=w.xy;gl_Position=projectionMatrix*viewMatrix*w;}",
    fragmentShader: `varying vec2 p;uniform vec3 colour;uniform float share,shadow,cell,reach;uniform vec2 middle;
      float line(float s,float w){vec2 g=abs(fract(p/s-.5)-.5)*s/fwidth(p);return 1.-min(1.,min(g.x,g.y)/w);}
      void main(){float d=length(p-middle),f=1.-smoothstep(1.2*reach,4.2*reach,d);float a=max(line(cell,1.)*.45,line(5.*cell,1.5))*f*share;
      float s=exp(-dot(p-middle,p-middle)/(.1*reach*reach))*shadow;gl_FragColor=vec4(mix(colour,vec3(0.),s/(s+a+1e-4)),a+s);}`,
  });
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(60 * REACH, 60 * REACH), material);
  mesh.renderOrder = 1;
  scene.add(mesh);
  return mesh;
}

// Segments with a width of their own in the scene, as quadrilaterals that face the camera.
class Segments {
  constructor(most, { order = 7, soft = false, thinnest = 1.1, depthTest = true } = {}) {
    this.most = most;
    const g = this.g = new THREE.InstancedBufferGeometry();
    g.setAttribute("position", new THREE.Float32BufferAttribute([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0], 3));
    g.setIndex([0, 1, 2, 0, 2, 3]);
    const list = (name) => { const a = new THREE.InstancedBufferAttribute(new Float32Array(4 * most), 4); a.setUsage(THREE.DynamicDrawUsage); g.setAttribute(name, a); return a.array; };
    [this.a, this.b, this.ca, this.cb] = ["a", "b", "ca", "cb"].map(list);
    this.material = new THREE.ShaderMaterial({
      transparent: true, depthWrite: false, depthTest,
      uniforms: { size: { value: new THREE.Vector2() }, thinnest: { value: thinnest }, soft: { value: soft ? 1 : 0 }, opacity: { value: 1 } },
      vertexShader: `attribute vec4 a,b,ca,cb;varying vec4 vc;varying float vs;uniform vec2 size;uniform float thinnest;
        void main(){vec4 A=projectionMatrix*viewMatrix*vec4(a.xyz,1.),B=projectionMatrix*viewMatrix*vec4(b.xyz,1.);vec4 P=mix(A,B,position.x);
        vec2 d=(B.xy/B.w-A.xy/A.w)*size;d=length(d)<1e-5?vec2(1,0):normalize(d);vec2 n=vec2(-d.y,d.x);
        float w=mix(a.w,b.w,position.x),px=w*projectionMatrix[1][1]*size.y*.5/P.w,al=1.;if(px<thinnest){al=max(px/thinnest,.35);px=thinnest;}
        P.xy+=(n*position.y+d*(position.x*2.-1.)*.35)*px/size*P.w;gl_Position=P;vs=position.y;vc=mix(ca,cb,position.x);vc.a*=al;}`,
      fragmentShader: "varying vec4 vc;varying float vs;uniform float soft,opacity;void main(){float k=soft>.5?exp(-4.*vs*vs):1.-smoothstep(.55,1.,abs(vs));gl_FragColor=vec4(vc.rgb,vc.a*k*opacity);}",
    });
    sized.push((w, h) => this.material.uniforms.size.value.set(w, h));
    this.mesh = new THREE.Mesh(g, this.material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = order;
    scene.add(this.mesh);
  }
  begin() { this.n = 0; }
  // From p to r: colours, opacities and widths of both ends.
  add(p, r, colour, [a0, a1], [w0, w1]) {
    if (this.n >= this.most) return;
    const k = 4 * this.n++;
    this.a.set(p, k); this.a[k + 3] = w0; this.b.set(r, k); this.b[k + 3] = w1;
    this.ca.set(colour, k); this.ca[k + 3] = a0; this.cb.set(colour, k); this.cb[k + 3] = a1;
  }
  end() {
    this.g.instanceCount = this.n;
    for (const name of ["a", "b", "ca", "cb"]) { const a = this.g.attributes[name]; a.clearUpdateRanges(); a.addUpdateRange(0, 4 * this.n); a.needsUpdate = true; }
  }
}

// ---- views: direction to the camera, distance, height of the target over the body ----
// The wake of the last frame is looked at, too: where its younger part is, from the body, and how far it goes.
const wakeAt = (() => {
  if (!hasWake || LAST < 0) return { middle: [0, 0, 0], extent: 0 };
  const { wake, sheets, particles } = unpack(LAST), c = centreOf(LAST), near = [];
  let first = 0;
  for (const { cols, rows } of sheets) {
    const young = Math.min(rows, Math.round(state.age * BEAT));
    for (let i = 3 * first; i < 3 * (first + (young + 1) * (cols + 1)); i += 3) near.push([wake[i] - c[0], wake[i + 1] - c[1], wake[i + 2] - c[2]]);
    first += (rows + 1) * (cols + 1);
  }
  if (!sheets.length) for (let i = 0; i < particles.length; i += 3) near.push([particles[i] - c[0], particles[i + 1] - c[1], particles[i + 2] - c[2]]);
  const far = near.map((p) => Math.hypot(...p)).sort((a, b) => a - b), limit = 1.5 * REACH, clip = (x) => Math.max(-limit, Math.min(limit, x));
  return { middle: [0, 1, 2].map((k) => (k === 1 ? 0 : clip(0.5 * near.reduce((s, p) => s + p[k] / near.length, 0)))), extent: Math.min(3 * REACH, far[Math.floor(0.7 * far.length)] || 0) };
})();
const FAR = 4.9 * Math.max(hasWake ? REACH : 0.8 * REACH, 0.62 * wakeAt.extent);
// Direction to the camera, distance, share of the way to the wake at which it looks.
const VIEWS = { quarter: [[0.62, -0.7, 0.26], 1, 1], side: [[0, -1, 0.04], 1, 1], front: [[1, 0, 0.04], 1.04, 1], top: [[-0.02, 0, 1], 1.04, 1], wake: [[-0.55, -0.75, 0.18], 1.5, 2] };
function setView(name) {
  state.view = name;
  document.querySelectorAll("[data-view]").forEach((b) => b.setAttribute("aria-pressed", b.dataset.view === name));
  if (!renderer) return flatView(name);
  const [direction, far, share] = VIEWS[name], c = centreOf(frameNow()), d = Math.hypot(...direction), narrow = camera.aspect < 1.1 ? 1.25 : 1;
  orbit.target.set(...c.map((x, k) => x + share * wakeAt.middle[k]));
  camera.position.set(...[0, 1, 2].map((k) => orbit.target.getComponent(k) + direction[k] / d * FAR * far * narrow));
  orbit.update();
  redraw();
}
function dressStage() {
  scene.background = skyTexture();
  if (!rooms.has(theme)) rooms.set(theme, room.fromScene(roomScene(), 0.04).texture);
  scene.environment = rooms.get(theme);
  scene.environmentIntensity = theme.room;
  const u = ground.material.uniforms;
  u.colour.value.setRGB(...rgb(theme.grid)); u.share.value = theme.gridShare; u.shadow.value = theme.shadow;
}
let pixelRatio = Math.min(window.devicePixelRatio || 1, 2), stageSize = "";
function resizeStage() {
  const w = Math.max(1, stage.clientWidth), h = Math.max(1, stage.clientHeight), size = [w, h, pixelRatio].join();
  if (size === stageSize) return;
  stageSize = size;
  renderer.setPixelRatio(pixelRatio);
  renderer.setSize(w, h, false);
  camera.aspect = w / h;
  camera.updateProjectionMatrix();
  sized.forEach((f) => f(w * pixelRatio, h * pixelRatio));
  if (drawn >= 0) renderer.render(scene, camera); // a new size empties the canvas: it is never shown so
}
