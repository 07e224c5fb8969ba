"""State of a cavity, as floats that can be saved."""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum
from typing import Any, NamedTuple

from ...lubrication.rupture_history import RuptureHistory

__all__ = ["FULL", "Cavity", "Phase", "restored_cavity"]


class Phase(IntEnum):
    """Motion of the liquid at the edge of the cavity; the kernel in C has the same numbers."""

    FULL = 0
    RECEDING = 1
    RETURNING = 2


class Cavity(NamedTuple):
    """Cavity in one film.

    `void` is the volume without liquid [m3], `fraction` that of the disc within the edge, (c/R)^2;
    `history` has the gap at which the film ruptured at each radius, and `largest` is the largest
    void that it had [m3]. Of a face that is no disc, `liquid` has the thickness of the liquid [m]
    in each cell of its grid, in place of `history`.
    """

    phase: Phase = Phase.FULL
    void: float = 0.0
    fraction: float = 0.0
    history: RuptureHistory = ()
    largest: float = 0.0
    liquid: tuple[tuple[float, ...], ...] = ()


FULL = Cavity()
"""A film without a cavity."""


def restored_cavity(saved: Sequence[Any]) -> Cavity:
    """Cavity of the numbers and lists that one is saved as.

    Examples
    --------
    >>> restored_cavity([0, 0.0, 0.0, [], 0.0, []]) == FULL
    True
    """
    phase, void, fraction, history, largest, liquid = saved
    pieces = tuple(tuple(float(number) for number in piece) for piece in history)
    rows = tuple(tuple(float(number) for number in row) for row in liquid)
    return Cavity(Phase(phase), float(void), float(fraction), pieces, float(largest), rows)
