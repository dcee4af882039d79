"""Processes that are forks of one in which threads have flown: none of these go with them."""

from __future__ import annotations

import multiprocessing
from concurrent.futures import ProcessPoolExecutor

import gymnasium
import numpy as np
import pytest

import wingbeat.gym  # noqa: F401  (registers its environments)
from wingbeat import Flight, campaign
from wingbeat.gym import VectorEnvironment

pytestmark = pytest.mark.skipif(
    "fork" not in multiprocessing.get_all_start_methods(), reason="there are no forks here"
)
FEW = {"time.beats": 0.1, "output.figures": False}
LATTICE = {**FEW, "air.shed": ["trailing"]}


def histories() -> list[np.ndarray]:
    """Of flights in every way that Python has, on threads: a lattice, blade elements, steps, a trim, a vector of episodes."""
    lattice = Flight.preset("fruit-fly-tethered").set(LATTICE)
    stepper = lattice.start()
    stepper.step(3)
    envs = VectorEnvironment(64, "hover")
    envs.reset(seed=3)
    seen = envs.step(np.zeros((64, 4), dtype=np.float32))[0]
    trim = Flight.preset("fruit-fly-blade").trim()
    return [
        lattice.fly().history["air_impulse_n1_newton_s"].to_numpy(),
        Flight.preset("fruit-fly-blade").set(FEW).fly().history["body_z_m"].to_numpy(),
        stepper.frame.surface.nodes_m,
        seen.copy(),
        trim.stability().A,
    ]


def fork() -> multiprocessing.context.ForkContext:
    return multiprocessing.get_context("fork")


def in_a_fork(send) -> None:
    send.send(histories())


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_agrees_a_fork_with_the_process_it_is_of():
    here = histories()
    receive, send = fork().Pipe(duplex=False)
    process = fork().Process(target=in_a_fork, args=(send,), daemon=True)
    process.start()
    assert receive.poll(120), "the fork waits for threads that it has not"
    there = receive.recv()
    process.join(10)
    assert process.exitcode == 0
    for a, b in zip(here, there, strict=True):
        np.testing.assert_array_equal(a, b)


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_agrees_gymnasium_s_own_vectors_with_each_other():
    histories()
    ends = []
    for mode in ["sync", "async"]:
        envs = gymnasium.make_vec("wingbeat/Hover-v0", num_envs=2, vectorization_mode=mode)
        envs.reset(seed=1)
        for _ in range(3):
            seen = envs.step(np.zeros((2, 4), dtype=np.float32))[0]
        envs.close()
        ends.append(seen)
    np.testing.assert_array_equal(*ends)


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_agrees_a_campaign_of_forks_with_one_of_its_own():
    histories()
    points = {"motion.frequency_hz": [190.0, 200.0, 210.0], "time.beats": 1}
    with ProcessPoolExecutor(2, fork()) as pool:
        table = campaign.map(points, pool, base="fruit-fly-blade")
    serial = campaign.map(points, campaign.Serial(), base="fruit-fly-blade")
    assert all(table[k].tobytes() == serial[k].tobytes() for k in serial)
