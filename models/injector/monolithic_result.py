"""What a monolithic simulation gives: curves, events and a summary of each firing cycle."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from attrs import field, frozen
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from ...analyses.load_displacement.curve import LoadDisplacementCurve
from ...separation.motion.state import MotionState, outputs
from ...separation.plan import Plan
from . import valve as law
from .valve import Valve

__all__ = [
    "COLUMNS",
    "FLUX",
    "Cycle",
    "Drive",
    "Event",
    "Mode",
    "MonolithicResult",
    "Piece",
    "in_si",
    "read",
]

_Floats = NDArray[np.float64]

FLUX = 1e-3
"""Size of the unknown flux linkage [Wb]; 1 m/s, 1 N.s and 1 J are those of the others."""

Drive = Valve | Callable[[float], float]
"""A valve, or a prescribed pull [N] at a time [s]."""

COLUMNS: Mapping[str, str] = MappingProxyType(
    {
        "time": "s",
        "gap": "m",
        "speed": "m/s",
        "flux": "Wb",
        "current": "A",
        "voltage": "V",
        "magnet_force": "N",
        "spring_force": "N",
        "stop_force": "N",
        "pull": "N",
        "film_force": "N",
        "meniscus_force": "N",
        "viscous_force": "N",
        "status": "-",
        "viscous_impulse": "N.s",
        "dissipated_work": "J",
    }
)
"""The curves of a result and their units; a drive without a valve leaves those of the coil at 0."""


class Mode(NamedTuple):
    """What holds throughout a piece."""

    in_contact: bool  # at rest on the end cap
    broken: bool = False
    volume_fraction: float = 1.0  # volume of the film over that of the scene
    blocked: bool = False  # the diode keeps the current at zero
    heading: int = 0  # which way a gap that lies on a mark goes; 0: as the forces say
    largest: float = 0.0  # largest approach that rough faces of the stop have had [m]


class Piece(NamedTuple):
    """One smooth piece: what held, the voltage [V], the times of its steps [s], its unknowns.

    `at` gives gap [m], speed [m/s], flux linkage [Wb], impulse [N.s] and work [J] at times.
    """

    mode: Mode
    applied: float
    times: _Floats
    at: Callable[[Any], _Floats]


class Event(NamedTuple):
    """Something that happened: when [s], what, and at which gap [m] and speed [m/s]."""

    time: float
    what: str
    gap: float
    speed: float


class Cycle(NamedTuple):
    """One firing cycle, from one energising to the next.

    It starts at `start` [s] with the gap `start_gap` [m]. `release_time` counts from there to the
    first time the release gap is passed [s], nan if it never is; `peak_force` [N] is the largest
    force of the film and `peak_time` when it acts, from the start [s]; `viscous_impulse` [N.s] is
    signed, closing counts against opening.
    """

    start: float
    start_gap: float
    release_time: float
    release_speed: float
    peak_force: float
    peak_time: float
    viscous_impulse: float


@frozen(eq=False, kw_only=True)
class MonolithicResult:
    """Curves, events and cycles of a monolithic simulation.

    Attributes
    ----------
    columns : mapping of str to ndarray
        The curves, by the names of `COLUMNS`; also read as attributes, ``result.gap``.
    cycles : tuple of Cycle
        A summary of each firing cycle; one in all for a prescribed pull.
    events : tuple of Event
        What happened, in order.
    n_steps, n_evaluations : int
        Steps of the solver, and evaluations of the equations.
    """

    columns: Mapping[str, NDArray[Any]] = field(repr=False)
    cycles: tuple[Cycle, ...]
    events: tuple[Event, ...] = field(repr=False)
    n_steps: int
    n_evaluations: int

    def __getattr__(self, name: str) -> NDArray[Any]:
        if name in COLUMNS:
            return self.columns[name]
        raise AttributeError(name)


def in_si(
    solution: Callable[[Any], _Floats], origin: float, logarithmic: bool, times: Any
) -> _Floats:
    """Gap, speed, flux linkage, impulse and work at times, from the unknowns of the solver."""
    found: _Floats = np.array(solution(times))
    found[0] = origin * (np.exp(found[0]) if logarithmic else found[0])
    found[2] *= FLUX
    return found


def read(
    plan: Plan,
    drive: Drive,
    pieces: Sequence[Piece],
    events: Sequence[Event],
    times: _Floats | None,
    counts: tuple[int, int],
    faces: LoadDisplacementCurve | None = None,
) -> MonolithicResult:
    """Read curves and cycles off the pieces of a simulation."""
    rows: list[tuple[float, ...]] = []
    for piece in pieces:
        last = piece is pieces[-1]
        chosen = piece.times if times is None else _inside(piece, times, last)
        if len(chosen):
            rows += _rows(plan, drive, piece, chosen, faces)
    table = np.array(rows, dtype=np.float64).reshape(-1, len(COLUMNS)).T
    columns: dict[str, NDArray[Any]] = dict(zip(COLUMNS, table, strict=True))
    for column in columns.values():
        column.flags.writeable = False
    return MonolithicResult(
        columns=MappingProxyType(columns),
        cycles=_cycles(plan, drive, pieces, events),
        events=tuple(events),
        n_steps=counts[0],
        n_evaluations=counts[1],
    )


def _inside(piece: Piece, times: _Floats, last: bool) -> _Floats:
    before = times <= piece.times[-1] if last else times < piece.times[-1]
    inside: _Floats = times[(times >= piece.times[0]) & before]
    return inside


def _rows(
    plan: Plan, drive: Drive, piece: Piece, times: _Floats, faces: LoadDisplacementCurve | None
) -> list[tuple[float, ...]]:
    """Values of all columns at times in one piece."""
    mode = piece.mode
    found: list[tuple[float, ...]] = []
    for time, *unknowns in np.column_stack([times, piece.at(times).T]).tolist():
        gap, speed, flux, impulse, work = unknowns
        electric = (0.0, 0.0, 0.0, 0.0, 0.0)
        if isinstance(drive, Valve):
            held = law.stopping(drive.stop, faces, mode.largest, gap, speed)
            pull = law.pull(drive, flux, gap, speed, held)
            electric = (
                law.current(drive.coil, flux, gap),
                piece.applied,
                law.magnet_force(drive.coil, flux),
                law.spring_force(drive.spring, gap),
                held,
            )
        else:
            pull = drive(time)
        now = MotionState(time, gap, speed, mode.volume_fraction, mode.broken, mode.in_contact)
        film = outputs(plan, now, pull)
        forces = (pull, film.film, film.static, film.viscous, float(film.status))
        found.append((time, gap, speed, flux, *electric, *forces, impulse, work))
    return found


def _cycles(
    plan: Plan, drive: Drive, pieces: Sequence[Piece], events: Sequence[Event]
) -> tuple[Cycle, ...]:
    end = float(pieces[-1].times[-1])
    starts = [0.0]
    if isinstance(drive, Valve):
        starts = [time for time in law.energising_times(drive.profile) if time < end]
    found = []
    for start, stop in zip(starts, [*starts[1:], end], strict=True):
        # No piece reaches across an energising.
        inside = [p for p in pieces if start <= 0.5 * (p.times[0] + p.times[-1]) < stop]
        release = next((e for e in events if e.what == "released" and start <= e.time < stop), None)
        peak, when = max((_peak(plan, piece) for piece in inside), default=(0.0, math.nan))
        given = inside[-1].at(inside[-1].times[-1])[3] - inside[0].at(inside[0].times[0])[3]
        found.append(
            Cycle(
                start=start,
                start_gap=float(inside[0].at(inside[0].times[0])[0]),
                release_time=release.time - start if release else math.nan,
                release_speed=release.speed if release else math.nan,
                peak_force=peak,
                peak_time=when - start,
                viscous_impulse=float(given),
            )
        )
    return tuple(found)


def _peak(plan: Plan, piece: Piece) -> tuple[float, float]:
    """Largest force [N] of the film in a piece, and when [s]."""
    if piece.mode.broken:
        return 0.0, math.nan
    film = plan.film_with(piece.mode.volume_fraction)

    def force(time: float) -> float:
        gap, speed = piece.at(time)[:2].tolist()
        return film.force(gap, speed)

    times = piece.times
    forces = [force(float(time)) for time in times]
    best = int(np.argmax(forces))
    low, high = float(times[max(best - 1, 0)]), float(times[min(best + 1, len(times) - 1)])
    if piece.mode.in_contact or not low < high:
        return forces[best], float(times[best])
    sharp = minimize_scalar(
        lambda time: -force(time),
        bounds=(low, high),
        method="bounded",
        options={"xatol": 1e-9 * (high - low)},
    )
    at_step = forces[best], float(times[best])
    return max(at_step, (-float(sharp.fun), float(sharp.x)))
