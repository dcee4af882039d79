"""Paths that are given."""

from __future__ import annotations

import os
from typing import Any

from wingbeat.errors import CaseError


def path(key: str, given: Any) -> str:
    """A path as a text: a str, or what stands for one, as ``pathlib.Path`` does; bytes are none."""
    plain = os.fspath(given) if isinstance(given, str | os.PathLike) else None
    if not isinstance(plain, str):
        raise CaseError(f"{key} = {given!r:.60}: no path", key=key, remedy="a text or a pathlib.Path")
    return plain
