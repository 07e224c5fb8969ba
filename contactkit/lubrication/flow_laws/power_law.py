r"""Power law, alone or beyond a Newtonian plateau.

Beyond the plateau :math:`\tau = K \dot\gamma^n`; below the stress at which both meet, the
viscosity is that of the plateau:

.. math:: \tau_* = \eta_0 \dot\gamma_*, \qquad
          \dot\gamma_* = \left(\frac{K}{\eta_0}\right)^{1/(1-n)}
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import Attribute, field, frozen

from ...units import si
from ...validators import optional, positive, refuse
from .base import FlowLaw
from .gap_flow import WallFlow

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["PowerLaw"]


@frozen(kw_only=True)
class PowerLaw(FlowLaw):
    r"""Power-law liquid, :math:`\tau = K \dot\gamma^n`.

    .. math:: q = \frac{n h^2}{2 (2n + 1)} \left(\frac{h}{2K} \frac{dp}{dx}\right)^{1/n}

    Parameters
    ----------
    consistency : float
        K [Pa.s^n].
    exponent : float
        n [-]; below 1 the liquid thins with shear.
    plateau_viscosity : float, optional
        Newtonian viscosity eta_0 at low rates [Pa.s]. None: a pure power law, which is infinitely
        viscous (n < 1) or not at all (n > 1) at rest.

    Notes
    -----
    A pressure law multiplies viscosities at a given stress, so that K rises as M^n. The kink at
    the end of the plateau is where Carreau's law bends; the force of a film differs by some 10 %
    there.

    References
    ----------
    Bird, Armstrong and Hassager (1987), Table 4.2-1.

    Examples
    --------
    >>> law = PowerLaw(consistency=2.0, exponent=0.5)
    >>> h, g = 1e-4, 1e6
    >>> q = 0.5 * h**2 / 4.0 * (h * g / 4.0) ** 2
    >>> round(law.flux(g, h) / q, 12), round(law.gradient(q, h) / g, 12)
    (1.0, 1.0)
    """

    consistency: float = field(validator=positive, metadata=si("Pa.s^n"))
    exponent: float = field(validator=positive, metadata=si("-"))
    plateau_viscosity: float | None = field(
        default=None, validator=optional(positive), metadata=si("Pa.s")
    )

    @plateau_viscosity.validator
    def _has_an_end(self, attribute: Attribute[Any], value: float | None) -> None:
        if value is not None and self.exponent == 1.0:
            cure = "a liquid of exponent 1 has one viscosity: leave the plateau out"
            raise refuse(self, attribute, value, "be absent", cure)

    @property
    def plateau_stress(self) -> float:
        """Stress at which the plateau ends [Pa]; 0 without one."""
        if self.plateau_viscosity is None:
            return 0.0
        ratio = math.log(self.consistency / self.plateau_viscosity) / (1.0 - self.exponent)
        return self.plateau_viscosity * math.exp(ratio)

    @property
    def is_newtonian_at_rest(self) -> bool:
        """See `FlowLaw.is_newtonian_at_rest`."""
        return self.plateau_viscosity is not None or self.exponent == 1.0

    def wall_flow(self, parameter: Array) -> WallFlow:
        """See `FlowLaw.wall_flow`; the parameter is the stress [Pa]."""
        n, kink = self.exponent, self.plateau_stress
        rate = (parameter / self.consistency) ** (1.0 / n)
        # Moments of the rate over the stress: of the power law, less what its plateau changes.
        mean, apparent = n / (n + 1.0) * rate, 3.0 * n / (2.0 * n + 1.0) * rate
        one = np.ones_like(parameter)
        if self.plateau_viscosity is None:
            return WallFlow(parameter, rate, mean, apparent, one, one / n)
        at_kink = kink / self.plateau_viscosity
        inner = np.minimum(kink / parameter, 1.0)
        mean = mean + inner * at_kink * (0.5 - n / (n + 1.0))
        apparent = apparent + inner**2 * at_kink * (1.0 - 3.0 * n / (2.0 * n + 1.0))
        below, newtonian = parameter <= kink, parameter / self.plateau_viscosity
        return WallFlow(
            parameter,
            np.where(below, newtonian, rate),
            np.where(below, 0.5 * newtonian, mean),
            np.where(below, newtonian, apparent),
            one,
            np.where(below, 1.0, 1.0 / n),
        )

    def start(self, apparent_rate: Array) -> Array:
        """See `FlowLaw.start`."""
        n = self.exponent
        tail = self.consistency * (apparent_rate * (2.0 * n + 1.0) / (3.0 * n)) ** n
        if self.plateau_viscosity is None:
            return tail
        bound = np.minimum if n < 1.0 else np.maximum
        return np.asarray(bound(tail, self.plateau_viscosity * apparent_rate))

    def of_stress(self, stress: Array) -> Array:
        """See `FlowLaw.of_stress`."""
        return stress
