r"""Viscosity over the rate of shear: power law, Carreau-Yasuda, Eyring.

All begin at the viscosity :math:`\eta_0` of the liquid at its temperature. A law holds constants;
`contactkit.lubrication.flow_laws` evaluates it. Times of relaxation and stresses are those
at the temperature of the scene: no law shifts them with it.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, ClassVar

from attrs import Attribute, field, frozen

from ...units import si
from ...validators import Described, non_negative, positive, refuse

if TYPE_CHECKING:
    from ...lubrication.flow_laws.base import FlowLaw

__all__ = ["CarreauViscosity", "EyringViscosity", "PowerLawViscosity", "ShearViscosity"]

_LEAST_EXPONENT = 0.1  # polymer melts are at 0.2 to 0.8; below, a liquid slips like a solid
_MOST_EXPONENT = 1.5  # shear-thickening suspensions; beyond, they jam
_LEAST_STRESS = 100.0  # [Pa]; those of oils are some MPa, of polymer solutions kPa


def _exponent(owner: object, attribute: Attribute[Any], value: Any) -> None:
    positive(owner, attribute, value)
    if not _LEAST_EXPONENT <= value <= _MOST_EXPONENT:
        expected = f"lie between {_LEAST_EXPONENT:g} and {_MOST_EXPONENT:g}"
        cure = "1 is a Newtonian liquid, less one that thins"
        raise refuse(owner, attribute, value, expected, cure)


def _thinning(owner: object, attribute: Attribute[Any], value: Any) -> None:
    positive(owner, attribute, value)
    if not _LEAST_EXPONENT <= value <= 1.0:
        expected = f"lie between {_LEAST_EXPONENT:g} and 1"
        cure = "of a liquid that thickens give a power-law"
        raise refuse(owner, attribute, value, expected, cure if value > 1.0 else "")


def _stress(owner: object, attribute: Attribute[Any], value: Any) -> None:
    positive(owner, attribute, value)
    if value < _LEAST_STRESS:
        cure = f"was it given in MPa? write '{value:g} MPa' in a file, or {value:g}e6"
        raise refuse(owner, attribute, value, f"be at least {_LEAST_STRESS:g}", cure)


@frozen(kw_only=True)
class ShearViscosity(Described, ABC):
    """Viscosity of a liquid over the rate of shear."""

    family: ClassVar[str] = "rheology law"
    kind: ClassVar[str]
    """Name of the law in files."""
    cite: ClassVar[str]
    """Source of its equation."""

    @abstractmethod
    def memory(self, viscosity: float) -> float:
        """Time [s] after which a liquid of a viscosity [Pa.s] at rest has forgotten its shear."""

    @abstractmethod
    def flow_law(self, viscosity: float) -> FlowLaw:
        """Law of a liquid of a viscosity [Pa.s] at rest, as films evaluate it."""


@frozen(kw_only=True)
class PowerLawViscosity(ShearViscosity):
    r"""Newtonian up to a rate of shear, a power of it beyond (Ostwald and de Waele).

    .. math:: \eta = \eta_0 \max\left(1, \frac{\dot\gamma}{\dot\gamma_c}\right)^{n - 1}

    Parameters
    ----------
    exponent : float
        n [-]: 1 is Newtonian, less thins, more thickens; 0.1 to 1.5.
    critical_rate : float
        :math:`\dot\gamma_c`, above which the liquid thins [1/s]. A consistency K [Pa.s^n] is
        :math:`\eta_0 \dot\gamma_c^{1 - n}`.
    source : str
        Source of the constants.

    Raises
    ------
    DescriptionError
        If a constant is out of its range.

    References
    ----------
    Bird, Armstrong and Hassager, Dynamics of Polymeric Liquids 1, section 4.1.

    Examples
    --------
    >>> PowerLawViscosity(exponent=0.6, critical_rate="10 1/s").critical_rate
    10.0
    """

    kind: ClassVar[str] = "power-law"
    cite: ClassVar[str] = "power law: Ostwald 1925, de Waele 1923"

    exponent: float = field(validator=_exponent, metadata=si("-"))
    critical_rate: float = field(validator=positive, metadata=si("1/s"))
    source: str = ""

    def memory(self, viscosity: float) -> float:
        """See `ShearViscosity.memory`."""
        return 1.0 / self.critical_rate

    def flow_law(self, viscosity: float) -> FlowLaw:
        """See `ShearViscosity.flow_law`."""
        from ...lubrication.flow_laws.newtonian import Newtonian
        from ...lubrication.flow_laws.power_law import PowerLaw

        n = self.exponent
        if n == 1.0:
            return Newtonian(viscosity=viscosity)
        consistency = viscosity * self.critical_rate ** (1.0 - n)
        return PowerLaw(consistency=consistency, exponent=n, plateau_viscosity=viscosity)


@frozen(kw_only=True)
class CarreauViscosity(ShearViscosity):
    r"""Viscosity that thins from one plateau to another (Carreau and Yasuda).

    .. math:: \eta = \eta_\infty + (\eta_0 - \eta_\infty)
              \left[1 + (\lambda\dot\gamma)^a\right]^{(n - 1)/a}

    Parameters
    ----------
    relaxation_time : float
        :math:`\lambda` [s]; the liquid thins at rates of shear beyond 1/lambda.
    exponent : float
        n [-], 0.1 to 1.
    second_plateau : float
        :math:`\eta_\infty/\eta_0` [-], below 1.
    sharpness : float
        Yasuda's a [-]; 2: Carreau.
    source : str
        Source of the constants.

    Raises
    ------
    DescriptionError
        If a constant is out of its range.

    References
    ----------
    Carreau (1972); Yasuda (1979); Bird, Armstrong and Hassager, Dynamics of Polymeric Liquids 1,
    Eq. (4.1-9).

    Examples
    --------
    >>> CarreauViscosity(relaxation_time="1 us", exponent=0.5).sharpness
    2.0
    """

    kind: ClassVar[str] = "carreau"
    cite: ClassVar[str] = "shear thinning: Carreau 1972, Yasuda 1979"

    relaxation_time: float = field(validator=positive, metadata=si("s"))
    exponent: float = field(validator=_thinning, metadata=si("-"))
    second_plateau: float = field(default=0.0, validator=non_negative, metadata=si("-"))
    sharpness: float = field(default=2.0, validator=positive, metadata=si("-"))
    source: str = ""

    @second_plateau.validator
    def _below_the_first(self, attribute: Attribute[Any], value: float) -> None:
        if not value < 1.0:
            hint = "it is a fraction of the viscosity at rest"
            raise refuse(self, attribute, value, "be below 1", hint)

    def memory(self, viscosity: float) -> float:
        """See `ShearViscosity.memory`."""
        return self.relaxation_time

    def flow_law(self, viscosity: float) -> FlowLaw:
        """See `ShearViscosity.flow_law`."""
        from ...lubrication.flow_laws.carreau import Carreau

        return Carreau(
            viscosity=viscosity,
            relaxation_time=self.relaxation_time,
            exponent=self.exponent,
            limit_viscosity=self.second_plateau * viscosity,
            transition=self.sharpness,
        )


@frozen(kw_only=True)
class EyringViscosity(ShearViscosity):
    r"""Viscosity that thins as stress makes molecules jump (Eyring).

    .. math:: \dot\gamma = \frac{\tau_E}{\eta_0} \sinh\frac{\tau}{\tau_E}

    Parameters
    ----------
    stress : float
        Eyring's stress :math:`\tau_E` [Pa], beyond which the liquid thins; of oils some 5 MPa.
    source : str
        Source of the constants.

    Raises
    ------
    DescriptionError
        If the stress is not positive and finite, or seems to be in MPa.

    Notes
    -----
    The pressure of a film raises the viscosity, not the stress.

    References
    ----------
    Eyring (1936); Johnson and Tevaarwerk (1977).

    Examples
    --------
    >>> EyringViscosity(stress="5 MPa").stress
    5000000.0
    """

    kind: ClassVar[str] = "eyring"
    cite: ClassVar[str] = "shear stress as a process of rates: Eyring 1936"

    stress: float = field(validator=_stress, metadata=si("Pa"))
    source: str = ""

    def memory(self, viscosity: float) -> float:
        """See `ShearViscosity.memory`."""
        return viscosity / self.stress

    def flow_law(self, viscosity: float) -> FlowLaw:
        """See `ShearViscosity.flow_law`."""
        from ...lubrication.flow_laws.eyring import Eyring

        return Eyring(viscosity=viscosity, eyring_stress=self.stress)
