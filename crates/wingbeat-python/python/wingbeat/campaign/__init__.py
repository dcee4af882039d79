"""Many flights at once: the same thing done at each of many points, on the executor of your choice.

>>> from wingbeat import campaign
>>> points = campaign.grid({"motion.frequency_hz": [190, 200, 210]})
>>> table = campaign.map(points, campaign.Serial(), base="fruit-fly-blade", keep=["lift_over_weight"])
>>> table["lift_over_weight"].shape
(3,)

Results come in the order of the points, the same bits from every engine and any number of workers. How to use engines:
docs/campaigns-python.md.
"""

from __future__ import annotations

from wingbeat.campaign._directory import run
from wingbeat.campaign._engines import Processes, Ray, Serial
from wingbeat.campaign._map import map
from wingbeat.campaign._names import ADJUSTMENT, ATTITUDE, BEATS, POWER, SUMMARY
from wingbeat.campaign._points import grid
from wingbeat.campaign._table import Table

__all__ = ["ADJUSTMENT", "ATTITUDE", "BEATS", "POWER", "SUMMARY", "Processes", "Ray", "Serial", "Table", "grid", "map", "run"]
