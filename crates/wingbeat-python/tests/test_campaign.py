"""Campaigns: the same bits whatever flies them and whatever happens to the workers."""

from __future__ import annotations

import errno
import inspect
import multiprocessing
import os
import pickle
import random
import re
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

import campaign_tasks as tasks
import numpy as np
import pytest

import wingbeat
from wingbeat import CaseError, Flight, campaign
from wingbeat.campaign import _identity, _names, _task

FREQUENCIES = np.linspace(180.0, 220.0, 24)
POINTS = {"motion.frequency_hz": FREQUENCIES, "time.beats": 1}


@pytest.fixture(scope="module")
def serial() -> campaign.Table:
    return campaign.map(POINTS, campaign.Serial(), base="fruit-fly-blade")


def same(a: campaign.Table, b: campaign.Table) -> bool:
    """Bit for bit."""
    return list(a) == list(b) and all(a[k].tobytes() == b[k].tobytes() for k in a) and a.reasons == b.reasons


def test_agrees_with_flights_one_by_one(serial):
    for k, frequency in enumerate(FREQUENCIES[::6]):
        run = Flight.preset("fruit-fly-blade").set({"motion.frequency_hz": frequency, "time.beats": 1}).fly()
        assert run.beats["lift_over_weight"].mean() == serial["lift_over_weight"][6 * k]
        assert run.beats["power_watt"].mean() == serial["power_watt"][6 * k]


def test_invariant_engine_number_of_workers_and_batches_change_no_bit(serial):
    rows = [{"motion.frequency_hz": f, "time.beats": 1} for f in FREQUENCIES]
    assert same(campaign.map(POINTS, base="fruit-fly-blade", workers=2), serial)
    assert same(campaign.map(POINTS, base=Flight.preset("fruit-fly-blade"), workers=3, chunk_s=0), serial)
    with ThreadPoolExecutor(2) as pool:
        assert same(campaign.map(iter(rows), pool, base="fruit-fly-blade"), serial)
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        assert same(campaign.map(POINTS, pool, base="fruit-fly-blade", chunk_s=0.1), serial)


def test_behaves_workers_that_are_killed_change_no_bit(serial):
    many = {"motion.frequency_hz": np.tile(FREQUENCIES, 8), "time.beats": 1}
    over, killed, chance = threading.Event(), [], random.Random(1)

    def kill(pool: campaign.Processes) -> None:
        while not over.wait(0.3 * chance.random()) and len(killed) < 4:
            if there := sorted(getattr(pool._pool, "_processes", None) or {}):
                killed.append(chance.choice(there))
                with suppress(ProcessLookupError):
                    os.kill(killed[-1], signal.SIGKILL)

    with campaign.Processes(2) as pool:
        pool.submit(os.getpid).result()
        killer = threading.Thread(target=kill, args=(pool,))
        killer.start()
        try:
            table = campaign.map(many, pool, base="fruit-fly-blade", chunk_s=0.1)
        finally:
            over.set()
            killer.join()
    assert killed and not any(table.reasons)
    for name in ("lift_over_weight", "power_watt"):
        assert table[name].tobytes() == np.tile(serial[name], 8).tobytes()


def test_behaves_a_point_that_kills_its_worker_is_recorded_and_no_other():
    points = {"motion.frequency_hz": [190.0, 195.0, 200.0, 205.0, 210.0]}
    table = campaign.map(points, base="fruit-fly-blade", do=tasks.deadly, keep={"frequency": "Hz"}, workers=2, attempts=2)
    assert table["frequency"].tolist()[:2] == [190.0, 195.0] and table["frequency"].tolist()[3:] == [205.0, 210.0]
    assert np.isnan(table["frequency"][2]) and table.ok.tolist() == [True, True, False, True, True]
    assert table.reasons[2] == "its worker died, 2 times with nothing beside it: BrokenProcessPool"


