// What the reader has chosen. A link can choose, too: flight.html#frame=12&view=side&theme=light.
const state = {
  at: 0, // frame, not whole while it plays
  playing: false,
  loop: true,
  speed: flight.period ? 0.5 : 1, // wingbeats, or parts of 1/4 of the flight, per second
  theme: matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark",
  view: "quarter",
  follow: true,
  vortices: true, smoke: true, filaments: false,
  colour: hasStrokes ? "stroke" : "age",
  age: 1.1,
  opacity: 0.8,
  level: 1, // of |omega|, relative to the usual
  pressure: false,
  force: "total",
  trail: true,
};
const WAKES = ["vortices", "smoke", "filaments"];
const NAMED = { theme: ["dark", "light"], view: ["quarter", "side", "front", "top", "wake"], colour: hasStrokes ? ["stroke", "age", "spin"] : ["age", "spin"], force: ["total", "each", "none"] };
const RANGES = { speed: [1 / 64, 8], age: [0.25, 3], level: [0.25, 4] };
// Chooses what the link says; the rest stays.
function choose(link) {
  for (const name in NAMED) if (NAMED[name].includes(link.get(name))) state[name] = link.get(name);
  for (const name in RANGES) {
    const v = parseFloat(link.get(name));
    if (Number.isFinite(v)) state[name] = Math.max(RANGES[name][0], Math.min(RANGES[name][1], v));
  }
  if (link.has("pressure")) state.pressure = link.get("pressure") === "1";
  if (link.has("wake")) for (const name of WAKES) state[name] = link.get("wake").split(",").includes(name);
}
const linkNow = () => new URLSearchParams(location.hash.slice(1));
choose(linkNow());
const frameNow = () => Math.max(0, Math.min(LAST, Math.round(state.at)));
