// Colours of the dark and of the light page. The same hue means the same thing everywhere.
const THEMES = {
  dark: { sky: ["#182233", "#080b11"], grid: "#5f7694", gridShare: 0.34, down: "#ffab4a", up: "#45bdff", plain: "#9fb4cc", shadow: 0.42, trail: "#9df5c8", path: "#8b9bb0", force: "#ffd34d", high: "#ff7a66", low: "#5fa8ff", zero: "#e8edf4", body: "#8f5f2c", standIn: "#8796a8", stripe: "#22140a", eye: "#86140f", vein: "rgba(245,222,184,.95)", membrane: "rgba(190,216,242,.26)", edge: "#f2e6cf", room: 0.42, roomColour: 0x1a2433, rim: [0.16, 0.88], core: [0.3, 0.9], cover: 0.8, ages: ["#2b1f6b", "#8b2f86", "#f0703a", "#fff0b8"], lines: ["#5cc8ff", "#ffb057", "#c79bff", "#7fe0b0", "#ff8fa3", "#d8d26a", "#b8c4d2"] },
  light: { sky: ["#ffffff", "#e6ebf2"], grid: "#7f8fa3", gridShare: 0.42, down: "#cf5a06", up: "#0b66b8", plain: "#5d6b7c", shadow: 0.3, trail: "#0a8f5b", path: "#5d6b7c", force: "#9a6a00", high: "#c02616", low: "#1552b5", zero: "#ffffff", body: "#8a5826", standIn: "#8c98a6", stripe: "#22140a", eye: "#7a130f", vein: "rgba(58,42,28,.95)", membrane: "rgba(84,108,138,.30)", edge: "#33291f", room: 0.5, roomColour: 0xb8c4d2, rim: [0.12, 0.62], core: [0.3, 0.85], cover: 1, ages: ["#c9bfe0", "#b0549c", "#b8330f", "#4a0d05"], lines: ["#0b66b8", "#c2560a", "#7a3fc0", "#0a8f5b", "#b3204d", "#7d6b00", "#4b5563"] },
};
let theme = THEMES.dark;
const isDark = () => theme === THEMES.dark;
const rgb = (hex) => { const n = parseInt(hex.slice(1), 16); return [(n >> 16) / 255, (n >> 8 & 255) / 255, (n & 255) / 255]; };
const blend = (a, b, t) => a.map((x, c) => x + (b[c] - x) * t);
const smooth = (a, b, x) => { x = Math.min(1, Math.max(0, (x - a) / (b - a))); return x * x * (3 - 2 * x); };
// Colour of a share: of age along four stops, else from upstroke (0) to downstroke (1).
function wakeDye(by) {
  const down = rgb(theme.down), up = rgb(theme.up), stops = theme.ages.map(rgb);
  if (by === "age") return (t) => { const x = Math.max(0, Math.min(2.999, 3 * t)); return blend(stops[x | 0], stops[(x | 0) + 1], x % 1); };
  return (t) => blend(up, down, smooth(0.33, 0.67, t));
}
// Colour of a signed number from -1 to 1, square-root scale.
function signDye(x) {
  const r = Math.sqrt(Math.min(1, Math.abs(x)));
  return blend(rgb(theme.zero), rgb(x > 0 ? theme.high : theme.low), r);
}
