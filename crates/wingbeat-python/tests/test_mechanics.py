"""Trim, stability, controls, power."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
import scipy.io
import scipy.signal

import wingbeat

LAWFUL = {"forward_m_per_s": 0.0, "steps": 40}


@pytest.fixture(scope="module")
def trim(blade) -> wingbeat.Trim:
    return blade.trim(**LAWFUL)


def test_agrees_the_trim_of_a_tethered_flight_with_that_of_the_free_one(blade):
    """What is looked for is free flight, as by the command line: the tether is left out."""
    free, tethered = blade.trim(), blade.set("flight.mode", "tethered").trim()
    np.testing.assert_array_equal(tethered.residual, free.residual)
    assert tethered.adjustment == free.adjustment and tethered.converged


def test_behaves_the_trimmed_flight_stays_where_it_is(trim):
    assert trim.converged and abs(trim.residual).max() < 1e-9
    run = trim.flight().set("time.beats", 3).fly()
    drift = [np.ptp(run.arrays[f"mass_centre_n{axis}_m"][::40]) for axis in (1, 2, 3)]
    assert max(drift) < 1e-8


def test_agrees_with_the_command_line(trim, program):
    done = program("stability", "fruit-fly-blade", "--steps", 40, "--json")
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    model = trim.stability()
    np.testing.assert_array_equal(model.derivatives, told["derivatives_si_by_u_v_w_p_q_r"])
    assert [m.growth_per_s for m in model.floquet_modes] == [m["growth_per_s"] for m in told["floquet_modes"]]
    done = program("power", "fruit-fly-blade", "--steps", 40, "--json")
    told, power = json.loads(done.stdout)["power"], trim.power()
    for name in ("aerodynamic", "inertial_positive", "perfect_storage", "no_storage", "peak"):
        assert getattr(power, f"{name}_watt") == told[name]["watt"]
    assert power.damping_watt == 0 and power.mass_kg == pytest.approx(told["peak"]["watt"] / told["peak"]["watt_per_kg_body"])


GLIDER = Path(__file__).parents[2] / "wingbeat-case/tests/data/glider.toml"


def test_agrees_the_unknowns_of_a_glide_with_the_command_line(program):
    """Speed and climb that follow from the incidences, the elevator that follows from a speed."""
    glide = wingbeat.Flight.from_case(GLIDER).trim()
    told = json.loads(program("trim", GLIDER, "--json").stdout)
    assert set(glide.unknowns) == {"body_pitch", "forward", "climb"}
    assert glide.forward_m_per_s == glide.unknowns["forward"] == told["unknowns"]["forward_m_s"]
    assert glide.climb_m_per_s == glide.unknowns["climb"] == told["unknowns"]["climb_m_s"] < 0
    assert (glide.tail_incidence_rad, glide.mass_centre_m) == (0, 0)
    fast = wingbeat.Flight.from_case(GLIDER).trim(forward_m_per_s=8)
    told = json.loads(program("trim", GLIDER, "--forward", 8, "--json").stdout)["unknowns"]
    assert fast.forward_m_per_s == 8 and "forward" not in fast.unknowns
    assert fast.tail_incidence_rad == fast.unknowns["tail_incidence"] != 0
    assert math.degrees(fast.tail_incidence_rad) == pytest.approx(told["tail_incidence_deg"], rel=1e-14)
    assert fast.climb_m_per_s == told["climb_m_s"]
    assert fast.converged and glide.converged


def test_agrees_the_shift_of_the_mass_centre_with_its_part_of_a_wing_length(blade):
    moved = blade.trim(unknowns=["body_pitch", "stroke_amplitude", "mass_centre"], **LAWFUL)
    length = moved.mass_centre_m / moved.unknowns["mass_centre"]
    assert moved.converged and 2e-3 < length < 3e-3
    assert (moved.forward_m_per_s, moved.climb_m_per_s) == (0, 0)
    assert moved.unknowns["body_pitch"] == moved.body_pitch_rad
    assert moved.unknowns["stroke_amplitude"] == moved.adjustment.stroke_amplitude


def test_agrees_turns_and_bounds_with_the_command_line(blade, program):
    turn = blade.trim(forward_m_per_s=0.3, turn_rate_rad_per_s=math.radians(300), bounds={"body_roll": (0, 0.1)})
    done = program("trim", "--forward", 0.3, "--turn-rate", 300, "--bound", "body_roll=0..5.729577951308232", "--json")
    told = json.loads(done.stdout)
    assert turn.converged and turn.residual.shape == (12,)
    assert turn.outside_bounds == ("body_roll",) == tuple(told["outside_bounds"]) and done.returncode == 1
    assert math.degrees(turn.body_roll_rad) == told["unknowns"]["body_roll_deg"]
    assert turn.difference.stroke_amplitude == told["unknowns"]["stroke_amplitude_difference_change_relative"]
    with pytest.raises(wingbeat.AnalysisError, match="outside its bounds: body_roll"):
        turn.power()
    turn = blade.trim(forward_m_per_s=0.3, turn_rate_rad_per_s=math.radians(300))
    assert turn.power().perfect_storage_watt > 0
    with pytest.raises(wingbeat.CaseError, match="straight in the mean") as refused:
        turn.stability()
    assert refused.value.key == "turn_rate_rad_per_s"
    told = json.loads(program("stability", "--forward", 0.3, "--turn-rate", 300, "--json").stdout)
    assert [m.growth_per_s for m in turn.floquet_modes()] == [m["growth_per_s"] for m in told["floquet_modes"]]


def test_exact_modes_are_the_eigenvalues_of_a(trim):
    model = trim.stability()
    values = np.linalg.eigvals(model.A)
    for mode in model.averaged_modes:
        value = complex(mode.growth_per_s, mode.frequency_rad_per_s)
        assert abs(values - value).min() < 1e-6 * abs(values).max()


def test_balances_inputs_are_loads_over_mass(trim, blade):
    """Forces move the mass and the air that goes with it by the first rows of B; a mirror image turns the lateral ones round."""
    model, controls = trim.stability(), trim.derivatives()
    moved = blade.mass_kg * model.B[:3] + model.added_mass[:3] @ model.B[:6]
    forces = controls.loads[:, :3].T
    np.testing.assert_allclose(moved, forces, rtol=1e-9, atol=1e-12 * abs(forces).max())
    np.testing.assert_array_equal(model.added_mass, model.added_mass.T)
    np.testing.assert_array_equal(model.B[6:], 0.0)
    assert model.inputs == tuple(f"{c} {w}" for c, w in zip(controls.controls, controls.wings, strict=True))
    left, right, both = (model.B[:, model.inputs.index(f"stroke_amplitude {w}")] for w in ("left", "right", "all"))
    np.testing.assert_allclose(left + right, both, atol=1e-6 * abs(both).max())
    # By the moment of inertia about the mean mass centre, which a step of the map of a beat sees as well.
    longitudinal, lateral = [0, 2, 4], [1, 3, 5]
    size = abs(right).max()
    np.testing.assert_allclose(left[longitudinal], right[longitudinal], atol=1e-6 * size)
    np.testing.assert_allclose(left[lateral], -right[lateral], atol=1e-6 * size)


def test_behaves_scipy_and_matlab_take_the_model(trim, tmp_path):
    model = trim.stability()
    system = scipy.signal.StateSpace(*model)
    assert system.A.shape == (9, 9) and system.B.shape == (9, len(model.inputs))
    assert len(model.states) == len(model.state_units) == 9
    model.save(tmp_path / "model.mat")
    read = scipy.io.loadmat(tmp_path / "model.mat", simplify_cells=True)
    np.testing.assert_array_equal(read["A"], model.A)
    with pytest.raises(wingbeat.ResultError, match="exists already"):
        model.save(tmp_path / "model.mat")
    model.save(tmp_path / "model.mat", overwrite=True)
    (tmp_path / "model").mkdir()
    with pytest.raises(OSError):
        model.save(tmp_path / "model", overwrite=True)  # and not the file beside it
    assert list(read["inputs"]) == list(model.inputs) and list(read["state_units"]) == list(model.state_units)


@pytest.mark.parametrize("key", ["forward_m_per_s", "sideslip_m_per_s", "climb_m_per_s", "turn_rate_rad_per_s"])
def test_refuses_speeds_that_are_not_finite(blade, key):
    with pytest.raises(wingbeat.CaseError, match=key):
        blade.trim(**{key: math.nan})


def test_behaves_vacuum_cannot_be_trimmed():
    with pytest.raises(wingbeat.Error):
        wingbeat.Flight.preset("fruit-fly-vacuum").power()


def test_agrees_trim_with_a_wake_with_the_command_line(program):
    """A coarse lattice without sheets of leading edges; what was trimmed flies on as a case.

    The wings beat fast enough to carry the weight by attached flow with strokes that do not make them meet.
    """
    keys = {
        "motion.frequency_hz": 216.0, "time.steps_per_beat": 20, "wing.right.mesh.chordwise": 2,
        "wing.right.mesh.spanwise": 3, "air.body": False, "air.shed": ["trailing"], "output.page": False,
    }  # fmt: skip
    flight = wingbeat.Flight.preset("fruit-fly-hover").set(keys)
    trim = flight.trim_with_wake(held_beats=1)
    sets = [x for key, value in keys.items() for x in ("--set", f"{key}={json.dumps(value)}")]
    done = program("trim", "fruit-fly-hover", "--hold", 1, "--json", *sets)
    told = json.loads(done.stdout)
    assert (trim.converged, trim.flights) == (done.returncode == 0, told["flights"])
    assert sorted(trim.residual) == sorted(told["residuals"].values())
    assert trim.flight().fly().outcome == "finished"
    told = json.loads(program("power", "fruit-fly-hover", "--hold", 1, "--json", *sets).stdout)["power"]
    paid = trim.power()
    assert paid.aerodynamic_watt == told["aerodynamic"]["watt"] > 0
    with pytest.raises(wingbeat.CaseError, match="wake"):
        trim.stability(wake="frozen")
    models = {wake: trim.stability(wake=wake) for wake in ("given", "carried")}
    for wake, model in models.items():
        told = json.loads(program("stability", "fruit-fly-hover", "--hold", 1, "--wake", wake, "--json", *sets).stdout)
        assert [m.growth_per_s for m in model.floquet_modes] == [m["growth_per_s"] for m in told["floquet_modes"]]
        values = np.linalg.eigvals(model.monodromy)
        assert all(abs(values - m.multiplier).min() < 1e-9 * abs(values).max() for m in model.floquet_modes)
    assert abs(models["given"].monodromy - models["carried"].monodromy).max() > 1e-3
    with pytest.raises(wingbeat.CaseError) as caught:
        trim.floquet_modes()
    assert caught.value.remedy.startswith("stability(wake=")


def test_agrees_modes_of_strips_with_wakes_with_the_command_line(program):
    keys = {"air.blade.unsteady": "jones", "time.steps_per_beat": 40}
    trim = wingbeat.Flight.preset("fruit-fly-blade").set(keys).trim_with_wake()
    sets = [x for key, value in keys.items() for x in ("--set", f"{key}={json.dumps(value)}")]
    told = json.loads(program("stability", "fruit-fly-blade", "--json", *sets).stdout)["floquet_modes"]
    modes = trim.floquet_modes()
    assert [m.name for m in modes] == [m["name"] for m in told]
    assert [m.growth_per_s for m in modes] == [m["growth_per_s"] for m in told]
    for wake in ("given", "carried"):
        with pytest.raises(wingbeat.CaseError, match="wakes of strips") as caught:
            trim.stability(wake=wake)
        assert caught.value.key == "wake" and caught.value.remedy.startswith("floquet_modes()")
    for count in (0, 21):
        with pytest.raises(wingbeat.CaseError, match="wing_modes"):
            trim.floquet_modes(wing_modes=count)
