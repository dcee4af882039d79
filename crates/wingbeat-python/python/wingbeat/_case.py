"""Cases as parts with attributes: the names, units and meanings of keys are those of the program's own table."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from functools import cache
from typing import Any

from wingbeat import _core
from wingbeat.errors import CaseError

_Shapes = tuple[dict[str, Any], ...]


class NoKeyError(CaseError, AttributeError):
    """A case has no such key there."""


class Part(dict[str, Any]):
    """A part of a case: a dict whose keys are attributes too, ``case.motion.frequency_hz = 210``.

    A key that no case has there is refused when it is set as an attribute; values are checked when a flight is made of the
    case. :meth:`describe` says what a key is, ``dir(part)`` and completion in a notebook which there are.
    """

    _shapes: _Shapes
    _path: str

    def __init__(self, items: Mapping[str, Any] | None = None, shapes: _Shapes | None = None, path: str = "") -> None:
        self._shapes = _whole() if shapes is None else shapes
        self._path = path
        super().__init__({name: self._part(name, value) for name, value in (items or {}).items()})

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_"):
            if name in self:
                return self[name]
            raise self._unknown(name)
        raise AttributeError(name)

    def __setattr__(self, name: str, value: Any) -> None:
        if name.startswith("_"):
            object.__setattr__(self, name, value)
        elif _inner(self._shapes, name) or name in self:
            self[name] = self._part(name, value)
        else:
            raise self._unknown(name)

    def __delattr__(self, name: str) -> None:
        if self.pop(name, self) is self:
            raise self._unknown(name)

    def __dir__(self) -> Iterable[str]:
        return sorted({*super().__dir__(), *self, *_names(self._shapes)})

    def describe(self, name: str = "") -> str:
        """What the key ``name`` is, or this part: its default, what is allowed, when to change it."""
        shapes = _inner(self._shapes, name) if name else self._shapes
        if not shapes:
            raise self._unknown(name)
        lines = [text for shape in shapes if (text := shape.get("description"))][:1]
        limits = ("default", "minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum", "enum")
        lines += [f"{limit}: {shape[limit]}" for shape in shapes for limit in limits if limit in shape]
        names = _names(shapes)
        return "\n".join([*lines, *(["keys: " + ", ".join(names)] if names else [])])

    def _part(self, name: str, value: Any) -> Any:
        return _made(value, _inner(self._shapes, name), f"{self._path}.{name}".lstrip("."))

    def _unknown(self, name: str) -> NoKeyError:
        key = f"{self._path}.{name}".lstrip(".")
        names = _names(self._shapes)
        if name in names:
            return NoKeyError(f"{key} is not given here", key=key, remedy="set it; describe() says what it is")
        from difflib import get_close_matches

        near = get_close_matches(name, names, 1)
        remedy = f"did you mean {near[0]}? " if near else ""
        return NoKeyError(f"{key}: no case has this key", key=key, remedy=f"{remedy}There are {', '.join(names)}")


def check_key(key: str) -> None:
    """Refuses a key that no case has, ``motion.frequenzy_hz``, with one that was meant."""
    part = Part()
    for name in key.split("."):
        shapes = _inner(part._shapes, name)
        if not shapes:
            error = part._unknown(name)
            raise CaseError(error.args[0], key=error.key, remedy=error.remedy)
        part = Part({}, shapes, f"{part._path}.{name}".lstrip("."))


def _made(value: Any, shapes: _Shapes, path: str) -> Any:
    if isinstance(value, Mapping):
        return Part(value, shapes, path)
    if isinstance(value, list):
        items = tuple(x for shape in shapes if "items" in shape for x in _flat(shape["items"]))
        return [_made(item, items, f"{path}[{k}]") for k, item in enumerate(value)]
    return value


@cache
def _schema() -> dict[str, Any]:
    schema: dict[str, Any] = json.loads(_core.schema())
    return schema


@cache
def _whole() -> _Shapes:
    return tuple(_flat(_schema()))


def _flat(shape: Any) -> list[dict[str, Any]]:
    """The shape, what it refers to, and its choices."""
    if not isinstance(shape, dict):
        return []
    found = [shape]
    if "$ref" in shape:
        found += _flat(_schema()["$defs"][shape["$ref"].rsplit("/", 1)[1]])
    for choices in ("anyOf", "oneOf", "allOf"):
        for choice in shape.get(choices, ()):
            found += _flat(choice)
    return found


def _inner(shapes: _Shapes, name: str) -> _Shapes:
    """What may stand at the key ``name``."""
    known = [shape["properties"][name] for shape in shapes if name in shape.get("properties", {})]
    free = [shape["additionalProperties"] for shape in shapes if "additionalProperties" in shape]
    return tuple(x for shape in known or free for x in _flat(shape))


def _names(shapes: _Shapes) -> list[str]:
    return sorted({name for shape in shapes for name in shape.get("properties", {})})
