"""A scene made ready to run: what will be simulated can be read before it is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from types import MappingProxyType

from attrs import evolve, field, frozen

from ..accuracy import Accuracy
from ..errors import InfeasibleError, PlanError
from ..scene.effect import check_listed, choices
from ..scene.loading import ImposedForce, ImposedTime
from ..scene.scenes import SeparationScene
from .bodies import check_bodies
from .effects.as_published import mixed
from .effects.base import FilmEnd, FilmLimit, ForceLaw, Limiter, SeparationForce
from .effects.film_shape import film_shape
from .effects.registry import SEPARATION_EFFECTS, SeparationEffect
from .effects.viscous import ViscousForce
from .film import Film

__all__ = ["Film", "Plan", "plan"]


@frozen(eq=False)
class Plan:
    """A checked scene with each effect prepared once.

    ``print(plan)`` says what will be simulated and what will not; `cite` gives the sources.
    """

    scene: SeparationScene
    accuracy: Accuracy
    film: Film = field(repr=False)
    _films: dict[float, Film] = field(factory=dict, repr=False)
    _left: dict[tuple[float, bool, bool], Film | None] = field(factory=dict, repr=False)

    def film_with(self, volume_fraction: float) -> Film:
        """Return the film with a fraction of the volume the scene gives."""
        if volume_fraction == 1.0 or self.scene.meniscus.volume is None:
            return self.film
        if volume_fraction not in self._films:
            meniscus = self.scene.meniscus
            assert meniscus.volume is not None
            less = evolve(meniscus, volume=volume_fraction * meniscus.volume)
            interface = evolve(self.scene.interface, meniscus=less)
            self._films[volume_fraction] = _prepare(
                evolve(self.scene, interface=interface), self.accuracy
            )
        return self._films[volume_fraction]

    def film_left(self, volume_fraction: float, *, broken: bool, detached: bool) -> Film | None:
        """Return what acts in a state: all, or what a broken film and parted solids leave."""
        if not broken and not detached:
            return self.film_with(volume_fraction)
        key = volume_fraction, broken, detached
        if key not in self._left:
            self._left[key] = self.film_with(volume_fraction).left(broken=broken, detached=detached)
        return self._left[key]

    def has(self, kind: type[SeparationEffect]) -> bool:
        """Whether the scene calls for an effect."""
        return any(type(effect) is kind for effect in self.scene.effects)

    def cite(self) -> str:
        """Sources of the equations of this run, one to a line."""
        lines = [
            f"{effect.name}: {source}"
            for effect in self.scene.effects
            for source in effect.cites(self.scene)
        ]
        return "\n".join(lines)

    def __str__(self) -> str:
        title = f"{self.scene.name or 'separation'}: {self.scene.loading.summary}"
        on = [f"  on   {e.name:19s} {choices(e)}" for e in self.scene.effects]
        off = [
            f"  off  {kind.name:19s} {kind.summary}"
            for kind in SEPARATION_EFFECTS
            if not self.has(kind)
        ]
        return "\n".join([title, *on, *off])


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
    accuracy = accuracy or Accuracy.standard
    check_bodies(scene)
    _check_effects(scene)
    if mixture := mixed(scene):
        raise PlanError(mixture)
    _check_gap(scene)
    return Plan(scene, accuracy, _prepare(scene, accuracy))


def _check_effects(scene: SeparationScene) -> None:
    kinds = check_listed(scene.effects, SeparationEffect, "separation", _known())
    if not any(isinstance(e, SeparationForce) for e in scene.effects):
        raise PlanError(
            f"a separation scene needs at least one force among its effects; known: {_known()}"
        )
    ends = [k.__name__ for k in kinds if issubclass(k, FilmEnd)]
    if len(ends) > 1:
        raise PlanError(f"{' and '.join(ends)} both say where the film breaks; keep one of them")
    problems = [
        f"{type(effect).__name__} needs {item}"
        for effect in scene.effects
        for item in effect.lacks(scene)
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
    """What a film that lets go, and an imposed force or time, want besides."""
    problems: list[str] = []
    loading = scene.loading
    massless = isinstance(loading, ImposedForce) and loading.mass is None
    if massless:
        problems += [
            f"{type(e).__name__} needs loading.mass [kg]: where the film lets go, nothing else "
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


def _known() -> str:
    return ", ".join(kind.__name__ for kind in SEPARATION_EFFECTS)


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


def _prepare(scene: SeparationScene, accuracy: Accuracy) -> Film:
    laws: dict[type[SeparationForce], ForceLaw] = {}
    limits: list[tuple[type[SeparationEffect], Limiter]] = []
    end = math.inf
    for effect in scene.effects:
        if isinstance(effect, SeparationForce):
            laws[type(effect)] = effect.prepare(scene, accuracy)
        elif isinstance(effect, FilmLimit):
            limits.append((type(effect), effect.prepare(scene, accuracy)))
        elif isinstance(effect, FilmEnd):
            end = effect.prepare(scene, accuracy)
    end = min([end, *(law.end for law in laws.values())])
    if end <= scene.loading.initial_gap:
        raise _too_wide(scene, end)
    return Film(MappingProxyType(laws), tuple(limits), end, film_shape(scene).full_gap)
