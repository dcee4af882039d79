"""What environments remember, to go on from there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from wingbeat.errors import CaseError

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class SavedState:
    """Everything that the environments remember between two steps. It can be pickled: environments with the same settings, here
    or in another process, go on from it with the same bits.
    """

    settings: dict[str, Any]
    """Of the environments, with the text of the case that is flown; of several flights all of them."""
    counts: NDArray[Any]
    """Seed, episodes since, control steps, integration steps, whether the episode is over; shape (environments, 5)."""
    numbers: NDArray[Any]
    """Of the episodes, shape (environments, any); of several flights rows that are shorter end in zeros."""
    regulators: NDArray[Any]
    """Of the regulators, likewise."""
    generator: tuple[int | None, dict[str, Any] | None, bool]
    """Seed and state of gymnasium's generator, None where it is not drawn yet; whether a seed was given."""

    def __repr__(self) -> str:
        return f"<wingbeat.gym.SavedState of {len(self.counts)} environments, task {self.settings['task']}>"

    def check(self, settings: dict[str, Any]) -> None:
        """Refuses environments with other settings."""
        for name, own in settings.items():
            saved = self.settings.get(name)
            if saved != own:
                told = _other(saved, own) if name == "flight" else f"{name} = {saved!r:.60}, here it is {own!r:.60}"
                raise CaseError(
                    f"state: it was saved with {told}", key="state", remedy="environments with the same settings and flight"
                )


def _other(saved: Any, own: Any) -> str:
    """What is said of a flight, or several, that are not those flown here."""
    if isinstance(saved, str) and isinstance(own, str):
        return "another flight"
    saved, own = ((x,) if isinstance(x, str) else tuple(x) for x in (saved, own))
    if len(saved) != len(own):
        return f"another number of flights, {len(saved)}: here there are {len(own)}"
    return f"another flight[{next(k for k, text in enumerate(own) if text != saved[k])}]"
