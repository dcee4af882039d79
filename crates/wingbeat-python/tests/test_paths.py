"""Paths are texts or what stands for one; bytes are refused by name."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

import wingbeat
from wingbeat import Flight, campaign

TABLE = "phase,angle\n0,{0}\n0.25,0\n0.5,-{0}\n0.75,0\n1,{0}\n"
KEYS = [f"wing.{side}.motion.phi.table.file" for side in ("left", "right")]


@pytest.fixture
def folder(tmp_path) -> Path:
    """A case, and two tables of angles."""
    flight = Flight.preset("fruit-fly-blade").set({"time.beats": 0.2, "output.figures": False})
    (tmp_path / "case.toml").write_text(flight.case_text)
    for name, angle in (("a.csv", 60), ("b.csv", 70)):
        (tmp_path / name).write_text(TABLE.format(angle))
    return tmp_path


class Named:
    """What stands for a path."""

    def __init__(self, name: str | bytes) -> None:
        self._name = name

    def __fspath__(self) -> str | bytes:
        return self._name


def test_behaves_paths_are_taken_wherever_a_file_is_named(folder):
    case = folder / "case.toml"
    flights = [Flight.preset(case), Flight.preset(str(case)), Flight.from_case(case), Flight.preset(Named(os.fspath(case)))]
    assert len({flight.case_text for flight in flights}) == 1
    by_text, by_path = (flights[0].set({key: kind(folder / "a.csv") for key in KEYS}) for kind in (str, Path))
    assert by_path.case_text == by_text.case_text != flights[0].case_text
    run = flights[0].fly(out=Named(os.fspath(folder / "out")))
    np.testing.assert_array_equal(wingbeat.read(folder / "out").arrays["time_s"], run.arrays["time_s"])
    run = flights[0].fly()
    run.write(folder / "written")
    assert (folder / "written" / "history.csv").is_file()


def test_agrees_columns_of_paths_with_columns_of_texts(folder):
    names = ["a.csv", "b.csv", None]
    of_texts, of_paths = (
        {key: [None if name is None else kind(folder / name) for name in names] for key in KEYS} for kind in (str, Path)
    )
    settings = {"base": folder / "case.toml", "do": lambda flight: {"steps": flight.steps}, "keep": {"steps": "1"}}
    for points in (of_texts, of_paths, {KEYS[0]: folder / "a.csv", KEYS[1]: [folder / "a.csv"] * 2}):
        table = campaign.map(points, campaign.Serial(), **settings)
        assert table.ok[:2].all(), table.reasons
    grid = campaign.grid({key: [folder / "a.csv", folder / "b.csv"] for key in KEYS})
    assert campaign.map(grid, campaign.Serial(), **settings).ok.all()


@pytest.mark.parametrize("given", [b"x", 3, Named(b"x")], ids=["bytes", "number", "bytes of an object"])
def test_refuses_what_is_no_path(blade, given, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run = blade.fly()
    asked = {
        "name": lambda: Flight.preset(given),
        "case": lambda: Flight.from_case(given),
        "out": lambda: blade.fly(out=given),
        "dir": lambda: wingbeat.read(given),
        "into": lambda: run.export("hdf5", given),
    }
    for key, ask in asked.items():
        with pytest.raises(wingbeat.CaseError) as caught:
            ask()
        assert caught.value.key == key and caught.value.remedy, key
    with pytest.raises(wingbeat.CaseError):
        run.write(given)
    if not isinstance(given, int):
        with pytest.raises(wingbeat.CaseError) as caught:
            blade.set("name", given)
        assert caught.value.key == "name"
    assert not list(tmp_path.iterdir())
