"""Liquids: surface tension, viscosity and density, constant or as functions of temperature."""

from __future__ import annotations

from typing import Any

from attrs import Attribute, field, fields, fields_dict, frozen

from ..errors import DescriptionError
from ..kinds import TEMPERATURE_LAWS
from ..units import si
from ..validators import Described, optional, part, positive, refuse
from .rheology.density import PressureDensity
from .rheology.pressure import PressureViscosity
from .rheology.shear import ShearViscosity
from .temperature_laws import TemperatureLaw, celsius_hint
from .viscosity import MAX_KINEMATIC_VISCOSITY, centistokes_hint

__all__ = ["Liquid", "LiquidState"]

# Values beyond these are taken for numbers in mN/m, g/mol and GPa. They lie between what occurs in
# SI units (molten metals 2.5 N/m, polymer oils some kg/mol, liquids 0.3 GPa and more) and what the
# other unit would give (perfluorohexane 12 mN/m, water 18 g/mol, liquids 0.3 to 5 GPa).
_MAX_SURFACE_TENSION = 10.0  # [N/m]
_MAX_MOLAR_MASS = 10.0  # [kg/mol]
_MIN_BULK_MODULUS = 1e5  # [Pa]; foams are softer, and are no liquids here
_MIN_HEAT_CAPACITY = 50.0  # [J/kg/K]; mercury has 139, water in kJ/kg/K 4.2


@frozen
class LiquidState:
    """Properties of a liquid at one temperature.

    A property that the liquid does not give is refused where it is read; `missing` asks first,
    and `given` returns None for it.
    """

    _surface_tension: float | None
    _viscosity: float | None
    _density: float | None
    temperature: float = field(metadata=si("K"))
    _bulk_modulus: float | None = None

    @property
    def surface_tension(self) -> float:
        """Surface tension [N/m]."""
        return self._known("surface_tension")

    @property
    def viscosity(self) -> float:
        """Dynamic viscosity [Pa.s]."""
        return self._known("viscosity")

    @property
    def density(self) -> float:
        """Density [kg/m3]."""
        return self._known("density")

    @property
    def bulk_modulus(self) -> float:
        """Bulk modulus [Pa]."""
        return self._known("bulk_modulus")

    def given(self, name: str) -> float | None:
        """Return a property by its name; None if the liquid does not give it."""
        value: float | None = getattr(self, f"_{name}")
        return value

    def missing(self, *names: str) -> tuple[str, ...]:
        """Those of some properties that the liquid does not give, each with its unit."""
        units = fields_dict(Liquid)
        return tuple(
            f"liquid.{name} [{units[name].metadata['unit']}]"
            for name in names
            if self.given(name) is None
        )

    def _known(self, name: str) -> float:
        value = self.given(name)
        if value is None:
            unit = fields_dict(Liquid)[name].metadata["unit"]
            raise DescriptionError(f"Liquid.{name}", None, "be given", unit=unit)
        return value


