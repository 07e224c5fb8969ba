"""Sum of the prepared forces of film and solids, with the limits of the liquid."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import NamedTuple

from attrs import field, frozen

from ..scene.column import Column
from .cavity.law import Cavitation
from .effects.base import Limiter, LimitKind, SeparationForce
from .effects.force_law import ForceLaw, LawAt, law_impulse
from .integrator.radau import Forces

__all__ = ["Film", "ForcesAt", "balance_speed"]

_SLOW = 1e-15  # speed [m/s] at which every liquid film is as at rest
_MOST_SECANTS, _LONGEST, _FLATTEST = 60, 20.0, 0.02  # steps, in logarithms of force and speed
_DIFFERENCE = 1e-7  # relative, of gap and speed, for the slopes of a force that a limit bounds


class ForcesAt(NamedTuple):
    """Forces [N] at a gap and a speed, positive where they resist opening.

    `named` has each by the name of its column. Their sum is that of `static`, which they are at
    rest, and of `viscous`, which the speed adds. `newtonian` has those of a flowing liquid without
    its limits, by the names of their columns, and `limit` is the one that acts.
    """

    named: dict[str, float]
    static: float
    viscous: float
    newtonian: dict[str, float]
    limit: LimitKind


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
    """How the film cavitates, where that is remembered; None if its limits need no memory."""
    volume_fraction: Callable[[float], float] | None = field(default=None, kw_only=True)
    """Volume over that of the scene at a gap [m] of the imposed motion; None: it is kept."""
    moving_ends: tuple[Callable[[float, float], float], ...] = field(default=(), kw_only=True)
    """Gaps [m] at which the film breaks at a gap and a speed, where that depends on the motion;
    `end` is then what it lasts to at most."""
    checks: tuple[Callable[[float, float], None], ...] = field(default=(), kw_only=True)
    """What refuses a gap and a speed that a motion has reached, where a law is not known."""
    kinks: tuple[float, ...] = field(init=False)
    release: float = field(init=False)
    recontact: float = field(init=False)
    limited: type[SeparationForce] | None = field(init=False)
    """Force that limits of the liquid bound; None where there are no limits."""
    columns: tuple[Column, ...] = field(init=False, repr=False)
    """Columns of all forces, that of a flowing liquid last."""
    static_columns: tuple[Column, ...] = field(init=False, repr=False)
    """Columns of forces that act at rest, too."""
    moving_columns: tuple[Column, ...] = field(init=False, repr=False)
    """Columns of forces that may depend on the speed."""
    impulse_names: tuple[str, ...] = field(init=False, repr=False)
    """Name of the impulse of each law, in their order."""
    # The same laws, split once: these are called some ten times per internal step.
    _static: tuple[ForceLaw, ...] = field(init=False, repr=False)
    _proportional: tuple[ForceLaw, ...] = field(init=False, repr=False)
    _any: tuple[ForceLaw, ...] = field(init=False, repr=False)
    _bounded: ForceLaw | None = field(init=False, repr=False)
    _moving: tuple[ForceLaw, ...] = field(init=False, repr=False)

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

    @limited.default
    def _find_limited(self) -> type[SeparationForce] | None:
        liquid = (kind for kind in self.laws if kind.newtonian is not None)
        return next(liquid, None) if self.is_limited else None

    @columns.default
    def _find_columns(self) -> tuple[Column, ...]:
        # A sort keeps the order of the scene among the others.
        kinds = sorted(self.laws, key=lambda kind: kind.newtonian is not None)
        return tuple(kind.column for kind in kinds)

    @static_columns.default
    def _find_static_columns(self) -> tuple[Column, ...]:
        return tuple(k.column for k, law in self.laws.items() if law.rate != "proportional")

    @moving_columns.default
    def _find_moving_columns(self) -> tuple[Column, ...]:
        return tuple(k.column for k, law in self.laws.items() if law.rate != "none")

    @impulse_names.default
    def _find_impulse_names(self) -> tuple[str, ...]:
        return tuple(kind.column.impulse.name for kind in self.laws)

    @_static.default
    def _find_static(self) -> tuple[ForceLaw, ...]:
        return tuple(law for law in self.laws.values() if law.rate == "none")

    @_proportional.default
    def _find_proportional(self) -> tuple[ForceLaw, ...]:
        return self._unbounded("proportional")

    @_any.default
    def _find_any(self) -> tuple[ForceLaw, ...]:
        return self._unbounded("any")

    @_bounded.default
    def _find_bounded(self) -> ForceLaw | None:
        return self.laws[self.limited] if self.limited is not None else None

    @_moving.default
    def _find_moving(self) -> tuple[ForceLaw, ...]:
        bounded = () if self._bounded is None else (self._bounded,)
        return (*self._proportional, *bounded, *self._any)

    def _unbounded(self, rate: str) -> tuple[ForceLaw, ...]:
        pairs = self.laws.items()
        return tuple(law for k, law in pairs if law.rate == rate and k is not self.limited)

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
        return Film(
            MappingProxyType(laws),
            self.limits,
            self.end,
            self.full_gap,
            self.cavity,
            moving_ends=self.moving_ends,
            checks=self.checks,
        )

    def end_at(self, gap: float, speed: float) -> float:
        """Gap [m] at which the film breaks, at a gap and a speed that a motion has reached."""
        return min([self.end, *(end(gap, speed) for end in self.moving_ends)])

    def check(self, gap: float, speed: float) -> None:
        """Refuse a gap and a speed that a motion has reached, where a law is not known."""
        for check in self.checks:
            check(gap, speed)

    @property
    def is_limited(self) -> bool:
        """Whether a limit of the liquid is among what acts."""
        return bool(self.limits) or self.cavity is not None

    @property
    def is_smooth(self) -> bool:
        """Whether no slope can jump with the speed: no limits, and no law of any rate."""
        return not (self._any or self.is_limited)

    def impulses(self) -> dict[str, float]:
        """Impulse [N.s] of each force before anything has moved, by its name."""
        return dict.fromkeys(self.impulse_names, 0.0)

    def static_force(self, gap: float) -> float:
        """Sum of the forces [N] at rest, at a gap [m]."""
        total = 0.0
        for law in self._static:
            total += law.force(gap, 0.0)
        for law in self._any:
            total += law.force(gap, 0.0)
        return total

    def static_forces(self, gap: float) -> dict[str, float]:
        """Each force [N] that acts at rest at a gap [m], by the name of its column."""
        return {
            kind.column.name: law.force(gap, 0.0)
            for kind, law in self.laws.items()
            if law.rate != "proportional"
        }

    def viscous_force(self, gap: float, speed: float) -> tuple[float, LimitKind]:
        """Viscous part of the forces [N], after the limits, and the limit that acts."""
        total, limit = self.limited_force(gap, speed)
        for law in (*self._proportional, *self._any):
            total += law.viscous_force(gap, speed)
        return total, limit

    def limited_force(self, gap: float, speed: float) -> tuple[float, LimitKind]:
        """Force [N] that the limits of the liquid bound, and the limit that acts; 0 without any."""
        if self._bounded is None:
            return 0.0, LimitKind.NONE
        return self._left(gap, speed, self._bounded.force(gap, speed))

    def _left(self, gap: float, speed: float, newtonian: float) -> tuple[float, LimitKind]:
        """Force [N] that the limits leave of a Newtonian one, and the limit that acts."""
        found, acting = newtonian, LimitKind.NONE
        for kind, limiter in self.limits:
            left = limiter(gap, speed, newtonian)
            if abs(left) < abs(found):
                found, acting = left, kind
        return found, acting

    def at(self, gap: float, speed: float, held: float | None = None) -> ForcesAt:
        """Return each force at a gap and a speed, evaluated once.

        `held` is what a film that cavitates holds around its cavity [N], in place of what it would
        hold while it is full.
        """
        named: dict[str, float] = {}
        newtonian: dict[str, float] = {}
        static, viscous, limit = 0.0, 0.0, LimitKind.NONE
        for kind, law in self.laws.items():
            value = law.force(gap, speed if law.rate != "none" else 0.0)
            rest = 0.0
            if law.rate != "proportional":
                rest = law.force(gap, 0.0) if law.rate == "any" and speed else value
            if kind.newtonian is not None:
                newtonian[kind.newtonian.name] = value
                if law is self._bounded:
                    value, limit = (
                        self._left(gap, speed, value) if held is None else (held, LimitKind.TENSION)
                    )
            named[kind.column.name] = value
            static += rest
            viscous += value - rest
        ordered = {column.name: named[column.name] for column in self.columns}
        return ForcesAt(ordered, static, viscous, newtonian, limit)

    def forces(self, gap: float, speed: float) -> Forces:
        """Forces at rest and what the speed adds [N], with their slopes, and the limit that acts.

        A limit leaves a force at rest alone, so that differences of the speed may be relative: they
        never straddle the speed at which the limit sets in.
        """
        found = self.unbounded(gap, speed)
        limit = LimitKind.NONE if self._any else None
        bounded = self._bounded
        if bounded is None:
            return Forces(*found, limit)
        left, acting = self.limited_force(gap, speed)
        if acting is LimitKind.NONE:
            return Forces(*_sum(found, bounded.at(gap, speed)), limit)
        near, faster = gap * (1.0 + _DIFFERENCE), speed * (1.0 + _DIFFERENCE)
        nearer, more = self.limited_force(near, speed)[0], self.limited_force(gap, faster)[0]
        slopes = (nearer - left) / (near - gap), (more - left) / (faster - speed)
        return Forces(*_sum(found, LawAt(0.0, 0.0, left, *slopes)), acting)

    def split(self, gap: float, speed: float, forces: Forces) -> list[float]:
        """Each force [N] at a gap and a speed, in the order of the laws, from their sums.

        What the sums say by themselves is not evaluated again; and a force with a memory is what
        the others leave of the sum.
        """
        found = []
        for law in self.laws.values():
            if law.rate == "none":
                value = forces.static if len(self.static_columns) == 1 else law.force(gap, 0.0)
            elif law.rate == "proportional" and len(self.moving_columns) == 1:
                value = forces.viscous
            elif law is self._bounded:
                others = (*self._proportional, *self._any)
                value = forces.viscous - sum(one.viscous_force(gap, speed) for one in others)
            else:
                value = law.force(gap, speed)
            found.append(value)
        return found

    def unbounded(self, gap: float, speed: float) -> LawAt:
        """Sum of the forces with their slopes, that which limits of the liquid bound left out."""
        static = static_by_gap = viscous = by_gap = by_speed = 0.0
        for law in self._static:
            value, slope = law.static_slope(gap)
            static, static_by_gap = static + value, static_by_gap + slope
        for law in self._proportional:
            value, slope = law.damping_slope(gap)
            viscous, by_gap = viscous + value * speed, by_gap + slope * speed
            by_speed += value
        found = LawAt(static, static_by_gap, viscous, by_gap, by_speed)
        for law in self._any:
            found = _sum(found, law.at(gap, speed))
        return found

    @staticmethod
    def acting_limit(forces: Forces) -> LimitKind:
        """Limit of the liquid that acts in forces of this film."""
        return LimitKind.NONE if forces.limit is None else LimitKind(forces.limit)

    def force(self, gap: float, speed: float) -> float:
        """Sum of all forces [N]; positive resists opening."""
        return self.viscous_force(gap, speed)[0] + self.static_force(gap)

    def damping(self, gap: float, speed: float = 1.0) -> float:
        """Damping [N.s/m]: the viscous part of the forces without limits over a speed [m/s]."""
        total = 0.0
        for law in self._moving:
            total += law.damping(gap, speed)
        return total

    def exponent(self, gap: float, speed: float = 1.0) -> float:
        """Exponent n of the damping at a speed [m/s], which falls as gap^-n; 0 without one."""
        laws = self._moving
        if len(laws) == 1:
            return laws[0].exponent_at(gap, speed)
        shares = [max(law.damping(gap, speed), 0.0) for law in laws]
        total = sum(shares)
        if not total > 0.0:
            return 0.0
        each = (law.exponent_at(gap, speed) for law in laws)
        return sum(n * share for n, share in zip(each, shares, strict=True)) / total

    @property
    def has_viscous_impulse(self) -> bool:
        """Whether a force is proportional to speed, so that two gaps give its impulse."""
        return any(law.rate == "proportional" for law in self.laws.values())

    @property
    def sets_speed(self) -> bool:
        """Whether a force grows with the speed, so that a mass is not needed to find it."""
        pairs = self.laws.items()
        return any(law.rate == "proportional" or kind.newtonian for kind, law in pairs)

    def viscous_impulse(self, start: float, end: float) -> float:
        """Impulse [N.s] between two gaps [m] of forces proportional to speed, without limits."""
        laws = (law for law in self._moving if law.rate == "proportional")
        return sum(law_impulse(law, start, end) for law in laws)

    def impulse_at(self, start: float, end: float, speed: float) -> float:
        """Impulse [N.s] between two gaps [m] at a speed [m/s], without limits."""
        return law_impulse(ForceLaw(lambda gap, _: self.damping(gap, speed)), start, end)

    def opening_time(self, start: float, end: float, pull: float) -> float:
        """Time [s] in which a pull [N] opens the gap [m] against what grows with the speed alone.

        To some per cent, without limits and static forces.
        """

        def slowness(gap: float, _: float) -> float:
            return 1.0 / balance_speed(lambda speed: self.damping(gap, speed) * speed, pull)

        return law_impulse(ForceLaw(slowness), start, end)

    def newtonian_impulse(self, start: float, end: float) -> float:
        """Impulse [N.s] of a flowing liquid without limits between two gaps [m]; 0 without one."""
        return sum(law_impulse(law, start, end) for law in self._liquid())

    def newtonian_force(self, gap: float, speed: float) -> float:
        """Force [N] of a flowing liquid without limits; 0 without one."""
        return sum(law.force(gap, speed) for law in self._liquid())

    def _liquid(self) -> list[ForceLaw]:
        return [law for kind, law in self.laws.items() if kind.newtonian is not None]


def balance_speed(force: Callable[[float], float], pull: float) -> float:
    """Speed [m/s] at which a force that grows with it is a pull [N], both positive, to 1e-3.

    By the secant method in logarithms, from a speed so low that the force is proportional to it.

    Examples
    --------
    >>> round(balance_speed(lambda speed: 4.0 * speed**0.5, 2.0), 3)
    0.25
    """
    x = math.log(_SLOW)
    missing, slope = math.log(pull / force(_SLOW)), 1.0
    for _ in range(_MOST_SECANTS):
        step = min(missing / slope, _LONGEST) if missing > 0.0 else missing / slope
        left = math.log(pull / force(math.exp(x + step)))
        x, slope, missing = x + step, max((missing - left) / step, _FLATTEST), left
        if abs(missing) < 1e-3 * slope:
            break
    return math.exp(x)


def _sum(one: LawAt, other: LawAt) -> LawAt:
    a, b, c, d, e = one
    p, q, r, s, t = other
    return LawAt(a + p, b + q, c + r, d + s, e + t)
