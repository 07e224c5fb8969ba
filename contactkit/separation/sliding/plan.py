"""Plan of a sliding: the checked scene and its prepared forces."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, ClassVar

from attrs import evolve, field, frozen

from ...accuracy import Accuracy
from ...errors import DescriptionError, InfeasibleError, PlanError
from ...kinds import SLIDING_SCENE_EFFECTS
from ...liquids.liquid import LiquidState
from ...registry import Registries
from ...scene.column import Column
from ...scene.effect import check_listed
from ...scene.interface import Body, Interface
from ...scene.plan import ScenePlan
from ...scene.scenes import SlidingScene
from ...scene.surfaces import Sphere
from ..bodies import check_bodies
from ..effects.base import SeparationEffect
from ..effects.film_shape import FilmShape
from ..effects.prepared import PreparedScene, prepare_scene
from ..effects.published_film import published_film
from ..effects.viscous import ShearLimit
from .effects import CouetteForce, SlideLaw, SlidingForce

__all__ = ["SlidingPlan", "divide_sliding", "plan_sliding"]

COLUMNS = MappingProxyType(
    {
        column.name: column
        for column in (
            Column("time", "s", "time"),
            Column("travel", "m", "travel"),
            Column("speed", "m/s", "sliding speed"),
            Column("overlap_area", "m2", "overlap of the wetted circles"),
            Column("tangential_force", "N", "tangential force", "#6a4c93", "--"),
            Column("tangential_impulse", "N.s", "tangential impulse so far"),
        )
    }
)
"""Columns that belong to no effect, by their names."""


@frozen(eq=False)
class SlidingPlan(ScenePlan):
    """A checked sliding scene with each effect prepared once.

    ``print(plan)`` says what will be simulated and what will not; `cite` gives the sources.
    """

    known_effects: ClassVar[Registries[Any]] = SLIDING_SCENE_EFFECTS

    prepared: PreparedScene[SlidingScene] = field(repr=False)
    laws: Mapping[type[SlidingForce], SlideLaw] = field(repr=False)
    columns: Mapping[str, Column] = field(repr=False)
    """Columns a result of this plan may have, by their names."""

    @property
    def scene(self) -> SlidingScene:
        """Scene that is simulated."""
        return self.prepared.scene

    @property
    def accuracy(self) -> Accuracy:
        """Numerical accuracy of the solution."""
        return self.prepared.accuracy

    @property
    def film(self) -> FilmShape:
        """Shape of one film."""
        return self.prepared.film

    @property
    def wetted_radius(self) -> float:
        """Radius of the wetted circle of one meniscus [m]."""
        return self.film.radius(self.scene.loading.gap)

    @property
    def break_travel(self) -> float:
        """Travel [m] from which on the wetted circles do not overlap: twice their radius."""
        return 2.0 * self.wetted_radius

    @property
    def end(self) -> float:
        """Travel [m] at which the run ends."""
        return min(self.scene.loading.travel or math.inf, self.break_travel)

    @property
    def title(self) -> str:
        """See `ScenePlan.title`."""
        return (
            f"{self.scene.name or 'sliding'}: {self.scene.loading.summary}, travel {self.end:g} m"
        )

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the scene, of which the same plan is made again: laws are functions."""
        return plan_sliding, (self.scene, self.accuracy)


def plan_sliding(scene: SlidingScene, accuracy: Accuracy | None = None) -> SlidingPlan:
    """Check the effects against a sliding scene and prepare each of them once.

    Parameters
    ----------
    scene : SlidingScene
        What is there and which physics it calls for.
    accuracy : Accuracy, optional
        How well to solve; `Accuracy.standard` if not given. Only `points` matters.

    Raises
    ------
    PlanError
        If an effect is listed twice, lacks something, or does not act on a sliding.
    InfeasibleError
        If the gap is closed.
    """
    check_bodies(scene)
    liquid = scene.meniscus.liquid.at(scene.temperature)
    _check_effects(scene, liquid)
    _check_gap(scene)
    prepared = prepare_scene(scene, accuracy, liquid)
    drag = scene.effect(CouetteForce)
    if drag is not None and drag.takes_printed():
        prepared = evolve(prepared, film=published_film(prepared))
    forces = [effect for effect in scene.effects if isinstance(effect, SlidingForce)]
    laws = {type(effect): effect.prepare(prepared) for effect in forces}
    _check_path(scene, laws)
    own = {column.name: column for effect in forces for column in effect.curves()}
    return SlidingPlan(prepared, MappingProxyType(laws), MappingProxyType({**COLUMNS, **own}))


