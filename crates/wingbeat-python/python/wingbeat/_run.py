"""Flights that were flown, and result directories."""

from __future__ import annotations

import html
import json
import operator
import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from wingbeat import _core
from wingbeat._case import Part
from wingbeat._frame import Frame
from wingbeat._packages import needs
from wingbeat._paths import path
from wingbeat.errors import CaseError

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure
    from numpy.typing import NDArray


def read(dir: str | os.PathLike[str]) -> Run:
    """Opens a result directory, of a flight that is finished or not, written from Python or by the program.

    Raises :class:`wingbeat.ResultError` for a directory that holds no run, or whose files were changed.
    """
    return Run(_core.Run.read(path("dir", dir)))


@dataclass(frozen=True, slots=True)
class Estimate:
    """A mean over wingbeats."""

    mean: float
    standard_error: float | None
    """Of the mean, the correlation of neighbouring beats and Student's factor counted in; None of fewer than three values."""


class Beats(Mapping[str, "NDArray[Any]"]):
    """Means over every whole wingbeat, those of summary and figures: an array for each quantity.

    ``beat`` (numbers from 1), ``lift_newton``, ``lift_over_weight`` (NaN without gravity), ``thrust_newton``,
    ``side_force_newton`` (along n2), ``power_watt``, ``positive_power_watt`` (its positive part, joint by joint),
    ``lift_coefficient``, ``thrust_coefficient`` (forces over the mean dynamic pressure on the wings; NaN in a vacuum),
    ``inviscid_lift_newton``, ``lift_by_impulse_newton`` (both NaN without a lattice).
    """

    def __init__(self, beats: list[dict[str, Any]], means: dict[str, Any] | None) -> None:
        import numpy as np

        names = list(beats[0]) if beats else ["beat", "lift_newton", "lift_over_weight", "thrust_newton", "power_watt"]
        self._arrays: dict[str, NDArray[Any]] = {}
        for name in names:
            column = [row[name] for row in beats]
            kind = np.int64 if name == "beat" else np.float64
            array = np.array([np.nan if x is None else x for x in column], dtype=kind)
            array.setflags(write=False)
            self._arrays[name] = array
        estimates = {k: v for k, v in (means or {}).items() if isinstance(v, dict)}
        self.means: Mapping[str, Estimate] = MappingProxyType({k: Estimate(**v) for k, v in estimates.items()})
        """Means over all but the first wingbeats (two, or those of a start or hold) with their errors; empty of too few."""
        known = (means or {}).get("is_known", True)
        self.is_steady: bool | None = (means or {}).get("is_steady") if known else None
        """Whether lift and force stay from the first half of these beats to the second; None of fewer than five, or of beats
        too few or too scattered to tell."""

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._arrays[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    def __repr__(self) -> str:
        return f"<wingbeat.Beats: {self['beat'].size} wingbeats of {', '.join(self)}>"


class Run:
    """A flight that was flown.

    Its arrays are read-only, hold what the core computed without copies, and live as long as they are held.
    """

    def __init__(self, core: _core.Run) -> None:
        self._core = core

    def __repr__(self) -> str:
        where = f" in {self.dir}" if self.dir else ""
        return f"<wingbeat.Run {self.outcome}, {self.summary['verdict']}: {self._core.rows} rows{where}>"

    def __reduce__(self) -> tuple[Callable[[str], Run], tuple[str]]:
        if self.dir is None:
            raise CaseError(
                "a run in memory cannot be copied or pickled",
                key="out",
                remedy="dict(run.arrays) and run.case_text, or fly(out=DIR): such a run is read again from its directory",
            )
        return read, (os.fspath(self.dir),)

    def _repr_html_(self) -> str:
        page = self._core.page()
        text = f"<pre>{html.escape(self.summary_text)}</pre>"
        if page is None:
            return text
        frame = f'<iframe srcdoc="{html.escape(page)}" style="width:100%;height:600px;border:0"></iframe>'
        return frame + text

    @property
    def dir(self) -> Path | None:
        """The result directory; None of a flight in memory."""
        return None if self._core.dir is None else Path(self._core.dir)

    @property
    def case_text(self) -> str:
        """The case with everything filled in, as TOML."""
        return self._core.case_text

    @property
    def case(self) -> Part:
        """The same as a dict whose keys are attributes."""
        import tomllib

        return Part(tomllib.loads(self.case_text))

    @property
    def outcome(self) -> str:
        """``finished``, ``interrupted``, ``failed``, ``unwritten`` or ``running``."""
        return self._core.outcome[0]

    @property
    def why(self) -> str:
        """Why it failed or was not written; empty otherwise."""
        return self._core.outcome[1]

    @cached_property
    def arrays(self) -> Mapping[str, NDArray[Any]]:
        """The history, a read-only array of shape (rows,) for each column of ``history.csv``; counts are int64."""
        return MappingProxyType(self._core.history())

    @cached_property
    def history(self) -> xarray.Dataset:
        """The history as a dataset over ``time_s``: the columns of ``history.csv`` with ``units``, ``long_name``,
        ``frame`` and ``symbol``, the case (``case_toml``) as an attribute. Needs xarray.
        """
        needs("xarray", "data", "history")
        import xarray

        variables = {}
        for name, unit, frame, symbol, about in self._core.columns():
            notes = {"units": unit, "long_name": about, "frame": frame}
            variables[name] = ("time_s", self.arrays[name], notes | ({"symbol": symbol} if symbol else {}))
        time = variables.pop("time_s")
        notes = {"case_toml": self.case_text, "outcome": self.outcome, "wingbeat_version": _core.version()}
        return xarray.Dataset(variables, coords={"time_s": time}, attrs=notes)

    @cached_property
    def summary(self) -> Mapping[str, Any]:
        """The numbers of ``summary.json``: residuals of balances, wingbeats, warnings, ..."""
        return MappingProxyType(json.loads(self._core.summary()[0]))

    @property
    def summary_text(self) -> str:
        """What happened, in words, and how far to trust it."""
        return self._core.summary()[1]

    @cached_property
    def beats(self) -> Beats:
        """Means over every whole wingbeat."""
        return Beats(self.summary["beats"], self.summary["means"])

    @property
    def frame_steps(self) -> list[int]:
        """Steps whose surfaces and wakes were kept (``output.frames_every``)."""
        return self._core.frame_steps()

    def frame(self, step: int) -> Frame:
        """Surfaces and wakes of one of :attr:`frame_steps`; negative numbers count from the last of them."""
        try:
            step = operator.index(step)
        except TypeError:
            raise CaseError(f"step = {step!r}: a frame is that of a step", key="step", remedy="a whole number, one of frame_steps") from None
        steps = self.frame_steps
        if step < 0 and -step <= len(steps):
            step = steps[step]
        if step not in steps:
            few = ", ".join(map(str, steps[:3])) + (f", ... {steps[-1]}" if len(steps) > 3 else "")
            have = f"there are frames of the steps {few}" if steps else "there are none"
            raise CaseError(
                f"step = {step}: there is no frame of it, {have}", key="step", remedy="one of frame_steps; output.frames_every keeps more"
            )
        return Frame(self._core.frame(step))

    def plot(self, kind: str | None = None) -> Figure:
        """A figure over time drawn with matplotlib, of the same definitions as ``wingbeat plot``.

        ``kind`` is ``forces``, ``trajectory``, ``angles``, ``commands``, ``bending`` (of elastic wings) or ``balances``; the
        first that the flight has if it is left out. The program draws all others, from a result directory.
        """
        charts = dict(self._core.charts())
        name = next(iter(charts)) if kind is None else kind
        if name not in charts:
            raise CaseError(
                f"kind = {name!r}: this flight has no such figure over time",
                key="kind",
                remedy=f"one of {', '.join(charts)}; `wingbeat plot DIR` draws all others",
            )
        needs("matplotlib", "plot", "plot")
        import matplotlib.pyplot as plt

        title, x_label, x, panels = charts[name]
        size = (8, 1.2 + 1.8 * len(panels))
        figure, grid = plt.subplots(len(panels), 1, sharex=True, squeeze=False, figsize=size, layout="constrained")
        figure.suptitle(title)
        for axes, (label, lines, shaded) in zip(grid[:, 0], panels, strict=True):
            for line, values in lines:
                axes.plot(x, values, label=line)
            for start, end in shaded:
                axes.axvspan(start, end, color="0.92", zorder=0)
            axes.set_ylabel(label)
            if len(lines) > 1:
                axes.legend()
        grid[-1, 0].set_xlabel(x_label)
        return figure

    def write(self, dir: str | os.PathLike[str]) -> None:
        """Writes ``history.csv``, ``summary.txt`` and ``summary.json`` into the new folder ``dir``: numbers for other programs,
        without the case that :func:`wingbeat.read` needs. ``fly(out=DIR)`` writes what it takes.
        """
        self._core.write(path("dir", dir))

    def export(
        self, format: str, into: str | os.PathLike[str] | None = None, *, overwrite: bool = False
    ) -> list[Path]:
        """Exports a result directory as ``hdf5``, ``parquet``, ``vtkhdf`` or ``gltf``; the files written."""
        folder = None if into is None else path("into", into)
        return [Path(file) for file in self._core.export(format, folder, overwrite)]
