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
    Column("asperity_force", "N", "meniscus force at the asperities"),
    Column("van_der_waals_force", "N", "van der Waals force"),
    Column("adhesion_force", "N", "adhesion of the solids"),
    Column("viscous_force", "N", "viscous force"),
    Column("newtonian_force", "N", "viscous force without limits"),
    Column("viscous_impulse", "N.s", "viscous impulse so far"),
    Column("limit", "-", "limit that acts"),
    Column("film_status", "-", "state of the film"),
    Column("mean_gap", "m", "gap without the vibration"),
    Column("mean_pull", "N", "pull, mean of a cycle"),
    Column("steady_pull", "N", "pull without vibration"),
    Column("travel", "m", "travel"),
    Column("overlap_area", "m2", "overlap of the wetted circles"),
    Column("couette_force", "N", "viscous drag"),
    Column("hysteresis_force", "N", "force of contact lines that stick"),
    Column("tangential_force", "N", "tangential force"),
    Column("couette_impulse", "N.s", "viscous impulse of the slide so far"),
    Column("tangential_impulse", "N.s", "tangential impulse so far"),
)
