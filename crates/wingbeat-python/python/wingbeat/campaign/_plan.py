"""What is done at the points of a campaign, checked, and how they are flown."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any

from wingbeat._flight import Flight
from wingbeat._paths import path
from wingbeat._source import is_case_text
from wingbeat.campaign import _engines, _names
from wingbeat.campaign._points import Points
from wingbeat.campaign._schedule import Schedule
from wingbeat.campaign._store import Store
from wingbeat.campaign._table import Table
from wingbeat.campaign._task import Base, Found, Task, packed
from wingbeat.errors import CaseError

Progress = Callable[[int, int], object]


@dataclass(frozen=True)
class Plan:
    """What is done at each point, and what is kept."""

    task: Task
    units: dict[str, str]
    store: Store | None
    workers: int | None
    chunk_s: float
    attempts: int

    def fly(self, points: Points, executor: Executor, bar: Progress | None) -> Table:
        """Flies what the store has not; an exception has what was flown as ``table``."""
        base = self.task.base
        table = Table(points, self.units, base.case_text if isinstance(base, Flight) else "")
        try:
            self._fill(table, points, executor, bar or (lambda done, of: None))
        except BaseException as e:
            e.table = table  # type: ignore[attr-defined]
            raise
        return table

    def _fill(self, table: Table, points: Points, executor: Executor, bar: Progress) -> None:
        store = self.store
        keys = [] if store is None else [store.key(point) for point in points]
        missing = []
        for index in range(len(points)):
            kept = None if store is None else store.get(keys[index])
            if kept is None:
                missing.append(index)
            else:
                table._put(index, kept)
        done = len(points) - len(missing)

        def found(index: int, result: Found) -> None:
            nonlocal done
            table._put(index, result)
            table.flown += 1
            done += 1
            if store is not None and not _is_death(result):
                store.put(keys[index], result)

        def told() -> None:
            if store is not None:
                store.flush()
            bar(done, len(points))

        if not missing:
            told()
            return
        count = _engines.capacity(executor, self.workers)
        schedule = Schedule(executor, count, packed(self.task), points, self.chunk_s, self.attempts, found)
        try:
            schedule.fly(missing, told)
        except BaseException:
            schedule.cancel()
            if store is not None:
                store.flush()
            raise


def plan(
    keys: Iterable[str],
    base: Any,
    do: Any,
    keep: Any,
    last_beats: Any,
    out: str | os.PathLike[str] | None,
    workers: Any,
    chunk_s: Any,
    attempts: Any,
) -> Plan:
    """What is done at points with these keys; refuses what cannot be."""
    if not callable(do) and do not in ("fly", "trim"):
        raise CaseError(f"do = {do!r}: no task", key="do", remedy="'fly', 'trim', or a function of the flight")
    units = _names.kept(keep, do)
    task = _task(base, do, tuple(units), last_beats)
    _check_keys(task, keys)
    _check_numbers(workers, chunk_s, attempts)
    return Plan(task, units, None if out is None else Store(path("out", out), task), workers, chunk_s, attempts)


def _is_death(result: Found) -> bool:
    """Deaths of workers say nothing about the point for certain: a later campaign tries it again."""
    return result[1].startswith("its worker died")


def _task(base: Any, do: Any, keep: tuple[str, ...], last_beats: int | None) -> Task:
    if last_beats is not None:
        if do != "fly":
            raise CaseError("last_beats: has no effect here", key="last_beats", remedy="leave it out, or do='fly'")
        if isinstance(last_beats, bool) or not isinstance(last_beats, int) or last_beats < 1:
            raise CaseError(f"last_beats = {last_beats!r}: no number of them", key="last_beats", remedy="a whole number >= 1")
    return Task(_based(base), do, keep, last_beats)


def _based(base: Any) -> Base:
    """The flight, or the function that makes one."""
    if isinstance(base, Flight):
        if base._source is None:
            base.__reduce__()  # says why
        return base
    if callable(base):
        made: Base = base
        return made
    if isinstance(base, str) and not is_case_text(base):
        return Flight.preset(base)
    return Flight.from_case(base)


def _check_keys(task: Task, keys: Iterable[str]) -> None:
    """Refuses keys that no case has; values are the points' own matter."""
    from wingbeat._case import check_key

    for key in keys:
        name = key.removeprefix("trim.")
        if key != name and task.do == "trim":
            if name not in _names.TRIM_OPTIONS:
                there = ", ".join(f"trim.{option}" for option in _names.TRIM_OPTIONS)
                raise CaseError(f"{key}: a trim is not asked for this", key=key, remedy=f"one of {there}")
        elif key != name and task.do == "fly" and name in _names.TRIM_OPTIONS:
            raise CaseError(f"{key}: asked of trims, and points are flown", key=key, remedy="do='trim'")
        elif isinstance(task.base, Flight):
            check_key(key)


def _check_numbers(workers: Any, chunk_s: Any, attempts: Any) -> None:
    def whole(number: Any) -> bool:
        return isinstance(number, int) and not isinstance(number, bool) and number >= 1

    for key, number in (("workers", workers), ("attempts", attempts)):
        if not (whole(number) or (key == "workers" and number is None)):
            raise CaseError(f"{key} = {number!r}: no number of them", key=key, remedy="a whole number >= 1")
    if not isinstance(chunk_s, (int, float)) or not 0 <= chunk_s < math.inf:
        raise CaseError(f"chunk_s = {chunk_s!r}: no duration", key="chunk_s", remedy="seconds >= 0, e.g. 0.5")
