"""Laws of attraction that an `Adhesion` may take: Dugdale, exponential, Lennard-Jones."""

from __future__ import annotations

import abc
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from attrs import Attribute, field, frozen

from ...capillary import kelvin
from ...errors import DescriptionError
from ...units import si
from ...validators import Described, finite, optional, positive, refuse

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...liquids.liquid import Liquid

    Map = NDArray[np.float64]

__all__ = [
    "AttractionLaw",
    "DugdaleAttraction",
    "ExponentialAttraction",
    "LennardJonesAttraction",
    "TensionLaw",
]


_NARROWEST = 1e-3  # end width over the range: narrower, it asks for accuracy that changes nothing
_GENTLE = 0.2  # end width over the range at which iterations on stiff films settle at once


class TensionLaw(NamedTuple):
    """A law on a grid: its tension [Pa] and energy [J/m2] over the gap, and its numbers.

    Both functions take gaps (ny, nx) [m] and then the `numbers`, as those of
    `contactkit.adhesion.attraction` do; the energy is minus the work that is left to part the
    surfaces. `strength` is the largest tension [Pa], `reach` the gap [m] up to which pixels count
    as attracted, `steepest` the largest fall of the tension with the gap [Pa/m]. `cure` says what
    else to change where the tension does not settle.
    """

    tension_of: Callable[..., Map]
    energy_of: Callable[..., Map]
    numbers: tuple[float, ...]
    strength: float
    reach: float
    steepest: float
    cure: str = ""

    def tension(self, gap: Map) -> Map:
        """Tension [Pa] at a gap [m], (ny, nx) each."""
        return self.tension_of(gap, *self.numbers)

    def energy(self, gap: Map) -> Map:
        """Energy per area [J/m2] at a gap [m], (ny, nx) each."""
        return self.energy_of(gap, *self.numbers)


def _work(owner: object, attribute: Attribute[Any], value: Any) -> None:
    finite(owner, attribute, value)
    if value <= 0.0:
        raise refuse(
            owner, attribute, value, "be positive", "without adhesion leave Adhesion out of effects"
        )


@frozen(kw_only=True)
class AttractionLaw(Described, abc.ABC):
    """A tension over the gap that never rises; its kind is its name in files.

    Parameters
    ----------
    work_of_adhesion : float
        Work per area that parts the surfaces from contact [J/m2].
    range : float
        Gap over which the attraction acts [m].
    """

    family: ClassVar[str] = "attraction law"
    kind: ClassVar[str]
    source: ClassVar[str]

    work_of_adhesion: float = field(validator=_work, metadata=si("J/m2"))
    range: float = field(validator=positive, metadata=si("m"))

    @abc.abstractmethod
    def on_grid(self, self_influence: float) -> TensionLaw:
        """Return the law on a grid of a given self-influence coefficient [m/Pa]."""

    def cure_of_trapping(self, number: float, highest: float) -> str:
        """Say how to lower a trapping number to the highest that is in its range."""
        return (
            f"scale the range up to {self.range * math.sqrt(number / highest):.3g} m (pull-off of "
            "soft contacts hardly depends on it, jump-in and hysteresis do)"
        )

    def _made(
        self,
        kernels: tuple[Callable[..., Map], Callable[..., Map]],
        peak: float,
        slope: float,
        more: tuple[float, ...] = (),
    ) -> TensionLaw:
        """Return a law of given peak over w/r, and of steepest fall over w/r^2."""
        w, r = self.work_of_adhesion, self.range
        return TensionLaw(*kernels, (w, r, *more), peak * w / r, r, slope * w / r**2)


@frozen(kw_only=True)
class ExponentialAttraction(AttractionLaw):
    """Tension ``w/r exp(-g/r)`` over the gap g: smooth and concave everywhere.

    Parameters
    ----------
    work_of_adhesion : float
        Work of adhesion w [J/m2].
    range : float
        Range r [m], over which the tension falls by a factor of e.

    Examples
    --------
    >>> law = ExponentialAttraction(work_of_adhesion=0.05, range=1e-9)
    >>> law.on_grid(1e-20).strength / 1e6
    50.0
    """

    kind: ClassVar[str] = "exponential"
    source: ClassVar[str] = "tension w/r exp(-g/r), own choice"

    def on_grid(self, self_influence: float) -> TensionLaw:
        """See `AttractionLaw.on_grid`."""
        from ...adhesion.attraction import exponential_energy, exponential_tension

        return self._made((exponential_tension, exponential_energy), 1.0, 1.0)


