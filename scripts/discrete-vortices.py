#!/usr/bin/env python3
"""A second method for leading-edge vorticity: discrete vortices in plane flow beside a flat plate, after Ramesh, Gopalarathnam,
Granlund, Ol & Edwards 2014, J. Fluid Mech. 751:500. Nothing of wingbeat is used; needs numpy.

    python3 scripts/discrete-vortices.py [dt] [quarter]    Baik's plate, W1 and W3 (docs/separated-flow-evidence.md)
    python3 scripts/discrete-vortices.py ramp [dt] [quarter]    plate that pitches to 45 deg within a chord of travel about its leading edge
    python3 scripts/discrete-vortices.py wagner [dt] [quarter]    lift after a sudden start against R. T. Jones's form of Wagner's function
    python3 scripts/discrete-vortices.py hover [dt] [quarter]    plate that hovers at 45 deg, 2.8 chords to and fro

Each new vortex lies a third of the way to the last one [Ramesh et al. 2014], which is half a step's way from the edge; with `quarter`
a quarter of it, where a vortex has the effect on the edge of an even sheet as long, and with cores of 0.005 chords for 0.02.

Chord, speed and density are 1; the plate moves against x, z is up, clockwise circulation is positive. The vorticity of the plate is
`gamma = 2 (A0 cot(theta/2) + sum An sin n theta)`. A vortex leaves the trailing edge each step, and one leaves the leading edge when |A0|
would exceed the critical value, so strong that it does not. Forces are theirs, with the rate at which the leading edge sheds
circulation in the pressure.
"""

import csv
import sys
from pathlib import Path

import numpy as np

NODES = 60
CORE = 0.02  # of Vatistas, n = 2
PLACE = 1 / 2  # of a new vortex in what has left within the step, from the edge
ROOM = 25.0  # chords behind the plate after which vortices are dropped


def velocity(at, place, circulation):
    """Velocity at points of vortices."""
    way = at[:, None, :] - place[None]
    part = circulation / (2 * np.pi * np.sqrt((way**2).sum(2) ** 2 + CORE**4))
    return np.stack([(part * way[..., 1]).sum(1), -(part * way[..., 0]).sum(1)], 1)


def stream(t):
    """Place and speed along x of a plate that moves steadily."""
    return -t, -1.0


