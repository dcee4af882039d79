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
