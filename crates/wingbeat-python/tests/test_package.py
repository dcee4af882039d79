"""The package itself: stubs, types, import, command line."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import sysconfig
import time
from pathlib import Path

import wingbeat
from wingbeat import _core


def test_behaves_stubs_are_those_of_the_module(tmp_path):
    check = [sys.executable, "-m", "mypy.stubtest", "wingbeat._core", "--ignore-disjoint-bases"]
    done = subprocess.run(check, capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


def test_behaves_everything_public_has_a_docstring():
    for name in wingbeat.__all__:
        thing = getattr(wingbeat, name)
        assert thing.__doc__, name
        if isinstance(thing, type):
            own = [m for m, f in vars(thing).items() if not m.startswith("_") and (callable(f) or isinstance(f, property))]
            assert all(getattr(thing, m).__doc__ for m in own), name


def test_behaves_import_takes_less_than_150_ms_and_brings_nothing_heavy():
    code = (
        "import sys, time; t = time.process_time(); import wingbeat; t = time.process_time() - t\n"
        "print(t, [m for m in ('xarray', 'matplotlib', 'pandas', 'gymnasium', 'scipy', 'numpy') if m in sys.modules])"
    )
    told = [subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout for _ in range(3)]
    seconds, rest = min(told).split(" ", 1)
    assert float(seconds) < 0.15 and rest.strip() == "[]", told


def test_behaves_the_command_comes_along(program, tmp_path):
    script = Path(sysconfig.get_path("scripts"), "wingbeat")
    told = subprocess.run([script, "--version"], capture_output=True, text=True, cwd=tmp_path).stdout
    assert told == program("--version").stdout and subprocess.run([script, "check", "nothing"]).returncode == 2
    assert told.strip() == f"wingbeat {wingbeat.__version__}"
    assert set(wingbeat.presets()) <= set(program("presets").stdout.split())
    assert program("run", "nothing-of-the-kind").returncode == 2
    assert program("frobnicate").returncode == 2


def test_behaves_the_command_saves_its_state_on_ctrl_c(tmp_path):
    command = [sys.executable, "-m", "wingbeat", "run", "fruit-fly-hover", "--out", "run", "--set", "time.beats=20"]
    process = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    while not (tmp_path / "run" / "history.csv").is_file():
        time.sleep(0.05)
        assert process.poll() is None
    time.sleep(0.5)
    os.kill(process.pid, signal.SIGINT)
    _, told = process.communicate(timeout=120)
    assert process.returncode == 130 and "interrupted" in told and "Traceback" not in told
    assert wingbeat.read(tmp_path / "run").outcome == "interrupted"


def test_behaves_schema_is_json():
    import json

    assert "motion" in json.loads(_core.schema())["properties"]
