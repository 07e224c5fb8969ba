"""Force laws of N equal menisci between two flats: exact, circular approximation, as printed."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from ..errors import InfeasibleError, NotSimulatedError, PlanError
from ..lubrication import squeeze_film as squeeze
from ..scene.loading import ImposedForce, ImposedSpeed, ImposedTime, SeparationLoading
from ..separation.effects.as_published import mixed
from ..separation.effects.meniscus import MeniscusForce
from ..separation.effects.prepared import checked_liquid
from ..separation.effects.viscous import ViscousForce

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..liquids.liquid import LiquidState
    from ..scene.scenes import SeparationScene

    Floats = NDArray[np.float64]

__all__ = ["DivisionLaw", "law_of"]

Name = Literal["exact", "arc", "as-published"]

SOURCES = {
    "exact": "exact bridge, Orr, Scriven and Rivas 1975, to its stability limit; film, Stefan 1874",
    "arc": "arc of Eqs. (3.38)-(3.41) of Cai 2008 to the exact stability limit; film, Stefan 1874",
    "as-published": "Eqs. (3.33) and (3.34) of Cai 2008 as printed, to the gap of zero neck",
}


class DivisionLaw(NamedTuple):
    """Forces of N equal menisci of given total volume, at the gap and in the time of a scene.

    `meniscus` and `viscous` are functions of the volume of one meniscus [m3] and their number for
    the total force [N]; None if the scene does not include the effect. `radius` is the larger
    contact radius of one [m], `limit` its rupture gap [m].
    """

    name: Name
    gap: float
    meniscus: Callable[[Floats, Floats], Floats] | None
    viscous: Callable[[Floats, Floats], Floats] | None
    radius: Callable[[Floats, Floats], Floats]
    limit: Callable[[Floats], Floats]

    def total(self, volume: Floats, number: Floats) -> Floats:
        """Sum of the forces in the scene [N]."""
        found = [force(volume, number) for force in (self.meniscus, self.viscous) if force]
        return np.asarray(sum(found[1:], found[0]))

    def demand(self, kind: type) -> Callable[[Floats, Floats], Floats]:
        """Return a force, or raise an error that names the missing effect."""
        force = self.meniscus if kind is MeniscusForce else self.viscous
        if force is None:
            name = f"{kind.__name__}()"
            raise NotSimulatedError(f"the scene does not call for it: add {name} to its effects")
        return force


def law_of(scene: SeparationScene, name: Name | None, min_volume: float) -> DivisionLaw:
    """Law of a scene; `min_volume` [m3] is any volume, from which the limits are scaled."""
    effect = scene.effect(MeniscusForce)
    name = name or _own_law(scene)
    _check(scene, name)
    liquid = checked_liquid(scene)
    gap, limit = scene.loading.initial_gap, _limits(scene, name, min_volume)
    meniscus, radius = _meniscus(scene, name, liquid)
    film = scene.effect(ViscousForce)
    viscous = _viscous(scene, film, name, limit, liquid) if film is not None else None
    return DivisionLaw(name, gap, meniscus if effect is not None else None, viscous, radius, limit)


def _own_law(scene: SeparationScene) -> Name:
    """Law selected by the effects of a scene."""
    if both := mixed(scene):
        raise PlanError(both)
    meniscus, viscous = scene.effect(MeniscusForce), scene.effect(ViscousForce)
    if meniscus is not None:
        return meniscus.form
    is_printed = viscous is not None and viscous.closure == "as-published"
    return "as-published" if is_printed else "exact"


def _check(scene: SeparationScene, name: str) -> None:
    """Refuse scenes other than a film between two flats."""
    interface, loading = scene.interface, scene.loading
    known = (MeniscusForce, ViscousForce)
    others = [type(e).__name__ for e in scene.effects if not isinstance(e, known)]
    if name not in SOURCES:
        raise PlanError(f"a division has no law {name!r}; known: {', '.join(SOURCES)}")
    if others or not scene.effects:
        raise PlanError(
            "a division knows MeniscusForce() and ViscousForce() only, and needs one of them: "
            f"leave out {', '.join(others) or 'nothing, and add one'}"
        )
    viscous = scene.effect(ViscousForce)
    if viscous is not None and viscous.closure == "as-published" and name != "as-published":
        raise PlanError(
            f"ViscousForce(closure='as-published') does not go with the {name} law of a division: "
            "a result takes the equations as printed or the consistent ones, never both"
        )
    if not interface.is_flat:
        raise PlanError(
            "a division is of a film between two flats; for asperities in place of a sphere see "
            "AsperityPopulation.split and AsperityMenisci"
        )
    if isinstance(loading, ImposedForce) and viscous is not None:
        raise PlanError(
            "a division needs loading = ImposedTime(...) or ImposedSpeed(...): under a force "
            "there is no mean viscous force to compare, only a time"
        )
    if loading.initial_gap <= 0.0:
        raise InfeasibleError("loading.initial_gap is 0 m: touching flats hold no film to divide")


def _angles(scene: SeparationScene) -> tuple[float, float]:
    meniscus = scene.meniscus
    return meniscus.contact_angle_lower, meniscus.contact_angle_upper


def _limits(scene: SeparationScene, name: str, volume: float) -> Callable[[Floats], Floats]:
    """Rupture gap [m] as a function of the volume: it scales as the cube root."""
    if name == "as-published":
        from ..capillary.arc import flat as arc_flat

        one = float(arc_flat.zero_neck_gap(arc_flat.shape(*_angles(scene)), volume))
    else:
        from ..capillary.exact.stability import stability_limit

        one = float(stability_limit(volume, *_angles(scene)).gap)
    return lambda v: np.asarray(one * np.cbrt(v / volume))


def _printed_radius(scene: SeparationScene) -> Callable[[Floats, Floats], Floats]:
    """Radius x_n0/sqrt(N) [m] of one of N menisci in Eqs. (3.33) and (3.34).

    x_n0 is that of the undivided film: the contact circle of the arc where the effects of the scene
    are the printed ones, which then take the same at N = 1; else that of its area, volume over gap.
    """
    from ..capillary.arc import flat as arc_flat

    gap, meniscus, viscous = (
        scene.loading.initial_gap,
        scene.effect(MeniscusForce),
        scene.effect(ViscousForce),
    )
    is_printed = any(
        effect is not None and effect.takes_printed() for effect in (meniscus, viscous)
    )
    is_disc = meniscus is not None and meniscus.printed.radius == "disc"
    shape = arc_flat.shape(*_angles(scene))

    def radius(volume: Floats, number: Floats) -> Floats:
        whole = volume * number
        if not is_printed or is_disc:
            return np.asarray(squeeze.disc_radius(whole, gap) / np.sqrt(number))
        gaps = np.full_like(whole, gap)
        found = arc_flat.contact_radius(shape, gaps, whole)
        if meniscus is not None and meniscus.printed.pulled == "upper":
            found = arc_flat.upper_contact_radius(shape, gaps, found)
        return np.asarray(found / np.sqrt(number))

    return radius


def _meniscus(
    scene: SeparationScene, name: str, liquid: LiquidState
) -> tuple[Callable[[Floats, Floats], Floats], Callable[[Floats, Floats], Floats]]:
    gap, angles = scene.loading.initial_gap, _angles(scene)
    if name == "as-published":
        effect = scene.effect(MeniscusForce)
        pulled = effect.printed.pulled if effect is not None else "lower"
        one = _printed_radius(scene)
        from ..as_published.printed.common import meniscus_divided_3_33

        def printed(volume: Floats, number: Floats) -> Floats:
            whole, tension = one(volume, number) * np.sqrt(number), liquid.surface_tension
            return np.asarray(meniscus_divided_3_33(whole, gap, tension, *angles, number, pulled))

        return printed, one
    if name == "arc":
        from ..capillary.arc.bridge import arc_bridge as bridge
    else:
        from ..capillary.exact.bridge import bridge  # type: ignore[assignment]

    def force(volume: Floats, number: Floats) -> Floats:
        return np.asarray(number * liquid.surface_tension * bridge(gap, volume, *angles).force)

    def radius(volume: Floats, number: Floats) -> Floats:
        state = bridge(gap, volume, *angles)
        return np.maximum(state.radius_lower, state.radius_upper)

    return force, radius


def _viscous(
    scene: SeparationScene,
    effect: ViscousForce,
    name: str,
    limit: Callable[[Floats], Floats],
    liquid: LiquidState,
) -> Callable[[Floats, Floats], Floats]:
    """Mean viscous force over the opening, up to rupture or the final gap."""
    loading, viscosity = scene.loading, liquid.viscosity
    start = loading.initial_gap
    constant = effect.closure != "volume-conserving" or name == "as-published"
    printed = _printed_radius(scene) if name == "as-published" else None

    def force(volume: Floats, number: Floats) -> Floats:
        end = np.minimum(limit(volume), loading.final_gap)
        if constant:  # at constant radius, as printed
            if printed is not None:
                radius = printed(volume, number)
            else:
                radius = np.asarray(squeeze.disc_radius(volume, start))
            impulse = squeeze.disc_impulse_flooded(radius, start, end, viscosity)
        else:
            impulse = squeeze.disc_impulse_conserved(volume, start, end, viscosity)
        return np.asarray(number * impulse / _duration(loading, end - start))

    return force


def _duration(loading: SeparationLoading, way: Floats) -> Floats | float:
    """Time [s] in which a gap opens by a length [m]."""
    if isinstance(loading, ImposedTime):
        return loading.time
    return way / loading.speed if isinstance(loading, ImposedSpeed) else math.inf