def _check_effects(scene: SlidingScene, liquid: LiquidState) -> None:
    kinds = check_listed(scene.effects, SeparationEffect, "sliding", SLIDING_SCENE_EFFECTS)
    if not any(isinstance(effect, SlidingForce) for effect in scene.effects):
        raise PlanError(
            "a sliding scene needs at least one force along the bodies; known: "
            f"{SLIDING_SCENE_EFFECTS.names}"
        )
    problems = [
        f"{type(effect).__name__} needs a SeparationScene: it acts where the gap opens; known for "
        f"sliding: {SLIDING_SCENE_EFFECTS.names}"
        for effect in scene.effects
        if not isinstance(effect, SlidingForce) and type(effect) not in SLIDING_SCENE_EFFECTS
    ]
    if scene.meniscus.has_pressure:
        problems.append(
            "a sliding scene needs interface.meniscus.volume [m3] in place of its pressure"
        )
    if scene.meniscus.slips:
        problems.append(
            "interface.meniscus.slip_length_lower and slip_length_upper [m] are read by the "
            "ViscousForce of a SeparationScene: leave them out"
        )
    if scene.meniscus.liquid.shear_viscosity is not None and CouetteForce in kinds:
        problems.append(
            "CouetteForce takes the viscosity at rest, and the liquid has a shear_viscosity: leave "
            'it out, or list ShearLimit(law="eyring", strength=...)'
        )
    for effect in scene.effects:
        if isinstance(effect, SlidingForce):
            lacks = (*liquid.missing(*effect.liquid_needs(scene)), *effect.lacks(scene))
            problems += [f"{type(effect).__name__} needs {item}" for item in lacks]
    if ShearLimit in kinds and CouetteForce not in kinds:
        problems.append("ShearLimit needs CouetteForce() beside it: it bounds the shear stress")
    if ShearLimit in kinds and scene.loading.imposed == "time":
        problems.append(
            "ShearLimit needs loading.speed [m/s]: with only the time given, the path on which the "
            "limit acts is not known"
        )
    if problems:
        raise PlanError("; ".join(problems))


def _check_path(scene: SlidingScene, laws: Mapping[type[SlidingForce], SlideLaw]) -> None:
    """Refuse a force of which nothing is known where only the time is given."""
    if scene.loading.speed is not None:
        return
    for kind, law in laws.items():
        if law.impulse is None and law.work is None:
            raise PlanError(
                f"{kind.__name__} needs loading.speed [m/s]: with only the time given its force is "
                "not known, unless its SlideLaw gives the impulse of one that is proportional to "
                "speed, or the work of one that does not depend on it"
            )


def _check_gap(scene: SlidingScene) -> None:
    if scene.loading.gap > 0.0:
        return
    drag, is_flat = scene.effect(CouetteForce), scene.interface.is_flat
    if is_flat:
        raise InfeasibleError(
            "loading.gap is 0 m between flats: touching flats are a contact problem; give the gap "
            "that their roughness keeps open [m]"
        )
    if drag is not None and drag.closure != "as-published":
        raise InfeasibleError(
            "loading.gap is 0 m: the viscous drag under a touching sphere is infinite, it grows "
            "as ln(1/gap); give a cut-off gap [m], such as the roughness or 0.2 to 0.3 nm"
        )


def divide_sliding(scene: SlidingScene, n_menisci: int) -> SlidingScene:
    r"""Return a scene in which a number of menisci stand where there was one, on the same area.

    Parameters
    ----------
    scene : SlidingScene
        A film between flats, or under a sphere.
    n_menisci : int
        Number N of menisci in place of each; the square of a whole number fills a square.

    Returns
    -------
    SlidingScene
        Between flats the liquid is shared out, and each film has the radius x/sqrt(N). A sphere
        becomes N asperities of radius R/sqrt(N) with the same film height at the rim, which
        takes sqrt(N) times the liquid.

    Notes
    -----
    The drag of flats is then N^0 at a given speed, N^(-1/2) at a given time (travels are shorter);
    that of spheres N^(1/2) and N^(1/4), not the N^(-1/2) of Eq. (3.59). The force of contact lines
    that stick grows as N^(1/2) between flats and N^(3/4) under spheres.

    Raises
    ------
    InfeasibleError
        If neighbouring menisci would overlap: the wetted radius exceeds that of the asperities,
        N^(1/2) > R/(2 (s - D)).
    """
    if isinstance(n_menisci, bool) or not isinstance(n_menisci, int) or n_menisci < 1:
        raise DescriptionError(
            "divide_sliding(n_menisci)", n_menisci, "be a whole number of at least 1"
        )
    interface, meniscus = scene.interface, scene.meniscus
    if interface.is_flat:
        more = evolve(meniscus, count=meniscus.count * n_menisci)
        return evolve(scene, interface=evolve(interface, meniscus=more))
    if meniscus.volume is None:
        raise DescriptionError(
            "Meniscus.volume",
            None,
            "be given to be shared out",
            unit="m3",
        )
    root = math.sqrt(n_menisci)
    film, gap = prepare_scene(scene).film, scene.loading.gap
    depth = film.height(gap) - gap
    if n_menisci > 1 and 2.0 * depth * root > film.sphere_radius:
        most = max(int((film.sphere_radius / (2.0 * depth)) ** 2), 1)
        raise InfeasibleError(
            f"{n_menisci} asperities have menisci that overlap: at most {most} of them stand "
            f"apart with a film of {film.height(gap):g} m at a gap of {gap:g} m"
        )
    more = evolve(meniscus, count=meniscus.count * n_menisci, volume=root * meniscus.volume)
    smaller = Interface(
        lower=_smaller(interface.lower, root), upper=_smaller(interface.upper, root), meniscus=more
    )
    return evolve(scene, interface=smaller)


def _smaller(body: Body, root: float) -> Body:
    """Sphere of a radius divided by a number; a flat as it is."""
    curvature = body.surface.curvature
    return Body(surface=Sphere(radius=1.0 / curvature / root)) if curvature else body
