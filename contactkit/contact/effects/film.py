"""The meniscus force of a thin liquid film on a rough contact."""

from __future__ import annotations

import math
from operator import attrgetter
from typing import TYPE_CHECKING, ClassVar, Literal, NamedTuple

from attrs import Attribute, field, frozen

from ...units import si
from ...validators import optional, part, positive, refuse
from ...validity import ValidityNumber
from .base import Array, Balance, LoadTerm, Scalar, SolvedContact

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.scenes import ContactScene

_AMBIGUOUS = 0.02  # range of balances over the load: force and area are off by about as much
_WEAK = 0.1  # force over load up to which a film does not change the contact much

__all__ = ["FilmMeniscus", "FilmPart"]


class FilmPart(NamedTuple):
    """Meniscus force [N], its area [m2], the number of menisci, and where they are (ny, nx).

    `force` pulls the bodies together. `relative_force` is force over imposed load [-], infinite
    without a load. `equilibria` are the loads [N] on the contact at which load, film and elastic
    bodies are in balance: one where the force does not act back on the contact or does so mildly;
    with more, the bodies snap in beyond the second. `imbalance` is the imbalance over the load [-]
    that remains at a step of the force, which is a sum over pixels. `balance_error` is the range of
    the loads that balance up to such steps, over the load [-]: what load, force and area may be off
    by as the grid is no finer; zero unless `self_consistent`. `self_consistent_force` [N] is
    an estimate of what the film would pull with if it added to the load, where it pulls so hard
    that this matters; else None.
    """

    force: float
    area: float
    n_menisci: int
    is_meniscus: NDArray[np.bool_]
    relative_force: float
    equilibria: tuple[float, ...] = ()
    imbalance: float = 0.0
    self_consistent_force: float | None = None
    balance_error: float = 0.0


def _size(part: FilmPart, force: float) -> str:
    """A force [N], alone and over the load."""
    (load,) = part.equilibria
    return f"{force:.2g} N" + (f", {force / load:.2g} times the load" if load > 0.0 else "")


def _balance(part: FilmPart) -> ValidityNumber:
    return ValidityNumber(
        name="range of the film balance",
        value=part.balance_error,
        high=_AMBIGUOUS,
        detail="loads that balance up to steps of single pixels, over the load: load, force and "
        "area may be off by as much; use a finer Accuracy.grid or a smaller window",
    )


def _is_only_reported(effect: FilmMeniscus, contact: SolvedContact) -> bool:
    """Whether the film leaves alone a load that it adds to; an imposed approach is no load."""
    load = contact.scene.loading.mean_pressure(contact.grid.area)
    return load is not None and not effect.self_consistent


def _connectivity(owner: object, attribute: Attribute[int], value: int) -> None:
    if value not in (4, 8):
        raise refuse(owner, attribute, value, "be 4 or 8 neighbours")