def test_refuses_to_go_on_with_a_pool_that_cannot_start_again():
    points = {"motion.frequency_hz": [200.0, 190.0]}
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool, pytest.raises(wingbeat.FlightError, match="broken") as caught:
        campaign.map(points, pool, base="fruit-fly-blade", do=tasks.deadly, keep=["frequency"])
    assert "Processes()" in caught.value.remedy and caught.value.table.reasons == ["not flown"] * 2


def test_behaves_points_that_cannot_be_flown_have_reasons():
    table = campaign.map(
        {"motion.frequency_hz": [200.0, -3.0, float("nan")], "time.beats": 1}, campaign.Serial(), base="fruit-fly-blade"
    )
    assert table.ok.tolist() == [True, False, False] and np.isnan(table["power_watt"][1:]).all()
    assert "motion.frequency_hz=-3.0" in table.reasons[1] and "2 without numbers" in repr(table)
    none = campaign.map({"time.beats": [0.5]}, campaign.Serial(), base="fruit-fly-blade")
    assert none.reasons == ["0 whole wingbeats were flown; means need 1 (time.beats)"]
    bad = campaign.map({"time.beats": [1]}, campaign.Serial(), base="fruit-fly-blade", do=tasks.wrong, keep=["x"])
    assert bad.reasons == ["KeyError: 'fruit-fly-blade'"]
    over = campaign.map({"time.beats": [1]}, workers=1, base="fruit-fly-blade", do=tasks.exits, keep=["x"])
    assert over.reasons == ["SystemExit: over"]
    other = campaign.map({"time.beats": [1]}, campaign.Serial(), base="fruit-fly-blade", do=tasks.mean_lift, keep=["x"])
    assert other.reasons == ["keep = 'x': the function gave lift, unasked"]


def test_behaves_functions_and_trims_are_tasks_too():
    table = campaign.map({"double": [1.9, 2.0]}, workers=1, base=tasks.fruit_fly, do=tasks.mean_lift, keep={"lift": "N"})
    one = tasks.fruit_fly({"double": 2.0}).fly()
    assert table["lift"][1] == one.beats["lift_newton"].mean() and table.units["lift"] == "N"
    speeds = {"trim.forward_m_per_s": [0.0, 0.2]}
    keep = ["perfect_storage_watt", "stroke_amplitude", "body_pitch_rad"]
    trims = campaign.map(speeds, campaign.Serial(), base="fruit-fly-blade", do="trim", keep=keep)
    assert trims.reasons == ["", ""]
    trim = Flight.preset("fruit-fly-blade").trim(forward_m_per_s=0.2)
    expected = [trim.power().perfect_storage_watt, trim.adjustment.stroke_amplitude, trim.body_pitch_rad]
    assert [trims[name][1] for name in keep] == expected


def test_behaves_what_was_flown_is_not_flown_again(tmp_path, serial):
    settings = {"base": "fruit-fly-blade", "out": tmp_path / "kept"}
    first = campaign.map(POINTS, campaign.Serial(), **settings)
    again = campaign.map(POINTS, campaign.Serial(), **settings)
    assert same(first, serial) and same(again, serial) and (first.flown, again.flown) == (24, 0)
    more = {"motion.frequency_hz": np.append(FREQUENCIES, 230.0), "time.beats": 1}
    assert campaign.map(more, campaign.Serial(), **settings).flown == 1
    assert campaign.map(more, campaign.Serial(), keep=["lift_newton"], **settings).flown == 25
    lighter = settings | {"base": Flight.preset("fruit-fly-blade").set("body.mass_kg", 9e-7)}
    assert campaign.map(POINTS, campaign.Serial(), **lighter).flown == 24


