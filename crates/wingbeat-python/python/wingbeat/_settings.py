"""Keywords that all environments share: their types and defaults, once."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from difflib import get_close_matches
from typing import Any, TypedDict, TypeVar, get_type_hints


class Settings(TypedDict, total=False):
    """The keywords, as the table of :class:`wingbeat.gym.Environment` has them."""

    steps_per_beat: int
    controls_per_beat: int
    beats: int
    amplitude_limit: float
    angle_limit_rad: float
    delay: int
    position_noise_m: float
    velocity_noise_m_per_s: float
    tilt_noise_rad: float
    rate_noise_rad_per_s: float


DEFAULTS: Settings = {
    "steps_per_beat": 40,
    "controls_per_beat": 1,
    "beats": 100,
    "amplitude_limit": 0.2,
    "angle_limit_rad": 0.2,
    "delay": 0,
    "position_noise_m": 0.0,
    "velocity_noise_m_per_s": 0.0,
    "tilt_noise_rad": 0.0,
    "rate_noise_rad_per_s": 0.0,
}

_Init = TypeVar("_Init", bound=Callable[..., None])


def with_settings(init: _Init) -> _Init:
    """Shows the settings one by one in the signature of a constructor that takes them as ``**settings``."""
    types = get_type_hints(Settings)
    kept = [p for p in inspect.signature(init).parameters.values() if p.kind is not p.VAR_KEYWORD]
    shown = [
        inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=types[name])
        for name, default in DEFAULTS.items()
    ]
    setattr(init, "__signature__", inspect.Signature([*kept, *shown], return_annotation=None))  # noqa: B010
    return init


def check_known(of: str, settings: dict[str, Any], known: list[str]) -> None:
    """Refuses keywords of ``of`` that are not known with the nearest one."""
    for name in settings:
        if name not in known:
            near = get_close_matches(name, known, 1)
            remedy = f"did you mean {near[0]!r}?" if near else f"it has {', '.join(known)}"
            raise TypeError(f"wingbeat.gym.{of}() has no keyword {name!r}: {remedy}")
