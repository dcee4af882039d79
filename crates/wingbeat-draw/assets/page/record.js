// Pictures and films of the stage with what explains them, without the page around.
let recorder = null;
const recording = () => recorder !== null;
const film = document.createElement("canvas");
function save(blob, ending) {
  const a = document.createElement("a");
  a.href = URL.createObjectURL(blob);
  a.download = `${flight.name.replace(/[^\w-]+/g, "-")}-${flight.frames[frameNow()].step}.${ending}`;
  a.click();
  setTimeout(() => URL.revokeObjectURL(a.href), 10000);
}
// The stage as it is, with name, clock, scale and legend; drawn in the same task as the scene.
function compose() {
  const w = canvas.width, h = canvas.height, s = w / stage.clientWidth, g = film.getContext("2d"), ink = getComputedStyle(document.documentElement).getPropertyValue("--text");
  if (film.width !== w || film.height !== h) { film.width = w; film.height = h; }
  g.setTransform(1, 0, 0, 1, 0, 0);
  g.drawImage(canvas, 0, 0);
  g.setTransform(s, 0, 0, s, 0, 0);
  g.fillStyle = ink; g.textBaseline = "top"; g.textAlign = "left";
  g.font = "600 15px system-ui, sans-serif"; g.fillText(flight.name, 14, 12);
  g.font = "13px system-ui, sans-serif"; g.fillText(whenWords(frameNow()), 14, 32);
  const cw = stage.clientWidth, ch = stage.clientHeight, { pixels, words } = scaleBar();
  g.strokeStyle = ink; g.lineWidth = 1.6;
  g.beginPath(); g.moveTo(cw - 18 - pixels, ch - 38); g.lineTo(cw - 18 - pixels, ch - 32); g.lineTo(cw - 18, ch - 32); g.lineTo(cw - 18, ch - 38); g.stroke();
  g.textAlign = "center"; g.fillText(words, cw - 18 - pixels / 2, ch - 27);
  g.textAlign = "left"; g.font = "12px system-ui, sans-serif";
  let x = 14;
  for (const [text, colours] of legend()) {
    const ramp = g.createLinearGradient(x, 0, x + 10, 0);
    colours.forEach((c, i) => ramp.addColorStop(colours.length > 1 ? i / (colours.length - 1) : 0, c));
    g.fillStyle = ramp; g.fillRect(x, ch - 25, 10, 10);
    g.fillStyle = ink; g.fillText(text, x + 15, ch - 27);
    x += 32 + g.measureText(text).width;
  }
  if (arrowLabel && renderer) { const [ax, ay] = onStage(arrowLabel.at); g.fillStyle = theme.force; g.font = "600 12px system-ui, sans-serif"; g.fillText(arrowLabel.text, ax + 10, ay - 6); }
}
function savePicture() {
  drawAll();
  compose();
  film.toBlob((blob) => save(blob, "png"), "image/png");
}
const canRecord = typeof MediaRecorder !== "undefined" && typeof film.captureStream === "function";
function startRecording() {
  drawAll();
  compose();
  const stream = film.captureStream(0), [track] = stream.getVideoTracks();
  const kind = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"].find((t) => MediaRecorder.isTypeSupported(t)), parts = [];
  recorder = new MediaRecorder(stream, { mimeType: kind, videoBitsPerSecond: 12e6 });
  recorder.ondataavailable = (e) => { if (e.data.size) parts.push(e.data); };
  recorder.filmed = () => track.requestFrame();
  recorder.hasPictures = () => parts.length > 0;
  recorder.onstop = () => { const blob = new Blob(parts, { type: "video/webm" }); byId("state").dataset.film = blob.size; recorder = null; showRecording(); save(blob, "webm"); };
  recorder.start(250);
  if (state.at >= LAST) state.at = 0;
  setPlaying(true);
  showRecording();
}
// The last picture stays for half a second, and until a slow browser has begun to hand out the film.
function recordingEnds() {
  const ending = recorder, began = performance.now();
  const end = () => {
    if (ending.state === "inactive") return;
    const waited = performance.now() - began;
    if (waited > 500 && (ending.hasPictures() || waited > 30000)) { ending.stop(); return; }
    ending.filmed();
    setTimeout(end, 100);
  };
  if (ending) end();
}
function showRecording() {
  byId("record").setAttribute("aria-pressed", recording());
  byId("record").textContent = recording() ? "Stop" : "Film";
}
