"""Flyers of environments: the flights that are given, each trimmed once."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from wingbeat._flight import Flight
from wingbeat.errors import CaseError, Error

if TYPE_CHECKING:
    from wingbeat import _core


def check_one(flight: Any) -> None:
    """Refuses several flights where one is flown."""
    if isinstance(flight, list | tuple):
        raise CaseError(
            f"flight: {len(flight)} of them, and this environment flies one",
            key="flight",
            remedy="one Flight, or VectorEnvironment, whose environments fly them in turn",
        )


class Flyers:
    """One flight, or several, with what messages call them."""

    def __init__(self, given: Any) -> None:
        self._is_one = not isinstance(given, list | tuple)
        flights = [Flight.preset("fruit-fly-blade") if given is None else given] if self._is_one else list(given)
        self.names = ["flight"] if self._is_one else [f"flight[{k}]" for k in range(len(flights))]
        if not flights:
            raise CaseError("flight: a sequence without any", key="flight", remedy="one Flight at least")
        for name, flight in zip(self.names, flights, strict=True):
            if not isinstance(flight, Flight):
                remedy = "Flight.preset(NAME) or Flight.from_case(FILE); several as a list or tuple, in VectorEnvironment"
                raise CaseError(f"{name} = {flight!r:.60}: no Flight", key="flight", remedy=remedy)
        if not self._is_one:
            self.names = [f"{name} ({flight.name:.60})" for name, flight in zip(self.names, flights, strict=True)]
        for name, flight in zip(self.names, flights, strict=True):
            _check_plain(name, flight)
        self._flights = flights

    @property
    def case_texts(self) -> str | tuple[str, ...]:
        """The text of the case of one flight, those of several."""
        texts = tuple(flight.case_text for flight in self._flights)
        return texts[0] if len(texts) == 1 else texts

    def courses(self, steps: int, settings: dict[str, Any]) -> list[_core.Course]:
        """What the episodes of each share. A flight is trimmed once: by threads, but those that call Python one by
        one.
        """
        firsts = dict(zip(reversed(self._flights), reversed(self.names), strict=True))

        def course(flight: Flight) -> _core.Course:
            with self._told_of(firsts[flight]):
                trim = flight.trim(steps=steps)
                trim._check()
                return trim._core.course(settings)

        each = list(dict.fromkeys(self._flights))
        if len(each) == 1 or any(flight._core.is_own for flight in each):
            made = [course(flight) for flight in each]
        else:
            with ThreadPoolExecutor(min(len(each), os.cpu_count() or 1)) as threads:
                made = list(threads.map(course, each))
        found = dict(zip(each, made, strict=True))
        return [found[flight] for flight in self._flights]

    @contextmanager
    def _told_of(self, name: str) -> Iterator[None]:
        """Errors within say of which of several flights they are."""
        try:
            yield
        except Error as error:
            if not self._is_one:
                error.args = (f"{name}: {error.args[0]}",)
            raise


def _check_plain(name: str, flight: Flight) -> None:
    """Refuses what episodes about the trimmed flight would drop."""
    if flight._core.is_steered:
        raise CaseError(
            f"{name}: it has a controller, and actions are the only commands here",
            key="control.controller",
            remedy='a flight without one: set("control.controller", "none"), or leave out with_controller',
        )
    if flight._core.is_tethered:
        raise CaseError(
            f"{name}: it is tethered, and episodes are free flights",
            key="flight.mode",
            remedy='set("flight.mode", "free")',
        )
    if flight._core.held_beats > 0.0:
        raise CaseError(
            f"{name}: its body is held at first, and episodes begin in free flight",
            key="flight.held_beats",
            remedy='set("flight.held_beats", None)',
        )
