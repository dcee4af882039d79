"""Points: what is flown at each."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from wingbeat.errors import CaseError

if TYPE_CHECKING:
    from numpy.typing import NDArray

Point = dict[str, Any]
"""Values by key."""


class Points:
    """Points as columns: an array over the points for each key."""

    def __init__(self, columns: Mapping[str, NDArray[Any]], count: int) -> None:
        self.columns = dict(columns)
        self.count = count

    def __len__(self) -> int:
        return self.count

    def __getitem__(self, index: int) -> Point:
        return {key: _plain(column[index]) for key, column in self.columns.items()}

    def __iter__(self) -> Iterator[Point]:
        return (self[k] for k in range(self.count))


def read(points: Any) -> Points:
    """Columns by key (a dict, a table of pandas or xarray; single values hold for all points), or dicts one after the
    other.
    """
    if hasattr(points, "keys") and hasattr(points, "__getitem__"):
        return _of_columns({key: points[key] for key in points.keys()})
    if isinstance(points, (str, bytes)) or not isinstance(points, Iterable):
        raise _wrong(f"a {type(points).__name__} has no points")
    rows = list(points)
    for k, row in enumerate(rows):
        if not isinstance(row, Mapping):
            raise _wrong(f"point {k} is a {type(row).__name__}")
        if row.keys() != rows[0].keys():
            raise _wrong(f"point {k} has the keys {', '.join(map(str, row))}, point 0 {', '.join(map(str, rows[0]))}")
    if not rows:
        raise _wrong("there are none")
    return _of_columns({key: [row[key] for row in rows] for key in rows[0]})


def grid(axes: Mapping[str, Iterable[Any]]) -> dict[str, NDArray[Any]]:
    """All combinations of the values of each key, the last key quickest, as columns for :func:`wingbeat.campaign.map`."""
    import numpy as np

    if not isinstance(axes, Mapping) or not axes:
        raise CaseError("grid: no key is given", key="grid", remedy="a dict of keys and their values")
    values = []
    for key, axis in axes.items():
        try:
            values.append(np.asarray(None) if isinstance(axis, str) else _column(list(axis)))
        except (TypeError, ValueError):  # one value alone, lists of several lengths
            values.append(np.asarray(None))
        if values[-1].ndim != 1 or values[-1].size == 0:
            raise CaseError(f"grid: {key} has no list of values", key=str(key), remedy="a list of numbers or texts, one at least")
    return {key: axis.ravel() for key, axis in zip(axes, np.meshgrid(*values, indexing="ij"), strict=True)}


def _of_columns(given: Mapping[Any, Any]) -> Points:
    import numpy as np

    columns = {}
    for key, column in given.items():
        if not isinstance(key, str) or not key:
            raise _wrong(f"{key!r} is no key")
        try:
            columns[key] = _column(_texts(column))
        except ValueError:
            raise _wrong(f"{key}: values of several shapes") from None
        if columns[key].dtype == object and all(isinstance(item, str) for item in columns[key].flat):
            columns[key] = columns[key].astype(str)  # texts of pandas
        if columns[key].dtype == object:
            columns[key] = _checked(columns[key], key)
    lengths = {key: len(column) for key, column in columns.items() if column.ndim}
    if not columns or not min(lengths.values(), default=1):
        raise _wrong("there are none")
    count = max(lengths.values(), default=1)
    for key, length in lengths.items():
        if length != count:
            raise _wrong(f"{key} has {length} values, others have {count}")
    every = {key: c if c.ndim else np.full(count, c) for key, c in columns.items()}
    return Points(every, count)


def _texts(column: Any) -> Any:
    """Paths as the texts that they are."""
    if isinstance(column, os.PathLike):
        return os.fspath(column)
    is_plain = hasattr(column, "dtype") and column.dtype != object
    if is_plain or isinstance(column, str | bytes) or not isinstance(column, Iterable):
        return column
    items = list(column)
    is_path = [isinstance(item, os.PathLike) for item in items]
    return [os.fspath(x) if p else x for x, p in zip(items, is_path, strict=True)] if any(is_path) else column


def _column(values: Any) -> NDArray[Any]:
    """Values as an array; as they are, one by one, where they are of several types, of which numpy would make one: texts
    of numbers, numbers of True.
    """
    import numpy as np

    array = np.asarray(values)
    if array.dtype == object or not isinstance(values, list | tuple):
        return array
    if len({_kind(value) for value in values}) < 2:
        return array
    mixed = np.empty(len(values), dtype=object)
    mixed[:] = [_plain(value) for value in values]
    return mixed


def _kind(value: Any) -> str:
    """What a value is, as cases tell values apart: a list of values is none of these."""
    import numpy as np

    if isinstance(value, bool | np.bool_):
        return "true or false"
    return "text" if isinstance(value, str) else "number" if np.isscalar(value) else "list"


def _checked(column: NDArray[Any], key: str) -> NDArray[Any]:
    """A column of values of several types, or one in which some points have no value, None: the key is taken out of
    the case there.
    """
    import numpy as np

    values = str | bool | int | float | np.generic | None
    if column.ndim > 1 or not all(isinstance(item, values) for item in column.flat):
        raise _wrong(f"{key}: values that are neither numbers nor texts")
    return column


def _plain(value: Any) -> Any:
    return value.tolist() if hasattr(value, "tolist") else value


def _wrong(why: str) -> CaseError:
    return CaseError(
        f"points: {why}",
        key="points",
        remedy="arrays of one length by key, as {'motion.frequency_hz': [190, 200]}, or dicts with the same keys",
    )
