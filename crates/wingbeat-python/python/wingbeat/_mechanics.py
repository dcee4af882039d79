"""Trim, stability, controls, power."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, NoReturn, Self, TypeVar

from wingbeat import _core
from wingbeat._numbers import whole
from wingbeat._own import Adjustment
from wingbeat._packages import needs
from wingbeat._paths import path as plain_path
from wingbeat.errors import AnalysisError, CaseError, ResultError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from wingbeat._flight import Flight

_STATES, _CONTROLS = _core.Trim.names()
STATES = tuple(name for name, _ in _STATES)
"""Velocity of the mass centre u, v, w, angular velocity p, q, r, rotation vector phi (roll), theta, psi."""
STATE_UNITS = tuple(unit for _, unit in _STATES)
_INPUT_UNITS = dict(_CONTROLS)


@dataclass(frozen=True, slots=True)
class Mode:
    """A mode of flight."""

    name: str
    """As "unstable oscillation", "fast subsidence"."""
    plane: str
    """``longitudinal``, ``lateral`` or ``joints``."""
    growth_per_s: float
    """Real part of the exponent."""
    frequency_rad_per_s: float
    """Imaginary part of the exponent; one mode stands for the conjugate pair."""
    multiplier: complex
    """Floquet's multiplier."""
    vector: dict[str, tuple[float, float]]
    """Components of the eigenvector over their natural sizes: size and phase [rad]."""


def _modes(parts: list[Any]) -> tuple[Mode, ...]:
    def mode(name: str, plane: str, growth: float, frequency: float, at: list[float], vector: list[Any]) -> Mode:
        components = {component: (size, phase) for component, size, phase in vector}
        return Mode(name, plane, growth, frequency, complex(*at), components)

    return tuple(mode(*part) for part in parts)