def test_behaves_a_changed_file_that_a_point_names_is_flown_again(tmp_path):
    def table(name: str, angle: float) -> None:
        (tmp_path / name).write_text(f"phase,angle\n0,{angle}\n0.25,0\n0.5,{-angle}\n0.75,0\n1,{angle}\n")

    table("a.csv", 60.0)
    table("b.csv", 70.0)
    case = Flight.preset("fruit-fly-blade").set({"time.beats": 1, "time.steps_per_beat": 40}).case_text
    (tmp_path / "case.toml").write_text(case)
    points = {f"wing.{side}.motion.phi.table.file": ["a.csv", "b.csv"] for side in ("left", "right")}
    settings = {"base": str(tmp_path / "case.toml"), "keep": ["power_watt"], "out": tmp_path / "kept"}
    before = campaign.map(points, campaign.Serial(), **settings)
    assert before.flown == 2 and before.ok.all(), before.reasons
    table("b.csv", 75.0)
    after = campaign.map(points, campaign.Serial(), **settings)
    assert after.flown == 1 and after["power_watt"][0] == before["power_watt"][0] != after["power_watt"][1]
    table("b.csv", 70.0)
    assert same(campaign.map(points, campaign.Serial(), **settings), before)


def test_behaves_points_of_columns_of_a_changed_file_are_flown_again(tmp_path):
    def table(angle: float) -> None:
        rows = (f"{k / 4},{angle * cos},{angle * cos / 2}" for k, cos in enumerate((1, 0, -1, 0, 1)))
        (tmp_path / "angles.csv").write_text("phase,wide,narrow\n" + "\n".join(rows) + "\n")

    table(60.0)
    text = Flight.preset("fruit-fly-blade").set({"time.beats": 1, "time.steps_per_beat": 40}).case_text
    (tmp_path / "case.toml").write_text(text)
    keys = [f"wing.{side}.motion.phi.table" for side in ("left", "right")]
    base = Flight.from_case(tmp_path / "case.toml").set(dict.fromkeys(keys, {"file": "angles.csv", "angle_column": "wide"}))
    settings = {"base": base, "keep": ["power_watt"], "out": tmp_path / "kept"}
    columns = {f"{key}.angle_column": ["narrow"] for key in keys}
    before = campaign.map(columns, campaign.Serial(), **settings)
    assert before.flown == 1 and before.ok.all(), before.reasons
    assert campaign.map(columns, campaign.Serial(), **settings).flown == 0
    table(65.0)
    after = campaign.map(columns, campaign.Serial(), **settings)
    assert after.flown == 1 and after["power_watt"][0] > before["power_watt"][0]


def test_behaves_what_a_function_carries_is_part_of_the_point(tmp_path):
    def flown(do, **options) -> list[float]:
        table = campaign.map({"time.beats": [1]}, campaign.Serial(), base="fruit-fly-blade", do=do, keep={"x": "1"}, out=tmp_path)
        assert table.flown == options.get("flown", 1), options
        return table["x"].tolist()

    base = Flight.preset("fruit-fly-blade")
    for factor in (1.0, 1000.0, np.array([2.0]), (3.0,), {"a": 4.0}, tasks.Study(5.0), tasks.scaled(6.0), base):
        number = 7.0 if isinstance(factor, Flight) else tasks.number(factor)
        assert flown(tasks.scaled(factor)) == [number]
        assert flown(tasks.scaled(factor), flown=0) == [number], "it is the same another time"
    for factor in (10.0, 20.0):
        assert flown(lambda flight, factor=factor: {"x": factor}) == [factor]
        assert flown(lambda flight, *, factor=factor: {"x": factor}) == [factor]
        assert flown(tasks.Study(factor).do) == [factor]
        assert flown(tasks.Study(factor).do, flown=0) == [factor]


def test_exact_identity_of_a_function_that_carries_nothing_is_its_source():
    assert _identity.of_part(tasks.slow, "do") == [tasks.__name__, "slow", inspect.getsource(tasks.slow)]


def test_refuses_to_keep_what_a_function_carries_that_may_be_another_next_time(tmp_path):
    for carried in (threading.Lock(), np.random.default_rng(1), open(__file__), iter([1.0])):  # noqa: SIM115
        with pytest.raises(CaseError, match="carries `factor`") as caught:
            campaign.map({"time.beats": [1]}, base="fruit-fly-blade", do=tasks.scaled(carried), keep={"x": "1"}, out=tmp_path)
        assert caught.value.key == "out" and caught.value.remedy


