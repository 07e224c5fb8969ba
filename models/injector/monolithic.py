r"""Monolithic model of spool, film and coil, by another method than `contactkit.separation.motion`.

.. math:: (\ln h)' = v/h, \qquad m v' = F_{pull} - k_s (h - h_0) - F_{film}(h, v, W), \qquad
          \lambda' = u(t) - R\,i(\lambda, h), \qquad W' = -2\pi C(h, v, W)

with the void W of a cavitated film, and the viscous impulse and the dissipated work as quadratures.
scipy integrates from one event to the next, by Radau (implicit, order 5) where a film acts and
DOP853 (explicit, order 8) where none does. Events are voltages that switch, the end cap met and
left, kinks of the film laws, a film that cavitates, turns of the edge of its cavity, a film that is
full again, rupture, re-wetting, release, the end stop met and left, the end of the current. The
laws of film and valve are those of the package; unknowns, time stepping and search for events are
not, so that an agreement with `contactkit.separation.motion`, or with its FMU coupled to that of
the drive, says something about both.

Validity: as the laws themselves; the numerical error is about `rtol`. Landing on the end cap is
inelastic, as in `contactkit.separation.motion`: a bounce is left out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import pairwise
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from attrs import field, frozen
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

from ...analyses.load_displacement.curve import LoadDisplacementCurve
from ...errors import ConvergenceError, DescriptionError, PlanError, nearest
from ...frozen import FrozenDict
from ...separation.cavity.events import inception, is_inception
from ...separation.cavity.law import CavityLaw
from ...separation.cavity.state import FULL, Cavity, Phase
from ...separation.motion.state import MotionState, Outputs, outputs
from ...separation.plan import Film, Plan
from ..ode_events import crossing, slopes_of, watch
from . import cavity_pieces
from . import valve as law
from .valve import Valve

__all__ = ["Drive", "Event", "MonolithicResult", "simulate"]

_Floats = NDArray[np.float64]

# With these sizes all unknowns are of order one, and one absolute tolerance fits them.
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
        "void_volume": "m3",
        "cavity_radius": "m",
    }
)
"""The curves of a result and their units; a drive without a valve leaves those of the coil at 0."""


class Mode(NamedTuple):
    """Constants of a piece."""

    in_contact: bool  # at rest on the end cap
    broken: bool = False
    volume_fraction: float = 1.0  # volume of the film over that of the scene
    blocked: bool = False  # the diode keeps the current at zero
    heading: int = 0  # which way a gap that lies on a mark goes; 0: as the forces say
    largest: float = 0.0  # maximum approach of the rough end-stop faces so far [m]
    cavity: Cavity = FULL  # of the film at the start of the piece


class Piece(NamedTuple):
    """One smooth piece: what held, the voltage [V], the times of its steps [s], its unknowns.

    `at` gives gap [m], speed [m/s], flux linkage [Wb], impulse [N.s], work [J] and the void in
    each film [m3] at times.
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
        The curves, by the names of `COLUMNS`; ``result["gap"]`` is one of them.
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

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return a curve by its name in `COLUMNS`."""
        if name not in self.columns:
            raise DescriptionError(
                "column", name, "be a column of the result", hint=nearest(name, self.columns)
            )
        return self.columns[name]


def in_si(
    solution: Callable[[Any], _Floats], units: _Floats, logarithmic: bool, times: Any
) -> _Floats:
    """Gap, speed, flux linkage, impulse, work and void at times, from the solver's unknowns."""
    found: _Floats = np.array(solution(times))
    if logarithmic:
        found[0] = np.exp(found[0])
    return (found.T * units).T


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
        columns=FrozenDict(columns),
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
        gap, speed, flux, impulse, work, void = unknowns
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
        film = _outputs(plan, mode, (time, gap, speed, void), pull)
        forces = (pull, film.film, film.static, film.viscous, float(film.status))
        cavity = (film.void, film.cavity_radius)
        found.append((time, gap, speed, flux, *electric, *forces, impulse, work, *cavity))
    return found


def _outputs(
    plan: Plan, mode: Mode, now: tuple[float, float, float, float], pull: float
) -> Outputs:
    """Forces and cavity at a time [s], a gap [m], a speed [m/s] and a void [m3]."""
    time, gap, speed, void = now
    cavity = mode.cavity if mode.cavity is FULL else mode.cavity._replace(void=void)
    fraction = mode.volume_fraction
    state = MotionState(time, gap, speed, fraction, mode.broken, mode.in_contact, cavity=cavity)
    return outputs(plan, state, pull)


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
        released = (e for e in events if e.what == "released" and start <= e.time)
        release = next((e for e in released if e.time < stop or stop == end), None)
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

    def force(time: float) -> float:
        gap, speed, *_, void = piece.at(time).tolist()
        return _outputs(plan, piece.mode, (time, gap, speed, void), 0.0).film

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


