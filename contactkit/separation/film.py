"""The forces of a scene made ready to be called: of the film, and of the solids beside it."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterable, Mapping
from itertools import pairwise
from types import MappingProxyType

from attrs import field, frozen

from .effects.base import ForceLaw, Limiter, SeparationForce
from .effects.registry import SeparationEffect
from .effects.viscous import ViscousForce
from .integrator.radau_smooth import Here

__all__ = ["Film", "impulse_name"]


def impulse_name(column: str) -> str:
    """Name of the time integral of the force in a column.

    Examples
    --------
    >>> impulse_name("meniscus_force")
    'meniscus_impulse'
    """
    return column.removesuffix("_force") + "_impulse"


def _nothing(gap: float) -> tuple[float, float, float]:
    return 0.0, 0.0, 0.0


def _none(gap: float, speed: float) -> float:
    return 0.0


def _smooth(
    edges: tuple[float, ...],
    viscous: ForceLaw | None,
    series: Callable[[float], tuple[float, float, float] | None],
) -> Callable[[float], Here | None]:
    """Join the viscous and one other force between edges; the last answer is kept.

    The end of a step is the start of the next one.
    """
    resist, cells = viscous.force if viscous is not None else _none, []
    for low, high in pairwise(edges):
        one = low or min(0.5 * high, 1e-6)
        cells.append((viscous.exponent(one) if viscous is not None else 0.0, low, high))
    inner = edges[1:-1]
    last: Here = (math.nan, *(0.0,) * 7)

    def at(gap: float) -> Here | None:
        nonlocal last
        found = last
        if found[0] == gap:
            return found
        forces = series(gap)
        if forces is None:
            return None
        last = found = (gap, *forces, resist(gap, 1.0), *cells[bisect_right(inner, gap)])
        return found

    return at


@frozen(eq=False)
class Film:
    """The forces of a film of one volume, ready to be evaluated at any gap and speed.

    Forces of the solids are among the `laws` too: they stay when the film breaks, which it does
    at `end`. A solid contact lets go at `release`, and is there again once the gap has closed to
    `rejoin` (all in metres; inf and 0 where there is none).
    """

    laws: Mapping[type[SeparationForce], ForceLaw]
    limits: tuple[tuple[type[SeparationEffect], Limiter], ...]
    end: float
    full_gap: float
    kinks: tuple[float, ...] = field(init=False)
    release: float = field(init=False)
    rejoin: float = field(init=False)
    # The same laws, split once: these are called some ten times per internal step.
    _viscous: ForceLaw | None = field(init=False, repr=False)
    _static: tuple[Callable[[float, float], float], ...] = field(init=False, repr=False)
    static_columns: tuple[str, ...] = field(init=False, repr=False)
    smooth: Callable[[float], Here | None] | None = field(init=False, repr=False)
    """What acts at a gap [m], if that is a liquid between flats, without its limits; see `Here`."""

    @kinks.default
    def _find_kinks(self) -> tuple[float, ...]:
        found = {kink for law in self.laws.values() for kink in law.kinks}
        return tuple(sorted(kink for kink in found if 0.0 < kink < self.end))

    @release.default
    def _find_release(self) -> float:
        return min((law.release for law in self.laws.values()), default=math.inf)

    @rejoin.default
    def _find_rejoin(self) -> float:
        return max((law.rejoin for law in self.laws.values()), default=0.0)

    @_viscous.default
    def _find_viscous(self) -> ForceLaw | None:
        return self.laws.get(ViscousForce)

    @_static.default
    def _find_static(self) -> tuple[Callable[[float, float], float], ...]:
        return tuple(law.force for kind, law in self.laws.items() if kind is not ViscousForce)

    @static_columns.default
    def _find_columns(self) -> tuple[str, ...]:
        return tuple(kind.column for kind in self.laws if kind is not ViscousForce)

    @smooth.default
    def _find_smooth(self) -> Callable[[float], Here | None] | None:
        others = [law for kind, law in self.laws.items() if kind is not ViscousForce]
        viscous = self._viscous
        if self.static_columns not in ((), ("meniscus_force",)):
            return None
        if viscous is not None and not viscous.is_power:
            return None
        series = others[0].series if others else _nothing
        edges = (0.0, *self.kinks, min(self.end, self.release))
        return _smooth(edges, viscous, series) if series is not None else None

    def left(self, *, broken: bool, detached: bool) -> Film | None:
        """Return what acts once the film is broken, or the solids have let go; None if nothing."""
        laws = {
            kind: law
            for kind, law in self.laws.items()
            if not (broken and kind.needs_film) and not (detached and math.isfinite(law.release))
        }
        if not laws:
            return None
        limits, end = ((), math.inf) if broken else (self.limits, self.end)
        return Film(MappingProxyType(laws), limits, end, self.full_gap)

    def static_force(self, gap: float) -> float:
        """Sum of the forces [N] that do not depend on speed, at a gap [m]."""
        total = 0.0
        for force in self._static:
            total += force(gap, 0.0)
        return total

    def static_forces(self, gap: float) -> dict[str, float]:
        """Each of the forces [N] that do not depend on speed, by its column, at a gap [m]."""
        return {
            column: force(gap, 0.0)
            for column, force in zip(self.static_columns, self._static, strict=True)
        }

    def static_means(
        self, gaps: Iterable[float], weights: Iterable[float], totals: Iterable[float]
    ) -> dict[str, float]:
        """Weighted sum over gaps of each of the forces that do not depend on speed [N].

        By the name of its impulse. `totals` are their sums at the gaps, so that one force alone
        is not evaluated again.
        """
        pairs = list(zip(gaps, weights, strict=True))
        names = [impulse_name(column) for column in self.static_columns]
        if len(names) == 1:
            return {names[0]: sum(w * f for (_, w), f in zip(pairs, totals, strict=True))}
        return {
            name: sum(weight * force(gap, 0.0) for gap, weight in pairs)
            for name, force in zip(names, self._static, strict=True)
        }

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

    def forces(
        self, gap: float, speed: float
    ) -> tuple[float, float, type[SeparationEffect] | None]:
        """Static force and viscous force after the limits [N], and the limit that acts."""
        here = self.smooth(gap) if self.smooth is not None else None
        if here is None:
            return self.static_force(gap), *self.viscous_force(gap, speed)
        if self.limits:
            return here[1], *self.viscous_force(gap, speed)
        return here[1], here[4] * speed, None  # known already, at the end of a step

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
