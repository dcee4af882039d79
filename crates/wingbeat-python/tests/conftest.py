"""What several tests need."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import matplotlib
import pytest

import wingbeat

matplotlib.use("Agg")


@pytest.fixture(scope="session")
def blade() -> wingbeat.Flight:
    """Two wingbeats of a fruit fly in blade elements."""
    return wingbeat.Flight.preset("fruit-fly-blade").set("time.beats", 2)


@pytest.fixture(scope="session")
def lattice() -> wingbeat.Flight:
    """A fifth of a wingbeat in the vortex lattice, frames at every other step."""
    keys = {"time.steps_per_beat": 40, "time.beats": 0.2, "output.frames_every": 2, "output.page": False}
    return wingbeat.Flight.preset("fruit-fly-hover").set(keys)


@pytest.fixture(scope="session")
def program() -> Callable[..., subprocess.CompletedProcess[str]]:
    """The command line that comes with the package."""

    def run(*args: object) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "wingbeat", *map(str, args)]
        return subprocess.run(command, capture_output=True, text=True, timeout=300)

    return run


def interrupted(code: str, cwd: Path) -> float:
    """Seconds from Ctrl-C until ``code`` notices it. It is sent when ``code``, which gives ``flying`` as its progress,
    has flown some steps: what time a flight takes differs between machines."""
    script = (
        "import time, wingbeat\n"
        "def flying(done, of, told=[]):\n"
        "    if done > 3 and not told:\n        told.append(done)\n        print('flying', flush=True)\n"
        "try:\n" + "".join(f"    {line}\n" for line in code.splitlines())
        + "except KeyboardInterrupt:\n    print(time.monotonic())\n"
    )
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True, cwd=cwd)
    assert process.stdout is not None
    assert process.stdout.readline() == "flying\n"
    sent = time.monotonic()
    os.kill(process.pid, 2)
    answer, _ = process.communicate(timeout=60)
    return float(answer.splitlines()[-1]) - sent