@frozen(kw_only=True)
class FilmMeniscus(LoadTerm[FilmPart]):
    """Menisci of a film that lies on a rough surface: Laplace pressure times projected area.

    A meniscus fills an island of the gap below `meniscus_height` that somewhere dips into the film.
    Its line tension is left out: force of order perimeter x surface tension.

    Parameters
    ----------
    film_thickness : float
        Thickness of the film on the surface [m].
    meniscus_height : float, optional
        Height of the menisci [m]. None: the thickness of the film.
    connectivity : int
        Whether pixels join an island across edges (4) or across corners too (8).
    self_consistent : bool
        Whether the force adds to the load that presses the bodies together. Off, as published: it
        is reported only.
    """

    takes_anisotropy: ClassVar[bool] = True
    name: ClassVar[str] = "film-meniscus"
    summary: ClassVar[str] = "meniscus force of a thin film on a rough contact"
    takes_tension: ClassVar[bool] = False
    records: ClassVar[tuple[type, ...]] = (FilmPart,)
    arrays: ClassVar[tuple[Array, ...]] = (Array("meniscus", "-", attrgetter("is_meniscus")),)
    scalars: ClassVar[tuple[Scalar, ...]] = (
        Scalar("meniscus_force", "N", attrgetter("force")),
        Scalar("relative_meniscus_force", "-", attrgetter("relative_force")),
        Scalar("meniscus_area", "m2", attrgetter("area")),
        Scalar("n_menisci", "-", attrgetter("n_menisci")),
        Scalar("n_equilibria", "-", lambda part: len(part.equilibria)),
        Scalar("self_consistent_force", "N", attrgetter("self_consistent_force")),
        Scalar("balance_error", "-", attrgetter("balance_error")),
    )

    film_thickness: float = field(validator=positive, metadata=si("m"))
    meniscus_height: float | None = field(
        default=None, validator=optional(positive), metadata=si("m")
    )
    connectivity: Literal[4, 8] = field(default=8, validator=_connectivity, metadata=si("-"))
    self_consistent: bool = field(default=False, validator=part(bool))

    def liquid_needs(self, scene: ContactScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        return ("surface_tension",)

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return ("meniscus force of a thin film, Eq. (2.43) of Cai 2008; Tian and Bhushan 1996",)

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        meniscus = scene.interface.meniscus
        if meniscus is None:
            return ("interface.meniscus (the liquid and its contact angles)",)
        lacking = []
        if meniscus.volume is not None:
            lacking.append("a film thickness, not interface.meniscus.volume [m3]: leave that out")
        if scene.meniscus.has_pressure:
            lacking.append(
                "a film thickness, not interface.meniscus.pressure [Pa] or relative_humidity [-]: "
                "leave that out"
            )
        return tuple(lacking)

    def _force(self, contact: SolvedContact, area: float) -> float:
        """Meniscus force [N] of an area [m2], Eq. (2.43)."""
        from ...capillary.film_islands import film_force

        meniscus = contact.scene.meniscus
        angles = (meniscus.contact_angle_lower, meniscus.contact_angle_upper)
        tension = contact.liquid.surface_tension
        return float(film_force(area, tension, *angles, self._height))

    @property
    def _height(self) -> float:
        return self.meniscus_height if self.meniscus_height is not None else self.film_thickness

    def largest_force(self, contact: SolvedContact) -> float:
        """See `LoadTerm.largest_force`: that of a film that fills the whole window."""
        return self._force(contact, contact.grid.area)

    def force_of(self, part: FilmPart) -> float:
        """See `LoadTerm.force_of`."""
        return part.force

    def needs_balance(self, contact: SolvedContact, part: FilmPart) -> bool:
        """See `LoadTerm.needs_balance`."""
        return _is_only_reported(self, contact) and abs(part.relative_force) > _WEAK

    def estimated(self, part: FilmPart, force: float | None) -> FilmPart:
        """See `LoadTerm.estimated`."""
        return part._replace(self_consistent_force=force)

    def validity(self, contact: SolvedContact, part: FilmPart) -> tuple[ValidityNumber, ...]:
        """See `ContactEffect.validity`."""
        if self.self_consistent:
            return (_balance(part),)
        if not _is_only_reported(self, contact):
            return ()
        estimate = part.self_consistent_force
        size = "" if estimate is None else f"; then it is about {_size(part, estimate)}"
        return (
            ValidityNumber(
                name="film force over load",
                value=abs(part.relative_force),
                high=_WEAK,
                detail="as published, the film is reported and is no part of the load; "
                f"use FilmMeniscus(self_consistent=True){size}",
            ),
        )

    def balanced(self, part: FilmPart, balance: Balance) -> FilmPart:
        """See `LoadTerm.balanced`."""
        return part._replace(**balance._asdict())

    def observe(self, contact: SolvedContact) -> FilmPart:
        """See `LoadTerm.observe`."""
        from ...capillary.film_islands import meniscus_area

        found = meniscus_area(
            contact.gap,
            self.film_thickness,
            self._height,
            contact.pressure > 0.0,
            contact.grid.edges,
            self.connectivity,
        )
        area = found.n_meniscus * contact.grid.pixel_area
        force = self._force(contact, area)
        load = float(contact.pressure.sum()) * contact.grid.pixel_area
        relative = force / load if load > 0.0 else math.inf
        return FilmPart(force, area, int(found.n_islands), found.meniscus, relative, (load,))
