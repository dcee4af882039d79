// What explains the picture: paths, arrows of force, scale bar, axes, legend, clock.
const TRAIL_FRAMES = Math.max(2, Math.min(400, LAST < 1 ? 2 : Math.round(BEAT / Math.max(1, flight.frames[1].step - flight.frames[0].step))));
const paths = renderer && new Segments(Math.max(16, WINGS.length * TRAIL_FRAMES + Math.min(LAST + 1, 2000)), { order: 5 });
const shafts = renderer && new Segments(40, { order: 11, depthTest: false });
const heads = [];
function arrowHead(i) {
  if (!heads[i]) {
    heads[i] = new THREE.Mesh(new THREE.ConeGeometry(0.044, 0.12, 24), new THREE.MeshBasicMaterial({ depthTest: false, transparent: true, toneMapped: false }));
    heads[i].renderOrder = 11;
    scene.add(heads[i]);
  }
  return heads[i];
}
function drawPaths(k) {
  paths.begin();
  if (state.trail) {
    const first = Math.max(0, k - TRAIL_FRAMES), colour = rgb(theme.trail);
    let before = tipsOf(first);
    for (let j = first + 1; j <= k; j++) {
      const now = tipsOf(j), fade = (n) => 0.9 * Math.max(0, 1 - (k - n) / TRAIL_FRAMES);
      now.forEach((p, w) => paths.add(before[w], p, colour, [fade(j - 1), fade(j)], [0.004, 0.004]));
      before = now;
    }
    const stride = Math.max(1, Math.ceil(k / 1800)), way = rgb(theme.path);
    for (let j = stride; j <= k; j += stride) paths.add(centreOf(j - stride), centreOf(j), way, [0.5, 0.5], [0.004, 0.004]);
  }
  paths.end();
}
// A force over what an arrow of one length stands for: the weight, or the usual force of the flight.
const forceUnit = flight.weight_newton > 0 && flight.most.force < 50 * flight.weight_newton ? flight.weight_newton : flight.most.force;
const forceWords = (size) => (forceUnit === flight.weight_newton ? digits(size / forceUnit) + " × weight" : withPrefix(size, "N"));
let arrowLabel = null; // of the largest arrow: where and what
// Arrows of force: whence, how large [N], the way to the tip; small forces have none.
function forceArrows(k) {
  const f = flight.frames[k].forces, arrows = [];
  if (state.force === "total" && f.length) arrows.push([centreOf(k), totalForce(k)]);
  if (state.force === "each") WINGS.forEach((w) => {
    const p = unpack(k).wings.subarray(3 * w.first, 3 * (w.first + w.nodes)), c = [0, 0, 0];
    for (let i = 0; i < p.length; i++) c[i % 3] += p[i] / w.nodes;
    if (f[w.body]) arrows.push([c, f[w.body]]);
  });
  const alone = arrows.length === 1, most = Math.max(...arrows.map(([, force]) => Math.hypot(...force)));
  return arrows.map(([from, force]) => {
    const size = Math.hypot(...force), length = Math.min(1.3, size / flight.most.force) * 0.6 * REACH;
    return { from, size, alone, isLargest: size === most, way: force.map((x) => length * x / size) };
  }).filter(({ size }) => size > (alone ? 0.3 : 0.15) * forceUnit);
}
function drawForces(k) {
  const colour = rgb(theme.force);
  arrowLabel = null;
  shafts.begin();
  let n = 0;
  for (const { from, size, way, isLargest } of forceArrows(k)) {
    const length = Math.hypot(...way), d = way.map((x) => x / length), tip = from.map((x, c) => x + way[c]), head = arrowHead(n++);
    shafts.add(from, tip, colour, [0.95, 0.95], [0.014, 0.014]);
    head.visible = true;
    head.material.color.set(theme.force);
    head.position.set(...tip.map((x, c) => x + 0.04 * d[c]));
    head.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), new THREE.Vector3(...d));
    if (isLargest) arrowLabel = { at: tip.map((x, c) => x + 0.13 * d[c]), text: forceWords(size) };
  }
  for (let i = n; i < heads.length; i++) heads[i].visible = false;
  shafts.end();
}
// A place in the scene on the stage [CSS pixels].
function onStage(p) {
  const v = new THREE.Vector3(...p).project(camera);
  return [(0.5 + 0.5 * v.x) * stage.clientWidth, (0.5 - 0.5 * v.y) * stage.clientHeight];
}
// Length of the scale bar: words and pixels.
function scaleBar() {
  const far = renderer ? camera.position.distanceTo(new THREE.Vector3(...centreOf(frameNow()))) : 1;
  const perLength = renderer ? stage.clientHeight / (2 * far * Math.tan(camera.fov * Math.PI / 360)) : flat.scale;
  const length = roundDown(130 / perLength * flight.length_m);
  return { pixels: length * SCALE * perLength, words: lengthWords(length) };
}
// Directions of the scene as the camera sees them: right, up, toward it.
function seen(v) {
  if (!renderer) return flatSeen(v);
  const d = new THREE.Vector3(...v).transformDirection(camera.matrixWorldInverse);
  return [d.x, d.y, d.z];
}
const AXES = [["x", [1, 0, 0], "#ff6b5e"], ["y", [0, 1, 0], "#53c66b"], ["z", [0, 0, 1], "#5aa2ff"]];
function drawOverlay() {
  const { pixels, words } = scaleBar();
  byId("bar").style.width = pixels + "px";
  byId("bar-words").textContent = words;
  const o = [46, 50], at = (v) => { const d = seen(v); return [o[0] + 27 * d[0], o[1] - 27 * d[1], d[2]]; };
  const axes = AXES.map(([name, v, colour]) => ({ name, colour, p: at(v) })).sort((a, b) => a.p[2] - b.p[2]);
  let svg = axes.map(({ name, colour, p }) => `<line x1="${o[0]}" y1="${o[1]}" x2="${p[0]}" y2="${p[1]}" stroke="${colour}" stroke-width="2.4" stroke-linecap="round"/><text x="${o[0] + 1.34 * (p[0] - o[0])}" y="${o[1] + 1.34 * (p[1] - o[1]) + 3.5}" text-anchor="middle" fill="${colour}">${name}</text>`).join("");
  if (flight.weight_newton > 0) {
    const [gx, gy] = at(flight.down.map((x) => 0.85 * x)), d = Math.hypot(gx - o[0], gy - o[1]) || 1, ux = (gx - o[0]) / d, uy = (gy - o[1]) / d;
    if (d > 5) svg += `<line x1="${o[0]}" y1="${o[1]}" x2="${gx}" y2="${gy}" stroke="currentColor" stroke-width="1.6" stroke-dasharray="3 2.5"/><path d="M${gx - 4 * uy - 3 * ux} ${gy + 4 * ux - 3 * uy}L${gx + 5 * ux} ${gy + 5 * uy}L${gx + 4 * uy - 3 * ux} ${gy - 4 * ux - 3 * uy}z" fill="currentColor"/><text x="${gx + 10}" y="${gy + 4}" fill="currentColor" font-style="italic">g</text>`;
  }
  byId("triad").innerHTML = svg;
  const label = byId("force-words");
  label.hidden = !arrowLabel || !renderer;
  if (!label.hidden) placeLabel(label);
}
// The words of the force beside the tip of the arrow, or as near above or below as nothing else stands.
function placeLabel(label) {
  label.textContent = arrowLabel.text;
  const [x, y] = onStage(arrowLabel.at), stands = stage.getBoundingClientRect(), w = label.offsetWidth, half = label.offsetHeight / 2 + 1;
  const left = Math.max(0, Math.min(x + 10, stands.width - w - 6)), right = left + w;
  const others = ["#clock", "#views > *", "#note", "#legend > *", "#scale", "#triad"].flatMap((s) => [...stage.querySelectorAll(s)]).map((e) => e.getBoundingClientRect())
    .filter((r) => r.width && r.left - stands.left < right && r.right - stands.left > left).map((r) => [r.top - stands.top, r.bottom - stands.top]);
  const free = (m) => m >= half && m <= stands.height - half && others.every(([top, bottom]) => m + half <= top || m - half >= bottom);
  const middle = [y, ...others.flatMap(([top, bottom]) => [top - half, bottom + half])].filter(free).sort((a, b) => Math.abs(a - y) - Math.abs(b - y))[0];
  label.style.left = left + "px";
  label.style.top = (middle ?? y) + "px";
  label.style.visibility = middle === undefined ? "hidden" : "";
}
// What the colours of pressure are, from end to end: bodies have one side in the air.
function pressureWords() {
  const bodies = flight.body_pressures && flight.solids.some((s) => s.first_panel !== null && s.quads.length), most = digits(flight.most.pressure), beyond = flight.frames.some((f) => f.pressure > flight.most.pressure);
  return `${bodies && !wingNodes ? "ambient less outer pressure" : "pressure jump"} −${most} to ${most} Pa${beyond ? ", full colour beyond" : ""}${bodies && wingNodes ? "; of bodies ambient less outer pressure" : ""}`;
}
// What the colours mean: swatches and ramps, as [words, colours].
function legend() {
  const list = [];
  if (hasWake && (state.vortices || state.smoke || state.filaments)) {
    if (state.colour === "age") list.push([`wake: ${ageWords(state.age)} old to new`, theme.ages]);
    else if (state.colour === "spin") list.push(["spin to the right", [theme.up]], ["spin to the left", [theme.down]]);
    else list.push(["shed in the upstroke", [theme.up]], ["in the downstroke", [theme.down]]);
    if (state.colour !== "age" && flight.frames.some((f) => f.particles)) list.push(["vortex particles", [theme.plain]]);
  }
  if (state.pressure && PANELS && flight.most.pressure > 0) list.push([pressureWords(), [theme.low, theme.zero, theme.high]]);
  if (flight.solids.some((s) => s.stand_in)) list.push(["no shape given: ellipsoid of mass and inertia", [theme.standIn]]);
  return list;
}
function drawLegend() {
  byId("legend").replaceChildren(...legend().map(([words, colours]) => {
    const span = document.createElement("span"), swatch = document.createElement("i");
    swatch.className = colours.length > 1 ? "ramp" : "";
    swatch.style.background = colours.length > 1 ? `linear-gradient(90deg,${colours.join()})` : colours[0];
    span.append(swatch, words);
    return span;
  }));
}
// Where wings beat apart, their strokes have a line of their own.
const BEAT_APART = flight.frames.some((_, k) => strokesOf(k).length > 1);
stage.classList.toggle("apart", BEAT_APART);
function drawClock(k) {
  const f = flight.frames[k], clock = byId("clock"), strokes = document.createElement("span");
  shortStrokes(k).forEach(([words, stroke], n) => {
    const span = document.createElement("span");
    span.className = { downstroke: "down", upstroke: "up" }[stroke];
    span.textContent = words;
    strokes.append(n ? ", " : BEAT_APART ? "" : " · ", span);
  });
  strokes.className = "strokes";
  clock.innerHTML = (flight.period ? `<b>${(f.time / flight.period).toFixed(2)}</b> beats · ` : "") + timeWords(f.time);
  clock.append(strokes);
}
