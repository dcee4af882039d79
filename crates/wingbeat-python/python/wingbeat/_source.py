"""What flights are made of."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from wingbeat import _core


def is_case_text(case: str) -> bool:
    """Whether this is the text of a case rather than a name: lines, or a key that is set where no file has that name."""
    return "\n" in case or ("=" in case and not os.path.isfile(case))


@dataclass(frozen=True, slots=True)
class Source:
    """What a flight was made of, so that another process makes the same one."""

    origin: str
    """Name of a preset, or of the text in messages."""
    text: str | None
    """The text of the case; None of a preset."""
    base: str
    """Folder that paths in the case are relative to."""
    sets: tuple[str, ...] = ()
    """Keys set on top of it, as KEY=VALUE."""

    @staticmethod
    def named(name: str) -> Source | None:
        """A case file, or a preset where there is no such file; None of the standard input, which is read once."""
        if name == "-":
            return None
        path = Path(name)
        if not path.is_file():
            return Source(name, None, "")
        return Source(name, path.read_text(encoding="utf-8"), str(path.absolute().parent))

    def core(self) -> _core.Flight:
        """The flight."""
        if self.text is None:
            return _core.Flight.find(self.origin, self.sets)
        return _core.Flight.from_text(self.origin, self.text, self.base, self.sets)
