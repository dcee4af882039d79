#!/usr/bin/env python3
"""A plunging foil with a flexible rear in plane flow: linear theory, a second method beside the lattice.

The pressure on a thin foil that moves by small harmonic amounts is that of Kuessner and Schwarz (Bisplinghoff, Ashley & Halfman 1955, sec. 5.7):
with an upward velocity of the surface w = U (P0 + 2 sum Pn cos n theta), x = b cos theta, trailing edge at theta = 0,

    jump of pressure (upward) = -rho U^2 (2 a0 tan(theta / 2) + 4 sum an sin n theta),
    a0 = C(k) (P0 + P1) - P1,   an = Pn + i k / (2 n) (P(n-1) - P(n+1)),   k = omega b / U.

Thrust is the suction of the leading edge, pi rho U^2 c |a0|^2 / 2 in the mean [Garrick 1936], and the pressure along the slope of the bent plate.

The plate is Euler and Bernoulli's beam of unit width with E / (1 - nu^2), clamped at the end of the rigid part.

    plunging-plate.py THICKNESS_OVER_CHORD STROUHAL ...        (numpy, scipy; the foil of Heathcote & Gursul 2007)
"""
import sys

import numpy as np
from scipy.special import hankel2

DENSITY, CHORD, SPEED, HEAVE = 1000.0, 0.09, 0.1, 0.0175
YOUNG, POISSON, STEEL, RIGID = 2.05e11, 0.3, 7850.0, 1 / 3
ELEMENTS, TERMS, ANGLES = 32, 60, 4000


def hermite(s, length):
    """Shape functions of a beam element and their slopes at s = 0..1."""
    shape = [1 - 3 * s**2 + 2 * s**3, length * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, length * (s**3 - s**2)]
    slope = [(6 * s**2 - 6 * s) / length, 1 - 4 * s + 3 * s**2, (6 * s - 6 * s**2) / length, 3 * s**2 - 2 * s]
    return np.array(shape), np.array(slope)


def motion(x):
    """Displacement and slope at x by the heave and by the numbers of the beam's nodes."""
    count = 2 * (ELEMENTS + 1)
    length = CHORD * (1 - RIGID) / ELEMENTS
    shape, slope = np.zeros((len(x), count)), np.zeros((len(x), count))
    for i, at in enumerate(x):
        s = (at - RIGID * CHORD) / length
        if s > 0:
            e = min(int(s), ELEMENTS - 1)
            shape[i, 2 * e : 2 * e + 4], slope[i, 2 * e : 2 * e + 4] = hermite(s - e, length)
    return shape[:, 2:], slope[:, 2:]


def plate(thickness):
    """Stiffness and mass of the beam, its clamped node left out."""
    length = CHORD * (1 - RIGID) / ELEMENTS
    bending = YOUNG * thickness**3 / 12 / (1 - POISSON**2)
    a, b = 6 * length, length**2
    k = bending / length**3 * np.array([[12, a, -12, a], [a, 4 * b, -a, 2 * b], [-12, -a, 12, -a], [a, 2 * b, -a, 4 * b]])
    c, d = 22 * length, 13 * length
    m = STEEL * thickness * length / 420 * np.array([[156, c, 54, -d], [c, 4 * b, d, -3 * b], [54, d, 156, -c], [-d, -3 * b, -c, 4 * b]])
    stiff, mass = (np.zeros((2 * (ELEMENTS + 1),) * 2) for _ in range(2))
    for e in range(ELEMENTS):
        stiff[2 * e : 2 * e + 4, 2 * e : 2 * e + 4] += k
        mass[2 * e : 2 * e + 4, 2 * e : 2 * e + 4] += m
    return stiff[2:, 2:], mass[2:, 2:], mass[2:, 0::2].sum(axis=1)


def flight(part, strouhal):
    """Complex pitch [rad] for a heave of HEAVE cos(omega t), the mean thrust over rho U^2 c / 2, and the frequency [Hz]."""
    frequency = strouhal * SPEED / (2 * HEAVE)
    omega, b = 2 * np.pi * frequency, 0.5 * CHORD
    k = omega * b / SPEED
    theodorsen = hankel2(1, k) / (hankel2(1, k) + 1j * hankel2(0, k))
    theta = (np.arange(ANGLES) + 0.5) * np.pi / ANGLES
    shape, slope = motion(b * (1 + np.cos(theta)))
    wash = np.hstack([np.full((ANGLES, 1), 1j * omega), 1j * omega * shape + SPEED * slope]) / SPEED
    p = [np.cos(n * theta) @ wash / ANGLES for n in range(TERMS + 1)]
    edge = theodorsen * (p[0] + p[1]) - p[1]
    jump = 2 * np.outer(np.tan(theta / 2), edge)
    for n in range(1, TERMS):
        jump += 4 * np.outer(np.sin(n * theta), p[n] + 1j * k / (2 * n) * (p[n - 1] - p[n + 1]))
    width = b * np.sin(theta) * np.pi / ANGLES
    load = -DENSITY * SPEED**2 * shape.T @ (jump * width[:, None])
    stiff, mass, carried = plate(part * CHORD)
    known = load[:, 0] + omega**2 * carried
    bent = np.linalg.solve(stiff - omega**2 * mass - load[:, 1:], known * HEAVE)
    moved = np.concatenate([[HEAVE], bent])
    along = -np.real(np.vdot(slope @ bent, width * (jump @ moved))) / CHORD
    return bent[-2] / CHORD, along + np.pi * abs(edge @ moved) ** 2, frequency


if __name__ == "__main__":
    thickness = float(sys.argv[1])
    for number in map(float, sys.argv[2:]):
        angle, thrust, hertz = flight(thickness, number)
        print(f"St {number:.4f}  {hertz:.4f} Hz  pitch {np.degrees(abs(angle)):.4f} deg, phase {np.degrees(np.angle(angle)):.1f} deg  thrust {thrust:.4f}")
