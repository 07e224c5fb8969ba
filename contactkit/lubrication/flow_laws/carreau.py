r"""Carreau-Yasuda law: Newtonian at low shear rates, a power law beyond, a plateau at the end.

The moments of the rate have no elementary form. With the rate as variable,
:math:`x = \ln(\lambda\dot\gamma)` and :math:`m = d\ln\tau/d\ln\dot\gamma`,

.. math:: \Gamma = \frac{3}{\tau_w^2} \int_{-\infty}^{x_w} \dot\gamma \, \tau^2 m \, dx, \qquad
          C = \frac{1}{\tau_w} \int_{-\infty}^{x_w} \dot\gamma \, \tau \, m \, dx

are sums of positive terms, by Gauss-Legendre on panels of x: those below are summed once for each
law.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from attrs import field, frozen

from ...numerics.quadrature import gauss_legendre
from ...units import si
from ...validators import non_negative, positive
from .base import FlowLaw
from .gap_flow import WallFlow, positive_root

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["Carreau"]

# The law has branch points at a height of pi/a over the axis of x. Panels of 2 with twelve nodes
# then leave 1e-13 at a = 2; a sharper bend takes shorter ones.
_PANEL = 2.0
_NODES = 12
_ROUNDING = 38.0  # exp(-38) is below round-off
_END = 230.0  # of x: gamma tau^2 stays a double


@frozen(kw_only=True)
class Carreau(FlowLaw):
    r"""Liquid of Carreau and Yasuda.

    .. math:: \eta = \eta_\infty + (\eta_0 - \eta_\infty)
              \left[1 + (\lambda\dot\gamma)^a\right]^{(n-1)/a}

    Parameters
    ----------
    viscosity : float
        eta_0, at low rates and ambient pressure [Pa.s].
    relaxation_time : float
        lambda [s]: beyond a rate of 1/lambda the liquid thins. A pressure stretches it as it does
        the viscosity.
    exponent : float
        n [-].
    limit_viscosity : float
        eta_inf, at high rates [Pa.s].
    transition : float
        a [-]; 2 is Carreau's law.

    Notes
    -----
    Accurate to 1e-12.

    References
    ----------
    Yasuda, Armstrong and Cohen (1981); Bird, Armstrong and Hassager (1987), Eq. (4.1-9).

    Examples
    --------
    >>> law = Carreau(viscosity=1.0, relaxation_time=1e-3, exponent=0.5)
    >>> round(law.wall_stress(1e-13, 1e-5), 9)
    0.006
    >>> round(law.wall_stress(1e-3, 1e-5) / (1e3 * 8e4**0.5), 3)
    1.0
    """

    viscosity: float = field(validator=positive, metadata=si("Pa.s"))
    relaxation_time: float = field(validator=positive, metadata=si("s"))
    exponent: float = field(validator=positive, metadata=si("-"))
    limit_viscosity: float = field(default=0.0, validator=non_negative, metadata=si("Pa.s"))
    transition: float = field(default=2.0, validator=positive, metadata=si("-"))

    @property
    def _shape(self) -> _Shape:
        """The law in units of its viscosity and its relaxation time."""
        return _Shape(self.exponent, self.transition, self.limit_viscosity / self.viscosity)

    def wall_flow(self, parameter: Array) -> WallFlow:
        """See `FlowLaw.wall_flow`; the parameter is the shear rate at the wall [1/s]."""
        x = np.log(parameter * self.relaxation_time)
        stress, slope = _stress(self._shape, x)
        mean, apparent = _rates(self._shape, x, stress, slope)
        return WallFlow(
            self.viscosity / self.relaxation_time * stress,
            parameter,
            mean * parameter,
            apparent * parameter,
            slope,
            np.ones_like(x),
        )

    def start(self, apparent_rate: Array) -> Array:
        """See `FlowLaw.start`."""
        return apparent_rate

    def of_stress(self, stress: Array) -> Array:
        """See `FlowLaw.of_stress`."""
        unit = self.viscosity / self.relaxation_time

        def residual(rate: Array) -> tuple[Array, Array]:
            value, slope = _stress(self._shape, np.log(rate))
            return np.log(stress / unit / value), slope

        return positive_root(residual, stress / unit) / self.relaxation_time


class _Shape(NamedTuple):
    """Carreau's law without its units."""

    exponent: float
    transition: float
    ratio: float
    """eta_inf over eta_0."""


def _stress(shape: _Shape, x: Array) -> tuple[Array, Array]:
    """Stress over that of the units, and its exponent m, at the logarithm of the rate."""
    n, a, ratio = shape
    thins = (1.0 - ratio) * np.exp((n - 1.0) / a * np.logaddexp(0.0, a * x))
    viscosity = ratio + thins
    beyond = np.exp(-np.logaddexp(0.0, -a * x))  # y/(1 + y) of y = (lambda rate)^a
    return viscosity * np.exp(x), 1.0 + (n - 1.0) * beyond * thins / viscosity


@lru_cache(maxsize=64)
def _panels(shape: _Shape) -> tuple[Array, Array, Array]:
    """Edges of the panels, and both moments up to each edge."""
    length = _PANEL * min(1.0, 2.0 / shape.transition)
    low = -min(_ROUNDING / shape.transition, _END)
    edges = low + length * np.arange(int((_END - low) / length))
    # Below the first edge the liquid is Newtonian.
    first, second = _inside(shape, edges[:-1], edges[1:])
    rate = np.exp(edges[0])
    first = np.concatenate([[0.5 * rate**2], 0.5 * rate**2 + np.cumsum(first)])
    second = np.concatenate([[rate**3 / 3.0], rate**3 / 3.0 + np.cumsum(second)])
    return edges, first, second


def _inside(shape: _Shape, low: Array, high: Array) -> tuple[Array, Array]:
    """Both moments between logarithms of rates no farther apart than a panel."""
    nodes, weights = (np.array(one) for one in gauss_legendre(_NODES))
    width = (high - low)[..., None]
    x = low[..., None] + width * nodes
    stress, slope = _stress(shape, x)
    each = np.exp(x) * stress * slope * (weights * width)
    return each.sum(axis=-1), (each * stress).sum(axis=-1)


def _rates(shape: _Shape, x: Array, stress: Array, slope: Array) -> tuple[Array, Array]:
    """Mean and apparent rate of a half film over the rate at its wall [-]."""
    edges, below, below_square = _panels(shape)
    within = np.clip(x, edges[0], edges[-1])
    panel = np.searchsorted(edges, within, side="right") - 1
    first, second = _inside(shape, edges[panel], within)
    outside = within != x
    if not outside.any():
        rate = np.exp(x)
        first, second = below[panel] + first, below_square[panel] + second
        return first / stress / rate, 3.0 * second / stress**2 / rate
    at_end = np.where(outside, 1.0, stress)
    rate = np.where(outside, 1.0, np.exp(within))
    mean = (below[panel] + first) / at_end / rate
    apparent = 3.0 * (below_square[panel] + second) / at_end**2 / rate
    # Beyond both ends the law is a power of the rate.
    mean = np.where(outside, slope / (1.0 + slope), mean)
    return mean, np.where(outside, 3.0 * slope / (1.0 + 2.0 * slope), apparent)
