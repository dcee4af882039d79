"""Environments in the core, with their arrays."""

from __future__ import annotations

import inspect
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from copy import deepcopy as copy_of
from typing import TYPE_CHECKING, Any, NoReturn, Self, Unpack

import gymnasium
import numpy as np

from wingbeat import _core
from wingbeat._flyers import Flyers
from wingbeat._numbers import reals, whole
from wingbeat._saved import SavedState
from wingbeat._settings import DEFAULTS, Settings, check_known
from wingbeat.errors import AnalysisError, CaseError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from wingbeat._flight import Flight

TASKS = tuple(_core.Fleet.TASKS)
OBSERVED, CONTROLS = _core.Fleet.OBSERVED, _core.Fleet.CONTROLS


_Gymnasium = gymnasium.Env[Any, Any] | gymnasium.vector.VectorEnv[Any, Any, Any]


def _bits(state: dict[str, Any]) -> np.random.BitGenerator:
    """The generator of this state, of the kind that it names."""
    bits: np.random.BitGenerator = getattr(np.random, state["bit_generator"])()
    bits.state = copy_of(state)
    return bits


def _size(key: str, number: float, most: float) -> float:
    if isinstance(number, bool) or not isinstance(number, int | float | np.number) or not 0.0 <= number <= most:
        raise CaseError(f"{key} = {number!r:.60}: out of range", key=key, remedy=f"a number from 0 to {most}")
    return float(number)


def _folded(seed: int) -> int:
    """The seed of the core, 64 bits: itself, or what larger ones are hashed to."""
    return seed if seed < 2**64 else int(np.random.SeedSequence(seed).generate_state(1, np.uint64)[0])


class Uncopied:
    """Flyers live in the compiled core: they are neither copied nor pickled. Keywords that are not known are refused with the
    nearest one.
    """

    def __new__(cls, *_arguments: Any, **settings: Any) -> Self:
        parameters = inspect.signature(cls.__init__).parameters
        is_open = any(p.kind is p.VAR_KEYWORD for p in parameters.values())
        if not is_open:
            known = [name for name, p in parameters.items() if p.kind is p.KEYWORD_ONLY]
            by_name = [name for name, p in parameters.items() if p.kind is p.POSITIONAL_OR_KEYWORD]
            check_known(cls.__name__, {name: settings[name] for name in settings if name not in by_name}, known)
        return super().__new__(cls)

    def __reduce__(self) -> NoReturn:
        raise CaseError(
            f"wingbeat.gym.{type(self).__name__} cannot be copied or pickled: its flyers cannot",
            key="environment",
            remedy="keep its settings and save(), from which restore() goes on; or seed and actions since reset(seed=...)",
        )