def _constant_or_law(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Refuse anything but a positive number or a law of the same unit."""
    if not isinstance(value, TemperatureLaw):
        positive(owner, attribute, value)
    elif value.unit != attribute.metadata["unit"]:
        unit = attribute.metadata["unit"]
        kinds = ", ".join(repr(law.kind) for law in TEMPERATURE_LAWS if law.unit == unit)
        raise refuse(
            owner,
            attribute,
            value.kind,
            "be a number or a law of the same unit",
            f"the law {value.kind!r} gives {value.unit}; laws that fit: {kinds}",
        )


def _tension(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Like `_constant_or_law`; the hint suggests mN/m, as molten metals reach only 2.5 N/m."""
    _constant_or_law(owner, attribute, value)
    if not isinstance(value, TemperatureLaw) and value > _MAX_SURFACE_TENSION:
        cure = f"was it given in mN/m? write '{value:g} mN/m' in a file, or {value:g}*mN"
        raise refuse(owner, attribute, value, f"be at most {_MAX_SURFACE_TENSION:g}", cure)


def _kinematic(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Like `_constant_or_law`; the hint suggests cSt for a value far too large."""
    _constant_or_law(owner, attribute, value)
    if not isinstance(value, TemperatureLaw) and value > MAX_KINEMATIC_VISCOSITY:
        expected = f"be at most {MAX_KINEMATIC_VISCOSITY:g}"
        raise refuse(owner, attribute, value, expected, centistokes_hint(value))


def _molar(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Refuse anything but a positive number; the hint suggests g/mol above 10 kg/mol."""
    positive(owner, attribute, value)
    if value > _MAX_MOLAR_MASS:
        cure = f"was it given in g/mol? write '{value:g} g/mol' in a file, or {value:g}e-3"
        raise refuse(owner, attribute, value, f"be at most {_MAX_MOLAR_MASS:g}", cure)


def _bulk(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Refuse anything but a positive number; the hint suggests GPa for one far too small."""
    positive(owner, attribute, value)
    if value < _MIN_BULK_MODULUS:
        cure = f"was it given in GPa? write '{value:g} GPa' in a file, or {value:g}e9"
        raise refuse(owner, attribute, value, f"be at least {_MIN_BULK_MODULUS:g}", cure)


def _heat(owner: object, attribute: Attribute[Any], value: Any) -> None:
    """Refuse anything but a positive number; the hint suggests kJ/kg/K for one far too small."""
    positive(owner, attribute, value)
    if value < _MIN_HEAT_CAPACITY:
        cure = f"was it given in kJ/kg/K? write '{value:g} kJ/kg/K' in a file, or {value:g}e3"
        raise refuse(owner, attribute, value, f"be at least {_MIN_HEAT_CAPACITY:g}", cure)


@frozen(kw_only=True)
class Liquid(Described):
    """A liquid; properties that no effect needs may be omitted.

    Parameters
    ----------
    name : str
        Name of the liquid.
    surface_tension : float or TemperatureLaw, optional
        Surface tension against air [N/m].
    viscosity : float or TemperatureLaw, optional
        Dynamic viscosity [Pa.s].
    kinematic_viscosity : float or TemperatureLaw, optional
        Kinematic viscosity [m2/s], instead of `viscosity` and only together with a density,
        because forces depend on the dynamic viscosity.
    density : float or TemperatureLaw, optional
        Density [kg/m3].
    molar_mass : float, optional
        Molar mass [kg/mol], for a liquid that condenses from its vapour.
    bulk_modulus : float, optional
        Bulk modulus [Pa] at low pressure, without bubbles. Films are taken for incompressible; it
        says how far they are.
    pressure_viscosity : BarusViscosity or RoelandsViscosity, optional
        Viscosity over pressure. None: it stays.
    shear_viscosity : PowerLawViscosity, CarreauViscosity or EyringViscosity, optional
        Viscosity over the rate of shear. None: a Newtonian liquid.
    pressure_density : DowsonHigginsonDensity, optional
        Density over pressure, in place of a `bulk_modulus`.
    heat_capacity : float, optional
        Specific heat capacity [J/kg/K]; with it a film states how far it may heat itself.
    thermal_conductivity : float, optional
        Thermal conductivity [W/m/K], for the same.
    source : str
        Source of the constants; laws carry their own source.

    Raises
    ------
    DescriptionError
        If a constant is not positive and finite, or seems to be in mN/m or cSt; if the unit of a
        law is not that of the field; if both viscosities are given; if a kinematic viscosity is
        given without a density; if both a bulk modulus and a density over pressure are given.

    Notes
    -----
    A `ViscousForce` computes what its numbers call for of pressure and shear. Neglected: ageing,
    elasticity (normal stress), and layers that solidify at a wall.

    Examples
    --------
    >>> from contactkit.liquids.viscosity import WaltherViscosity
    >>> from contactkit.units import celsius, cSt
    >>> oil = Liquid(
    ...     name="mineral oil",
    ...     surface_tension=30e-3,
    ...     kinematic_viscosity=WaltherViscosity(
    ...         temperature_1=celsius(40.0),
    ...         kinematic_viscosity_1=105 * cSt,
    ...         temperature_2=celsius(100.0),
    ...         kinematic_viscosity_2=14.2 * cSt,
    ...     ),
    ...     density=880.0,
    ... )
    >>> cold, warm = oil.at(celsius(-20.0)), oil.at(celsius(40.0))
    >>> f"{cold.viscosity / warm.viscosity:.0f} times as thick"
    '80 times as thick'
    """

    name: str = field()
    surface_tension: float | TemperatureLaw | None = field(
        default=None, validator=optional(_tension), metadata=si("N/m")
    )
    viscosity: float | TemperatureLaw | None = field(
        default=None, validator=optional(_constant_or_law), metadata=si("Pa.s")
    )
    kinematic_viscosity: float | TemperatureLaw | None = field(
        default=None, validator=optional(_kinematic), metadata=si("m2/s")
    )
    density: float | TemperatureLaw | None = field(
        default=None, validator=optional(_constant_or_law), metadata=si("kg/m3")
    )
    molar_mass: float | None = field(
        default=None, validator=optional(_molar), metadata=si("kg/mol")
    )
    bulk_modulus: float | None = field(default=None, validator=optional(_bulk), metadata=si("Pa"))
    pressure_viscosity: PressureViscosity | None = field(
        default=None, validator=optional(part(PressureViscosity))
    )
    shear_viscosity: ShearViscosity | None = field(
        default=None, validator=optional(part(ShearViscosity))
    )
    pressure_density: PressureDensity | None = field(
        default=None, validator=optional(part(PressureDensity))
    )
    heat_capacity: float | None = field(
        default=None, validator=optional(_heat), metadata=si("J/kg/K")
    )
    thermal_conductivity: float | None = field(
        default=None, validator=optional(positive), metadata=si("W/m/K")
    )
    source: str = ""

    def __attrs_post_init__(self) -> None:
        if self.pressure_density is not None and self.bulk_modulus is not None:
            expected, kind = "be left out where bulk_modulus is given", self.pressure_density.kind
            where = fields(Liquid).pressure_density
            raise refuse(self, where, kind, expected, "keep one of the two")
        if self.kinematic_viscosity is None:
            return
        attribute, value = fields(Liquid).kinematic_viscosity, _shown(self.kinematic_viscosity)
        if self.viscosity is not None:
            expected = "be left out where viscosity is given"
            raise refuse(self, attribute, value, expected, "keep one of the two")
        if self.density is None:
            cure = "give density too, or viscosity in Pa.s"
            raise refuse(self, attribute, value, "come together with a density", cure)

    def at(self, temperature: float) -> LiquidState:
        """Properties of the liquid at `temperature` [K].

        Raises
        ------
        DescriptionError
            If the temperature is not positive and finite, or outside the domain of a law.

        Warns
        -----
        ValidityWarning
            If a law is used outside its fitted range.
        """
        if not 0.0 < temperature < float("inf"):
            raise DescriptionError(
                "Liquid.at(temperature)",
                temperature,
                "be positive and finite",
                unit="K",
                hint=celsius_hint(temperature),
            )
        viscosity = _value(self.viscosity, temperature)
        density = _value(self.density, temperature)
        kinematic = _value(self.kinematic_viscosity, temperature)
        if kinematic is not None and density is not None:
            viscosity = kinematic * density
        surface_tension = _value(self.surface_tension, temperature)
        return LiquidState(
            surface_tension, viscosity, density, float(temperature), self.bulk_modulus
        )

    @property
    def is_newtonian(self) -> bool:
        """Whether its viscosity depends on neither pressure nor shear."""
        return self.pressure_viscosity is None and self.shear_viscosity is None

    def molar_volume(self, temperature: float) -> float:
        """Molar volume [m3/mol] at `temperature` [K].

        Raises
        ------
        DescriptionError
            If molar mass or density is not given.

        Examples
        --------
        >>> water = Liquid(name="water", density=998.2, molar_mass=0.018015)
        >>> round(water.molar_volume(293.15) * 1e6, 3)
        18.047
        """
        return self.molar_volume_of(self.at(temperature))

    def molar_volume_of(self, state: LiquidState) -> float:
        """Molar volume [m3/mol] of this liquid in a state that is known.

        Raises
        ------
        DescriptionError
            If molar mass or density is not given.
        """
        density = state.given("density")
        if self.molar_mass is None or density is None:
            name, unit = ("density", "kg/m3") if density is None else ("molar_mass", "kg/mol")
            raise DescriptionError(
                f"Liquid.{name}",
                None,
                "be given for a liquid in equilibrium with its vapour",
                unit=unit,
                hint="or give the meniscus a volume, or its pressure",
            )
        return self.molar_mass / density


def _value(given: float | TemperatureLaw | None, temperature: float) -> float | None:
    if given is None:
        return None
    return given(temperature) if isinstance(given, TemperatureLaw) else float(given)


def _shown(given: float | TemperatureLaw) -> float | str:
    return given.kind if isinstance(given, TemperatureLaw) else given
