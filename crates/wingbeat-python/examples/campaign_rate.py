"""Rate of `campaign.map` against processes that fly the same points in a plain loop: `python campaign_rate.py [POINTS] [PAIRS]`.

Both take turns on as many processes as there are processors. Printed are the ratios of the rates (independent processes
are 1) by the clock and by processor time, which other work on the machine disturbs less. Linux only.
"""

from __future__ import annotations

import os
import statistics
import sys
import time
from concurrent.futures import wait
from pathlib import Path

import numpy as np

import wingbeat
from wingbeat import campaign

TICK_S = 1 / os.sysconf("SC_CLK_TCK")


def processor_s(pids: list[int]) -> float:
    """Processor time of processes and of this one."""
    times = [Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[11:13] for pid in [*pids, os.getpid()]]
    return TICK_S * sum(int(t) for pair in times for t in pair)


def plain(frequencies: list[float]) -> list[float]:
    """A loop without any of this package's campaigns."""
    base = wingbeat.Flight.preset("fruit-fly-blade").set("time.beats", 1)
    means = []
    for frequency in frequencies:
        beats = base.set("motion.frequency_hz", frequency).fly(frames=False).beats
        means.append((float(beats["lift_over_weight"].mean()), float(beats["power_watt"].mean())))
    return means


def main(count: int = 2000, pairs: int = 5) -> None:
    """Measures."""
    frequencies = np.linspace(180.0, 220.0, count)
    base = wingbeat.Flight.preset("fruit-fly-blade").set("time.beats", 1)
    clock, processor = [], []
    with campaign.Processes() as pool:
        workers = pool._max_workers
        shares = [frequencies[k::workers].tolist() for k in range(workers)]
        wait([pool.submit(plain, share[:20]) for share in shares * 2])  # all processes are there and have flown
        pids = list(pool._pool._processes)

        def took(work) -> tuple[float, float]:
            start, used = time.perf_counter(), processor_s(pids)
            work()
            return time.perf_counter() - start, processor_s(pids) - used

        for _ in range(pairs):
            alone = took(lambda: [future.result() for future in [pool.submit(plain, share) for share in shares]])
            mapped = took(lambda: campaign.map({"motion.frequency_hz": frequencies}, pool, base=base))
            clock.append(alone[0] / mapped[0])
            processor.append(alone[1] / mapped[1])
            print(f"alone {count / alone[0]:.0f}/s {1e3 * alone[1] / count:.2f} ms, map {count / mapped[0]:.0f}/s {1e3 * mapped[1] / count:.2f} ms", flush=True)
    middle = f"{statistics.median(clock):.3f} by the clock, {statistics.median(processor):.3f} by processor time"
    print(f"{workers} processes, {count} points, medians of {pairs} pairs: {middle}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
