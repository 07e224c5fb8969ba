r"""Viscosity over pressure: Barus and Roelands, as a factor on the viscosity at ambient pressure.

Pressures are relative to ambient [Pa], negative in tension. No published law was measured in
tension. Below ambient a law either goes on as its own tangent exponential,
:math:`M = e^{\alpha p}` with the slope at ambient, which measurements do fix, or stays at 1: the
forces of an opening film under these two are a lower and an upper bound.
"""

from __future__ import annotations

import abc
import math
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import evolve, field, frozen

from ...numerics.quadrature import gauss_legendre
from ...units import si
from ...validators import non_negative, positive

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["POLE_LOGARITHM", "POLE_PRESSURE", "Barus", "PressureLaw", "Roelands"]

POLE_LOGARITHM = 9.67
"""Minus the logarithm of the viscosity [Pa.s] at the pole of Roelands' law, 6.31e-5 Pa.s."""
POLE_PRESSURE = 1.96e8
"""Pressure of that pole below ambient [Pa]: 2000 kgf/cm2, the inverse of 5.1e-9 1/Pa."""


@frozen(kw_only=True)
class PressureLaw(abc.ABC):
    """Viscosity at a pressure over that at ambient pressure.

    Parameters
    ----------
    thins_in_tension : bool
        Whether the viscosity falls below its ambient value where the liquid is in tension; else it
        stays at that value.
    """

    thins_in_tension: bool = True

    @property
    @abc.abstractmethod
    def coefficient(self) -> float:
        """Slope of the logarithm at ambient pressure [1/Pa]."""

    @abc.abstractmethod
    def to_power(self, exponent: float) -> PressureLaw:
        """Law of the factor to a power: that of the gradient of a power law at a given flux."""

    @abc.abstractmethod
    def _logarithm(self, pressure: Array) -> tuple[Array, Array]:
        """Logarithm of the factor and its slope [1/Pa] at pressures above ambient."""

    def logarithm(self, pressure: ArrayLike) -> tuple[Array, Array]:
        """Logarithm of the factor [-] and its slope [1/Pa] at a pressure [Pa].

        Examples
        --------
        >>> value, slope = Barus(coefficient=2e-8).logarithm(5e7)
        >>> float(value), float(slope)
        (1.0, 2e-08)
        """
        p = np.asarray(pressure, dtype=float)
        value, slope = self._logarithm(np.maximum(p, 0.0))
        below = self.coefficient if self.thins_in_tension else 0.0
        return np.where(p < 0.0, below * p, value), np.where(p < 0.0, below, slope)

    def multiplier(self, pressure: ArrayLike) -> Array:
        """Viscosity at a pressure [Pa] over that at ambient pressure [-]; inf beyond doubles.

        Examples
        --------
        >>> float(Barus(coefficient=2e-8, thins_in_tension=False).multiplier(-5e7))
        1.0
        """
        return np.exp(np.minimum(self.logarithm(pressure)[0], 709.0))

    def reduced(self, pressure: ArrayLike) -> Array:
        r"""Reduced pressure [Pa], :math:`\int_0^p dp/M`: that of a liquid of constant viscosity.

        Examples
        --------
        >>> law = Barus(coefficient=2e-8)
        >>> round(float(law.reduced(5e7)) / 5e7, 12) == round(1.0 - math.exp(-1.0), 12)
        True
        """
        p = np.asarray(pressure, dtype=float)
        alpha = self.coefficient
        if not self.thins_in_tension or alpha == 0.0:
            below = np.minimum(p, 0.0)
        else:
            below = -np.expm1(np.minimum(-alpha * np.minimum(p, 0.0), 700.0)) / alpha
        return np.asarray(below + self._reduced_above(np.maximum(p, 0.0)))

    def _reduced_above(self, pressure: Array) -> Array:
        """Reduced pressure [Pa] at pressures above ambient, over the logarithm of 1 + alpha p."""
        scale = max(self.coefficient, 1e-300)
        end = np.log1p(scale * pressure)
        nodes, weights = (np.array(one) for one in gauss_legendre(40))
        x = np.expm1(end[..., None] * nodes) / scale
        each = np.exp(end[..., None] * nodes - self._logarithm(x)[0]) / scale
        return np.asarray(end * (each @ weights))

    def pressure_of(self, reduced: ArrayLike) -> Array:
        """Pressure [Pa] of a reduced one; inf where no pressure is as high.

        Examples
        --------
        >>> law = Roelands(viscosity=0.1, exponent=0.6)
        >>> round(float(law.pressure_of(law.reduced(2e8))), 3), float(law.pressure_of(1e9))
        (200000000.0, inf)
        """
        given = np.asarray(reduced, dtype=float)
        alpha = self.coefficient
        below, above = np.minimum(given, 0.0), np.maximum(given, 0.0)
        if self.thins_in_tension and alpha > 0.0:
            below = -np.log1p(-alpha * below) / alpha
        p = above.copy()
        # The reduced pressure is concave: Newton's method from below rises to the root.
        with np.errstate(over="ignore", invalid="ignore"):
            for _ in range(200):
                step = (above - self._reduced_above(p)) * np.exp(self._logarithm(p)[0])
                none = ~(p + step < 600.0 / max(alpha, 1e-300))
                step = np.where(none, 0.0, step)
                p = np.where(none, 0.0, p + step)
                above = np.where(none, 0.0, above)
                below = np.where(none, np.inf, below)
                if (np.abs(step) <= 1e-14 * p).all():
                    break
        return np.asarray(below + p)


