"""The liquid between two bodies: how much of it, or at which pressure, and how it wets them.

Contact angles are measured through the liquid; a pressure is that of the liquid less that
outside, so that it is negative in a hollow meniscus.
"""

from __future__ import annotations

import math

from attrs import Attribute, field, frozen

from ..errors import DescriptionError
from ..liquids.liquid import Liquid
from ..units import celsius, si
from ..validators import angle, count, fraction, optional, part, positive, refuse

__all__ = ["Meniscus"]


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _negative(owner: object, attribute: Attribute[float], value: float) -> None:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not (number and -math.inf < value < 0.0):
        hint = "liquid of a positive pressure dries up or grows without end; give a volume"
        raise refuse(owner, attribute, value, "be negative and finite", hint if number else "")


@frozen(kw_only=True)
class Meniscus:
    """The liquid that joins the two bodies: how much, and how it wets them.

    Parameters
    ----------
    liquid : Liquid
        What it is.
    volume : float, optional
        Amount of liquid in all menisci together [m3]. With neither volume nor pressure the gap
        stands in a bath and stays full to the rim however far it opens (flooded).
    pressure : float, optional
        Pressure of the liquid less that outside [Pa], negative, in place of a volume: liquid
        condenses or dries up until it is reached (`from_humidity`).
    contact_angle_lower, contact_angle_upper : float
        Contact angles on the two bodies [rad], 0 (wets) to pi (repels).
    count : int
        Number of equal menisci the liquid is divided into.
    rewetting : float
        Share of `volume` that is there again, at least, each time the bodies come back together
        [-]. 0: what is lost by rupture stays lost.
    """

    liquid: Liquid = field(validator=part(Liquid))
    volume: float | None = field(default=None, validator=optional(positive), metadata=si("m3"))
    pressure: float | None = field(default=None, validator=optional(_negative), metadata=si("Pa"))
    contact_angle_lower: float = field(default=0.0, validator=angle, metadata=si("rad"))
    contact_angle_upper: float = field(default=0.0, validator=angle, metadata=si("rad"))
    count: int = field(default=1, validator=count, metadata=si("-"))
    rewetting: float = field(default=1.0, validator=fraction, metadata=si("-"))

    def __attrs_post_init__(self) -> None:
        if self.volume is not None and self.pressure is not None:
            raise DescriptionError(
                "Meniscus",
                ["volume", "pressure"],
                "be given a volume [m3] or a pressure [Pa], not both",
                hint="one follows from the other and the gap",
            )

    @classmethod
    def from_humidity(
        cls,
        *,
        liquid: Liquid,
        relative_humidity: float,
        temperature: float = celsius(20.0),
        contact_angle_lower: float = 0.0,
        contact_angle_upper: float = 0.0,
        count: int = 1,
    ) -> Meniscus:
        r"""Meniscus that has condensed from vapour: its `pressure` follows from Kelvin's equation.

        Parameters
        ----------
        liquid : Liquid
            With surface tension, density and molar mass.
        relative_humidity : float
            Pressure of the vapour over that of saturation [-], above 0 and below 1.
        temperature : float
            Of liquid and vapour [K]; the one of the scene it goes into.
        contact_angle_lower, contact_angle_upper, count
            As in `Meniscus`.

        Raises
        ------
        InfeasibleError
            At no vapour, where nothing condenses, and at saturation, where all is flooded.
        DescriptionError
            If the liquid has no molar mass or no density.

        Notes
        -----
        The bodies are in equilibrium with the vapour at every gap: right if condensing is faster
        than the motion. Films that vapour leaves on the bodies are left out; they add about twice
        their thickness to the height of the meniscus.

        Examples
        --------
        >>> water = Liquid(name="water", density=998.2, molar_mass=0.018015)
        >>> moist = Meniscus.from_humidity(liquid=water, relative_humidity=0.5)
        >>> f"{moist.pressure / 1e6:.1f} MPa"
        '-93.6 MPa'
        """
        from ..capillary.kelvin import laplace_pressure

        if not (_is_number(relative_humidity) and 0.0 <= relative_humidity <= 1.0):
            raise DescriptionError(
                "Meniscus.from_humidity(relative_humidity)",
                relative_humidity,
                "lie between 0 and 1",
                hint="it is a share, not per cent",
            )
        volume = liquid.molar_volume(temperature)
        pressure = laplace_pressure(volume, temperature, relative_humidity)
        return cls(
            liquid=liquid,
            pressure=pressure,
            contact_angle_lower=contact_angle_lower,
            contact_angle_upper=contact_angle_upper,
            count=count,
        )

    @classmethod
    def from_coverage(
        cls,
        *,
        liquid: Liquid,
        coverage: float,
        area: float,
        gap: float,
        count: int = 1,
        contact_angle_lower: float = 0.0,
        contact_angle_upper: float = 0.0,
    ) -> Meniscus:
        r"""Menisci that cover a share of a face: their `volume` follows from a gap.

        .. math:: V = f A h

        Parameters
        ----------
        liquid : Liquid
            What it is.
        coverage : float
            Share f of the face under the menisci [-], above 0 and up to 1.
        area, gap : float
            Area A of the face [m2] and gap h [m] at which it is covered, between flats.
        count, contact_angle_lower, contact_angle_upper
            As in `Meniscus`.

        Notes
        -----
        The rims are taken for upright, as the source does; the contact circles then cover less
        or more than that by about the gap over the radius of one.

        Examples
        --------
        >>> water = Liquid(name="water", surface_tension=0.072)
        >>> film = Meniscus.from_coverage(
        ...     liquid=water, coverage=0.25, area=1e-12, gap=2e-9, count=100)
        >>> f"{film.volume:.3g} m3 in {film.count} menisci"
        '5e-22 m3 in 100 menisci'
        """
        given = (("coverage", coverage, ""), ("area", area, "m2"), ("gap", gap, "m"))
        for name, value, unit in given:
            if not (_is_number(value) and value > 0.0 and (unit or value <= 1.0)):
                expected = "be positive and finite" if unit else "lie above 0 and not above 1"
                raise DescriptionError(
                    f"Meniscus.from_coverage({name})", value, expected, unit=unit
                )
        return cls(
            liquid=liquid,
            volume=coverage * area * gap,
            contact_angle_lower=contact_angle_lower,
            contact_angle_upper=contact_angle_upper,
            count=count,
        )
