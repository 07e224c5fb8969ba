"""Plan of a separation: the checked scene, its liquid, and each effect prepared once."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from attrs import evolve, field, frozen

from ..accuracy import Accuracy
from ..errors import DescriptionError, InfeasibleError, PlanError
from ..kinds import SEPARATION_EFFECTS
from ..liquids.liquid import LiquidState
from ..registry import Registry
from ..scene.column import Column
from ..scene.effect import check_listed
from ..scene.loading import ImposedForce, ImposedTime, PressAndPull
from ..scene.plan import ScenePlan
from ..scene.scenes import SeparationScene
from ..units import nm, quantity_text
from ..validity import ValidityNumber
from .bodies import check_bodies, check_rim
from .cavity.law import Cavitation
from .columns import COLUMNS
from .effects.as_published import mixed
from .effects.base import (
    FilmEnd,
    FilmLimit,
    ForceLaw,
    Limiter,
    LimitKind,
    MovingAngle,
    MovingEnd,
    SeparationEffect,
    SeparationForce,
    VolumeLoss,
    VolumeRate,
    effects_of,
)
from .effects.force_law import measured_rate, settled
from .effects.prepared import PreparedScene, prepare_scene, with_fraction
from .effects.viscous import ViscousForce
from .film import Film
from .first_closing import closing_note

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

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

    known_effects: ClassVar[Registry[Any]] = SEPARATION_EFFECTS

    prepared: PreparedScene[SeparationScene] = field(repr=False)
    film: Film
    columns: Mapping[str, Column] = field(repr=False)
    """Columns a result of this plan may have, by their names."""
    _films: Mapping[float, Film] = field(repr=False)
    _left: Mapping[FilmState, Film | None] = field(repr=False)
    volume_rate: VolumeRate | None = field(default=None, repr=False)
    """Rate of the volume in a motion; None for a film that keeps it, or of which it is known."""
    _film_of: Callable[[float], Film] | None = field(default=None, repr=False)

    @property
    def scene(self) -> SeparationScene:
        """Scene that is simulated."""
        return self.prepared.scene

    @property
    def accuracy(self) -> Accuracy:
        """Numerical accuracy of the solution."""
        return self.prepared.accuracy

    @property
    def methods(self) -> tuple[str, ...]:
        """See `ScenePlan.methods`: of a motion; others integrate closed forms or splines."""
        if not isinstance(self.scene.loading, ImposedForce):
            return ()
        return ("Radau IIA with error control; Hairer and Wanner 1996",)

    @property
    def moving_effects(self) -> tuple[str, ...]:
        """Effects by which volume or end of the film depend on the motion, by their names."""
        return tuple(
            type(effect).__name__
            for effect in effects_of(self.scene)
            if isinstance(effect, MovingAngle | VolumeLoss)
            or (isinstance(effect, FilmEnd) and effect.prepare_moving(self.prepared) is not None)
        )

    def film_with(self, volume_fraction: float) -> Film:
        """Return the film of the volume of the scene, or of what is left or re-wets of it."""
        if self._film_of is not None:
            return self._film_of(volume_fraction)
        return self._films[volume_fraction]

    def remaining_film(
        self, volume_fraction: float, *, broken: bool, detached: bool
    ) -> Film | None:
        """Return what acts in a state: all, or what a broken film and detached solids leave."""
        if self._film_of is not None:
            film = self._film_of(volume_fraction)
            return film.remaining(broken=broken, detached=detached) if broken or detached else film
        return self._left[FilmState(volume_fraction, broken, detached)]

    def acting_film(self, gap: float, speed: float = 0.0) -> Film | None:
        """Return what acts at a gap [m] during a monotonic opening: None if nothing does.

        The speed [m/s] decides where the end of the film depends on it.
        """
        film = self.film
        broken = gap > film.end or (bool(film.moving_ends) and gap > film.end_at(gap, speed))
        return self.remaining_film(1.0, broken=broken, detached=gap > film.release)

    def force(self, gap: ArrayLike, speed: ArrayLike = 0.0) -> Any:
        """Sum of the listed forces [N] at a gap and an opening speed; positive resists opening.

        The film has the liquid of the scene, and the limits of the liquid that have no memory.
        Beyond the gap at which it breaks only the forces of the solids are left.

        Parameters
        ----------
        gap : float or array_like
            Distance of the bodies [m]; 0 only where a sphere touches and no viscous force acts.
        speed : float or array_like
            Opening speed [m/s]; negative while the bodies approach.

        Returns
        -------
        float or ndarray
            Force [N], of the broadcast shape.

        Raises
        ------
        DescriptionError
            If a gap is negative, or zero where the force is infinite, or a number is not finite.
        PlanError
            If the force depends on the motion before: a film that cavitates and remembers it.

        Examples
        --------
        >>> import contactkit as ck
        >>> oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
        >>> face = ck.Flat(radius=1e-3)
        >>> film = ck.Meniscus(liquid=oil, volume=1e-11)
        >>> scene = ck.SeparationScene(
        ...     interface=ck.Interface(lower=face, upper=face, meniscus=film),
        ...     loading=ck.ImposedSpeed(speed=1e-3, initial_gap=4e-6, final_gap=1e-5),
        ...     effects=(ck.MeniscusForce(), ck.ViscousForce()),
        ... )
        >>> ck.plan(scene).force([4e-6, 8e-6], 1e-3).round(4).tolist()
        [4.7003, 0.1551]
        """
        import numpy as np

        if self.film.volume_fraction is not None or self.volume_rate is not None:
            raise PlanError(
                "plan.force(gap, speed) is not known for a film that loses liquid: its volume "
                "depends on the motion before; take ck.simulate(plan), or leave out what takes it"
            )
        if self.film.cavity is not None:
            raise PlanError(
                "plan.force(gap, speed) is not known for a film that cavitates: it depends on the "
                "motion before; take ck.simulate(plan), or "
                'TensionLimit(strength=..., cavity="truncated")'
            )
        try:
            gaps, speeds = np.broadcast_arrays(
                np.asarray(gap, dtype=np.float64), np.asarray(speed, dtype=np.float64)
            )
        except (TypeError, ValueError):
            raise DescriptionError(
                "Plan.force(gap, speed)", (gap, speed), "be numbers or arrays that broadcast"
            ) from None
        touches = not any(kind.touching for kind in self.film.laws)
        least = 0.0 if touches and not self.scene.interface.is_flat else None
        for value in gaps.ravel().tolist():
            if not (math.isfinite(value) and (value > 0.0 or value == least)):
                expected = "be positive and finite" if least is None else "be zero or positive"
                raise DescriptionError("Plan.force(gap)", value, expected, unit="m")
        if not np.isfinite(speeds).all():
            raise DescriptionError("Plan.force(speed)", speed, "be finite", unit="m/s")
        found = [self._force(*point) for point in zip(gaps.flat, speeds.flat, strict=True)]
        return found[0] if gaps.ndim == 0 else np.reshape(found, gaps.shape)

    def _force(self, gap: float, speed: float) -> float:
        film, gap, speed = self.acting_film(float(gap), float(speed)), float(gap), float(speed)
        if film is None:
            return 0.0
        film.check(gap, speed)
        return film.force(gap, speed)

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
            *(
                one
                for effect in effects_of(self.scene)
                for one in effect.validity(self, path)
                if one.name not in self._superseded
            ),
        )

    @property
    def _superseded(self) -> set[str]:
        return {name for effect in effects_of(self.scene) for name in effect.supersedes}

    @property
    def title(self) -> str:
        """See `ScenePlan.title`."""
        return f"{self.scene.name or 'separation'}: {self.scene.loading.summary}"

    @property
    def notes(self) -> tuple[str, ...]:
        """See `ScenePlan.notes`."""
        loading, end = self.scene.loading, self.film.end
        found = []
        if self.film.moving_ends or (self.volume_rate is not None and end < math.inf):
            longest = quantity_text(end, "m")
            found.append(f"the film breaks at {longest} at most: the gap depends on the motion")
        elif end < loading.final_gap:
            found.append(f"the film breaks at {quantity_text(end, 'm')}, before the final gap")
        if isinstance(loading, ImposedForce) and loading.mass is None:
            found.append("no mass: speeds are those at which the film balances the pull")
        if isinstance(loading, ImposedForce):
            found.append(closing_note(loading, self.film))
        if not self.scene.interface.has_discs and len(self.forces) > 1:
            found.append(
                f"the face is no even disc: all but the viscous force take it for one of the same "
                f"area, of radius {quantity_text(self.scene.interface.rim_radius, 'm')}"
            )
        if self.prepared.rheology is not None:
            found += self.prepared.rheology.notes
        own = (note for effect in effects_of(self.scene) for note in effect.notes(self.scene))
        return tuple(filter(None, (*found, *own)))

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
    kinds = check_listed(scene.effects, SeparationEffect, "separation", SEPARATION_EFFECTS)
    if isinstance(scene.loading, PressAndPull):
        raise PlanError(
            "loading = PressAndPull(...) needs ElasticBodies() among the effects: rigid bodies "
            "that are pressed stop at nothing but a rest_gap, see ImposedForce"
        )
    check_bodies(scene)
    liquid = scene.meniscus.liquid.at(scene.temperature)
    _check_effects(scene, kinds, liquid)
    if mixture := mixed(scene):
        raise PlanError(mixture)
    _check_gap(scene)
    prepared = _with_rheology(prepare_scene(scene, accuracy, liquid))
    film = _as_it_moves(prepared, _film(prepared))
    loading = scene.loading
    if isinstance(loading, ImposedForce) and loading.mass is None and not film.sets_speed:
        raise PlanError(
            "an imposed force needs loading.mass [kg], or ViscousForce(), to set a speed"
        )
    reach = film.end_at(loading.initial_gap, getattr(loading, "initial_speed", 0.0))
    if reach <= loading.initial_gap:
        raise _too_wide(prepared, reach)
    check_rim(prepared)
    columns = _columns(scene)
    loss = scene.effect(VolumeLoss)
    if loss is not None and isinstance(loading, ImposedForce):
        nothing: Mapping[Any, Any] = MappingProxyType({})
        rate, film_of = loss.volume_rate(prepared), _of_volume(prepared, film, loss)
        return Plan(prepared, film, columns, nothing, nothing, rate, film_of)
    films = {1.0: film} | _rewetted(prepared, film)
    states = MappingProxyType(_states(films))
    return Plan(prepared, film, columns, MappingProxyType(films), states)


def _with_rheology(prepared: PreparedScene[SeparationScene]) -> PreparedScene[SeparationScene]:
    """Add the rheology of the film, where the liquid is not Newtonian or slips."""
    meniscus = prepared.scene.meniscus
    if meniscus.liquid.is_newtonian and not meniscus.slips:
        return prepared
    from .rheology.choice import film_rheology

    return evolve(prepared, rheology=film_rheology(prepared))


def _columns(scene: SeparationScene) -> Mapping[str, Column]:
    own = {column.name: column for effect in effects_of(scene) for column in effect.curves()}
    return MappingProxyType({**COLUMNS, **own})


_ALONE: Mapping[type[SeparationEffect], str] = {
    FilmEnd: "where the film breaks",
    MovingAngle: "how the contact angle moves",
    VolumeLoss: "what the film loses",
}


def _check_effects(scene: SeparationScene, kinds: Sequence[type], liquid: LiquidState) -> None:
    if not any(isinstance(e, SeparationForce) for e in scene.effects):
        raise PlanError(
            "a separation scene needs at least one force among its effects; known: "
            f"{SEPARATION_EFFECTS.names}"
        )
    for role, says in _ALONE.items():
        rivals = [k.__name__ for k in kinds if issubclass(k, role)]
        if len(rivals) > 1:
            raise PlanError(f"{' and '.join(rivals)} both say {says}; keep one of them")
    problems = [
        f"{type(effect).__name__} needs {item}"
        for effect in effects_of(scene)
        for item in (*liquid.missing(*effect.liquid_needs(scene)), *effect.lacks(scene))
    ]
    if scene.meniscus.has_pressure:
        problems += [
            f"{type(e).__name__} needs interface.meniscus.volume [m3] in place of its pressure: it "
            "has no law at a fixed pressure"
            for e in effects_of(scene)
            if not e.takes_pressure
        ]
    problems += _lacks_of_limits(scene, kinds)
    problems += _unread_rheology(scene)
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
    bounded = [k for k in kinds if issubclass(k, SeparationForce) and k.newtonian is not None]
    limits = [type(e).__name__ for e in scene.effects if isinstance(e, FilmLimit)]
    if not bounded:
        problems += [
            f"{name} needs ViscousForce() beside it: it bounds the viscous force" for name in limits
        ]
    if len(bounded) > 1 and limits:
        both = " and ".join(kind.__name__ for kind in bounded)
        problems.append(f"{limits[0]} bounds one force of the film; keep one of {both}")
    if isinstance(loading, ImposedTime):
        problems += [
            f"{type(e).__name__} needs a speed or a force imposed: with only the time given, the "
            "path on which the limit acts is not known"
            for e in scene.effects
            if isinstance(e, FilmLimit)
        ]
    return problems


def _unread_rheology(scene: SeparationScene) -> list[str]:
    """Slip and shear of the liquid that effects of a scene would leave out."""
    viscous, meniscus, problems = scene.effect(ViscousForce), scene.meniscus, list[str]()
    if meniscus.slips and viscous is None:
        problems.append(
            "interface.meniscus.slip_length_lower and slip_length_upper [m] are read by "
            "ViscousForce() alone: list it, or leave them out"
        )
    if meniscus.liquid.shear_viscosity is None:
        return problems
    if viscous is not None and viscous.rheology == "newtonian":
        return problems
    cure = 'list ViscousForce(rheology="newtonian")' if viscous is not None else "leave it out"
    return problems + [
        f"{type(effect).__name__} takes the viscosity at rest, and the liquid has a "
        f"shear_viscosity; {cure}"
        for effect in effects_of(scene)
        if effect is not viscous and "viscosity" in effect.liquid_needs(scene)
    ]


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
    for effect in scene.effects:
        if isinstance(effect, SeparationForce) and effect.touching:
            raise InfeasibleError(f"loading.initial_gap is 0 m: {effect.touching}")


def _too_wide(prepared: PreparedScene[SeparationScene], end: float) -> InfeasibleError:
    """Error that names the largest gap, and the largest number of menisci where that is known."""
    scene = prepared.scene
    gap, meniscus = scene.loading.initial_gap, scene.meniscus
    reach, cure = "volume", "give more volume or a smaller initial_gap"
    if prepared.liquid_pressure is not None:
        reach = f"pressure of {prepared.liquid_pressure:g} Pa"
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
    cavity: Cavitation | None = None
    end, outlasts = math.inf, False
    moving: list[MovingEnd] = []
    for effect in prepared.scene.effects:
        if isinstance(effect, SeparationForce):
            laws[type(effect)] = _law(prepared, effect)
        elif isinstance(effect, FilmLimit):
            law = effect.cavity_law(prepared)
            if law is None:
                limits.append((effect.limit, effect.prepare(prepared)))
            else:
                cavity = law
        elif isinstance(effect, FilmEnd):
            end, outlasts = effect.prepare(prepared), effect.outlasts
            moving += filter(None, (effect.prepare_moving(prepared),))
    if not outlasts:
        end = min([end, *(law.end for law in laws.values())])
    ends = [one.end_at for one in moving]
    if not outlasts:
        ends += [law.end_at for law in laws.values() if law.end_at is not None]
    checks = [one.check for one in moving]
    checks += [law.check for law in laws.values() if law.check is not None]
    return Film(
        MappingProxyType(laws),
        tuple(limits),
        end,
        prepared.film.full_gap,
        cavity,
        moving_ends=tuple(ends),
        checks=tuple(checks),
    )


def _as_it_moves(prepared: PreparedScene[SeparationScene], film: Film) -> Film:
    """Film along the imposed motion: with the volume it has left, where an effect takes some."""
    effect = prepared.scene.effect(VolumeLoss)
    if effect is None or isinstance(prepared.scene.loading, ImposedForce):
        return film
    from .wetting.losing_film import losing_film, volume_nodes

    fraction = effect.volume_fraction(prepared)
    last = min(prepared.scene.loading.final_gap, film.end)
    nodes = volume_nodes(fraction(last))
    films = [_film(with_fraction(prepared, node)) for node in nodes]
    return losing_film(film, films, fraction, last)


def _of_volume(
    prepared: PreparedScene[SeparationScene], film: Film, loss: VolumeLoss
) -> Callable[[float], Film]:
    """Film of any part of the volume that a motion may leave of it.

    Raises
    ------
    PlanError
        If less re-wets than an effect that takes liquid knows.
    """
    from .wetting.losing_film import films_of_volume, volume_nodes

    rewets = prepared.scene.meniscus.rewetting
    if 0.0 < rewets < loss.least:
        raise PlanError(
            f"{type(loss).__name__} is known down to {loss.least:.0%} of the liquid, and "
            f"interface.meniscus.rewetting is {rewets:g}: give 0, or {loss.least:g} or more"
        )
    films = [_film(with_fraction(prepared, node)) for node in volume_nodes(loss.least)]
    return films_of_volume(film, films, loss.least)


_RATES = {"none": "it depends on the speed", "proportional": "it is not proportional to the speed"}
_PROBES = 9  # gaps at which a law is asked how it depends on the speed


def _law(prepared: PreparedScene[SeparationScene], effect: SeparationForce) -> ForceLaw:
    """Law of a force, which depends on the speed as it says, and as the loading can follow.

    Raises
    ------
    PlanError
        If it says that it depends on the speed in another way than it does, or no path in time is
        known to which it belongs.
    """
    law, loading, name = effect.prepare(prepared), prepared.scene.loading, type(effect).__name__
    low = loading.initial_gap or 1e-3 * loading.final_gap
    high = max(min(loading.final_gap, law.end), low)
    gaps = [low * (high / low) ** (i / _PROBES) for i in range(_PROBES)]
    if law.rate != "any":
        if measured_rate(law, gaps[:1]) not in (law.rate, "none"):
            raise PlanError(
                f'{name}: its ForceLaw says rate="{law.rate}", but '
                f"{_RATES[law.rate]}; leave rate out"
            )
        return law
    if isinstance(loading, ImposedTime):
        law = settled(law, gaps)
        if law.rate == "any":
            raise PlanError(
                f"{name} needs a speed or a force imposed: it depends on the speed, and with only "
                "the time given no speed is known"
            )
    elif isinstance(loading, ImposedForce) and loading.mass is None:
        law = settled(law, gaps)
    return law


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
