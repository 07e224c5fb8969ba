"""Sum of the prepared forces of film and solids, with the limits of the liquid."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType

from attrs import field, frozen

from ..scene.column import Column
from .cavity.law import Cavitation
from .effects.base import ForceLaw, Limiter, LimitKind, SeparationForce
from .effects.viscous import ViscousForce, ViscousLaw
from .integrator.radau import Forces

__all__ = ["Film"]

_DIFFERENCE = 1e-7  # relative, of gap and speed, for the slopes of forces


@frozen(eq=False)
class Film:
    """The forces of a film of one volume, ready to be evaluated at any gap and speed.

    Forces of the solids are among the `laws` too: they stay when the film breaks, which it does
    at `end`. A solid contact pulls off at `release`, and is there again once the gap has closed to
    `recontact` (all in metres; inf and 0 where there is none).
    """

    laws: Mapping[type[SeparationForce], ForceLaw]
    limits: tuple[tuple[LimitKind, Limiter], ...]
    end: float
    full_gap: float
    cavity: Cavitation | None = None
    """How the film tears, where that is remembered; None if its limits need no memory."""
    kinks: tuple[float, ...] = field(init=False)
    release: float = field(init=False)
    recontact: float = field(init=False)
    # The same laws, split once: these are called some ten times per internal step.
    _viscous: ViscousLaw | None = field(init=False, repr=False)
    _static: tuple[Callable[[float, float], float], ...] = field(init=False, repr=False)
    static_columns: tuple[Column, ...] = field(init=False, repr=False)
    static_impulses: tuple[str, ...] = field(init=False, repr=False)

    @kinks.default
    def _find_kinks(self) -> tuple[float, ...]:
        found = {kink for law in self.laws.values() for kink in law.kinks}
        return tuple(sorted(kink for kink in found if 0.0 < kink < self.end))

    @release.default
    def _find_release(self) -> float:
        return min((law.release for law in self.laws.values()), default=math.inf)

    @recontact.default
    def _find_recontact(self) -> float:
        return max((law.recontact for law in self.laws.values()), default=0.0)

    @_viscous.default
    def _find_viscous(self) -> ViscousLaw | None:
        law = self.laws.get(ViscousForce)
        return law if isinstance(law, ViscousLaw) else None

    @_static.default
    def _find_static(self) -> tuple[Callable[[float, float], float], ...]:
        return tuple(law.force for kind, law in self.laws.items() if kind is not ViscousForce)

    @static_columns.default
    def _find_columns(self) -> tuple[Column, ...]:
        return tuple(kind.column for kind in self.laws if kind is not ViscousForce)

    @static_impulses.default
    def _find_impulses(self) -> tuple[str, ...]:
        return tuple(column.impulse.name for column in self.static_columns)

    @property
    def has_viscous(self) -> bool:
        """Whether a viscous force is among the laws."""
        return self._viscous is not None

    def remaining(self, *, broken: bool, detached: bool) -> Film | None:
        """Film without the forces that rupture or pull-off ends; None if no force remains."""
        laws = {
            kind: law
            for kind, law in self.laws.items()
            if not (broken and kind.needs_film) and not (detached and math.isfinite(law.release))
        }
        if not laws:
            return None
        if broken:
            return Film(MappingProxyType(laws), (), math.inf, self.full_gap)
        return Film(MappingProxyType(laws), self.limits, self.end, self.full_gap, self.cavity)

    @property
    def is_limited(self) -> bool:
        """Whether a limit of the liquid is among what acts."""
        return bool(self.limits) or self.cavity is not None

    def static_force(self, gap: float) -> float:
        """Sum of the forces [N] that do not depend on speed, at a gap [m]."""
        total = 0.0
        for force in self._static:
            total += force(gap, 0.0)
        return total

    def static_forces(self, gap: float) -> dict[str, float]:
        """Each force [N] that does not depend on speed at a gap [m], by the name of its column."""
        return {
            column.name: force(gap, 0.0)
            for column, force in zip(self.static_columns, self._static, strict=True)
        }

    def impulses(self) -> dict[str, float]:
        """Impulse [N.s] of each force before anything has moved, by its name."""
        return {kind.column.impulse.name: 0.0 for kind in self.laws}

    def viscous_force(self, gap: float, speed: float) -> tuple[float, LimitKind]:
        """Viscous force [N] that is left after the limits, and the limit that acts."""
        if self._viscous is None:
            return 0.0, LimitKind.NONE
        newtonian = self._viscous.force(gap, speed)
        found, acting = newtonian, LimitKind.NONE
        for kind, limiter in self.limits:
            left = limiter(gap, speed, newtonian)
            if abs(left) < abs(found):
                found, acting = left, kind
        return found, acting

    def forces(self, gap: float, speed: float) -> Forces:
        """Static and viscous force [N] with their slopes, by differences, and the limit that acts.

        A limit leaves a viscous force at rest alone, so that differences of the speed may be
        relative: they never straddle the speed at which the limit sets in.
        """
        near = gap * (1.0 + _DIFFERENCE)
        static, static_by_gap = self.static_slope(gap)
        damping = damping_near = 0.0
        if self._viscous is not None:
            damping, damping_near = self._viscous.force(gap, 1.0), self._viscous.force(near, 1.0)
        viscous, limit = (
            self.viscous_force(gap, speed) if self.limits else (damping * speed, LimitKind.NONE)
        )
        if limit is LimitKind.NONE:
            by_gap = speed * (damping_near - damping) / (near - gap)
            return Forces(static, static_by_gap, viscous, by_gap, damping)
        by_gap = (self.viscous_force(near, speed)[0] - viscous) / (near - gap)
        faster = speed * (1.0 + _DIFFERENCE)
        by_speed = (self.viscous_force(gap, faster)[0] - viscous) / (faster - speed)
        return Forces(static, static_by_gap, viscous, by_gap, by_speed, limit)

    def static_slope(self, gap: float) -> tuple[float, float]:
        """Sum of the forces [N] that do not depend on speed, and its slope over the gap [N/m]."""
        near = gap * (1.0 + _DIFFERENCE)
        static = static_near = 0.0
        for force in self._static:
            static += force(gap, 0.0)
            static_near += force(near, 0.0)
        return static, (static_near - static) / (near - gap)

    @staticmethod
    def acting_limit(forces: Forces) -> LimitKind:
        """Limit of the liquid that acts in forces of this film."""
        return LimitKind.NONE if forces.limit is None else LimitKind(forces.limit)

    def force(self, gap: float, speed: float) -> float:
        """Sum of all forces [N]; positive resists opening."""
        total = self.viscous_force(gap, speed)[0]
        for force in self._static:
            total += force(gap, speed)
        return total

    def damping(self, gap: float) -> float:
        """Damping coefficient of the film without limits, viscous force per speed [N.s/m]."""
        return self._viscous.force(gap, 1.0) if self._viscous is not None else 0.0

    def exponent(self, gap: float) -> float:
        """Exponent n of the viscous force, which falls as gap^-n; 0 without one."""
        return self._viscous.exponent(gap) if self._viscous is not None else 0.0

    def newtonian_impulse(self, start: float, end: float) -> float:
        """Impulse [N.s] of the viscous force without limits between two gaps [m]; 0 without one."""
        return self._viscous.impulse(start, end) if self._viscous is not None else 0.0

    def newtonian_force(self, gap: float, speed: float) -> float:
        """Viscous force [N] without limits; 0 without one."""
        return self._viscous.force(gap, speed) if self._viscous is not None else 0.0