@frozen(kw_only=True)
class Barus(PressureLaw):
    r"""Exponential law of Barus, :math:`M = e^{\alpha p}`.

    Parameters
    ----------
    coefficient : float
        Pressure-viscosity coefficient alpha [1/Pa]; mineral oils 1e-8 to 3e-8.

    Notes
    -----
    Valid up to some 0.1 GPa: beyond, measured viscosities rise more slowly, and `Roelands` fits.

    References
    ----------
    Barus (1893), Am. J. Sci. 45, 87.

    Examples
    --------
    >>> round(float(Barus(coefficient=2e-8).multiplier(1e8)), 6)
    7.389056
    """

    coefficient: float = field(validator=non_negative, metadata=si("1/Pa"))

    def to_power(self, exponent: float) -> Barus:
        """See `PressureLaw.to_power`."""
        return evolve(self, coefficient=exponent * self.coefficient)

    def _logarithm(self, pressure: Array) -> tuple[Array, Array]:
        """See `PressureLaw._logarithm`."""
        return self.coefficient * pressure, np.full_like(pressure, self.coefficient)


@frozen(kw_only=True)
class Roelands(PressureLaw):
    r"""Law of Roelands, fitted to lubricating oils up to about 1 GPa.

    .. math:: M = \exp\left\{\left[\ln\eta_0 + 9.67\right]
              \left[\left(1 + \frac{p}{p_0}\right)^z - 1\right]\right\}, \qquad
              \alpha = \frac{z}{p_0}\left[\ln\eta_0 + 9.67\right]

    Parameters
    ----------
    viscosity : float
        Viscosity eta_0 at ambient pressure [Pa.s], above 6.3e-5, the common pole of all liquids.
    exponent : float
        Pressure index z [-]; oils 0.5 to 0.8.
    pole_pressure : float
        p_0 [Pa].

    Notes
    -----
    The pole of the fit lies at eta = 6.31e-5 Pa.s, p = -0.196 GPa. The power has no value below
    it, so that in tension the law is its tangent at ambient pressure.

    References
    ----------
    Roelands (1966); Hamrock, Fundamentals of Fluid Film Lubrication, Eq. (4.10).

    Examples
    --------
    >>> law = Roelands(viscosity=0.04, exponent=0.68)
    >>> round(law.coefficient * 1e9, 3), round(float(law.multiplier(5e8)), 1)
    (22.381, 6769.3)
    """

    viscosity: float = field(validator=positive, metadata=si("Pa.s"))
    exponent: float = field(validator=positive, metadata=si("-"))
    pole_pressure: float = field(default=POLE_PRESSURE, validator=positive, metadata=si("Pa"))

    @property
    def _height(self) -> float:
        """Logarithm of the viscosity at ambient over that of the pole."""
        return math.log(self.viscosity) + POLE_LOGARITHM

    @property
    def coefficient(self) -> float:
        """See `PressureLaw.coefficient`."""
        return self.exponent * self._height / self.pole_pressure

    def to_power(self, exponent: float) -> Roelands:
        """See `PressureLaw.to_power`: that of a liquid nearer to the pole."""
        viscosity = math.exp(exponent * self._height - POLE_LOGARITHM)
        return evolve(self, viscosity=viscosity)

    def _logarithm(self, pressure: Array) -> tuple[Array, Array]:
        """See `PressureLaw._logarithm`."""
        grown = self.exponent * np.log1p(pressure / self.pole_pressure)
        slope = self.coefficient * np.exp(grown) / (1.0 + pressure / self.pole_pressure)
        return self._height * np.expm1(grown), slope
