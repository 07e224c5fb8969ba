"""Viscosity over pressure: the laws of Barus and Roelands.

A law holds constants; `contactkit.lubrication.flow_laws` evaluates it. Pressures are those above
ambient. None of the laws was measured in tension, where each goes on as an exponential.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, ClassVar

from attrs import Attribute, field, frozen

from ...errors import DescriptionError
from ...units import si
from ...validators import Described, positive, refuse

if TYPE_CHECKING:
    from ...lubrication.flow_laws.pressure_laws import PressureLaw

__all__ = ["BarusViscosity", "PressureViscosity", "RoelandsViscosity"]

# The steepest that is measured is some 60 1/GPa (polyphenyl ethers near their glass); beyond ten
# times that a number was meant in 1/GPa, or in 1/MPa.
_STEEPEST = 1e-6  # [1/Pa]


def _coefficient(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Refuse anything but a positive number; the hint suggests 1/GPa above 1e-6 1/Pa."""
    positive(owner, attribute, value)
    if value > _STEEPEST:
        cure = f"was it given in 1/GPa? write '{value:g} 1/GPa' in a file, or {value:g}e-9"
        raise refuse(owner, attribute, value, f"be at most {_STEEPEST:g}", cure)


@frozen(kw_only=True)
class PressureViscosity(Described, ABC):
    """Viscosity of a liquid over its pressure.

    Parameters
    ----------
    pressure_coefficient : float
        Slope of the logarithm of the viscosity over pressure, at ambient pressure [1/Pa].
    source : str
        Source of the constants.

    Raises
    ------
    DescriptionError
        If the coefficient is not positive and finite, or seems to be in 1/GPa.
    """

    family: ClassVar[str] = "rheology law"
    kind: ClassVar[str]
    """Name of the law in files."""
    cite: ClassVar[str]
    """Source of its equation."""
    highest_pressure: ClassVar[float]
    """Pressure [Pa] up to which the law is known to fit."""

    pressure_coefficient: float = field(validator=_coefficient, metadata=si("1/Pa"))
    source: str = ""

    @abstractmethod
    def pressure_law(self, viscosity: float) -> PressureLaw:
        """Law of a liquid of a viscosity [Pa.s] at ambient pressure, as films evaluate it."""


@frozen(kw_only=True)
class BarusViscosity(PressureViscosity):
    r"""Viscosity that grows exponentially with pressure (Barus).

    .. math:: \eta = \eta_0\,e^{\alpha p}

    Parameters
    ----------
    pressure_coefficient : float
        :math:`\alpha` [1/Pa]; of mineral oils some 2e-8.
    source : str
        Source of the constants.

    Notes
    -----
    Right up to some 0.1 GPa; beyond, oils thicken less.

    References
    ----------
    Barus (1893), Isothermals, isopiestics and isometrics relative to viscosity.

    Examples
    --------
    >>> oil = BarusViscosity(pressure_coefficient="20 1/GPa")
    >>> oil.pressure_coefficient
    2e-08
    """

    kind: ClassVar[str] = "barus"
    cite: ClassVar[str] = "viscosity over pressure: Barus 1893"
    highest_pressure: ClassVar[float] = 1e8

    def pressure_law(self, viscosity: float) -> PressureLaw:
        """See `PressureViscosity.pressure_law`."""
        from ...lubrication.flow_laws.pressure_laws import Barus

        return Barus(coefficient=self.pressure_coefficient)


@frozen(kw_only=True)
class RoelandsViscosity(PressureViscosity):
    r"""Viscosity over pressure up to some 1 GPa (Roelands).

    .. math:: \eta = \eta_0 \exp\left\{(\ln\eta_0 + 9.67)
              \left[\left(1 + \frac{p}{p_r}\right)^Z - 1\right]\right\}, \qquad
              Z = \frac{\alpha\,p_r}{\ln\eta_0 + 9.67}

    with :math:`\eta_0` in Pa.s and :math:`p_r` = 196 MPa.

    Parameters
    ----------
    pressure_coefficient : float
        :math:`\alpha`, the slope of :math:`\ln\eta` at ambient pressure [1/Pa].
    source : str
        Source of the constants.

    Notes
    -----
    The exponent Z follows from the viscosity at the temperature of the scene, with the same
    coefficient. For a liquid as thin as 63 uPa.s the law has no meaning.

    References
    ----------
    Roelands (1966), Correlational aspects of the viscosity-temperature-pressure relationship of
    lubricating oils; Hamrock, Fundamentals of Fluid Film Lubrication, Eq. (4.10).

    Examples
    --------
    >>> RoelandsViscosity(pressure_coefficient=2e-8).kind
    'roelands'
    """

    kind: ClassVar[str] = "roelands"
    cite: ClassVar[str] = "viscosity over pressure: Roelands 1966"
    highest_pressure: ClassVar[float] = 1e9

    def pressure_law(self, viscosity: float) -> PressureLaw:
        """See `PressureViscosity.pressure_law`.

        Raises
        ------
        DescriptionError
            If the liquid is thinner than the pole that the law gives to all liquids.
        """
        from ...lubrication.flow_laws.pressure_laws import (
            POLE_LOGARITHM,
            POLE_PRESSURE,
            Roelands,
        )

        height = math.log(viscosity) + POLE_LOGARITHM
        if not height > 0.0:
            raise DescriptionError(
                "Liquid.viscosity",
                viscosity,
                f"exceed {math.exp(-POLE_LOGARITHM):.3g} for the law of Roelands",
                unit="Pa.s",
                hint="it is meant for oils; take BarusViscosity(pressure_coefficient=...)",
            )
        exponent = self.pressure_coefficient * POLE_PRESSURE / height
        return Roelands(viscosity=viscosity, exponent=exponent)
