"""Modes and flutter of elastic wings."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import wingbeat
from wingbeat import AnalysisError, CaseError, Flight

# A beam of a rectangular section in vacuum: its first bending frequency is 3.516 sqrt(EI / m) / (2 pi L^2).
BEAM = """
format = 1
name = "beam"
gravity_m_s2 = [0, 0, 0]
[time]
step_s = 1e-3
steps = 4
[flight]
mode = "tethered"
[air]
model = "none"
[body]
mass_kg = 1
inertia_about_centre_kg_m2 = [0.1, 0.1, 0.1, 0, 0, 0]
[wing.right]
mirror = false
hinge_m = [0, 0, 0]
planform.rectangle = { chord_m = 0.1, span_m = 1.0 }
[wing.right.structure.beam]
elements = 12
mass_kg_per_m = [0.5, 0.5]
inertia_kg_m = [1e-3, 1e-3]
flap_newton_m2 = [2.0, 2.0]
lag_newton_m2 = [2e3, 2e3]
torsion_newton_m2 = [50, 50]
"""

# The wing of Goland (1945) in strips, which flutters between these speeds.
GOLAND = Path(__file__).parents[2] / "wingbeat-verify" / "data" / "goland-strips.toml"
SPEEDS = (130.0, 145.0)


def of_command(*args: str) -> dict:
    line = [sys.executable, "-m", "wingbeat", *args, "--json"]
    return json.loads(subprocess.run(line, capture_output=True, check=True).stdout)


def test_exact_first_frequencies_of_a_cantilever(tmp_path):
    case = tmp_path / "beam.toml"
    case.write_text(BEAM)
    (wing,) = Flight.from_case(case).wing_modes(count=2).values()
    exact = np.array([3.51602, 22.0345]) * np.sqrt(2.0 / 0.5) / (2 * np.pi)
    assert np.allclose(wing.vacuum.frequency_hz, exact, rtol=3e-3)  # twelve elements, and the inertia of turning sections
    assert wing.air is None and wing.wing == "right"
    assert wing.vacuum.shapes.shape == (2, len(wing.nodes_m), 3)
    assert np.allclose(np.linalg.norm(wing.vacuum.shapes, axis=2).max(axis=1), 1.0)
    assert not wing.deflection_m.any()


def test_agrees_modes_and_flutter_with_the_commands():
    name = "hawkmoth-elastic"
    found = Flight.preset(name).wing_modes(count=3)
    told = of_command("modes", name, "--count", "3")
    assert [w["name"] for w in told["wings"]] == list(found)
    for wing in told["wings"]:
        assert [m["frequency_hz"] for m in wing["vacuum"]] == list(found[wing["name"]].vacuum.frequency_hz)
        assert [m["frequency_hz"] for m in wing["air"]] == list(found[wing["name"]].air.frequency_hz)
    seen = []
    flutter = Flight.from_case(GOLAND).flutter(SPEEDS, progress=lambda done, of: seen.append((done, of)))
    told = of_command("flutter", str(GOLAND), "--speeds", f"{SPEEDS[0]}:{SPEEDS[1]}:2")
    assert seen[-1] == (2, 2)
    for condition, values in zip(flutter.conditions, told["speeds"], strict=True):
        assert condition.speed_m_per_s == values["speed_m_s"]
        assert [m.growth_per_s for m in condition.modes] == [m["growth_per_s"] for m in values["modes"]]
        assert list(condition.tip_m) == values["tip_m"] and condition.residual == values["residual"]
    (onset,) = flutter.onsets
    assert onset.certain and onset.begins
    assert onset.speed_m_per_s == told["flutter"][0]["speed_m_s"] == flutter.speed_m_per_s


def test_refuses_wings_that_do_not_bend_and_speeds_that_do_not_rise():
    with pytest.raises(AnalysisError, match="no wing is elastic"):
        Flight.preset("fruit-fly-blade").wing_modes()
    flight = Flight.preset("hawkmoth-elastic")
    for speeds in ([], [0.0, 1.0], [3.0, 2.0], [2.0, float("nan")]):
        with pytest.raises(CaseError, match="speeds_m_per_s"):
            flight.flutter(speeds)
    with pytest.raises(CaseError, match="count"):
        flight.wing_modes(count=0)
    with pytest.raises(CaseError, match="disturbance"):
        flight.flutter([10.0], disturbance=2.0)
    assert wingbeat.Flutter((), ()).speed_m_per_s is None
