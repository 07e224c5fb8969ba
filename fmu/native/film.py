"""The film of a scene as the tables that the C kernel of a native FMU reads."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from typing import NamedTuple

from attrs import evolve

from ...accuracy import Accuracy
from ...errors import ConvergenceError, DescriptionError, PlanError
from ...liquids.temperature_table import liquid_table
from ...scene.loading import ImposedForce
from ...scene.scenes import SeparationScene
from ...separation.effects.base import FilmEnd, SeparationForce
from ...separation.effects.film_shape import FilmShape, between_flats
from ...separation.effects.force_law import ForceLaw, measured_rate
from ...separation.effects.prepared import PreparedScene, with_fraction
from ...separation.effects.viscous import ShearLimit, TensionLimit, ViscousForce, viscous_film
from ...separation.face.shape import on_face
from ...separation.film import Film as PlanFilm
from ...separation.plan import Plan, plan
from ...separation.rheology.prepared_film import PreparedFilm as RheologyOfFilm
from ..slaves.rheology import is_rheological, with_rheology
from .records import (
    Film,
    FilmTables,
    Grid,
    Law,
    LiquidTable,
    Rate,
    Rheology,
    Scale,
    Scaling,
    Table,
)
from .rheology import (
    check_face,
    film_in_hosts,
    nearest_gap,
    rheological_film,
    rheology_record,
    scaling_of,
)
from .tables import Tabulate, tabulate

__all__ = [
    "FINE",
    "PreparedFilm",
    "can_cavitate",
    "free_liquid",
    "liquid_over_temperature",
    "moving",
    "prepared_film",
]

FINE = Accuracy(time_rtol=1e-11)
"""Accuracy of the laws behind the tables; their splines are 100 times finer than by default."""

# Final gaps up to which laws without an end are tabulated; beyond, their last power goes on. A
# motion in a host rarely goes farther than four; forces that cost no digits there (static ones) are
# cheap to 100. So are films on uneven faces, which are no power of the gap yet where a disc is one.
_FAR = 4.0
_FARTHER = 100.0
_PROBES = 65  # gaps at which a law is asked how it depends on the speed
_INF = math.inf


class PreparedFilm(NamedTuple):
    """Tables that the kernel reads about a scene, and what they were made of."""

    tables: FilmTables
    lowest: float
    """Lowest gap of the tables [m]."""
    force: float
    """Static force at the start [N], or 0."""
    prepared: PreparedScene[SeparationScene]
    effects: tuple[type[SeparationForce], ...]
    """Effect that each law of a film is of, in the order of its laws."""
    liquid: LiquidTable | None = None
    """Laws of the liquid over the temperature, where that is a variable."""


def moving(scene: SeparationScene, mass: float | None) -> SeparationScene:
    """Scene whose mass moves under an imposed force, whatever the scene imposes.

    Raises
    ------
    DescriptionError
        If there is no mass.
    """
    given = scene.loading
    own = given if isinstance(given, ImposedForce) else None
    if mass is None and own is not None:
        mass = own.mass
    if mass is None:
        raise DescriptionError(
            "m", None, "be given", unit="kg", hint="the scene has no loading.mass; set m=..."
        )
    if own is not None:
        return evolve(scene, loading=evolve(own, force=0.0, mass=mass))
    loading = ImposedForce(
        force=0.0, mass=mass, initial_gap=given.initial_gap, final_gap=given.final_gap
    )
    return evolve(scene, loading=loading)


class FreeLiquid(NamedTuple):
    """Properties of the liquid that are parameters of a native FMU; 0 where they are not."""

    viscosity: float  # [Pa.s]
    surface_tension: float  # [N/m]


def free_liquid(prepared: PreparedScene[SeparationScene]) -> FreeLiquid:
    """Viscosity [Pa.s] and surface tension [N/m] that may be set in the FMU; 0 where they may not.

    A property of the liquid may be set where each effect that reads it is proportional to it, and
    the viscosity where its rheology is known for another one.
    """
    scene, film = prepared.scene, rheological_film(prepared)
    forces = {e for e in scene.effects if isinstance(e, SeparationForce)}
    scaled = {e.proportional_to(scene) for e in forces}
    for effect in scene.effects:
        own = effect.proportional_to(scene) if isinstance(effect, SeparationForce) else ""
        scaled -= set(effect.liquid_needs(scene)) - {own}
    viscosity, tension = (
        (prepared.liquid.given(name) or 0.0) if name in scaled else 0.0
        for name in ("viscosity", "surface_tension")
    )
    if film is not None and scaling_of(film) is Scaling.NONE:
        viscosity = 0.0
    return FreeLiquid(viscosity, tension)


def liquid_over_temperature(scene: SeparationScene, free: Collection[str]) -> LiquidTable | None:
    """Laws of a liquid, where all that follows from the temperature of a scene is in `free`.

    The vapour of a meniscus, a strength that is the vapour pressure, and forces that are not
    proportional to what they read of the liquid depend on the temperature in other ways: None.
    """
    needs = {name for effect in scene.effects for name in effect.liquid_needs(scene)}
    limit = scene.effect(TensionLimit)
    by_vapour = limit is not None and "vapour" in (limit.strength, limit.cavity_pressure)
    if needs - {*free} or by_vapour or scene.meniscus.relative_humidity is not None:
        return None
    table = liquid_table(scene.meniscus.liquid)
    if table is None or not table.low <= scene.temperature <= table.high:
        return None
    logs = {name: tuple(table.logs.get(name, ())) for name in ("viscosity", "surface_tension")}
    count = max(map(len, logs.values()))
    if not count:
        return None
    logs = {name: values or (0.0,) * count for name, values in logs.items()}
    return LiquidTable(low=table.low, high=table.high, **logs)


def prepared_film(
    scene: SeparationScene, accuracy: Accuracy = FINE, make: Tabulate = tabulate
) -> PreparedFilm:
    """Tables of the films of a scene, each made by `make`: first those of the forces of a film.

    Raises
    ------
    ContactkitError
        If the scene cannot be planned, or a force is too rough for a table.
    """
    made = plan(with_rheology(scene), accuracy)
    _check_rheology(made)
    interface, loading, fraction = scene.interface, scene.loading, scene.meniscus.rewetting
    # Under a sphere whose cavity is followed, the film is one on a face with a crown.
    is_sphere = not interface.is_flat and not on_face(scene)
    returns = scene.meniscus.volume is not None and 0.0 < fraction < 1.0
    tension = scene.effect(TensionLimit)
    rheological = rheological_film(made.prepared)
    lowest = max(1e-13, 1e-3 * loading.initial_gap)
    if rheological is not None:
        lowest = nearest_gap(rheological, loading.initial_gap)
    common = _Common(made, free_liquid(made.prepared), lowest, make)
    if made.moving_effects:
        raise PlanError(
            f"a native FMU has no form of {', '.join(made.moving_effects)}: its tables "
            "are over the gap alone, and volume or end of this film depend on the motion; build "
            "the Python FMU (without --native), or run the scene with ck.simulate"
        )
    _check_limits(common)
    tables = FilmTables(
        is_sphere=is_sphere,
        sphere_radius=interface.sphere_radius if is_sphere else _INF,
        menisci=float(scene.meniscus.count),
        reynolds=tension is not None and tension.cavity == "reynolds",
        rewetting=fraction,
        films=tuple(_film(common, one) for one in ((1.0, fraction) if returns else (1.0,))),
        grid=_grid(common),
    )
    force = made.film.static_force(loading.initial_gap)
    laws = _tabulated(made.film, _computed(made.prepared))
    effects = tuple(
        type(effect)
        for effect in _forces(scene)
        for _ in _parts(common, effect, laws[type(effect)])
    )
    free = {name for name, value in common.free._asdict().items() if value}
    liquid = liquid_over_temperature(scene, free)
    return PreparedFilm(tables, common.lowest, force, made.prepared, effects, liquid)


class _Common(NamedTuple):
    """What the tables of a plan have in common: liquid that stays free, and their lowest gap."""

    plan: Plan
    free: FreeLiquid
    lowest: float
    make: Tabulate

    @property
    def final_gap(self) -> float:
        """Gap [m] that is reached: in a host a motion goes on beyond that of the scene.

        At least up to the ends of the laws, so that a table holds all of a bridge.
        """
        given = self.plan.scene.loading.final_gap
        ends = (law.end for law in self.plan.film.laws.values())
        return max((given, *(end for end in ends if end < _INF)))


def _film(common: _Common, fraction: float) -> Film:
    """Tables of the film with a fraction of the volume."""
    made = common.plan
    film, prepared = made.film_with(fraction), with_fraction(made.prepared, fraction)
    rheology = _computed(prepared)
    if rheology is not None:
        start = made.scene.loading.initial_gap
        rheology = film_in_hosts(rheology, common.lowest, start)
    forces = _forces(made.scene)
    rules = [e.prepare(prepared) for e in made.scene.effects if isinstance(e, FilmEnd)]
    is_liquid = any(kind.newtonian is not None for kind in film.laws)
    shape = _liquid_shape(prepared) if is_liquid else None
    disc = shape if can_cavitate(made.scene) and not on_face(made.scene) else None
    tabulated = _tabulated(film, rheology)
    laws = [law for effect in forces for law in _laws(common, effect, tabulated[type(effect)])]
    if len(laws) > Film.most("laws"):
        raise PlanError(
            f"{len(laws)} tables of forces are more than the {Film.most('laws')} of a native FMU; "
            "a force that acts at rest and depends on the speed counts twice"
        )
    return Film(
        end=min(law.end for law in film.laws.values()),
        breaks=min(rules, default=_INF),
        full_gap=film.full_gap,
        laws=tuple(laws),
        shape=_shape(common, shape),
        rim_square=disc.rim * disc.rim if disc else 0.0,
        volume=disc.volume if disc else 0.0,
        rheology=None if rheology is None else _rheology(common, rheology),
    )


def _computed(prepared: PreparedScene[SeparationScene]) -> RheologyOfFilm | None:
    """Film whose viscosity follows pressure and shear, which a plan has prepared; None for none."""
    rheology = prepared.rheology
    film = rheology.film if rheology is not None and rheology.computed else None
    return film if isinstance(film, RheologyOfFilm) else None


def _tabulated(
    film: PlanFilm, rheology: RheologyOfFilm | None
) -> dict[type[SeparationForce], ForceLaw]:
    """Laws of a film that are tables over the gap: of a rheology that at the viscosity at rest."""
    found = dict(film.laws)
    if rheology is not None:
        found[ViscousForce] = rheology.linear_law()
    return found


def _rheology(common: _Common, film: RheologyOfFilm) -> Rheology:
    start = common.plan.scene.loading.initial_gap
    return rheology_record(film, (common.lowest, _FAR * common.final_gap), start)


def _forces(scene: SeparationScene) -> list[SeparationForce]:
    return [effect for effect in scene.effects if isinstance(effect, SeparationForce)]


def _liquid_shape(prepared: PreparedScene[SeparationScene]) -> FilmShape:
    """Shape of the film; of one on a face that of a disc of its area, whatever the gap."""
    interface = prepared.scene.interface
    if on_face(prepared.scene) and not interface.is_flat:
        return between_flats(1, _INF, interface.rim_radius)
    return viscous_film(prepared)


def _check_rheology(made: Plan) -> None:
    """Refuse films that tables over the gap do not hold."""
    scene, rheology = made.scene, _computed(made.prepared)
    if rheology is not None:
        check_face(rheology.film)
        return
    is_limited = scene.effect(TensionLimit) is not None
    if scene.meniscus.slips and is_limited and not scene.interface.is_flat:
        raise PlanError(
            "a native FMU cuts off the pressure under a sphere as in a film that does not slip: "
            "leave TensionLimit or the slip lengths of the meniscus out, or run the scene with "
            "ck.simulate"
        )


def _check_limits(common: _Common) -> None:
    """Refuse limits of a film whose viscosity is no parameter: the kernel would have none."""
    if common.free.viscosity or is_rheological(common.plan.scene):
        return
    for effect in common.plan.scene.effects:
        if isinstance(effect, TensionLimit | ShearLimit):
            raise PlanError(
                f"{type(effect).__name__} has no native form beside a force that is not "
                "proportional to the viscosity it reads; leave that out, or run the scene by "
                "ck.simulate"
            )


def can_cavitate(scene: SeparationScene) -> bool:
    """Whether the film of a scene may have a cavity that is remembered.

    One between discs may in any case; one on another face where the scene has a `TensionLimit`, as
    it takes a grid. None that is known slips, or follows pressure and shear.
    """
    if scene.effect(ViscousForce) is None or is_rheological(scene) or scene.meniscus.slips:
        return False
    if on_face(scene):
        return scene.effect(TensionLimit) is not None
    return scene.interface.is_flat


def _grid(common: _Common) -> Grid | None:
    """Grid of a film that cavitates on a face that is no disc."""
    cavity = common.plan.film.cavity
    if cavity is None or common.plan.prepared.face_film is None:
        return None
    from ...separation.face.cavity import FaceCavity
    from .grid import grid_record

    if not isinstance(cavity, FaceCavity):
        return None
    return grid_record(cavity, (common.lowest, _FARTHER * common.final_gap))


def _laws(common: _Common, effect: SeparationForce, law: ForceLaw) -> list[Law]:
    """Tables of a force: what it is at rest, and what it is per speed."""
    viscosity, surface_tension = common.free
    scale, unit = Scale.FIXED, 1.0
    proportional_to = effect.proportional_to(common.plan.scene)
    if proportional_to == "viscosity" and viscosity:
        scale, unit = Scale.VISCOSITY, viscosity
    elif proportional_to == "surface_tension" and surface_tension:
        scale, unit = Scale.SURFACE_TENSION, surface_tension
    return [
        Law(
            scale=scale,
            rate=rate,
            needs_film=effect.needs_film,
            end=law.end,
            release=law.release,
            recontact=law.recontact,
            kinks=tuple(map(float, law.kinks)),
            table=_law_table(common, effect, law, rate, _over(part, unit)),
        )
        for rate, part in _parts(common, effect, law).items()
    ]


def _over(part: Callable[[float], float], unit: float) -> Callable[[float], float]:
    return lambda gap: part(gap) / unit


def _parts(
    common: _Common, effect: SeparationForce, law: ForceLaw
) -> dict[Rate, Callable[[float], float]]:
    """What a force is at rest [N], and per speed [N.s/m], as functions of the gap.

    Raises
    ------
    PlanError
        If it is not linear in the speed, so that no two functions of the gap say what it is.
    """
    rate: str = law.rate
    if rate == "any":
        high = min(law.end, law.known_to, _FAR * common.final_gap)
        ratio = high / common.lowest
        places = [common.lowest * ratio ** (i / _PROBES) for i in range(_PROBES)]
        rate = measured_rate(law, places)
    if rate == "any":
        raise PlanError(
            f"{type(effect).__name__} has no native form: its force is not linear in the speed, "
            "and the tables of a native FMU are F(h, 0) and dF/dv(h); run the scene with "
            "ck.simulate, or give a law that is linear over the speeds that matter"
        )
    found: dict[Rate, Callable[[float], float]] = {}
    if rate != "proportional":
        found[Rate.AT_REST] = lambda gap: law.force(gap, 0.0)
    if rate != "none":
        per_speed = Rate.PER_SPEED if effect.newtonian is None else Rate.LIQUID
        found[per_speed] = lambda gap: law.viscous_force(gap, 1.0)
    return found


def _law_table(
    common: _Common,
    effect: SeparationForce,
    law: ForceLaw,
    rate: Rate,
    force: Callable[[float], float],
) -> Table:
    lowest, final, high = common.lowest, common.final_gap, min(law.end, law.known_to)
    stays = math.isfinite(high)
    if not stays:
        is_power = rate is not Rate.AT_REST and not on_face(common.plan.scene)
        high = (_FAR if is_power else _FARTHER) * final
    folds = {high} if high == law.end else set[float]()
    inside = {kink for kink in law.kinks if lowest < kink < high}
    if lowest < law.release < high:
        inside.add(law.release)
        folds.add(law.release)
    edges = [lowest, *sorted(inside), high]
    try:
        return common.make(force, edges, folds=tuple(folds), stays=stays)
    except ConvergenceError as error:
        raise ConvergenceError(
            f"{type(effect).__name__} has no native form: {error}; or take profile='arc' if it is "
            "a meniscus, or build the Python FMU, without --native",
            error.result,
        ) from error


def _shape(common: _Common, shape: FilmShape | None) -> Table:
    """Reach of the film, for the limits of the liquid."""
    lowest, high = common.lowest, _FAR * common.final_gap
    if shape is None:
        return common.make(lambda gap: 1.0, (lowest, high))
    marks = {mark for mark in (shape.full_gap, shape.level) if lowest < mark < high}
    return common.make(_reach(shape), (lowest, *sorted(marks), high))


def _reach(shape: FilmShape) -> Callable[[float], float]:
    if math.isinf(shape.sphere_radius):
        return lambda gap: shape.radius(gap) ** 2
    # Without an end the film is as high as a number can be whose square is one, too.
    return lambda gap: min(shape.height(gap) - gap, 1e150)
