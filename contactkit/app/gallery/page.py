"""Head of a page of the gallery: claim and verdict; checks; a table.

A script of a page is a module with ``PAGE``, ``compute(draft) -> data``, ``draw(data) -> figure``
(or several) and ``check(data) -> checks``, and, where numbers are to be read,
``table(data) -> Table``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from attrs import field, frozen
from attrs.validators import instance_of
from numpy.typing import NDArray

__all__ = ["Check", "Data", "Page", "Table"]

Data = Mapping[str, NDArray[Any]]
"""Everything that figure, checks and table need, by name; arrays that an npz file can hold."""


@frozen(kw_only=True)
class Page:
    """Head of a page.

    Parameters
    ----------
    name : str
        Number of the figure in the source, ``2.9``, or another short name.
    title : str
        What it shows.
    claim : str
        What the source states, in our words.
    verdict : str
        What we find, and why.
    grid : str
        Pixels and window, or points.
    seeds : str
        Seeds of random surfaces; empty if there are none.
    choices : str
        What the source leaves open and we have chosen; empty if nothing.

    Examples
    --------
    >>> Page(name="2.9", title="Roughness", claim="", verdict="", grid="256 x 256").label
    'Fig. 2.9'
    """

    name: str = field(validator=instance_of(str))
    title: str = field(validator=instance_of(str))
    claim: str = field(validator=instance_of(str))
    verdict: str = field(validator=instance_of(str))
    grid: str = field(validator=instance_of(str))
    seeds: str = field(default="", validator=instance_of(str))
    choices: str = field(default="", validator=instance_of(str))

    @property
    def label(self) -> str:
        """The name, as text refers to it."""
        if not self.name[:1].isdigit():
            return self.name
        return f"Fig{'s' if '-' in self.name or ',' in self.name else ''}. {self.name}"


class Check(NamedTuple):
    """A statement that the data of a page decide.

    Parameters
    ----------
    statement : str
        What is stated: a trend, an ordering, a crossing, a printed number. A false claim of the
        source stays as its corrected statement.
    holds : bool
        Whether it does.
    measured : str
        The numbers that decide it, with units.
    """

    statement: str
    holds: bool
    measured: str


class Table(NamedTuple):
    """Rows of numbers and text under a head, written as csv too."""

    head: Sequence[str]
    rows: Sequence[Sequence[Any]]
