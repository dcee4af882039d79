"""Executors of other libraries on local clusters: the same bits as from one process. What is not installed is skipped by name."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import threading
from pathlib import Path

import campaign_tasks as tasks
import numpy as np
import pytest

from wingbeat import CaseError, campaign

POINTS = {"motion.frequency_hz": np.linspace(180.0, 220.0, 40), "time.beats": 1}
SCRIPTS = os.path.dirname(sys.executable)
SETTINGS = {"base": "fruit-fly-blade", "chunk_s": 0.05}


@pytest.fixture(scope="module")
def expected() -> dict[str, bytes]:
    return bits(campaign.map(POINTS, campaign.Serial(), **SETTINGS))


def bits(table: campaign.Table) -> dict[str, bytes]:
    """All of a table bit for bit."""
    assert not any(table.reasons), table.reasons
    return {name: table[name].tobytes() for name in table}


@pytest.fixture(scope="module")
def dask_client():
    pytest.importorskip("distributed")
    from distributed import Client, LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        yield client


def test_agrees_dask(expected, dask_client):
    assert bits(campaign.map(POINTS, dask_client, **SETTINGS)) == expected
    assert bits(campaign.map(POINTS, dask_client.get_executor(), **SETTINGS)) == expected


def test_agrees_dask_when_workers_are_killed(expected, dask_client):
    many = {"motion.frequency_hz": np.tile(POINTS["motion.frequency_hz"], 10), "time.beats": 1}
    killed = []

    def kill(done: int, of: int) -> None:
        if len(killed) < 2 and done > 40 * (1 + len(killed)):
            pids = list(dask_client.run(os.getpid).values())
            os.kill(pids[0], signal.SIGKILL)
            killed.append(done)

    table = campaign.map(many, dask_client, progress=kill, **SETTINGS)
    assert len(killed) == 2 and not any(table.reasons)
    assert table["power_watt"].tobytes() == expected["power_watt"] * 10


def test_behaves_functions_without_a_module_go_to_dask(dask_client):
    pytest.importorskip("cloudpickle")
    task = {"do": lambda flight: {"double": 2 * flight.case.motion.frequency_hz}, "keep": {"double": "Hz"}}
    table = campaign.map(POINTS, dask_client, base="fruit-fly-blade", **task)
    assert table["double"].tolist() == (2 * POINTS["motion.frequency_hz"]).tolist()


def test_agrees_ray(expected):
    ray = pytest.importorskip("ray")
    with pytest.raises(CaseError, match="not connected"):
        campaign.Ray()
    paths = {"PYTHONPATH": str(Path(tasks.__file__).parent)}
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, runtime_env={"env_vars": paths})
    try:
        assert bits(campaign.map(POINTS, campaign.Ray(), **SETTINGS)) == expected
        assert bits(campaign.map(POINTS, campaign.Ray(num_cpus=0.5), **SETTINGS)) == expected
        deadly = {"do": tasks.deadly, "keep": ["frequency"], "attempts": 1}
        table = campaign.map({"motion.frequency_hz": [190.0, 200.0]}, campaign.Ray(max_retries=0), base="fruit-fly-blade", **deadly)
        assert table["frequency"][0] == 190.0 and "WorkerCrashedError" in table.reasons[1]
    finally:
        ray.shutdown()


def test_agrees_parsl(expected, tmp_path, monkeypatch):
    parsl = pytest.importorskip("parsl")
    monkeypatch.setenv("PATH", SCRIPTS, prepend=os.pathsep)  # where Parsl's own commands are
    from parsl.concurrent import ParslPoolExecutor
    from parsl.executors import HighThroughputExecutor
    from parsl.providers import LocalProvider

    processes = HighThroughputExecutor(
        label="local", max_workers_per_node=2, address="127.0.0.1", encrypted=False, provider=LocalProvider(max_blocks=1)
    )
    config = parsl.Config(executors=[processes], run_dir=str(tmp_path), usage_tracking=0)
    with ParslPoolExecutor(config) as pool:
        assert bits(campaign.map(POINTS, pool, workers=2, **SETTINGS)) == expected


MPI = """
import sys
import numpy
from mpi4py.futures import MPIPoolExecutor
from wingbeat import campaign
if __name__ == "__main__":
    points = {"motion.frequency_hz": numpy.linspace(180.0, 220.0, 40), "time.beats": 1}
    with MPIPoolExecutor() as pool:
        table = campaign.map(points, pool, base="fruit-fly-blade", chunk_s=0.05, workers=2)
    assert not any(table.reasons)
    numpy.save("power.npy", table["power_watt"])
"""


def test_agrees_mpi(expected, tmp_path):
    pytest.importorskip("mpi4py")
    mpirun = shutil.which("mpirun", path=os.pathsep.join([SCRIPTS, os.environ["PATH"]]))
    if mpirun is None:
        pytest.skip("no mpirun")
    (tmp_path / "points.py").write_text(MPI)
    start = [mpirun, "-n", "3", sys.executable, "-m", "mpi4py.futures", "points.py"]
    done = subprocess.run(start, cwd=tmp_path, env=os.environ | tasks.MPI, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert np.load(tmp_path / "power.npy").tobytes() == expected["power_watt"]


def test_behaves_threads_of_this_process_keep_their_number(expected):
    """Flights elsewhere are on one thread; the environment of the process that started them stays as it was."""
    from concurrent.futures import ThreadPoolExecutor

    before, there = os.environ.get("RAYON_NUM_THREADS"), threading.active_count()
    with ThreadPoolExecutor(2) as pool:
        assert bits(campaign.map(POINTS, pool, **SETTINGS)) == expected
    assert os.environ.get("RAYON_NUM_THREADS") == before and threading.active_count() == there
