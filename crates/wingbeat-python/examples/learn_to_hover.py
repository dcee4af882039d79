"""Learns to hover from rewards alone: a linear policy found by the evolution strategy CMA-ES [Hansen & Ostermeier 2001] of the
library cma, and the linear-quadratic regulator beside it, which is made from the equations.

    pip install './crates/wingbeat-python[gym,plot]' cma
    python learn_to_hover.py [GENERATIONS]

An action is ``tanh(W o)`` of twelve observed numbers (place, velocity, angular velocity, tilt), each over its spread in flights
without control. A generation flies every candidate ``W`` in the same few flights; the mean of the candidates is then judged
in flights that none of them saw. Writes learn_to_hover.csv and learn_to_hover.svg.
"""

from __future__ import annotations

import csv
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import cma
import numpy as np

from wingbeat.gym import VectorEnvironment

SEEN, CONTROLS = 12, 4
Policy = Callable[[np.ndarray], np.ndarray]


class Judged(NamedTuple):
    """The policy after a generation."""

    generation: int
    wingbeats: int
    """Flown so far to learn."""
    core_seconds: float
    mean: float
    """Sum of the rewards of a flight, at most its number of wingbeats: mean over the flights of the test."""
    worst: float


def returns(envs: VectorEnvironment, policy: Policy, seeds: list[int]) -> tuple[np.ndarray, int]:
    """Sum of the rewards of one flight of each seed, and the wingbeats flown."""
    observed, _ = envs.reset(seed=seeds)
    total, flying, beats = np.zeros(envs.num_envs), np.ones(envs.num_envs, bool), 0
    while flying.any():
        observed, rewards, lost, over, _ = envs.step(policy(observed))
        total += np.where(flying, rewards, 0.0)
        beats += int(flying.sum())
        flying &= ~(lost | over)
    return total, beats


def spread(envs: VectorEnvironment, beats: int = 10) -> np.ndarray:
    """Standard deviations of what is observed in flights without control."""
    observed, _ = envs.reset(seed=0)
    seen = [observed]
    for _ in range(beats):
        seen.append(envs.step(np.zeros((envs.num_envs, CONTROLS)))[0])
    return np.std(np.concatenate(seen)[:, :SEEN], axis=0)


def linear(weights: Any, scale: np.ndarray) -> Policy:
    """The policies of ``weights``, each for as many flights as any other."""
    gains = np.reshape(weights, (-1, CONTROLS, SEEN)) / scale

    def policy(observed: np.ndarray) -> np.ndarray:
        flights = observed[:, :SEEN].reshape(len(gains), -1, SEEN)
        return np.tanh(flights @ gains.transpose(0, 2, 1)).reshape(-1, CONTROLS)

    return policy


def learn(
    generations: int,
    *,
    candidates: int = 16,
    flights: int = 4,
    judge_every: int = 5,
    test: int = 64,
    seed: int = 1,
    **settings: Any,
) -> Iterator[Judged]:
    """Learns, and judges the mean of the candidates every few generations."""
    settings = {"task": "hover", "autoreset_mode": "Disabled"} | settings
    envs = VectorEnvironment(candidates * flights, **settings)
    tests = VectorEnvironment(test, **settings)
    scale, flown, begun = spread(envs), 0, time.process_time()
    options = {"popsize": candidates, "seed": seed, "verbose": -9}
    search = cma.CMAEvolutionStrategy(np.zeros(CONTROLS * SEEN), 0.03, options)
    for generation in range(1, generations + 1):
        asked = search.ask()
        seeds = [generation * flights + k for k in range(flights)] * candidates
        total, beats = returns(envs, linear(asked, scale), seeds)
        search.tell(asked, -total.reshape(candidates, flights).mean(axis=1))
        flown += beats
        if generation % judge_every == 0:
            spent = time.process_time() - begun
            policy = linear(search.result.xfavorite, scale)
            judged, _ = returns(tests, policy, [10**6 + k for k in range(test)])
            yield Judged(generation, flown, spent, float(judged.mean()), float(judged.min()))
            begun = time.process_time() - spent


def baselines(test: int = 64, **settings: Any) -> tuple[np.ndarray, np.ndarray]:
    """Returns of the regulator and of no control in the flights of the test."""
    envs = VectorEnvironment(test, **({"task": "hover", "autoreset_mode": "Disabled"} | settings))
    seeds = [10**6 + k for k in range(test)]
    none = np.zeros((test, CONTROLS))
    return returns(envs, lambda _: envs.regulated(), seeds)[0], returns(envs, lambda _: none, seeds)[0]


def draw(curve: list[Judged], regulator: float, none: float, path: str) -> None:
    """The curve as a figure that can be read on light and dark pages."""
    import matplotlib.pyplot as plt

    grey = "#808080"
    figure, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
    beats = [j.wingbeats / 1e3 for j in curve]
    axes.axhline(regulator, color="#d9822b", label="linear-quadratic regulator")
    axes.plot(beats, [j.mean for j in curve], color="#2b8cbe", label="learned, mean of the test")
    axes.plot(beats, [j.worst for j in curve], color="#2b8cbe", linestyle=":", label="learned, worst of the test")
    axes.axhline(none, color=grey, linestyle="--", label="no control")
    axes.set(xlabel="wingbeats flown to learn [thousands]", ylabel="sum of rewards", ylim=(0, None))
    axes.tick_params(colors=grey)
    for text in (axes.xaxis.label, axes.yaxis.label, *axes.legend(frameon=False, loc="center right").get_texts()):
        text.set_color(grey)
    for spine in axes.spines.values():
        spine.set_color(grey)
    figure.savefig(path, transparent=True, metadata={"Date": None})


def main(generations: int) -> None:
    """Learns, says how it goes, writes the curve."""
    regulator, none = baselines()
    print(f"regulator {regulator.mean():.2f} (worst {regulator.min():.2f}), no control {none.mean():.2f}")
    curve = []
    for judged in learn(generations):
        curve.append(judged)
        print(
            f"generation {judged.generation}: {judged.mean:.2f} (worst {judged.worst:.2f}), "
            f"{judged.wingbeats} wingbeats, {judged.core_seconds:.0f} core-seconds",
            flush=True,
        )
    with open("learn_to_hover.csv", "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow([*Judged._fields, "regulator", "none"])
        rows.writerows([*j, regulator.mean(), none.mean()] for j in curve)
    draw(curve, regulator.mean(), none.mean(), "learn_to_hover.svg")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 60)
