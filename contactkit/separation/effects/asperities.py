"""Menisci at the asperities of a rough flat: one bridge at each summit within reach."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar, Literal

from attrs import field, frozen

from ...capillary.many_menisci import MAX_COVERAGE
from ...scene.asperity_population import AsperityPopulation
from ...scene.column import Column
from ...units import si
from ...validators import choice, optional, part, positive
from ...validity import ValidityNumber
from .base import ForceLaw, ForcePart, SeparationForce

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...capillary.asperities import AsperitySum
    from ...scene.scenes import SeparationScene
    from .base import PlanView, RunView
    from .prepared import PreparedScene

__all__ = ["AsperityMenisci", "AsperityPart"]


@frozen(eq=False)
class AsperityPart(ForcePart):
    """Force and impulse of the menisci at asperities, and the `law` they follow.

    `n_wet` is their number along the run, `coverage` their contact circles over the face [-], both
    of thin menisci: above 0.9 neighbours overlap, and their forces do not add up any more.
    """

    law: str
    n_wet: NDArray[np.float64]
    coverage: NDArray[np.float64]


@frozen(kw_only=True)
class AsperityMenisci(SeparationForce):
    """Menisci at the summits of a rough flat face near a smooth one; the liquid condenses there.

    The gap of the scene is the distance of the smooth face from the mean plane of the summits.
    They are counted over the face, a disc of the radius of the `Flat`, unless they bring their
    count, as those of `AsperityPopulation.split` do.
    How far a meniscus reaches is set by its pressure or relative humidity, or by the height of a
    film.

    Parameters
    ----------
    asperities : AsperityPopulation
        The summits.
    law : {"greenwood-williamson", "identical"}
        Summits whose heights are normal about their mean plane; or all of one height, whatever
        `AsperityPopulation.rms_height` says.
    profile : {"exact", "thin-film"}
        Each meniscus an exact bridge of the given pressure on a sphere; or the limit of a film
        thin against the radius, ``2 pi R gamma (cos + cos) (1 - D/h_m)``.
    meniscus_height : float, optional
        Height h_m at which the menisci end [m], in place of a pressure:
        ``p = -gamma (cos + cos)/h_m``.

    Notes
    -----
    A summit that touches has the force of a gap of 0: its flattening is left out, which is right
    for menisci thin against the radius of a summit. Neighbours do not feel each other: the cover,
    the contact circles over the area of the face, is printed with a result. This is not the
    cross-cut law of `FilmMeniscus`, which may be ten times as large on the same surface, as it is
    fed the heights of all points and not those of summits.
    """

    name: ClassVar[str] = "asperity-menisci"
    summary: ClassVar[str] = "menisci at the summits of a rough face"
    column: ClassVar[Column] = Column(
        "asperity_force", "N", "meniscus force at the asperities", "#2a9d8f", "-."
    )
    takes_pressure: ClassVar[bool] = True

    asperities: AsperityPopulation = field(validator=part(AsperityPopulation))
    law: Literal["greenwood-williamson", "identical"] = field(
        default="greenwood-williamson", validator=choice("greenwood-williamson", "identical")
    )
    profile: Literal["exact", "thin-film"] = field(
        default="exact", validator=choice("exact", "thin-film")
    )
    meniscus_height: float | None = field(
        default=None, validator=optional(positive), metadata=si("m")
    )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        population = {
            "identical": "identical asperities, Eqs. (3.13) and (3.14) of Cai 2008",
            "greenwood-williamson": "summits of normal heights, Greenwood and Williamson 1966",
        }
        bridge = {
            "exact": "exact bridge of fixed pressure on each, Orr, Scriven and Rivas 1975",
            "thin-film": "thin meniscus on each, Eq. (3.7) of Cai 2008",
        }
        return (f"{population[self.law]}; {bridge[self.profile]}",)

    def liquid_needs(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        return ("surface_tension",)

    def reads(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.reads`: of a curve through bridges, which a closed form meets by itself."""
        return ("time_rtol",)

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        meniscus, missing = scene.meniscus, list[str]()
        if not scene.interface.is_flat:
            missing.append("two flats: the asperities stand on one of them")
        elif math.isinf(self.area(scene)):
            missing.append(
                "the radius [m] of a Flat face, over which the asperities are counted, or their "
                "count"
            )
        if meniscus.volume is not None:
            missing.append(
                "interface.meniscus.pressure [Pa] or meniscus_height [m], not a volume: which "
                "summits share it is not known"
            )
        elif scene.meniscus.has_pressure is not (self.meniscus_height is None):
            missing.append("either interface.meniscus.pressure [Pa] or meniscus_height [m]")
        if _wetting(scene) <= 0.0:
            missing.append(
                "contact angles that add up to less than 180 deg: nothing condenses between "
                "others, and no film is drawn up"
            )
        if meniscus.count != 1:
            missing.append("interface.meniscus.count = 1: the asperities are the count")
        if self.law == "greenwood-williamson" and self.asperities.rms_height == 0.0:
            missing.append('asperities.rms_height [m] above 0, or law="identical"')
        whole = ("meniscus-force", "viscous-force")
        missing += [
            f"{type(effect).__name__} left out: it is of one film, the liquid is at asperities"
            for effect in scene.effects
            if type(effect).name in whole
        ]
        return tuple(missing)

    def area(self, scene: SeparationScene) -> float:
        """Area [m2] that bears the asperities."""
        return self.asperities.counted_area(math.pi * scene.interface.rim_radius**2)

    def height(self, prepared: PreparedScene[SeparationScene]) -> float:
        """Height at which the menisci end [m], of a thin film."""
        from ...capillary.kelvin import meniscus_height

        if self.meniscus_height is not None:
            return self.meniscus_height
        pressure, tension = (
            prepared.liquid_pressure,
            prepared.liquid.surface_tension,
        )
        return float(meniscus_height(pressure, tension, _wetting(prepared.scene)))

    def prepare(self, prepared: PreparedScene[SeparationScene]) -> ForceLaw:
        """See `SeparationForce.prepare`."""
        if self.profile == "thin-film":
            end = self.height(prepared) if self.law == "identical" else math.inf
            return ForceLaw(lambda gap, speed: self.sums(prepared, gap).force, end=end, rate="none")
        return _exact_law(self, prepared)

    def sums(self, prepared: PreparedScene[SeparationScene], gap: float) -> AsperitySum:
        """Force, number and area coverage of thin menisci at a gap [m], whatever the `profile`."""
        from ...capillary import asperities as laws

        population, scene = self.asperities, prepared.scene
        area = self.area(scene)
        tension, wetting = prepared.liquid.surface_tension, _wetting(scene)
        height = self.height(prepared)
        given = (population.radius, population.density, area, tension, wetting, height)
        if self.law == "identical":
            return laws.identical(gap, *given)
        return laws.greenwood_williamson(gap, population.rms_height, *given)

    def validity(
        self, plan: PlanView, path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """See `SeparationEffect.validity`."""
        number = ValidityNumber(
            name="contact circles over the face",
            value=max(self.sums(plan.prepared, gap).coverage for gap, _ in path),
            high=MAX_COVERAGE,
            detail="above it the menisci of neighbouring asperities overlap",
            source="densest order of equal circles, pi/sqrt(12)",
        )
        return (number,)

    def part(self, result: RunView) -> AsperityPart:
        """See `SeparationEffect.part`."""
        import numpy as np

        sums = [self.sums(result.plan.prepared, gap) for gap in result.gap.tolist()]
        law = f"{self.law}, {self.profile} bridges"
        wet, coverage = np.array([s.n_wet for s in sums]), np.array([s.coverage for s in sums])
        return AsperityPart(result, self.column, law, wet, coverage)


def _wetting(scene: SeparationScene) -> float:
    """Sum of the cosines of both contact angles, right where they add up to 180 degrees."""
    from ...capillary.arc.shape import wetting

    meniscus = scene.meniscus
    return float(wetting(meniscus.contact_angle_lower, meniscus.contact_angle_upper))


def _exact_law(effect: AsperityMenisci, prepared: PreparedScene[SeparationScene]) -> ForceLaw:
    """Force of all menisci as a law of the gap."""
    import numpy as np

    from ...capillary.asperity_bridges import force_curve, gaussian_average

    population, tension = effect.asperities, prepared.liquid.surface_tension
    pressure = -_wetting(prepared.scene) / effect.height(prepared)
    rtol = max(0.1 * prepared.accuracy.time_rtol, 1e-11)
    one, reach = force_curve(pressure, prepared.angles, 1.0 / population.radius, rtol)
    number = population.density * effect.area(prepared.scene)
    if effect.law == "identical":
        last = reach * (1.0 - 1e-12)  # a trial step may look beyond the end
        return ForceLaw(
            lambda gap, speed: number * tension * float(one(np.asarray(min(gap, last)))),
            end=reach,
            rate="none",
        )
    spread = population.rms_height
    return ForceLaw(
        lambda gap, speed: number * tension * gaussian_average(one, reach, gap, spread), rate="none"
    )
