"""Plan of a separation: the checked scene, its liquid, and each effect prepared once."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, ClassVar, NamedTuple

from attrs import field, frozen

from ..accuracy import Accuracy
from ..errors import InfeasibleError, PlanError
from ..liquids.liquid import LiquidState
from ..scene.column import Column
from ..scene.effect import EffectRegistry, check_listed
from ..scene.loading import ImposedForce, ImposedTime
from ..scene.plan import ScenePlan
from ..scene.scenes import SeparationScene
from ..scene.validity import ValidityNumber
from ..units import nm, quantity_text
from .bodies import check_bodies, check_rim
from .cavity.law import CavityLaw
from .columns import COLUMNS
from .effects.as_published import mixed
from .effects.base import FilmEnd, FilmLimit, ForceLaw, Limiter, LimitKind, SeparationForce
from .effects.prepared import PreparedScene, prepare_scene, with_fraction
from .effects.registry import SEPARATION_EFFECTS, SeparationEffect
from .effects.viscous import ViscousForce
from .film import Film

_CONTINUUM = 2.0 * nm  # gap below which a liquid is no continuum any more

__all__ = ["Film", "FilmState", "Plan", "plan"]


class FilmState(NamedTuple):
    """State of a film and of the contact of its solids.

    `volume_fraction` is the volume of the film over that of the scene; the film may be `broken`,
    and the solids `detached`.
    """

    volume_fraction: float
    broken: bool
    detached: bool


@frozen(eq=False)
class Plan(ScenePlan):
    """A checked scene with each effect prepared once.

    ``print(plan)`` says what will be simulated and what will not; `cite` gives the sources.
    """

    known_effects: ClassVar[EffectRegistry[SeparationEffect]] = SEPARATION_EFFECTS

    prepared: PreparedScene[SeparationScene] = field(repr=False)
    film: Film
    columns: Mapping[str, Column] = field(repr=False)
    """Columns a result of this plan may have, by their names."""
    _films: Mapping[float, Film] = field(repr=False)
    _left: Mapping[FilmState, Film | None] = field(repr=False)

    @property
    def scene(self) -> SeparationScene:
        """Scene that is simulated."""
        return self.prepared.scene

    @property
    def accuracy(self) -> Accuracy:
        """Numerical accuracy of the solution."""
        return self.prepared.accuracy

    def film_with(self, volume_fraction: float) -> Film:
        """Return the film of the volume of the scene, or of what re-wets of it."""
        return self._films[volume_fraction]

    def remaining_film(
        self, volume_fraction: float, *, broken: bool, detached: bool
    ) -> Film | None:
        """Return what acts in a state: all, or what a broken film and detached solids leave."""
        return self._left[FilmState(volume_fraction, broken, detached)]

    @property
    def forces(self) -> tuple[Column, ...]:
        """Columns of the listed forces."""
        return tuple(e.column for e in self.scene.effects if isinstance(e, SeparationForce))

    def validity(self, path: Sequence[tuple[float, float]]) -> tuple[ValidityNumber, ...]:
        """Whether the models are in their range along pairs of gap [m] and speed [m/s]."""
        return (
            ValidityNumber(
                name="thinnest gap over 2 nm",
                value=min(gap for gap, _ in path) / _CONTINUUM,
                low=1.0,
                detail="below about 2 nm a liquid is not a continuum",
                source="Chan and Horn 1985",
            ),
            *(number for effect in self.scene.effects for number in effect.validity(self, path)),
        )

    @property
    def title(self) -> str:
        """See `ScenePlan.title`."""
        return f"{self.scene.name or 'separation'}: {self.scene.loading.summary}"

    @property
    def notes(self) -> tuple[str, ...]:
        """See `ScenePlan.notes`."""
        loading, end = self.scene.loading, self.film.end
        found = []
        if end < loading.final_gap:
            found.append(f"the film breaks at {quantity_text(end, 'm')}, before the final gap")
        if isinstance(loading, ImposedForce) and loading.mass is None:
            found.append("no mass: speeds are those at which the film balances the pull")
        return (
            *found,
            *(note for effect in self.scene.effects for note in effect.notes(self.scene)),
        )

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the scene, of which the same plan is made again: laws are functions."""
        return plan, (self.scene, self.accuracy)