@dataclass(frozen=True)
class LinearModel:
    """The averaged linear model about a trimmed flight, ``x' = A x + B u``, ``y = C x + D u``.

    Level axes of the trimmed attitude (forward, right, down) about the mass centre, SI. ``scipy.signal.StateSpace(*m)``,
    ``control.ss(*m)`` and ``scipy.io.savemat(file, m.to_dict())`` take it as it is.
    """

    A: NDArray[Any]
    """Shape (9, 9)."""
    B: NDArray[Any]
    """Shape (9, inputs)."""
    C: NDArray[Any]
    """All states are seen, shape (9, 9)."""
    D: NDArray[Any]
    """Zero, shape (9, inputs)."""
    states: tuple[str, ...]
    state_units: tuple[str, ...]
    inputs: tuple[str, ...]
    """Control and wing, as ``stroke_amplitude right``."""
    input_units: tuple[str, ...]
    derivatives: NDArray[Any]
    """Of the mean loads X, Y, Z, L, M, N by u, v, w, p, q, r, shape (6, 6)."""
    added_mass: NDArray[Any]
    """Of the air: what the mean loads are smaller by for the rates of u, v, w (through the air), p, q, r, shape (6, 6)."""
    averaged_modes: tuple[Mode, ...]
    """Modes of A."""
    floquet_modes: tuple[Mode, ...]
    """Modes of the full periodic orbit."""

    def __iter__(self) -> Any:
        return iter((self.A, self.B, self.C, self.D))

    def to_dict(self) -> dict[str, Any]:
        """Matrices, names and units, as MATLAB takes them."""
        names = ("states", "state_units", "inputs", "input_units")
        return {k: getattr(self, k) for k in "ABCD"} | {k: list(getattr(self, k)) for k in names}

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Writes a file for MATLAB by the name given (end it in ``.mat``), in place of one that exists only with
        ``overwrite``. Needs scipy.
        """
        needs("scipy.io", "study", "save")
        import numpy as np
        from scipy.io import savemat

        name = plain_path("path", path)
        if os.path.exists(name) and not overwrite:
            raise ResultError(f"{name} exists already", key=name, remedy="overwrite=True, or another file")
        texts = {k: np.array(v, dtype=object) for k, v in self.to_dict().items() if isinstance(v, list)}
        savemat(name, self.to_dict() | texts, appendmat=False)  # no file but the one looked for


@dataclass(frozen=True)
class Derivatives:
    """Control derivatives of the mean loads."""

    controls: tuple[str, ...]
    wings: tuple[str, ...]
    """The wing that is moved, or ``all``."""
    units: tuple[str, ...]
    """Of the controls."""
    loads: NDArray[Any]
    """Force [N] and moment about the mean mass centre [N m], level axes, per unit of the control: shape (controls, 6)."""


@dataclass(frozen=True, slots=True)
class Power:
    """Mean mechanical power over a wingbeat."""

    aerodynamic_watt: float
    """Against the air."""
    inertial_positive_watt: float
    """Positive part of the inertial power."""
    perfect_storage_watt: float
    """Of the muscles, if springs return all negative power."""
    no_storage_watt: float
    """Of the muscles, if negative power is lost."""
    peak_watt: float
    """Of all wings."""
    damping_watt: float
    """What the damping of elastic wings takes; 0 of rigid ones."""
    mass_kg: float
    """Of the animal."""


@dataclass(frozen=True)
class WakeModel:
    """A wingbeat in air with a memory as a map of small disturbances of the body, ``x(T) = M x(0)``, in the axes of
    :class:`LinearModel`; velocities are those through the air.
    """

    monodromy: NDArray[Any]
    """M, shape (9, 9)."""
    states: tuple[str, ...]
    state_units: tuple[str, ...]
    floquet_modes: tuple[Mode, ...]
    """Modes of M."""


_Core = TypeVar("_Core", bound="_core.Trim | _core.WakeTrim")


class _Trimmed(Generic[_Core]):
    """What trims in any air have: the point found, converged or not."""

    def __init__(self, core: _Core) -> None:
        self._core: _Core = core
        self._solution = core.solution

    def __repr__(self) -> str:
        found = "converged" if self.converged else "NOT converged"
        if self.outside_bounds:
            found = f"{found}, OUTSIDE its bounds ({', '.join(self.outside_bounds)})"
        return f"<wingbeat.{type(self).__name__} {found}: largest residual {abs(self.residual).max():.1e}>"

    def __reduce__(self) -> NoReturn:
        raise CaseError(
            "a trim cannot be pickled",
            key="trim",
            remedy="the numbers that are needed of it, or flight() if it is of a case: that can be, and trims again from there",
        )

    def __copy__(self) -> Self:
        return self  # it never changes

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        return self

    @property
    def converged(self) -> bool:
        """Whether steady flight was found; :attr:`outside_bounds` says whether it is as asked."""
        return self._solution.converged

    @property
    def residual(self) -> NDArray[Any]:
        """Horizontal and vertical force over weight, pitch moment over weight times wing length, pitch per beat [rad],
        horizontal and vertical drift per beat over wing length; of flight that turns, slips or has lateral unknowns three
        of each: forward, right, down. Then those of free joints.
        """
        return self._solution.residual

    @property
    def iterations(self) -> int:
        """Steps of Newton's method made, in air with a memory of a quasi-Newton method."""
        return self._solution.iterations

    @property
    def unknowns(self) -> dict[str, float]:
        """What was chosen, by the names and in the units in which bounds are given: radians, parts of 1, wingbeats
        (``feathering_lead``), wing lengths (``mass_centre``), metres a second (``forward``, ``climb``).
        """
        return dict(self._solution.unknowns)

    @property
    def forward_m_per_s(self) -> float:
        """Mean velocity forward, asked for or, of gliders for instance, found [m/s]."""
        return self._core.velocity[0]

    @property
    def climb_m_per_s(self) -> float:
        """Mean velocity upward, asked for or found [m/s]; a glider's is negative."""
        return self._core.velocity[2]

    @property
    def tail_incidence_rad(self) -> float:
        """What trim adds to the feathering angle of the tail, leading edge up [rad]."""
        return self._solution.tail_incidence_rad

    @property
    def mass_centre_m(self) -> float:
        """By how much trim moves the mass centre forward against the hinges [m]."""
        return self._solution.mass_centre_m

    @property
    def adjustment(self) -> Adjustment:
        """What trim adds to the motion of all wings."""
        return Adjustment(*self._solution.adjustment)

    @property
    def difference(self) -> Adjustment:
        """What right wings have more of it than left ones."""
        return Adjustment(*self._solution.difference)

    @property
    def outside_bounds(self) -> tuple[str, ...]:
        """Unknowns outside their bounds, or by which strokes are turned inside out: the flight is steady, but not as asked."""
        return tuple(self._solution.at_bounds[0])

    @property
    def at_bound(self) -> tuple[str, ...]:
        """Unknowns at a bound."""
        return tuple(self._solution.at_bounds[1])

    @property
    def body_roll_rad(self) -> float:
        """Roll of the body at the start of the wingbeat, right side down [rad]."""
        return self._solution.body_roll_rad

    @property
    def body_pitch_rad(self) -> float:
        """Pitch of the body at the start of the wingbeat, in air with a memory at its release [rad]."""
        return self._solution.body_pitch_rad

    def flight(self) -> Flight:
        """The flight that was found, to be flown on, trimmed (``converged``) or not; in air with a memory held, released, and the
        free wingbeat."""
        return _flight(self._core.case_text)

    def power(self) -> Power:
        """Mean mechanical power over the free wingbeat that was trimmed."""
        self._check()
        return Power(*self._core.power())

    def _check(self) -> None:
        """Refuses to say anything of a flight that is not as asked."""
        if self._solution.is_as_asked:
            return
        remedy = "start nearer to it (flight.pitch_deg, motion), or choose other unknowns"
        if self.converged:
            names = ", ".join(self.outside_bounds)
            raise AnalysisError(f"the trimmed flight is outside its bounds: {names}", remedy=f"wider bounds; {remedy}")
        raise AnalysisError(f"the flight is not trimmed: largest residual {abs(self.residual).max():.1e}", remedy=remedy)


