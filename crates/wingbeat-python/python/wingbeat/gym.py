"""Environments for gymnasium: a flyer that is steered near its trimmed flight, in blade elements.

>>> import wingbeat.gym
>>> envs = wingbeat.gym.VectorEnvironment(64, "hover")
>>> observations, _ = envs.reset(seed=1)

or ``gymnasium.make("wingbeat/Hover-v0")``, ``gymnasium.make_vec(..., vectorization_mode="vector_entry_point")``; tasks
hover, recover (from a tumble), path (follow a target), gust. Needs gymnasium.

An episode is flown about the trimmed flight of ``flight``. R is the wing length, hinge to tip [m], T the wingbeat [s]. Level axes are forward,
right and down of the trimmed attitude at the start of a wingbeat: down along gravity, forward the horizontal part of b1.

**Actions**: four numbers in [-1, 1] (larger ones are cut), once per control step, over which the strokes go to them smoothly.
Times their limits they are

== ======================================================================= ===================
0  relative change of the stroke amplitude of all wings [1]                ``amplitude_limit``
1  mean stroke angle of all wings, forward [rad]                           ``angle_limit_rad``
2  relative amplitude of right wings less that of left ones [1]            ``amplitude_limit``
3  pitch of the stroke plane of right wings less that of left ones [rad]   ``angle_limit_rad``
== ======================================================================= ===================

**Observations**: 17 numbers, float32, without bounds.

===== ============================================================================================ ======
0-2   place of the mass centre less the target's, level axes                                       R
3-5   velocity u, v, w less that of the trimmed flight (not the target's)                           R / T
6-8   angular velocity p, q, r, likewise                                                           1 / T
9-11  tilt: rotation vector roll, pitch, heading from the trimmed attitude, level axes             rad
12-14 velocity of the target, level axes                                                           R / T
15-16 sine and cosine of the phase of the wingbeat                                                 1
===== ============================================================================================ ======

u, v, w and p, q, r are components along level axes that turn with the body; the trimmed flight that they are compared with is that
at the start of a wingbeat. Numbers 0 to 11 have the noise of the sensors, normal and of its own at each look, and are ``delay``
control steps old.

**Rewards**: of a control step ``exp(-cost) / controls_per_beat``, so one per wingbeat at most, with
``cost = 0.2 |place|^2 + |velocity|^2 + |tilt|^2 + 0.02 |action|^2`` of the numbers 0 to 5 and 9 to 11 above (R, R / T, rad) without
noise and delay, and of the action; 0 in the step in which the flyer is lost.

**Ends**: terminated where the flyer is lost: farther than 20 R from its target, tilted by more than 2.5 rad, or its numbers
no longer finite; truncated after ``beats`` wingbeats.

**Starts**: each component is drawn evenly within +- of these, about the trimmed flight at the start of a wingbeat; the velocity
along level axes that do not turn with the body, tilt and rate as they are observed.

======= ========== ============== =============== ==================================================================
task    tilt [rad] velocity [R/T] rate [1/T]      what else
======= ========== ============== =============== ==================================================================
hover   0.1        0.05           0.02            the target is the trimmed flight
recover 1.2        0.05           0.2             a tumble
path    0.1        0.05           0.02            the target goes round a level circle of radius 4 R to the right, once in
                                                  100 wingbeats: 0.25 R / T
gust    0.1        0.05           0.02            one horizontal gust, see below
======= ========== ============== =============== ==================================================================

The gust is a single pulse that is even in space, no turbulence: it rises and falls as ``(1 - cos(2 pi t / (4 T))) / 2`` over four
wingbeats. Its peak is drawn evenly from 0.2 to 0.5 R / T, its direction from all horizontal ones, its beginning from 2 T to 20 T
after the start. Starts and noise of the sensors follow from the seed of ``reset`` and the number of the episode since.

**Several flights**: a :class:`VectorEnvironment` takes a list or tuple of them as ``flight``, and environment k flies
``flight[k % len(flight)]``: animals, airs and strokes that are drawn, say. Each has its own trimmed flight, R, T, target and
regulator; ``wing_lengths_m`` and ``periods_s`` are R and T of each environment. Keywords are the same for all: steps are parts of
each flyer's own wingbeat, so that one control step is as many wingbeats of all, not as many seconds; noise has its SI units.

``save()`` gives what environments remember, which can be pickled, and ``restore(state)`` goes on from there with the same
bits: to try several actions from one state, or to go on another day.
"""

