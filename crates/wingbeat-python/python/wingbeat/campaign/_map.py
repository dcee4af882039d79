"""One thing done at many points."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor
from typing import Any

from wingbeat._flight import Flight
from wingbeat.campaign import _engines, _names, _points
from wingbeat.campaign._points import Points
from wingbeat.campaign._schedule import Schedule
from wingbeat.campaign._store import Store
from wingbeat.campaign._table import Table
from wingbeat.campaign._task import Base, Do, Found, Task, packed
from wingbeat.errors import CaseError

Progress = Callable[[int, int], object]


def map(
    points: Any,
    executor: Executor | None = None,
    *,
    base: Flight | Mapping[str, Any] | str | os.PathLike[str] | Callable[[dict[str, Any]], Flight],
    do: str | Do = "fly",
    keep: Iterable[str] | Mapping[str, str] = ("lift_over_weight", "power_watt"),
    last_beats: int | None = None,
    out: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    chunk_s: float = 0.5,
    attempts: int = 3,
    progress: bool | Progress | None = None,
) -> Table:
    """Does the same at many points, and returns a :class:`Table` of the numbers in the order of the points.

    ``points`` are columns by key of the case (a dict of arrays, a table), or dicts one after the other; each point is set
    on top of ``base``: a flight, a case, the name of a preset, or a function that makes a flight of a point. ``do`` is
    ``"fly"``; ``"trim"``, where points may also have ``trim.forward_m_per_s`` and the like; or a function of the flight that
    returns numbers by name. ``keep`` are the names of numbers to be kept, of a function also with their units: of flights
    means over all whole wingbeats, or the ``last_beats`` of them, and numbers of the summary.

    ``executor`` is any of the interface of ``concurrent.futures``, or a client of Dask; processes of this machine if left
    out. ``workers`` is how many of them there are, if it is not to be found out. Points go to workers in batches of
    ``chunk_s`` seconds of work. A point that cannot be flown has NaN and its reason; one whose worker dies is flown again,
    in the end ``attempts`` times with nothing beside it, before it counts as failed.

    ``out`` is a folder in which points are kept; those that it has already are not flown again. ``progress`` is called
    with the points done and all points; True shows a bar. Whatever exception ends it, Ctrl-C too, has what was flown
    as ``error.table``.
    """
    read = _points.read(points)
    task, units = check(list(read.columns), base, do, keep, last_beats, workers, chunk_s, attempts)
    store = None if out is None else Store(out, task)
    case_text = task.base.case_text if isinstance(task.base, Flight) else ""
    table = Table(read, units, case_text)
    bar = _bar() if progress is True else progress or (lambda done, of: None)
    used, is_made_here = _engines.engine(executor, workers)
    try:
        _fly(table, read, task, store, used, _Settings(workers, chunk_s, attempts), bar)
    except BaseException as e:
        e.table = table  # type: ignore[attr-defined]
        if is_made_here and isinstance(used, _engines.Processes):
            used.stop()
        raise
    if is_made_here:
        used.shutdown()
    return table


class _Settings:
    def __init__(self, workers: int | None, chunk_s: float, attempts: int) -> None:
        self.workers, self.chunk_s, self.attempts = workers, chunk_s, attempts


def _fly(
    table: Table, points: Points, task: Task, store: Store | None, executor: Executor, settings: _Settings, bar: Progress
) -> None:
    """Flies what the store has not, and fills the table."""
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
    count = _engines.capacity(executor, settings.workers)
    schedule = Schedule(executor, count, packed(task), points, settings.chunk_s, settings.attempts, found)
    try:
        schedule.fly(missing, told)
    except BaseException:
        schedule.cancel()
        if store is not None:
            store.flush()
        raise


def check(
    keys: Iterable[str],
    base: Any,
    do: Any,
    keep: Any,
    last_beats: Any,
    workers: Any,
    chunk_s: Any,
    attempts: Any,
) -> tuple[Task, dict[str, str]]:
    """What is done at points with these keys, and the units of what is kept; refuses what cannot be."""
    units = _names.kept(keep, do)
    task = _task(base, do, tuple(units), last_beats)
    _check_keys(task, keys)
    _check_numbers(workers, chunk_s, attempts)
    return task, units


def _is_death(result: Found) -> bool:
    """Deaths of workers say nothing about the point for certain: a later campaign tries it again."""
    return result[1].startswith("its worker died")


def _task(base: Any, do: Any, keep: tuple[str, ...], last_beats: int | None) -> Task:
    if not callable(do) and do not in ("fly", "trim"):
        raise CaseError(f"do = {do!r}: no task", key="do", remedy="'fly', 'trim', or a function of the flight")
    if last_beats is not None:
        if do != "fly":
            raise CaseError("last_beats: has no effect here", key="last_beats", remedy="leave it out, or do='fly'")
        if isinstance(last_beats, bool) or not isinstance(last_beats, int) or last_beats < 1:
            raise CaseError(f"last_beats = {last_beats!r}: no number of them", key="last_beats", remedy="a whole number >= 1")
    return Task(based(base), do, keep, last_beats)


def based(base: Any) -> Base:
    """The flight, or the function that makes one."""
    if isinstance(base, Flight):
        if base._source is None:
            base.__reduce__()  # says why
        return base
    if callable(base):
        made: Base = base
        return made
    if isinstance(base, str) and "\n" not in base and "=" not in base:
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


def _bar() -> Progress:
    from wingbeat import _flight

    return _flight._bar("campaign", "point")
