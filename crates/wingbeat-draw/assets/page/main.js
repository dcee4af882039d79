// Ties everything together: words, controls, keys, one frame everywhere.
byId("name").textContent = flight.name;
byId("verdict").textContent = flight.verdict;
byId("verdict").title = flight.verdict_reason;
byId("verdict").dataset.level = flight.verdict;
byId("outcome").textContent = flight.outcome;
byId("outcome").classList.toggle("alarm", !flight.is_whole);
byId("about").textContent = [flight.description, "wingbeat " + flight.version].filter(Boolean).join(" · ");
byId("summary").replaceChildren(...blocks(flight.summary));
// Prose is broken where it must; lines with columns are not, and scroll together.
function blocks(text) {
  const list = [];
  for (const line of text.trimEnd().split("\n")) {
    const kind = /\S {3,}\S/.test(line) ? "columns" : "prose", last = list[list.length - 1];
    if (last?.className === kind) { last.textContent += "\n" + line; continue; }
    const block = document.createElement("pre");
    block.className = kind; block.textContent = line;
    if (kind === "columns") block.tabIndex = 0;
    list.push(block);
  }
  return list;
}
byId("case").textContent = flight.case;
byId("thinned").textContent = flight.thinned + ".";
const notes = [];
if (flight.failed) notes.push("This flight ended early: " + flight.failed);
if (LAST < 0) notes.push("There is no step to show.");
else if (!renderer) notes.push("This browser cannot draw in 3-D (no WebGL): the scene is drawn flat.");
byId("note").textContent = notes.join(" ");
byId("note").hidden = notes.length === 0;

let drawn = -1;
function drawAll() {
  if (LAST < 0) { drawPlots(); return; }
  const k = frameNow(), data = byId("state").dataset;
  let puffs = 0, vertices = 0;
  if (renderer) {
    if (drawn >= 0 && state.follow && k !== drawn) {
      const shift = new THREE.Vector3(...centreOf(k)).sub(new THREE.Vector3(...centreOf(drawn)));
      camera.position.add(shift); orbit.target.add(shift);
    }
    const c = centreOf(k);
    ground.position.set(c[0], c[1], GROUND + groundUnder(c[2]));
    ground.material.uniforms.middle.value.set(c[0], c[1]);
    poseBodies(k); drawWings(k);
    puffs = hasWake ? drawFilaments(k) : 0;
    vertices = drawSurfaces(k);
    opaqueWake(); drawPaths(k); drawForces(k);
    renderer.render(scene, camera);
    data.triangles = renderer.info.render.triangles;
  } else { drawFlat(k); data.triangles = "flat"; }
  drawn = k;
  drawClock(k); drawOverlay(); drawPlots(); drawTime();
  slider.value = k;
  slider.setAttribute("aria-valuetext", whenWords(k));
  if (!state.playing && byId("values-box").open) valueTable(k);
  if (recording()) { compose(); recorder.filmed(); }
  tell(k);
  Object.assign(data, { frame: k, puffs, surface: vertices, particles: flight.frames[k].particles, tip: tipsOf(k).map((p) => p.map((x) => (x * flight.length_m).toExponential(5)).join(" ")).join(" | ") });
}
// The ground stays, but for an animal that leaves it by more than its reach it is moved in steps.
const STEP_OF_GROUND = 2 * REACH;
const groundUnder = (z) => Math.round((z - centreZ()) / STEP_OF_GROUND) * STEP_OF_GROUND + centreZ();
const centreZ = () => centreOf(0)[2];

