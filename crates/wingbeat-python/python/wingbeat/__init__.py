"""wingbeat: a simulator of flapping-wing flight.

>>> import wingbeat
>>> run = wingbeat.Flight.preset("fruit-fly-blade").set("time.beats", 2).fly()
>>> run.beats["lift_over_weight"].shape
(2,)

A flight is a :class:`Flight`, a flight that was flown a :class:`Run`; :func:`read` opens any result directory.
Lengths are metres, angles radians, and so on: the unit is part of every name. Vectors are components of the
inertial frame N (n1 forward, n2 right, n3 down along gravity) unless said.
"""

from __future__ import annotations

from wingbeat._core import presets as _presets
from wingbeat._core import version as _version
from wingbeat._case import Part
from wingbeat._flight import Flight, Stepper
from wingbeat._frame import Frame, Particles, Surface, Wake
from wingbeat._mechanics import Derivatives, LinearModel, Mode, Power, Trim, WakeModel, WakeTrim
from wingbeat._own import Adjustment, Motions, Sensed
from wingbeat._run import Beats, Estimate, Run, read
from wingbeat.errors import AnalysisError, CaseError, Error, FlightError, ResultError

__version__ = _version()

__all__ = [
    "Adjustment",
    "AnalysisError",
    "Beats",
    "CaseError",
    "Derivatives",
    "Error",
    "Estimate",
    "Flight",
    "FlightError",
    "Frame",
    "LinearModel",
    "Mode",
    "Motions",
    "Part",
    "Particles",
    "Power",
    "ResultError",
    "Run",
    "Sensed",
    "Stepper",
    "Surface",
    "Trim",
    "Wake",
    "WakeModel",
    "WakeTrim",
    "presets",
    "read",
]


def presets() -> dict[str, str]:
    """Names of the presets, and what each is."""
    return dict(_presets())
