"""A campaign while its workers are killed: `python campaign_kills.py ENGINE [POINTS] [KILLS]`.

ENGINE is `processes`, `dask` or `ray`, on this machine. Points are flown in one process first, then on the engine while
random workers get SIGKILL at random times; the numbers must be the same, byte for byte. Linux only.
"""

from __future__ import annotations

import os
import random
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import contextmanager, suppress
from pathlib import Path

import numpy as np

from wingbeat import campaign

Pids = Callable[[], list[int]]


def parents() -> dict[int, tuple[int, str]]:
    """Parent and command of every process that lives."""
    found = {}
    for folder in Path("/proc").iterdir():
        try:
            state, parent = (folder / "stat").read_text().rsplit(")", 1)[1].split()[:2]
            if state != "Z":
                found[int(folder.name)] = int(parent), (folder / "cmdline").read_text().replace("\0", " ")
        except (OSError, ValueError):
            pass
    return found


def descendants() -> dict[int, str]:
    """Processes that this one has started, directly or not, and their commands."""
    all_there, found, more = parents(), {}, {os.getpid()}
    while more := {pid for pid, (parent, _) in all_there.items() if parent in more} - found.keys():
        found |= {pid: all_there[pid][1] for pid in more}
    return found


@contextmanager
def processes() -> Iterator[tuple[Executor, Pids]]:
    """Processes of the package."""
    with campaign.Processes() as pool:
        yield pool, lambda: list(getattr(pool._pool, "_processes", None) or {})


@contextmanager
def dask() -> Iterator[tuple[Executor, Pids]]:
    """A local cluster of Dask."""
    from dask import config
    from distributed import Client, LocalCluster

    # Dask looks for a lost worker after a while, and takes its place away if it has been killed again just then.
    config.set({"distributed.deploy.lost-worker-timeout": "1h"})
    with LocalCluster(threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:

        def pids() -> list[int]:  # of workers that have begun: one that is killed before is not started again by Dask
            there = client.scheduler_info(n_workers=-1)["workers"]
            return [n.process.pid for n in cluster.workers.values() if n.process and n.worker_address in there]

        yield client.get_executor(), pids


@contextmanager
def ray() -> Iterator[tuple[Executor, Pids]]:
    """A local cluster of Ray."""
    import ray as cluster

    cluster.init(num_cpus=campaign.Processes()._max_workers, include_dashboard=False, log_to_driver=False)
    try:
        yield campaign.Ray(), lambda: [pid for pid, line in descendants().items() if line.startswith(("ray::fly_batch", "ray::IDLE"))]
    finally:
        cluster.shutdown()


def main(engine: str, count: int = 10_000, kills: int = 50) -> None:
    """Flies, kills, compares."""
    chance = random.Random(count)
    points = {"motion.frequency_hz": np.linspace(170.0, 240.0, count), "time.beats": 1}
    start = time.perf_counter()
    undisturbed = campaign.map(points, campaign.Serial(), base="fruit-fly-blade")
    serial_s = time.perf_counter() - start
    targets = sorted(chance.sample(range(count * 19 // 20), kills))
    now, killed = [0], 0
    over = threading.Event()

    def kill(pids: Pids) -> None:
        nonlocal killed
        for target in targets:
            while now[0] < target and not over.wait(0.02):
                pass
            over.wait(0.3 * chance.random())
            if over.is_set():
                return
            if there := pids():
                with suppress(ProcessLookupError):
                    os.kill(chance.choice(there), signal.SIGKILL)
                    killed += 1

    with {"processes": processes, "dask": dask, "ray": ray}[engine]() as (executor, pids):
        campaign.map({"time.beats": [1] * 8}, executor, base="fruit-fly-blade")  # all processes are there
        killer = threading.Thread(target=kill, args=(pids,))
        killer.start()
        start = time.perf_counter()
        try:
            table = campaign.map(points, executor, base="fruit-fly-blade", progress=lambda done, of: now.__setitem__(0, done))
        finally:
            over.set()
            killer.join()
        seconds = time.perf_counter() - start
    same = all(table[name].tobytes() == undisturbed[name].tobytes() for name in table) and not any(table.reasons)
    print(f"{engine}: {count} points, {killed} kills, {seconds:.0f} s ({serial_s:.0f} s in one process); bytes the same: {same}")
    sys.exit(not same)


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
