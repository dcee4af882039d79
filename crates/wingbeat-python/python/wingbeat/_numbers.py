"""Numbers that are given: whole ones, real ones, arrays of real ones."""

from __future__ import annotations

import math
import operator
from typing import TYPE_CHECKING, Any

from wingbeat.errors import CaseError

if TYPE_CHECKING:
    from numpy.typing import NDArray


def whole(key: str, number: Any, least: int, most: int) -> int:
    """A whole number from ``least`` to ``most``: an int, or what stands for one, as numpy's do."""
    try:
        plain = least - 1 if isinstance(number, bool) else operator.index(number)
    except TypeError:
        plain = least - 1
    if not least <= plain <= most:
        raise CaseError(f"{key} = {number!r:.60}: out of range", key=key, remedy=f"a whole number from {least} to {most}")
    return plain


def flag(key: str, given: Any) -> bool:
    """A truth value: True or False, numpy's as well."""
    if not isinstance(given, bool) and getattr(given, "dtype", None) != bool:
        raise CaseError(f"{key} = {given!r:.60}: no truth value", key=key, remedy="True or False")
    return bool(given)


def real(key: str, number: Any) -> float:
    """A real number; texts that read like one and truth values are none."""
    try:
        if isinstance(number, str | bytes | bool) or getattr(number, "dtype", None) == bool:
            raise TypeError
        return float(number)
    except (TypeError, ValueError, OverflowError):
        raise CaseError(f"{key} = {number!r:.60}: no number", key=key, remedy="a number") from None


def finite(key: str, number: Any) -> float:
    """A real number that is finite."""
    plain = real(key, number)
    if not math.isfinite(plain):
        raise CaseError(f"{key} = {plain}: not finite", key=key, remedy="a finite number")
    return plain


def points(key: str, given: Any) -> NDArray[Any]:
    """Points, finite, in rows of three coordinates; a single one as three numbers."""
    import numpy as np

    array = reals(key, given)
    if array.ndim not in (1, 2) or array.shape[-1] != 3 or not np.isfinite(array).all():
        what = f"an array of shape {array.shape}" if np.isfinite(array).all() else "a number is not finite"
        raise CaseError(f"{key}: {what}", key=key, remedy="finite coordinates, shape (n, 3) or (3,)")
    return array.reshape(-1, 3)


def reals(key: str, numbers: Any, kind: Any = float) -> NDArray[Any]:
    """An array of real numbers: complex ones would lose a part, texts and ragged lists are none."""
    import numpy as np

    remedy = "an array of real numbers"
    try:
        array = np.asarray(numbers)
    except ValueError as error:
        raise CaseError(f"{key}: no array: {error}", key=key, remedy=remedy) from None
    if array.dtype.kind not in "biuf":
        raise CaseError(f"{key}: an array of {array.dtype}", key=key, remedy=remedy)
    return np.ascontiguousarray(array, kind)