def test_refuses_a_folder_of_points_that_cannot_be_read(tmp_path):
    def link(path: Path) -> None:
        path.symlink_to(tmp_path / "nowhere")

    for k, make in enumerate((Path.mkdir, link)):
        place = tmp_path / str(k) / "points" / "x.jsonl"
        place.parent.mkdir(parents=True)
        make(place)
        with pytest.raises(wingbeat.ResultError, match="x.jsonl: cannot be read") as caught:
            campaign.map(POINTS, base="fruit-fly-blade", out=tmp_path / str(k))
        assert caught.value.remedy


def test_behaves_damaged_points_are_flown_again(tmp_path, serial):
    settings = {"base": "fruit-fly-blade", "out": tmp_path}
    campaign.map(POINTS, campaign.Serial(), **settings)
    longest = max((tmp_path / "points").iterdir(), key=lambda file: file.stat().st_size)
    lines = longest.read_text().splitlines(keepends=True)
    longest.write_text("".join(lines[:-1]) + lines[-1][:-9].replace("1", "2"))
    (tmp_path / "points" / "empty.jsonl").write_bytes(b"\0" * 100)
    again = campaign.map(POINTS, campaign.Serial(), **settings)
    assert again.flown == 1 and same(again, serial)


def test_behaves_a_full_disk_ends_it_and_what_was_flown_is_in_the_error(tmp_path, monkeypatch, serial):
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as disk, pytest.raises(wingbeat.ResultError, match="No space left") as caught:
        disk.setattr(os, "replace", full)
        campaign.map(POINTS, campaign.Serial(), base="fruit-fly-blade", out=tmp_path)
    assert caught.value.remedy and caught.value.table.ok.any() and not list((tmp_path / "points").iterdir())
    assert same(campaign.map(POINTS, campaign.Serial(), base="fruit-fly-blade", out=tmp_path), serial)


def test_behaves_one_thread_in_each_process():
    table = campaign.map({"time.beats": [1]}, base="fruit-fly-blade", do=tasks.threads, keep=["threads"], workers=1)
    assert table["threads"][0] <= 2  # the one that flies and the pool's only one


def test_behaves_flights_are_pickled_with_their_keys(tmp_path, monkeypatch):
    flight = Flight.preset("fruit-fly-blade").set("time.beats", 1).set({"motion.frequency_hz": 210})
    assert pickle.loads(pickle.dumps(flight)).case_text == flight.case_text
    (tmp_path / "my.toml").write_text(flight.case_text)
    monkeypatch.chdir(tmp_path)
    packed = pickle.dumps(Flight.from_case("my.toml").set("time.beats", 2))
    (tmp_path / "my.toml").unlink()
    assert pickle.loads(packed).case.time.beats == 2
    with pytest.raises(CaseError, match="parts written in Python"):
        pickle.dumps(flight.with_air(lambda _: np.zeros((3, 6))))


def test_behaves_a_file_is_found_where_its_path_has_an_equals_sign(blade, tmp_path, monkeypatch):
    name = "frequency=200/case.toml"
    (tmp_path / "frequency=200").mkdir()
    (tmp_path / name).write_text(blade.case_text)
    monkeypatch.chdir(tmp_path)
    assert Flight.from_case(name).case_text == blade.case_text
    assert campaign.map({"time.beats": [1]}, campaign.Serial(), base=name).ok.all()
    with pytest.raises(CaseError, match="unknown key"):
        Flight.from_case("nothing = 1")  # a text, where there is no such file


def test_exact_units_are_those_of_the_columns(blade):
    run = blade.fly()
    for name, unit, *_ in run._core.columns():
        assert _names.unit(name) == unit, name
    assert _names.unit("motion.frequency_hz") == "Hz" and _names.unit("air.density_kg_m3") == "kg m-3"


