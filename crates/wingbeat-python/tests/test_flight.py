"""Flights from Python are those of the program."""

from __future__ import annotations

import copy
import gc
import hashlib
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import tomllib
import traceback
import weakref
from pathlib import Path

import numpy as np
import pytest

import wingbeat
from wingbeat import _toml

from conftest import interrupted


def test_agrees_toml_with_its_reader_in_keys_of_any_letters():
    case = {"\U0001f98b \x7f \"": {"\u00e9\n": [1, "\U0001f98b\x7f"]}}
    assert tomllib.loads(_toml.document(case)) == case


def test_agrees_with_the_command_line_to_the_last_bit(blade, lattice, program, tmp_path):
    for name, flight in (("blade", blade), ("lattice", lattice)):
        case = tmp_path / f"{name}.toml"
        case.write_text(flight.case_text)
        from_program, from_python = tmp_path / f"{name}-program", tmp_path / f"{name}-python"
        done = program("run", case, "--out", from_program, "--quiet")
        assert done.returncode == 0, done.stderr
        in_files = flight.fly(out=from_python)
        files = [path / "history.csv" for path in (from_program, from_python)]
        assert files[0].read_bytes() == files[1].read_bytes()
        in_memory = flight.fly()
        for read in (in_files, wingbeat.read(from_program)):
            for column, numbers in in_memory.arrays.items():
                np.testing.assert_array_equal(read.arrays[column], numbers, err_msg=column)


def test_agrees_a_flight_step_by_step_with_one_at_once(blade):
    whole, stepper = blade.fly(), blade.start()
    assert stepper.step(7) == 7 and stepper.steps_done == 7
    assert stepper.run.outcome == "running" and len(stepper.run.arrays["time_s"]) == 8
    assert stepper.step(10_000) == blade.steps - 7 and stepper.is_finished
    assert stepper.run.outcome == "finished"
    for column, numbers in whole.arrays.items():
        np.testing.assert_array_equal(stepper.run.arrays[column], numbers)


