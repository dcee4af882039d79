"""Flights that are asked for within their own step: by their controller, by their air, by other threads."""

from __future__ import annotations

import copy
import multiprocessing
import threading

import numpy as np
import pytest

import wingbeat
from wingbeat import Adjustment, Flight

ASKED = {
    "time_s": lambda s: s.time_s,
    "steps_done": lambda s: s.steps_done,
    "is_finished": lambda s: s.is_finished,
    "frame": lambda s: s.frame,
    "run": lambda s: s.run,
    "air_velocity": lambda s: s.air_velocity([0.0, 0.0, 0.0]),
    "step": lambda s: s.step(),
    "copy": copy.copy,
}


def answers(steppers: list[wingbeat.Stepper], told: dict[str, object]) -> None:
    """What the flight says of itself within a step, once it is under way."""
    for stepper in steppers:
        told["repr"] = repr(stepper)
        for name, ask in ASKED.items():
            try:
                told[name] = ask(stepper)
            except wingbeat.CaseError as error:
                told[name] = error


def steered(blade: Flight, told: dict[str, object]) -> tuple[Flight, list[wingbeat.Stepper]]:
    steppers: list[wingbeat.Stepper] = []

    def controller(_: wingbeat.Sensed) -> Adjustment:
        answers(steppers, told)
        return Adjustment()

    return blade.with_controller(controller, every_steps=10), steppers


def in_own_air(blade: Flight, told: dict[str, object]) -> tuple[Flight, list[wingbeat.Stepper]]:
    steppers: list[wingbeat.Stepper] = []

    def air(_: wingbeat.Motions) -> np.ndarray:
        answers(steppers, told)
        return np.zeros((3, 6))

    return blade.with_air(air), steppers


@pytest.mark.parametrize("part", [steered, in_own_air])
def test_refuses_a_part_that_asks_for_its_own_flight_within_a_step(blade, part):
    told: dict[str, object] = {}
    flight, steppers = part(blade, told)
    stepper = flight.start()
    steppers.append(stepper)
    assert stepper.step(12) == 12 and stepper.steps_done == 12
    assert told.pop("repr") == "<wingbeat.Stepper within a step>" and set(told) == set(ASKED)
    for name, error in told.items():
        assert isinstance(error, wingbeat.CaseError), name
        assert error.key == "stepper" and "within a step" in str(error) and "between calls of step()" in error.remedy


def test_behaves_a_part_that_asks_and_fails_ends_the_flight_with_its_run(blade):
    steppers: list[wingbeat.Stepper] = []

    def controller(sensed: wingbeat.Sensed) -> Adjustment:
        return Adjustment(stroke_amplitude=0.0 * sum(s.time_s for s in steppers))

    steppers.append(blade.with_controller(controller, every_steps=10).start())
    with pytest.raises(wingbeat.CaseError, match="within a step") as caught:
        steppers[0].step(20)
    assert caught.value.run.outcome == "failed" and steppers[0].steps_done == 9


def test_behaves_other_threads_wait_for_the_end_of_a_step(blade):
    """Another thread asks while a controller waits for a moment: it is answered after the step."""
    asks, steppers, times = threading.Event(), [], []

    def ask() -> None:
        asks.set()
        times.append(steppers[0].steps_done)

    def controller(_: wingbeat.Sensed) -> Adjustment:
        if steppers:
            other.start()
            asks.wait(10)
            other.join(0.05)  # it waits
            assert not times
        return Adjustment()

    other = threading.Thread(target=ask)
    flight = blade.with_controller(controller, every_steps=50)
    steppers.append(flight.start())
    assert steppers[0].step(60) == 60
    other.join(10)
    assert times and 50 <= times[0] <= 60


def in_a_fork(send) -> None:
    told: dict[str, object] = {}
    flight, steppers = steered(Flight.preset("fruit-fly-blade").set("time.beats", 1), told)
    steppers.append(flight.start())
    steppers[0].step(12)
    send.send((told["repr"], str(told["time_s"])))


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="there are no forks here")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_refuses_it_in_forks_too(blade):
    """Their steps are made by threads of a pool of their own."""
    blade.start().step(2)
    here, there = multiprocessing.get_context("fork").Pipe(duplex=False)
    process = multiprocessing.get_context("fork").Process(target=in_a_fork, args=(there,))
    process.start()
    assert here.poll(60), "the fork does not answer"
    shown, problem = here.recv()
    process.join(10)
    assert shown == "<wingbeat.Stepper within a step>" and "within a step" in problem


LATTICE = {
    "time.beats": 2,
    "time.steps_per_beat": 12,
    "flight.held_beats": 1,
    "wing.right.mesh.chordwise": 2,
    "wing.right.mesh.spanwise": 3,
}
POINTS = np.array([[0.0, 0.0, 1e-3], [1e-3, 1e-3, 2e-3], [-2e-3, 0.0, 3e-3]])


@pytest.mark.parametrize("integrator", ["hamming", "bdf"])
def test_agrees_the_air_at_a_look_with_that_after_its_step(integrator):
    """With the same bits, at the release and after it, and a flight whose controller feels the air with one that does not."""
    keys = LATTICE | {"dynamics.integrator": integrator}
    flight = Flight.preset("fruit-fly-hover").set(keys)
    felt: list[np.ndarray] = []

    def feels(sensed: wingbeat.Sensed) -> Adjustment:
        felt.append(sensed.air_velocity(POINTS))
        np.testing.assert_array_equal(sensed.air_velocity(points_m=POINTS[0]), felt[-1][:1])
        return Adjustment(stroke_amplitude=0.05)

    stepper, after = flight.with_controller(feels, every_steps=4).start(), []
    while stepper.step():
        if len(felt) > len(after):
            after.append(stepper.air_velocity(POINTS))
    assert len(felt) == len(after) == 4
    np.testing.assert_array_equal(felt, after)
    assert np.abs(felt).min() > 0.0 and len({row.tobytes() for row in felt}) == 4
    free = flight.with_controller(lambda _: Adjustment(stroke_amplitude=0.05), every_steps=4).fly()
    np.testing.assert_array_equal(stepper.run.arrays["body_z_m"], free.arrays["body_z_m"])


def test_refuses_to_tell_of_air_that_is_no_lattice_and_of_looks_that_are_over(blade):
    looks: list[wingbeat.Sensed] = []

    def keeps(sensed: wingbeat.Sensed) -> Adjustment:
        looks.append(sensed)
        return Adjustment()

    Flight.preset("fruit-fly-hover").set(LATTICE).with_controller(keeps, every_steps=4).fly()
    with pytest.raises(wingbeat.CaseError, match="this look is over") as caught:
        looks[0].air_velocity(POINTS)
    assert caught.value.key == "sensed" and "stepper" in caught.value.remedy
    for wrong in ([[np.nan, 0.0, 0.0]], np.zeros((3, 2)), "a"):
        with pytest.raises(wingbeat.CaseError) as caught:
            looks[0].air_velocity(wrong)
        assert caught.value.key == "points_m"
    with pytest.raises(wingbeat.CaseError, match="no vortex lattice") as caught:
        blade.with_controller(lambda sensed: sensed.air_velocity(POINTS)).fly()
    assert caught.value.key == "air.model"
