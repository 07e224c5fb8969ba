"""Eyring's law: thermally activated flow, linear in small stresses, exponential in large ones."""

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

__all__ = ["Eyring"]

# Stress over Eyring's stress below which series replace the closed forms, which cancel to x^2 and
# x^3 there. At 0.3 seven terms leave 1e-17, and the closed form of the flux 2e-15.
_SMALL = 0.3
_TERMS = 7


@frozen(kw_only=True)
class Eyring(FlowLaw):
    r"""Eyring liquid, :math:`\dot\gamma = (\tau_0/\eta) \sinh(\tau/\tau_0)`.

    .. math:: \Gamma = \frac{6 q}{h^2} = \frac{3 \tau_0}{\eta}
              \frac{x \cosh x - \sinh x}{x^2}, \qquad x = \frac{\tau_w}{\tau_0}

    Parameters
    ----------
    viscosity : float
        Viscosity eta at small stress and ambient pressure [Pa.s].
    eyring_stress : float
        tau_0 [Pa]; oils some 5 MPa. The pressure leaves it as it is.

    Notes
    -----
    The shear rate stays a double up to stresses of 700 tau_0.

    References
    ----------
    Eyring (1936), J. Chem. Phys. 4, 283; Johnson and Tevaarwerk (1977), Proc. R. Soc. A 356, 215.

    Examples
    --------
    >>> thin = Eyring(viscosity=0.1, eyring_stress=5e6)
    >>> round(thin.wall_stress(1e-9, 1e-5), 6), round(thin.wall_stress(1.0, 1e-5) / 5e6, 6)
    (6.0, 8.999578)
    """

    viscosity: float = field(validator=positive, metadata=si("Pa.s"))
    eyring_stress: float = field(validator=positive, metadata=si("Pa"))

    def wall_flow(self, parameter: Array) -> WallFlow:
        """See `FlowLaw.wall_flow`; the parameter is the stress [Pa]."""
        x = parameter / self.eyring_stress
        linear = parameter / self.viscosity
        is_small = x < _SMALL
        sinh_x, mean, moment = _series(np.where(is_small, x, 0.0))
        wide = np.where(is_small, 1.0, x)
        half = np.sinh(0.5 * wide)
        sinh, cosh = np.sinh(wide) / wide, np.cosh(wide)
        rate = linear * np.where(is_small, sinh_x, sinh)
        # d ln sinh(x)/d ln x is x coth(x).
        steep = np.where(is_small, x / np.tanh(np.where(x > 0.0, x, 1.0)), wide / np.tanh(wide))
        return WallFlow(
            parameter,
            rate,
            linear * np.where(is_small, mean, 2.0 * (half / wide) ** 2),
            linear * np.where(is_small, moment, 3.0 * (cosh - sinh) / wide**2),
            np.ones_like(x),
            np.where(x > 1e-8, steep, 1.0),
        )

    def start(self, apparent_rate: Array) -> Array:
        """See `FlowLaw.start`: from below, where the logarithm of the rate is convex."""
        x = np.arcsinh(self.viscosity / self.eyring_stress * apparent_rate)
        return np.where(x < 1e-8, self.viscosity * apparent_rate, self.eyring_stress * x)

    def of_stress(self, stress: Array) -> Array:
        """See `FlowLaw.of_stress`."""
        return stress


def _series(x: Array) -> tuple[Array, Array, Array]:
    """sinh(x)/x, (cosh(x) - 1)/x^2 and 3 (x cosh(x) - sinh(x))/x^3 at small x."""
    square = x * x
    first, second, third = np.zeros_like(x), np.zeros_like(x), np.zeros_like(x)
    term = np.ones_like(x)  # x^(2k)/(2k + 1)!
    for k in range(_TERMS):
        first = first + term
        second = second + term / (2 * k + 2)
        third = third + term * 3.0 / (2 * k + 3)
        term = term * square / ((2 * k + 2) * (2 * k + 3))
    return first, second, third
