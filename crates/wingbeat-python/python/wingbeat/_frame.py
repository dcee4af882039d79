"""Surfaces and wakes of one instant."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NoReturn, Self

from wingbeat import _core
from wingbeat.errors import CaseError

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Surface:
    """All bound surfaces: wings, then parts of the body."""

    nodes_m: NDArray[Any]
    """Nodes, N components, shape (nodes, 3) [m]."""
    panels: NDArray[Any]
    """Corners of the panels, shape (panels, 4): rows of ``nodes_m``."""
    circulation_m2_per_s: NDArray[Any]
    """Ring circulation of each panel, right-handed about its corners in their order [m2/s]: filaments along the edges 0-1-2-3-0 of
    ``panels`` with it induce the velocity of the air where ``air.ring_inset`` is 0. By default the rings lie a quarter panel aft of
    the panels, which is some per cent of the velocity a chord away; ``Stepper.air_velocity`` has it exactly.
    """
    pressure_jump_pascal: NDArray[Any]
    """Pressure jump of each panel, positive along its normal."""
    surface: NDArray[Any]
    """Number of the surface that each panel belongs to."""


@dataclass(frozen=True, slots=True)
class Wake:
    """A wake sheet, newest row first."""

    nodes_m: NDArray[Any]
    """Nodes, N components, shape (rows + 1, columns + 1, 3) [m]."""
    circulation_m2_per_s: NDArray[Any]
    """Of the rings, shape (rows, columns), right-handed about the nodes (r, c), (r + 1, c), (r + 1, c + 1), (r, c + 1) in this
    order: filaments along these edges with it induce the velocity of the air. Neighbours share an edge, which carries the
    difference of their circulations [m2/s].
    """
    shared_circulation_m2_per_s: NDArray[Any]
    """Of rings that have become particles, in the edges that they share with rings, shape (rows, columns), right-handed as
    ``circulation_m2_per_s``; 0 elsewhere [m2/s].
    """


@dataclass(frozen=True, slots=True)
class Particles:
    """Vortex particles."""

    position_m: NDArray[Any]
    """Places, N components, shape (particles, 3) [m]."""
    strength_m3_per_s: NDArray[Any]
    """Vorticity times volume, N components, shape (particles, 3)."""
    radius_m: NDArray[Any]
    """Radii, shape (particles,) [m]."""


class Frame:
    """Surfaces and wakes of one instant; arrays are read-only and live as long as they are held."""

    __slots__ = ("_core",)

    def __init__(self, core: _core.Frame) -> None:
        self._core = core

    def __repr__(self) -> str:
        return f"<wingbeat.Frame of step {self.step}: {len(self.wakes)} wake sheets>"

    def __reduce__(self) -> NoReturn:
        raise CaseError(
            "a frame cannot be pickled",
            key="frame",
            remedy="its arrays (surface, wakes, particles), or fly(out=DIR), from which frames are read again",
        )

    def __copy__(self) -> Self:
        return self  # it never changes

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        return self

    @property
    def step(self) -> int:
        """Step of the flight."""
        return self._core.step

    @property
    def time_s(self) -> float:
        """Time [s]."""
        return self._core.time_s

    @property
    def surface(self) -> Surface:
        """The bound surfaces."""
        core = self._core
        names = ("circulation_m2_per_s", "pressure_jump_pascal", "surface")
        return Surface(core.nodes_m, core.panels, *(core.panel_values(name) for name in names))

    @property
    def wakes(self) -> list[Wake]:
        """The wake sheets."""
        return [Wake(*sheet) for sheet in self._core.sheets()]

    @property
    def particles(self) -> Particles:
        """The vortex particles that wakes have become (``air.particles``)."""
        return Particles(*self._core.particles())
