"""Controllers, models of the air and motions that are written in Python."""

from __future__ import annotations

import pickle
import time

import numpy as np
import pytest

import wingbeat
from wingbeat import Flight


def test_behaves_a_controller_sees_at_its_own_rate_and_moves_the_wings(blade):
    seen = []

    def more(sensed: wingbeat.Sensed) -> wingbeat.Adjustment:
        seen.append(sensed)
        return wingbeat.Adjustment(stroke_amplitude=0.1)

    flight = blade.set("time.beats", 3)
    more_lift, free = flight.with_controller(more).fly(), flight.fly()
    np.testing.assert_allclose([s.time_s for s in seen], np.arange(4) * flight.period_s, rtol=1e-12)
    for axis in range(3):
        told = [s.mass_centre_m[axis] for s in seen]
        np.testing.assert_array_equal(told, more_lift.arrays[f"mass_centre_n{axis + 1}_m"][::100])
    np.testing.assert_allclose(seen[2].rotation @ seen[2].rotation.T, np.eye(3), atol=1e-12)
    assert (more_lift.arrays["command_wing_right_stroke_amplitude_dimensionless"] == 0.1).all()
    # The swing grows by a tenth within the first beat, lift by some (1.1)^2 - 1 = 21 % after it.
    lift = more_lift.beats["lift_over_weight"][1] / free.beats["lift_over_weight"][1]
    assert 1.1 < lift < 1.3


def test_agrees_a_controller_that_commands_nothing_with_the_free_flight(blade):
    still = blade.with_controller(lambda _: wingbeat.Adjustment(), every_steps=10).fly()
    for column, numbers in blade.fly().arrays.items():
        np.testing.assert_allclose(still.arrays[column], numbers, rtol=1e-9, atol=1e-8 * max(1.0, np.nanmax(np.abs(numbers))))  # beats known beforehand differ by roundings


def test_behaves_a_controller_is_reset_when_a_flight_begins(blade):
    class Counting:
        resets = looks = 0

        def reset(self) -> None:
            self.resets += 1
            self.looks = 0

        def __call__(self, _sensed: wingbeat.Sensed) -> list[wingbeat.Adjustment]:
            self.looks += 1
            return [wingbeat.Adjustment()] * 2

    counting = Counting()
    flight = blade.with_controller(counting, every_steps=50)
    flight.fly()
    flight.fly()
    assert (counting.resets, counting.looks) == (2, 5)


def test_behaves_an_exception_in_a_controller_stops_the_flight_and_keeps_it(blade):
    def fails(sensed: wingbeat.Sensed) -> wingbeat.Adjustment:
        if sensed.look == 1:
            raise ZeroDivisionError("gain")
        return wingbeat.Adjustment()

    with pytest.raises(ZeroDivisionError, match="gain") as caught:
        blade.with_controller(fails).fly()
    run = caught.value.run
    assert run.outcome == "failed" and len(run.arrays["time_s"]) == 100
    np.testing.assert_array_equal(run.arrays["body_z_m"], blade.fly().arrays["body_z_m"][:100])
    stepper = blade.with_controller(fails).start()
    with pytest.raises(ZeroDivisionError) as caught:
        stepper.step(1000)
    assert stepper.is_finished and stepper.run.outcome == caught.value.run.outcome == "failed"
    assert stepper.steps_done + 1 == len(stepper.run.arrays["time_s"]) == 100
    assert stepper.time_s == stepper.run.arrays["time_s"][-1]


def test_behaves_an_exception_at_the_start_has_no_run(blade):
    def fails(_: object) -> None:
        raise ZeroDivisionError("gain")

    def stops(_: object) -> None:
        raise KeyboardInterrupt

    for flight, kind in (
        (blade.with_controller(fails), ZeroDivisionError),
        (blade.with_controller(stops), KeyboardInterrupt),
        (blade.with_air(fails), ZeroDivisionError),
    ):
        for fly in (flight.fly, flight.start):
            with pytest.raises(kind) as caught:
                fly()
            assert caught.value.run is None


