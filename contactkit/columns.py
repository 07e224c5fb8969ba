"""The curves of a separation: the one table from which files, plots and results take names."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["COLUMNS", "Column"]


class Column(NamedTuple):
    """A curve of a result: its name in files, its unit, what it is."""

    name: str
    unit: str
    label: str


COLUMNS = (
    Column("time", "s", "time"),
    Column("gap", "m", "gap"),
    Column("speed", "m/s", "opening speed"),
    Column("pull", "N", "pull"),
    Column("meniscus_force", "N", "meniscus force"),
    Column("viscous_force", "N", "viscous force"),
    Column("newtonian_force", "N", "viscous force without limits"),
    Column("viscous_impulse", "N.s", "viscous impulse so far"),
    Column("limit", "-", "limit that acts"),
    Column("film_status", "-", "state of the film"),
)
