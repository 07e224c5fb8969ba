"""Reference scales of a result, by which its quantities become dimensionless."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from ..frozen import FrozenDict

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Scale", "Scaled", "Scales", "scales_of"]


class Scale(NamedTuple):
    """A reference value by which quantities of one unit are divided.

    Attributes
    ----------
    value : float
        In that SI unit; positive and finite.
    name : str
        Stands for the unit of what is divided by it, such as ``E* A``.
    definition : str
        How it is made.
    """

    value: float
    name: str
    definition: str


class Scaled(NamedTuple):
    """A quantity divided by its scale, and the name of that; ``-`` without one."""

    value: NDArray[Any]
    unit: str


Scales = Mapping[str, Scale]
"""Scales by the SI unit of the quantities that they belong to."""


def scales_of(known: Mapping[str, Scale]) -> Scales:
    """Those of some scales that are positive and finite.

    Examples
    --------
    >>> list(scales_of({"m": Scale(1e-9, "rms", "rms height"), "N": Scale(0.0, "F0", "pull")}))
    ['m']
    """
    return FrozenDict({unit: one for unit, one in known.items() if 0.0 < one.value < math.inf})
