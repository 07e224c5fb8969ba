"""The liquid between two bodies: its amount, and how it wets them.

Contact angles are measured through the liquid; a pressure is that of the liquid less that
outside, so that it is negative in a hollow meniscus.
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping
from typing import Literal

from attrs import Attribute, evolve, field, frozen

from ..errors import DescriptionError, nearest
from ..liquids.liquid import Liquid, LiquidState
from ..units import si
from ..validators import (
    Described,
    angle,
    as_whole,
    count,
    fraction,
    non_negative,
    optional,
    part,
    positive,
    refuse,
)

__all__ = ["Meniscus"]


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _negative(owner: object, attribute: Attribute[float], value: float) -> None:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not (number and -math.inf < value < 0.0):
        hint = "liquid of a positive pressure dries up or grows without end; give a volume"
        raise refuse(owner, attribute, value, "be negative and finite", hint if number else "")


def _humidity(owner: object, attribute: Attribute[float], value: float) -> None:
    if not (_is_number(value) and 0.0 <= value <= 1.0):
        raise refuse(owner, attribute, value, "lie between 0 and 1", "a fraction, not per cent")


def _at_gap(
    function: Callable[..., Meniscus], at_gap: float | None, earlier: Mapping[str, float]
) -> float:
    """Gap at which a radius or a coverage holds, by its name or its earlier one."""
    where, value = f"Meniscus.{function.__name__}(at_gap)", at_gap
    for name, given in earlier.items():
        if name != "gap":
            cure = nearest(name, inspect.signature(function).parameters)
            raise TypeError(f"{where[:-8]}() got an unexpected keyword argument {name!r}; {cure}")
        if at_gap is not None:
            hint = "gap is its earlier name: leave that out"
            raise DescriptionError(where, (at_gap, given), "be given once", unit="m", hint=hint)
        value = given
    if value is None:
        hint = "the gap at which that holds, such as at_gap=2e-9"
        raise DescriptionError(where, value, "be given", unit="m", hint=hint)
    if not (_is_number(value) and value > 0.0):
        raise DescriptionError(where, value, "be positive and finite", unit="m")
    return value


@frozen(kw_only=True)
class Meniscus(Described):
    """The liquid that joins the two bodies: how much, and how it wets them.

    Parameters
    ----------
    liquid : Liquid
        What it is.
    volume : float, optional
        Amount of liquid in all menisci together [m3]. With no amount given the gap is flooded: it
        stays full to the rim however far it opens.
    pressure : float, optional
        Pressure of the liquid less that outside [Pa], negative, in place of a volume: liquid
        condenses or dries up until it is reached.
    relative_humidity : float, optional
        Pressure of the vapour over that of saturation [-], in place of a volume: the liquid has
        the pressure of Kelvin's equation at the temperature of the scene. The bodies are in
        equilibrium with the vapour at every gap, which is right if condensing is faster than the
        motion. Films that vapour leaves on the bodies are left out; they add about twice their
        thickness to the height of the meniscus.
    contact_angle_lower, contact_angle_upper : float
        Contact angles on the two bodies [rad], 0 (wets) to pi (repels).
    slip_length_lower, slip_length_upper : float
        Slip lengths of the liquid on the two bodies [m]: how far beneath a wall the liquid would
        be at rest, 0 for no slip. Of water on hydrophobic glass some 20 nm.
    count : int
        Number of equal menisci the liquid is divided into.
    rewetting : float
        Fraction of `volume` that is there again, at least, each time the bodies come back
        together [-]. 0: what is lost by rupture stays lost.
    """

    liquid: Liquid = field(validator=part(Liquid))
    volume: float | None = field(default=None, validator=optional(positive), metadata=si("m3"))
    pressure: float | None = field(default=None, validator=optional(_negative), metadata=si("Pa"))
    relative_humidity: float | None = field(
        default=None, validator=optional(_humidity), metadata=si("-")
    )
    contact_angle_lower: float = field(default=0.0, validator=angle, metadata=si("rad"))
    contact_angle_upper: float = field(default=0.0, validator=angle, metadata=si("rad"))
    slip_length_lower: float = field(default=0.0, validator=non_negative, metadata=si("m"))
    slip_length_upper: float = field(default=0.0, validator=non_negative, metadata=si("m"))
    count: int = field(default=1, converter=as_whole, validator=count, metadata=si("-"))
    rewetting: float = field(default=1.0, validator=fraction, metadata=si("-"))

    def __attrs_post_init__(self) -> None:
        amounts = ("volume", "pressure", "relative_humidity")
        given = [name for name in amounts if getattr(self, name) is not None]
        if len(given) > 1:
            raise DescriptionError(
                "Meniscus",
                given,
                "be given one of volume [m3], pressure [Pa] and relative_humidity [-] at most",
                hint="each of them is the amount of liquid, and the others follow from the gap",
            )

    @property
    def slips(self) -> bool:
        """Whether the liquid slips on a body."""
        return self.slip_length_lower > 0.0 or self.slip_length_upper > 0.0

    @property
    def has_pressure(self) -> bool:
        """Whether the amount of liquid is its pressure, given or that of a relative humidity."""
        return self.pressure is not None or self.relative_humidity is not None

    def pressure_at(self, temperature: float) -> float | None:
        r"""Pressure of the liquid [Pa] at a temperature [K]; None if the amount is a volume.

        A relative humidity gives that of Kelvin's equation: liquid and vapour in equilibrium.

        Raises
        ------
        InfeasibleError
            At no vapour, where nothing condenses, and at saturation, where all is flooded.
        DescriptionError
            If the liquid has no molar mass or no density.

        Examples
        --------
        >>> water = Liquid(name="water", density=998.2, molar_mass=0.018015)
        >>> moist = Meniscus(liquid=water, relative_humidity=0.5)
        >>> f"{moist.pressure_at(293.15) / 1e6:.1f} MPa"
        '-93.6 MPa'
        """
        if self.relative_humidity is None:
            return self.pressure
        return self.pressure_of(self.liquid.at(temperature))

    def pressure_of(self, state: LiquidState) -> float | None:
        """Pressure of the liquid [Pa] in a state that is known; see `pressure_at`."""
        if self.relative_humidity is None:
            return self.pressure
        from ..capillary.kelvin import laplace_pressure

        volume = self.liquid.molar_volume_of(state)
        return float(laplace_pressure(volume, state.temperature, self.relative_humidity))

    @classmethod
    def from_coverage(
        cls,
        *,
        liquid: Liquid,
        coverage: float,
        area: float,
        at_gap: float | None = None,
        count: int = 1,
        contact_angle_lower: float = 0.0,
        contact_angle_upper: float = 0.0,
        **earlier: float,
    ) -> Meniscus:
        r"""Menisci that cover a fraction of a face: their `volume` follows from a gap.

        .. math:: V = f A h

        Parameters
        ----------
        liquid : Liquid
            What it is.
        coverage : float
            Fraction f of the face under the menisci [-], above 0 and up to 1.
        area, at_gap : float
            Area A of the face [m2] and gap h [m] at which it is covered, between flats.
        count, contact_angle_lower, contact_angle_upper
            As in `Meniscus`.
        **earlier : float
            `gap`, the earlier name of `at_gap`.

        Notes
        -----
        The rims are taken for upright, as the source does; the contact circles then cover less
        or more than that by about the gap over the radius of one.

        Examples
        --------
        >>> water = Liquid(name="water", surface_tension=0.072)
        >>> film = Meniscus.from_coverage(
        ...     liquid=water, coverage=0.25, area=1e-12, at_gap=2e-9, count=100)
        >>> f"{film.volume:.3g} m3 in {film.count} menisci"
        '5e-22 m3 in 100 menisci'
        """
        height = _at_gap(cls.from_coverage, at_gap, earlier)
        given = (("coverage", coverage, ""), ("area", area, "m2"))
        for name, value, unit in given:
            if not (_is_number(value) and value > 0.0 and (unit or value <= 1.0)):
                expected = "be positive and finite" if unit else "lie above 0 and not above 1"
                raise DescriptionError(
                    f"Meniscus.from_coverage({name})", value, expected, unit=unit
                )
        return cls(
            liquid=liquid,
            volume=coverage * area * height,
            contact_angle_lower=contact_angle_lower,
            contact_angle_upper=contact_angle_upper,
            count=count,
        )

    @classmethod
    def from_radius(
        cls,
        *,
        liquid: Liquid,
        radius: float,
        at_gap: float | None = None,
        body: Literal["lower", "upper"] = "lower",
        profile: Literal["exact", "arc"] = "exact",
        contact_angle_lower: float = 0.0,
        contact_angle_upper: float = 0.0,
        count: int = 1,
        **earlier: float,
    ) -> Meniscus:
        r"""Menisci between flats of a given contact radius at a gap: their `volume` follows.

        Parameters
        ----------
        liquid : Liquid
            What it is.
        radius, at_gap : float
            Radius of the contact circle of each meniscus and gap at which it has that [m].
        body : {"lower", "upper"}
            Body on which the circle is.
        profile : {"exact", "arc"}
            Profile of the meniscus: the exact bridge, or the arc of the source, with which
            ``MeniscusForce(profile="as-published")`` and ``ViscousForce(closure="as-published")``
            begin at that radius.
        contact_angle_lower, contact_angle_upper, count
            As in `Meniscus`.
        **earlier : float
            `gap`, the earlier name of `at_gap`.

        Raises
        ------
        InfeasibleError
            If no stable bridge has that circle at that gap.

        Examples
        --------
        The source's film of 2 nm and 100 nm:

        >>> water = Liquid(name="water", surface_tension=0.072)
        >>> angles = {"contact_angle_lower": math.pi / 3, "contact_angle_upper": math.pi / 3}
        >>> film = Meniscus.from_radius(liquid=water, radius=100e-9, at_gap=2e-9, **angles)
        >>> f"{film.volume / (math.pi * 1e-14 * 2e-9):.6f} of an upright disc"
        '0.996379 of an upright disc'
        """
        height = _at_gap(cls.from_radius, at_gap, earlier)
        if not (_is_number(radius) and radius > 0.0):
            where = "Meniscus.from_radius(radius)"
            raise DescriptionError(where, radius, "be positive and finite", unit="m")
        for name, text, options in (
            ("body", body, ("lower", "upper")),
            ("profile", profile, ("exact", "arc")),
        ):
            if text not in options:
                where = f"Meniscus.from_radius({name})"
                raise DescriptionError(where, text, f"be {' or '.join(map(repr, options))}")
        # Checks the angles, and is what is returned but for the volume.
        made = cls(
            liquid=liquid,
            contact_angle_lower=contact_angle_lower,
            contact_angle_upper=contact_angle_upper,
            count=count,
        )
        from ..capillary.contact_radius import volume_of_radius

        angles = (contact_angle_lower, contact_angle_upper)
        volume = volume_of_radius(radius, height, *angles, body=body, profile=profile)
        return evolve(made, volume=count * volume)