@frozen(kw_only=True)
class DugdaleAttraction(AttractionLaw):
    """Constant tension w/r up to the range r, with a sloping end; Maugis' cohesive zone.

    With a sudden end the edge of a crack hangs on single pixels; the slope cures that, and changes
    neither work nor tension.

    Parameters
    ----------
    work_of_adhesion : float
        Work of adhesion w [J/m2].
    range : float
        Range r [m].
    end_width : float, optional
        Half-width b of the slope [m]: the tension falls linearly from the gap r - b to r + b.
        None: the least that the grid needs, so that the trapping number is 0.5, between r/1000 and
        r. Wider ends change the branches: 0.2 r closes small hysteresis loops.

    Examples
    --------
    >>> law = DugdaleAttraction(work_of_adhesion=0.05, range=1e-9)
    >>> made = law.on_grid(1e-18)
    >>> round(made.steepest * 1e-18, 3), round(made.numbers[2] * 1e9, 3)
    (0.5, 0.05)
    """

    kind: ClassVar[str] = "dugdale"
    source: ClassVar[str] = "Dugdale 1960; Maugis 1992"

    end_width: float | None = field(default=None, validator=optional(positive), metadata=si("m"))

    @end_width.validator
    def _within_range(self, attribute: Attribute[Any], value: Any) -> None:
        if value is not None and value > self.range:
            raise refuse(self, attribute, value, f"be at most range = {self.range:g} m")

    def on_grid(self, self_influence: float) -> TensionLaw:
        """See `AttractionLaw.on_grid`."""
        from ...adhesion.attraction import dugdale_energy, dugdale_tension

        w, r = self.work_of_adhesion, self.range
        b = self.end_width
        if b is None:
            b = min(max(1.001 * w / r * self_influence, _NARROWEST * r), r)
        made = self._made((dugdale_tension, dugdale_energy), 1.0, 0.5 * r / b, (b,))
        if b >= _GENTLE * r:
            return made
        gentle = f"give DugdaleAttraction.end_width = {_GENTLE * r:.3g} m, now {b:.3g} m"
        return made._replace(cure=gentle)

    def cure_of_trapping(self, number: float, highest: float) -> str:
        """See `AttractionLaw.cure_of_trapping`."""
        needed = 1.001 * (self.end_width or math.inf) * number / highest
        if needed <= self.range:
            return f"leave DugdaleAttraction.end_width out, or give at least {needed:.3g} m"
        if self.end_width is None or self.end_width >= self.range:
            return super().cure_of_trapping(number, highest)
        # The widest end, that of the range, leaves a number that falls with the range squared.
        return "leave DugdaleAttraction.end_width out, and " + super().cure_of_trapping(
            number * self.end_width / self.range, highest
        )

    @classmethod
    def from_meniscus(
        cls,
        *,
        surface_tension: float,
        contact_angle_lower: float,
        contact_angle_upper: float,
        height: float,
        end_width: float | None = None,
    ) -> DugdaleAttraction:
        r"""Attraction of a liquid film that wets every gap below a height.

        .. math:: w = \gamma (\cos\theta_1 + \cos\theta_2), \qquad w/r = \text{Laplace pressure}

        Left out: menisci of a given volume, islands that hold no liquid (`FilmMeniscus` has
        those), and the line tension at the edge of the film.

        Parameters
        ----------
        surface_tension : float
            Surface tension gamma [N/m].
        contact_angle_lower, contact_angle_upper : float
            Contact angles on the bodies [rad].
        height : float
            Height of the menisci [m].
        end_width : float, optional
            As of the class [m].

        Raises
        ------
        DescriptionError
            If the liquid wets the bodies so little that it pushes them apart.

        Examples
        --------
        >>> film = DugdaleAttraction.from_meniscus(
        ...     surface_tension=0.072, contact_angle_lower=0.0, contact_angle_upper=0.0, height=2e-9
        ... )
        >>> film.work_of_adhesion, round(film.work_of_adhesion / film.range / 1e6)
        (0.144, 72)
        """
        wetting = math.cos(contact_angle_lower) + math.cos(contact_angle_upper)
        if not wetting > 1e-12:
            raise DescriptionError(
                "DugdaleAttraction.from_meniscus(contact_angle_lower, contact_angle_upper)",
                (contact_angle_lower, contact_angle_upper),
                "add up to less than pi, so that the film attracts",
                unit="rad",
                hint="a film that pushes the bodies apart is a matter of FilmMeniscus",
            )
        return cls(work_of_adhesion=surface_tension * wetting, range=height, end_width=end_width)

    @classmethod
    def from_humidity(
        cls,
        *,
        liquid: Liquid,
        relative_humidity: float,
        temperature: float,
        contact_angle_lower: float,
        contact_angle_upper: float,
        end_width: float | None = None,
    ) -> DugdaleAttraction:
        r"""Attraction of the menisci that condense from humid air, as `from_meniscus`.

        .. math:: r = -\frac{\gamma}{p} (\cos\theta_1 + \cos\theta_2), \qquad
            p = \frac{R T}{v} \ln H

        Parameters
        ----------
        liquid : Liquid
            With surface tension, density and molar mass.
        relative_humidity : float
            Of the air, above 0 and below 1 [-].
        temperature : float
            Temperature [K].
        contact_angle_lower, contact_angle_upper : float
            Contact angles on the bodies [rad].
        end_width : float, optional
            As of the class [m].

        Raises
        ------
        DescriptionError
            If the liquid wets the bodies so little that it pushes them apart.
        InfeasibleError
            Without vapour, and at or above saturation.

        Examples
        --------
        Water, 1.03 nm of Kelvin radius at 60 % and 20 degC:

        >>> from contactkit.files.structure import load_liquid
        >>> air = DugdaleAttraction.from_humidity(
        ...     liquid=load_liquid("water"), relative_humidity=0.6, temperature=293.15,
        ...     contact_angle_lower=0.0, contact_angle_upper=0.0)
        >>> f"{air.work_of_adhesion:.4f} J/m2 over {air.range * 1e9:.2f} nm"
        '0.1455 J/m2 over 2.11 nm'
        """
        state, molar = liquid.at(temperature), liquid.molar_volume(temperature)
        pressure = float(kelvin.laplace_pressure(molar, temperature, relative_humidity))
        wetting = math.cos(contact_angle_lower) + math.cos(contact_angle_upper)
        return cls.from_meniscus(
            surface_tension=state.surface_tension,
            contact_angle_lower=contact_angle_lower,
            contact_angle_upper=contact_angle_upper,
            height=float(kelvin.meniscus_height(pressure, state.surface_tension, wetting)),
            end_width=end_width,
        )


