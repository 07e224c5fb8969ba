"""Separations of imposed motion: forces at a speed, or the impulse within a time."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import attrs
import numpy as np

from ..numerics.lines import with_middles
from ..scene.loading import ImposedSpeed, ImposedTime
from ..units import quantity_text
from .bridge_end import distance_to_end
from .cavity_points import CavityPoint, Known, cavity_points
from .curve_result import LateColumns, Work
from .effects.base import CAVITY, LIMIT, FilmStatus, LimitKind, SeparationForce
from .effects.force_law import law_impulse
from .film import Film
from .plan import Plan
from .results import SeparationResult, extremes_of, with_late_curves
from .validity import check

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Curve = NDArray[np.float64]

__all__ = [
    "at_speed",
    "broke",
    "frozen",
    "impulses_of_gaps",
    "impulses_so_far",
    "limited_name",
    "simulated",
    "cavity_row",
    "within_time",
]


def frozen(values: object) -> Curve:
    """Make a read-only array of a curve."""
    array = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array


def _grid(plan: Plan) -> list[float]:
    """Gaps of a curve, closer where the film is thin, up to the end of all forces.

    The gap at which a film or a contact ends before is one of them.
    """
    loading, film = plan.scene.loading, plan.film
    low, high = loading.initial_gap, loading.final_gap
    if film.remaining(broken=True, detached=False) is None:  # no force of the solids is left
        high = min(high, film.end)
    # An offset keeps the first step finite where the curve begins at a touching sphere.
    offset = 0.0 if low > 0.0 else 1e-3 * high
    gaps = np.geomspace(low + offset, high + offset, max(plan.accuracy.points, 2)) - offset
    gaps[0], gaps[-1] = low, high
    ends = {end for end in (film.end, film.release) if low < end < high}
    return sorted({*map(float, gaps), *ends})


def broke(plan: Plan) -> str:
    """Say at which gap the film of an opening broke; empty if it lasts to the final gap."""
    end = plan.film.end
    return (
        f"; the film broke at {quantity_text(end, 'm')}"
        if end < plan.scene.loading.final_gap
        else ""
    )


def at_speed(plan: Plan, loading: ImposedSpeed, begun: float) -> SeparationResult:
    """Forces along the gap at an imposed speed."""
    gaps, speed = _grid(plan), loading.speed
    known: dict[float, Known] = {}
    columns = _at_speed(plan, loading, gaps, known)
    impulses = {}
    film = plan.film
    for kind, law in film.laws.items():
        end = _end(plan, kind)
        if law.rate == "proportional" or any(
            gaps[0] <= pole <= min(gaps[-1], end) for pole in law.poles
        ):
            continue
        impulses[kind.column.impulse.name] = _running(law.force, speed, gaps, end)[-1]
    impulses |= impulses_of_gaps(plan)
    if film.limited is not None and film.limited.so_far is not None:
        name = film.limited.so_far.name
        impulses[film.limited.column.impulse.name] = float(columns[name][-1])
    validity = check(plan, columns)
    work = Work(0, 0, len(gaps), clock.perf_counter() - begun)
    message = f"forces at {speed:g} m/s from {gaps[0]:g} m to {gaps[-1]:g} m{broke(plan)}"
    curves = _drawn(plan, columns, _SpeedLines(plan, loading, gaps, known))
    return SeparationResult(
        plan, "curve", message, curves, impulses, None, validity, work, extremes_of(plan, columns)
    )


def _at_speed(
    plan: Plan, loading: ImposedSpeed, gaps: Sequence[float], known: dict[float, Known]
) -> dict[str, Curve]:
    """Curves at some gaps [m] of an opening at a speed."""
    cavity, film = _cavity(plan, loading, gaps, known), plan.film
    columns = _forces_at_speed(plan, loading, gaps, cavity)
    for kind, law in film.laws.items():
        if kind.so_far is None:
            continue
        if kind is film.limited and cavity:
            running = [point.impulse for point in cavity]
            running += [running[-1]] * (len(gaps) - len(cavity))
        else:
            force = _limited(film) if kind is film.limited else law.force
            running = _running(force, loading.speed, gaps, _end(plan, kind))
        columns[kind.so_far.name] = frozen(running)
    return columns


def _limited(film: Film) -> Callable[[float, float], float]:
    """Force [N] that the limits of the liquid leave."""
    return lambda gap, speed: film.limited_force(gap, speed)[0]


def _end(plan: Plan, kind: type[SeparationForce]) -> float:
    """Gap [m] up to which a force acts during a monotonic opening."""
    film = plan.film
    return min(film.laws[kind].release, film.end if kind.needs_film else math.inf)


def _forces_at_speed(
    plan: Plan, loading: ImposedSpeed, gaps: Sequence[float], cavity: Sequence[CavityPoint]
) -> dict[str, Curve]:
    """Curves that need no integral, at some gaps [m]."""
    speed = loading.speed
    rows = [_forces(plan, gap, speed) for gap in gaps]
    rows[: len(cavity)] = [_with_cavity(plan, *pair) for pair in zip(rows, cavity, strict=False)]
    return {
        "time": frozen([(gap - loading.initial_gap) / speed for gap in gaps]),
        "gap": frozen(gaps),
        "speed": frozen([speed] * len(gaps)),
        "pull": frozen([row["pull"] for row in rows]),
        "film_status": frozen([row["film_status"] for row in rows]),
    } | {name: frozen([row[name] for row in rows]) for name in simulated(plan)}


@attrs.frozen(eq=False)
class _SpeedLines:
    """Curves at a speed, at as many gaps as lines need."""

    plan: Plan
    loading: ImposedSpeed
    gaps: Sequence[float]
    known: dict[float, Known]
    """What is known of a film that cavitates."""

    def __call__(self) -> dict[str, Curve]:
        """Return the curves by their names."""
        gaps = _with_middles(self.plan, self.gaps, self._table)
        return _at_speed(self.plan, self.loading, gaps, self.known)

    def _table(self, gaps: Curve) -> Curve:
        """Return all curves; the impulse by the trapezoidal rule, which is as right as lines."""
        cavity = _cavity(self.plan, self.loading, gaps.tolist(), self.known)
        columns = _forces_at_speed(self.plan, self.loading, gaps.tolist(), cavity)
        pull, time = columns["pull"], columns["time"]
        steps = 0.5 * (pull[1:] + pull[:-1]) * np.diff(time)
        impulse = np.concatenate([[0.0], np.cumsum(steps)])
        return np.column_stack([*columns.values(), impulse, _to_end(self.plan, gaps)])


@attrs.frozen(eq=False)
class _TimeLines:
    """Curves within a time, at as many gaps as lines need."""

    plan: Plan
    gaps: Sequence[float]

    def __call__(self) -> dict[str, Curve]:
        """Return the curves by their names."""
        return _within_time(self.plan, _with_middles(self.plan, self.gaps, self._table))

    def _table(self, gaps: Curve) -> Curve:
        columns = _within_time(self.plan, gaps.tolist())
        return np.column_stack([*columns.values(), _to_end(self.plan, gaps)])


def _to_end(plan: Plan, gaps: Curve) -> list[float]:
    """Return what lines follow so that the shape of a bridge is right near its end."""
    return [distance_to_end(plan, gap) for gap in gaps.tolist()]


def _with_middles(
    plan: Plan, gaps: Sequence[float], table: Callable[[Curve], Curve]
) -> list[float]:
    """Gaps [m] between which straight lines are right, over a logarithmic gap too.

    What ends at a gap is there at that gap, and gone at the next that a float can tell.
    """
    film, rtol = plan.film, plan.accuracy.curve_rtol
    places = {*gaps, *(math.nextafter(e, math.inf) for e in (film.end, film.release) if e in gaps)}
    places = {place for place in places if place <= gaps[-1]}
    for a, b in pairwise(gaps):
        # A line over the gap misses one over its logarithm by an eighth of the square.
        n = math.ceil(math.log(b / a) / math.sqrt(8.0 * rtol)) if a > 0.0 else 1
        places |= {a * (b / a) ** (k / n) for k in range(1, n)}
    found: list[float] = with_middles(np.array(sorted(places)), table, rtol).tolist()
    return found


def _drawn(
    plan: Plan, columns: Mapping[str, Curve], lines: Callable[[], dict[str, Curve]]
) -> Mapping[str, Curve]:
    """Curves of a result: those of a run, with points between its own when asked for."""
    return with_late_curves(plan, LateColumns({}, dict.fromkeys(columns, lines)))


def _cavity(
    plan: Plan, loading: ImposedSpeed, gaps: Sequence[float], known: dict[float, Known]
) -> list[CavityPoint]:
    """Film that cavitates, at each gap up to its end; none for a film that does not remember it."""
    film, law = plan.film, plan.film.cavity
    if law is None:
        return []
    start, speed = loading.initial_gap, loading.speed
    times = [(gap - start) / speed for gap in gaps if gap <= film.end]
    rtol = plan.accuracy.time_rtol
    return cavity_points(film, law, lambda time: (start + speed * time, speed), times, rtol, known)


def _with_cavity(plan: Plan, row: dict[str, float], point: CavityPoint) -> dict[str, float]:
    """Row of a curve with the force of a film that cavitates in place of that of a full one."""
    cavity = cavity_row(plan, point)
    return row | cavity | {"pull": row["pull"] - row[limited_name(plan)] + point.force}


def limited_name(plan: Plan) -> str:
    """Name of the force that limits of the liquid bound."""
    assert plan.film.limited is not None
    return plan.film.limited.column.name


def cavity_row(plan: Plan, point: CavityPoint) -> dict[str, float]:
    """Columns of a film that cavitates."""
    radius, void = (column.name for column in CAVITY)
    return {
        limited_name(plan): point.force,
        LIMIT.name: float(point.limit),
        radius: point.radius,
        void: point.void,
    }


def simulated(plan: Plan) -> list[str]:
    """Names of the curves that the effects of a plan give at each gap and speed."""
    film = plan.film
    names = [column.name for column in film.columns]
    names += [kind.newtonian.name for kind in film.laws if kind.newtonian is not None]
    if film.is_limited:
        names.append(LIMIT.name)
    if film.cavity is not None:
        names += [column.name for column in CAVITY]
    return names


def impulses_so_far(plan: Plan) -> list[str]:
    """Names of the curves of impulses up to each point."""
    return [kind.so_far.name for kind in plan.film.laws if kind.so_far is not None]


def _forces(plan: Plan, gap: float, speed: float) -> dict[str, float]:
    film, broken = plan.acting_film(gap), gap > plan.film.end
    row = dict.fromkeys(simulated(plan), 0.0)
    pull, limit = 0.0, LimitKind.NONE
    if film is not None:
        found = film.at(gap, speed)
        row |= found.named | found.newtonian
        pull, limit = sum(found.named.values()), found.limit
    whole = FilmStatus.FULL if gap <= plan.film.full_gap else FilmStatus.BRIDGE
    return row | {
        "pull": pull,
        LIMIT.name: float(limit),
        "film_status": float(FilmStatus.BROKEN if broken else whole),
    }


def _running(
    force: Callable[[float, float], float], speed: float, gaps: Sequence[float], end: float
) -> list[float]:
    """Time integral of a force [N.s] up to each gap of a curve, at an imposed speed.

    The force lasts to the gap `end` [m], which is one of the curve if it lies within.
    """
    from scipy.integrate import quad

    total, found = 0.0, [0.0]
    for a, b in pairwise(gaps):
        if a >= end:
            found.append(total)
            continue
        # Relative to the largest value there could be, as a force may change its sign.
        floor = 1e-13 * b * max(abs(force(a, speed)), abs(force(b, speed)))
        total += quad(force, a, b, (speed,), epsabs=floor, epsrel=1e-10, limit=500)[0] / speed
        found.append(total)
    return found


def impulses_of_gaps(plan: Plan) -> dict[str, float]:
    """Impulse [N.s] of each force that is proportional to speed, which no path in time changes.

    Without the limits of the liquid; of a force that they may bound under both its names.
    """
    loading, found = plan.scene.loading, dict[str, float]()
    for kind, law in plan.film.laws.items():
        if law.rate == "proportional":
            last = min(loading.final_gap, _end(plan, kind))
            value = law_impulse(law, loading.initial_gap, last)
            columns = (kind.column, kind.newtonian)
            found |= {column.impulse.name: value for column in columns if column is not None}
    return found


def within_time(plan: Plan, loading: ImposedTime, begun: float) -> SeparationResult:
    """Impulse and mean force of an opening of which only the duration is given."""
    gaps = _grid(plan)
    columns = _within_time(plan, gaps)
    impulses = impulses_of_gaps(plan)
    validity = check(plan, columns)
    work = Work(0, 0, len(gaps), clock.perf_counter() - begun)
    message = f"opening from {gaps[0]:g} m to {gaps[-1]:g} m within {loading.time:g} s{broke(plan)}"
    curves = _drawn(plan, columns, _TimeLines(plan, gaps))
    return SeparationResult(
        plan, "curve", message, curves, impulses, None, validity, work, extremes_of(plan, columns)
    )


def _within_time(plan: Plan, gaps: Sequence[float]) -> dict[str, Curve]:
    """Curves at some gaps [m] where only the duration is given."""
    film = plan.film
    static = [column.name for column in film.static_columns]
    rows = [_forces(plan, gap, 0.0) for gap in gaps] if static else []
    columns = {"gap": frozen(gaps)}
    columns |= {name: frozen([row[name] for row in rows]) for name in static}
    for kind, law in film.laws.items():
        if kind.so_far is not None and law.rate == "proportional":
            last = _end(plan, kind)
            running = [law_impulse(law, gaps[0], min(gap, last)) for gap in gaps]
            columns[kind.so_far.name] = frozen(running)
    return columns