def history(pitch, height, pivot, dt, steps, critical, travel=stream, held=0.0):
    """Lift and drag coefficient and what the leading edge has shed, step by step. `pitch(t)`, `height(t)` and `travel(t)` give value and
    rate; `critical` None: attached; `held`: part of the force of suction that does not act."""
    theta = (np.arange(NODES) + 0.5) * np.pi / NODES
    x = 0.5 * (1 - np.cos(theta))
    place, circulation, is_leading = np.zeros((0, 2)), np.zeros(0), np.zeros(0, bool)
    coefficients = lambda w: np.array([-w.mean(), *(2 * (w * np.cos(k * theta)).mean() for k in (1, 2, 3))])
    bound = lambda a: np.pi * (a[0] + a[1] / 2)
    before, dropped, was_shedding, shed_ahead, found = None, 0.0, False, 0.0, []
    for step in range(steps + 1):
        t = step * dt
        (angle, spin), (z, rise), (ahead, speed) = pitch(t), height(t), travel(t)
        cos, sin = np.cos(angle), np.sin(angle)
        along, normal, axis = np.array([cos, -sin]), np.array([sin, cos]), np.array([ahead, z])
        plate = axis + (x[:, None] - pivot) * along
        front, rear = axis - pivot * along, axis + (1 - pivot) * along
        motion = speed * sin - spin * (x - pivot) + rise * cos
        limit = None if critical is None else critical * (1.0 if travel is stream else np.hypot(speed, spin * pivot))
        wake = velocity(plate, place, circulation)
        a, total = coefficients(motion - wake @ normal), circulation.sum() + dropped

        def newest(edge, leading, drift):
            """At its place on the way to the last one, which was at the same place; the first as far from the edge."""
            last = place[is_leading == leading]
            fresh = not len(last) or leading and not was_shedding
            return edge + (PLACE * dt * drift if fresh else (last[-1] - edge) * PLACE / (1 + PLACE))

        behind = newest(rear, False, along if travel is stream else -np.array([speed, rise]) + spin * (1 - pivot) * normal)
        of_rear = velocity(plate, behind[None], np.ones(1))
        rear_a = coefficients(-of_rear @ normal)
        shed = -(bound(a) + total) / (bound(rear_a) + 1)
        new_a, flow = a + shed * rear_a, wake + shed * of_rear
        new, rate = [(behind, shed, False)], 0.0
        was_shedding_now = limit is not None and abs(new_a[0]) > limit
        if was_shedding_now:
            edge = np.array([speed, rise]) - pivot * spin * np.array([-sin, -cos])
            before_it = newest(front, True, velocity(front[None], place, circulation)[0] - edge)
            of_front = velocity(plate, before_it[None], np.ones(1))
            front_a = coefficients(-of_front @ normal)
            matrix = [[bound(rear_a) + 1, bound(front_a) + 1], [rear_a[0], front_a[0]]]
            shed, led = np.linalg.solve(matrix, [-bound(a) - total, limit * np.sign(new_a[0]) - a[0]])
            new_a, flow = a + shed * rear_a + led * front_a, wake + shed * of_rear + led * of_front
            new, rate = [(behind, shed, False), (before_it, led, True)], led / dt
        was_shedding = was_shedding_now
        place = np.vstack([place, *[p for p, _, _ in new]])
        circulation = np.append(circulation, [g for _, g, _ in new])
        is_leading = np.append(is_leading, [k for _, _, k in new])

        change = np.zeros(4) if before is None else (new_a - before) / dt
        before = new_a
        gamma = 2 * (new_a[0] / np.tan(theta / 2) + sum(new_a[k] * np.sin(k * theta) for k in (1, 2, 3)))
        width = gamma * 0.5 * np.sin(theta) * np.pi / NODES
        push = 2 * np.pi * ((rise * sin - speed * cos) * (new_a[0] + new_a[1] / 2) + 0.75 * change[0] + 0.25 * change[1] + change[2] / 8)
        push += 2 * ((flow @ along) * width).sum() + 2 * rate
        pull = 2 * np.pi * new_a[0] ** 2 * (1 - held)
        shed_ahead += led if was_shedding else 0.0
        found.append((push * cos + pull * sin, push * sin - pull * cos, shed_ahead))

        place = place + dt * (velocity(place, place, circulation) + velocity(place, plate, width))
        stays = np.abs(place[:, 0] - axis[0]) < ROOM
        dropped += circulation[~stays].sum()
        place, circulation, is_leading = place[stays], circulation[stays], is_leading[stays]
    return np.array(found)


def filtered(history, harmonics, phases):
    """Mean and first harmonics of a period, as the measurement was filtered."""
    n = len(history) - 1
    phase = np.arange(n) / n
    term = lambda k: 2 * ((history[:-1] * np.exp(-2j * np.pi * k * phase)).mean() * np.exp(2j * np.pi * k * phases)).real
    return history[:-1].mean() + sum(term(k) for k in range(1, harmonics + 1))


def baik(critical, dt, periods=3):
    """Rms error and peak of lift, measured peak, of both motions [Baik 2011, thesis, Univ. Michigan]."""
    table = Path(__file__).parents[1] / "crates/wingbeat-verify/data/baik2011_lift_drag.csv"
    lines = (line for line in table.read_text().splitlines() if line.strip() and not line.startswith("#"))
    rows = list(csv.DictReader(lines))
    flow, swing = np.radians(27.182), np.radians(13.16)
    for name, frequency, harmonics in (("W1", 0.5, 7), ("W3", 1.0, 3)):
        period = np.pi / frequency
        fine = np.linspace(0, 1, 4001)
        rate = -np.tan(flow * np.sin(2 * np.pi * fine))
        heights = np.concatenate([[0], np.cumsum((rate[1:] + rate[:-1]) / 2) * period / 4000])
        turn = 2 * np.pi / period
        pitch = lambda t: (np.radians(8) - swing * np.sin(turn * t), -swing * turn * np.cos(turn * t))
        height = lambda t: (np.interp(t / period % 1, fine, heights), -np.tan(flow * np.sin(turn * t)))
        own = [row for row in rows if row["case"] == name]
        phases, lift = (np.array([float(row[key]) for row in own]) for key in ("phase", "CL"))
        steps = round(period / dt)
        last = history(pitch, height, 0.25, period / steps, periods * steps, critical)[-steps - 1 :, 0]
        computed = filtered(last, harmonics, phases)
        yield name, np.sqrt(((computed - lift) ** 2).mean()), computed.max(), lift.max()


