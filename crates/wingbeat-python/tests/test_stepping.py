"""Flights that are flown step by step, and copies of them."""

from __future__ import annotations

import copy
import sys

import numpy as np
import pytest

import wingbeat
from wingbeat import Adjustment, Flight

TINY = {"time.beats": 2, "wing.right.mesh.chordwise": 2, "wing.right.mesh.spanwise": 3, "output.frames_every": 1}
LIKE = {
    "blade elements": lambda: Flight.preset("fruit-fly-blade").set({"time.beats": 1, "time.steps_per_beat": 20}),
    "held first": lambda: Flight.preset("fruit-fly-hover").set(TINY | {"time.steps_per_beat": 12, "flight.held_beats": 1}),
    "elastic wings": lambda: Flight.preset("hawkmoth-elastic").set({"time.beats": None, "time.steps": 12}),
    "a case's regulator": lambda: Flight.preset("fruit-fly-controlled").set(TINY | {"time.steps_per_beat": 12}),
}


def followed(stepper: wingbeat.Stepper, count: int) -> wingbeat.Run:
    stepper.step(count)
    return stepper.run


@pytest.mark.parametrize("name", LIKE)
@pytest.mark.parametrize("made", [0, 2, 9])
def test_agrees_a_copy_with_the_flight_it_is_of(name, made):
    first = LIKE[name]().start()
    first.step(made)
    second = first.copy()
    assert second.steps_done == made and second.time_s == first.time_s
    if first.frame.surface.nodes_m.size:
        np.testing.assert_array_equal(second.frame.surface.pressure_jump_pascal, first.frame.surface.pressure_jump_pascal)
    once, again, whole = followed(second, 3), followed(first, 3), followed(LIKE[name]().start(), made + 3)
    for column, numbers in whole.arrays.items():
        np.testing.assert_array_equal(again.arrays[column], numbers, err_msg=column)
        np.testing.assert_array_equal(once.arrays[column], numbers, err_msg=column)
    assert once.frame_steps == whole.frame_steps


def test_behaves_commands_are_tried_on_copies(blade):
    """The flight that was branched from does not know what was tried."""
    command = Adjustment()
    flight = blade.set("time.beats", 3).with_controller(lambda _: command)
    real, untouched = flight.start(), flight.start()
    beat = round(flight.period_s / flight.step_s)
    height = {}
    for amplitude in (-0.2, 0.0, 0.2):
        command = Adjustment(stroke_amplitude=amplitude)
        height[amplitude] = followed(copy.copy(real), 2 * beat).arrays["body_z_m"][-1]
    assert height[0.2] < height[0.0] < height[-0.2]  # n3 points down
    command = Adjustment()
    np.testing.assert_array_equal(followed(real, beat).arrays["body_z_m"], followed(untouched, beat).arrays["body_z_m"])


def test_agrees_a_copy_with_a_program_that_controls(blade, tmp_path):
    """It counts its looks in the memory that it is given back: the copy's program goes on with that."""
    program = tmp_path / "counts.py"
    program.write_text(
        "import json, sys\n"
        "for line in sys.stdin:\n"
        "    looks = (json.loads(line).get('memory') or [0])[0] + 1\n"
        "    wings = [{'stroke_amplitude': 0.01 * looks}] * 2\n"
        "    print(json.dumps({'wings': wings, 'memory': [looks]}), flush=True)\n"
    )
    keys = {"time.beats": 4, "control.controller": "external", "control.external.command": [sys.executable, str(program)]}
    flight = blade.set(keys)
    first, made = flight.start(), 2 * round(flight.period_s / flight.step_s) + 3
    first.step(made)
    once, again, whole = followed(first.copy(), 50), followed(first, 50), followed(flight.start(), made + 50)
    for column, numbers in whole.arrays.items():
        np.testing.assert_array_equal(once.arrays[column], numbers, err_msg=column)
        np.testing.assert_array_equal(again.arrays[column], numbers, err_msg=column)


def test_refuses_copies_of_flights_whose_parts_remember(blade):
    class Counting:
        def reset(self) -> None:
            self.looks = 0

        def __call__(self, _: wingbeat.Sensed) -> Adjustment:
            self.looks += 1
            return Adjustment()

    class Remembering:
        def __call__(self, _: wingbeat.Motions) -> np.ndarray:
            return np.zeros((3, 6))

        def accept(self, step: int) -> None: ...

    for flight in (blade.with_controller(Counting()), blade.with_air(Remembering())):
        with pytest.raises(wingbeat.CaseError, match="remembers") as caught:
            flight.start().copy()
        assert caught.value.remedy
    assert copy.deepcopy(blade.with_air(lambda _: np.zeros((3, 6))).start()).step(2) == 2
