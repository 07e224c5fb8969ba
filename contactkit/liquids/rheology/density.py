"""Density over pressure: the law of Dowson and Higginson."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

from attrs import field, frozen

from ...units import si
from ...validators import Described, non_negative, positive

__all__ = ["DowsonHigginsonDensity", "PressureDensity"]


@frozen(kw_only=True)
class PressureDensity(Described, ABC):
    """Density of a liquid over its pressure."""

    family: ClassVar[str] = "rheology law"
    kind: ClassVar[str]
    """Name of the law in files."""

    @abstractmethod
    def relative_change(self, pressure: float) -> float:
        """Change of the density over that at ambient pressure [-], at a pressure above it [Pa]."""


@frozen(kw_only=True)
class DowsonHigginsonDensity(PressureDensity):
    r"""Density of an oil over pressure (Dowson and Higginson).

    .. math:: \frac{\rho}{\rho_0} = 1 + \frac{a\,p}{1 + b\,p}

    Parameters
    ----------
    initial_compressibility : float
        a [1/Pa], the compressibility at ambient pressure.
    stiffening : float
        b [1/Pa].
    source : str
        Source of the constants.

    Raises
    ------
    DescriptionError
        If a constant is out of its range.

    Notes
    -----
    The defaults are those of a mineral oil, measured up to 0.4 GPa; a bulk modulus is 1/a.

    References
    ----------
    Dowson and Higginson (1966), Elasto-hydrodynamic lubrication; Hamrock, Fundamentals of Fluid
    Film Lubrication, Eq. (4.19).

    Examples
    --------
    >>> oil = DowsonHigginsonDensity()
    >>> round(oil.relative_change(1e6), 6), round(oil.relative_change(1e9), 3)
    (0.000599, 0.222)
    """

    kind: ClassVar[str] = "dowson-higginson"

    initial_compressibility: float = field(default=0.6e-9, validator=positive, metadata=si("1/Pa"))
    stiffening: float = field(default=1.7e-9, validator=non_negative, metadata=si("1/Pa"))
    source: str = ""

    def relative_change(self, pressure: float) -> float:
        """See `PressureDensity.relative_change`; in tension by the compressibility at ambient."""
        from ...lubrication.flow_laws.density import dowson_higginson

        ratio, _ = dowson_higginson(pressure, self.initial_compressibility, self.stiffening)
        return float(ratio) - 1.0
