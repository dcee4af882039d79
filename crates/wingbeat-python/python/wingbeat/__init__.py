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

from typing import TYPE_CHECKING, Any

from wingbeat._core import presets as _presets
from wingbeat._core import version as _version
from wingbeat._case import Part
from wingbeat._flight import Flight, Stepper
from wingbeat._frame import Frame, Particles, Surface, Wake
from wingbeat._mechanics import Derivatives, LinearModel, Mode, Power, Trim, WakeModel, WakeTrim
from wingbeat._own import Adjustment, Motions, Sensed
from wingbeat._run import Beats, Estimate, Run, read
from wingbeat._vibration import Flutter, FlutterCondition, FlutterOnset, GrowingMode, Vibrations, WingModes
from wingbeat.errors import AnalysisError, CaseError, Error, FlightError, PackageError, ResultError

if TYPE_CHECKING:
    from wingbeat import campaign
    from wingbeat._problem import Problem

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
    "Flutter",
    "FlutterCondition",
    "FlutterOnset",
    "Frame",
    "GrowingMode",
    "LinearModel",
    "Mode",
    "Motions",
    "PackageError",
    "Part",
    "Particles",
    "Power",
    "Problem",
    "ResultError",
    "Run",
    "Sensed",
    "Stepper",
    "Surface",
    "Trim",
    "Vibrations",
    "Wake",
    "WakeModel",
    "WakeTrim",
    "WingModes",
    "campaign",
    "presets",
    "read",
]


def presets() -> dict[str, str]:
    """Names of the presets, and what each is."""
    return dict(_presets())


def __getattr__(name: str) -> Any:
    """What is imported when it is asked for."""
    from importlib import import_module

    if name == "campaign":
        return import_module("wingbeat.campaign")
    if name == "Problem":
        return import_module("wingbeat._problem").Problem
    raise AttributeError(f"module 'wingbeat' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
