"""Curves of a separation that belong to no effect: its motion, and the state of its film."""

from __future__ import annotations

from types import MappingProxyType

from ..scene.column import Column

__all__ = ["COLUMNS"]

COLUMNS = MappingProxyType(
    {
        column.name: column
        for column in (
            Column("time", "s", "time"),
            Column("gap", "m", "gap", "#1f4e79"),
            Column("speed", "m/s", "opening speed", "#7f7f7f"),
            Column("pull", "N", "pull", "#6a4c93", "--"),
            Column("film_status", "-", "state of the film"),
            Column("mean_gap", "m", "gap without the vibration"),
            Column("mean_pull", "N", "pull, mean of a cycle", "#6a4c93"),
            Column("steady_pull", "N", "pull without vibration", "#1f4e79", "--"),
        )
    }
)
"""Columns by their names; each effect adds its own, see `Plan.columns`."""
