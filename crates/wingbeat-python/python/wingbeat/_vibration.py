"""Vibrations of elastic wings: modes and flutter."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from wingbeat import _core


@dataclass(frozen=True)
class Vibrations:
    """Modes of a wing, of rising frequency."""

    frequency_hz: NDArray[Any]
    """Shape (modes,)."""
    growth_per_s: NDArray[Any]
    """Growth of a mode that does not vibrate: the state is no stable equilibrium; 0 of the others. Shape (modes,)."""
    modal_mass_kg: NDArray[Any]
    """For shapes whose largest displacement is 1. Shape (modes,)."""
    shapes: NDArray[Any]
    """Displacements of the nodes, wing axes, the largest of each mode of length 1. Shape (modes, nodes, 3)."""


@dataclass(frozen=True)
class WingModes:
    """Modes of one elastic wing."""

    wing: str
    mass_kg: float
    nodes_m: NDArray[Any]
    """Nodes of the mesh about which it vibrates, wing axes. Shape (nodes, 3)."""
    deflection_m: NDArray[Any]
    """How far they are from where they are at rest, wing axes. Shape (nodes, 3)."""
    vacuum: Vibrations
    """Without air."""
    air: Vibrations | None
    """With the added mass of the air; None without air."""


def wing_modes(core: _core.Flight, count: int, steady: bool) -> dict[str, WingModes]:
    """Modes of all elastic wings, by name."""
    found = {}
    for wing, mass, nodes, deflection, vacuum, air in core.wing_modes(count, steady):
        in_air = None if air is None else Vibrations(*air)
        found[wing] = WingModes(wing, mass, nodes, deflection, Vibrations(*vacuum), in_air)
    return found


@dataclass(frozen=True, slots=True)
class GrowingMode:
    """A vibration about the deformed steady state."""

    frequency_hz: float
    growth_per_s: float
    growth_uncertainty_per_s: float
    """Growth smaller than this is neutral within what is known."""
    damping_ratio: float
    """Over critical damping; negative where it grows."""
    share: float
    """Part of the response that it is."""


@dataclass(frozen=True, slots=True)
class FlutterCondition:
    """An elastic wing in the stream at one speed."""

    wing: str
    """Its name; of wings deformed as mirror images of each other the first."""
    speed_m_per_s: float
    tip_m: tuple[float, float, float]
    """Displacement of the tip in the steady state, wing axes."""
    tip_turn_rad: tuple[float, float, float]
    """Rotation vector of the tip, wing axes."""
    vacuum_hz: tuple[float, ...]
    """Frequencies about the deformed steady state without air."""
    modes: tuple[GrowingMode, ...]
    divergence_growth_per_s: float | None
    """Growth of a motion that does not vibrate; None where none grows beyond what is known."""
    divergence_growth_uncertainty_per_s: float | None
    residual: float
    """Part of the response that no mode explains; above 0.02 the modes are doubtful."""
    nonlinearity: float
    """Part of the response that is not linear; above 0.05 the modes are doubtful."""
    disturbance: float
    """Amplitude of the disturbance over the length of the wing."""
    response_s: float
    """Length of the response."""
    slow_joint: tuple[str, float] | None
    """The joint on whose springs what it carries vibrates most slowly, and the period in s, where that is longer than the response:
    what moves on it is not found; lengthen ``periods``."""
    unknown_frequencies: tuple[tuple[float, float, float], ...]
    """Motions whose frequency the response does not tell, left out of the modes: where they appear in Hz, growth in 1/s and share; try a
    smaller step, other ``modes`` or ``periods``."""


@dataclass(frozen=True, slots=True)
class FlutterOnset:
    """Where flutter of a wing begins or ends between two speeds."""

    wing: str
    certain: bool
    """False where the mode is neutral, within what is known, at the lowest speeds: lower ones make it certain."""
    begins: bool
    speed_m_per_s: float
    frequency_hz: float
    between_m_per_s: tuple[float, float]


@dataclass(frozen=True)
class Flutter:
    """Vibrations over the speed of the stream: conditions speed by speed, wing by wing."""

    conditions: tuple[FlutterCondition, ...]
    onsets: tuple[FlutterOnset, ...]

    @property
    def speed_m_per_s(self) -> float | None:
        """The lowest speed at which flutter begins between the given ones; None where it does not."""
        return min((o.speed_m_per_s for o in self.onsets if o.begins), default=None)


def flutter(core: _core.Flight, speeds: list[float], how: tuple[int, float, float, bool], progress: Any) -> Flutter:
    """Conditions and onsets at these speeds [m/s]."""
    conditions, onsets = core.flutter(speeds, how, progress)

    def condition(
        wing: str, speed: float, tip: Any, vacuum: Any, modes: Any, divergence: Any, rest: Any, slow: Any, unknown: Any
    ) -> FlutterCondition:
        growing = tuple(GrowingMode(*mode) for mode in modes)
        growth, uncertainty = divergence or (None, None)
        residual, nonlinearity, disturbance, length = rest
        return FlutterCondition(
            wing=wing,
            speed_m_per_s=speed,
            tip_m=tuple(tip[0]),
            tip_turn_rad=tuple(tip[1]),
            vacuum_hz=tuple(vacuum),
            modes=growing,
            divergence_growth_per_s=growth,
            divergence_growth_uncertainty_per_s=uncertainty,
            residual=residual,
            nonlinearity=nonlinearity,
            disturbance=disturbance,
            response_s=length,
            slow_joint=slow,
            unknown_frequencies=tuple((at, growth, share) for at, growth, share in unknown),
        )

    return Flutter(
        tuple(condition(*parts) for parts in conditions),
        tuple(FlutterOnset(*parts[:5], (parts[5][0], parts[5][1])) for parts in onsets),
    )