from __future__ import annotations

import operator
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any, Unpack

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space

from wingbeat._fleet import CONTROLS as _CONTROLS
from wingbeat._fleet import TASKS, Fleet, Uncopied
from wingbeat._flight import Flight
from wingbeat._flyers import check_one
from wingbeat._numbers import reals, whole
from wingbeat._saved import SavedState
from wingbeat._settings import Settings, with_settings
from wingbeat.errors import CaseError

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["TASKS", "Environment", "SavedState", "VectorEnvironment"]


def _seed(number: Any) -> int:
    """A whole number that is not negative, as gymnasium has seeds."""
    try:
        plain = -1 if isinstance(number, bool) else operator.index(number)
    except TypeError:
        plain = -1
    if plain < 0:
        raise CaseError(f"seed = {number!r:.60}: out of range", key="seed", remedy="a whole number from 0 on")
    return plain


def _check_options(options: dict[str, Any] | None, *known: str) -> None:
    """Refuses options of ``reset`` that are not known."""
    if options is not None and not isinstance(options, Mapping):
        remedy = f"a dict with {', '.join(known)}, or None" if known else "leave it out"
        raise CaseError(f"options = {options!r:.60}: no dict", key="options", remedy=remedy)
    for name in options or {}:
        if name not in known:
            near = get_close_matches(str(name), known, 1)
            remedy = f"did you mean {near[0]}?" if near else f"one of {', '.join(known)}" if known else "leave it out"
            raise CaseError(f"options: {name!r} is not known", key="options", remedy=remedy)


