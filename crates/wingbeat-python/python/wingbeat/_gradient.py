"""Derivatives by differences with controlled error [Ridders 1982, Adv. Eng. Softw. 4:75].

Differences over steps `h`, `h/2`, `h/4`, ... have errors that are a series in `h^2` (central) or `h` (to one side, next to a
bound); Neville's scheme takes its terms away one after the other. How far neighbours of the scheme are apart estimates what is
left, truncation and rounding alike. A variable gets further, smaller steps until that is small enough or grows.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Evaluate = Callable[[NDArray[Any]], NDArray[Any]]

LEAST, MOST = 2, 6
"""Steps of a variable; the least of them at once."""


@dataclass
class Scheme:
    """Derivatives of all numbers by one variable."""

    direction: int
    """0: central; 1, -1: to this side."""
    step: float
    """The first step."""
    rows: list[list[NDArray[Any]]] = field(default_factory=list)
    best: Any = None
    """Derivatives with the least error so far."""
    error: Any = None
    is_done: bool = False

    def next_offsets(self) -> list[tuple[float, float]]:
        """Pairs of places that the next difference quotients need: two quotients at first, then one after the other."""
        steps = [self.step * 0.5**k for k in range(len(self.rows), max(len(self.rows) + 1, LEAST))]
        return [(self.direction * h, 0.0) if self.direction else (h, -h) for h in steps]

    def add(self, difference: NDArray[Any], wanted: NDArray[Any]) -> None:
        """Another difference quotient; ``wanted`` is how large errors may be."""
        import numpy as np

        row = [difference]
        for k, above in enumerate(self.rows[-1] if self.rows else []):
            factor = 2.0 ** ((k + 1) * (1 if self.direction else 2)) - 1.0
            row.append(row[k] + (row[k] - above) / factor)
        if self.rows:
            before = self.error
            for k in range(1, len(row)):
                self._take(row[k], np.maximum(abs(row[k] - row[k - 1]), abs(row[k] - self.rows[-1][k - 1])))
            is_stuck = before is not None and len(self.rows) > LEAST and np.array_equal(before, self.error)
            self.is_done = bool(is_stuck or (self.error <= wanted).all() or not np.isfinite(row[0]).all())
        self.rows.append(row)
        self.is_done |= len(self.rows) >= MOST

    def _take(self, value: NDArray[Any], error: NDArray[Any]) -> None:
        """Keeps what has the least error so far, of each number."""
        import numpy as np

        if self.best is None:
            self.best, self.error = value.copy(), error.copy()
        better = error < self.error
        self.best = np.where(better, value, self.best)
        self.error = np.where(better, error, self.error)


def jacobian(
    evaluate: Evaluate, x: NDArray[Any], lower: NDArray[Any], upper: NDArray[Any], first: float, relative: float
) -> tuple[NDArray[Any], NDArray[Any]]:
    """Derivatives and their estimated errors, both of shape (numbers, variables). All steps that are needed next are evaluated at
    once. ``first`` is the first step as a part of the range of a variable.
    """
    import numpy as np

    span = upper - lower
    schemes = [Scheme(_direction(*at), first * at[3]) for at in zip(x, lower, upper, span, strict=True)]
    centre = None
    while True:
        pairs = [(j, *pair) for j, s in enumerate(schemes) if not s.is_done for pair in s.next_offsets()]
        if not pairs:
            break
        points = [_moved(x, j, offset) for j, *pair in pairs for offset in pair if offset != 0.0]
        found = list(evaluate(np.array([*points, *([x] if centre is None else [])])))
        centre = found.pop() if centre is None else centre
        for j, a, b in pairs:
            at_a = found.pop(0)
            at_b = found.pop(0) if b != 0.0 else centre
            difference = (at_a - at_b) / (_moved(x, j, a)[j] - _moved(x, j, b)[j])
            wanted = relative * np.maximum(abs(difference), abs(centre) / span[j])
            schemes[j].add(difference, wanted)
    return np.column_stack([s.best for s in schemes]), np.column_stack([s.error for s in schemes])


def _direction(x: float, low: float, high: float, span: float) -> int:
    """Central where the first step stays within the bounds by far, else to the side with more room."""
    room = 0.05 * span
    if low + room <= x <= high - room:
        return 0
    return 1 if high - x > x - low else -1


def _moved(x: NDArray[Any], j: int, offset: float) -> NDArray[Any]:
    moved = x.copy()
    moved[j] += offset
    return moved
