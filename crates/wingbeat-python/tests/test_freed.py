"""Flights are freed with the objects whose methods steer them or are their air."""

from __future__ import annotations

import gc
import time
import weakref
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import wingbeat
from wingbeat import Adjustment, Flight


class Own:
    """An object that keeps a flight under its own method."""

    is_steady_and_uniform = True

    def __init__(self, keep: Callable[[Any], Any]) -> None:
        self.kept = keep(self)

    def control(self, _: wingbeat.Sensed) -> Adjustment:
        return Adjustment()

    def __call__(self, motions: wingbeat.Motions) -> np.ndarray:
        """Drag and damping of all bodies."""
        drag = np.array([1e-6, 1e-8, 1e-8])[:, None]
        return -np.hstack([drag * motions.velocity_m_per_s, 1e-6 * drag * motions.angular_velocity_rad_per_s])


class Remembering(Own):
    """Air with a memory."""

    def accept(self, step: int) -> None: ...


KEPT = {
    "a flight under its method": (Own, lambda f, own: f.with_controller(own.control)),
    "a flight in its air": (Own, lambda f, own: f.with_air(own)),
    "a flight in progress under its method": (Own, lambda f, own: f.with_controller(own.control).start()),
    "a flight in progress in its air": (Own, lambda f, own: f.with_air(own).start()),
    "one whose air has a memory": (Remembering, lambda f, own: f.with_air(own).start()),
    "both": (Own, lambda f, own: f.with_controller(own.control).with_air(own).start()),
    "a copy": (Own, lambda f, own: f.with_controller(own.control).start().copy()),
    "a trim in its air": (Own, lambda f, own: f.with_air(own).trim()),
    "what was flown": (Own, lambda f, own: f.with_controller(own.control).fly()),
}


@pytest.mark.parametrize("name", KEPT)
def test_behaves_an_object_is_freed_with_the_flight_that_it_keeps(blade, name):
    kind, keep = KEPT[name]
    own = kind(lambda own: keep(blade, own))
    if isinstance(own.kept, wingbeat.Stepper):
        own.kept.step(3)
    told = weakref.ref(own)
    gc.collect()
    assert told() is not None
    del own
    gc.collect()
    assert told() is None


def test_behaves_a_function_is_freed_with_the_flight_that_it_refers_to(blade):
    def closed() -> weakref.ref[Any]:
        kept: list[object] = []

        def controller(_: wingbeat.Sensed) -> Adjustment:
            return Adjustment(stroke_amplitude=0.1 * len(kept))

        kept.append(blade.with_controller(controller).start())
        return weakref.ref(controller)

    told = [closed() for _ in range(5)]
    gc.collect()
    assert not any(ref() for ref in told)


def test_behaves_what_flies_keeps_its_parts(blade):
    """A flight, a copy, a trim and what was flown need nothing beside them."""

    def free(_: wingbeat.Sensed) -> Adjustment:
        return Adjustment(stroke_amplitude=0.1)

    told = weakref.ref(free)
    stepper = blade.with_controller(free, every_steps=10).start().copy()
    run = blade.with_controller(free, every_steps=10).fly()
    own = Own(lambda own: blade.with_air(own).trim())
    del free
    gc.collect()
    stepper.step(1000)
    np.testing.assert_array_equal(stepper.run.arrays["body_z_m"], run.arrays["body_z_m"])
    assert told() is not None
    del stepper
    gc.collect()
    assert told() is None
    assert run.summary and run.beats["lift_newton"].size
    trim = own.kept
    del own
    gc.collect()
    assert isinstance(trim.residual, np.ndarray)


def test_behaves_a_flight_that_was_left_to_itself_ends_when_its_parts_are_gone(blade):
    """Its thread goes on for a moment after an exception in `progress`."""
    looks: list[int] = []

    def slow(sensed: wingbeat.Sensed) -> Adjustment:
        looks.append(sensed.look)
        time.sleep(0.3)
        return Adjustment()

    def stop(_done: int, _of: int) -> None:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        blade.with_controller(slow, every_steps=4).fly(progress=stop)
    told = weakref.ref(slow)
    del slow
    deadline = time.monotonic() + 10
    while told() is not None and time.monotonic() < deadline:
        time.sleep(0.05)
        gc.collect()
    assert told() is None and len(looks) < 5
