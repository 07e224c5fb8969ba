"""A quantity of a result: its name in files, its unit, its label, and how it is drawn."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["Column"]


class Column(NamedTuple):
    """Name, unit and label of a quantity in tables, files, plots and FMUs.

    `color` and `style` are those of its line in a figure, as matplotlib takes them; without a
    colour a figure takes the next free one.

    Examples
    --------
    >>> force = Column("meniscus_force", "N", "meniscus force")
    >>> force.heading, force.impulse.heading, force.impulse.label
    ('meniscus_force [N]', 'meniscus_impulse [N.s]', 'impulse of the meniscus force')
    """

    name: str
    unit: str
    label: str
    color: str | None = None
    style: str = "-"

    @property
    def heading(self) -> str:
        """Name and unit, at the head of a table."""
        return f"{self.name} [{self.unit}]"

    @property
    def impulse(self) -> Column:
        """Time integral of a force."""
        name = self.name.removesuffix("_force") + "_impulse"
        return Column(name, f"{self.unit}.s", f"impulse of the {self.label}", self.color, ":")

    @property
    def work(self) -> Column:
        """Work of a force."""
        name = self.name.removesuffix("_force") + "_work"
        return Column(name, "J", f"work of the {self.label}", self.color, ":")
