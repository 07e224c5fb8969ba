"""Menisci at the asperities of a rough face: one bridge at each summit within reach."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Literal

from attrs import field, frozen

from ...scene.asperity_population import AsperityPopulation
from ...units import si
from ...validators import choice, optional, part, positive
from .base import ForceLaw, SeparationForce

if TYPE_CHECKING:
    from ...accuracy import Accuracy
    from ...capillary.asperities import AsperitySum
    from ...scene.scenes import SeparationScene

__all__ = ["AsperityMenisci", "exact_law"]


@frozen(kw_only=True)
class AsperityMenisci(SeparationForce):
    """Menisci at the summits of a rough flat face near a smooth one; the liquid condenses there.

    The gap of the scene is the distance of the smooth face from the mean plane of the summits.
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
    column: ClassVar[str] = "asperity_force"
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
            "identical": "identical asperities, Eqs. (3.13) and (3.14)",
            "greenwood-williamson": "summits of normal heights, Greenwood and Williamson 1966",
        }
        bridge = {
            "exact": "exact bridge of fixed pressure (Young-Laplace) on each",
            "thin-film": "thin meniscus on each, Eq. (3.7)",
        }
        return (f"{population[self.law]}; {bridge[self.profile]}",)

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `SeparationEffect.lacks`."""
        meniscus, missing = scene.meniscus, list[str]()
        if not scene.interface.is_flat:
            missing.append("two flats: the asperities stand on one of them")
        elif math.isinf(scene.interface.rim_radius):
            missing.append("the radius [m] of a Flat face, over which the asperities are counted")
        if meniscus.liquid.at(scene.temperature).surface_tension is None:
            missing.append("liquid.surface_tension [N/m]")
        if meniscus.volume is not None:
            missing.append(
                "interface.meniscus.pressure [Pa] or meniscus_height [m], not a volume: which "
                "summits share it is not known"
            )
        elif (scene.liquid_pressure is None) == (self.meniscus_height is None):
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

    def height(self, scene: SeparationScene) -> float:
        """Height at which the menisci end [m], of a thin film."""
        from ...capillary.kelvin import meniscus_height

        if self.meniscus_height is not None:
            return self.meniscus_height
        tension = scene.meniscus.liquid.at(scene.temperature).surface_tension
        pressure = scene.liquid_pressure
        return float(meniscus_height(pressure, tension, _wetting(scene)))

    def coverage(self, scene: SeparationScene, gap: float) -> float:
        """Contact circles of all menisci over the area of the face at a gap [m], thin films."""
        return self.sums(scene, gap).coverage

    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> ForceLaw:
        """See `SeparationForce.prepare`."""
        if self.profile == "thin-film":
            end = self.height(scene) if self.law == "identical" else math.inf
            return ForceLaw(lambda gap, speed: self.sums(scene, gap).force, end=end)

        return exact_law(self, scene, accuracy, _wetting(scene))

    def sums(self, scene: SeparationScene, gap: float) -> AsperitySum:
        """Force, number and cover of thin menisci at a gap [m], whatever the `profile`."""
        from ...capillary import asperities as laws

        population, wetting = self.asperities, _wetting(scene)
        tension = scene.meniscus.liquid.at(scene.temperature).surface_tension
        assert tension is not None  # plan() has asked lacks() first
        area = math.pi * scene.interface.rim_radius**2
        given = (population.radius, population.density, area, tension, wetting, self.height(scene))
        if self.law == "identical":
            return laws.identical(gap, *given)
        return laws.greenwood_williamson(gap, population.rms_height, *given)


def _wetting(scene: SeparationScene) -> float:
    """Sum of the cosines of both contact angles, right where they add up to 180 degrees."""
    from ...capillary.arc.shape import wetting

    meniscus = scene.meniscus
    return float(wetting(meniscus.contact_angle_lower, meniscus.contact_angle_upper))


def exact_law(
    effect: AsperityMenisci, scene: SeparationScene, accuracy: Accuracy, wetting: float
) -> ForceLaw:
    """Force of all menisci as a law of the gap."""
    import numpy as np

    from ...capillary.asperity_bridges import force_curve, gaussian_average

    meniscus, population = scene.meniscus, effect.asperities
    tension = meniscus.liquid.at(scene.temperature).surface_tension
    assert tension is not None  # plan() has asked lacks() first
    pressure = -wetting / effect.height(scene)
    angles = (meniscus.contact_angle_lower, meniscus.contact_angle_upper)
    rtol = max(0.1 * accuracy.time_rtol, 1e-11)
    one, reach = force_curve(pressure, angles, 1.0 / population.radius, rtol)
    number = population.density * math.pi * scene.interface.rim_radius**2
    if effect.law == "identical":
        last = reach * (1.0 - 1e-12)  # a trial step may look beyond the end
        return ForceLaw(
            lambda gap, speed: number * tension * float(one(np.asarray(min(gap, last)))), end=reach
        )
    spread = population.rms_height
    return ForceLaw(lambda gap, speed: number * tension * gaussian_average(one, reach, gap, spread))
