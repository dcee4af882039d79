"""Flights, to be flown at once or step by step."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from wingbeat import _core, _toml
from wingbeat._case import Part
from wingbeat._frame import Frame
from wingbeat._mechanics import Derivatives, LinearModel, Power, Trim, WakeTrim
from wingbeat._numbers import finite, flag, real, reals, whole
from wingbeat._own import Air, Controller, Loads, Steering
from wingbeat._paths import path
from wingbeat._run import Run
from wingbeat._source import Source, is_case_text
from wingbeat._vibration import Flutter, WingModes, flutter, wing_modes
from wingbeat.errors import CaseError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

Progress = Callable[[int, int], object]
"""Called with the steps done and all steps some 25 times a second; an exception in it stops the flight."""

_UNSET: Any = object()


class Flight:
    """A flight to be flown: a case, keys set on top of it, and parts written in Python. It never changes: methods
    return new ones. Without such parts it can be pickled: another process flies the same, bit for bit.
    """

    def __init__(self, core: _core.Flight, source: Source | None = None) -> None:
        self._core = core
        self._source = source

    def __reduce__(self) -> tuple[Callable[[Source], Flight], tuple[Source]]:
        if self._source is None:
            raise CaseError(
                "this flight has parts written in Python, or was read from the standard input: it cannot be pickled",
                key="base",
                remedy="give a function that makes the flight, or that adds the parts",
            )
        return _made, (self._source,)

    @staticmethod
    def preset(name: str | os.PathLike[str]) -> Flight:
        """An embedded preset (:func:`wingbeat.presets`), or a case file by its path."""
        name = path("name", name)
        return Flight(_core.Flight.find(name, []), Source.named(name))

    @staticmethod
    def from_case(case: str | os.PathLike[str] | Mapping[str, Any]) -> Flight:
        """A case: the text of one (TOML), the path of a file, or a dict of the same keys."""
        if isinstance(case, Mapping):
            return _made(Source("case", _toml.document(case), ""))
        if isinstance(case, str) and is_case_text(case):
            return _made(Source("case", case, ""))
        if not isinstance(case, str | os.PathLike):
            raise CaseError(f"a case is no {type(case).__name__}", key="case", remedy="the path of a file, the text of a case, or a dict")
        name = path("case", case)
        if not Path(name).is_file():
            raise CaseError(
                f"there is no case file `{name}`",
                key=name,
                remedy="the path of a file, the text of a case, a dict, or Flight.preset(NAME)",
            )
        return Flight.preset(name)

    def __repr__(self) -> str:
        return f"<wingbeat.Flight {self.name}: {self.steps} steps of {self.step_s:.4g} s>"

    def set(self, key: str | Mapping[str, Any], value: Any = _UNSET) -> Flight:
        """A new flight with a key of the case at another value, e.g. ``set("motion.frequency_hz", 210)``, or several
        by a dict; None takes a key out of the case. Files are named by texts or ``pathlib.Path``. All keys: docs/case-keys.md.
        """
        items: Mapping[str, Any] = key if isinstance(key, Mapping) else {key: value}
        sets = []
        for name, item in items.items():
            if not isinstance(name, str) or not name or "=" in name or "\n" in name:
                raise CaseError(f"{name!r} is no key of a case", key=str(name) or "case", remedy="a path as motion.frequency_hz")
            if item is _UNSET:
                raise CaseError(f"{name}: no value is given", key=name, remedy="set(key, value)")
            sets.append(f"{name}=" if item is None else f"{name}={_toml.value(item, name)}")
        source = self._source and replace(self._source, sets=(*self._source.sets, *sets))
        return Flight(self._core.set(sets), source)

    def with_motion(
        self,
        *,
        phi_deg: ArrayLike | Callable[[float], float] | None = None,
        theta_deg: ArrayLike | Callable[[float], float] | None = None,
        psi_deg: ArrayLike | Callable[[float], float] | None = None,
        wing: str | None = None,
        samples: int = 64,
    ) -> Flight:
        """A new flight with angles of your own over the wingbeat: stroke phi, deviation theta, feathering psi [deg].

        Each is an array of equally spaced values over one wingbeat, the end left out, or a function of the phase in
        wingbeats, from 0 to 1, which is sampled ``samples`` times now and never called again. They hold for ``wing``,
        or for all right wings; a left wing without angles of its own is the mirror image of the right one (and the other way
        round). The flight joins them by a periodic cubic spline; angles that do not end where they began are refused.
        """
        angles = {"phi": phi_deg, "theta": theta_deg, "psi": psi_deg}
        given = {name: _rows(name, angle, samples) for name, angle in angles.items() if angle is not None}
        if not given:
            raise CaseError("with_motion: no angle is given", key="motion", remedy="phi_deg, theta_deg or psi_deg")
        names = [name for name, _ in self._core.wings]
        if wing is not None and wing not in names:
            raise CaseError(f"wing = {wing!r:.60}: there is none of this name", key="wing", remedy=", ".join(names))
        wings = [name for name, side in self._core.wings if side > 0] if wing is None else [wing]
        keys = {
            f"wing.{name}.motion.{angle}": {"table": {"rows_deg": rows}}
            for name in wings
            for angle, rows in given.items()
        }
        return self._with_angles(keys)

    def _with_angles(self, keys: dict[str, Any]) -> Flight:
        """With these keys; data that all angles have replaced are taken away."""
        try:
            return self.set(keys)
        except CaseError as error:
            is_replaced = error.key.startswith(("motion.", "wing.")) and error.key.endswith("motion.data")
            if not is_replaced or error.key in keys:
                raise
            return self._with_angles({error.key: None} | keys)

    def with_controller(
        self, controller: Controller, *, every_steps: int | None = None, latency_looks: int | None = None
    ) -> Flight:
        """A new flight under ``controller``, called with what is sensed (:class:`wingbeat.Sensed`) at the release and
        every ``every_steps`` steps after it (a wingbeat if left out), never inside a step; it answers with one
        :class:`wingbeat.Adjustment` for all wings or one for each. Commands act ``latency_looks`` looks later, within
        20 wingbeats and the flight, and the wings go over to them smoothly until the next look. Of a case with
        ``air.mirror`` one half of the air is computed: commands that differ from side to side end its flight. A controller with a method ``reset`` is reset when a
        flight begins. Of ``[control]`` in the case ``sensors``, ``looks_per_beat``, ``every_beats``, ``latency_beats`` and
        ``lag_beats`` act on it as on an external program, unless ``every_steps`` and ``latency_looks`` say otherwise; a case with
        other keys there has a controller already, and is refused unless ``control.controller`` is ``"none"``. An exception in it stops the flight; ``error.run`` is what was flown. Flights that no wing steers are
        refused when they begin: tethered ones, those without wings or in air by a table of derivatives.
        """
        if not callable(controller):
            raise CaseError("control: the controller cannot be called", key="control", remedy="a function of Sensed")
        interval, every, due = self._core.control_times() or (None, 1, 0)
        if every_steps is not None:
            steps, every = whole("every_steps", every_steps, 4, 2**31 - 1), 1
            if latency_looks is None and due * (interval or 0) % steps != 0:
                raise CaseError(
                    f"latency_looks: control.latency_beats is no whole number of looks of {steps} steps",
                    key="latency_looks",
                    remedy="give latency_looks, or another every_steps",
                )
            due = due * (interval or 0) // steps
        else:
            steps = whole("every_steps", self._interval() if interval is None else interval, 4, 2**31 - 1)
        latency = whole("latency_looks", due if latency_looks is None else latency_looks, 0, self._most_looks(steps))
        steering = Steering(controller, len(self._core.wings))
        has_memory = callable(getattr(controller, "reset", None))
        return Flight(self._core.with_controller(steering, (steps, every, latency), has_memory))

    def with_air(self, air: Air) -> Flight:
        """A new flight in the air that ``air`` computes: called with :class:`wingbeat.Motions`, it answers with forces [N]
        and moments about the origins of all bodies [N m], N components, shape (bodies, 6). It is called several times a
        step. Air with a memory has a method ``accept(step)``, told which step holds (docs/external-air.md), and may
        have ``open(names, step_s)``. Air whose attribute ``is_steady_and_uniform`` is True can be trimmed in: its loads depend
        on velocities and attitudes alone, not on time or place. Of other air no wingbeat is taken to be like the next.

        It takes the place of the air of the case, of which it knows nothing: streams, gusts, vortex streets, shear and the ground of
        the case are refused, and keys of the air that :meth:`set` gave; ``set(KEY, None)`` takes them away.
        """
        if not callable(air):
            raise CaseError("air: the model of the air cannot be called", key="air", remedy="a function of Motions")
        is_steady = getattr(air, "is_steady_and_uniform", False)
        if not isinstance(is_steady, bool):
            raise CaseError(
                f"air: is_steady_and_uniform = {is_steady!r:.60}",
                key="air",
                remedy="True where the loads depend on the motions alone, not on time or place; False",
            )
        has_memory = callable(getattr(air, "accept", None))
        return Flight(self._core.with_air(Loads(air, self._core.body_count), has_memory, is_steady))

    def _most_looks(self, steps: int) -> int:
        """How many looks later a command may act: 20 wingbeats, and within the flight."""
        beats = math.inf if self.period_s is None else 20 * self.period_s / self.step_s
        return int(min(beats, self.steps) + 0.5) // steps

    def _interval(self) -> int:
        if self.period_s is None:
            raise CaseError("every_steps: this motion has no wingbeat", key="every_steps", remedy="give every_steps")
        return round(self.period_s / self.step_s)

    @property
    def name(self) -> str:
        """Name of the case."""
        return self._core.name

    @property
    def case_text(self) -> str:
        """The case with everything filled in, as TOML; parts written in Python are not in it."""
        return self._core.case_text

    @property
    def case(self) -> Part:
        """The same as a dict whose keys are attributes: change it and give it to :meth:`from_case`."""
        import tomllib

        return Part(tomllib.loads(self.case_text))

    @property
    def steps(self) -> int:
        """Number of steps."""
        return self._core.steps

    @property
    def step_s(self) -> float:
        """Time step [s]."""
        return self._core.step_s

    @property
    def period_s(self) -> float | None:
        """Period of the wingbeat [s]; None of motions without one."""
        return self._core.period_s

    @property
    def mass_kg(self) -> float:
        """Mass of the animal [kg]."""
        return self._core.mass_kg

    @property
    def wings(self) -> list[str]:
        """Names of the wings, in the order of adjustments."""
        return [name for name, _ in self._core.wings]

    def fly(
        self,
        *,
        out: str | os.PathLike[str] | None = None,
        progress: bool | Progress | None = None,
        frames: bool = True,
    ) -> Run:
        """Flies it to its end, in memory or into the new result directory ``out``; a folder that exists is refused.

        ``progress`` is called with steps done and all steps; True shows a bar (tqdm where there is one). ``frames=False``
        keeps no surfaces and wakes in memory. Other threads run meanwhile. Ctrl-C stops the flight: with ``out`` its
        state is saved, and ``wingbeat resume`` goes on from it. Whatever exception ends a flight, what was flown is its
        ``run``: None if it ended at its start, or if a second Ctrl-C did not wait for the files of the first.
        """
        folder = None if out is None else path("out", out)
        if out is not None and self._core.is_own:
            raise CaseError(
                "out: this flight has parts written in Python, which no case of a result holds",
                key="out",
                remedy="fly() in memory, then run.write(FOLDER)",
            )
        bar = shown(progress, self.name, "step")
        frames = flag("frames", frames)
        try:
            run, error = self._core.fly(folder, bar, frames)
        except BaseException as error:
            _keep(error, None)
            raise
        if error is not None:
            _keep(error, None if run is None else Run(run))
            raise error
        assert run is not None
        return Run(run)

    def start(self) -> Stepper:
        """The flight before its first step, to be flown step by step."""
        try:
            return Stepper(self._core.start())
        except BaseException as error:
            _keep(error, None)
            raise

    def trim(
        self,
        *,
        forward_m_per_s: float = 0.0,
        sideslip_m_per_s: float = 0.0,
        climb_m_per_s: float = 0.0,
        turn_rate_rad_per_s: float = 0.0,
        unknowns: Sequence[str] | None = None,
        bounds: Mapping[str, tuple[float, float]] | None = None,
        steps: int = 100,
    ) -> Trim:
        """Steady flight with this mean velocity (forward, to the right, up) and turn (to the right) as a periodic orbit, in
        air without memory, feedback left out, and the tether of a case that has one (``flight.mode``). Three ``unknowns`` are
        chosen by it; six where the flight turns, slips or has wings that differ; those beyond for least power. ``bounds`` are
        of unknowns, in radians, parts of 1, wingbeats (``feathering_lead``) and wing lengths forward (``mass_centre``). See
        docs/flight-mechanics.md.
        """
        velocity = _velocity(forward_m_per_s, sideslip_m_per_s, climb_m_per_s)
        turn_rate = finite("turn_rate_rad_per_s", turn_rate_rad_per_s)
        return Trim(self._core.trim(_asked(velocity, turn_rate, unknowns, bounds), whole("steps", steps, 20, 2000)))

    def trim_with_wake(
        self,
        *,
        forward_m_per_s: float = 0.0,
        sideslip_m_per_s: float = 0.0,
        climb_m_per_s: float = 0.0,
        unknowns: Sequence[str] | None = None,
        bounds: Mapping[str, tuple[float, float]] | None = None,
        held_beats: int = 2,
        tolerance: float | None = None,
    ) -> WakeTrim:
        """The same in air with a memory (the vortex lattice, strips with ``air.blade.unsteady``) or with elastic wings, in the
        steps of the case. In the lattice the body is held for ``held_beats`` wingbeats while its wake grows, and the free
        wingbeat after them is the one that is trimmed: its residuals, forces over weight, within ``tolerance`` (2e-3 if it is
        left out). Some 10 to 30 such flights: minutes. In blade elements a periodic orbit is trimmed, wings and wakes of strips
        included, within 1e-6. A glider in the lattice is towed, within 1e-5: the first tow takes ``held_beats`` times of
        sqrt(R / g) / 4, R the wing length, and is doubled until the start of the wake is hardly felt.
        """
        asked = _asked(_velocity(forward_m_per_s, sideslip_m_per_s, climb_m_per_s), 0.0, unknowns, bounds)
        beats = whole("held_beats", held_beats, 1, 100)
        within = None if tolerance is None else real("tolerance", tolerance)
        return WakeTrim(self._core.trim_with_wake(asked, beats, within))

    def stability(self, **trim: Any) -> LinearModel:
        """Linear model about the trimmed flight; arguments are those of :meth:`trim`."""
        return self.trim(**trim).stability()

    def derivatives(self, **trim: Any) -> Derivatives:
        """Control derivatives about the trimmed flight; arguments are those of :meth:`trim`."""
        return self.trim(**trim).derivatives()

    def power(self, **trim: Any) -> Power:
        """Mechanical power of the trimmed flight; arguments are those of :meth:`trim`."""
        return self.trim(**trim).power()


    def wing_modes(self, *, count: int = 6, steady: bool = False) -> dict[str, WingModes]:
        """The ``count`` leading modes of each elastic wing by its name, in vacuum and with the added mass of the air: about
        the wing at rest, or with ``steady`` about its deformed steady state in the stream of the case (minutes in a wake).
        See docs/flexible-modes.md.
        """
        return wing_modes(self._core, whole("count", count, 1, 100), flag("steady", steady))

    def flutter(
        self,
        speeds_m_per_s: ArrayLike,
        *,
        modes: int = 3,
        disturbance: float = 1e-5,
        periods: float = 1.5,
        antisymmetric: bool = False,
        progress: bool | Progress | None = None,
    ) -> Flutter:
        """Vibrations about the deformed steady state in streams of these rising speeds, and where they begin to grow.

        ``modes`` of the deformed wing are disturbed by ``disturbance`` over its length, and the response is followed for
        ``periods`` of the first of them, with ``antisymmetric`` of mirror images against each other. ``progress`` is called with speeds done and all speeds. See docs/flexible-flutter.md.
        """
        shares = _share("disturbance", disturbance), _positive("periods", periods)
        how = whole("modes", modes, 1, 20), *shares, flag("antisymmetric", antisymmetric)
        speeds = [float(v) for v in reals("speeds_m_per_s", speeds_m_per_s).ravel()]
        return flutter(self._core, speeds, how, shown(progress, self.name, "speed"))


class Stepper:
    """A flight in progress. Its own controller and air, which are called within a step, cannot ask for it: they are refused;
    other threads wait for the end of the step.
    """

    def __init__(self, core: _core.Stepper) -> None:
        self._core = core

    def __repr__(self) -> str:
        try:
            return f"<wingbeat.Stepper after step {self.steps_done}>"
        except CaseError:  # asked by its own controller or air
            return "<wingbeat.Stepper within a step>"

    def __reduce__(self) -> NoReturn:
        raise CaseError(
            "a flight in progress cannot be pickled",
            key="stepper",
            remedy="keep the Flight: start() and as many steps give the same bits; copy() in the same process",
        )

    def copy(self) -> Stepper:
        """A second flight that goes on from here, with what was flown so far: to try commands, and to come back. Both give the
        same bits. A controller or air written in Python is called by both; those that remember (with ``reset`` or ``accept``)
        are refused, and so is the air of another program. A program that controls is started once more, with its memory.
        """
        return Stepper(self._core.copy())

    def __copy__(self) -> Stepper:
        return self.copy()

    def __deepcopy__(self, memo: dict[int, Any]) -> Stepper:
        return self.copy()

    def step(self, count: int = 1) -> int:
        """Makes up to ``count`` steps; how many were made before the end. An exception that ends the flight has what was flown as
        its ``run``.
        """
        number = whole("count", count, 0, sys.maxsize)
        self._core.check()
        try:
            return self._core.step(number)
        except BaseException as error:
            if self.is_finished:
                _keep(error, self.run)
            raise

    @property
    def steps_done(self) -> int:
        """Steps made: one that fails is not."""
        return self._core.steps_done

    @property
    def time_s(self) -> float:
        """Time after them [s]."""
        return self._core.time_s

    @property
    def is_finished(self) -> bool:
        """Whether it is at its end."""
        return self._core.is_finished

    @property
    def frame(self) -> Frame:
        """Surfaces and wakes now."""
        return Frame(self._core.frame())

    def air_velocity(self, points_m: ArrayLike) -> NDArray[Any]:
        """Velocity of the air at points, both N components of shape (n, 3) [m, m/s], a single point as (3,) too: vortex lattice
        only.
        """
        return self._core.air_velocity(points_m)

    @property
    def run(self) -> Run:
        """What was flown so far."""
        return Run(self._core.run())


def _keep(error: BaseException, run: Run | None) -> None:
    """What was flown goes with the exception that ended it."""
    error.run = run  # type: ignore[attr-defined]


def _made(source: Source) -> Flight:
    return Flight(source.core(), source)


def _velocity(forward: float, right: float, up: float) -> tuple[float, float, float]:
    return finite("forward_m_per_s", forward), finite("sideslip_m_per_s", right), finite("climb_m_per_s", up)


def _positive(name: str, value: float) -> float:
    number = real(name, value)
    if number <= 0.0:
        raise CaseError(f"{name} = {number}: not positive", key=name, remedy="a number above 0")
    return number


def _share(name: str, value: float) -> float:
    number = _positive(name, value)
    if number > 1.0:
        raise CaseError(f"{name} = {number}: more than the whole", key=name, remedy="a number above 0 and up to 1")
    return number


def _asked(
    velocity: tuple[float, float, float],
    turn_rate: float,
    unknowns: Sequence[str] | None,
    bounds: Mapping[str, tuple[float, float]] | None,
) -> _core._Asked:
    """What is asked of a trim."""
    names = None if unknowns is None or isinstance(unknowns, str) else list(unknowns)
    if unknowns is not None and (names is None or not all(isinstance(name, str) for name in names)):
        remedy = "as ('body_pitch', 'stroke_amplitude', 'stroke_offset')"
        raise CaseError(f"unknowns = {unknowns!r:.60}: not a list of names", key="unknowns", remedy=remedy)
    try:
        ranges = [(name, float(least), float(most)) for name, (least, most) in (bounds or {}).items()]
    except (AttributeError, TypeError, ValueError):
        raise CaseError(
            f"bounds = {bounds!r:.60}: not pairs by name", key="bounds", remedy="as {'stroke_amplitude': (-0.2, 0.2)}"
        ) from None
    return velocity, turn_rate, names, ranges


_SAMPLES, _JUMPS = 16, 5.0
"""Of so many samples or more, the step from the last to the first may be so many times the largest of the others."""


def _rows(name: str, angle: ArrayLike | Callable[[float], float], samples: int) -> list[list[float]]:
    """Rows of phase and angle over a wingbeat, its end the same as its start."""
    import numpy as np

    if callable(angle):
        samples = whole("samples", samples, 4, 100_000)
        angle = [real(f"{name}_deg", angle(k / samples)) for k in range(samples)]
    values = reals(f"{name}_deg", angle)
    if values.ndim != 1 or values.size < 4:
        raise CaseError(
            f"{name}_deg: an array of shape {values.shape}",
            key=f"{name}_deg",
            remedy="at least four equally spaced values over one wingbeat, the end left out",
        )
    phases = np.linspace(0.0, 1.0, values.size + 1)
    angles = np.append(values, values[0])
    steps = np.abs(np.diff(angles))
    if values.size >= _SAMPLES and steps[-1] > _JUMPS * steps[:-1].max():
        raise CaseError(
            f"{name}_deg: the angle jumps by {steps[-1]:.1f} deg at the end of the beat, from {values[-1]:.1f} to {values[0]:.1f}",
            key=f"{name}_deg",
            remedy="a function, or values, of a whole wingbeat that end where they began",
        )
    return [[float(phase), float(x)] for phase, x in zip(phases, angles, strict=True)]


def shown(progress: bool | Progress | None, name: str, unit: str) -> Progress | None:
    """What is called with the progress: True asks for a bar."""
    if progress is None or isinstance(progress, bool):
        return _bar(name, unit) if progress else None
    if not callable(progress):
        raise CaseError(
            f"progress = {progress!r:.60}: cannot be called",
            key="progress",
            remedy="True for a bar, or a function of what is done and of all",
        )
    return progress


def _bar(name: str, unit: str) -> Progress:
    """A bar of tqdm, or a line on the standard error."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return lambda done, of: print(f"\r{name}: {done}/{of}", end="\n" if done == of else "", file=sys.stderr)
    bar: Any = tqdm(total=None, desc=name, unit=unit)

    def show(done: int, of: int) -> None:
        bar.total = of
        bar.update(done - bar.n)
        if done == of:
            bar.close()

    return show
