#!/usr/bin/env python3
"""Figures of pages that the program does not draw itself. Needs nothing but Python and, for `roots`, the program.

    python3 scripts/page-figures.py polars > docs/polars.svg            coefficients of docs/blade-elements.md
    python3 scripts/page-figures.py roots WINGBEAT > docs/roots.svg     modes against speed of docs/flight-mechanics.md
    python3 scripts/page-figures.py plane > docs/stroke-plane.svg       angles of docs/measured-angles.md
"""
import json
import math
import subprocess
import sys

INK, GRID, FONT = "#282828", "#d6d6da", "'DejaVu Sans', Verdana, sans-serif"
# Okabe & Ito 2008
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#282828"]
DASHES = ["", "7 3", "2 3", "9 3 2 3", "", "5 2", "1 2"]


def picture(width, height, parts):
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}"'
    ground = f'<rect width="{width}" height="{height}" fill="#ffffff"/>'
    return "\n".join([f'{head} font-family="{FONT}" font-size="11">', ground, *parts, "</svg>"])


def text(x, y, words, anchor="middle", colour=INK, more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}" {more}>{words}</text>'


def line(x, y, u, v, colour=INK, width=1.0, more=""):
    ends = f'x1="{x:.1f}" y1="{y:.1f}" x2="{u:.1f}" y2="{v:.1f}"'
    return f'<line {ends} stroke="{colour}" stroke-width="{width}" {more}/>'


class Axes:
    """A frame from (left, top) of a size, with ranges of x and y."""

    def __init__(self, left, top, width, height, xs, ys):
        self.left, self.top, self.width, self.height, self.xs, self.ys = left, top, width, height, xs, ys

    def at(self, x, y):
        (a, b), (c, d) = self.xs, self.ys
        return self.left + (x - a) / (b - a) * self.width, self.top + (d - y) / (d - c) * self.height

    def frame(self, xticks, yticks, xname, title):
        out = []
        for x in xticks:
            p, _ = self.at(x, self.ys[0])
            out += [line(p, self.top, p, self.top + self.height, GRID, 0.75), text(p, self.top + self.height + 15, f"{x:g}".replace("-", "−"))]
        for y in yticks:
            _, p = self.at(self.xs[0], y)
            out += [line(self.left, p, self.left + self.width, p, GRID, 0.75), text(self.left - 6, p + 4, f"{y:g}".replace("-", "−"), "end")]
        out.append(f'<rect x="{self.left}" y="{self.top}" width="{self.width}" height="{self.height}" fill="none" stroke="{INK}"/>')
        out.append(text(self.left + self.width / 2, self.top + self.height + 32, xname))
        return out + [text(self.left, self.top - 8, title, "start")]

    def curve(self, points, colour, dashes=""):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in (self.at(*p) for p in points))
        return f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.6" stroke-dasharray="{dashes}"/>'


def double(lift, drag_0, drag_90):
    return lambda s, c: (2 * lift * s * c, drag_0 * c * c + drag_90 * s * s)


def dickinson(s, c):
    a = math.atan2(s, c)
    return 0.225 + 1.58 * math.sin(2.13 * a - math.radians(7.2)), 1.92 - 1.55 * math.cos(2.04 * a - math.radians(9.82))


def deng(s, c):
    n, t = 3.4 * s, 0.4 * max(c * c - s * s, 0.0) ** 2
    return n * c - t * s, n * s + t * c


# As crates/wingbeat-blade/src/coefficients.rs has them.
SETS = {
    "dickson-2008": double(0.5 * 3.3207, 0.4123, 3.1670 + 0.4123),
    "dickinson-1999": dickinson,
    "berman-wang-fruit-fly": double(1.833, 0.21, 3.35),
    "whitney-wood-2010": double(1.8, 0.4, 3.4),
    "wang-dragonfly": double(1.2, 0.4, 2.4),
    "byl": double(1.8, 0.0, 3.6),
    "deng-2006": deng,
}


