"""Meniscus force: Laplace pressure and surface tension, by the profile of the meniscus."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from attrs import Attribute, field, frozen

from ...as_published.printed import common as printed
from ...errors import ConvergenceError, InfeasibleError
from ...lubrication import dimensionless as numbers
from ...scene.column import Column
from ...validators import Described, choice
from ...validity import ValidityNumber
from .base import ForceLaw, MovingAngle, RunCurves, SeparationForce
from .film_shape import needs_extent
from .meniscus_flat import arc_law, exact_law, printed_law, printed_radius
from .meniscus_shape import SHAPE_COLUMNS, shape_curves

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Curve = NDArray[np.float64]

    from ...as_published.arguments import PublishedValue
    from ...scene.scenes import SeparationScene
    from .base import PlanView
    from .prepared import PreparedScene

__all__ = ["AsPublished", "MeniscusForce"]

_HEAVIEST = 0.05  # weight over force
_LEAST_FORCE = 0.3  # gamma V^(1/3): where a force changes sign, its errors are judged by this


@frozen(kw_only=True)
class AsPublished(Described):
    """The force as printed: Eq. (3.11) between flats, Eq. (3.12) on a sphere.

    Both are known to be wrong; `plan.cite()` lists their errata.

    Parameters
    ----------
    pulled : {"lower", "upper"}
        Body whose contact circle and contact angle enter Eq. (3.11).
    radius : {"arc", "disc"}
        Radius in Eq. (3.11) of a volume. ``"arc"``: that of the contact circle of the arc of Eqs.
        (3.38) to (3.40), as the source has it, up to the gap at which its neck closes. ``"disc"``:
        that of an upright disc, which is near the other for films much wider than high, and is
        what the law ``PUBLISHED`` of the FMU ``stiction-mass`` takes.

    Examples
    --------
    >>> MeniscusForce(profile="as-published") == MeniscusForce(profile=AsPublished())
    True
    """

    family: ClassVar[str] = "meniscus profile"
    kind: ClassVar[str] = "as-published"

    pulled: Literal["lower", "upper"] = field(default="lower", validator=choice("lower", "upper"))
    radius: Literal["arc", "disc"] = field(default="arc", validator=choice("arc", "disc"))


def _as_profile(value: Any) -> Any:
    return AsPublished() if value == AsPublished.kind else value


def _profile(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if not isinstance(value, AsPublished):
        choice("exact", "arc", "as-published")(owner, attribute, value)


@frozen(kw_only=True)
class MeniscusForce(SeparationForce):
    """Pull of the Laplace pressure and of the surface tension at the rim of the meniscus.

    Parameters
    ----------
    profile : {"exact", "arc", "as-published"} or AsPublished
        ``"exact"``: the axisymmetric solution of the Young-Laplace equation at the volume (or the
        pressure) of the meniscus, up to the gap at which it loses stability; any contact angles.
        ``"arc"``: an arc of a circle that keeps its volume, a fast model; one force, taken through
        its neck or belly, on both bodies. ``"as-published"``, or `AsPublished` with its choices:
        the printed equations, known to be wrong, for reproduction only.

    Notes
    -----
    The exact bridge stands in a curve: its error is a tenth of ``Accuracy.time_rtol`` of what the
    curvatures of the rim would pull. Gravity, a contact angle that depends on the direction of
    motion, and shapes that are not round are left out.

    Against it the arc is within 0.7 % up to a tenth of the stability limit, 4 % to a third, 7 %
    to nine tenths (equal angles below 90 degrees); mixed angles are worse where the gap is not
    small against the radius, -12 % at a radius of two gaps for 60/120 degrees. The arc has no
    fold: it ends where its neck vanishes, 1.4 to 15 times beyond the exact limit.

    A result has the shape of the meniscus, too, by the same profile: ``neck_radius``,
    ``contact_radius_lower``, ``contact_radius_upper``, ``liquid_pressure``, ``liquid_volume`` and
    ``break_gap``, computed when one of them is asked for, and nan where the film has broken.
    """

    name: ClassVar[str] = "meniscus-force"
    summary: ClassVar[str] = "capillary force of the meniscus"
    column: ClassVar[Column] = Column("meniscus_force", "N", "meniscus force", "#2a9d8f")
    takes_pressure: ClassVar[bool] = True
    published_choice: ClassVar[str] = "profile"

    late: ClassVar[tuple[Column, ...]] = SHAPE_COLUMNS

    profile: Literal["exact", "arc"] | AsPublished = field(
        default="exact", converter=_as_profile, validator=_profile
    )

    @property
    def printed(self) -> AsPublished:
        """The printed equations that are taken; with the choices of the source, if none are."""
        return self.profile if isinstance(self.profile, AsPublished) else AsPublished()

    @property
    def form(self) -> Literal["exact", "arc", "as-published"]:
        """Name of the profile."""
        return "as-published" if isinstance(self.profile, AsPublished) else self.profile

    def takes_printed(self) -> bool:
        """See `SeparationEffect.takes_printed`."""
        return isinstance(self.profile, AsPublished)

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        if self.form == "exact":
            return (
                "Young-Laplace equation, Eq. (3.1) of Cai 2008, by Delaunay's surfaces; Orr, "
                "Scriven and Rivas 1975",
            )
        if self.form == "arc":
            return (
                "arc of Eqs. (3.38)-(3.41) of Cai and Bhushan 2008a, force through its neck plane",
            )
        return tuple(
            f"Eq. ({number}) of Cai and Bhushan 2007a, as printed; {printed.ERRATA[number]}"
            for number in ("3.11", "3.12")
        )

    def cites(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.cites`."""
        if self.form != "as-published":
            return self.sources
        flats, sphere = self.sources
        return (flats,) if scene.interface.is_flat else (sphere,)

    def liquid_needs(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        return ("surface_tension",)

    def reads(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.reads`: of a curve through bridges, which a closed form meets by itself."""
        return ("time_rtol",)

    def proportional_to(self, scene: SeparationScene) -> str:
        """See `SeparationForce.proportional_to`; at a fixed pressure it is not."""
        return "" if scene.meniscus.has_pressure else "surface_tension"

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        meniscus = scene.meniscus
        missing: tuple[str, ...] = ()
        if not scene.interface.is_flat and self.printed != AsPublished():
            missing += (f"two flats for {self.profile}, which Eq. (3.11) has",)
        if scene.meniscus.has_pressure:
            return missing + self._lacks_at_pressure(scene)
        if not scene.interface.is_flat and meniscus.volume is None:
            missing += ("interface.meniscus.volume [m3]: a flooded sphere has no meniscus",)
        if self.form == "as-published" and scene.interface.curvatures[0]:
            missing += ("the sphere as the upper body: Eq. (3.12) is printed for that",)
        return missing + needs_extent(scene)

    def _lacks_at_pressure(self, scene: SeparationScene) -> tuple[str, ...]:
        missing: tuple[str, ...] = ()
        if self.form != "exact":
            missing += ('profile="exact" at a fixed pressure (or interface.meniscus.volume [m3])',)
        if scene.interface.is_flat:
            missing += (
                "interface.meniscus.volume [m3] between flats: at a fixed pressure the liquid "
                "there fills the gap or dries up",
            )
        return missing

    def prepare(self, prepared: PreparedScene[SeparationScene]) -> ForceLaw:
        """See `SeparationForce.prepare`: with a contact angle that moves, where one is listed."""
        law, moving = self._at_rest(prepared), prepared.scene.effect(MovingAngle)
        return law if moving is None else moving.meniscus_law(prepared, law)

    def _at_rest(self, prepared: PreparedScene[SeparationScene]) -> ForceLaw:
        if not prepared.scene.interface.is_flat:
            from .meniscus_sphere import sphere_law

            return sphere_law(prepared, self.form)
        if self.form == "as-published":
            return printed_law(prepared, self.printed.pulled, self.printed.radius)
        return exact_law(prepared) if self.form == "exact" else arc_law(prepared)

    def late_curves(self, run: RunCurves) -> Mapping[str, Curve]:
        """See `SeparationEffect.late_curves`: the shape of the meniscus."""
        is_disc = self.takes_printed() and self.printed.radius == "disc"
        return shape_curves(type(self), self.form, run, is_disc=is_disc)

    def notes(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `SeparationEffect.notes`: what pulls where no amount of liquid is given."""
        is_flooded = scene.meniscus.volume is None and not scene.meniscus.has_pressure
        if not is_flooded:
            return ()
        return (
            "flooded: liquid follows to the rim of the faces, and its meniscus, pinned there, "
            "pulls; in a flooded reservoir there is none: leave MeniscusForce out, or give the "
            "amount of liquid",
        )

    def rimless_radius(self, prepared: PreparedScene[SeparationScene], gap: float) -> float:
        """See `SeparationEffect.rimless_radius`: the contact circle."""
        from .meniscus_sphere import contact_radius

        return contact_radius(prepared, self.form, gap)

    def equations(self, scene: SeparationScene) -> str:
        """See `SeparationEffect.equations`."""
        return "as-published" if self.takes_printed() else "consistent"

    def errata(self, plan: PlanView) -> tuple[PublishedValue, ...]:
        """See `SeparationEffect.errata`: the force of all menisci."""
        return (_erratum(plan, self),) if self.takes_printed() else ()

    def validity(
        self, plan: PlanView, path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """See `SeparationEffect.validity`."""
        gaps = [gap for gap, _ in path]
        found = [_bond(plan.prepared, gaps), _weight(plan, gaps)]
        volume = plan.prepared.film.volume
        if not plan.scene.interface.is_flat:
            found.append(_lateral(plan, gaps))
            if self.takes_printed():
                found.append(_printed_neck(plan.prepared, gaps))
        elif math.isfinite(volume):
            found.append(
                ValidityNumber(
                    name="gap over cube root of volume",
                    value=max(gaps) / volume ** (1.0 / 3.0),
                    high=numbers.LONGEST_FLAT_BRIDGE,
                    detail="no longer bridge between flats is stable, whatever the contact angles",
                    source="stability of the cylinder at 90/90 degrees, pi^(1/3)",
                )
            )
        return tuple(found)


def _erratum(plan: PlanView, effect: MeniscusForce) -> PublishedValue:
    from ...as_published.lookup import published

    prepared, gap = plan.prepared, plan.scene.loading.initial_gap
    film, angles = prepared.film, prepared.angles
    given = {
        "gap": gap,
        "surface_tension": prepared.liquid.surface_tension,
        "angle_lower": angles.lower,
        "angle_upper": angles.upper,
    }
    if not plan.scene.interface.is_flat:
        lifted = published("3.12", sphere_radius=film.sphere_radius, volume=film.volume, **given)
        made = lifted.times(film.menisci)
    else:
        several = film.menisci > 1
        number, more = ("3.33", {"number": film.menisci}) if several else ("3.11", {})
        one, is_pinned = printed_radius(prepared, effect.printed.pulled, effect.printed.radius, gap)
        radius = one * math.sqrt(film.menisci)
        made = published(number, radius=radius, pulled=effect.printed.pulled, **given, **more)
        if not is_pinned:
            made = _against_exact(made, prepared)
    return made._replace(name=f"{MeniscusForce.name}, {made.name}")


def _against_exact(
    made: PublishedValue, prepared: PreparedScene[SeparationScene]
) -> PublishedValue:
    """Compare with the exact bridge of the volume of the scene, between flats."""
    from ...as_published.corrected import meniscus_at_volume

    film, gap = prepared.film, prepared.scene.loading.initial_gap
    try:
        tension = prepared.liquid.surface_tension
        one = meniscus_at_volume(gap, film.volume, tension, *prepared.angles)
    except (InfeasibleError, ConvergenceError) as reason:
        return made._replace(corrected=None, corrected_by=str(reason))
    by = "exact bridge of the volume of the scene"
    return made._replace(corrected=film.menisci * one, corrected_by=by)


def _bond(prepared: PreparedScene[SeparationScene], gaps: Sequence[float]) -> ValidityNumber:
    film, tension = prepared.film, prepared.liquid.surface_tension
    density, bond = prepared.liquid.given("density"), None
    if density is not None:
        sizes = ((film.height(h), max(film.height(h), film.radius(h))) for h in gaps)
        bond = max(numbers.bond_number(density, *size, tension) for size in sizes)
    return ValidityNumber(
        name="Bond number",
        value=bond,
        high=0.1,
        detail="gravity is left out"
        if density is not None
        else "liquid.density [kg/m3] is not given",
        source="rho g h max(h, r)/gamma",
    )


def _weight(plan: PlanView, gaps: Sequence[float]) -> ValidityNumber:
    """Weight of all menisci over their force, which it changes by a part of itself."""
    film, law = plan.prepared.film, plan.film.laws[MeniscusForce]
    density, tension = plan.prepared.liquid.given("density"), plan.prepared.liquid.surface_tension
    value: float | None = None
    if density is not None:
        value = 0.0
        for gap in gaps:
            volume = film.volume_at(gap)
            least = _LEAST_FORCE * tension * math.cbrt(volume)
            force = max(abs(law.force(gap, 0.0)) / film.menisci, least)
            value = max(value, numbers.GRAVITY * density * volume / force)
    return ValidityNumber(
        name="weight of the meniscus over its force",
        value=value,
        high=_HEAVIEST,
        detail="the weight of the liquid is left out; the forces on both bodies differ by it"
        if density is not None
        else "not judged, liquid.density [kg/m3] is not given",
        source="rho g V over the force, or over 0.3 gamma V^(1/3) where that is larger",
    )


def _printed_neck(
    prepared: PreparedScene[SeparationScene], gaps: Sequence[float]
) -> ValidityNumber:
    from .meniscus_sphere import printed_neck

    known = [neck for neck in printed_neck(prepared, gaps).tolist() if math.isfinite(neck)]
    return ValidityNumber(
        name="radius of the neck in Eq. (3.12) over that of the arc",
        value=min(known, default=None),
        low=0.0,
        detail="where it is zero, the printed force is infinite, and below zero the circle of the "
        "arc reaches beyond the axis; MeniscusForce() has neither",
        source="x_c - r1 over r1",
    )


def _lateral(plan: PlanView, gaps: Sequence[float]) -> ValidityNumber:
    """Whether a bridge on a sphere stays in its middle: it does as long as it attracts."""
    law, radius = plan.film.laws[MeniscusForce], plan.scene.interface.sphere_radius
    least = min(law.force(gap, 0.0) for gap in gaps)
    return ValidityNumber(
        name="least meniscus force over 2 pi R gamma",
        value=least / (2.0 * math.pi * radius * plan.prepared.liquid.surface_tension),
        low=0.0,
        detail="a bridge that repels a sphere is expelled sideways: it is laterally unstable",
        source="an axisymmetric bridge is neutral sideways where its force is zero",
    )
