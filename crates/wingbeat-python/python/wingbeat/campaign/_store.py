"""A folder in which points that were flown are kept, so that the same campaign flies only what is missing."""

from __future__ import annotations

import hashlib
import json
import os
import uuid
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from wingbeat import _core, _toml
from wingbeat._flight import Flight
from wingbeat.campaign._identity import of_part
from wingbeat.campaign._names import BEATS
from wingbeat.campaign._points import Point
from wingbeat.campaign._task import Found, Task
from wingbeat.errors import CaseError, ResultError

_FORMAT = 1
_FEATHERING = "feathering by thin-airfoil theory"
"""Of blade elements; it was of the leading edge, without a moment."""
_MOST = 1000
"""Points in a file at most."""


class Store:
    """Points by the hash of everything their numbers follow from.

    Each file holds lines of points, and is renamed when it is whole: whoever reads sees all of it or nothing, and several
    campaigns can write into one folder. A line that a power cut has damaged is left out, and its point is flown again.
    """

    def __init__(self, folder: str | os.PathLike[str], task: Task) -> None:
        self._folder = Path(folder) / "points"
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
        except OSError as e:
            raise _unwritten(self._folder, e) from e
        self._task = _digest(task)
        self._base = task.base._core if isinstance(task.base, Flight) else None
        self._files: dict[str, str] = {}
        self._lines: list[str] = []
        self._known: dict[str, Found] = dict(self._read())

    def key(self, point: Point) -> str:
        """The hash of a point: of its values, and of what is in files that they name."""
        text = self._task + json.dumps(point, sort_keys=True)
        if "blade_element" in point.values():
            text += _FEATHERING
        text += "".join(self._content(key, point[key]) for key in sorted(point))
        return hashlib.sha256(text.encode()).hexdigest()[:32]

    def _content(self, key: str, value: Any) -> str:
        """The hash of what is in files that a value names; an empty text where it names none."""
        try:
            line = f"{key}={_toml.value(value, key)}"
        except CaseError:  # a key that is taken out, or what a function of the user makes something of
            return ""
        content = self._files.get(line) or _core.hash_of_files(line, self._base)
        if content:
            self._files[line] = content
        return content

    def get(self, key: str) -> Found | None:
        """What is kept of a point."""
        return self._known.get(key)

    def put(self, key: str, found: Found) -> None:
        """Keeps a point; it is on the disk after :meth:`flush`."""
        values, reason = self._known[key] = found
        line = json.dumps([key, values, reason])
        self._lines.append(f"{zlib.crc32(line.encode()):08x} {line}\n")
        if len(self._lines) >= _MOST:
            self.flush()

    def flush(self) -> None:
        """Writes what is not written yet."""
        if not self._lines:
            return
        path = self._folder / f"{uuid.uuid4().hex}.jsonl"
        temporary = path.with_suffix(".part")
        try:
            temporary.write_text("".join(self._lines))
            os.replace(temporary, path)
        except OSError as e:
            temporary.unlink(missing_ok=True)
            raise _unwritten(path, e) from e
        self._lines = []

    def _read(self) -> Iterator[tuple[str, Found]]:
        for path in sorted(self._folder.glob("*.jsonl")):
            try:
                lines = path.read_text(errors="replace").splitlines()
            except OSError as e:
                raise ResultError(
                    f"{path}: cannot be read: {e.strerror or e}",
                    key=str(path),
                    remedy="remove it, if it is not a file of points, or make it readable",
                ) from e
            for line in lines:
                checksum, _, text = line.partition(" ")
                if checksum == f"{zlib.crc32(text.encode()):08x}":
                    key, values, reason = json.loads(text)
                    yield key, (values, reason)


def _digest(task: Task) -> str:
    """Everything that all points share: version, case, programs that it asks, what is done, what is kept."""
    base, do = of_part(task.base, "base"), of_part(task.do, "do")
    parts = [_FORMAT, _core.version(), base, do, task.keep, task.last_beats]
    if task.do == "fly" and any(name in BEATS for name in task.keep):
        parts.append("means without smooth starts and holds")  # they were of the last wingbeats, whatever these were
    if "blade_element" in json.dumps([base, do]):
        parts.append(_FEATHERING)
    if isinstance(task.base, Flight):
        parts.append(task.base._core.hash_of_programs())
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()


def _unwritten(path: Path, error: OSError) -> ResultError:
    return ResultError(
        f"{path}: cannot be written: {error.strerror or error}",
        key=str(path),
        remedy="a folder that can be written on a disk with room; what is there already is kept",
    )
