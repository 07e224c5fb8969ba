"""Viscosity as a function of temperature: the laws of Walther (ASTM D341) and Vogel."""

from __future__ import annotations

import math
from typing import ClassVar

from attrs import field, frozen

from ..errors import DescriptionError
from ..units import cSt, si
from ..validators import non_negative, positive
from .temperature_laws import SUSPECT_CELSIUS, TemperatureLaw, celsius_hint

__all__ = ["MAX_KINEMATIC_VISCOSITY", "VogelViscosity", "WaltherViscosity", "centistokes_hint"]

# Numbers of lubricants in cSt are above it; in m2/s only bitumen and the like are.
MAX_KINEMATIC_VISCOSITY = 1.0
"""A million cSt [m2/s]: above it a missing conversion is suspected."""

_MIN_KINEMATIC_VISCOSITY = 0.4 * cSt  # the double logarithm of Walther ends at 0.3 cSt
# Between the two temperatures of Walther [K]. An error of 0.1 % in one viscosity of an oil of 46
# cSt becomes 3 % at 60 K from them where they are 1 K apart, 0.35 % at 10 K and 0.1 % at 50 K.
_MIN_TEMPERATURE_DISTANCE = 1.0
# By convention a liquid is a glass from 1e12 Pa.s on, some 1e9 m2/s, long before the formulas
# overflow.
_GLASS, _GLASS_KINEMATIC = 1e12, 1e9


def centistokes_hint(kinematic_viscosity: float) -> str:
    """Hint for a kinematic viscosity that may be in cSt; empty if it is plausible."""
    if not kinematic_viscosity > MAX_KINEMATIC_VISCOSITY:
        return ""
    number = f"{kinematic_viscosity:g}"
    return f"was it given in cSt? write '{number} cSt' in a file, or {number}*cSt"


@frozen(kw_only=True)
class WaltherViscosity(TemperatureLaw):
    r"""Kinematic viscosity of a petroleum oil through two measured points (ASTM D341).

    .. math:: \log_{10}\log_{10}(\nu/\mathrm{cSt} + 0.7) = A - B \log_{10} T

    Parameters
    ----------
    temperature_1, temperature_2 : float
        The two temperatures [K], in either order, at least 1 K apart.
    kinematic_viscosity_1, kinematic_viscosity_2 : float
        Kinematic viscosities there [m2/s], at least 0.4 cSt, the lower one at the higher
        temperature.
    temperature_min, temperature_max : float
        Range [K]. Default: -30 to 450 degF, the range of the charts of the standard. The oil itself
        has narrower limits: its cloud point and its boiling range.
    source : str
        Source of the two points.

    Raises
    ------
    DescriptionError
        If the viscosity does not decrease with temperature.

    Notes
    -----
    Below 2 cSt the standard adds exp(-1.47 - 1.84 nu - 0.51 nu^2) to the 0.7, which is omitted
    here: 0.001 cSt at 2 cSt, 0.02 at 1 cSt, 0.08 at 0.5 cSt. Also neglected: wax and polymers,
    which raise the viscosity of a cold oil above the law, and high shear rates and pressures.

    References
    ----------
    .. [1] ASTM D341, Viscosity-temperature equations and charts for liquid petroleum or
       hydrocarbon products. Range of the charts: ASTM STP 43B (1957), note to table V.

    Examples
    --------
    >>> from contactkit.units import celsius, cSt
    >>> oil = WaltherViscosity(
    ...     temperature_1=celsius(40.0),
    ...     kinematic_viscosity_1=46e-6,
    ...     temperature_2=celsius(100.0),
    ...     kinematic_viscosity_2=6.8e-6,
    ... )
    >>> f"{oil(celsius(0.0)) / cSt:.1f} cSt"
    '577.3 cSt'
    """

    kind: ClassVar[str] = "walther"
    unit: ClassVar[str] = "m2/s"
    why: ClassVar[str] = "below it the law describes a glass, not a liquid"

    temperature_1: float = field(validator=positive, metadata=si("K"))
    kinematic_viscosity_1: float = field(validator=positive, metadata=si("m2/s"))
    temperature_2: float = field(validator=positive, metadata=si("K"))
    kinematic_viscosity_2: float = field(validator=positive, metadata=si("m2/s"))
    temperature_min: float = field(default=238.71, validator=positive, metadata=si("K"))
    temperature_max: float = field(default=505.37, validator=positive, metadata=si("K"))

    def __attrs_post_init__(self) -> None:
        for point in (1, 2):
            self._check_point(point)
        if abs(self.temperature_2 - self.temperature_1) < _MIN_TEMPERATURE_DISTANCE:
            raise DescriptionError(
                "WaltherViscosity.temperature_2",
                self.temperature_2,
                "differ from temperature_1 by at least 1",
                unit="K",
                hint="two points 50 K apart or more make a line that can be trusted",
            )
        if not self._line[2] < 0.0:
            raise DescriptionError(
                "WaltherViscosity.kinematic_viscosity_2",
                self.kinematic_viscosity_2,
                "belong to an oil that thins as it warms",
                unit="m2/s",
                hint=f"it is given at {self.temperature_2:.6g} K, beside "
                f"{self.kinematic_viscosity_1!r} at {self.temperature_1:.6g} K; swapped?",
            )
        super().__attrs_post_init__()

    def _check_point(self, point: int) -> None:
        temperature = getattr(self, f"temperature_{point}")
        if temperature < SUSPECT_CELSIUS:
            raise DescriptionError(
                f"WaltherViscosity.temperature_{point}",
                temperature,
                f"be at least {SUSPECT_CELSIUS:g}",
                unit="K",
                hint=celsius_hint(temperature),
            )
        viscosity = getattr(self, f"kinematic_viscosity_{point}")
        if not _MIN_KINEMATIC_VISCOSITY <= viscosity <= MAX_KINEMATIC_VISCOSITY:
            raise DescriptionError(
                f"WaltherViscosity.kinematic_viscosity_{point}",
                viscosity,
                "lie between 4e-07 (0.4 cSt) and 1",
                unit="m2/s",
                hint=centistokes_hint(viscosity),
            )

    @property
    def _line(self) -> tuple[float, float, float]:
        """Point 1 on the chart and the slope there, which lose fewer digits than A and B."""
        x1, x2 = math.log10(self.temperature_1), math.log10(self.temperature_2)
        y1, y2 = _chart(self.kinematic_viscosity_1), _chart(self.kinematic_viscosity_2)
        return x1, y1, (y2 - y1) / (x2 - x1)

    @property
    def meaningful(self) -> tuple[float, float]:
        """Temperatures [K] above the glass; at high temperature the law tends to 0.3 cSt."""
        x, y, slope = self._line
        return float(10.0 ** (x + (_chart(_GLASS_KINEMATIC) - y) / slope)), math.inf

    def value_at(self, temperature: float) -> float:
        """See `TemperatureLaw.value_at`."""
        x, y, slope = self._line
        ordinate = y + slope * (math.log10(temperature) - x)
        return float(10.0 ** (10.0**ordinate) - 0.7) * cSt


