"""Memory that is let go."""

from __future__ import annotations

import gc
import sys
import tracemalloc
from pathlib import Path

import pytest

import wingbeat


def resident_mib() -> float:
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096 / 2**20


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_behaves_a_thousand_flights_do_not_grow_the_process(blade):
    flight = blade.set({"time.beats": 0.5})
    controlled = flight.with_controller(lambda _: wingbeat.Adjustment(), every_steps=10)

    def fly(count: int) -> None:
        for k in range(count):
            run = (controlled if k % 4 == 0 else flight).fly()
            assert run.arrays["time_s"].size == 51
            del run

    fly(200)
    gc.collect()
    before = resident_mib()
    fly(1000)
    gc.collect()
    # A flight's history alone takes 51 rows of 176 numbers, 70 kB: a thousand kept ones are 70 MB.
    assert resident_mib() - before < 8.0


def test_behaves_python_keeps_nothing_of_a_flight(blade):
    flight = blade.set("time.beats", 0.1)

    def fly() -> None:
        run = flight.fly()
        _ = run.arrays, run.history, run.beats, run.summary
        try:
            flight.with_controller(lambda _: 1 / 0).fly()
        except ZeroDivisionError:
            pass

    def kept(flights: int) -> int:
        for _ in range(flights):
            fly()
        gc.collect()
        return tracemalloc.get_traced_memory()[0]

    tracemalloc.start()
    kept(30)  # tables of names fill up: 20 kB
    grown = -kept(1) + kept(20)
    tracemalloc.stop()
    assert grown < 10_000, "twenty flights, half a kilobyte each"
