"""Hardness of each pixel, which depends on the displacement there."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Protocol

import numpy as np

from ...errors import InfeasibleError
from .unknown import Held, HeldContact, Next, Target, Unknown

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["LocalHardness", "too_soft"]


class LocalLaw(Protocol):
    """Hardness [Pa] between two limits, for the displacements [m] of the bodies."""

    @property
    def lowest(self) -> float:
        """Least hardness [Pa]."""

    @property
    def highest(self) -> float:
        """Greatest hardness [Pa]."""

    @property
    def at(self) -> Callable[[tuple[Map, ...]], Map | float]:
        """Hardness for the displacements."""


class LocalHardness(Unknown):
    """Hardness [Pa] of each pixel (ny, nx), as the bound of its pressure.

    Parameters
    ----------
    law : LocalLaw
        Hardness over displacement.
    displacements : callable
        Displacement [m] of each body for a pressure and the displacement of both.
    shape : (ny, nx)
        Of the window.
    area : float
        Of the window [m2].
    effect : str
        Name of the effect.
    """

    name: ClassVar[str] = "local hardness"
    measure: ClassVar[str] = "itself"
    first_rtol = 0.0  # where no displacement reaches an interface, the first contact is the last
    cure = "use ContinuousHardness(displacement='largest')"

    def __init__(
        self,
        law: LocalLaw,
        displacements: Callable[[Map, Map], tuple[Map, ...]],
        shape: tuple[int, int],
        area: float,
        effect: str,
    ) -> None:
        self._law, self._displacements, self._shape = law, displacements, shape
        self._area, self.effect = area, effect

    def first(self, target: Target) -> Map:
        """See `Unknown.first`: the highest, as that of no displacement."""
        return np.full(self._shape, self._law.highest)

    def hold(self, held: Held, value: Map) -> Held:
        """See `Unknown.hold`."""
        return held._replace(bound=value)

    def renewed(self, contact: HeldContact, rtol: float) -> Next:
        """See `Unknown.renewed`.

        Raises
        ------
        InfeasibleError
            If the hardness of the whole window does not carry the load.
        """
        bodies = self._displacements(contact.pressure, contact.displacement)
        found = np.asarray(self._law.at(tuple(np.maximum(u, 0.0) for u in bodies)))
        load = contact.target.mean_pressure
        if load is not None and found.mean() < load:
            raise too_soft(load, float(found.mean()), self._area)
        return Next(found)

    def scale(self, contact: HeldContact) -> float:
        """See `Unknown.scale`."""
        return self._law.highest

    def change(self, value: Map, found: Map, contact: HeldContact) -> float:
        """See `Unknown.change`: of each pixel in contact over its own hardness."""
        change = np.abs(found / value - 1.0)[contact.touching]
        return float(change.max(initial=0.0))

    def admitted(self, value: Map, found: Map, target: Target) -> Map:
        """See `Unknown.admitted`: within the law, and enough to carry the load."""
        made = np.clip(value, self._law.lowest, self._law.highest)
        load = target.mean_pressure
        return made if load is None or made.mean() > load else found


def too_soft(load: float, hardness: float, area: float) -> InfeasibleError:
    """Refuse a load [Pa] that exceeds the hardness [Pa] at the displacement that it causes."""
    return InfeasibleError(
        f"load {load * area:.6g} N exceeds H*A = {hardness * area:.6g} N: at the displacement this "
        f"load causes the effective hardness has fallen to {hardness:.6g} Pa; lower the load"
    )
