"""Controllers in other programs and in Python: what they see, what is counted, what has no effect."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest

import wingbeat
from wingbeat import Adjustment, Flight, campaign

PROGRAM = """import json, sys
for line in sys.stdin:
    seen = json.loads(line)
    print(line, end="", file=open("LOG", "a"), flush=True)
    look = seen["look"]
    print(json.dumps({"wings": [ANSWER for _ in seen["wings"]]}), flush=True)
"""
SHORT = {"air.model": "blade_element", "time.steps_per_beat": 40, "time.beats": 3}


def steered(flight: Flight, tmp_path: Path, answer: str, **more: object) -> Flight:
    """Under a program that answers ``answer`` for every wing and keeps what it was told."""
    program = tmp_path / "program.py"
    program.write_text(PROGRAM.replace("ANSWER", answer).replace("LOG", str(tmp_path / "log")))
    external = {"command": [sys.executable, str(program)], "timeout_s": 60}
    keys = {"control.controller": "external", "control.external": external}
    return flight.set(SHORT | keys | {f"control.{key}": value for key, value in more.items()})


def test_exact_a_program_sees_one_error_of_place_and_one_of_velocity(tmp_path):
    sensors = {"seed": 3, "position_noise_m": 1e-4, "velocity_noise_m_s": 0.01, "velocity_bias_m_s": [0.5, 0, 0]}
    flight = steered(Flight.preset("fruit-fly-blade"), tmp_path, "{}", sensors=sensors)
    run = flight.fly().arrays
    told = [json.loads(line) for line in (tmp_path / "log").read_text().splitlines()]
    rows = slice(None, None, 40)
    body = np.stack([run[f"body_{axis}_m"][rows] for axis in "xyz"], axis=1)
    centre = np.stack([run[f"mass_centre_n{k}_m"][rows] for k in (1, 2, 3)], axis=1)
    of_body = np.array([t["position_m"] for t in told]) - body
    of_centre = np.array([t["mass_centre_m"] for t in told]) - centre
    assert len(told) == 4 and np.abs(of_body).min() > 0.0 and np.abs(of_body).max() < 6e-4
    np.testing.assert_allclose(of_body, of_centre, atol=1e-12)
    rates = np.array([t["velocity_m_s"] for t in told]) - np.array([t["mass_centre_velocity_m_s"] for t in told])
    plain = steered(Flight.preset("fruit-fly-blade"), tmp_path, "{}")
    (tmp_path / "log").unlink()
    plain.fly()
    true = [json.loads(line) for line in (tmp_path / "log").read_text().splitlines()]
    differences = np.array([t["velocity_m_s"] for t in true]) - np.array([t["mass_centre_velocity_m_s"] for t in true])
    np.testing.assert_allclose(rates, differences, atol=1e-9)
    errors = np.array([t["velocity_m_s"] for t in told]) - np.array([t["velocity_m_s"] for t in true])
    np.testing.assert_allclose(errors.mean(axis=0), [0.5, 0.0, 0.0], atol=0.03)


def test_behaves_looks_at_which_limits_cut_a_program_are_counted(tmp_path):
    flight = steered(
        Flight.preset("fruit-fly-blade"), tmp_path, '{"stroke_amplitude": 0.1 * look}', amplitude_limit=0.15
    )
    run = flight.fly().arrays
    np.testing.assert_array_equal(run["looks_count"][[0, -1]], [1, 4])
    np.testing.assert_array_equal(run["limited_looks_count"][::40], [0, 0, 1, 2])


@pytest.mark.parametrize("part", ["feathering_amplitude", "feathering_lead"])
def test_refuses_commands_of_a_program_without_effect(tmp_path, part):
    flight = steered(Flight.preset("robobee"), tmp_path, f'{{"{part}": 0.1 if look == 1 else 0.0}}')
    with pytest.raises(wingbeat.Error, match=rf"look 1.*{part} = 0.1 has no effect on wing") as caught:
        flight.fly()
    assert len(caught.value.run.arrays["time_s"]) == 40


@pytest.mark.parametrize("part", ["feathering_amplitude", "feathering_lead_wingbeats"])
def test_refuses_commands_in_python_without_effect(part):
    flight = Flight.preset("robobee").set(SHORT)
    for answer in (Adjustment(**{part: 0.1}), [Adjustment(), Adjustment(**{part: 0.1})]):
        with pytest.raises(wingbeat.FlightError, match=r"feathering_\w+ = 0.1 has no effect on wing") as caught:
            flight.with_controller(lambda _, answer=answer: answer).fly()
        assert caught.value.remedy and caught.value.run is None
    flown = flight.with_controller(lambda _: Adjustment(stroke_amplitude=0.05, feathering_offset_rad=0.01)).fly()
    assert flown.outcome == "finished"


def test_behaves_one_command_for_all_wings_counts_where_it_has_an_effect():
    """The left wing is held at its mean stroke angle: its command is 0 in the history."""
    stroke = {"fourier": {"cosine_deg": [60.0]}}
    keys = {"wing.left.motion.phi": {"constant_deg": 0.0}, "wing.right.motion.phi": stroke}
    flight = Flight.preset("fruit-fly-blade").set(SHORT | keys)
    run = flight.with_controller(lambda _: Adjustment(stroke_amplitude=0.1)).fly().arrays
    assert (run["command_wing_right_stroke_amplitude_dimensionless"] == 0.1).all()
    assert not run["command_wing_left_stroke_amplitude_dimensionless"].any()


@pytest.mark.parametrize(
    ("preset", "keys", "why"),
    [
        ("table1-sun-2007", {}, "air.model|no wing beats|wings"),
        ("fruit-fly-vacuum", {"dynamics.wings": "massless"}, "without mass"),
        ("fruit-fly-tethered", {}, "tethered"),
    ],
)
def test_refuses_controllers_where_no_wing_steers(preset, keys, why):
    flight = Flight.preset(preset).set(keys).with_controller(lambda _: Adjustment(stroke_amplitude=0.3), every_steps=10)
    for fly in (flight.fly, flight.start):
        with pytest.raises(wingbeat.CaseError, match=why) as caught:
            fly()
        assert caught.value.key == "control" and caught.value.run is None


def test_behaves_points_under_a_changed_program_are_flown_again(tmp_path):
    def flown(answer: str) -> int:
        flight = steered(Flight.preset("fruit-fly-blade"), tmp_path, answer)
        points = {"time.beats": [1]}
        return campaign.map(points, campaign.Serial(), base=flight, keep=["power_watt"], out=tmp_path / "kept").flown

    changed = '{"stroke_amplitude_rad": 0.01}'
    assert [flown("{}"), flown("{}"), flown(changed), flown(changed)] == [1, 0, 1, 0]


def test_exact_a_controller_in_python_sees_the_noise_that_a_program_sees(tmp_path):
    sensors = {"seed": 3, "position_noise_m": 1e-4, "velocity_noise_m_s": 0.01, "velocity_bias_m_s": [0.5, 0, 0]}
    times = {"latency_beats": 1, "every_beats": 2}
    steered(Flight.preset("fruit-fly-blade"), tmp_path, "{}", sensors=sensors, **times).fly()
    told = [json.loads(line) for line in (tmp_path / "log").read_text().splitlines()]
    seen = []

    def watches(sensed):
        seen.append([*sensed.mass_centre_m, *sensed.velocity_m_per_s])
        return Adjustment(stroke_amplitude=0.01)

    case = {"control.sensors": sensors} | {f"control.{key}": value for key, value in times.items()}
    run = Flight.preset("fruit-fly-blade").set(SHORT | case).with_controller(watches).fly()
    # The wings do what the case says until the first command acts, a beat after the release.
    assert [look["look"] for look in told] == [0, 2]
    assert seen[0] == [*told[0]["mass_centre_m"], *told[0]["velocity_m_s"]] and len(seen) == 2
    commands = run.arrays["command_wing_right_stroke_amplitude_dimensionless"]
    assert commands[30] == 0 and commands[60] == 0.01
    # Keys stand by where the controller of the case is switched off.
    text = Flight.preset("fruit-fly-blade").set(SHORT | case).case_text
    seen.clear()
    Flight.from_case(text).set("control.controller", "none").with_controller(watches).fly()
    assert seen[0] == [*told[0]["mass_centre_m"], *told[0]["velocity_m_s"]] and len(seen) == 2


def test_refuses_a_controller_beside_keys_of_another():
    flight = Flight.preset("fruit-fly-blade").set({"control.sensors.tilt_noise_deg": 1, "control.weights.sum": 1})
    with pytest.raises(wingbeat.CaseError, match="has a controller already") as caught:
        flight.with_controller(lambda _: Adjustment())
    assert caught.value.key == "control.controller"
