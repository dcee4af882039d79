"""A controller in another program: a fruit fly hovers by proportional-derivative loops. Protocol: docs/control.md.

    wingbeat trim fruit-fly-blade --write hover.toml
    wingbeat run hover.toml --set time.beats=60 --set control.controller=external \
        --set 'control.external={command=["python3", "hover.py"]}'
"""
import json
import sys

LIMIT = 0.3  # rad: leans no farther


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def returning(omega, x, rate):
    """Acceleration that brings x back with the natural frequency omega, critically damped."""
    return -omega * omega * x - 2.0 * omega * rate


def lean(x, rate):
    """Tilt against a departure [m] and a drift [m/s]."""
    return max(-LIMIT, min(LIMIT, returning(8.0, x, rate) / 9.81))


for line in sys.stdin:
    seen = json.loads(line)
    beat = seen["period_s"]
    rows = seen["attitude"]  # from body axes to inertial ones: forward, right, down
    spin = [dot(row, seen["angular_velocity_rad_s"]) for row in rows]
    # What it held at the first look: attitude, angular velocity, velocity.
    start = seen["memory"] or sum(rows, []) + spin + seen["mass_centre_velocity_m_s"]
    turn = [[dot(row, start[3 * k : 3 * k + 3]) for k in range(3)] for row in rows]
    tilt = [turn[2][1] - turn[1][2], turn[0][2] - turn[2][0], turn[1][0] - turn[0][1]]  # twice the tilt
    rate = [(a - b) * beat for a, b in zip(spin, start[9:12])]
    drift = [a - b for a, b in zip(seen["mass_centre_velocity_m_s"], start[12:15])]
    place = [a - b for a, b in zip(seen["mass_centre_m"], seen["reference"]["position_m"])]
    # Nose up accelerates backwards, right wing down to the right. Accelerations in rad per wingbeat squared.
    roll = returning(0.45, 0.5 * tilt[0] - lean(place[1], drift[1]), rate[0])
    pitch = returning(0.25, 0.5 * tilt[1] + lean(place[0], drift[0]), rate[1])
    heading = returning(0.45, 0.5 * tilt[2], rate[2])
    # What the controls do to this fly: `wingbeat derivatives` over its mass and inertia.
    amplitude = returning(20.0, place[2], drift[2]) / -16.5
    apart = -0.95 * roll - 0.63 * heading  # right less left amplitude
    planes = 0.91 * roll + 1.06 * heading  # right less left stroke plane, rad
    wings = []
    for wing in seen["wings"]:
        side = 0.5 if wing["side"] == "right" else -0.5
        offset, plane = 1.32 * pitch, side * planes
        degrees = {"stroke_offset_deg": 57.3 * offset, "stroke_plane_deg": 57.3 * plane}
        wings.append({"stroke_amplitude": amplitude + side * apart, **degrees})
    print(json.dumps({"wings": wings, "memory": start}), flush=True)