def test_agrees_units_with_those_of_all_keys_and_of_all_numbers_of_campaigns(tmp_path):
    keys = (Path(__file__).parents[3] / "docs" / "case-keys.md").read_text()
    rows = re.findall(r"^\| `(\w+)` \| ([^|]*) \|", keys, re.MULTILINE)
    assert len(rows) > 400
    for key, unit in rows:
        assert _names.unit(f"some.{key}") == ", ".join(map(written, unit.strip().split(", "))), key
    file = tmp_path / "c.toml"
    file.write_text('case = "fruit-fly-hover"\nkeep = ["power_watt"]\n')
    said = subprocess.run([sys.executable, "-m", "wingbeat", "campaign", "numbers", file], check=True, capture_output=True, text=True)
    numbers = [line.split(maxsplit=1) for line in said.stdout.splitlines()]
    assert len(numbers) > 300
    names = [name for name, _ in numbers]
    assert tuple(names[: 2 * len(campaign.BEATS) : 2]) == campaign.BEATS  # beside each its error
    assert tuple(name.removeprefix("summary.") for name in names if name.startswith("summary.")) == campaign.SUMMARY
    for name, rest in numbers:
        unit = rest[:10].strip()
        if not name.startswith("stability.derivative."):  # whose names have no unit
            assert _names.unit(name) == unit.replace("deg", "degree"), name


def written(unit: str) -> str:
    """A unit of the page of keys with exponents: kg/m3 as kg m-3."""
    if unit in ("", "wingbeats", "chords", "mean chords"):
        return "1"
    over, _, under = unit.replace("deg", "degree").partition("/")
    over = "" if over == "1" else over + " "
    return over + re.sub(r"(\D+)(\d*)", lambda m: f"{m[1]}-{m[2] or 1}", under) if under else over.strip()


def test_exact_names_are_those_of_runs_and_trims(blade):
    run, trim = blade.fly(), blade.trim()
    assert set(campaign.BEATS) == set(run.beats) - {"beat"}
    numbers = {k for k, v in _task.of_summary(run.summary).items() if isinstance(v, (int, float)) and not isinstance(v, bool)}
    assert set(campaign.SUMMARY) == numbers and len(campaign.SUMMARY) == len(numbers)
    assert all(isinstance(getattr(trim.power(), name), float) for name in campaign.POWER)
    assert all(isinstance(getattr(trim, name), (int, float)) for name in campaign.ATTITUDE)
    assert set(campaign.ADJUSTMENT) == set(type(trim.adjustment).__slots__)


def test_exact_means_leave_out_the_beats_of_a_smooth_start_and_of_a_hold(tmp_path):
    """Of all beats, or of the last ones, those that the start or the hold reaches into count for nothing; a flight without
    others has no numbers.
    """
    base = Flight.preset("fruit-fly-blade").set({"motion.start": "smooth", "time.steps_per_beat": 40})
    points = [{"time.beats": 5, "motion.start_beats": 3}, {"time.beats": 3, "motion.start_beats": 2.5}]
    table = campaign.map(points, campaign.Serial(), base=base, out=tmp_path)
    run = base.set(points[0]).fly()
    assert table["power_watt"][0] == run.beats["power_watt"][3:].mean()
    assert abs(table["power_watt"][0] - run.beats["power_watt"].mean()) > 1e-3 * table["power_watt"][0]
    assert table.reasons[1].startswith("3 whole wingbeats were flown, of which the first 3 are left out") and "1 more" in table.reasons[1]
    last = campaign.map(points[:1], campaign.Serial(), base=base, last_beats=2)
    assert last["power_watt"][0] == table["power_watt"][0]
    more = campaign.map(points[:1], campaign.Serial(), base=base, last_beats=3)
    assert "means need 3 more" in more.reasons[0]
    held = {"time.beats": 4, "flight.held_beats": 2}
    held_table = campaign.map([held], campaign.Serial(), base="fruit-fly-blade")
    assert held_table["power_watt"][0] == Flight.preset("fruit-fly-blade").set(held).fly().beats["power_watt"][2:].mean()


