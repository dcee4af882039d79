"""Campaign files on engines: the same bytes as from the command line."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import Future
from pathlib import Path
from typing import Any

import pytest

import wingbeat
from wingbeat import campaign

FILE = """case = "fruit-fly-blade"
keep = ["lift_over_weight", "power_watt"]
mean_beats = 1
samples = 12
seed = 1
[set]
"time.beats" = 1
"time.steps_per_beat" = 20
[parameter."motion.frequency_hz"]
uniform = { from = 190, to = 210 }
"""
TABLES = ["points.csv", "points.parquet", "points.nc", "failed.csv"]


def command(*words: str | Path) -> None:
    subprocess.run([sys.executable, "-m", "wingbeat", "campaign", *map(str, words)], check=True, capture_output=True)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "study.toml"
    path.write_text(FILE)
    return path


def test_agrees_with_the_command_line_to_the_byte(file: Path, tmp_path: Path) -> None:
    here, there = tmp_path / "here", tmp_path / "there"
    found = campaign.run(file, campaign.Processes(2), out=here)
    assert found == {"points": 12, "done": 12, "failed": 0}
    command("run", file, "--out", there, "--jobs", "1")
    for folder in (here, there):
        command("merge", file, "--out", folder)
    for name in TABLES:
        assert (here / name).read_bytes() == (there / name).read_bytes(), name
    assert campaign.run(file, campaign.Serial(), out=there) == found, "nothing is left to fly"


def test_agrees_with_the_command_line_where_the_results_go(file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    file.write_text(FILE.replace("samples = 12", "samples = 2"))
    (tmp_path / "link.toml").symlink_to(file)
    for words, name in (("", "link"), ('name = "my map"\n', "my map")):
        file.write_text(words + file.read_text())
        assert campaign.run("link.toml", campaign.Serial())["done"] == 2
        command("status", "link.toml")
        assert (tmp_path / "results" / name / "points").is_dir()
    assert sorted(folder.name for folder in (tmp_path / "results").iterdir()) == ["link", "my map"]


def test_refuses_a_file_that_is_changed_while_it_is_flown(file: Path, tmp_path: Path) -> None:
    class Changes(campaign.Serial):
        def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
            file.write_text(FILE.replace("seed = 1", "seed = 2"))
            return super().submit(fn, *args, **kwargs)

    with pytest.raises(wingbeat.FlightError, match="was changed while it was flown"):
        campaign.run(file, Changes(), out=tmp_path / "out")


def test_behaves_damaged_results_and_lost_files_are_flown_again(file: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    file.write_text(FILE.replace("samples = 12", 'samples = 6\nfiles = ["history"]'))
    assert campaign.run(file, campaign.Serial(), out=out)["done"] == 6
    results, histories = sorted(out.glob("points/*/*.ok")), sorted(out.glob("files/*/history.csv"))
    whole = [path.read_bytes() for path in results]
    results[-1].write_bytes(whole[-1][:-9])
    lost = histories[0].read_bytes()
    histories[0].unlink()
    assert campaign.run(file, campaign.Serial(), out=out)["done"] == 6
    assert [path.read_bytes() for path in results] == whole and histories[0].read_bytes() == lost


class Remembers(campaign.Serial):
    """Takes equal calls for one, as Dask does; the worker of its first call is killed."""

    def __init__(self) -> None:
        self.known: dict[Any, Future[Any]] = {}

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        if not self.known:
            self.known[args] = super().submit(lambda: -9)
        if args not in self.known:
            self.known[args] = super().submit(fn, *args)
        return self.known[args]


def test_behaves_a_part_is_flown_again_where_equal_calls_are_one(file: Path, tmp_path: Path) -> None:
    assert campaign.run(file, Remembers(), out=tmp_path / "out") == {"points": 12, "done": 12, "failed": 0}


def test_refuses_what_no_campaign_is(file: Path, tmp_path: Path) -> None:
    file.write_text(FILE.replace("keep", "kep"))
    with pytest.raises(wingbeat.CaseError, match="kep"):
        campaign.run(file, campaign.Serial(), out=tmp_path / "out")
    assert not (tmp_path / "out").exists()
    with pytest.raises(wingbeat.CaseError, match="attempts"):
        campaign.run(file, attempts=0)
    file.write_text(FILE)
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "thesis.txt").write_text("mine")
    with pytest.raises(wingbeat.CaseError, match="no campaign"):
        campaign.run(file, campaign.Serial(), out=tmp_path / "other")
    assert (tmp_path / "other" / "thesis.txt").read_text() == "mine"