def plan(scene: SeparationScene, accuracy: Accuracy | None = None) -> Plan:
    """Check the effects against the scene and prepare each of them once.

    Parameters
    ----------
    scene : SeparationScene
        What is there and which physics it calls for.
    accuracy : Accuracy, optional
        How well to solve; `Accuracy.standard` if not given.

    Raises
    ------
    PlanError
        If an effect is listed twice, lacks something, or does not fit the others.
    InfeasibleError
        If the scene has no answer.
    """
    kinds = check_listed(scene.effects, SeparationEffect, "separation", SEPARATION_EFFECTS.names)
    check_bodies(scene)
    liquid = scene.meniscus.liquid.at(scene.temperature)
    _check_effects(scene, kinds, liquid)
    if mixture := mixed(scene):
        raise PlanError(mixture)
    _check_gap(scene)
    prepared = prepare_scene(scene, accuracy, liquid)
    film = _film(prepared)
    if film.end <= scene.loading.initial_gap:
        raise _too_wide(scene, film.end)
    check_rim(prepared)
    films = {1.0: film} | _rewetted(prepared, film)
    states = MappingProxyType(_states(films))
    return Plan(prepared, film, _columns(scene), MappingProxyType(films), states)


def _columns(scene: SeparationScene) -> Mapping[str, Column]:
    own = {column.name: column for effect in scene.effects for column in effect.curves()}
    return MappingProxyType({**COLUMNS, **own})


def _check_effects(scene: SeparationScene, kinds: Sequence[type], liquid: LiquidState) -> None:
    if not any(isinstance(e, SeparationForce) for e in scene.effects):
        raise PlanError(
            "a separation scene needs at least one force among its effects; known: "
            f"{SEPARATION_EFFECTS.names}"
        )
    ends = [k.__name__ for k in kinds if issubclass(k, FilmEnd)]
    if len(ends) > 1:
        raise PlanError(f"{' and '.join(ends)} both say where the film breaks; keep one of them")
    problems = [
        f"{type(effect).__name__} needs {item}"
        for effect in scene.effects
        for item in (*liquid.missing(*effect.liquid_needs(scene)), *effect.lacks(scene))
    ]
    if scene.liquid_pressure is not None:
        problems += [
            f"{type(e).__name__} needs interface.meniscus.volume [m3] in place of its pressure: it "
            "has no law at a fixed pressure"
            for e in scene.effects
            if not e.takes_pressure
        ]
    problems += _lacks_of_limits(scene, kinds)
    if problems:
        raise PlanError("; ".join(problems))


def _lacks_of_limits(scene: SeparationScene, kinds: Sequence[type]) -> list[str]:
    """Needs of a film that ends, and of an imposed force or time."""
    problems: list[str] = []
    loading = scene.loading
    massless = isinstance(loading, ImposedForce) and loading.mass is None
    if massless:
        problems += [
            f"{type(e).__name__} needs loading.mass [kg]: once the film has ended, nothing else "
            f"sets the speed"
            for e in scene.effects
            if isinstance(e, FilmLimit | FilmEnd)
        ]
    if ViscousForce not in kinds:
        problems += [
            f"{type(e).__name__} needs ViscousForce() beside it: it bounds the viscous force"
            for e in scene.effects
            if isinstance(e, FilmLimit)
        ]
        if massless:
            problems.append(
                "an imposed force needs loading.mass [kg], or ViscousForce(), to set a speed"
            )
    if isinstance(loading, ImposedTime):
        problems += [
            f"{type(e).__name__} needs a speed or a force imposed: with only the time given, the "
            "path on which the limit acts is not known"
            for e in scene.effects
            if isinstance(e, FilmLimit)
        ]
    return problems


