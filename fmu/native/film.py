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
from ...separation.effects.film_shape import FilmShape, film_shape
from ...separation.effects.registry import (
    AdhesiveContact,
    AsperityMenisci,
    MeniscusForce,
    TensionLimit,
    ViscousForce,
)
from ...separation.effects.viscous import keeps_radius
from ...separation.film import Film
from ...separation.plan import Plan, plan
from .tables import Table, tabulate

__all__ = ["FINE", "FilmNumbers", "film_numbers", "free_liquid", "moving"]

FINE = Accuracy(time_rtol=1e-11)
"""Accuracy of the laws behind the tables; their splines are 100 times finer than by default."""

_FAR = 4.0  # final gaps up to which laws without an end are tabulated; their power goes on
_FARTHER = 100.0  # the same of forces that lose no digits there
_FIXED, _SURFACE, _VISCOSITY = 0.0, 1.0, 2.0
_INF = math.inf


class FilmNumbers(NamedTuple):
    """What the kernel reads about a scene, and the lowest gap its tables know [m]."""

    numbers: list[float]
    lowest: float


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


def free_liquid(scene: SeparationScene) -> tuple[float, float]:
    """Viscosity [Pa.s] and surface tension [N/m] that may be set in the FMU; 0 where they may not.

    The viscous force is proportional to viscosity. The force of a meniscus is proportional to
    surface tension at a given volume, but not at a given pressure.
    """
    state = scene.meniscus.liquid.at(scene.temperature)
    viscosity = state.viscosity if scene.effect(ViscousForce) is not None else None
    adhesion = scene.effect(AdhesiveContact)
    fixed = (
        scene.effect(MeniscusForce) is None
        or scene.liquid_pressure is not None
        or scene.effect(AsperityMenisci) is not None
        or (adhesion is not None and adhesion.work_of_adhesion == "capillary")
    )
    return viscosity or 0.0, 0.0 if fixed else (state.surface_tension or 0.0)


def film_numbers(scene: SeparationScene, accuracy: Accuracy = FINE) -> FilmNumbers:
    """Numbers of the films of a scene, in the order in which ``native/data.c`` reads them.

    Raises
    ------
    ContactkitError
        If the scene cannot be planned, or a force is too rough for a table.
    """
    prepared = plan(scene, accuracy)
    interface, loading = scene.interface, scene.loading
    shares = [1.0]
    share = scene.meniscus.rewetting
    if scene.meniscus.volume is not None and 0.0 < share < 1.0:
        shares.append(share)
    tension = scene.effect(TensionLimit)
    reynolds = tension is not None and tension.cavity == "reynolds"
    is_sphere = not interface.is_flat
    lowest = max(1e-13, 1e-3 * loading.initial_gap)
    numbers = [
        float(is_sphere),
        interface.sphere_radius,
        float(scene.meniscus.count),
        float(reynolds),
        share,
        float(max(accuracy.max_steps, 1)),
        float(len(shares)),
    ]
    for one in shares:
        numbers += _film(prepared, one, lowest)
    return FilmNumbers(numbers, lowest)


def _film(prepared: Plan, share: float, lowest: float) -> list[float]:
    """Numbers of the film with a share of the volume."""
    film, scene = prepared.film_with(share), _with_share(prepared.scene, share)
    breaks = _INF
    for effect in scene.effects:
        if isinstance(effect, FilmEnd):
            breaks = effect.prepare(scene, prepared.accuracy)
    ends = min([_INF, *(law.end for law in film.laws.values())])
    numbers = [ends, breaks, film.full_gap, float(len(film.laws))]
    for kind, law in film.laws.items():
        numbers += _law(scene, kind, law, lowest)
    return numbers + _shape(scene, film, lowest).numbers()


def _with_share(scene: SeparationScene, share: float) -> SeparationScene:
    meniscus = scene.meniscus
    if share == 1.0 or meniscus.volume is None:
        return scene
    less = evolve(meniscus, volume=share * meniscus.volume)
    return evolve(scene, interface=evolve(scene.interface, meniscus=less))


def _law(
    scene: SeparationScene, kind: type[SeparationForce], law: ForceLaw, lowest: float
) -> list[float]:
    viscosity, surface_tension = free_liquid(scene)
    scale, speed, unit = _FIXED, 0.0, 1.0
    if kind is ViscousForce:
        scale, speed, unit = _VISCOSITY, 1.0, viscosity
    elif kind is MeniscusForce and surface_tension:
        scale, unit = _SURFACE, surface_tension
    table = _law_table(scene, kind, law, lowest, lambda gap: law.force(gap, speed) / unit)
    return [
        scale,
        float(kind.needs_film),
        law.end,
        law.release,
        law.rejoin,
        float(len(law.kinks)),
        *law.kinks,
        *table.numbers(),
    ]


def _law_table(
    scene: SeparationScene,
    kind: type[SeparationForce],
    law: ForceLaw,
    lowest: float,
    force: Callable[[float], float],
) -> Table:
    final = scene.loading.final_gap
    # A meniscus on a sphere is a curve that was made up to twice the final gap, and stays there.
    is_curve = kind is MeniscusForce and not scene.interface.is_flat
    high = min(law.end, 2.0 * final) if is_curve else law.end
    stays = math.isfinite(high)
    if not stays:
        high = _FAR * final if kind is ViscousForce else _FARTHER * final
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
            f"{kind.__name__} has no native form: {error}; take profile='arc' if it is a meniscus, "
            f"or build the Python FMU, without --native",
            error.result,
        ) from error


def _shape(scene: SeparationScene, film: Film, lowest: float) -> Table:
    """Reach of the film, for the limits of the liquid."""
    high = _FAR * scene.loading.final_gap
    if ViscousForce not in film.laws:
        return tabulate(lambda gap: 1.0, (lowest, high))
    shape = film_shape(scene, constant_radius=keeps_radius(scene))
    marks = {mark for mark in (shape.full_gap, shape.level) if lowest < mark < high}
    return tabulate(_reach(shape), (lowest, *sorted(marks), high))


def _reach(shape: FilmShape) -> Callable[[float], float]:
    if math.isinf(shape.sphere_radius):
        return lambda gap: shape.radius(gap) ** 2
    # Without an end the film is as high as a number can be whose square is one, too.
    return lambda gap: min(shape.height(gap) - gap, 1e150)