def test_behaves_a_table_is_a_dataset_with_units(serial, tmp_path):
    import xarray

    data = serial.dataset
    assert data["power_watt"].attrs["units"] == "W" and data["motion.frequency_hz"].attrs["units"] == "Hz"
    assert "wingbeat" in data["motion.frequency_hz"].attrs["long_name"].lower() and data["power_watt"].attrs["long_name"]
    assert data["reason"].values.tolist() == [""] * 24 and "fruit-fly" in data.attrs["case_toml"]
    data.to_netcdf(tmp_path / "table.nc", engine="h5netcdf")
    with xarray.open_dataset(tmp_path / "table.nc", engine="h5netcdf") as read:
        assert read["power_watt"].values.tobytes() == serial["power_watt"].tobytes()
    starts = campaign.map({"motion.start": ["impulsive", "smooth"], "time.beats": 2}, campaign.Serial(), base="fruit-fly-blade").dataset
    assert "units" not in starts["motion.start"].attrs and starts["motion.start"].attrs["long_name"]


def test_behaves_values_of_several_types_stay_what_they_are():
    points = {"motion.frequency_hz": [200, "fast", 210.5], "time.beats": 1}
    table = campaign.map(points, campaign.Serial(), base="fruit-fly-blade")
    assert table.ok.tolist() == [True, False, True] and "fast" in table.reasons[1]
    assert table["motion.frequency_hz"].tolist() == [200, "fast", 210.5]
    mixed = campaign.grid({"a": [1, True, None, "x"], "b": [1, 2.5]})
    assert [type(value) for value in mixed["a"][::2]] == [int, bool, type(None), str]
    assert mixed["b"].dtype == float
    for wrong in ({"a": [1, {}]}, {"a": [1, [2, 3]]}):
        with pytest.raises(CaseError):
            campaign.map(wrong, campaign.Serial(), base="fruit-fly-blade")


def test_behaves_points_may_be_tables_texts_and_vectors():
    import pandas

    frame = pandas.DataFrame({"air.blade.coefficients": ["dickson-2008", "dickinson-1999"], "time.beats": [1, 1]})
    table = campaign.map(frame, campaign.Serial(), base="fruit-fly-blade")
    assert table.ok.all() and table["air.blade.coefficients"].tolist() == list(frame["air.blade.coefficients"])
    flight = Flight.preset("fruit-fly-blade").set({"time.beats": 1, "air.blade.coefficients": "dickinson-1999"})
    assert table["lift_over_weight"][1] == flight.fly().beats["lift_over_weight"][0]
    winds = {"air.stream_m_s": [[0.0, 0.0, 0.0], [-0.1, 0.0, 0.0]], "time.beats": 1}
    blown = campaign.map(winds, campaign.Serial(), base="fruit-fly-blade")
    assert blown.ok.all() and blown.dataset["air.stream_m_s"].shape == (2, 3)
    assert blown["lift_over_weight"][0] != blown["lift_over_weight"][1]


SCRIPT = """
import campaign_tasks as tasks, wingbeat, numpy, sys, time
from wingbeat import campaign
if __name__ == "__main__":
    points = {"motion.frequency_hz": numpy.linspace(180, 220, 200)}
    say = lambda done, of: print(done, flush=True)
    settings = dict(base="fruit-fly-blade", do=tasks.slow, keep=["frequency"], workers=2, chunk_s=0.1, out=sys.argv[1])
    try:
        campaign.map(points, progress=say, **settings)
    except KeyboardInterrupt as stopped:
        print("stopped", sum(stopped.table.ok), time.monotonic())
"""