function dress() {
  theme = THEMES[state.theme];
  document.documentElement.dataset.theme = state.theme;
  if (renderer) { dressStage(); dressWings(); dressWake(); paintBodies(); }
  drawLegend();
  redraw();
}
if (!renderer) flatState();
const shows = []; // each shows the state of a control
for (const name of [...WAKES, "pressure", "trail", "follow", "loop"]) {
  const button = byId("on-" + name), show = () => button.setAttribute("aria-pressed", state[name]);
  button.addEventListener("click", () => { state[name] = !state[name]; show(); drawLegend(); redraw(); });
  shows.push(show);
}
for (const name of ["colour", "force"]) {
  shows.push(() => { byId(name).value = state[name]; });
  byId(name).addEventListener("change", (e) => { state[name] = e.target.value; drawLegend(); redraw(); });
}
const speedWords = () => (flight.period ? (state.speed < 1 ? state.speed.toFixed(2) : state.speed.toFixed(1)) + " beats/s" : (100 * framesPerSecond() / Math.max(1, LAST)).toFixed(1) + " %/s");
for (const [name, read, write, words] of [
  ["speed", () => Math.log2(state.speed), (v) => { state.speed = 2 ** v; }, speedWords],
  ["age", () => state.age, (v) => { state.age = v; drawLegend(); }, () => ageWords(state.age)],
  ["opacity", () => state.opacity, (v) => { state.opacity = v; }, () => Math.round(100 * state.opacity) + " %"],
  ["level", () => Math.log2(state.level), (v) => { state.level = 2 ** v; }, () => digits(levelNow()) + " s⁻¹"],
]) {
  const input = byId(name), show = () => { byId(name + "-words").textContent = words(); input.setAttribute("aria-valuetext", words()); };
  input.addEventListener("input", () => { write(+input.value); show(); redraw(); });
  shows.push(() => { input.value = read(); show(); });
}
shows.forEach((show) => show());
document.querySelectorAll("[data-view]").forEach((b) => b.addEventListener("click", () => setView(b.dataset.view)));
byId("play").addEventListener("click", () => setPlaying(!state.playing));
slider.max = Math.max(0, LAST);
slider.addEventListener("input", () => seek(+slider.value));
byId("theme").addEventListener("click", () => { state.theme = isDark() ? "light" : "dark"; dress(); });
byId("picture").addEventListener("click", savePicture);
byId("record").addEventListener("click", () => (recording() ? recordingEnds() : startRecording()));
byId("record").disabled = !canRecord || LAST < 1;
byId("full").addEventListener("click", () => (document.fullscreenElement ? document.exitFullscreen() : byId("scene").requestFullscreen?.()));
byId("zoom-in").addEventListener("click", () => zoomPlots(0.5, LAST >= 0 ? flight.frames[frameNow()].x : undefined));
byId("zoom-out").addEventListener("click", () => zoomPlots(2));
byId("zoom-all").addEventListener("click", () => movePlots(whole[0], whole[1] - whole[0]));
byId("values-box").addEventListener("toggle", redraw);
TABS.forEach(([name], n) => {
  const b = document.createElement("button");
  b.textContent = name;
  b.addEventListener("click", () => openTab(n));
  byId("tabs").append(b);
});

// Keys: where a control has the focus, its own keys are its own, and only these.
const MOVES = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "PageUp", "PageDown"], PRESSES = [" ", "Enter"];
function ownsKey(control, key) {
  if (!control) return false;
  if (control.matches("button, summary, a")) return PRESSES.includes(key);
  if (control.matches("[type=range]")) return MOVES.includes(key);
  // A list is also searched by first letters.
  if (control.matches("select")) return MOVES.includes(key) || PRESSES.includes(key) || [...control.options].some((o) => o.text[0] === key);
  return true;
}
const KEYS = {
  " ": () => setPlaying(!state.playing), ArrowRight: () => seek(frameNow() + 1), ArrowLeft: () => seek(frameNow() - 1), Home: () => seek(0), End: () => seek(LAST),
  f: () => byId("full").click(), l: () => byId("on-loop").click(), p: savePicture, t: () => byId("theme").click(),
  1: () => setView("quarter"), 2: () => setView("side"), 3: () => setView("front"), 4: () => setView("top"), 5: () => setView("wake"),
};
window.addEventListener("keydown", (e) => {
  const key = e.key.length === 1 ? e.key.toLowerCase() : e.key; // Caps Lock and Shift change nothing
  if (e.ctrlKey || e.metaKey || e.altKey || LAST < 0 || ownsKey(e.target.closest("input, select, button, summary, textarea, a"), key)) return;
  if (e.target === canvas && turnByKey(key)) { e.preventDefault(); return; }
  if (KEYS[key]) { e.preventDefault(); KEYS[key](); }
});
// With the focus on the scene, arrow keys turn it, + and - come closer and go away.
function turnByKey(key) {
  const turns = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1], "+": [0, 0, 0.9], "-": [0, 0, 1 / 0.9] }[key];
  if (!turns) return false;
  if (!renderer) { flat.turn += turns[0]; flat.tilt -= turns[1]; flat.zoom /= turns[2] || 1; redraw(); return true; }
  const arm = camera.position.clone().sub(orbit.target), far = arm.length() * (turns[2] || 1), azimuth = Math.atan2(arm.y, arm.x) + turns[0], height = Math.max(0.02, Math.min(3.1, Math.acos(arm.z / arm.length()) + turns[1]));
  camera.position.set(orbit.target.x + far * Math.sin(height) * Math.cos(azimuth), orbit.target.y + far * Math.sin(height) * Math.sin(azimuth), orbit.target.z + far * Math.cos(height));
  orbit.update();
  redraw();
  return true;
}
const hide = (id, missing) => { byId(id).hidden = missing; };
hide("wake-controls", !hasWake); hide("wake-sliders", !hasWake); hide("on-pressure", !PANELS || !(flight.most.pressure > 0)); hide("force-box", !(LAST >= 0 && flight.frames[0].forces.length)); hide("on-trail", LAST < 1 || !renderer);
if (!renderer) for (const id of ["on-vortices", "on-smoke", "on-pressure", "on-follow", "level-box"]) hide(id, true);
hide("scene", LAST < 0);
if (!hasStrokes) byId("colour").querySelector("[value=stroke]").remove();
if (matchMedia("(max-width: 820px)").matches) byId("display").open = false;