class Trim(_Trimmed[_core.Trim]):
    """Steady flight as a periodic orbit of the full model: the point found, converged or not. What is derived from it
    (stability, derivatives, power) is refused if it is not as asked.
    """

    @property
    def period_s(self) -> float:
        """Period of the wingbeat [s]."""
        return self._core.period_s

    @cached_property
    def _controls(self) -> tuple[list[tuple[str, str]], NDArray[Any], NDArray[Any]]:
        self._check()
        return self._core.derivatives()

    def derivatives(self) -> Derivatives:
        """Control derivatives, wing by wing and of all wings together."""
        names, loads, _ = self._controls
        controls = tuple(control for control, _ in names)
        return Derivatives(controls, tuple(wing for _, wing in names), tuple(_INPUT_UNITS[control] for control in controls), loads)

    def floquet_modes(self) -> tuple[Mode, ...]:
        """Floquet's modes of the periodic orbit, also of turns and of animals with free joints."""
        self._check()
        return _modes(self._core.floquet_modes())

    def stability(self) -> LinearModel:
        """The averaged linear model with its inputs, its modes, and Floquet's modes of the periodic orbit. A turn and free
        joints have no averaged model: :meth:`floquet_modes` takes them.
        """
        import numpy as np

        self._check()
        a, (derivatives, added_mass), averaged, orbit = self._core.stability()
        names, _, b = self._controls
        return LinearModel(
            A=a,
            B=b,
            C=np.eye(a.shape[0]),
            D=np.zeros(b.shape),
            states=STATES,
            state_units=STATE_UNITS,
            inputs=tuple(f"{control} {wing}" for control, wing in names),
            input_units=tuple(_INPUT_UNITS[control] for control, _ in names),
            derivatives=derivatives,
            added_mass=added_mass,
            averaged_modes=_modes(averaged),
            floquet_modes=_modes(orbit),
        )


class WakeTrim(_Trimmed[_core.WakeTrim]):
    """Steady flight in air with a memory or with elastic wings; the point found, converged or not. In the vortex lattice a
    wingbeat that changes nothing but the place, after wingbeats in which the body was held while its wake grew; in blade
    elements a periodic orbit of body, elastic wings and wakes of strips.
    """

    @property
    def flights(self) -> int:
        """Flights flown."""
        return self._core.flights

    def stability(self, *, wake: str = "carried") -> WakeModel:
        """In the lattice, derivative of the free wingbeat by the state of the body, and its modes: 18 more flights. Held fixed when the body is
        disturbed: the wake of the trimmed flight (``given``), or the disturbance during the hold, so that the wake goes with it
        (``carried``). Neither is the whole problem of body and wake; the two bracket it.
        """
        self._check()
        matrix, modes = self._core.stability(wake)
        return WakeModel(matrix, STATES, STATE_UNITS, _modes(modes))

    def floquet_modes(self, *, wing_modes: int = 3) -> tuple[Mode, ...]:
        """In blade elements, Floquet's modes of the periodic orbit of body, elastic wings and wakes of strips, as ``wingbeat
        stability`` has them: ``wing_modes`` leading modes of each elastic wing are disturbed, too (20 at most; with one
        fewer the multipliers tell whether they are enough), and all states of the wakes. Decaying motions in which wakes have
        more part than body and wings are left out. The lattice has :meth:`stability`.
        """
        self._check()
        return _modes(self._core.floquet_modes(whole("wing_modes", wing_modes, 1, 20)))


def _flight(case_text: str | None) -> Flight:
    from wingbeat._flight import Flight

    if case_text is None:
        raise AnalysisError(
            "no case gives this trimmed flight: it has parts written in Python",
            remedy="read adjustment and body_pitch_rad, and set them by hand",
        )
    return Flight.from_case(case_text)