def ramp(critical, dt, last=2.0, before=0.4, smoothing=11.0):
    """Travel, lift coefficient and circulation shed by the leading edge of a plate that pitches to 45 deg within a chord of travel
    [Eldredge, Wang & Ol 2009, AIAA 2009-3687]."""

    def pitch(t):
        rise, hold = smoothing * (t - before), smoothing * (t - before - 1)
        angle = 1 + np.log(np.cosh(rise) / np.cosh(hold)) / smoothing
        return np.pi / 8 * angle, np.pi / 8 * (np.tanh(rise) - np.tanh(hold))

    steps = round((last + before) / dt)
    found = history(pitch, lambda t: (0.0, 0.0), 0.0, dt, steps, critical)
    for step in range(steps + 1):
        yield step * dt - before, found[step, 0], found[step, 2]


def wagner(dt):
    """Travel and lift over steady lift after a sudden start, and Wagner's function in R. T. Jones's form."""
    small = 0.01
    found = history(lambda t: (small, 0.0), lambda t: (0.0, 0.0), 0.0, dt, round(2 / dt), None)
    for t in (0.25, 0.5, 1.0, 2.0):
        jones = 1 - 0.165 * np.exp(-0.091 * t) - 0.335 * np.exp(-0.6 * t)
        yield t, found[round(t / dt), 0] / (2 * np.pi * small), jones


def hover(dt, beats=4, stroke=2.8):
    """Mean lift and drag coefficient of each beat of a plate that moves as cos along x and turns about its mid chord while it reverses,
    45 deg at mid stroke; thin: the force of the suction that its edge holds, 0.15, does not act."""
    period = np.pi * stroke
    steps = round(period / dt)
    turn = 2 * np.pi / period
    pitch = lambda t: (np.pi / 2 - np.pi / 4 * np.sin(turn * t), -np.pi / 4 * turn * np.cos(turn * t))
    travel = lambda t: (stroke / 2 * np.cos(turn * t), -np.sin(turn * t))
    found = history(pitch, lambda t: (0.0, 0.0), 0.5, period / steps, beats * steps, 0.15, travel, 1.0)
    middle = (found[1:, :2] + found[:-1, :2]) / 2
    forward = np.sign(np.sin(turn * (np.arange(beats * steps) + 0.5) * period / steps))
    for beat in range(beats):
        own = slice(beat * steps, (beat + 1) * steps)
        yield middle[own, 0].mean(), (middle[own, 1] * forward[own]).mean()


def print_baik(dt):
    for critical in (None, 0.25, 0.18, 0.11):
        for name, error, peak, measured in baik(critical, dt):
            about = "attached" if critical is None else f"critical value {critical}"
            print(f"{name}, {about}: rms error of lift {error:.3f}, peak {peak:.2f} of {measured:.2f}", flush=True)


if __name__ == "__main__":
    words = sys.argv[1:]
    if "quarter" in words:
        words.remove("quarter")
        PLACE, CORE = 1 / 4, 0.005
    what = words.pop(0) if words and words[0] in ("ramp", "wagner", "hover") else "baik"
    dt = float(words[0]) if words else 0.02
    if what == "baik":
        print_baik(dt)
    if what == "ramp":
        print("travel,lift,leading_edge_circulation")
        for travel, lift, shed in ramp(0.18, dt):
            if abs(travel / 0.2 - round(travel / 0.2)) < 0.4 * dt and travel > 0.1:
                print(f"{travel:.2f},{lift:.3f},{shed:.3f}")
    if what == "wagner":
        for travel, lift, jones in wagner(dt):
            print(f"{travel} chords: lift over steady lift {lift:.3f}, Wagner's function {jones:.3f}")
    if what == "hover":
        for beat, (lift, drag) in enumerate(hover(dt if words else 0.055)):
            print(f"beat {beat + 1}: lift {lift:.3f}, drag {drag:.3f}")