def _chart(kinematic_viscosity: float) -> float:
    """Ordinate of the ASTM chart, on which oils are straight lines."""
    return math.log10(math.log10(kinematic_viscosity / cSt + 0.7))


@frozen(kw_only=True)
class VogelViscosity(TemperatureLaw):
    r"""Dynamic viscosity that diverges at a finite temperature (Vogel).

    .. math:: \eta = \eta_0 \, 10^{B/(T - C)}

    Parameters
    ----------
    reference_viscosity : float
        :math:`\eta_0`, the limit at high temperature [Pa.s].
    activation_temperature : float
        :math:`B` [K], in a power of ten, not of e.
    divergence_temperature : float
        :math:`C` [K]; zero gives the law of Andrade.
    temperature_min, temperature_max, source
        See `TemperatureLaw`.

    Raises
    ------
    DescriptionError
        If a constant is out of range, or the range of the law reaches into the glass.

    Notes
    -----
    With 2.414e-5 Pa.s, 247.8 K and 140 K the viscosity of water is 2 % too low at 0 degC, 1 % too
    low at 100 degC, and within 0.1 % at 20 and 25 degC. Pressure is neglected.

    Examples
    --------
    >>> from contactkit.units import celsius
    >>> water = VogelViscosity(
    ...     reference_viscosity=2.414e-5,
    ...     activation_temperature=247.8,
    ...     divergence_temperature=140.0,
    ...     temperature_min=celsius(0.0),
    ...     temperature_max=celsius(100.0),
    ... )
    >>> f"{water(celsius(25.0)) * 1e3:.5f} mPa.s"
    '0.89044 mPa.s'
    """

    kind: ClassVar[str] = "vogel"
    unit: ClassVar[str] = "Pa.s"
    why: ClassVar[str] = "below it the law describes a glass, not a liquid"

    reference_viscosity: float = field(validator=positive, metadata=si("Pa.s"))
    activation_temperature: float = field(validator=positive, metadata=si("K"))
    divergence_temperature: float = field(validator=non_negative, metadata=si("K"))

    def __attrs_post_init__(self) -> None:
        if self.reference_viscosity >= 1.0:
            raise DescriptionError(
                "VogelViscosity.reference_viscosity",
                self.reference_viscosity,
                "be below 1",
                unit="Pa.s",
                hint="the law tends to it when hot, where liquids have some 1e-5 Pa.s",
            )
        super().__attrs_post_init__()

    @property
    def meaningful(self) -> tuple[float, float]:
        """Temperatures [K] above the glass, which lies above `divergence_temperature`."""
        decades = math.log10(_GLASS) - math.log10(self.reference_viscosity)
        return self.divergence_temperature + self.activation_temperature / decades, math.inf

    def value_at(self, temperature: float) -> float:
        """See `TemperatureLaw.value_at`."""
        decades = self.activation_temperature / (temperature - self.divergence_temperature)
        # One power, because a factor could overflow where the product does not.
        return float(10.0 ** (math.log10(self.reference_viscosity) + decades))
