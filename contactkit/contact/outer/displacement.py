r"""Normal displacement that the tractions of sliding friction cause.

With the compliance F under pressure and the normal displacement B p that friction causes, a contact
is the variational inequality of M = F + B. B is skew (reciprocity), so that M is as positive as F
and there is one solution for any coefficient of friction (Lions and Stampacchia 1967). Its strength
is the norm c of B over F: the coefficient times Dundurs' constant for half-spaces.

Contacts under the displacement of the last one contract by c. From there on they swing, and a step
is taken of M instead, relaxed by :math:`\theta`, in the norm of F:

.. math:: F p' - \left[(1 - \theta) F p - \theta B p\right] - \theta h \ge 0

That is a contact under the displacement :math:`(1 - \theta)(d - g) + \theta B p` of the last
displacement d and gap g, with :math:`\theta` of its own gap. It contracts by
:math:`c/\sqrt{1 + c^2}` for :math:`\theta = 1/(1 + c^2)`, on any grid.
"""

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
# Strength from which on steps are relaxed. On a sphere and a rough map relaxed steps take as many
# applications at 0.86 and 13 % fewer at 1.09; Anderson's method settles others up to 1.2.
_STRONG = 1.0
# Evaluations of relaxed steps that Anderson's method looks back on. At strengths of 2.9 and 4.3
# four take 1852 and 6591 applications on a sphere, ten 873 and 2652, fifteen 814 and 2072, 25 864
# and 2302.
_MEMORY = 15


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
    strength : float
        Bound of the displacement over that of the pressure itself, in the energy norm [-].
    first_touch : float
        Rigid-body approach [m] at which the undeformed bodies touch.
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
        strength: float = 0.0,
        first_touch: float = -np.inf,
    ) -> None:
        self._caused_by, self._shape, self._own = caused_by, shape, self_influence
        self.effect, self._touch = effect, first_touch
        self._share = 1.0
        if strength > _STRONG:
            self._share, self.memory = 1.0 / (1.0 + strength**2), _MEMORY
            self.slowness = 1.0 / self._share

    def first(self, target: Target) -> Map:
        """See `Unknown.first`.

        Bodies that do not touch undeformed start from nothing: tractions of a contact before would
        press them together and, on flats, which have no length, not fall over what they cause.
        """
        approach = target.rigid_approach
        if approach is not None and approach <= self._touch:
            return np.zeros(self._shape)
        known = target.unknowns.get(self.name)
        return known if known is not None else np.zeros(self._shape)

    def hold(self, held: Held, value: Map) -> Held:
        """See `Unknown.hold`."""
        return held._replace(displacement=value, relaxation=self._share)

    def renewed(self, contact: HeldContact, rtol: float) -> Next:
        """See `Unknown.renewed`."""
        caused, before = self._caused_by(contact.solution.pressure), contact.held.displacement
        if before is None or self._share == 1.0:
            return Next(caused)
        return Next((1.0 - self._share) * (before - contact.distance) + self._share * caused)

    def change(self, value: Map, found: Map, contact: HeldContact) -> float:
        """See `Unknown.change`: that of a whole step."""
        return super().change(value, found, contact) / self._share

    def settled(self, value: Map, contact: HeldContact) -> Map:
        """See `Unknown.settled`: with the gap that a relaxed one lacks."""
        displacement = contact.held.displacement
        assert displacement is not None
        return displacement

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
