"""A scene made ready to run: what will be simulated can be read before it is."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType

from attrs import evolve, field, frozen

from .accuracy import Accuracy
from .effects import SEPARATION_EFFECTS, Effect, SeparationEffect
from .effects.base import FilmEnd, FilmLimit, ForceLaw, Limiter, SeparationForce
from .effects.film_shape import film_shape
from .effects.viscous import ViscousForce
from .errors import InfeasibleError, PlanError
from .scene import SeparationScene

__all__ = ["Film", "Plan", "check_listed", "choices", "plan"]


@frozen(eq=False)
class Film:
    """The forces of a film of one volume, ready to be evaluated at any gap and speed."""

    laws: Mapping[type[SeparationEffect], ForceLaw]
    limits: tuple[tuple[type[SeparationEffect], Limiter], ...]
    kinks: tuple[float, ...]
    end: float
    full_gap: float
    # The same laws, split once: these are called some ten times per internal step.
    _viscous: ForceLaw | None = field(init=False, repr=False)
    _static: tuple[Callable[[float, float], float], ...] = field(init=False, repr=False)

    @_viscous.default
    def _find_viscous(self) -> ForceLaw | None:
        return self.laws.get(ViscousForce)

    @_static.default
    def _find_static(self) -> tuple[Callable[[float, float], float], ...]:
        return tuple(law.force for kind, law in self.laws.items() if kind is not ViscousForce)

    def static_force(self, gap: float) -> float:
        """Sum of the forces [N] that do not depend on speed, at a gap [m]."""
        total = 0.0
        for force in self._static:
            total += force(gap, 0.0)
        return total

    def viscous_force(
        self, gap: float, speed: float
    ) -> tuple[float, type[SeparationEffect] | None]:
        """Viscous force [N] that is left after the limits, and the limit that acts."""
        if self._viscous is None:
            return 0.0, None
        newtonian = self._viscous.force(gap, speed)
        found, acting = newtonian, None
        for kind, limiter in self.limits:
            left = limiter(gap, speed, newtonian)
            if abs(left) < abs(found):
                found, acting = left, kind
        return found, acting

    def force(self, gap: float, speed: float) -> float:
        """Sum of all forces [N]; positive resists opening."""
        total = self.viscous_force(gap, speed)[0]
        for force in self._static:
            total += force(gap, speed)
        return total

    def resistance(self, gap: float) -> float:
        """Viscous force per speed [N.s/m] of the film without limits, at a gap [m]."""
        return self._viscous.force(gap, 1.0) if self._viscous is not None else 0.0

    def exponent(self, gap: float) -> float:
        """Exponent n of the viscous force, which falls as gap^-n; 0 without one."""
        return self._viscous.exponent(gap) if self._viscous is not None else 0.0


@frozen(eq=False)
class Plan:
    """A checked scene with each effect prepared once.

    ``print(plan)`` says what will be simulated and what will not; `cite` gives the sources.
    """

    scene: SeparationScene
    accuracy: Accuracy
    film: Film = field(repr=False)
    _films: dict[float, Film] = field(factory=dict, repr=False)

    def film_with(self, share: float) -> Film:
        """Return the film with a share of the volume the scene gives."""
        if share == 1.0 or self.scene.interface.meniscus.volume is None:
            return self.film
        if share not in self._films:
            meniscus = self.scene.interface.meniscus
            assert meniscus.volume is not None
            less = evolve(meniscus, volume=share * meniscus.volume)
            interface = evolve(self.scene.interface, meniscus=less)
            self._films[share] = _prepare(evolve(self.scene, interface=interface), self.accuracy)
        return self._films[share]

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
        opening = self.scene.opening
        title = (
            f"{self.scene.name or 'separation'}: {opening.imposed} imposed, "
            f"gap {opening.initial_gap:g} m to {opening.final_gap:g} m"
        )
        on = [f"  on   {e.name:15s} {choices(e)}" for e in self.scene.effects]
        off = [
            f"  off  {kind.name:15s} {kind.summary}"
            for kind in SEPARATION_EFFECTS
            if not self.has(kind)
        ]
        return "\n".join([title, *on, *off])


def choices(effect: Effect) -> str:
    """Say what an effect does and which choices it was given."""
    fields = ((a.name, getattr(effect, a.name)) for a in type(effect).__attrs_attrs__)
    chosen = ", ".join(f"{name}={value!r}" for name, value in fields if value is not None)
    return f"{effect.summary}" + (f" ({chosen})" if chosen else "")


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
    _check_effects(scene)
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
    if scene.opening.imposed == "force" and scene.opening.mass is None:
        problems += [
            f"{type(e).__name__} needs opening.mass [kg]: where the film lets go, nothing else "
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
        if scene.opening.imposed == "force" and scene.opening.mass is None:
            problems.append(
                "an imposed force needs opening.mass [kg], or ViscousForce(), to set a speed"
            )
    if problems:
        raise PlanError("; ".join(problems))


def check_listed(
    effects: Sequence[object], role: type, scene: str, known: str
) -> list[type[object]]:
    """Refuse what is no effect of a kind of scene, or is listed twice; return the kinds."""
    for effect in effects:
        if not isinstance(effect, role):
            raise PlanError(f"{effect!r} is not an effect of a {scene} scene; known: {known}")
    kinds = [type(effect) for effect in effects]
    if twice := sorted({k.__name__ for k in kinds if kinds.count(k) > 1}):
        raise PlanError(f"listed more than once: {', '.join(twice)}")
    return kinds


def _known() -> str:
    return ", ".join(kind.__name__ for kind in SEPARATION_EFFECTS)


def _check_gap(scene: SeparationScene) -> None:
    if scene.opening.initial_gap > 0.0:
        return
    if scene.opening.imposed == "force":
        raise InfeasibleError(
            "Opening.initial_gap is 0 m: bodies that touch do not move as a film yields; give the "
            "gap that their roughness keeps open [m]"
        )
    if scene.interface.is_flat:
        raise InfeasibleError(
            "Opening.initial_gap is 0 m between flats: touching flats are a contact problem; "
            "give the gap that their roughness keeps open [m]"
        )
    if any(isinstance(e, ViscousForce) for e in scene.effects):
        raise InfeasibleError(
            "Opening.initial_gap is 0 m: the viscous impulse from a touching sphere is infinite, "
            "it grows as ln(1/gap); give a cut-off gap [m], such as the roughness or 0.2 to 0.3 nm"
        )


def _prepare(scene: SeparationScene, accuracy: Accuracy) -> Film:
    laws: dict[type[SeparationEffect], ForceLaw] = {}
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
    if end <= scene.opening.initial_gap:
        raise InfeasibleError(
            f"no meniscus spans the initial gap of {scene.opening.initial_gap:g} m: this volume "
            f"reaches {end:g} m at most; give more volume or a smaller initial_gap"
        )
    kinks = {kink for law in laws.values() for kink in law.kinks if 0.0 < kink < end}
    full_gap = film_shape(scene).full_gap
    return Film(MappingProxyType(laws), tuple(limits), tuple(sorted(kinks)), end, full_gap)