def begun(tmp_path: Path) -> subprocess.Popen[str]:
    """A campaign that has flown some points in another process."""
    (tmp_path / "script.py").write_text(SCRIPT)
    paths = os.pathsep.join([str(Path(tasks.__file__).parent), *sys.path])
    process = subprocess.Popen(
        [sys.executable, "script.py", tmp_path / "kept"],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": paths},
        stdout=subprocess.PIPE,
        text=True,
    )
    while int(process.stdout.readline()) < 8:
        pass
    return process


def processes_of(tmp_path: Path) -> list[str]:
    """Processes whose folder is this one."""
    found = []
    for process in Path("/proc").iterdir():
        try:
            if process.name.isdigit() and os.readlink(process / "cwd") == str(tmp_path):
                found.append(process.name)
        except OSError:
            pass
    return found


def ended(tmp_path: Path) -> bool:
    """Whether all of them end within some seconds."""
    for _ in range(100):
        if not processes_of(tmp_path):
            return True
        time.sleep(0.1)
    return False


def rest(tmp_path: Path) -> campaign.Table:
    """The same campaign again."""
    points = {"motion.frequency_hz": np.linspace(180, 220, 200)}
    settings = {"base": "fruit-fly-blade", "do": tasks.slow, "keep": ["frequency"], "out": tmp_path / "kept"}
    return campaign.map(points, ThreadPoolExecutor(50), **settings)


@pytest.mark.timed
@pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="looks for processes in /proc")
def test_behaves_ctrl_c_stops_and_keeps(tmp_path):
    process = begun(tmp_path)
    sent = time.monotonic()
    process.send_signal(signal.SIGINT)
    told, _ = process.communicate(timeout=30)
    _, done, when = told.splitlines()[-1].split()
    assert float(when) - sent < 2.0 and int(done) >= 8 and ended(tmp_path)
    again = rest(tmp_path)
    assert again.flown <= 200 - int(done) and again["frequency"].tolist() == np.linspace(180, 220, 200).tolist()


@pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="looks for processes in /proc")
def test_behaves_a_master_that_is_killed_leaves_points_and_no_processes(tmp_path):
    process = begun(tmp_path)
    process.kill()
    process.wait()
    assert ended(tmp_path)
    again = rest(tmp_path)
    assert again.flown <= 192 and again["frequency"].tolist() == np.linspace(180, 220, 200).tolist()


