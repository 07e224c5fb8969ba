"""Temperature laws of liquid properties: the base class, and linear laws.

A law is called with a temperature [K] and returns one number in SI units. Outside its fitted range
it warns; where it no longer describes a liquid it raises an error. Only `math` is needed: laws run
inside FMUs, in an interpreter without numpy.
"""

from __future__ import annotations

import math
import warnings
from abc import ABC, abstractmethod
from typing import ClassVar

from attrs import field, frozen

from ..errors import DescriptionError, ValidityWarning
from ..units import si
from ..validators import Described, finite, positive

__all__ = [
    "SUSPECT_CELSIUS",
    "LinearDensity",
    "LinearLaw",
    "LinearSurfaceTension",
    "TemperatureLaw",
    "celsius_hint",
]

# Higher, it would catch hotter oils in degrees Celsius and suspect cold liquids in kelvin: light
# alkanes still flow at 150 K (-123 degC), and few lubricants are used above 150 degC.
SUSPECT_CELSIUS = 150.0
"""Temperature [K] below which degrees Celsius are suspected."""


def celsius_hint(temperature: float) -> str:
    """Hint for a temperature that may be in degrees Celsius; empty if it is plausible."""
    if not -273.15 <= temperature < SUSPECT_CELSIUS:
        return ""
    return (
        f"was it meant in degrees Celsius? then write celsius({temperature!r}), "
        f"or '{temperature:g} degC' in a file"
    )


@frozen(kw_only=True)
class TemperatureLaw(Described, ABC):
    """One property of a liquid as a function of temperature.

    Parameters
    ----------
    temperature_min, temperature_max : float
        Fitted range [K]; outside it a `ValidityWarning` is issued.
    source : str
        Source of the constants.

    Raises
    ------
    DescriptionError
        If the range is empty, or not within the domain of the law.
    """

    family: ClassVar[str] = "temperature law"
    kind: ClassVar[str]
    """Name of the law in files."""
    unit: ClassVar[str]
    """Unit of the property."""
    why: ClassVar[str]
    """Why the law ends at the bounds of `meaningful`, for messages."""

    temperature_min: float = field(validator=positive, metadata=si("K"))
    temperature_max: float = field(validator=positive, metadata=si("K"))
    source: str = ""

    def __attrs_post_init__(self) -> None:
        low, high = self.meaningful
        given = (self.temperature_min, self.temperature_max)
        if not low < given[0] < given[1] < high:
            raise DescriptionError(
                f"{type(self).__name__}.temperature_min and temperature_max",
                given,
                f"rise, and both {_between(low, high)}",
                unit="K",
                hint=self.why,
            )

    def __call__(self, temperature: float) -> float:
        """Value at `temperature` [K], in `unit`.

        Raises
        ------
        DescriptionError
            If the temperature is outside the domain of the law.

        Warns
        -----
        ValidityWarning
            If the temperature is outside the fitted range.
        """
        low, high = self.meaningful
        if not (math.isfinite(temperature) and low < temperature < high):
            raise self._refusal(temperature)
        value = self.value_at(temperature)
        # Just inside the bounds a law may still underflow or overflow.
        if not 0.0 < value < math.inf:
            raise self._refusal(temperature)
        if not self.temperature_min <= temperature <= self.temperature_max:
            # Whole kelvins, so that a drifting temperature does not warn at every step.
            hints = (self.source, celsius_hint(temperature))
            warnings.warn(
                f"{type(self).__name__} holds {self._range} "
                f"and was evaluated at {temperature:.0f} K"
                + "".join(f"; {hint}" for hint in hints if hint),
                ValidityWarning,
                stacklevel=2,
            )
        return value

    def _refusal(self, temperature: float) -> DescriptionError:
        hints = (self.why, f"the law is meant to hold {self._range}", celsius_hint(temperature))
        return DescriptionError(
            f"{type(self).__name__}.temperature",
            temperature,
            _between(*self.meaningful),
            unit="K",
            hint="; ".join(hint for hint in hints if hint),
        )

    @property
    def _range(self) -> str:
        return f"from {self.temperature_min:.6g} to {self.temperature_max:.6g} K"

    @property
    @abstractmethod
    def meaningful(self) -> tuple[float, float]:
        """Domain of the formula [K], ends excluded."""

    @abstractmethod
    def value_at(self, temperature: float) -> float:
        """Evaluate the formula; the temperature has been checked."""