def test_exact_vacuum_written_in_python_is_vacuum():
    flight = wingbeat.Flight.preset("fruit-fly-vacuum").set("time.beats", 1)
    own = flight.with_air(lambda motions: np.zeros((3, 6))).fly()
    for column, numbers in flight.fly().arrays.items():
        np.testing.assert_allclose(own.arrays[column], numbers, rtol=1e-9, atol=1e-8 * max(1.0, np.nanmax(np.abs(numbers))))  # beats known beforehand differ by roundings


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("air.stream_m_s", [0.3, 0.0, 0.0]),
        ("air.gust", [{"amplitude_m_s": [0.1, 0.0, 0.0], "start_s": 1e-3, "duration_s": 1e-3}]),
        ("air.shear_1_s", [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]),
        ("air.density_kg_m3", 1.0),
        ("air.blade.body_drag.area_m2", 1e-6),
    ],
)
def test_refuses_what_air_written_in_python_would_lose(blade, key, value):
    def air(_motions: wingbeat.Motions) -> np.ndarray:
        return np.zeros((3, 6))

    told = blade.set(key, value)
    with pytest.raises(wingbeat.CaseError, match="your own") as caught:
        told.with_air(air)
    assert caught.value.key == key and caught.value.remedy
    away = key.removesuffix(".area_m2")  # a drag of the body has an area
    assert told.set(away, None).with_air(air).steps == blade.steps


def test_refuses_streams_of_a_file_beside_air_written_in_python(blade):
    case = blade.case
    case.air.stream_m_s = [0.3, 0.0, 0.0]
    with pytest.raises(wingbeat.CaseError, match="your own"):
        Flight.from_case(case).with_air(lambda _: np.zeros((3, 6)))
    case.air.stream_m_s = [0.0, 0.0, 0.0]
    case.air.density_kg_m3 = 1.0
    Flight.from_case(case).with_air(lambda _: np.zeros((3, 6)))


@pytest.mark.parametrize("name", ["fruit-fly-hover", "fruit-fly-blade", "hawkmoth-blade", "locust-blade", "robobee"])
def test_behaves_presets_fly_in_air_written_in_python(name):
    flight = Flight.preset(name)
    count = len(flight._core.wings) + 1
    assert flight.with_air(lambda _: np.zeros((count, 6))).steps == flight.steps


def test_exact_a_steady_force_on_the_body_accelerates_all_of_it():
    """The mass centre of the whole moves by F t^2 / 2 m; the fourth-order method has that to rounding."""
    flight = wingbeat.Flight.preset("fruit-fly-vacuum").set("time.beats", 1)
    force = 3.0 * 9.81 * flight.mass_kg

    def pull(_motions: wingbeat.Motions) -> list[list[float]]:
        return [[force, 0, 0, 0, 0, 0], [0] * 6, [0] * 6]

    pulled, free = flight.with_air(pull).fly(), flight.fly()
    time_s = free.arrays["time_s"]
    moved = pulled.arrays["mass_centre_n1_m"] - free.arrays["mass_centre_n1_m"]
    expected = 0.5 * force / flight.mass_kg * time_s**2
    np.testing.assert_allclose(moved, expected, atol=1e-9 * expected[-1])


def test_behaves_air_written_in_python_is_trimmed_in_where_it_says_that_it_is_steady(blade):
    """Air that carries the weight whatever the wings do, with drag and damping, as a gust may change it."""
    weight = 9.81 * blade.mass_kg

    def air(motions: wingbeat.Motions) -> np.ndarray:
        loads = np.zeros((3, 6))
        loads[0, :3] = -1e-5 * motions.velocity_m_per_s[0] - np.array([0.0, 0.0, weight])
        loads[0, 3:] = -1e-9 * motions.angular_velocity_rad_per_s[0]
        return loads

    with pytest.raises(wingbeat.AnalysisError, match="model of your own") as caught:
        blade.with_air(air).trim()
    assert "is_steady_and_uniform" in caught.value.remedy
    air.is_steady_and_uniform = True
    try:
        blade.with_air(air).trim()  # flown, whether steady flight is found or not
    except wingbeat.AnalysisError as error:
        assert "model of your own" not in str(error)
    air.is_steady_and_uniform = "yes"
    with pytest.raises(wingbeat.CaseError, match="is_steady_and_uniform") as caught:
        blade.with_air(air)
    assert caught.value.key == "air"


