"""Sections of docs/campaigns-python.md, each run as the script that it is."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import campaign_tasks as tasks
import numpy as np
import pytest

from wingbeat import campaign

PAGE = (Path(__file__).parents[3] / "docs" / "campaigns-python.md").read_text(encoding="utf-8")
NEEDS = {"Processes": (), "Dask": ("distributed",), "Ray": ("ray",), "MPI": ("mpi4py",), "Parsl": ("parsl",)}


def sections() -> dict[str, str]:
    """Text under each heading."""
    parts = re.split(r"^## (.+)$", PAGE, flags=re.MULTILINE)
    return {"": parts[0]} | dict(zip(parts[1::2], parts[2::2], strict=True))


def code(section: str, language: str) -> str:
    """The first block of a section."""
    found = re.search(rf"```{language}\n(.*?)```", sections()[section], flags=re.DOTALL)
    assert found, section
    return found[1]


def run(section: str, folder: Path) -> None:
    """The script of a section, which also writes the power."""
    script = code(section, "python") + '    open("power", "wb").write(table["power_watt"].tobytes())\n'
    (folder / "points.py").write_text(script)
    scripts = os.path.dirname(sys.executable)
    path = os.pathsep.join([scripts, os.environ["PATH"]])
    command = [sys.executable, "points.py"]
    if section == "MPI":
        command = code(section, "sh").split()
    around = os.environ | tasks.MPI | {"PATH": path}
    done = subprocess.run(command, cwd=folder, env=around, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr[-3000:]


@pytest.fixture(scope="module")
def expected() -> bytes:
    points = {"motion.frequency_hz": [180 + k for k in range(40)], "time.beats": 1}
    return campaign.map(points, campaign.Serial(), base="fruit-fly-blade")["power_watt"].tobytes()


def test_behaves_every_engine_has_a_section():
    assert set(sections()) == {"", "A campaign file on an engine", *NEEDS, "Measured"}


def test_behaves_first_script_runs(tmp_path):
    run("", tmp_path)
    assert np.isfinite(np.frombuffer((tmp_path / "power").read_bytes())).sum() == 22
    assert list((tmp_path / "kept" / "points").glob("*.jsonl"))


@pytest.mark.parametrize("section", NEEDS)
def test_agrees_on_every_engine(section, expected, tmp_path):
    for module in NEEDS[section]:
        pytest.importorskip(module)
    if section == "MPI" and not any(Path(p, "mpirun").exists() for p in [os.path.dirname(sys.executable), *os.get_exec_path()]):
        pytest.skip("no mpirun")
    run(section, tmp_path)
    assert (tmp_path / "power").read_bytes() == expected