def _between(low: float, high: float) -> str:
    if math.isinf(high):
        return f"be above {low:.6g}"
    return f"lie between {low:.6g} and {high:.6g}"


@frozen(kw_only=True)
class LinearLaw(TemperatureLaw):
    """A property linear in temperature, through its value at a reference temperature.

    Raises
    ------
    DescriptionError
        If a constant is out of range, or the property falls to zero within the range of the law.
    """

    why: ClassVar[str] = "beyond it the straight line is no longer positive"

    value: float = field(validator=positive)
    slope: float = field(validator=finite)
    reference_temperature: float = field(validator=positive, metadata=si("K"))

    @property
    def meaningful(self) -> tuple[float, float]:
        """Temperatures [K] at which the line is positive."""
        if self.slope == 0.0:
            return 0.0, math.inf
        zero = self.reference_temperature - self.value / self.slope
        return (0.0, zero) if self.slope < 0.0 else (max(0.0, zero), math.inf)

    def value_at(self, temperature: float) -> float:
        """See `TemperatureLaw.value_at`."""
        return self.value + self.slope * (temperature - self.reference_temperature)


@frozen(kw_only=True)
class LinearSurfaceTension(LinearLaw):
    """Surface tension of an oil, linear in temperature.

    Parameters
    ----------
    value : float
        Surface tension at the reference temperature [N/m].
    slope : float
        Change with temperature [N/m/K], negative for pure liquids.
    reference_temperature : float
        Temperature of `value` [K].
    temperature_min, temperature_max, source
        See `TemperatureLaw`.

    Notes
    -----
    The neglected curvature (a power 11/9 of the distance to the critical point) is below 2 %
    within 100 K of the reference for an oil with a critical point beyond 700 K.

    Examples
    --------
    >>> from contactkit.units import celsius
    >>> oil = LinearSurfaceTension(
    ...     value=30e-3,
    ...     slope=-0.09e-3,
    ...     reference_temperature=celsius(20.0),
    ...     temperature_min=celsius(-20.0),
    ...     temperature_max=celsius(120.0),
    ... )
    >>> round(oil(celsius(100.0)), 6)
    0.0228
    """

    kind: ClassVar[str] = "linear-surface-tension"
    unit: ClassVar[str] = "N/m"

    value: float = field(validator=positive, metadata=si("N/m"))
    slope: float = field(validator=finite, metadata=si("N/m/K"))


@frozen(kw_only=True)
class LinearDensity(LinearLaw):
    """Density of a liquid, linear in temperature.

    Parameters
    ----------
    value : float
        Density at the reference temperature [kg/m3].
    slope : float
        Change with temperature [kg/m3/K]: minus density times thermal expansion.
    reference_temperature : float
        Temperature of `value` [K]; 15 degC by convention.
    temperature_min, temperature_max, source
        See `TemperatureLaw`.

    Notes
    -----
    From -20 to 100 degC the line stays within 0.1 % of the exponential that ASTM D1250 gives for
    lubricating oils. Compressibility is neglected: some 0.06 % per MPa.

    Examples
    --------
    >>> from contactkit.units import celsius
    >>> oil = LinearDensity(
    ...     value=880.0,
    ...     slope=-0.6278,
    ...     reference_temperature=celsius(15.0),
    ...     temperature_min=celsius(-20.0),
    ...     temperature_max=celsius(120.0),
    ... )
    >>> round(oil(celsius(40.0)), 3)
    864.305
    """

    kind: ClassVar[str] = "linear-density"
    unit: ClassVar[str] = "kg/m3"

    value: float = field(validator=positive, metadata=si("kg/m3"))
    slope: float = field(validator=finite, metadata=si("kg/m3/K"))
