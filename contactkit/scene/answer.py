"""Base class of results, curves and studies: status, numbers, sources, figures and a file."""

from __future__ import annotations

import abc
from pathlib import Path

from .tabular import Tabular

__all__ = ["Answer", "headline"]


def headline(status: str, message: str) -> str:
    """Status and message of a result in one line; a message may begin with its status.

    Examples
    --------
    >>> headline("converged", "converged: conditions met"), headline("released", "after 1 ms")
    ('converged: conditions met', 'released: after 1 ms')
    """
    return message if message.startswith(status) else f"{status}: {message}"


class Answer(Tabular):
    """Outcome of a computation: `status`, `scalars`, `cite`, `save`, `plot`, and `print`.

    Results of one scene, curves along an axis and studies over parameters share these; `to_xarray`
    and `to_dataframe` have their columns.
    """

    __slots__ = ()

    @property
    @abc.abstractmethod
    def status(self) -> str:
        """End of the computation, in a word."""

    @property
    @abc.abstractmethod
    def message(self) -> str:
        """End of the computation, in a sentence."""

    @abc.abstractmethod
    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the whole, each with its SI unit."""

    @abc.abstractmethod
    def unit(self, name: str) -> str:
        """Return the unit of a column."""

    @abc.abstractmethod
    def cite(self) -> str:
        """Return the sources of the equations, one to a line."""

    @abc.abstractmethod
    def save(self, path: str | Path) -> Path:
        """Write columns and numbers to an npz file without pickle, whole or not at all."""

    @property
    def _headline(self) -> str:
        """First line of what is printed."""
        return headline(self.status, self.message)

    def _repr_html_(self) -> str:
        """Status and numbers in a notebook."""
        from ..export.html import numbers_table

        return numbers_table(self._headline, self.scalars())

    def __str__(self) -> str:
        numbers = self.scalars()
        width = max(map(len, numbers), default=0)
        lines = [f"  {name:{width}s}  {v:.6g} {unit}" for name, (v, unit) in numbers.items()]
        return "\n".join([self._headline, *lines])
