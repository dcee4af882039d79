"""What is done at a point, here or in a worker."""

from __future__ import annotations

import os
import pickle
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from wingbeat._flight import Flight
from wingbeat.campaign import _names
from wingbeat.campaign._points import Point
from wingbeat.errors import AnalysisError, CaseError, Error

Found = tuple[list[float] | None, str]
"""Numbers of a point and an empty text, or None and why there are none."""
Do = Callable[[Flight], Mapping[str, Any]]
Base = Flight | Callable[[Point], Flight]


@dataclass(frozen=True)
class Task:
    """What is done at each point."""

    base: Base
    do: str | Do
    keep: tuple[str, ...]
    last_beats: int | None

    def at(self, point: Point) -> Found:
        """The numbers of a point, or why there are none."""
        try:
            numbers = self._numbers(point)
            return [self._number(numbers, name) for name in self.keep], ""
        except Error as e:
            return None, _line(e)
        except (Exception, SystemExit) as e:  # of functions of the user: whatever it is, the other points are flown
            return None, f"{type(e).__name__}: {_line(e)}"

    def _numbers(self, point: Point) -> Mapping[str, Any]:
        options = {key: value for key, value in point.items() if key.startswith("trim.")} if self.do == "trim" else {}
        keys = {key: value for key, value in point.items() if key not in options}
        if isinstance(self.base, Flight):
            given = self.base._core.gives
            keys = {key: value for key, value in keys.items() if value is not None or given(key)}
            flight = self.base.set(keys) if keys else self.base
        else:
            flight = self.base(keys)
        if callable(self.do):
            return self.do(flight)
        if self.do == "trim":
            return _trimmed(flight, {key.removeprefix("trim."): value for key, value in options.items()})
        return _flown(flight, self.keep, self.last_beats)

    @staticmethod
    def _number(numbers: Mapping[str, Any], name: str) -> float:
        if not isinstance(numbers, Mapping):
            raise CaseError(
                f"do: the function gave {numbers!r:.60}, a value of type {type(numbers).__name__}",
                key="do",
                remedy="a function that returns a dict of numbers by the names in keep",
            )
        if name not in numbers:
            raise CaseError(f"keep = {name!r}: the function gave {', '.join(map(str, numbers)) or 'nothing'}", key="keep")
        number = float(numbers[name])
        if not -float("inf") < number < float("inf"):
            raise AnalysisError(f"{name} is {number}")
        return number


def _flown(flight: Flight, keep: Sequence[str], last: int | None) -> dict[str, Any]:
    run = flight.fly(frames=False)
    flown, out = len(run.summary["beats"]), run._core.starting_beats
    count, least = max(0, flown - out), last or 1
    if count < least and any(name in _names.BEATS for name in keep):
        started = f", of which the first {out} are left out: a smooth start or the hold reaches into them" if out and flown else ""
        raise AnalysisError(f"{flown} whole wingbeats were flown{started}; means need {least}{' more' if started else ''} (time.beats)")
    numbers = of_summary(run.summary)
    for name in keep:
        if name in _names.BEATS:
            values = run.beats[name]
            numbers[name] = float(values[-(last or count) :].mean())
    return numbers


def of_summary(summary: Mapping[str, Any]) -> dict[str, Any]:
    """The summary with its vectors, its verdict and its warnings as numbers of their own."""
    numbers = dict(summary)
    numbers |= zip(("forward_m", "right_m", "down_m"), summary["displacement_m"], strict=True)
    numbers |= zip(("pitch_deg", "yaw_deg", "roll_deg"), summary["turn_deg"], strict=True)
    last = summary.get("last_part") or {}  # of flights without wingbeats
    for name in ("lift_coefficient", "thrust_coefficient"):
        value = last.get(name)
        numbers[f"last_{name}"] = float("nan") if value is None else value
    wings = summary.get("elastic_wings", ())
    for name in ("tip_displacement_m", "tip_twist_deg", "strain_energy_joule"):
        numbers[name] = max((wing[name] for wing in wings), default=float("nan"))
    numbers["impulse_residual_relative"] = (summary.get("impulse_budget") or {}).get("largest_relative")
    for name in ("leading_rings", "impulse_residual_relative"):  # of air without wakes, and where it is not judged
        if numbers[name] is None:
            numbers[name] = float("nan")
    return numbers | {
        "verdict": ("green", "amber", "red").index(summary["verdict"]),
        "warnings": len(summary["warnings"]),
    }


def _trimmed(flight: Flight, options: dict[str, Any]) -> dict[str, Any]:
    trim = flight.trim(**options)
    power = trim.power()
    numbers: dict[str, Any] = {name: getattr(power, name) for name in _names.POWER}
    numbers |= {name: getattr(trim.adjustment, name) for name in _names.ADJUSTMENT}
    return numbers | {name: getattr(trim, name) for name in _names.ATTITUDE}


def _line(error: BaseException) -> str:
    return " ".join(str(error).split()) or type(error).__name__


def packed(task: Task) -> bytes:
    """The task as bytes; functions of a notebook or of the main module by value, where cloudpickle is there."""
    try:
        import cloudpickle as pickler
    except ImportError:
        pickler = pickle
    try:
        packed: bytes = pickler.dumps(task)
    except CaseError:
        raise
    except Exception as e:
        raise CaseError(
            f"do, base: the function cannot be sent to a worker: {_line(e)}",
            key="do",
            remedy="a function of a module, without open files or locks; `pip install cloudpickle` sends others, too",
        ) from e
    return packed


_unpacked: tuple[bytes, Task] | None = None


def fly_batch(
    payload: bytes, host: tuple[str, int], keys: list[str], rows: list[list[Any]], ticket: str
) -> tuple[list[Found], float]:
    """In a worker: numbers of points one after the other, and the seconds that took. ``host`` is where the campaign was
    started; ``ticket`` makes the call unlike any other, for engines that remember calls.
    """
    global _unpacked
    if (_node(), os.getpid()) != host:
        one_thread()
    if _unpacked is None or _unpacked[0] != payload:
        _unpacked = payload, pickle.loads(payload)
    task = _unpacked[1]
    start = time.perf_counter()
    found = [task.at(dict(zip(keys, row, strict=True))) for row in rows]
    return found, time.perf_counter() - start


def here() -> tuple[str, int]:
    """This machine and process."""
    return _node(), os.getpid()


def one_thread() -> None:
    """Flights of this process on one thread, if none has flown yet: the cores are those of other workers."""
    for name in ("RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")


def _node() -> str:
    import platform

    return platform.node()