class Fleet(Uncopied):
    """Environments in the core, and their arrays."""

    def __init__(
        self,
        count: int,
        task: str,
        autoreset: str,
        *,
        flight: Flight | list[Flight] | tuple[Flight, ...] | None = None,
        **given: Unpack[Settings],
    ) -> None:
        check_known("Environment", {**given}, list(DEFAULTS))
        chosen = DEFAULTS | given
        steps = whole("steps_per_beat", chosen["steps_per_beat"], 20, 2000)
        controls = whole("controls_per_beat", chosen["controls_per_beat"], 1, steps)
        if steps % controls:
            raise CaseError(
                f"controls_per_beat = {controls}: {steps} steps are no whole number for each",
                key="controls_per_beat",
                remedy="a divisor of steps_per_beat",
            )
        settings = {
            "task": task,
            "interval": steps // controls,
            "beats": whole("beats", chosen["beats"], 1, 1_000_000),
            "amplitude_limit": _size("amplitude_limit", chosen["amplitude_limit"], 0.5),
            "angle_limit_rad": _size("angle_limit_rad", chosen["angle_limit_rad"], 0.5),
            "delay": whole("delay", chosen["delay"], 0, 10_000),
            "position_noise_m": _size("position_noise_m", chosen["position_noise_m"], 1e3),
            "velocity_noise_m_per_s": _size("velocity_noise_m_per_s", chosen["velocity_noise_m_per_s"], 1e3),
            "tilt_noise_rad": _size("tilt_noise_rad", chosen["tilt_noise_rad"], 3.0),
            "rate_noise_rad_per_s": _size("rate_noise_rad_per_s", chosen["rate_noise_rad_per_s"], 1e5),
        }
        if not isinstance(task, str) or task not in TASKS:
            raise CaseError(f"task = {task!r:.60}: not known", key="task", remedy=", ".join(TASKS))
        self.count = whole("num_envs", count, 1, 1_000_000)
        flyers = Flyers(flight)
        courses = flyers.courses(steps, settings)
        self._unregulated = next((k for k, course in enumerate(courses) if not course.is_regulated), None)
        self._flyers = flyers.names
        self.is_seeded = False
        """Whether episodes have begun, by ``reset`` or ``restore``."""
        self._lock = threading.Lock()
        turns = np.arange(self.count) % len(courses)
        self.scales = np.array([course.scales for course in courses])[turns]
        told = {"num_envs": self.count, "steps_per_beat": steps, "controls_per_beat": controls, "flight": flyers.case_texts}
        self._settings = settings | {"autoreset_mode": autoreset} | told
        seeds = np.random.default_rng().integers(2**63, size=self.count)  # until reset() gives others
        self.core = _core.Fleet(courses, autoreset, [int(s) for s in seeds])
        self.observed = np.zeros((self.count, OBSERVED), np.float32)
        self.last = np.zeros((self.count, OBSERVED), np.float32)
        self.rewards = np.zeros(self.count)
        self.terminated = np.zeros(self.count, np.bool_)
        self.truncated = np.zeros(self.count, np.bool_)
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (OBSERVED,), np.float32)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (CONTROLS,), np.float32)

    def first(self, seed: int | None, of: _Gymnasium) -> int | None:
        """The seed to begin with: before any was given that which gymnasium draws for its own generator."""
        is_drawn = seed is None and not self.is_seeded
        drawn = of.np_random_seed if is_drawn else seed
        return None if drawn is None or drawn < 0 else drawn  # negative: a generator of the user's

    @contextmanager
    def alone(self) -> Iterator[_core.Fleet]:
        """The environments, which one thread has at a time."""
        if not self._lock.acquire(blocking=False):
            raise CaseError(
                "another thread steps these environments, or they are asked within their own step",
                key="environment",
                remedy="an environment for each thread, or a threading.Lock about its calls",
            )
        try:
            yield self.core
        finally:
            self._lock.release()

    def _check_begun(self, call: str) -> None:
        if not self.is_seeded:
            raise gymnasium.error.ResetNeeded(f"{call}() before reset(): no episode has begun; call reset(seed=...) first")

    def reset(self, seeds: Sequence[int | None], mask: Sequence[bool]) -> None:
        with self.alone() as core:
            core.reset([None if s is None else _folded(s) for s in seeds], list(mask), self.observed)
            self.is_seeded = True

    def save(self, of: _Gymnasium) -> SavedState:
        generator = of._np_random
        drawn = None if generator is None else copy_of(dict(generator.bit_generator.state))
        with self.alone() as core:
            return SavedState(dict(self._settings), *core.save(), (of._np_random_seed, drawn, self.is_seeded))

    def restore(self, state: Any, of: _Gymnasium) -> None:
        if not isinstance(state, SavedState):
            raise CaseError(f"state = {state!r:.60}: none", key="state", remedy="what save() gave")
        state.check(self._settings)
        with self.alone() as core:
            counts, numbers, regulators = map(np.ascontiguousarray, (state.counts, state.numbers, state.regulators))
            core.restore(counts, numbers, regulators, self.observed)
            of._np_random_seed, drawn, self.is_seeded = state.generator
            of._np_random = None if drawn is None else np.random.Generator(_bits(drawn))

    def step(self, actions: Any) -> bool:
        """Whether any episode has ended."""
        plain = reals("actions", actions, np.float32)
        if plain.shape != (self.count, CONTROLS):
            remedy = f"shape ({self.count}, {CONTROLS})"
            raise CaseError(f"actions: an array of shape {plain.shape}", key="actions", remedy=remedy)
        self._check_begun("step")
        with self.alone() as core:
            return core.step(plain, self.observed, self.last, self.rewards, self.terminated, self.truncated)

    def regulated(self) -> NDArray[np.float32]:
        if self._settings["controls_per_beat"] != 1 or self._settings["delay"]:
            raise AnalysisError(
                "the regulator looks once per wingbeat, at once", remedy="controls_per_beat = 1 and delay = 0"
            )
        if self._unregulated is not None:
            which = self._flyers[self._unregulated]
            raise AnalysisError(f"{which}: no regulator can be made for it", remedy="actions of your own, or another flight")
        self._check_begun("regulated")
        actions = np.zeros((self.count, CONTROLS), np.float32)
        with self.alone() as core:
            core.regulate(actions)
        return actions