# Two gaps closer than this, relatively, are one: a mark that a piece ended at is behind it in spite
# of round-off. Wider, two marks at nearly one gap would be merged.
_SAME = 1e-12
# Pieces of the motion between events: a spool that bounces ever faster would go on for ever.
_MOST_PIECES = 100_000

_Rates = Callable[[float, _Floats], list[float]]
_Watch = Callable[[float, _Floats], float]


def simulate(
    plan: Plan,
    drive: Drive,
    end: float,
    *,
    rtol: float = 1e-8,
    times: Sequence[float] | _Floats | None = None,
    faces: LoadDisplacementCurve | None = None,
    until_release: bool = False,
) -> MonolithicResult:
    """Integrate spool, film and coil from time 0 to `end`.

    Parameters
    ----------
    plan : Plan
        Of a scene with an imposed force and a mass; the force itself is replaced by `drive`.
    drive : Valve or callable
        A valve, or a pull [N] as a smooth function of time [s].
    end : float
        Where to end [s].
    rtol : float
        Tolerance of the solver, relative to the gap, the speed and the flux.
    times : sequence of float, optional
        Where to give the curves [s]. None: at the steps of the solver, both sides of an event.
    faces : LoadDisplacementCurve, optional
        Rough faces in front of the stop of the valve, solved.
    until_release : bool
        End at the first release, if there is one before `end`.

    Raises
    ------
    PlanError
        If the scene has no mass, does not impose a force, has a force of the solids, or a film
        whose volume or end depends on the motion.
    DescriptionError
        If `end` is not positive and finite.
    ConvergenceError
        If the solver gives up, or events follow each other without end.
    """
    loading = plan.scene.imposed_force
    if not 0.0 < end < math.inf:
        raise DescriptionError(
            "end", end, "be positive and finite", unit="s", hint="the simulation starts at 0"
        )
    if not all(kind.needs_film for kind in plan.film.laws):
        raise PlanError(
            "a monolithic simulation knows forces of the film only; leave out those of the solids"
        )
    if plan.moving_effects:
        raise PlanError(
            "a monolithic simulation knows films of a volume that stays and an end at a gap; leave "
            f"out {' and '.join(plan.moving_effects)}, or take ck.simulate"
        )
    run = _Run(plan, drive, loading.moving_mass, rtol, faces)
    switches = law.switching_times(drive.profile, 0.0, end) if isinstance(drive, Valve) else []
    for start, stop in pairwise([0.0, *switches, end]):
        run.to(start, stop, until_release)
    sampled = None if times is None else np.asarray(times, dtype=np.float64)
    return read(
        plan, drive, run.pieces, run.events, sampled, (run.n_steps, run.n_evaluations), faces
    )


