"""Numbers of a flight by name, and their units."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from wingbeat import _core
from wingbeat.errors import CaseError

_beats, _summary, _powers = _core.names_of_numbers()
BEATS = tuple(_beats)
"""Means over wingbeats."""
SUMMARY = tuple(_summary)
"""Numbers of the summary: way and turn from start to end by components; ``verdict``: 0 green, 1 amber, 2 red; how many ``warnings``."""
POWER = tuple(_powers)
ATTITUDE = ("body_pitch_rad", "body_roll_rad", "period_s", "iterations")
ADJUSTMENT = (
    "stroke_amplitude",
    "stroke_offset_rad",
    "feathering_amplitude",
    "feathering_offset_rad",
    "feathering_lead_wingbeats",
    "deviation_offset_rad",
    "stroke_plane_rad",
    "frequency",
)
"""What trim adds to the motion of the wings."""
TRIM_OPTIONS = ("forward_m_per_s", "sideslip_m_per_s", "climb_m_per_s", "turn_rate_rad_per_s")
"""What points may ask of a trim, as ``trim.forward_m_per_s``."""

# Endings of names, the longest that fits counts; those of keys are the endings of docs/case-keys.md. Two units are those of the
# columns of a table. Lengths in chords and times in wingbeats are numbers.
_UNITS = {
    "m": "m",
    "mm": "mm",
    "m2": "m2",
    "s": "s",
    "hz": "Hz",
    "kg": "kg",
    "mg": "mg",
    "kg_m": "kg m",
    "kg_m2": "kg m2",
    "kg_m3": "kg m-3",
    "kg_per_m": "kg m-1",
    "density_kg_m2": "kg m-2",
    "table_m_kg_m2": "m, kg m-2",
    "kg_m_per_s": "kg m s-1",
    "kg_m2_per_s": "kg m2 s-1",
    "m_s": "m s-1",
    "m_per_s": "m s-1",
    "m_s2": "m s-2",
    "m_per_s2": "m s-2",
    "m2_s": "m2 s-1",
    "m2_per_s": "m2 s-1",
    "1_s": "s-1",
    "per_s": "s-1",
    "s_per_rad": "s rad-1",
    "per_rad2": "rad-2",
    "deg": "degree",
    "deg_s": "degree s-1",
    "rad": "rad",
    "rad_per_s": "rad s-1",
    "rad_per_s2": "rad s-2",
    "newton": "N",
    "newton_m": "N m",
    "newton_m2": "N m2",
    "newton_m_m2": "N m, N m2",
    "newton_m_s": "N m s",
    "newton_m_per_rad": "N m rad-1",
    "newton_m_s_per_rad": "N m s rad-1",
    "newton_per_m": "N m-1",
    "newton_s": "N s",
    "newton_s_m": "N s m-1",
    "newton_s_per_m": "N s m-1",
    "pa": "Pa",
    "watt": "W",
    "watt_per_kg": "W kg-1",
    "joule": "J",
}


def unit(name: str) -> str:
    """The unit that a name ends in, ``1`` where it has none: ``motion.frequency_hz`` is in Hz."""
    parts = name.rsplit(".", 1)[-1].split("_")
    for start in range(1, len(parts)):
        found = _UNITS.get("_".join(parts[start:]))
        if found is not None:
            return found
    return "1"


def of_task(do: str) -> tuple[str, ...]:
    """Names of what a flight (``fly``) or a trim (``trim``) gives."""
    return BEATS + SUMMARY if do == "fly" else POWER + ATTITUDE + ADJUSTMENT


_DEFAULT = {"fly": ("lift_over_weight", "power_watt"), "trim": ("perfect_storage_watt", "body_pitch_rad", "body_roll_rad")}


def kept(keep: Iterable[str] | Mapping[str, str] | None, do: Any) -> dict[str, str]:
    """Names that are kept and their units, checked against those of the task; by default those of a task that has a name."""
    if keep is None:
        keep = _DEFAULT.get(do, ()) if isinstance(do, str) else ()
    if isinstance(keep, str):
        keep = (keep,)
    units = dict(keep) if isinstance(keep, Mapping) else {name: unit(name) for name in _texts(keep)}
    if not units:
        raise CaseError("keep: no name is given", key="keep", remedy="e.g. ['lift_over_weight', 'power_watt']")
    if isinstance(do, str):
        known = of_task(do)
        for name in units:
            if name not in known:
                why = f"keep = {name!r}: no number of do={do!r} has this name"
                raise CaseError(why, key="keep", remedy=_remedy(name, known))
    return units


def _texts(names: Iterable[str]) -> list[str]:
    listed = list(names)
    wrong = [name for name in listed if not isinstance(name, str)]
    if wrong:
        raise CaseError(f"keep: {wrong[0]!r} is no name", key="keep", remedy="names as texts, e.g. 'power_watt'")
    twice = [name for name in listed if listed.count(name) > 1]
    if twice:
        raise CaseError(f"keep: {twice[0]} is there twice", key="keep", remedy="each name once")
    return listed


def _remedy(name: str, known: Iterable[str]) -> str:
    from difflib import get_close_matches

    near = get_close_matches(name, list(known), 1)
    hint = f"did you mean {near[0]}? " if near else ""
    return f"{hint}There are {', '.join(known)}; others by a function as do="