def test_behaves_cases_come_from_texts_paths_and_dicts(blade, tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(blade.case_text)
    flights = [wingbeat.Flight.from_case(case) for case in (blade.case_text, path, str(path), blade.case)]
    assert {flight.case_text for flight in flights} == {blade.case_text}
    faster = blade.set("motion.frequency_hz", 210)
    assert faster.case["motion"]["frequency_hz"] == 210 and blade.case["motion"]["frequency_hz"] == 200
    wind = blade.set({"air.stream_m_s": np.array([1.0, 0.0, 0.0]), "name": 'a "fly"'.replace('"', "")})
    assert wind.case["air"]["stream_m_s"] == [1.0, 0.0, 0.0]
    assert tomllib.loads(wind.case_text)["name"] == "a fly"


def test_behaves_keys_of_a_case_are_attributes(blade):
    case = blade.case
    case.motion.frequency_hz = 210.0
    case.wing.right.planform.beta.length_m = 2.6e-3
    changed = wingbeat.Flight.from_case(case)
    keys = {"motion.frequency_hz": 210.0, "wing.right.planform.beta.length_m": 2.6e-3}
    assert changed.case == blade.set(keys).case and changed.case != blade.case
    assert copy.deepcopy(case) == case == pickle.loads(pickle.dumps(case))
    assert isinstance(copy.deepcopy(case).motion, wingbeat.Part)
    assert {"frequency_hz", "stroke_plane_pitch_deg"} <= set(dir(case.motion))
    del case.motion.frequency_hz
    assert "frequency_hz" not in case.motion and not hasattr(case.motion, "frequency_hz")


def test_agrees_what_a_case_says_of_its_keys_with_the_page_of_keys(blade):
    """Of every number that is given: the page of all keys has the same words."""
    page = " ".join((Path(__file__).parents[3] / "docs" / "case-keys.md").read_text().split())
    told = 0
    for part in (blade.case.motion, blade.case.time, blade.case.air, blade.case.wing.right):
        for name in part:
            first = " ".join(part.describe(name).split("keys:")[0].split("default:")[0].split())
            told += first.split(". ")[0].rstrip(".") in page
            assert first, name
    assert told > 10


def test_behaves_history_has_dims_units_and_the_case(blade):
    history = blade.fly().history
    assert dict(history.sizes) == {"time_s": blade.steps + 1}
    place = history["mass_centre_n3_m"]
    assert place.attrs == {
        "units": "m",
        "long_name": "mass centre of the whole animal",
        "frame": "N: inertial, n3 along the default gravity",
    }
    assert history["wake_rings_count"].dtype == np.int64
    assert all(v.attrs["units"] and v.attrs["long_name"] for v in history.data_vars.values())
    assert wingbeat.Flight.from_case(history.attrs["case_toml"]).case_text == blade.case_text


def test_exact_beats_are_differences_of_the_impulse(blade):
    run = blade.set("time.beats", 6).fly()
    period, weight = blade.period_s, 9.81 * blade.mass_kg
    impulse = run.arrays["air_impulse_n3_newton_s"][:: round(period / blade.step_s)]
    np.testing.assert_allclose(run.beats["lift_over_weight"], -np.diff(impulse) / period / weight, rtol=1e-12)
    lift = run.beats.means["lift_over_weight"]
    np.testing.assert_allclose(lift.mean, run.beats["lift_over_weight"][2:].mean(), rtol=1e-12)
    assert 0.0 < lift.standard_error < lift.mean
    assert run.summary["steps"] == 600 and "flew to its end" in run.summary_text


def test_exact_coefficients_are_mean_forces_over_the_mean_dynamic_pressure_on_the_wings(blade):
    """Both are differences over a wingbeat of what the history integrates: to rounding."""
    run = blade.set("time.beats", 3).fly()
    pressure = np.diff(run.arrays["dynamic_impulse_newton_s"][:: round(blade.period_s / blade.step_s)]) / blade.period_s
    assert (pressure > 0).all()
    for force in ("lift", "thrust"):
        coefficient = run.beats[f"{force}_coefficient"]
        np.testing.assert_allclose(coefficient, run.beats[f"{force}_newton"] / pressure, rtol=1e-11)
    assert (run.beats["lift_coefficient"] > 0.5).all()


def test_behaves_arrays_cannot_be_written_and_outlive_their_flight(lattice):
    run = lattice.fly()
    arrays = run.arrays
    place, frame = arrays["mass_centre_n1_m"], run.frame(-1)
    nodes, sheet = frame.surface.nodes_m, frame.wakes[0].nodes_m
    assert not place.flags.owndata, "the numbers are Rust's, not a copy"
    assert not any(array.flags.writeable for array in (place, nodes, sheet, run.beats["beat"]))
    with pytest.raises(ValueError):
        place[0] = 1.0
    before = [hashlib.sha256(array.tobytes()).digest() for array in (place, nodes, sheet)]
    gone = weakref.ref(run)
    del run, arrays, frame
    gc.collect()
    assert gone() is None
    for _ in range(20):
        lattice.fly()  # uses the memory again, if it was let go
    assert before == [hashlib.sha256(array.tobytes()).digest() for array in (place, nodes, sheet)]


def test_agrees_frames_in_memory_with_those_in_files(lattice, tmp_path):
    memory, files = lattice.fly(), lattice.fly(out=tmp_path / "run")
    assert memory.frame_steps == files.frame_steps == [0, 2, 4, 6, 8]
    for step in memory.frame_steps:
        one, other = memory.frame(step), files.frame(step)
        assert one.time_s == other.time_s == step * lattice.step_s
        for name in ("nodes_m", "panels", "circulation_m2_per_s", "pressure_jump_pascal", "surface"):
            np.testing.assert_array_equal(getattr(one.surface, name), getattr(other.surface, name))
        assert len(one.wakes) == len(other.wakes)
        for a, b in zip(one.wakes, other.wakes, strict=True):
            np.testing.assert_array_equal(a.nodes_m, b.nodes_m)
            np.testing.assert_array_equal(a.circulation_m2_per_s, b.circulation_m2_per_s)
            assert not a.shared_circulation_m2_per_s.any(), "no particles"
            assert a.shared_circulation_m2_per_s.shape == a.circulation_m2_per_s.shape
            rows, columns = a.circulation_m2_per_s.shape
            assert a.nodes_m.shape == (rows + 1, columns + 1, 3)
    assert not lattice.fly(frames=False).frame_steps


def test_exact_wings_in_a_frame_stand_where_the_history_has_their_hinges(lattice):
    """A wing root is nearer to its hinge than a fifth of the span, in the inertial frame and not in its mirror image."""
    run = lattice.fly()
    surface = run.frame(-1).surface
    for number, wing in enumerate(lattice.wings):
        panels = surface.panels[surface.surface == number]
        nodes = surface.nodes_m[np.unique(panels)]
        hinge = [run.arrays[f"wing_{wing}_{axis}_m"][-1] for axis in "xyz"]
        distance = np.linalg.norm(nodes - hinge, axis=1)
        assert distance.min() < 0.2 * distance.max()


def test_behaves_air_velocity_far_away_is_the_stream(lattice):
    stepper = lattice.start()
    stepper.step(4)
    far, near = stepper.air_velocity([[1e3, 0.0, 0.0], [2e-3, 2e-3, 0.0]])
    assert np.linalg.norm(far) < 1e-9 < np.linalg.norm(near)


def test_behaves_other_threads_run_while_it_flies(lattice):
    ticks, done = [0], threading.Event()

    def count() -> None:
        while not done.wait(0.005):
            ticks[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    lattice.set("time.beats", 1).fly()
    done.set()
    thread.join()
    assert ticks[0] > 10


def test_behaves_progress_is_told_and_may_stop_the_flight(lattice):
    told: list[tuple[int, int]] = []
    flight = lattice.set("time.beats", 1)
    flight.fly(progress=lambda done, of: told.append((done, of)))
    assert told[-1] == (flight.steps, flight.steps) and told == sorted(told) and len(told) > 2

    def enough(done: int, _of: int) -> None:
        if done > 3:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough") as caught:
        flight.fly(progress=enough)
    assert caught.value.run.outcome == "interrupted"
    assert 4 < len(caught.value.run.arrays["time_s"]) < flight.steps


@pytest.mark.timed
def test_behaves_ctrl_c_is_noticed_within_a_fifth_of_a_second(tmp_path):
    code = "wingbeat.Flight.preset('fruit-fly-hover').set('time.beats', 40).fly(progress=flying)"
    assert min(interrupted(code, tmp_path) for _ in range(3)) < 0.2


def test_behaves_a_flight_stopped_by_ctrl_c_is_resumed_by_the_program(program, tmp_path):
    keys = "{'time.beats': 0.6, 'time.steps_per_beat': 200, 'output.figures': False, 'output.page': False}"
    code = f"f = wingbeat.Flight.preset('fruit-fly-hover').set({keys})\nf.fly(out='stopped', progress=flying)"
    interrupted(code, tmp_path)
    stopped = wingbeat.read(tmp_path / "stopped")
    assert stopped.outcome == "interrupted" and len(stopped.arrays["time_s"]) < 121
    done = program("resume", tmp_path / "stopped", "--quiet")
    assert done.returncode == 0, done.stderr
    whole = wingbeat.Flight.from_case(tmp_path / "stopped" / "case.toml").fly()
    resumed = wingbeat.read(tmp_path / "stopped")
    for column, numbers in whole.arrays.items():
        np.testing.assert_array_equal(resumed.arrays[column], numbers)


def test_behaves_ctrl_c_at_any_time_leaves_the_exception_its_run(blade):
    flight, runs = blade.set({"time.beats": 10}), []
    for k in range(12):
        timer = threading.Timer(0.02 + 0.004 * k, os.kill, (os.getpid(), signal.SIGINT))
        try:
            timer.start()
            while True:
                flight.fly(frames=False)
        except KeyboardInterrupt as error:
            # Between two flights Python itself raises it.
            frames = [frame.name for frame in traceback.extract_tb(error.__traceback__)]
            if "fly" in frames:
                runs.append(error.run)
        timer.join()
    assert len(runs) >= 6 and any(run is not None for run in runs)


@pytest.mark.timed
def test_behaves_a_second_ctrl_c_does_not_wait_for_the_page(tmp_path):
    script = (
        "import wingbeat\n"
        "try:\n    wingbeat.Flight.preset('fruit-fly-blade').set({'time.beats': 3000}).fly(out='run')\n"
        "except KeyboardInterrupt as e:\n    print('run', e.run, flush=True)\n"
    )
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True, cwd=tmp_path)
    while not (tmp_path / "run" / "history.csv").is_file():
        time.sleep(0.02)
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    time.sleep(0.3)
    sent = time.monotonic()
    process.send_signal(signal.SIGINT)
    assert process.stdout is not None
    told = process.stdout.readline()
    assert told == "run None\n" and time.monotonic() - sent < 0.5
    process.kill()
    process.wait()



def test_agrees_exports_with_the_history_value_for_value(blade, tmp_path):
    import pyarrow.parquet
    import xarray

    run = blade.fly(out=tmp_path / "run")
    (parquet,) = run.export("parquet")
    (hdf5,) = run.export("hdf5")
    table = pyarrow.parquet.read_table(parquet)
    dataset = xarray.open_dataset(hdf5, group="history", engine="h5netcdf")
    run.history.to_netcdf(tmp_path / "own.nc", engine="h5netcdf")
    own = xarray.open_dataset(tmp_path / "own.nc", engine="h5netcdf")
    for column, numbers in run.arrays.items():
        for read in (table[column].to_numpy(), dataset[column].to_numpy(), own[column].to_numpy()):
            np.testing.assert_array_equal(read, numbers)
    for name in ("units", "long_name", "frame"):
        assert dataset["kinetic_energy_joule"].attrs[name] == run.history["kinetic_energy_joule"].attrs[name]


def test_behaves_figures_and_notebooks_show_the_flight(blade, tmp_path):
    run = blade.fly(out=tmp_path / "run")
    for kind in ("forces", "trajectory", "angles", "balances"):
        figure = run.plot(kind)
        lines = [line for axes in figure.axes for line in axes.get_lines()]
        assert lines and all(line.get_xdata()[-1] == pytest.approx(2.0) for line in lines)
    assert "flew to its end" in run._repr_html_()
    page = Path(run.dir, "flight.html")
    assert ("<iframe" in run._repr_html_()) == page.is_file()
