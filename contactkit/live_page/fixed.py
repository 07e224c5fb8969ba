"""Tables with the same number of nodes whatever the scene, so that they can be interpolated."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from ..errors import PlanError
from ..fmu.native.records import FilmTables, Piece, Table
from ..fmu.native.tables import quintics

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["SMALL", "FixedTables"]

# Along a piece: 1e-6 of a meniscus between flats; 17 nodes leave 3e-5, 65 double the page.
_NODES = 33
SMALL = 1e-3  # of the largest value of a piece: errors of less are measured against this


class FixedTables:
    """A maker of tables for `prepared_film`: as many pieces and powers as some tables have.

    Attributes
    ----------
    error : float
        Largest relative error between the nodes so far [-].
    """

    def __init__(self, like: FilmTables) -> None:
        self._like = [
            table
            for film in like.films
            for table in (*(law.table for law in film.laws), film.shape)
        ]
        self._next: Iterator[Table] = iter(self._like)
        self.error = 0.0

    def begin(self) -> FixedTables:
        """Make the tables of another scene, from the first on."""
        self._next = iter(self._like)
        return self

    def __call__(
        self,
        function: Callable[[float], float],
        edges: Sequence[float],
        *,
        folds: Sequence[float] = (),
        stays: bool = False,
    ) -> Table:
        """See `contactkit.fmu.native.tables.Tabulate`."""
        like = next(self._next)
        if len(edges) != len(like.pieces) + 1:
            raise PlanError("another number of pieces")
        pieces = [
            self._piece(function, low, high, high in folds, one)
            for (low, high), one in zip(pairwise(edges), like.pieces, strict=True)
        ]
        return Table(stays=stays, pieces=tuple(pieces))

    def _piece(
        self, function: Callable[[float], float], low: float, high: float, folds: bool, like: Piece
    ) -> Piece:
        if folds is not like.folds:
            raise PlanError("another kind of end")
        first, last = (
            (0.0, math.sqrt(math.log(high / low))) if folds else (math.log(low), math.log(high))
        )
        count = 2 if len(like.x) == 2 else _NODES
        x: Floats = np.linspace(first, last, 2 * count - 1)
        gaps = high * np.exp(-x * x) if folds else np.exp(x)
        inside = np.clip(gaps, low * (1.0 + 1e-14), high * (1.0 - 1e-14))
        y = np.array([function(float(gap)) * gap**like.power for gap in inside])
        if not np.all(np.isfinite(y)):
            raise PlanError("a force that is no finite number")
        slope, curve = _slopes(x, y)
        self._measure(y, slope[::2], curve[::2], x[2] - x[0])
        columns = (tuple(map(float, one[::2])) for one in (x, y, slope, curve))
        names = ("x", "y", "slope", "curve")
        return Piece(
            low=low,
            high=high,
            folds=folds,
            power=like.power,
            **dict(zip(names, columns, strict=True)),
        )

    def _measure(self, y: Floats, slope: Floats, curve: Floats, width: float) -> None:
        """Compare the quintics with the values half way between their nodes."""
        half = np.full((1, 1), 0.5)
        found, _ = quintics(half, y[::2], slope * width, curve * width * width)
        size = np.maximum(np.abs(y[1::2]), SMALL * np.max(np.abs(y)))
        self.error = max(self.error, float(np.max(np.abs(found[0] - y[1::2]) / size, initial=0.0)))


def _slopes(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """First and second derivative at the nodes."""
    if len(x) <= 3:
        rise = (y[-1] - y[0]) / (x[-1] - x[0])
        return np.full(len(x), rise), np.zeros(len(x))
    from scipy.interpolate import make_interp_spline

    spline = make_interp_spline(x, y, k=5)
    return spline(x, 1), spline(x, 2)