class Remembering:
    """Air with a memory: drag of the body by its velocity at the last accepted step."""

    def open(self, names: list[str], step_s: float) -> None:
        self.names, self.accepted, self.asked = names, [], np.zeros(3)

    def __call__(self, motions: wingbeat.Motions) -> np.ndarray:
        assert motions.rotation.shape == (3, 3, 3)
        self.asked = motions.velocity_m_per_s[0]
        loads = np.zeros((3, 6))
        loads[0, :3] = -1e-6 * self.asked
        return loads

    def accept(self, step: int) -> None:
        self.accepted.append(step)


def test_behaves_air_with_a_memory_is_told_what_holds():
    air = Remembering()
    keys = {"time.beats": 1, "dynamics.integrator": "hamming"}
    flight = wingbeat.Flight.preset("fruit-fly-vacuum").set(keys)
    run = flight.with_air(air).fly()
    assert air.names[0] == "body" and len(air.names) == 3
    assert air.accepted[-1] == flight.steps and set(air.accepted) == set(range(flight.steps + 1))
    assert run.arrays["air_body_force_n3_newton"][-1] < 0.0, "drag points up against the fall"


def test_agrees_a_motion_from_a_function_with_one_from_an_array(blade):
    def stroke(phase: float) -> float:
        return 60.0 * np.cos(2 * np.pi * phase)

    phases = np.arange(48) / 48
    one = blade.with_motion(phi_deg=stroke, samples=48)
    other = blade.with_motion(phi_deg=60.0 * np.cos(2 * np.pi * phases))
    assert one.case_text == other.case_text
    angle = one.fly().arrays["wing_right_prescribed_phi_rad"]
    time_s = np.arange(angle.size) * one.step_s
    # A cubic spline through n points of a cosine errs by 5 (2 pi / n)^4 / 384 of its amplitude.
    error = np.abs(np.degrees(angle) - 60.0 * np.cos(2 * np.pi * time_s / one.period_s)).max()
    assert error < 1.5 * 60.0 * 5 * (2 * np.pi / 48) ** 4 / 384
    left = one.fly().arrays["wing_left_prescribed_phi_rad"]
    np.testing.assert_allclose(left, -angle, atol=1e-12)


@pytest.mark.parametrize("wing", [None, "right"])
def test_behaves_a_motion_of_all_angles_replaces_the_data(blade, wing):
    """Of two angles the third is that of the data; with all three nothing is left of them."""
    cosine, sine = 60.0 * np.cos(2 * np.pi * np.arange(48) / 48), 40.0 * np.sin(2 * np.pi * np.arange(48) / 48)
    assert "data" in blade.case.motion
    flight = blade.set("time.beats", 1).with_motion(phi_deg=cosine, theta_deg=0.0 * sine, psi_deg=-sine, wing=wing)
    run = flight.fly().arrays
    np.testing.assert_allclose(run["wing_left_prescribed_phi_rad"], -run["wing_right_prescribed_phi_rad"], atol=1e-12)
    np.testing.assert_allclose(run["wing_right_prescribed_theta_rad"], 0.0, atol=1e-12)
    again = pickle.loads(pickle.dumps(flight))
    assert again.case_text == flight.case_text
    assert "data" in blade.with_motion(phi_deg=cosine, psi_deg=-sine).case.motion


@pytest.mark.timed
def test_behaves_a_look_costs_less_than_a_tenth_of_a_millisecond(blade):
    flight = blade.set("time.beats", 20)
    nothing = flight.with_controller(lambda _: wingbeat.Adjustment(), every_steps=4)

    def seconds(f: wingbeat.Flight) -> float:
        begun = time.process_time()  # other work on the machine is not ours
        f.fly()
        return time.process_time() - begun

    cost = min(seconds(nothing) for _ in range(5)) - min(seconds(flight) for _ in range(5))
    assert cost / (flight.steps / 4) < 1e-4
