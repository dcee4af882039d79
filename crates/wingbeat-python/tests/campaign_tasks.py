"""What tests of campaigns do at points, in a module that workers can import."""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import wingbeat

MPI = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
}
"""What Open MPI 4 and 5 need to start more processes than there are processors, as whoever runs the tests."""


def mean_lift(flight: wingbeat.Flight) -> dict[str, float]:
    """A number of one's own, of a flight that is quick."""
    return {"lift": float(flight.fly().beats["lift_newton"].mean()), "unasked": 1.0}


def deadly(flight: wingbeat.Flight) -> dict[str, float]:
    """Kills the process it runs in at 200 Hz."""
    frequency = flight.case.motion.frequency_hz
    if frequency == 200.0:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"frequency": frequency}


def slow(flight: wingbeat.Flight) -> dict[str, float]:
    """Takes a while."""
    time.sleep(0.05)
    return {"frequency": flight.case.motion.frequency_hz}


def threads(flight: wingbeat.Flight) -> dict[str, float]:
    """Threads that a flight in this process makes."""
    before = len(os.listdir("/proc/self/task"))
    flight.fly()
    return {"threads": len(os.listdir("/proc/self/task")) - before}


def positive_power(flight: wingbeat.Flight) -> dict[str, float]:
    """Mean of the positive power of the hinges over a beat [W], and lift over weight."""
    run = flight.fly(frames=False)
    power = run.arrays["hinge_wing_left_power_watt"] + run.arrays["hinge_wing_right_power_watt"]
    positive = np.maximum(power, 0)
    mean = (positive.sum() - 0.5 * (positive[0] + positive[-1])) / (positive.size - 1)
    return {"positive": float(mean), "lift": run.beats["lift_over_weight"][-1]}


def fruit_fly(point: dict[str, float]) -> wingbeat.Flight:
    """A flight of a number that no case has."""
    return wingbeat.Flight.preset("fruit-fly-blade").set({"time.beats": 1, "motion.frequency_hz": 100 * point["double"]})


def wrong(flight: wingbeat.Flight) -> dict[str, float]:
    """A function with a mistake."""
    raise KeyError(flight.name)


def exits(flight: wingbeat.Flight) -> dict[str, float]:
    """A function that ends its program."""
    sys.exit("over")


def number(factor: Any) -> float:
    """The number that is somehow in what a function carries."""
    if callable(factor):
        return float(factor(None)["x"])
    if isinstance(factor, Study):
        return factor.factor
    if isinstance(factor, dict):
        return float(factor["a"])
    return 7.0 if isinstance(factor, wingbeat.Flight) else float(np.ravel(factor)[0])


def scaled(factor: Any) -> Callable[[Any], dict[str, float]]:
    """A function that carries ``factor``."""

    def do(flight: Any) -> dict[str, float]:
        return {"x": number(factor)}

    return do


class Study:
    """A method carries its object."""

    def __init__(self, factor: float) -> None:
        self.factor = factor

    def do(self, flight: wingbeat.Flight) -> dict[str, float]:
        """Its number."""
        return {"x": self.factor}
