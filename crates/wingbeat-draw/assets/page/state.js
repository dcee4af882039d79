// What the reader has chosen. A link can choose, too: flight.html#frame=12&view=side&theme=light.
const link = new URLSearchParams(location.hash.slice(1));
const linked = (name, known, usual) => (known.includes(link.get(name)) ? link.get(name) : usual);
const number = (name, [low, high], usual) => { const v = parseFloat(link.get(name)); return Number.isFinite(v) ? Math.max(low, Math.min(high, v)) : usual; };
const AGES = [0.25, 3];
const state = {
  at: 0, // frame, not whole while it plays
  playing: false,
  loop: true,
  speed: number("speed", [1 / 64, 8], flight.period ? 0.5 : 1), // wingbeats, or parts of 1/4 of the flight, per second
  theme: linked("theme", ["dark", "light"], matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark"),
  view: linked("view", ["quarter", "side", "front", "top", "wake"], "quarter"),
  follow: true,
  vortices: true, smoke: true, filaments: false,
  colour: linked("colour", hasStrokes ? ["stroke", "age", "spin"] : ["age", "spin"], hasStrokes ? "stroke" : "age"),
  age: number("age", AGES, 1.1),
  opacity: 0.8,
  level: number("level", [0.25, 4], 1), // of |omega|, relative to the usual
  pressure: link.get("pressure") === "1",
  force: linked("force", ["total", "each", "none"], "total"),
  trail: true,
};
if (link.get("wake") !== null) for (const k of ["vortices", "smoke", "filaments"]) state[k] = link.get("wake").split(",").includes(k);
const frameNow = () => Math.max(0, Math.min(LAST, Math.round(state.at)));
