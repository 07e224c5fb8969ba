"""Newtonian flow law: one viscosity at all shear rates."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import field, frozen

from ...units import si
from ...validators import positive
from .base import FlowLaw
from .gap_flow import WallFlow

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["Newtonian"]


@frozen(kw_only=True)
class Newtonian(FlowLaw):
    r"""Newtonian liquid, :math:`\tau = \eta \dot\gamma`.

    .. math:: q = \frac{h^3}{12 \eta}\left(1 + \frac{6 b}{h}\right) \frac{dp}{dx}

    Parameters
    ----------
    viscosity : float
        Dynamic viscosity eta at ambient pressure [Pa.s].

    Examples
    --------
    >>> slips = Newtonian(viscosity=0.1, slip_length=1e-6)
    >>> round(Newtonian(viscosity=0.1).gradient(1e-9, 1e-5) / slips.gradient(1e-9, 1e-5), 12)
    1.6
    """

    viscosity: float = field(validator=positive, metadata=si("Pa.s"))

    def wall_flow(self, parameter: Array) -> WallFlow:
        """See `FlowLaw.wall_flow`; the parameter is the stress [Pa]."""
        rate, one = parameter / self.viscosity, np.ones_like(parameter)
        return WallFlow(parameter, rate, 0.5 * rate, rate, one, one)

    def start(self, apparent_rate: Array) -> Array:
        """See `FlowLaw.start`."""
        return self.viscosity * apparent_rate

    def of_stress(self, stress: Array) -> Array:
        """See `FlowLaw.of_stress`."""
        return stress