class _Run:
    """A simulation on its way; `state` is gap, speed, flux linkage, impulse, work and void, in SI.

    The unknowns of the solver are ln(h/h_0) while a film acts, else h/h_0, and the others scaled.
    """

    def __init__(
        self,
        plan: Plan,
        drive: Drive,
        mass: float,
        rtol: float,
        faces: LoadDisplacementCurve | None,
    ) -> None:
        self.plan, self.drive, self.mass, self.rtol = plan, drive, mass, rtol
        self.faces, self.pressing = faces, True
        self.loading = loading = plan.scene.imposed_force
        self.valve = drive if isinstance(drive, Valve) else None
        self.mode = Mode(loading.rest_gap >= loading.initial_gap and loading.initial_speed <= 0.0)
        self.time, self.applied, self._longest = 0.0, 0.0, math.inf
        if self.valve is not None:  # an explicit method must not try to step far into the stop
            self._longest = 2.0 * math.sqrt(mass / self.valve.stop.stiffness)
        speed = 0.0 if self.mode.in_contact else loading.initial_speed
        self.state = np.array([loading.initial_gap, speed, 0.0, 0.0, 0.0, 0.0])
        cavity = cavity_pieces.round_cavity(plan.film.cavity)
        scale = cavity_pieces.void_scale(cavity, loading.initial_gap)
        self.units = np.array([loading.initial_gap, 1.0, FLUX, 1.0, 1.0, scale])
        self.pieces: list[Piece] = []
        self.events: list[Event] = []
        self.n_evaluations = self.n_steps = 0
        self.released = False

    def to(self, start: float, stop: float, until_release: bool) -> None:
        """Integrate from one jump of the voltage to the next, or to the first release."""
        if until_release and self.released:
            return
        self.time = start
        if self.valve is not None:
            # In the middle, where rounding of the switching times does not matter.
            self.applied = law.voltage(self.valve.profile, 0.5 * (start + stop))
            blocked = self.applied <= 0.0 and self.state[2] <= 0.0
            self.mode = self.mode._replace(blocked=blocked)
        while self.time < stop and not (until_release and self.released):
            if self.mode.in_contact and self._balance(self.time, self.state[2]) > 0.0:
                self._leave()
            self._piece(stop)
            if len(self.pieces) > _MOST_PIECES:
                raise ConvergenceError(
                    f"events follow each other without end: {_MOST_PIECES} by {self.time:g} s, at "
                    f"a gap of {float(self.state[0]):g} m; end earlier, or move apart the marks "
                    "next to it: loading.rest_gap, initial_gap and final_gap, the gap of the stop"
                )

    # equations --------------------------------------------------------------------------------

    @property
    def film(self) -> Film | None:
        """The film, None while it is broken."""
        return None if self.mode.broken else self.plan.film_with(self.mode.volume_fraction)

    @property
    def cavitation(self) -> CavityLaw | None:
        """Law of the cavity of the film; None where it has none, or nothing is left to cavitate."""
        return cavity_pieces.round_cavity(self.film.cavity) if self.film is not None else None

    def _pull(self, time: float, flux: float, gap: float, speed: float) -> float:
        if isinstance(self.drive, Valve):
            held = law.stopping(self.drive.stop, self.faces, self.mode.largest, gap, speed)
            return law.pull(self.drive, flux, gap, speed, held)
        return self.drive(time)

    def _balance(self, time: float, flux: float) -> float:
        """Force [N] that would set a resting spool in motion; positive opens."""
        film, gap = self.film, float(self.state[0])
        static = film.static_force(gap) if film is not None else 0.0
        spring = self.loading.stiffness * (gap - self.loading.initial_gap)
        return self._pull(time, float(flux), gap, 0.0) - spring - static

    def _rates(self) -> _Rates:
        """Right-hand side of the present mode."""
        film, mass, applied, pull = self.film, self.mass, self.applied, self._pull
        coil = self.valve.coil if self.valve is not None and not self.mode.blocked else None
        stiffness, origin = self.loading.stiffness, self.loading.initial_gap
        in_contact, cavity, cavitation = self.mode.in_contact, self.mode.cavity, self.cavitation
        scale = float(self.units[5])

        def rates(time: float, unknowns: _Floats) -> list[float]:
            place, speed, scaled, _, _, void = unknowns.tolist()
            flux, gap = FLUX * scaled, origin * (place if film is None else math.exp(place))
            rise = law.flux_rate(coil, flux, gap, applied) / FLUX if coil is not None else 0.0
            if in_contact:
                return [0.0, 0.0, rise, 0.0, 0.0, 0.0]
            net = pull(time, flux, gap, speed) - stiffness * (gap - origin)
            if film is None:
                return [speed / origin, net / mass, rise, 0.0, 0.0, 0.0]
            growth = 0.0
            if cavitation is None or cavity is FULL:
                viscous = film.viscous_force(gap, speed)[0]
            else:
                viscous, growth = cavity_pieces.cavitated_film(
                    cavitation, cavity, gap, speed, scale * void
                )
                viscous += film.unbounded(gap, speed).viscous
            net -= film.static_force(gap) + viscous
            return [speed / gap, net / mass, rise, viscous, viscous * speed, growth / scale]

        return rates

    # one piece --------------------------------------------------------------------------------

    def _piece(self, stop: float) -> None:
        """Integrate to the first event, or to `stop`, and apply the event."""
        self._cavitate_at_once()
        film, rates, watched = self.film, self._rates(), self._watched(self._rates())
        # A void that is a little smaller is one that the film remembers, a larger one is not.
        voids = () if self.mode.cavity is FULL else (0.0, 0.0, -1e-3)
        slopes = slopes_of(rates, (1.0, 1e-6, 1e-3, *voids))
        method: dict[str, Any] = {"method": "Radau", "jac": slopes}
        if film is None and not self.mode.in_contact:
            method = {"method": "DOP853", "max_step": self._longest}
        solution = solve_ivp(
            rates,
            (self.time, stop),
            self._unknowns(self.state),
            dense_output=True,
            events=[watch for watch, _ in watched] or None,
            rtol=self.rtol,
            atol=self.rtol * self._sizes(),
            **method,
        )
        if not solution.success or solution.sol is None:
            raise ConvergenceError(
                f"scipy stopped at {self.time:g} s, at a gap of {float(self.state[0]):g} m and "
                f"{float(self.state[1]):g} m/s: {solution.message} Use a larger rtol (it is "
                f"{self.rtol:g}), end earlier, or check the units of mass, stiffness and pull"
            )
        self.n_steps += len(solution.t) - 1
        self.n_evaluations += solution.nfev
        at = partial(in_si, solution.sol, self.units, film is not None)
        self.pieces.append(Piece(self.mode, self.applied, solution.t, at))
        self.time, self.state = float(solution.t[-1]), at(solution.t[-1])
        self.mode = self.mode._replace(heading=0, cavity=self._remembered(solution.t, at))
        if solution.status == 1:
            next(
                action
                for (_, action), times in zip(watched, solution.t_events or [], strict=True)
                if len(times)
            )()

    def _unknowns(self, state: _Floats) -> _Floats:
        unknowns: _Floats = state / self.units
        if self.film is not None:
            unknowns[0] = math.log(unknowns[0])
        return unknowns

    def _sizes(self) -> _Floats:
        """Sizes below which relative errors of the unknowns do not count."""
        return np.array([1.0, max(1e-3 * abs(self.state[1]), 1e-6), 1e-3, 1e-3, 1e-6, 1.0])

    def _watched(self, rates: _Rates) -> list[tuple[_Watch, Callable[[], None]]]:
        """What may end a piece, and what to do then."""
        found: list[tuple[_Watch, Callable[[], None]]] = []
        if self.mode.in_contact:
            found.append((watch(self._leaving, 1), self._leave))
        else:
            for mark, way in self._marks():
                level = self._unknowns(np.array([mark, *[0.0] * 5]))[0]
                found.append((crossing(level, way), partial(self._arrive, mark, way)))
            found += self._turns_of_cavity(rates)
        if self.faces is not None and self._depth() > 0.0:
            turns = watch(lambda time, unknowns: float(unknowns[1]), -1 if self.pressing else 1)
            found.append((turns, self._turn))
        if self.valve is not None and self.applied <= 0.0 and not self.mode.blocked:
            found.append((watch(lambda time, unknowns: float(unknowns[2]), -1), self._block))
        return found

    # cavity -----------------------------------------------------------------------------------

    def _turns_of_cavity(self, rates: _Rates) -> list[tuple[_Watch, Callable[[], None]]]:
        """Events of the cavity in its present phase, and what to do then."""
        film_law, cavity = self.cavitation, self.mode.cavity
        if film_law is None:
            return []

        def place(unknowns: _Floats) -> tuple[float, float, float]:
            now = in_si(lambda _: unknowns, self.units, True, 0.0)
            return float(now[0]), float(now[1]), float(now[5])

        def begins(time: float, unknowns: _Floats) -> float:
            return film_law.tension(*place(unknowns)) / film_law.strength - 1.0

        def recedes(time: float, unknowns: _Floats) -> float:
            acceleration = rates(time, unknowns)[1]
            return cavity_pieces.still_recedes(film_law, *place(unknowns), acceleration)

        def returns(time: float, unknowns: _Floats) -> float:
            return cavity_pieces.liquid_returns(film_law, cavity, *place(unknowns))

        def left(time: float, unknowns: _Floats) -> float:
            return place(unknowns)[2] / cavity.largest - cavity_pieces.REFORMED

        if cavity.phase is Phase.FULL:
            return [(watch(begins, 1), self._cavitate)] if math.isfinite(film_law.strength) else []
        if cavity.phase is Phase.RECEDING:
            return [(watch(recedes, -1), self._turn_edge)]
        return [(watch(left, -1), self._fill), (watch(returns, -1), self._grow_again)]

    def _remembered(self, times: _Floats, at: Callable[[Any], _Floats]) -> Cavity:
        """Cavity at the end of a piece, with the ruptures in it."""
        film_law, cavity = self.cavitation, self.mode.cavity
        if film_law is None or cavity.phase is not Phase.RECEDING:
            return cavity
        return cavity_pieces.remembered(film_law, cavity, times, lambda now: at(now)[[0, 1, 5]])

    def _cavitate_at_once(self) -> None:
        """Let a film cavitate that moves too fast for its strength where a piece begins."""
        film_law, (gap, speed) = self.cavitation, self.state[:2].tolist()
        if film_law is not None and is_inception(film_law, self.mode.cavity, gap, speed):
            self._cavitate()

    def _cavitate(self) -> None:
        film_law, (gap, speed) = self.cavitation, self.state[:2].tolist()
        if film_law is not None:
            self.mode = self.mode._replace(cavity=inception(film_law, gap, speed))
            self._note("film cavitates")

    def _turn_edge(self) -> None:
        cavity = cavity_pieces.turned(self.mode.cavity, float(self.state[0]))
        self.state[5] = cavity.void
        self.mode = self.mode._replace(cavity=cavity)
        self._note("liquid returns")

    def _grow_again(self) -> None:
        gap, void = self.state[[0, 5]].tolist()
        self.mode = self.mode._replace(
            cavity=cavity_pieces.grows_again(self.mode.cavity, gap, void)
        )
        self._note("cavity grows again")

    def _fill(self) -> None:
        self.state[5] = 0.0
        self.mode = self.mode._replace(cavity=FULL)
        self._note("film is full again")

    def _leaving(self, time: float, unknowns: _Floats) -> float:
        return self._balance(time, FLUX * unknowns[2])

    def _marks(self) -> list[tuple[float, int]]:
        """Nearest gaps above (1) and below (-1) at which something happens."""
        film, loading, (gap, speed) = self.film, self.loading, self.state[:2]
        marks = [loading.rest_gap, loading.initial_gap, loading.final_gap]
        marks += [*film.kinks, film.end] if film is not None else []
        marks += [self.valve.stop.gap] if self.valve is not None else []
        towards = self.mode.heading or speed or self._balance(self.time, self.state[2])
        # A mark that the gap lies on is behind it.
        behind = gap * (1.0 + math.copysign(_SAME, towards))
        above = min((m for m in marks if behind < m), default=math.inf)
        below = max((m for m in marks if m < behind), default=0.0)
        return [(m, way) for m, way in ((above, 1), (below, -1)) if 0.0 < m < math.inf]

    # events -----------------------------------------------------------------------------------

    def _note(self, what: str) -> None:
        self.events.append(Event(self.time, what, float(self.state[0]), float(self.state[1])))

    def _leave(self) -> None:
        self.mode = self.mode._replace(in_contact=False, heading=1)
        self._note("leaves the end cap")

    def _depth(self) -> float:
        """How far the spool is in the stop [m]."""
        return float(self.state[0]) - self.valve.stop.gap if self.valve is not None else 0.0

    def _turn(self) -> None:
        """Remember the deepest point of rough faces, which decides their unloading curve."""
        self.pressing = not self.pressing
        if self.valve is not None and self.faces is not None:
            gap, before = float(self.state[0]), self.mode.largest
            depth = law.rough_stop_force(self.valve.stop, self.faces, before, gap, 0.0).approach
            self.mode = self.mode._replace(largest=max(before, min(depth, self.faces.max_approach)))

    def _block(self) -> None:
        self.state[2] = 0.0
        self.mode = self.mode._replace(blocked=True)
        self._note("current ends")

    def _arrive(self, mark: float, way: int) -> None:
        self.state[0] = mark
        self.mode = self.mode._replace(heading=way)
        if self.valve is not None and mark == self.valve.stop.gap:
            self.pressing = True
            self._note("meets the stop" if way > 0 else "leaves the stop")
        self._rise(mark) if way > 0 else self._fall(mark)

    def _rise(self, mark: float) -> None:
        film = self.film
        if mark == self.loading.final_gap:
            self._note("released")
            self.released = True
        if film is not None and mark == film.end:
            self.state[5] = 0.0
            self.mode = self.mode._replace(broken=True, cavity=FULL)
            self._note("film breaks")

    def _fall(self, mark: float) -> None:
        fraction = self.plan.scene.meniscus.rewetting
        dry = self.mode.broken and mark <= self.loading.initial_gap
        if dry and fraction > 0.0 and self.plan.film_with(fraction).end > mark:
            self.mode = self.mode._replace(broken=False, volume_fraction=fraction)
            self._note("film wets again")
        if mark == self.loading.rest_gap:
            self._note("meets the end cap")
            self.mode = self.mode._replace(in_contact=True, cavity=FULL)
            self.state[[1, 5]] = 0.0