class Environment(Uncopied, gymnasium.Env[Any, Any]):
    """One flyer.

    ========================== =========== ================= ============================================================
    keyword                    default     allowed           what
    ========================== =========== ================= ============================================================
    ``task``                   ``"hover"`` ``TASKS``         what is to be done
    ``flight``                 None        in blade elements the flyer, one; None: the preset ``fruit-fly-blade``
    ``steps_per_beat``         40          20 to 2000        integration steps of a wingbeat
    ``controls_per_beat``      1           1 and more        control steps of a wingbeat, a divisor of ``steps_per_beat``
    ``beats``                  100         1 to 1e6          wingbeats of an episode
    ``amplitude_limit``        0.2         0 to 0.5          largest actions 0 and 2 [1]
    ``angle_limit_rad``        0.2         0 to 0.5          largest actions 1 and 3 [rad]
    ``delay``                  0           0 to 10000        control steps from sensing to observing
    ``position_noise_m``       0           0 to 1e3          standard deviation of places that are sensed, each component [m]
    ``velocity_noise_m_per_s`` 0           0 to 1e3          of velocities [m/s]
    ``tilt_noise_rad``         0           0 to 3            of the tilt [rad]
    ``rate_noise_rad_per_s``   0           0 to 1e5          of angular velocities [rad/s]
    ========================== =========== ================= ============================================================

    Axes and units of actions and observations, rewards, starts and ends: :mod:`wingbeat.gym`.
    """

    metadata = {"render_modes": []}  # noqa: RUF012

    @with_settings
    def __init__(
        self,
        task: str = "hover",
        *,
        flight: Flight | None = None,
        render_mode: None = None,
        **settings: Unpack[Settings],
    ) -> None:
        if render_mode is not None:
            raise CaseError("render_mode: there is none", key="render_mode", remedy="leave it out")
        check_one(flight)
        self._fleet = Fleet(1, task, "disabled", flight=flight, **settings)
        self.observation_space = self._fleet.observation_space
        self.action_space = self._fleet.action_space

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """A new episode; the first of ``seed``, else the next one. Before any seed ``np_random_seed`` is drawn at random, which
        repeats the episodes when it is given as the seed.
        """
        _check_options(options)
        seed = None if seed is None else _seed(seed)
        super().reset(seed=seed)
        self._fleet.reset([self._fleet.first(seed, self)], [True])
        return self._fleet.observed[0].copy(), {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """One control step."""
        fleet = self._fleet
        plain = reals("action", action, np.float32)
        if plain.shape != (_CONTROLS,):
            raise CaseError(f"action: an array of shape {plain.shape}", key="action", remedy=f"shape ({_CONTROLS},)")
        fleet.step(plain[np.newaxis])
        ended = bool(fleet.terminated[0]), bool(fleet.truncated[0])
        return fleet.observed[0].copy(), float(fleet.rewards[0]), *ended, {}

    def save(self) -> SavedState:
        """What it remembers now: :meth:`restore` goes on from there with the same bits, here or in another environment."""
        return self._fleet.save(self)

    def restore(self, state: SavedState) -> NDArray[np.float32]:
        """Goes on from what :meth:`save` of an environment with the same settings gave; the observation then."""
        self._fleet.restore(state, self)
        observed: NDArray[np.float32] = self._fleet.observed[0].copy()
        return observed

    def regulated(self) -> NDArray[np.float32]:
        """What the linear-quadratic regulator would do now, shape (4,): a baseline, with ``controls_per_beat=1`` and ``delay=0``.
        It goes by what is observed and by the actions that acted, whoever chose them.
        """
        actions: NDArray[np.float32] = self._fleet.regulated()[0]
        return actions


class VectorEnvironment(Uncopied, gymnasium.vector.VectorEnv[Any, Any, Any]):
    """Many flyers, stepped by one call on all threads. Keywords as those of :class:`Environment`.

    ``flight`` may be a list or tuple of flights here, of which environment k flies number ``k % len(flight)``; each is trimmed
    once. States that are saved are of these flights in this order.

    Observations, rewards and ends are arrays that the next step writes again: copy what is kept (``copy=True`` does it).
    ``autoreset_mode`` is ``NextStep``, ``SameStep`` (``info["final_obs"]``) or ``Disabled`` (``reset(options={"reset_mask": ...})``), as
    gymnasium has them.
    """

    @with_settings
    def __init__(
        self,
        num_envs: int = 1,
        task: str = "hover",
        *,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        copy: bool = True,
        flight: Flight | list[Flight] | tuple[Flight, ...] | None = None,
        render_mode: None = None,
        **settings: Unpack[Settings],
    ) -> None:
        try:
            mode = AutoresetMode(autoreset_mode)
        except ValueError:
            names = ", ".join(m.value for m in AutoresetMode)
            raise CaseError(f"autoreset_mode = {autoreset_mode!r:.60}", key="autoreset_mode", remedy=names) from None
        if render_mode is not None:
            raise CaseError("render_mode: there is none", key="render_mode", remedy="leave it out")
        self._fleet = Fleet(num_envs, task, mode.name.lower(), flight=flight, **settings)
        self._mode, self._copy = mode, copy
        self.num_envs = num_envs
        self.metadata = {"render_modes": [], "autoreset_mode": mode}
        self.render_mode = None
        self.single_observation_space = self._fleet.observation_space
        self.single_action_space = self._fleet.action_space
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """New episodes, of the seeds ``seed + k`` or those of a list; where ``options["reset_mask"]`` says, if given.

        Without a seed each is the next of its environment. Before any seed ``np_random_seed`` is drawn at random, which repeats
        the episodes when it is given as the seed; ``np_random`` follows from it, of a list from its first seed.
        """
        _check_options(options, "reset_mask")
        count = self.num_envs
        if isinstance(seed, Sequence | np.ndarray) and not isinstance(seed, str | bytes):
            seeds = [None if s is None else _seed(s) for s in seed]
            first = next((s for s in seeds if s is not None), None)
        else:
            first = None if seed is None else _seed(seed)
            begun = self._fleet.first(first, self)
            seeds = [None if begun is None else begun + k for k in range(count)]
        mask = np.ones(count, np.bool_) if options is None else options.get("reset_mask", np.ones(count, np.bool_))
        if len(seeds) != count:
            raise CaseError(f"seed: {len(seeds)} of them for {count} environments", key="seed", remedy=f"{count} seeds")
        if np.shape(mask) != (count,) or np.asarray(mask).dtype != bool:
            problem = f"reset_mask: an array of {np.asarray(mask).dtype}, shape {np.shape(mask)}"
            remedy = f"truth values, shape ({count},), True where an episode begins"
            raise CaseError(problem, key="reset_mask", remedy=remedy)
        super().reset(seed=first)
        self._fleet.reset(seeds, [bool(x) for x in mask])
        observed = self._fleet.observed
        return (observed.copy() if self._copy else observed), {}

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """One control step of all."""
        fleet = self._fleet
        ended = fleet.step(actions)
        info: dict[str, Any] = {}
        if ended and self._mode is AutoresetMode.SAME_STEP:
            done = fleet.terminated | fleet.truncated
            final = np.empty(self.num_envs, dtype=object)
            for k in np.flatnonzero(done):
                final[k] = fleet.last[k].copy()
            info = {"final_obs": final, "_final_obs": done, "final_info": {}, "_final_info": done.copy()}
        if self._copy:
            ends = fleet.terminated.copy(), fleet.truncated.copy()
            return fleet.observed.copy(), fleet.rewards.copy(), *ends, info
        return fleet.observed, fleet.rewards, fleet.terminated, fleet.truncated, info

    def save(self) -> SavedState:
        """What all remember now: :meth:`restore` goes on from there with the same bits, here or in other environments."""
        return self._fleet.save(self)

    def restore(self, state: SavedState) -> NDArray[np.float32]:
        """Goes on from what :meth:`save` of environments with the same settings gave; the observations then."""
        self._fleet.restore(state, self)
        return self._fleet.observed.copy() if self._copy else self._fleet.observed

    def regulated(self) -> NDArray[np.float32]:
        """What the linear-quadratic regulator would do now, shape (num_envs, 4): a baseline, with ``controls_per_beat=1`` and
        ``delay=0``. It goes by what is observed and by the actions that acted, whoever chose them.
        """
        return self._fleet.regulated()

    @property
    def wing_lengths_m(self) -> NDArray[np.float64]:
        """R of each environment, shape (num_envs,) [m]."""
        return self._fleet.scales[:, 0].copy()

    @property
    def periods_s(self) -> NDArray[np.float64]:
        """T of each environment, shape (num_envs,) [s]."""
        return self._fleet.scales[:, 1].copy()

    def distances_m(self) -> NDArray[np.float64]:
        """Distances of the mass centres from their targets, without noise, shape (num_envs,) [m]."""
        with self._fleet.alone() as core:
            return np.array(core.distances())

    def core_seconds(self, count: int) -> float:
        """Seconds that ``count`` control steps of all take within Rust: what Python adds is seen beside it."""
        with self._fleet.alone() as core:
            return core.core_seconds(whole("count", count, 0, 10**9))


for _task in TASKS:
    gymnasium.register(
        id=f"wingbeat/{_task.capitalize()}-v0",
        entry_point="wingbeat.gym:Environment",
        vector_entry_point="wingbeat.gym:VectorEnvironment",
        kwargs={"task": _task},
        order_enforce=False,
        disable_env_checker=True,
    )
