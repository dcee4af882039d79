"""Bad input: an exception with key and remedy each, never an abort or a panic."""

from __future__ import annotations

import copy
import pickle
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wingbeat
from wingbeat import Adjustment, Flight

Bad = Callable[[Flight, Path], Any]


def controlled(answer: Any) -> Bad:
    return controlled_by(lambda: answer)


def controlled_by(answer: Callable[[], Any]) -> Bad:
    return lambda blade, _: blade.with_controller(lambda _: answer()).fly()


def blown(answer: Any) -> Bad:
    return lambda blade, _: blade.with_air(lambda _: answer).fly()


def lattice() -> wingbeat.Stepper:
    return Flight.preset("fruit-fly-hover").start()


STRIPS = {"air.blade.unsteady": "jones"}


def without(package: str, ask: Callable[[], Any]) -> Any:
    """Asks where a package cannot be imported."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, package, None)
        return ask()


def problem(blade: Flight) -> wingbeat.Problem:
    return wingbeat.Problem(blade, {"motion.frequency_hz": (150, 250)}, ["power_watt"], executor=wingbeat.campaign.Serial())


BAD: dict[str, Bad] = {
    "frames that are no truth value": lambda blade, _: blade.fly(frames="no"),
    "steady that is no truth value": lambda blade, _: blade.wing_modes(steady=1),
    "campaign whose file is no path": lambda *_: wingbeat.campaign.run(3),
    "campaign whose folder is no path": lambda blade, _: wingbeat.campaign.map(
        {"time.beats": [1]}, wingbeat.campaign.Serial(), base=blade, out=3
    ),
    "unknown preset": lambda *_: Flight.preset("fruit-fli"),
    "empty preset": lambda *_: Flight.preset(""),
    "no such file": lambda *_: Flight.from_case("nowhere.toml"),
    "a directory": lambda _, tmp: Flight.from_case(tmp),
    "no TOML": lambda *_: Flight.from_case("[time\nbeats = "),
    "empty case": lambda *_: Flight.from_case("\n"),
    "empty dict": lambda *_: Flight.from_case({}),
    "key that is no text": lambda *_: Flight.from_case({3: 1}),
    "value that is no value": lambda *_: Flight.from_case({"time": {"beats": object()}}),
    "bytes": lambda blade, _: blade.set("name", b"fly"),
    "None": lambda blade, _: blade.set("time.steps", None),
    "a law that does not close": lambda blade, _: blade.with_motion(phi_deg=lambda x: 70.0 * x),
    "samples that do not close": lambda blade, _: blade.with_motion(theta_deg=np.linspace(0.0, 20.0, 40)),
    "a command of 1e9": controlled([Adjustment(stroke_amplitude=1e9)] * 2),
    "no value": lambda blade, _: blade.set("time.beats"),
    "unknown key": lambda blade, _: blade.set("motion.frequenzy_hz", 200),
    "unit of another kind": lambda blade, _: blade.set("body.mass_mg", 1.0),
    "empty key": lambda blade, _: blade.set("", 1),
    "key with an equals sign": lambda blade, _: blade.set("time.beats=3", 1),
    "key with a line end": lambda blade, _: blade.set("time\nbeats", 1),
    "wrong type": lambda blade, _: blade.set("time.beats", "two"),
    "wrong choice": lambda blade, _: blade.set("air.model", "aether"),
    "not a number": lambda blade, _: blade.set("motion.frequency_hz", float("nan")),
    "attribute that is no key": lambda blade, _: setattr(blade.case.motion, "frequenzy_hz", 200),
    "attribute that is not given": lambda blade, _: blade.case.wing.right.motion.phi,
    "key below a number": lambda blade, _: blade.set("time.beats.x", 1),
    "infinite": lambda blade, _: blade.set("air.density_kg_m3", float("inf")),
    "negative": lambda blade, _: blade.set("motion.frequency_hz", -1.0),
    "a number beyond 64 bits": lambda blade, _: blade.set("time.beats", 10**30),
    "vector of two": lambda blade, _: blade.set("air.stream_m_s", [1.0, 2.0]),
    "key without effect": lambda blade, _: blade.set("air.wake_core.algebraic.radius_m", 1.0),
    "too many steps": lambda blade, _: blade.set("time.beats", 1e300),
    "line break in a name": lambda blade, _: blade.set("name", "a\nb"),
    "result that exists": lambda blade, tmp: blade.fly(out=tmp),
    "result below a file": lambda blade, tmp: blade.fly(out=tmp / "file" / "run"),
    "no result": lambda _, tmp: wingbeat.read(tmp),
    "result that is a file": lambda _, tmp: wingbeat.read(tmp / "file"),
    "write over a result": lambda blade, tmp: blade.fly().write(tmp),
    "export from memory": lambda blade, _: blade.fly().export("hdf5"),
    "unknown format": lambda blade, tmp: blade.fly(out=tmp / "run").export("xls"),
    "unknown figure": lambda blade, _: blade.fly().plot("wake"),
    "frame that is not there": lambda blade, _: blade.fly().frame(7),
    "last frame of none": lambda blade, _: blade.fly().frame(-1),
    "frame of half a step": lambda blade, _: blade.fly().frame(1.5),
    "negative steps": lambda blade, _: blade.start().step(-1),
    "half a step": lambda blade, _: blade.start().step(0.5),
    "velocity without a lattice": lambda blade, _: blade.start().air_velocity([[0.0, 0.0, 0.0]]),
    "velocity at points of two": lambda blade, _: lattice().air_velocity(np.zeros((3, 2))),
    "velocity at a table of points": lambda blade, _: lattice().air_velocity(np.zeros((2, 2, 3))),
    "velocity at six numbers": lambda blade, _: lattice().air_velocity(np.zeros(6)),
    "velocity nowhere": lambda blade, _: lattice().air_velocity([[np.nan, 0.0, 0.0]]),
    "velocity at complex points": lambda blade, _: lattice().air_velocity(np.zeros((1, 3), complex)),
    "velocity at a text": lambda blade, _: lattice().air_velocity("a"),
    "flight in progress pickled": lambda blade, _: pickle.dumps(blade.start()),
    "motion in words": lambda blade, _: blade.with_motion(phi_deg=lambda _: "a"),
    "gradient to less than nothing": lambda blade, _: problem(blade).gradient([200.0], relative=-1),
    "gradient to no number": lambda blade, _: problem(blade).gradient([200.0], relative=float("nan")),
    "gradient to anything": lambda blade, _: problem(blade).gradient([200.0], relative=1e300),
    "gradient to a text": lambda blade, _: problem(blade).gradient([200.0], relative="a"),
    "gradient at a text": lambda blade, _: problem(blade).gradient("a"),
    "controller that is none": lambda blade, _: blade.with_controller(3),
    "controller too often": lambda blade, _: blade.with_controller(lambda _: Adjustment(), every_steps=1),
    "negative latency": lambda blade, _: blade.with_controller(lambda _: Adjustment(), latency_looks=-1),
    "latency beyond the flight": lambda blade, _: blade.with_controller(lambda _: Adjustment(), latency_looks=10**6),
    "controller beside that of the case": lambda blade, _: blade.set("control.controller", "regulator").with_controller(
        lambda _: Adjustment()
    ),
    "nothing for an answer": controlled(None),
    "too few adjustments": controlled([Adjustment()]),
    "adjustments that are none": controlled([1.0, 2.0]),
    "infinite adjustment": controlled(Adjustment(stroke_amplitude=float("inf"))),
    "frequency in flight": controlled(Adjustment(frequency=0.1)),
    "air that is none": lambda blade, _: blade.with_air("air"),
    "loads of two bodies": blown(np.zeros((2, 6))),
    "loads that are not finite": blown(np.full((3, 6), np.nan)),
    "keys under a controller": lambda blade, _: blade.with_controller(lambda _: Adjustment()).set("time.beats", 1),
    "controller in a result": lambda blade, tmp: blade.with_controller(lambda _: Adjustment()).fly(out=tmp / "run"),
    "tethered under a controller": lambda blade, _: Flight.preset("fruit-fly-tethered")
    .with_controller(lambda _: Adjustment())
    .start(),
    "motion of a wing of another name": lambda blade, _: blade.with_motion(phi_deg=[1.0, 2.0, 3.0, 2.0], wing="rigth"),
    "motion of nothing": lambda blade, _: blade.with_motion(),
    "motion of two samples": lambda blade, _: blade.with_motion(phi_deg=[1.0, 2.0]),
    "motion that is not finite": lambda blade, _: blade.with_motion(phi_deg=[0.0, np.nan, 0.0, 1.0]),
    "motion of a wing that is not there": lambda blade, _: blade.with_motion(phi_deg=np.zeros(8), wing="third"),
    "two unknowns": lambda blade, _: blade.trim(unknowns=("body_pitch", "stroke_amplitude")),
    "one unknown twice": lambda blade, _: blade.trim(unknowns=("body_pitch", "body_pitch", "frequency")),
    "unknown unknown": lambda blade, _: blade.trim(unknowns=("body_pitch", "courage", "frequency")),
    "trim at infinite speed": lambda blade, _: blade.trim(forward_m_per_s=float("inf")),
    "trim above the speed of sound": lambda blade, _: blade.trim(forward_m_per_s=500, climb_m_per_s=-500),
    "trim of two unknowns": lambda blade, _: blade.trim(unknowns=["body_pitch", "stroke_amplitude"]),
    "trim of one unknown twice": lambda blade, _: blade.trim(unknowns=["body_pitch", "body_pitch", "stroke_amplitude"]),
    "trim in one step": lambda blade, _: blade.trim(steps=1),
    "trim in few steps": lambda blade, _: blade.trim(steps=19),
    "stability in few steps": lambda blade, _: blade.stability(steps=5),
    "trim in less than none": lambda blade, _: blade.trim(steps=-1),
    "trim in half a step": lambda blade, _: blade.trim(steps=20.5),
    "trim at the speed of a word": lambda blade, _: blade.trim(forward_m_per_s="a"),
    "trim with a wake, held for less": lambda *_: Flight.preset("fruit-fly-hover").trim_with_wake(held_beats=-1),
    "more steps than there are numbers": lambda blade, _: blade.start().step(2**70),
    "complex loads": blown(np.zeros((3, 6), complex)),
    "loads in words": blown([["a"] * 6] * 3),
    "complex motion": lambda blade, _: blade.with_motion(phi_deg=np.zeros(8, complex)),
    "trim with a wake, to nothing": lambda *_: Flight.preset("fruit-fly-hover").trim_with_wake(tolerance=0),
    "trim with a wake, held for nothing": lambda *_: Flight.preset("fruit-fly-hover").trim_with_wake(held_beats=0),
    "case that is a number": lambda *_: Flight.from_case(3),
    "progress that is none": lambda blade, _: blade.fly(progress=3),
    "adjustment in words": controlled_by(lambda: Adjustment(stroke_amplitude="0.1")),
    "adjustment of an array": controlled_by(lambda: Adjustment(stroke_amplitude=np.zeros(2))),
    "figure without matplotlib": lambda blade, _: without("matplotlib", blade.fly().plot),
    "trim under a load": lambda blade, _: Flight.preset("fruit-fly-hover").trim(),
}


@pytest.mark.parametrize("name", BAD)
def test_refuses(name, blade, tmp_path, capfd):
    (tmp_path / "file").write_text("no run")
    with pytest.raises(wingbeat.Error) as caught:
        BAD[name](blade.set("time.beats", 1), tmp_path)
    error = caught.value
    assert error.remedy, f"no remedy: {error}"
    assert error.key or isinstance(error, wingbeat.AnalysisError), f"no key: {error}"
    assert "--set" not in str(error) + error.remedy
    assert "panic" not in str(error) and "panicked" not in capfd.readouterr().err


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, pickle.dumps])
def test_refuses_copies_of_a_run_in_memory(blade, copied):
    with pytest.raises(wingbeat.CaseError, match="copied or pickled") as caught:
        copied(blade.set("time.beats", 0.1).fly())
    assert "run.arrays" in caught.value.remedy


def test_exact_a_run_in_a_directory_is_pickled_as_that(blade, tmp_path):
    run = blade.set("time.beats", 0.1).fly(out=tmp_path / "run")
    again = pickle.loads(pickle.dumps(run))
    assert again.dir == run.dir
    np.testing.assert_array_equal(again.arrays["body_z_m"], run.arrays["body_z_m"])


def test_behaves_steps_may_be_numbers_of_numpy(blade):
    stepper = blade.start()
    assert stepper.step(np.int64(3)) == 3 == stepper.steps_done
    assert blade.set("time.beats", 0.1).start().step(10**18) == 10


def test_behaves_errors_of_keys_that_were_set_name_them(blade):
    with pytest.raises(wingbeat.CaseError) as caught:
        blade.set("motion.frequency_hz", -3)
    assert caught.value.key == "motion.frequency_hz"
    assert "motion.frequency_hz=-3 (set on top of preset fruit-fly-blade)" in str(caught.value)


def test_refuses_a_package_that_is_not_installed_by_its_name():
    with pytest.raises(wingbeat.PackageError, match="ray") as caught:
        without("ray", wingbeat.campaign.Ray)
    assert isinstance(caught.value, ImportError)
    assert caught.value.key == "executor" and "install the extra `engines` of the package" in caught.value.remedy


@pytest.mark.parametrize(
    ("preset", "keys", "key"),
    [
        ("fruit-fly-hover", {}, "air.model"),
        ("fruit-fly-blade", STRIPS, "air.blade.unsteady"),
        ("hawkmoth-elastic", {"air.model": "blade_element"}, "wing.structure"),
    ],
)
def test_refuses_a_map_of_one_wingbeat_where_something_remembers(preset, keys, key):
    with pytest.raises(wingbeat.CaseError) as caught:
        Flight.preset(preset).set(keys).trim()
    assert caught.value.key == key and "trim_with_wake()" in caught.value.remedy


def test_refuses_numbers_without_a_case(blade, tmp_path):
    blade.set("time.beats", 0.1).fly().write(tmp_path / "numbers")
    with pytest.raises(wingbeat.ResultError, match="no case to read them with") as caught:
        wingbeat.read(tmp_path / "numbers")
    assert caught.value.remedy.startswith("fly(out=FOLDER)")


def test_behaves_errors_name_the_line_of_a_case(blade):
    text = blade.case_text.replace("frequency_hz = 200.0", "frequency_hz = -3.0")
    line = 1 + text[: text.index("frequency_hz = -3.0")].count("\n")
    with pytest.raises(wingbeat.CaseError) as caught:
        Flight.from_case(text)
    assert (caught.value.key, caught.value.line) == ("motion.frequency_hz", line)
    assert isinstance(caught.value, ValueError)


def test_behaves_what_to_try_is_said_of_a_flight_that_leaves_its_mirror():
    def turn(sensed: wingbeat.Sensed) -> list[Adjustment]:
        return [Adjustment(stroke_amplitude=0.05), Adjustment(stroke_amplitude=-0.05)]

    hover = Flight.preset("fruit-fly-hover").set({"time.beats": 1.5, "time.steps_per_beat": 20})
    with pytest.raises(wingbeat.FlightError, match="not mirror-symmetric") as caught:
        hover.with_controller(turn, every_steps=5).fly()
    assert caught.value.remedy.endswith("compute both halves") and str(caught.value).count("compute both halves") == 1


def test_behaves_a_flight_that_cannot_go_on_keeps_what_was_flown(blade):
    """Loads that grow with the acceleration they make: bodies and air do not agree."""

    def wild(motions: wingbeat.Motions) -> np.ndarray:
        loads = np.zeros((3, 6))
        if motions.time_s > 2e-3:
            loads[0, :3] = 1e3 * motions.velocity_m_per_s[0]
        return loads

    with pytest.raises(wingbeat.FlightError) as caught:
        blade.set("dynamics.integrator", "hamming").with_air(wild).fly()
    run = caught.value.run
    assert run.outcome == "failed" and caught.value.remedy
    assert 30 < len(run.arrays["time_s"]) < 50 and run.why in str(caught.value)


def test_behaves_the_text_of_an_error_says_once_what_to_try() -> None:
    base = wingbeat.Flight.preset("fruit-fly-blade")
    with pytest.raises(wingbeat.CaseError) as of_python:
        wingbeat.Problem(base, {}, ["power_watt"])
    with pytest.raises(wingbeat.CaseError) as of_a_case:
        base.set("time.beats", -1)
    for error in (of_python.value, of_a_case.value):
        assert error.remedy
        assert str(error).count(error.remedy) == 1
