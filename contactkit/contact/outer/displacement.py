"""Normal displacement that the tractions of sliding friction cause."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np

from .unknown import Held, HeldContact, Next, Target, Unknown

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["TractionDisplacement", "displacement_scale"]

# The first contact is that without tractions, with which `pressure_without` compares to six digits.
# Looser (1e-4) its displacement misleads the acceleration: 3 to 27 % more applications for
# coefficients of 0.1 to 1; tighter (1e-8) it takes 1 to 8 % more.
_WITHOUT = 1e-6


class TractionDisplacement(Unknown):
    """Normal displacement [m] (ny, nx) by tractions that follow from the pressure of contact.

    Parameters
    ----------
    caused_by : callable
        Displacement [m] by the tractions that a pressure [Pa] brings about.
    shape : (ny, nx)
        Of the window.
    self_influence : float
        Displacement of a pixel under unit pressure on itself [m/Pa].
    effect : str
        Name of the effect.
    """

    name: ClassVar[str] = "displacement by friction"
    measure: ClassVar[str] = "that by pressure"
    cure = "lower FrictionTraction.coefficient or leave FrictionCoupling out"
    is_of_tractions: ClassVar[bool] = True
    first_rtol = _WITHOUT

    def __init__(
        self,
        caused_by: Callable[[Map], Map],
        shape: tuple[int, int],
        self_influence: float,
        effect: str,
    ) -> None:
        self._caused_by, self._shape, self._own = caused_by, shape, self_influence
        self.effect = effect

    def first(self, target: Target) -> Map:
        """See `Unknown.first`."""
        known = target.unknowns.get(self.name)
        return known if known is not None else np.zeros(self._shape)

    def hold(self, held: Held, value: Map) -> Held:
        """See `Unknown.hold`."""
        return held._replace(displacement=value)

    def renewed(self, contact: HeldContact, rtol: float) -> Next:
        """See `Unknown.renewed`."""
        return Next(self._caused_by(contact.solution.pressure))

    def scale(self, contact: HeldContact) -> float:
        """See `Unknown.scale`."""
        return displacement_scale(contact, self._own)


def displacement_scale(contact: HeldContact, self_influence: float) -> float:
    """Displacement [m] that others are small against.

    Its range, or where that is round-off, as of flat surfaces, that of a pixel on its own; without
    pressure, as after unloading, the round-off of the distance between the surfaces.
    """
    own = float(contact.solution.pressure.max()) * self_influence
    least = np.finfo(float).eps * float(np.abs(contact.distance).max())
    return max(float(np.ptp(contact.solution.displacement)), own, least, np.finfo(float).tiny)
