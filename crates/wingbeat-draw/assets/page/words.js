// Numbers and times as words.
const minus = (text) => text.replace("-", "−");
// Three digits, or with a power of ten where there are many zeros.
function digits(v) {
  const a = Math.abs(v);
  if (a === 0) return "0";
  if (a >= 1e5 || a < 1e-3) {
    const e = Math.floor(Math.log10(a));
    return minus((v / 10 ** e).toFixed(1)) + "×10" + String(e).replace(/[-\d]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
  }
  return minus(a >= 100 ? v.toFixed(0) : a >= 10 ? v.toFixed(1) : v.toFixed(a < 0.1 ? 3 : 2));
}
// A value with a decimal prefix before its unit.
function withPrefix(v, unit) {
  const a = Math.abs(v);
  for (const [scale, prefix] of [[1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"]])
    if (a >= 0.9995 * scale || scale === 1e-9) return digits(v / scale) + " " + prefix + unit;
}
// 1, 2 or 5 times a power of ten: the largest that is not above x.
function roundDown(x) {
  const p = 10 ** Math.floor(Math.log10(x));
  return [5, 2, 1].map((m) => m * p).find((v) => v <= x * 1.000001) || p;
}
const lengthWords = (m) => (m >= 1 ? +m.toPrecision(2) + " m" : m >= 0.01 ? +(100 * m).toPrecision(2) + " cm" : m >= 1e-3 ? +(1e3 * m).toPrecision(2) + " mm" : +(1e6 * m).toPrecision(2) + " µm");
const timeWords = (s) => (Math.abs(s) < 1 ? minus((1e3 * s).toFixed(2)) + " ms" : minus(s.toFixed(3)) + " s");
const ageWords = (age) => (flight.period ? age.toFixed(2) + " beats" : timeWords(age * BEAT * flight.step_s));
// Half-strokes of the wings as [name, stroke]: one without a name where all wings keep together; else that of each
// pair that does, or of each wing.
const pairOf = (name) => name.replace(/[-_ ]*(left|right)$|^(left|right)[-_ ]*/, "");
function strokesOf(k) {
  if (!hasStrokes) return [];
  const words = WINGS.map((w, i) => [w.name, downOf(flight.frames[k].step, i) ? "downstroke" : "upstroke"]);
  const same = (list) => list.every(([, s]) => s === list[0][1]);
  if (same(words)) return [["", words[0][1]]];
  const pairs = [...new Set(words.map(([name]) => pairOf(name)))].map((p) => [p, words.filter(([name]) => pairOf(name) === p)]);
  return pairs.flatMap(([p, list]) => (p && same(list) ? [[p, list[0][1]]] : list));
}
const strokeOf = (k) => strokesOf(k).map((w) => w.join(" ").trim()).join(", ");
// The same as [words, stroke] in as few words as the clock has room for.
function shortStrokes(k) {
  const list = strokesOf(k), named = (stroke) => list.filter((w) => w[1] === stroke).map((w) => w[0]);
  if (list.length < 2) return list.map(([, stroke]) => [stroke, stroke]);
  const [down, up] = [named("downstroke"), named("upstroke")], others = (names, few) => (names.length > 1 && few ? "others" : names.join(", "));
  return [[others(down, down.length > up.length) + " down", "downstroke"], [others(up, down.length <= up.length) + " up", "upstroke"]];
}
function whenWords(k) {
  const f = flight.frames[k], beats = flight.period ? (f.time / flight.period).toFixed(2) + " beats, " : "";
  return beats + timeWords(f.time) + (hasStrokes ? ", " + strokeOf(k) : "");
}