@frozen(kw_only=True)
class LennardJonesAttraction(AttractionLaw):
    """Attraction of half-spaces with Lennard-Jones interaction, above a hard wall.

    The part of the law where the tension rises with the distance, next to contact, is replaced by
    a plateau of the same work.

    Parameters
    ----------
    work_of_adhesion : float
        Work of adhesion w [J/m2].
    range : float
        Equilibrium distance z_0 [m]; the tension has fallen to a half at a gap of 0.66 z_0.

    Examples
    --------
    >>> law = LennardJonesAttraction(work_of_adhesion=0.05, range=0.165e-9)
    >>> round(law.on_grid(1e-20).strength / 1e6)
    311
    """

    kind: ClassVar[str] = "lennard-jones"
    source: ClassVar[str] = "Lennard-Jones half-spaces above a hard wall: Israelachvili 1992"

    def on_grid(self, self_influence: float) -> TensionLaw:
        """See `AttractionLaw.on_grid`."""
        from ...adhesion.attraction import (
            LENNARD_JONES_PEAK,
            LENNARD_JONES_SLOPE,
            lennard_jones_energy,
            lennard_jones_tension,
        )

        kernels = (lennard_jones_tension, lennard_jones_energy)
        return self._made(kernels, LENNARD_JONES_PEAK, LENNARD_JONES_SLOPE)
