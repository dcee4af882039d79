"""A flight as a function of some of its keys, for libraries of optimisation, sensitivity and uncertainty."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from types import TracebackType
from typing import TYPE_CHECKING, Any, NoReturn

from wingbeat._numbers import real, reals
from wingbeat.campaign import Processes, Serial, _engines, _names, _plan, _points
from wingbeat.errors import CaseError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from wingbeat._flight import Flight

Bounds = Mapping[str, tuple[float | None, float | None]]


class Problem:
    """Numbers of a flight as a function of keys within bounds: ``evaluate(X)`` for many points at once.

    ``variables`` are keys of the case, or what a function as ``base`` makes a flight of, with their lower and upper bounds.
    ``objectives`` are names of numbers, less being better, or a dict of them with ``"min"`` or ``"max"``; ``constraints`` are
    names with the least and the most that is allowed, None for no bound. ``base`` and ``do`` are those of
    :func:`wingbeat.campaign.map`, as are ``last_beats``, ``out``, ``chunk_s`` and ``attempts``.

    ``executor`` is as there, too, but processes of this machine are kept from one evaluation to the next: ``close()``, or a
    ``with`` statement, ends them. One point alone is flown in the calling process if no executor is given.

    >>> import wingbeat
    >>> base = wingbeat.Flight.preset("fruit-fly-blade").set("time.beats", 1)
    >>> hover = wingbeat.Problem(base, {"motion.frequency_hz": (150, 250)}, ["power_watt"], {"lift_over_weight": (1, None)})
    >>> hover.evaluate([[200.0]]).shape
    (1, 2)
    """

    def __init__(
        self,
        base: Flight | Mapping[str, Any] | str | os.PathLike[str] | Callable[[dict[str, Any]], Flight],
        variables: Mapping[str, tuple[float, float]],
        objectives: str | Sequence[str] | Mapping[str, str],
        constraints: Bounds | None = None,
        *,
        do: str | Callable[[Flight], Mapping[str, Any]] = "fly",
        executor: Executor | None = None,
        workers: int | None = None,
        last_beats: int | None = None,
        out: str | os.PathLike[str] | None = None,
        chunk_s: float = 0.5,
        attempts: int = 3,
    ) -> None:
        import numpy as np

        bounds = _bounds(variables)
        self.variables: tuple[str, ...] = tuple(bounds)
        """Keys, in the order of the columns of X."""
        self.lower: NDArray[Any] = np.array([low for low, _ in bounds.values()])
        """Lower bounds, shape (d,)."""
        self.upper: NDArray[Any] = np.array([high for _, high in bounds.values()])
        """Upper bounds, shape (d,)."""
        self.objectives: dict[str, str] = _objectives(objectives)
        """Names and ``min`` or ``max``."""
        self.constraints: dict[str, tuple[float | None, float | None]] = _constraints(constraints or {})
        """Names, and the least and the most that is allowed."""
        self.outputs: tuple[str, ...] = tuple(dict.fromkeys([*self.objectives, *self.constraints]))
        """Names, in the order of the columns of Y: objectives, then constraints."""
        self.reasons: list[str] = []
        """Why points of the last evaluation have no numbers; empty texts where they have."""
        self.errors: NDArray[Any] = np.empty(0)
        """Estimated errors of the last gradient."""
        self.evaluations = 0
        """Points evaluated so far."""
        self._executor, is_made_here = _engines.engine(executor, workers)
        self._own = self._executor if is_made_here and isinstance(self._executor, Processes) else None
        shared = None if executor is None else workers
        keep = {name: _names.unit(name) for name in self.outputs}
        self._plan = _plan.plan(self.variables, base, do, keep, last_beats, out, shared, chunk_s, attempts)

    def __reduce__(self) -> NoReturn:
        raise CaseError(
            "a problem cannot be pickled: it keeps the processes that fly its points",
            key="problem",
            remedy="a function that makes it, called in the other process",
        )

    def evaluate(self, X: ArrayLike) -> NDArray[Any]:
        """Numbers of points: from shape (n, d) to (n, m), or from (d,) to (m,); NaN where a point failed.

        Optimisers with penalties ask for points outside the bounds, too: they are flown. Gradients are refused there.
        """
        import numpy as np

        points = reals("X", X)
        rows = np.atleast_2d(points)
        if points.ndim > 2 or rows.shape[1] != len(self.variables):
            raise CaseError(
                f"X has the shape {points.shape}", key="X", remedy=f"(n, {len(self.variables)}): {', '.join(self.variables)}"
            )
        if not len(rows):
            self.reasons = []
            return np.empty((0, len(self.outputs)))
        read = _points.read(dict(zip(self.variables, rows.T, strict=True)))
        table = self._plan.fly(read, self._engine(len(rows)), None)
        self.reasons = table.reasons
        self.evaluations += len(rows)
        found = np.column_stack([table[name] for name in self.outputs])
        numbers: NDArray[Any] = found[0] if points.ndim == 1 else found
        return numbers

    def gradient(self, x: ArrayLike, *, first_step: float = 0.02, relative: float = 1e-7) -> NDArray[Any]:
        """Derivatives of all numbers by all variables at a point, shape (m, d), from (d,); or (n, m, d) from (n, d).

        By differences within the bounds, the first over ``first_step`` of the range of a variable; steps become smaller until the
        estimated errors (``errors``, of the same shape) are below the ``relative`` part of the derivative or of the number over the range,
        or grow. Points of all variables are flown at once. A point that fails makes its derivatives NaN.
        """
        import numpy as np

        from wingbeat import _gradient

        if not 0.0 < real("first_step", first_step) <= 0.05:
            raise CaseError(f"first_step = {first_step!r:.60}: no part of a range", key="first_step", remedy="above 0, up to 0.05")
        if not 0.0 < real("relative", relative) < 1.0:
            raise CaseError(f"relative = {relative!r:.60}: no part of a number", key="relative", remedy="above 0, below 1, e.g. 1e-7")
        points = np.atleast_2d(reals("x", x))
        if points.shape[1:] != self.lower.shape or not ((self.lower <= points) & (points <= self.upper)).all():
            raise CaseError("x: not within the bounds of the variables", key="x", remedy="lower <= x <= upper, shape (d,) or (n, d)")
        pairs = [_gradient.jacobian(self.evaluate, at, self.lower, self.upper, first_step, relative) for at in points]
        found, errors = (np.array(list(arrays)) for arrays in zip(*pairs, strict=True))
        self.errors = errors[0] if np.ndim(x) == 1 else errors
        derivatives: NDArray[Any] = found[0] if np.ndim(x) == 1 else found
        return derivatives

    def costs(self, Y: ArrayLike) -> NDArray[Any]:
        """The objectives of results, what is to be large with the opposite sign: less is better."""
        import numpy as np

        signs = np.array([-1.0 if sense == "max" else 1.0 for sense in self.objectives.values()])
        costs: NDArray[Any] = np.asarray(Y)[..., : len(signs)] * signs
        return costs

    def violations(self, Y: ArrayLike) -> NDArray[Any]:
        """How far results are beyond the bounds of constraints, a column each: 0 and less is allowed."""
        import numpy as np

        found = np.asarray(Y)
        columns = []
        for name, (least, most) in self.constraints.items():
            value = found[..., self.outputs.index(name)]
            columns += [] if least is None else [least - value]
            columns += [] if most is None else [value - most]
        return np.stack(columns, axis=-1) if columns else np.empty((*found.shape[:-1], 0))

    def close(self) -> None:
        """Ends the processes that this problem has started."""
        if self._own is not None:
            self._own.shutdown()

    def __enter__(self) -> Problem:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        if self._own is not None and error is not None:
            self._own.stop()
        self.close()

    def __repr__(self) -> str:
        return f"<wingbeat.Problem: {', '.join(self.outputs)} of {', '.join(self.variables)}>"

    def _engine(self, points: int) -> Executor:
        if self._own is not None:
            return self._own if points > 1 else Serial()
        return self._executor


def _bounds(variables: Mapping[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    if not isinstance(variables, Mapping) or not variables:
        raise CaseError("variables: none is given", key="variables", remedy="as {'motion.frequency_hz': (150, 250)}")
    found = {}
    for key, pair in variables.items():
        try:
            low, high = map(float, pair)
        except (TypeError, ValueError):
            low = high = float("nan")
        if not -float("inf") < low < high < float("inf"):
            remedy = "a lower and a larger upper bound, both finite"
            raise CaseError(f"variables: {key} = {pair!r:.60}: no range", key=str(key), remedy=remedy)
        found[key] = (low, high)
    return found


def _objectives(given: str | Iterable[str] | Mapping[str, str]) -> dict[str, str]:
    names = [given] if isinstance(given, str) else given
    found = dict(names) if isinstance(names, Mapping) else dict.fromkeys(names, "min")
    if not found:
        raise CaseError("objectives: none is given", key="objectives", remedy="names of numbers, e.g. ['power_watt']")
    for name, sense in found.items():
        if sense not in ("min", "max"):
            raise CaseError(f"objectives: {name} = {sense!r:.60}", key="objectives", remedy="'min' or 'max'")
    return found


def _constraints(given: Bounds) -> dict[str, tuple[float | None, float | None]]:
    found = {}
    for name, pair in given.items():
        try:
            least, most = (None if bound is None else float(bound) for bound in pair)
        except (TypeError, ValueError):
            least = most = None
        if any(bound is not None and bound != bound for bound in (least, most)):
            least = most = None  # not a number
        if least is most is None or (least is not None and most is not None and not least <= most):
            remedy = "the least and the most that is allowed, as (1.0, None)"
            raise CaseError(f"constraints: {name} = {pair!r:.60}: no bounds", key="constraints", remedy=remedy)
        found[name] = (least, most)
    return found
