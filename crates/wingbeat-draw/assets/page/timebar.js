// The time bar: a range input under a drawing of the half-strokes; playing.
const bar = byId("time-drawing"), slider = byId("time");
const EDGE_OF_BAR = 8;
// Wings that beat, one for each rhythm.
const beating = (() => {
  const rhythms = flight.turns.map((turns) => turns.join());
  return [...rhythms.keys()].filter((i) => rhythms[i] && rhythms.indexOf(rhythms[i]) === i);
})();
function drawTime() {
  if (LAST < 0) return;
  const w = bar.clientWidth, h = bar.clientHeight, ratio = Math.min(2, window.devicePixelRatio || 1), g = bar.getContext("2d"), css = getComputedStyle(document.documentElement);
  bar.width = w * ratio; bar.height = h * ratio;
  g.scale(ratio, ratio);
  const X = (k) => EDGE_OF_BAR + (w - 2 * EDGE_OF_BAR) * k / Math.max(1, LAST), now = state.at;
  g.fillStyle = css.getPropertyValue("--line");
  g.fillRect(EDGE_OF_BAR, 9, w - 2 * EDGE_OF_BAR, 5);
  if (hasStrokes) beating.forEach((wing, i) => { // runs of one half-stroke, a band for each rhythm
    const high = beating.length > 1 ? 8 : 5, height = high / beating.length, top = 11.5 - high / 2 + i * height;
    for (let k = 0; k < now;) {
      const down = downOf(flight.frames[k].step, wing);
      let end = k;
      while (end < now && downOf(flight.frames[Math.min(LAST, end)].step, wing) === down) end++;
      g.fillStyle = down ? theme.down : theme.up;
      g.fillRect(X(k), top, X(Math.min(end, now)) - X(k) + 0.4, height);
      k = end;
    }
  }); else { g.fillStyle = theme.up; g.fillRect(EDGE_OF_BAR, 9, X(now) - EDGE_OF_BAR, 5); }
  if (flight.failed) { g.fillStyle = theme.high; g.fillRect(w - EDGE_OF_BAR - 3, 4, 5, 15); }
  g.fillStyle = css.getPropertyValue("--muted"); g.font = "10px system-ui, sans-serif"; g.textAlign = "center";
  const first = flight.frames[0].x, last = flight.frames[LAST].x, at = (x) => EDGE_OF_BAR + (w - 2 * EDGE_OF_BAR) * (x - first) / (last - first || 1);
  if (LAST > 0) for (const t of ticks(first, last, Math.max(2, Math.min(12, Math.floor(w / 60))))) { g.fillRect(at(t) - 0.5, 6, 1, 11); g.fillText(minus(String(t)), Math.max(10, Math.min(w - 12, at(t))), 29); }
  g.fillStyle = css.getPropertyValue("--text");
  g.beginPath(); g.arc(X(now), 11.5, 6.5, 0, 7); g.fill();
}
// Goes to a frame, also while it plays: playing goes on from there.
function seek(k) {
  state.at = Math.max(0, Math.min(LAST, k));
  redraw();
}
const framesPerSecond = () => (LAST > 0 ? state.speed * BEAT * LAST / (flight.frames[LAST].step - flight.frames[0].step || 1) : 0);
function setPlaying(on) {
  state.playing = on && LAST > 0;
  if (state.playing && state.at >= LAST) state.at = 0;
  const button = byId("play");
  button.setAttribute("aria-label", state.playing ? "Pause" : "Play");
  button.dataset.playing = state.playing;
  then = performance.now();
  redraw();
}
let then = 0, wanted = true, gap = 30, hurried = false;
function redraw() { wanted = true; }
function tick(now) {
  const passed = Math.max(0, Math.min(0.5, (now - then) / 1e3));
  then = now;
  if (state.playing) {
    state.at += passed * framesPerSecond();
    if (state.at > LAST) {
      if (state.loop && !recording()) state.at = 0;
      else { state.at = LAST; setPlaying(false); recordingEnds(); }
    }
    wanted = true;
    gap = 0.7 * gap + 0.3 * passed * 1e3;
  } else gap = 30;
  adaptResolution();
  if (wanted) { wanted = false; drawAll(); }
  requestAnimationFrame(tick);
}
// Without a fast GPU the picture is coarser while it plays, and fine again when it stops.
function adaptResolution() {
  if (!renderer) return;
  const fine = Math.min(window.devicePixelRatio || 1, 2), coarse = Math.min(fine, 0.5), now = state.playing && (gap > 70 || (pixelRatio < fine && gap > 40)) ? coarse : fine;
  if (now !== pixelRatio) { pixelRatio = now; resizeStage(); wanted = true; }
  // Slower than six pictures a second even so: surfaces without the smoke around them, until it stops.
  hurried = state.playing && state.vortices && now < fine && (gap > 170 || (hurried && gap > 90));
}