def test_refuses_a_script_without_a_guard(tmp_path):
    (tmp_path / "bare.py").write_text("from wingbeat import campaign\ncampaign.map({'time.beats': [1]}, base='fruit-fly-blade')\n")
    done = subprocess.run([sys.executable, "bare.py"], cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert done.returncode and "FlightError" in done.stderr


BAD = {
    "no points": {"points": []},
    "points that are none": {"points": 3},
    "points that are a text": {"points": "time.beats"},
    "a point that is none": {"points": [{"time.beats": 1}, 2]},
    "other keys": {"points": [{"time.beats": 1}, {"motion.frequency_hz": 200.0}]},
    "lengths": {"points": {"time.beats": [1, 2], "motion.frequency_hz": [200.0]}},
    "no key": {"points": {"": [1]}},
    "ragged": {"points": {"air.stream_m_s": [[1, 2], [1]]}},
    "objects": {"points": {"time.beats": [object()]}},
    "unknown key": {"points": {"motion.frequenzy_hz": [200.0]}},
    "unknown part": {"points": {"motoin.frequency_hz": [200.0]}},
    "unknown number": {"keep": ["lift_newtons"]},
    "number of another task": {"keep": ["peak_watt"]},
    "no numbers": {"keep": []},
    "a number twice": {"keep": ["power_watt", "power_watt"]},
    "a number that is no name": {"keep": [3]},
    "unknown task": {"do": "fligh"},
    "unknown question to a trim": {"do": "trim", "keep": ["peak_watt"], "points": {"trim.fast": [1.0]}},
    "beats of a trim": {"do": "trim", "keep": ["peak_watt"], "last_beats": 1},
    "no beats": {"last_beats": 0},
    "no workers": {"workers": 0},
    "half a worker": {"workers": 1.5},
    "negative time": {"chunk_s": -1.0},
    "no attempts": {"attempts": 0},
    "executor that is none": {"executor": 4},
    "executor that is a class": {"executor": campaign.Serial},
    "unknown preset": {"base": "fruit-fli"},
    "base with parts of its own": {"base": Flight.preset("fruit-fly-blade").with_air(lambda _: np.zeros((3, 6)))},
    "base that is a number": {"base": 3},
    "question to a trim that is not made": {"points": {"trim.forward_m_per_s": [1.0]}},
    "progress that is none": {"progress": 3},
    "out that is a file": {"out": __file__},
}


@pytest.mark.parametrize("name", BAD)
def test_refuses(name):
    good = {"points": {"time.beats": [1]}, "executor": campaign.Serial(), "base": "fruit-fly-blade"}
    with pytest.raises(wingbeat.Error) as caught:
        campaign.map(**good | BAD[name])
    assert caught.value.remedy and caught.value.key, caught.value


def test_refuses_unknown_names_with_what_was_meant():
    with pytest.raises(CaseError) as caught:
        campaign.map({"motion.frequenzy_hz": [1]}, base="fruit-fly-blade")
    assert "did you mean frequency_hz?" in caught.value.remedy and caught.value.key == "motion.frequenzy_hz"
    with pytest.raises(CaseError) as caught:
        campaign.map({"time.beats": [1]}, base="fruit-fly-blade", keep=["power_wat"])
    assert "did you mean power_watt?" in caught.value.remedy
    with pytest.raises(CaseError, match="the function cannot be sent") as caught:
        campaign.map({"time.beats": [1]}, base="fruit-fly-blade", do=lambda _, lock=threading.Lock(): {}, keep=["x"])


def test_exact_grid_is_all_combinations_the_last_key_quickest():
    points = campaign.grid({"time.beats": [1, 2], "motion.frequency_hz": [190.0, 200.0, 210.0]})
    assert points["time.beats"].tolist() == [1, 1, 1, 2, 2, 2]
    assert points["motion.frequency_hz"].tolist() == [190.0, 200.0, 210.0] * 2
    for values in ([], 3, "abc", [[1.0, 2.0], [1.0]]):
        with pytest.raises(CaseError, match="time.beats has no list of values"):
            campaign.grid({"time.beats": values})


def test_behaves_single_values_alone_are_one_point():
    base = wingbeat.Flight.preset("fruit-fly-blade").set("time.beats", 1)
    table = campaign.map({"motion.frequency_hz": 200.0, "body.mass_kg": 1e-6}, campaign.Serial(), base=base)
    assert table["power_watt"].shape == (1,)


def test_exact_a_value_that_is_none_takes_its_key_out_of_the_case():
    """At some points the wing has its chord, at others an area instead."""
    chord, area = "wing.right.planform.beta.mean_chord_m", "wing.right.planform.beta.area_m2"
    points = {chord: [0.7e-3, None, None], area: [None, 1.6e-6, 1.7e-6], "time.beats": 1}
    found = campaign.map(points, campaign.Serial(), base="fruit-fly-blade", keep=["power_watt"])
    assert found.ok.all(), found.reasons
    before = Flight.preset("fruit-fly-blade").set({chord: 0.7e-3, "time.beats": 1}).fly()
    assert found["power_watt"][0] == before.beats["power_watt"].mean()
    always = campaign.map({chord: None, area: [1.6e-6, 1.7e-6], "time.beats": 1}, campaign.Serial(), base="fruit-fly-blade")
    assert always["power_watt"].tolist() == found["power_watt"].tolist()[1:]
    alone = Flight.preset("fruit-fly-blade").set({chord: None, area: 1.7e-6, "time.beats": 1}).fly()
    assert always["power_watt"][1] == alone.beats["power_watt"].mean()
    with pytest.raises(CaseError, match="neither numbers nor texts"):
        campaign.map({chord: [None, object()]}, campaign.Serial(), base="fruit-fly-blade")