def _check_gap(scene: SeparationScene) -> None:
    if scene.loading.initial_gap > 0.0:
        return
    if isinstance(scene.loading, ImposedForce):
        raise InfeasibleError(
            "loading.initial_gap is 0 m: bodies that touch do not move as a film yields; give the "
            "gap that their roughness keeps open [m]"
        )
    if scene.interface.is_flat:
        raise InfeasibleError(
            "loading.initial_gap is 0 m between flats: touching flats are a contact problem; "
            "give the gap that their roughness keeps open [m]"
        )
    if any(isinstance(e, ViscousForce) for e in scene.effects):
        raise InfeasibleError(
            "loading.initial_gap is 0 m: the viscous impulse from a touching sphere is infinite, "
            "it grows as ln(1/gap); give a cut-off gap [m], such as the roughness or 0.2 to 0.3 nm"
        )


def _too_wide(scene: SeparationScene, end: float) -> InfeasibleError:
    """Error that names the largest gap, and the largest number of menisci where that is known."""
    gap, meniscus = scene.loading.initial_gap, scene.meniscus
    reach, cure = "volume", "give more volume or a smaller initial_gap"
    if scene.liquid_pressure is not None:
        reach = f"pressure of {scene.liquid_pressure:g} Pa"
        cure = "give one nearer to zero (a higher humidity) or a smaller initial_gap"
    elif meniscus.volume is None:
        reach, cure = "liquid", "give a smaller initial_gap"
    if scene.interface.is_flat and meniscus.volume is not None and meniscus.count > 1:
        # Each has its part of the volume, and its limit is as the cube root of that.
        most = math.ceil(meniscus.count * (end / gap) ** 3) - 1
        if most >= 1:
            cure += f", or divide the liquid into at most {most} menisci"
    return InfeasibleError(
        f"no meniscus spans the initial gap of {gap:g} m: this {reach} reaches {end:.6g} m at "
        f"most; {cure}"
    )


def _film(prepared: PreparedScene[SeparationScene]) -> Film:
    laws: dict[type[SeparationForce], ForceLaw] = {}
    limits: list[tuple[LimitKind, Limiter]] = []
    cavity: CavityLaw | None = None
    end = math.inf
    for effect in prepared.scene.effects:
        if isinstance(effect, SeparationForce):
            laws[type(effect)] = effect.prepare(prepared)
        elif isinstance(effect, FilmLimit):
            tears = effect.cavity_law(prepared)
            if tears is None:
                limits.append((effect.limit, effect.prepare(prepared)))
            else:
                cavity = tears
        elif isinstance(effect, FilmEnd):
            end = effect.prepare(prepared)
    end = min([end, *(law.end for law in laws.values())])
    return Film(MappingProxyType(laws), tuple(limits), end, prepared.film.full_gap, cavity)


def _rewetted(prepared: PreparedScene[SeparationScene], film: Film) -> dict[float, Film]:
    """Film of the fraction of the volume that re-wets, where that is not all of it."""
    scene = prepared.scene
    meniscus = scene.meniscus
    fraction, volume = meniscus.rewetting, meniscus.volume
    if not 0.0 < fraction < 1.0:
        return {}
    if volume is None:  # flooded, or in vapour: all of it is there again
        return {fraction: film}
    return {fraction: _film(with_fraction(prepared, fraction))}


def _states(films: Mapping[float, Film]) -> dict[FilmState, Film | None]:
    """What acts in each state that a motion may find."""
    return {
        FilmState(fraction, broken, detached): film.remaining(broken=broken, detached=detached)
        if broken or detached
        else film
        for fraction, film in films.items()
        for broken in (False, True)
        for detached in (False, True)
    }
