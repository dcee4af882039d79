"""What came of a campaign."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

from wingbeat import _core
from wingbeat._packages import needs
from wingbeat.campaign import _names
from wingbeat.campaign._points import Points
from wingbeat.campaign._task import Found

if TYPE_CHECKING:
    import xarray
    from numpy.typing import NDArray

NOT_FLOWN = "not flown"


class Table(Mapping[str, "NDArray[Any]"]):
    """Numbers of all points, in their order: an array over the points for each name and key, NaN where a point failed."""

    def __init__(self, points: Points, units: Mapping[str, str], case_text: str) -> None:
        import numpy as np

        self._points = points
        self._values = {name: np.full(len(points), np.nan) for name in units}
        self._units = dict(units)
        self._case_text = case_text
        self._reasons = [NOT_FLOWN] * len(points)
        self.flown = 0
        """How many points were flown now; others were in the folder ``out``."""

    def _put(self, index: int, found: Found) -> None:
        values, self._reasons[index] = found
        for column, value in zip(self._values.values(), values or (), strict=bool(values)):
            column[index] = value

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._values[name] if name in self._values else self._points.columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter([*self._points.columns, *self._values])

    def __len__(self) -> int:
        return len(self._points.columns) + len(self._values)

    def __repr__(self) -> str:
        bad = Counter(reason for reason in self._reasons if reason)
        failed = f", {bad.total()} without numbers, most often: {bad.most_common(1)[0][0]}" if bad else ""
        return f"<wingbeat.campaign.Table: {len(self._points)} points of {', '.join(self._values)}{failed}>"

    def _repr_html_(self) -> str:
        shown: str = self.dataset._repr_html_()
        return shown

    @property
    def reasons(self) -> list[str]:
        """Why a point has no numbers; empty texts where it has."""
        return list(self._reasons)

    @property
    def ok(self) -> NDArray[Any]:
        """Whether a point has numbers."""
        import numpy as np

        return np.array([not reason for reason in self._reasons])

    @property
    def units(self) -> dict[str, str]:
        """Units of keys and numbers."""
        return {key: _names.unit(key) for key in self._points.columns} | self._units

    @cached_property
    def dataset(self) -> xarray.Dataset:
        """The table as a dataset over ``point``, the keys as coordinates, with ``units`` and ``long_name`` (of
        keys, and of what flights give), ``reason`` and the case (``case_toml``) as an attribute. Needs xarray.
        """
        needs("xarray", "data", "dataset")
        import numpy as np
        import xarray

        units = self.units

        def variable(name: str) -> tuple[list[str], NDArray[Any], dict[str, str]]:
            array = self[name]
            inner = [f"{name}_{k}" for k in range(1, array.ndim)]
            about = _core.described(name)
            unit = {"units": units[name]} if array.dtype.kind in "iuf" else {}  # texts and switches have none
            return ["point", *inner], array, unit | ({"long_name": about} if about else {})

        numbers: dict[str, Any] = {name: variable(name) for name in self._values}
        numbers["reason"] = ("point", np.array(self._reasons, dtype=str), {"long_name": "why a point has no numbers"})
        keys = {key: variable(key) for key in self._points.columns}
        notes = {"wingbeat_version": _core.version()} | ({"case_toml": self._case_text} if self._case_text else {})
        return xarray.Dataset(numbers, coords=keys, attrs=notes)
