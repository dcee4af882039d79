"""Parts of a flight that are written in Python: controllers, models of the air, motions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import astuple, dataclass
from typing import TYPE_CHECKING, Any, Protocol

from wingbeat._core import Sensed
from wingbeat._numbers import real, reals
from wingbeat.errors import CaseError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Adjustment", "Motions", "Sensed"]


@dataclass(frozen=True, slots=True)
class Adjustment:
    """What a controller adds to the motion of a wing, as trim finds it. A part that can have no effect ends the flight: swing and
    lead of an angle that the case holds constant, as that of a passive hinge. Of one adjustment for all wings each has the parts that
    have an effect there.
    """

    stroke_amplitude: float = 0.0
    """Relative change of the stroke's swing about its mean."""
    stroke_offset_rad: float = 0.0
    """Added to the stroke angle, positive forward on either side."""
    feathering_offset_rad: float = 0.0
    """Added to the feathering angle."""
    feathering_amplitude: float = 0.0
    """Relative change of the feathering's swing about its mean."""
    feathering_lead_wingbeats: float = 0.0
    """Lead of feathering."""
    deviation_offset_rad: float = 0.0
    """Added to the deviation, in the sense of a right wing on either side."""
    stroke_plane_rad: float = 0.0
    """Added to the pitch of the stroke plane."""
    frequency: float = 0.0
    """Relative change of the frequency; 0 in flight."""

    def __post_init__(self) -> None:
        for name in self.__slots__:
            value = getattr(self, name)
            if type(value) is not float:
                object.__setattr__(self, name, real(name, value))


Controller = Callable[[Sensed], "Adjustment | Sequence[Adjustment]"]
"""From what is sensed to one adjustment for all wings, or one for each in their order."""


class Steering:
    """A controller as the core calls it."""

    def __init__(self, controller: Controller, wings: int) -> None:
        self._controller = controller
        self._wings = wings

    def reset(self) -> None:
        """A flight begins: asked of controllers that have such a method."""
        self._controller.reset()  # type: ignore[attr-defined]

    def __call__(self, sensed: Sensed) -> list[tuple[float, ...]]:
        answer = self._controller(sensed)
        if isinstance(answer, Adjustment):
            return [astuple(answer)]  # one for all
        for item in answer if isinstance(answer, Sequence) else [answer]:
            if not isinstance(item, Adjustment):
                raise CaseError(
                    f"control: the controller answered with {item!r:.60}, a value of type {type(item).__name__}",
                    key="control",
                    remedy="one wingbeat.Adjustment for all wings, or a list with one for each",
                )
        if len(answer) != self._wings:
            raise CaseError(
                f"control: the controller answered with {len(answer)} adjustments for {self._wings} wings",
                key="control",
                remedy="one wingbeat.Adjustment for all wings, or a list with one for each",
            )
        return [astuple(item) for item in answer]


class Motions:
    """How the bodies move at an instant, read-only views: the central body, then wings, then segments."""

    __slots__ = ("_rows", "step", "time_s")

    def __init__(self, step: int | None, time_s: float, rows: NDArray[Any]) -> None:
        self.step = step
        """Number of the step; None where the air has no memory."""
        self.time_s = time_s
        self._rows = rows

    @property
    def position_m(self) -> NDArray[Any]:
        """Origins, N components, shape (bodies, 3) [m]."""
        return self._rows[:, 0:3]

    @property
    def rotation(self) -> NDArray[Any]:
        """From body to N components, shape (bodies, 3, 3)."""
        return self._rows[:, 3:12].reshape(-1, 3, 3)

    @property
    def velocity_m_per_s(self) -> NDArray[Any]:
        """Of the origins, N components, shape (bodies, 3) [m/s]."""
        return self._rows[:, 12:15]

    @property
    def angular_velocity_rad_per_s(self) -> NDArray[Any]:
        """Body components, shape (bodies, 3) [rad/s]."""
        return self._rows[:, 15:18]


class MemoryAir(Protocol):
    """Air with a memory: told when a flight begins and which steps are accepted."""

    def __call__(self, motions: Motions) -> ArrayLike:
        """Loads on top of what was accepted at the step before."""

    def accept(self, step: int) -> None:
        """The motion asked for last is that of this step."""


Air = Callable[[Motions], "ArrayLike"]
"""From motions to forces [N] and moments about the origins [N m], N components, shape (bodies, 6)."""


class Loads:
    """A model of the air as the core calls it."""

    def __init__(self, air: Air, bodies: int) -> None:
        self._air = air
        self._bodies = bodies

    def open(self, names: list[str], step_s: float) -> None:
        """A flight begins."""
        opened = getattr(self._air, "open", None)
        if callable(opened):
            opened(names, step_s)

    def accept(self, step: int) -> None:
        """A step is accepted."""
        self._air.accept(step)  # type: ignore[attr-defined]

    def __call__(self, step: int | None, time_s: float, rows: NDArray[Any]) -> NDArray[Any]:
        import numpy as np

        loads = reals("air", self._air(Motions(step, time_s, rows)))
        if loads.shape != (self._bodies, 6):
            raise CaseError(
                f"air: the model of the air answered with an array of shape {loads.shape}",
                key="air",
                remedy=f"forces and moments of all bodies, shape ({self._bodies}, 6)",
            )
        if not np.isfinite(loads).all():
            raise CaseError(
                f"air: a load is not finite at t = {time_s:.6e} s", key="air", remedy="finite numbers everywhere"
            )
        return loads
