"""One thing done at many points."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor
from typing import Any

from wingbeat._flight import Flight, shown
from wingbeat.campaign import _engines, _plan, _points
from wingbeat.campaign._plan import Progress
from wingbeat.campaign._table import Table
from wingbeat.campaign._task import Do


def map(
    points: Any,
    executor: Executor | None = None,
    *,
    base: Flight | Mapping[str, Any] | str | os.PathLike[str] | Callable[[dict[str, Any]], Flight],
    do: str | Do = "fly",
    keep: Iterable[str] | Mapping[str, str] | None = None,
    last_beats: int | None = None,
    out: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    chunk_s: float = 0.5,
    attempts: int = 3,
    progress: bool | Progress | None = None,
) -> Table:
    """Does the same at many points, and returns a :class:`Table` of the numbers in the order of the points.

    ``points`` are columns by key of the case (a dict of arrays, a table), or dicts one after the other; each point is set
    on top of ``base``, and None in the place of a value takes the key out of the case, where another is given instead, say.
    ``base`` is a flight, a case, the name of a preset, or a function that makes a flight of a point. ``do`` is
    ``"fly"``; ``"trim"``, where points may also have ``trim.forward_m_per_s`` and the like; or a function of the flight that
    returns numbers by name. ``keep`` are the names of numbers to be kept, of a function also with their units: of flights
    means over all whole wingbeats but those that a smooth start or a hold reach into, or over the ``last_beats`` of them, and numbers
    of the summary; left out: lift over weight and power of flights, power and body angles of trims.

    ``executor`` is any of the interface of ``concurrent.futures``, or a client of Dask; processes of this machine if left
    out. ``workers`` is how many of them there are, if it is not to be found out. Points go to workers in batches of
    ``chunk_s`` seconds of work. A point that cannot be flown has NaN and its reason; one whose worker dies is flown again,
    in the end ``attempts`` times with nothing beside it, before it counts as failed.

    ``out`` is a folder in which points are kept; those that it has already are not flown again. ``progress`` is called
    with the points done and all points; True shows a bar. Whatever exception ends it, Ctrl-C too, has what was flown
    as ``error.table``.
    """
    read = _points.read(points)
    plan = _plan.plan(read.columns, base, do, keep, last_beats, out, workers, chunk_s, attempts)
    bar = shown(progress, "campaign", "point")
    used, is_made_here = _engines.engine(executor, workers)
    try:
        table = plan.fly(read, used, bar)
    except BaseException:
        if is_made_here and isinstance(used, _engines.Processes):
            used.stop()
        raise
    if is_made_here:
        used.shutdown()
    return table