// Beside another flight, both keep step. The one that the reader acted on last leads: it tells the page around
// what it shows, and the other shows that, too. Acts are numbered, so that what was told before an act is left
// aside by the flight that was acted on, however late it comes.
const beside = { act: 0, leads: true, touched: false, known: "" };
const armNow = () => (renderer ? camera.position.clone().sub(orbit.target).divideScalar(REACH).toArray() : null);
const shownNow = () => [frameNow(), ...(armNow() || []).map((x) => x.toFixed(4))].join();
for (const kind of ["pointerdown", "wheel", "keydown", "input"]) window.addEventListener(kind, () => { beside.touched = true; }, { capture: true, passive: true });
// Leads from now on if the reader has chosen another time or view than the one that was told.
function claim() {
  if (!beside.touched || shownNow() === beside.known || (beside.leads && beside.act > 0)) return;
  beside.act = Math.floor(beside.act) + 1;
  beside.leads = true;
}
function tell(k) {
  if (window.parent === window) return;
  claim();
  if (beside.leads) window.parent.postMessage({ shown: { x: flight.frames[k].x, arm: armNow() }, act: beside.act }, "*");
}
function hear({ shown, act }) {
  claim();
  if (act < beside.act || (act === beside.act && beside.leads)) return;
  beside.act = act;
  beside.leads = false;
  state.playing = false;
  byId("play").dataset.playing = false;
  if (renderer && shown.arm) { camera.position.copy(orbit.target).add(new THREE.Vector3(...shown.arm).multiplyScalar(REACH)); camera.lookAt(orbit.target); }
  seek(frameAt(shown.x));
  beside.touched = false;
  beside.known = shownNow();
}
window.addEventListener("message", ({ data }) => {
  if (LAST < 0) return;
  if (data.shown) hear(data);
  // They begin to keep step anew: with what plays, or with the next act.
  if (data.apart) Object.assign(beside, { act: 0, leads: state.playing, touched: false, known: shownNow() });
});
if (linkNow().has("narrow")) document.documentElement.classList.add("narrow");

// A frame can be linked to: flight.html#frame=12 moves the slider there.
function followLink() {
  const k = /frame=(\d+)/.exec(location.hash);
  if (k) seek(+k[1]);
}
window.addEventListener("hashchange", () => {
  choose(linkNow());
  if (!renderer) flatState();
  shows.forEach((show) => show());
  followLink();
  dress();
  if (LAST >= 0 && linkNow().has("view")) setView(state.view);
});
// Paper is white: a print is light, and drawn in the size that it has there.
// What WebGL has drawn is lost on the way to the printer: a copy of it is printed.
let unprinted = null; // the theme of the screen, while it is printed
const printed = document.createElement("canvas");
printed.id = "printed";
function dressForPrint(on) {
  if (on === (unprinted !== null)) return;
  if (on) { unprinted = state.theme; state.theme = "light"; } else { state.theme = unprinted; unprinted = null; }
  document.documentElement.classList.toggle("printing", on);
  if (renderer) resizeStage();
  dress();
  drawAll();
  printed.remove();
  if (!on || !renderer) return;
  printed.width = canvas.width; printed.height = canvas.height;
  printed.getContext("2d").drawImage(canvas, 0, 0);
  canvas.after(printed);
}
window.addEventListener("beforeprint", () => dressForPrint(true));
window.addEventListener("afterprint", () => dressForPrint(false));
const paper = matchMedia("print");
paper.addEventListener("change", () => dressForPrint(paper.matches));
if (renderer) { orbit.addEventListener("change", redraw); resizeStage(); }
new ResizeObserver(() => { if (renderer) resizeStage(); redraw(); }).observe(document.body);
if (renderer) new ResizeObserver(() => { resizeStage(); redraw(); }).observe(stage);
openTab(0);
dress();
setPlaying(false);
followLink();
if (LAST >= 0) setView(state.view);
drawAll();
requestAnimationFrame((now) => { then = now; tick(now); });
