"""The film of a scene as the numbers that the C kernel of a native FMU reads."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from attrs import evolve

from ...accuracy import Accuracy
from ...errors import ConvergenceError, DescriptionError
from ...scene.loading import ImposedForce
from ...scene.scenes import SeparationScene
from ...separation.effects.base import FilmEnd, ForceLaw, SeparationForce
from ...separation.effects.film_shape import FilmShape
from ...separation.effects.prepared import PreparedScene, with_fraction
from ...separation.effects.viscous import (
    TensionLimit,
    ViscousForce,
    ViscousLaw,
    viscous_film,
)
from ...separation.plan import Plan, plan
from .tables import Table, tabulate

__all__ = ["FINE", "FilmNumbers", "can_tear", "film_numbers", "free_liquid", "moving"]

FINE = Accuracy(time_rtol=1e-11)
"""Accuracy of the laws behind the tables; their splines are 100 times finer than by default."""

_FAR = 4.0  # final gaps up to which laws without an end are tabulated; their power goes on
_FARTHER = 100.0  # the same of forces that lose no digits there
_FIXED, _SURFACE, _VISCOSITY = 0.0, 1.0, 2.0
_INF = math.inf


class FilmNumbers(NamedTuple):
    """Numbers that the kernel reads about a scene, and what they were made of."""

    numbers: list[float]
    lowest: float
    """Lowest gap of the tables [m]."""
    force: float
    """Static force at the start [N], or 0."""
    prepared: PreparedScene[SeparationScene]


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

    A property of the liquid may be set where each effect that reads it is proportional to it.
    """
    scene = prepared.scene
    forces = {e for e in scene.effects if isinstance(e, SeparationForce)}
    scaled = {e.proportional_to(scene) for e in forces}
    for effect in scene.effects:
        own = effect.proportional_to(scene) if isinstance(effect, SeparationForce) else ""
        scaled -= set(effect.liquid_needs(scene)) - {own}
    viscosity, tension = (
        (prepared.liquid.given(name) or 0.0) if name in scaled else 0.0
        for name in ("viscosity", "surface_tension")
    )
    return FreeLiquid(viscosity, tension)


def film_numbers(scene: SeparationScene, accuracy: Accuracy = FINE) -> FilmNumbers:
    """Numbers of the films of a scene, in the order in which ``native/data.c`` reads them.

    Raises
    ------
    ContactkitError
        If the scene cannot be planned, or a force is too rough for a table.
    """
    made = plan(scene, accuracy)
    interface, loading = scene.interface, scene.loading
    fractions = [1.0]
    fraction = scene.meniscus.rewetting
    if scene.meniscus.volume is not None and 0.0 < fraction < 1.0:
        fractions.append(fraction)
    tension = scene.effect(TensionLimit)
    reynolds = tension is not None and tension.cavity == "reynolds"
    is_sphere = not interface.is_flat
    tables = _Tables(made, free_liquid(made.prepared), max(1e-13, 1e-3 * loading.initial_gap))
    numbers = [
        float(is_sphere),
        interface.sphere_radius,
        float(scene.meniscus.count),
        float(reynolds),
        fraction,
        float(len(fractions)),
    ]
    for one in fractions:
        numbers += _film(tables, one)
    force = made.film.static_force(loading.initial_gap)
    return FilmNumbers(numbers, tables.lowest, force, made.prepared)


class _Tables(NamedTuple):
    """What the tables of a plan have in common: liquid that stays free, and their lowest gap."""

    plan: Plan
    free: FreeLiquid
    lowest: float

    @property
    def final_gap(self) -> float:
        """Gap [m] that is reached: in a host a motion goes on beyond that of the scene.

        At least up to the ends of the laws, so that a table holds all of a bridge.
        """
        given = self.plan.scene.loading.final_gap
        ends = (law.end for law in self.plan.film.laws.values())
        return max((given, *(end for end in ends if end < _INF)))


def _film(tables: _Tables, fraction: float) -> list[float]:
    """Numbers of the film with a fraction of the volume."""
    made = tables.plan
    film, prepared = made.film_with(fraction), with_fraction(made.prepared, fraction)
    breaks = _INF
    for effect in made.scene.effects:
        if isinstance(effect, FilmEnd):
            breaks = effect.prepare(prepared)
    ends = min([_INF, *(law.end for law in film.laws.values())])
    numbers = [ends, breaks, film.full_gap, float(len(film.laws))]
    for effect in made.scene.effects:
        if isinstance(effect, SeparationForce):
            numbers += _law(tables, effect, film.laws[type(effect)])
    shape = viscous_film(prepared) if film.has_viscous else None
    disc = [shape.rim * shape.rim, shape.volume] if shape and can_tear(made.scene) else [0.0, 0.0]
    return numbers + _shape(tables, shape).numbers() + disc


def can_tear(scene: SeparationScene) -> bool:
    """Whether the film of a scene may have a cavity: one between flats, with a viscous force."""
    return scene.interface.is_flat and scene.effect(ViscousForce) is not None


def _law(tables: _Tables, effect: SeparationForce, law: ForceLaw) -> list[float]:
    viscosity, surface_tension = tables.free
    speed = 1.0 if isinstance(law, ViscousLaw) else 0.0
    scale, unit = _FIXED, 1.0
    proportional_to = effect.proportional_to(tables.plan.scene)
    if proportional_to == "viscosity" and viscosity:
        scale, unit = _VISCOSITY, viscosity
    elif proportional_to == "surface_tension" and surface_tension:
        scale, unit = _SURFACE, surface_tension
    table = _law_table(tables, effect, law, lambda gap: law.force(gap, speed) / unit)
    return [
        scale,
        float(effect.needs_film),
        law.end,
        law.release,
        law.recontact,
        float(len(law.kinks)),
        *law.kinks,
        *table.numbers(),
    ]


def _law_table(
    tables: _Tables, effect: SeparationForce, law: ForceLaw, force: Callable[[float], float]
) -> Table:
    lowest, final, high = tables.lowest, tables.final_gap, min(law.end, law.known_to)
    stays = math.isfinite(high)
    if not stays:
        high = _FAR * final if isinstance(law, ViscousLaw) else _FARTHER * final
    folds = {high} if high == law.end else set[float]()
    inside = {kink for kink in law.kinks if lowest < kink < high}
    if lowest < law.release < high:
        inside.add(law.release)
        folds.add(law.release)
    edges = [lowest, *sorted(inside), high]
    try:
        return tabulate(force, edges, folds=tuple(folds), stays=stays)
    except ConvergenceError as error:
        raise ConvergenceError(
            f"{type(effect).__name__} has no native form: {error}; or take profile='arc' if it is "
            "a meniscus, or build the Python FMU, without --native",
            error.result,
        ) from error


def _shape(tables: _Tables, shape: FilmShape | None) -> Table:
    """Reach of the film, for the limits of the liquid."""
    lowest, high = tables.lowest, _FAR * tables.final_gap
    if shape is None:
        return tabulate(lambda gap: 1.0, (lowest, high))
    marks = {mark for mark in (shape.full_gap, shape.level) if lowest < mark < high}
    return tabulate(_reach(shape), (lowest, *sorted(marks), high))


def _reach(shape: FilmShape) -> Callable[[float], float]:
    if math.isinf(shape.sphere_radius):
        return lambda gap: shape.radius(gap) ** 2
    # Without an end the film is as high as a number can be whose square is one, too.
    return lambda gap: min(shape.height(gap) - gap, 1e150)
