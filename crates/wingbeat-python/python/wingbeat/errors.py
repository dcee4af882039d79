"""Exceptions. Each says which key it is about, where, and what to try."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wingbeat._run import Run


class Error(Exception):
    """Why a case cannot be flown, a flight cannot go on, or a result cannot be read.

    ``key`` is the key of the case, or the file, that it is about (empty where there is none), ``line`` its
    line in the text of the case, counted from 1, ``remedy`` what to try. ``run`` is what was flown until then,
    where anything was.
    """

    key: str
    line: int | None
    remedy: str
    run: Run | None

    def __init__(self, message: str, *, key: str = "", line: int | None = None, remedy: str = "") -> None:
        super().__init__(message)
        self.key = key
        self.line = line
        self.remedy = remedy
        self.run = None

    def __str__(self) -> str:
        """The message, and the remedy where the message does not say it."""
        message = super().__str__()
        return message if self.remedy in message else f"{message}; try: {self.remedy}"


class CaseError(Error, ValueError):
    """A case, or a value given to a function, that is refused."""


class FlightError(Error, RuntimeError):
    """A flight that cannot go on."""


class AnalysisError(Error, RuntimeError):
    """An analysis that cannot be made."""


class PackageError(Error, ImportError):
    """A package of others that this needs and that is not installed."""


class ResultError(Error, OSError):
    """A file or result directory that cannot be read or written."""
