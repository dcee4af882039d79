"""Which points go to workers together, and what becomes of points whose worker dies."""

from __future__ import annotations

import math
import pickle
import uuid
from collections import deque
from collections.abc import Callable, Iterable
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from dataclasses import dataclass, field
from typing import Any

from wingbeat.campaign import _task
from wingbeat.campaign._points import Points
from wingbeat.campaign._task import Found
from wingbeat.errors import FlightError

_GROWTH = 4
"""How many times as large as the last a batch may be: first points may be quicker than others."""
_SMALLER = 8
"""How many times smaller batches of points are that were lost once."""
_AHEAD = 2
"""Batches handed out for each worker: one it flies, one that waits for it."""
_HOPELESS = 20
"""Batches lost one after the other, beyond the attempts of a point, after which the engine itself is taken to be dead."""
_PERIOD_S = 0.5
"""How long to wait before signals are looked for where waiting cannot be interrupted."""
_UNFIT = (ImportError, AttributeError, TypeError, pickle.PicklingError, pickle.UnpicklingError)
"""What workers raise that cannot run this at all."""


@dataclass
class Batch:
    """Points that were handed out together."""

    points: list[int]
    is_alone: bool = False
    """Whether nothing else was handed out meanwhile."""


@dataclass
class Schedule:
    """Points over an executor, in batches that take ``chunk_s`` seconds each.

    When a worker dies, it is not known which point killed it, and pools of processes take all of their batches with them. So
    points of a batch that was lost are flown again in smaller batches, and after a second loss one by one with nothing beside
    them: a worker that dies then dies of this point. After ``attempts`` such deaths the point has failed.
    """

    executor: Executor
    workers: int
    payload: bytes
    points: Points
    chunk_s: float
    attempts: int
    found: Callable[[int, Found], None]
    """Told the numbers of each point."""
    cost_s: float | None = None
    """Seconds a point takes."""
    _size: int = 1
    _lost_in_a_row: int = 0
    _fresh: deque[int] = field(default_factory=deque)
    _again: deque[int] = field(default_factory=deque)
    _alone: deque[int] = field(default_factory=deque)
    _losses: dict[int, int] = field(default_factory=dict)
    _deaths: dict[int, int] = field(default_factory=dict)
    _flying: dict[Future[Any], Batch] = field(default_factory=dict)

    def fly(self, points: Iterable[int], told: Callable[[], None]) -> None:
        """Flies these points; ``told`` is called between."""
        self._fresh.extend(points)
        self._fill()
        while self._flying:
            done, _ = wait(self._flying, timeout=_PERIOD_S, return_when=FIRST_COMPLETED)
            for future in done:
                self._collect(future, self._flying.pop(future))
            told()
            self._fill()

    def cancel(self) -> None:
        """Takes back what has not begun."""
        for future in self._flying:
            future.cancel()

    def _fill(self) -> None:
        while batch := self._next():
            keys = list(self.points.columns)
            rows = [list(self.points[k].values()) for k in batch.points]
            arguments = (self.payload, _task.here(), keys, rows, uuid.uuid4().hex)
            self._flying[self._submitted(arguments)] = batch

    def _next(self) -> Batch | None:
        """What to hand out now, if anything."""
        if len(self._flying) >= _AHEAD * self.workers:
            return None
        if self._fresh:
            return Batch(_taken(self._fresh, self._batch_size(self._fresh, self.chunk_s)))
        if self._again:
            return Batch(_taken(self._again, self._batch_size(self._again, self.chunk_s / _SMALLER)))
        if self._alone and not self._flying:
            return Batch(_taken(self._alone, 1), is_alone=True)
        return None

    def _batch_size(self, queue: deque[int], seconds: float) -> int:
        """As many points as take so long; towards the end fewer, so that all workers end together."""
        if self.cost_s is None:
            return 1
        wanted = math.ceil(seconds / max(self.cost_s, 1e-9))
        left = math.ceil(len(queue) / (_AHEAD * self.workers))
        return max(1, min(wanted, _GROWTH * self._size, left))

    def _submitted(self, arguments: tuple[Any, ...]) -> Future[Any]:
        try:
            return self.executor.submit(_task.fly_batch, *arguments)
        except BrokenExecutor as e:
            raise FlightError(
                f"the executor is broken: {e}",
                key="executor",
                remedy="executor=None, or wingbeat.campaign.Processes(), which start processes again when one dies",
            ) from e

    def _collect(self, future: Future[Any], batch: Batch) -> None:
        try:
            results, seconds = future.result()
        except _UNFIT as e:
            raise FlightError(
                f"the workers cannot run this: {type(e).__name__}: {e}",
                key="executor",
                remedy="the same wingbeat and the module of your functions must be installed where the workers are; "
                "cloudpickle sends functions by value",
            ) from e
        except Exception as e:  # each engine has exceptions of its own for workers that died
            self._lost(batch, e)
            return
        self._lost_in_a_row = 0
        for index, result in zip(batch.points, results, strict=True):
            self.found(index, result)
        cost = seconds / len(batch.points)
        self.cost_s = cost if self.cost_s is None else 0.5 * (self.cost_s + cost)
        self._size = max(self._size, len(batch.points))

    def _lost(self, batch: Batch, error: Exception) -> None:
        self._lost_in_a_row += 1
        if self._lost_in_a_row >= _HOPELESS + self.attempts:
            raise FlightError(
                f"{self._lost_in_a_row} batches were lost one after the other, the last with {type(error).__name__}: {error}",
                key="executor",
                remedy="look whether the engine still runs and its workers have memory; `out` keeps what was flown",
            ) from error
        for index in batch.points:
            losses = self._losses[index] = self._losses.get(index, 0) + 1
            if batch.is_alone:
                self._died(index, error)
            elif losses == 1 and len(batch.points) > 1:
                self._again.append(index)
            else:
                self._alone.append(index)

    def _died(self, index: int, error: Exception) -> None:
        deaths = self._deaths[index] = self._deaths.get(index, 0) + 1
        if deaths < self.attempts:
            self._alone.append(index)
        else:
            times = "once" if deaths == 1 else f"{deaths} times"
            self.found(index, (None, f"its worker died, {times} with nothing beside it: {type(error).__name__}"))


def _taken(queue: deque[int], count: int) -> list[int]:
    return [queue.popleft() for _ in range(min(count, len(queue)))]
