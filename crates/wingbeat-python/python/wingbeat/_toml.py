"""Values of Python as TOML."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterable, Mapping
from typing import Any

from wingbeat.errors import CaseError

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def value(x: Any, key: str) -> str:
    """``x``, which ``key`` gets, as TOML: numbers, texts, paths, truth values, lists, arrays and dicts of them."""
    if isinstance(x, os.PathLike):
        x = os.fspath(x)
    if hasattr(x, "tolist"):  # numpy
        x = x.tolist()
    if isinstance(x, bool):
        return "true" if x else "false"
    if isinstance(x, int):
        return str(x)
    if isinstance(x, float):
        return repr(x)
    if isinstance(x, str):
        return _quoted(x)
    if isinstance(x, Mapping):
        items = (f"{_name(name, key)} = {value(item, f'{key}.{name}')}" for name, item in x.items())
        return "{" + ", ".join(items) + "}"
    if isinstance(x, Iterable) and not isinstance(x, bytes):
        return "[" + ", ".join(value(item, f"{key}[{k}]") for k, item in enumerate(x)) + "]"
    raise CaseError(
        f"{key}: a {type(x).__name__} is no value of a case",
        key=key,
        remedy="numbers, texts, truth values, lists, arrays and dicts of them; leave keys without a value out",
    )


def document(case: Mapping[str, Any]) -> str:
    """A case as TOML, a line for each key of the outermost table."""
    return "".join(f"{_name(name, '')} = {value(item, str(name))}\n" for name, item in case.items())


def _name(name: object, key: str) -> str:
    if not isinstance(name, str):
        key = key or "case"
        raise CaseError(
            f"{key}: the key {name!r} is no text", key=key, remedy="texts as keys, e.g. 'frequency_hz'"
        )
    return name if _BARE.fullmatch(name) else _quoted(name)


def _quoted(text: str) -> str:
    """A basic string: TOML takes no surrogate pairs, which JSON has for characters beyond U+FFFF, and no bare U+007F."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
