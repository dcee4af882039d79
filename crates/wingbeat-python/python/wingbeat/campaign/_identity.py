"""What the numbers of points follow from besides their values: flights, functions and what functions carry with them."""

from __future__ import annotations

import hashlib
import inspect
from enum import Enum
from pathlib import PurePath
from types import BuiltinFunctionType, FunctionType, MethodType, ModuleType
from typing import Any

from wingbeat._flight import Flight
from wingbeat.campaign._task import packed
from wingbeat.errors import CaseError

_NEW = object().__reduce_ex__(2)[0]
"""What makes objects that are nothing but their class and their attributes, for pickle."""
_PLAIN = (type(None), bool, int, float, complex, str, bytes)


def of_part(part: Any, name: str) -> Any:
    """The identity of ``base`` or ``do`` as JSON has it: a flight by its case, a text, a function by its source and what it
    carries: variables of the functions around it, default arguments, the object of a method.
    """
    if isinstance(part, Flight):
        return _of_flight(part)
    if isinstance(part, str):
        return part
    try:
        found: list[Any] = _of_source(part)
    except (OSError, TypeError, AttributeError):
        return packed(part).hex()
    carried = _carried(part, name, ())
    return [*found, carried] if carried else found


def _of_flight(flight: Flight) -> Any:
    source = flight._source
    return [flight.case_text, source and [source.text, source.origin, source.sets]]


def _of_source(part: Any) -> list[Any]:
    return [part.__module__, part.__qualname__, inspect.getsource(part)]


def _carried(part: Any, name: str, within: tuple[int, ...]) -> dict[str, Any]:
    """What a function carries, by name."""
    found = {}
    if isinstance(part, MethodType):
        found["self"] = _of_value(part.__self__, f"{name}.__self__", within)
        part = part.__func__
    if not isinstance(part, FunctionType):
        return found
    for variable, cell in zip(part.__code__.co_freevars, part.__closure__ or (), strict=True):
        try:
            value = cell.cell_contents
        except ValueError:  # not assigned yet
            continue
        found[variable] = _of_value(value, variable, within)
    arguments = inspect.signature(part, follow_wrapped=False).parameters.values()
    for argument in arguments:
        if argument.default is not argument.empty:
            found[f"{argument.name}="] = _of_value(argument.default, argument.name, within)
    return found


def _of_value(value: Any, name: str, within: tuple[int, ...]) -> Any:
    """The identity of a value that a function carries; refuses one that has none that holds in another process."""
    kind = type(value).__name__
    if type(value) in _PLAIN:
        return [kind, repr(value)]
    if id(value) in within:
        return ["around", within.index(id(value))]
    within = (*within, id(value))
    if isinstance(value, Flight) and value._source is not None:
        return ["Flight", _of_flight(value)]
    if isinstance(value, Enum):
        return [_of_value(type(value), name, within), value.name]
    if isinstance(value, PurePath):
        return ["path", str(value)]
    if isinstance(value, (ModuleType, BuiltinFunctionType)):
        return [kind, getattr(value, "__module__", None), value.__name__]
    if type(value) in (tuple, list):
        return [kind, [_of_value(item, name, within) for item in value]]
    if type(value) in (set, frozenset):
        return [kind, sorted(repr(_of_value(item, name, within)) for item in value)]
    if type(value) is dict:
        return [kind, [[_of_value(item, name, within) for item in pair] for pair in value.items()]]
    if isinstance(value, (FunctionType, MethodType, type)):
        return _of_code(value, name, within)
    return _of_array(value) or _of_object(value, name, within)


def _of_code(value: Any, name: str, within: tuple[int, ...]) -> Any:
    """A function or a class by its source; one of the library or of an extension by its name."""
    try:
        found = _of_source(value)
    except (OSError, TypeError):
        if isinstance(value, FunctionType):
            raise _unknown(value, name) from None
        return [value.__module__, value.__qualname__]
    return [*found, _carried(value, name, within)]


def _of_array(value: Any) -> Any:
    """An array or a number of numpy by its bytes."""
    import numpy as np

    if type(value) is np.ndarray or isinstance(value, np.generic):
        array = np.ascontiguousarray(value)
        if not array.dtype.hasobject:
            return [array.dtype.str, np.shape(value), hashlib.sha256(array.tobytes()).hexdigest()]
    return None


def _of_object(value: Any, name: str, within: tuple[int, ...]) -> Any:
    """An object that is nothing but its class and its attributes."""
    try:
        made = tuple(value.__reduce_ex__(2))
    except Exception:  # whatever a class may do there
        raise _unknown(value, name) from None
    make, arguments, state, *others = (*made, None, None, None)
    plain = make is _NEW and arguments == (type(value),) and all(other is None for other in others)
    if not plain or not isinstance(state, (dict, tuple, type(None))):
        raise _unknown(value, name)
    return ["object", _of_value(type(value), name, within), _of_value(state, name, within)]


def _unknown(value: Any, name: str) -> CaseError:
    return CaseError(
        f"out: the function carries `{name}`, a {type(value).__name__}: whether it is the same another time cannot be told",
        key="out",
        remedy="make it of numbers, texts, lists, arrays or flights, or make it in the function; or leave out= out",
    )
