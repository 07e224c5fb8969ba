"""Water: surface tension (IAPWS R1-76) and density (Kell) as functions of temperature.

Both are reference formulas with their constants; a file only names them.
"""

from __future__ import annotations

from typing import ClassVar

from attrs import field, frozen

from ..units import celsius, si
from ..validators import positive
from .temperature_laws import TemperatureLaw

__all__ = ["IapwsSurfaceTension", "KellWaterDensity"]

_CRITICAL_TEMPERATURE = 647.096  # IAPWS R1-76(2014) [K]
_FREEZES_BY_ITSELF = 231.0  # homogeneous nucleation of ice, near -42 degC [K]
# Kell (1975), Eq. 16, numerator, highest power first, in kg/m3 and degC
_KELL = (-280.54253e-12, 105.56302e-9, -46.170461e-6, -7.9870401e-3, 16.945176, 999.83952)


@frozen(kw_only=True)
class IapwsSurfaceTension(TemperatureLaw):
    r"""Surface tension of water against its vapour (IAPWS R1-76).

    .. math:: \gamma = 235.8\,\mathrm{mN/m}\; \tau^{1.256} (1 - 0.625\,\tau),
              \quad \tau = 1 - T / 647.096\,\mathrm{K}

    Parameters
    ----------
    temperature_min, temperature_max : float
        Range [K]. Default: -25 degC to just below the critical point. The release holds from the
        triple point on and states that it extrapolates well down to -25 degC.
    source : str
        Source of the law.

    Notes
    -----
    Against air the value is the same within 0.1 mN/m. Solutes are neglected: surfactants can halve
    it.

    References
    ----------
    .. [1] IAPWS R1-76(2014), Revised release on surface tension of ordinary water substance.

    Examples
    --------
    >>> from contactkit.units import celsius
    >>> f"{IapwsSurfaceTension()(celsius(25.0)) * 1e3:.3f} mN/m"
    '71.972 mN/m'
    """

    kind: ClassVar[str] = "iapws-surface-tension"
    unit: ClassVar[str] = "N/m"
    why: ClassVar[str] = "at the critical point liquid and vapour become one"

    temperature_min: float = field(default=celsius(-25.0), validator=positive, metadata=si("K"))
    temperature_max: float = field(default=647.0, validator=positive, metadata=si("K"))
    source: str = "IAPWS R1-76(2014)"

    @property
    def meaningful(self) -> tuple[float, float]:
        """Temperatures [K] below the critical point."""
        return 0.0, _CRITICAL_TEMPERATURE

    def value_at(self, temperature: float) -> float:
        """See `TemperatureLaw.value_at`."""
        tau = 1.0 - temperature / _CRITICAL_TEMPERATURE
        return float(235.8e-3 * tau**1.256 * (1.0 - 0.625 * tau))


@frozen(kw_only=True)
class KellWaterDensity(TemperatureLaw):
    r"""Density of water at one atmosphere (Kell 1975, Eq. 16).

    .. math:: \rho = \frac{\sum_{k=0}^5 a_k t^k}{1 + 0.01687985\,t}, \quad t = T - 273.15

    Parameters
    ----------
    temperature_min, temperature_max : float
        Range [K]. Default: that of the fit, 0 to 150 degC.
    source : str
        Source of the law.

    Notes
    -----
    Neglected: compressibility (0.05 % per MPa), dissolved air, and the difference to the
    temperature scale of 1968 used by Kell (some 0.02 kg/m3 at 100 degC, less below).

    References
    ----------
    .. [1] G. S. Kell, J. Chem. Eng. Data 20 (1975) 97-105.

    Examples
    --------
    >>> from contactkit.units import celsius
    >>> round(KellWaterDensity()(celsius(25.0)), 2)
    997.04
    """

    kind: ClassVar[str] = "kell-water-density"
    unit: ClassVar[str] = "kg/m3"
    why: ClassVar[str] = "colder, water freezes by itself; at the critical point it is no liquid"

    temperature_min: float = field(default=celsius(0.0), validator=positive, metadata=si("K"))
    temperature_max: float = field(default=celsius(150.0), validator=positive, metadata=si("K"))
    source: str = "Kell, J. Chem. Eng. Data 20 (1975) 97, Eq. 16"

    @property
    def meaningful(self) -> tuple[float, float]:
        """Temperatures [K] of (supercooled) liquid water; the pole at 214 K lies below them."""
        return _FREEZES_BY_ITSELF, _CRITICAL_TEMPERATURE

    def value_at(self, temperature: float) -> float:
        """See `TemperatureLaw.value_at`."""
        t = temperature - celsius(0.0)
        total = 0.0
        for coefficient in _KELL:
            total = total * t + coefficient
        return total / (1.0 + 16.879850e-3 * t)