def polars():
    plots = [Axes(45, 30, 270, 250, (0, 90), (0, 4)), Axes(380, 30, 270, 250, (0, 4), (0, 2))]
    parts = plots[0].frame(range(0, 91, 15), [0, 1, 2, 3, 4], "angle of attack [deg]", "lift and drag coefficient")
    parts += plots[1].frame([0, 1, 2, 3, 4], [0, 0.5, 1, 1.5, 2], "drag coefficient", "lift coefficient")
    parts += [text(*plots[0].at(83, 0.75), "lift"), text(*plots[0].at(60, 3.3), "drag")]
    for k, (name, law) in enumerate(SETS.items()):
        at = [(a, law(math.sin(math.radians(a)), math.cos(math.radians(a)))) for a in range(0, 91, 2)]
        parts += [plots[0].curve([(a, c[n]) for a, c in at], COLOURS[k], DASHES[k]) for n in (0, 1)]
        parts.append(plots[1].curve([(drag, lift) for _, (lift, drag) in at], COLOURS[k], DASHES[k]))
        x, y = 45 + 155 * (k % 4), 340 + 18 * (k // 4)
        parts += [line(x, y - 4, x + 22, y - 4, COLOURS[k], 1.6, f'stroke-dasharray="{DASHES[k]}"'), text(x + 27, y, name, "start")]
    return picture(675, 372, parts)


def roots(program):
    plot = Axes(50, 30, 590, 330, (-60, 30), (-5, 100))
    parts = plot.frame(range(-60, 31, 10), range(0, 101, 20), "growth [1/s]: what lies to the right of 0 grows", "angular frequency [rad/s]; hover (light) to 1 m/s (dark), every 0.1 m/s")
    parts.append(line(*plot.at(0, -5), *plot.at(0, 100), INK, 1.2))
    for k in range(11):
        speed = 0.1 * k
        command = [program, "stability", "fruit-fly-blade", "--forward", f"{speed:.1f}", "--json"]
        modes = json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)["floquet_modes"]
        for mode in modes:
            x, y = plot.at(mode["growth_per_s"], mode["frequency_rad_per_s"])
            if x < plot.left:
                continue
            along, ink = mode["plane"] == "longitudinal", f"{0.25 + 0.75 * k / 10:.2f}"
            colour = COLOURS[0] if along else COLOURS[1]
            shape = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5"' if along else f'<rect x="{x - 4:.1f}" y="{y - 4:.1f}" width="8" height="8"'
            parts.append(f'{shape} fill="{colour}" fill-opacity="{ink}" stroke="{colour}"/>')
    parts += [f'<circle cx="490" cy="18" r="4.5" fill="{COLOURS[0]}"/>', text(500, 22, "longitudinal", "start")]
    parts += [f'<rect x="590" y="14" width="8" height="8" fill="{COLOURS[1]}"/>', text(603, 22, "lateral", "start")]
    return picture(675, 405, parts)


def plane():
    """The body from its right side, flying to the right of the picture."""
    arrow = '<defs><marker id="a" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto-start-reverse"><path d="M0 0 L8 4 L0 8 z"/></marker></defs>'
    parts = [arrow]

    def side(x, y, pitch, in_body, title):
        chi, beta = math.radians(pitch), math.radians(90 - pitch - in_body)
        ahead = lambda angle, r: (x + r * math.cos(angle), y - r * math.sin(angle))
        parts.append(text(x, 24, title))
        parts.append(f'<ellipse cx="{x}" cy="{y}" rx="88" ry="20" fill="#dddddd" stroke="{INK}" transform="rotate({-pitch} {x} {y})"/>')
        nose = ahead(chi, 88)
        parts.append(f'<circle cx="{nose[0]:.1f}" cy="{nose[1]:.1f}" r="15" fill="#dddddd" stroke="{INK}"/>')
        parts.append(line(x - 150, y, x + 150, y, "#888888", 1, 'stroke-dasharray="4 4"'))
        parts.append(line(x, y, *ahead(chi, 150), INK, 1, 'marker-end="url(#a)"'))
        at = ahead(chi, 150)
        parts.append(text(at[0] + 6, at[1] - 6, "b1, along the body", "middle"))
        back, fore = ahead(-beta + math.pi, 130), ahead(-beta, 130)
        parts.append(line(*back, *fore, COLOURS[0], 3, 'marker-end="url(#a)"'))
        parts.append(text(back[0], back[1] - 10, "stroke plane", "middle", COLOURS[0]))
        parts.append(text(fore[0] - 4, fore[1] + 20, "downstroke", "middle", COLOURS[0]))

        def arc(start, end, r, words, colour):
            a, b = ahead(start, r), ahead(end, r)
            sweep = 0 if end > start else 1
            parts.append(f'<path d="M{a[0]:.1f} {a[1]:.1f} A{r} {r} 0 0 {sweep} {b[0]:.1f} {b[1]:.1f}" fill="none" stroke="{colour}" stroke-width="1.5" marker-end="url(#a)"/>')
            m = ahead((start + end) / 2, r + 8)
            parts.append(text(m[0], m[1] + 4, words, "start", colour))

        arc(0.0, chi, 108, f"χ = {pitch}", COLOURS[1])
        if abs(beta) > 0.01:
            arc(0.0, -beta, 62, f"β = {90 - pitch - in_body}", COLOURS[2])
        parts.append(text(x, 300, f"pitch_deg = χ = {pitch}, stroke_plane_pitch_deg = 90 − {pitch} − {90 - pitch - in_body} = {in_body}"))

    side(190, 180, 50, 40, "hover, stroke plane level")
    side(575, 180, 20, 40, "forward flight, stroke plane tilted forward")
    parts.append(text(385, 330, "seen from the right side of the animal, nose to the right; the dashed line is level; angles in degrees"))
    return picture(775, 345, parts)


if __name__ == "__main__":
    what, *rest = sys.argv[1:] or ["?"]
    drawings = {"polars": polars, "roots": roots, "plane": plane}
    if what not in drawings:
        sys.exit(__doc__)
    print(drawings[what](*rest))
