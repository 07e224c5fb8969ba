r"""Spool, film and coil solved as one system, by another method than `contactkit.motion`.

.. math:: (\ln h)' = v/h, \qquad m v' = F_{pull} - k_s (h - h_0) - F_{film}(h, v), \qquad
          \lambda' = u(t) - R\,i(\lambda, h)

with the viscous impulse and the dissipated work as quadratures beside them. scipy integrates from
one event to the next, by Radau (implicit, order 5) where a film acts and DOP853 (explicit, order
8) where none does. Events are voltages that switch, the end cap met and left, kinks of the film
laws, rupture, re-wetting, release, the stop met and left, the end of the current. The laws of
film and valve are those of the package; unknowns, time stepping and search for events are not,
so that an agreement with `contactkit.motion`, or with its FMU coupled to that of the drive, says
something about both.

Validity: as the laws themselves; the numerical error is about `rtol`. Landing on the end cap is
inelastic, as in `contactkit.motion`: a bounce is left out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from ...analyses.load_displacement.curve import LoadDisplacementCurve
from ...errors import ConvergenceError, PlanError
from ...separation.plan import Film, Plan
from ..ode_events import crossing, slopes_of, watch
from . import valve as law
from .monolithic_result import FLUX, Drive, Event, Mode, MonolithicResult, Piece, in_si, read
from .valve import Valve

__all__ = ["Drive", "MonolithicResult", "simulate"]

_SAME = 1e-12  # two gaps closer than this, relatively, are one
_MOST_PIECES = 100_000

_Floats = NDArray[np.float64]
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

    Raises
    ------
    PlanError
        If the scene has no mass, does not impose a force, or has a force of the solids.
    ConvergenceError
        If the solver gives up.
    """
    loading = plan.scene.imposed_force
    if loading.mass is None:
        raise PlanError("a monolithic simulation needs loading.mass [kg]")
    if not all(kind.needs_film for kind in plan.film.laws):
        raise PlanError(
            "a monolithic simulation knows forces of the film only; leave out those of the solids"
        )
    run = _Run(plan, drive, loading.mass, rtol, faces)
    switches = law.switching_times(drive.profile, 0.0, end) if isinstance(drive, Valve) else []
    for start, stop in pairwise([0.0, *switches, end]):
        run.to(start, stop)
    sampled = None if times is None else np.asarray(times, dtype=np.float64)
    return read(
        plan, drive, run.pieces, run.events, sampled, (run.n_steps, run.n_evaluations), faces
    )


class _Run:
    """A simulation on its way; `state` is gap, speed, flux linkage, impulse and work, in SI units.

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
        self.state = np.array([loading.initial_gap, speed, 0.0, 0.0, 0.0])
        self.pieces: list[Piece] = []
        self.events: list[Event] = []
        self.n_evaluations = self.n_steps = 0

    def to(self, start: float, stop: float) -> None:
        """Integrate from one jump of the voltage to the next."""
        self.time = start
        if self.valve is not None:
            # In the middle, where rounding of the switching times does not matter.
            self.applied = law.voltage(self.valve.profile, 0.5 * (start + stop))
            blocked = self.applied <= 0.0 and self.state[2] <= 0.0
            self.mode = self.mode._replace(blocked=blocked)
        while self.time < stop:
            if self.mode.in_contact and self._balance(self.time, self.state[2]) > 0.0:
                self._leave()
            self._piece(stop)
            if len(self.pieces) > _MOST_PIECES:
                raise ConvergenceError(f"events follow each other without end at {self.time:g} s")

    # equations --------------------------------------------------------------------------------

    @property
    def film(self) -> Film | None:
        """The film, None while it is broken."""
        return None if self.mode.broken else self.plan.film_with(self.mode.volume_fraction)

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
        in_contact = self.mode.in_contact

        def rates(time: float, unknowns: _Floats) -> list[float]:
            place, speed, scaled, _, _ = unknowns.tolist()
            flux, gap = FLUX * scaled, origin * (place if film is None else math.exp(place))
            rise = law.flux_rate(coil, flux, gap, applied) / FLUX if coil is not None else 0.0
            if in_contact:
                return [0.0, 0.0, rise, 0.0, 0.0]
            net = pull(time, flux, gap, speed) - stiffness * (gap - origin)
            if film is None:
                return [speed / origin, net / mass, rise, 0.0, 0.0]
            viscous = film.viscous_force(gap, speed)[0]
            net -= film.static_force(gap) + viscous
            return [speed / gap, net / mass, rise, viscous, viscous * speed]

        return rates

    # one piece --------------------------------------------------------------------------------

    def _piece(self, stop: float) -> None:
        """Integrate to the first event, or to `stop`, and apply the event."""
        film, rates, watched = self.film, self._rates(), self._watched()
        method: dict[str, Any] = {"method": "Radau", "jac": slopes_of(rates)}
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
            raise ConvergenceError(f"scipy stopped at {self.time:g} s: {solution.message}")
        self.n_steps += len(solution.t) - 1
        self.n_evaluations += solution.nfev
        at = partial(in_si, solution.sol, self.loading.initial_gap, film is not None)
        self.pieces.append(Piece(self.mode, self.applied, solution.t, at))
        self.time, self.state = float(solution.t[-1]), at(solution.t[-1])
        self.mode = self.mode._replace(heading=0)
        if solution.status == 1:
            next(
                action
                for (_, action), times in zip(watched, solution.t_events or [], strict=True)
                if len(times)
            )()

    def _unknowns(self, state: _Floats) -> _Floats:
        unknowns: _Floats = state / np.array([self.loading.initial_gap, 1.0, FLUX, 1.0, 1.0])
        if self.film is not None:
            unknowns[0] = math.log(unknowns[0])
        return unknowns

    def _sizes(self) -> _Floats:
        """Sizes below which relative errors of the unknowns do not count."""
        return np.array([1.0, max(1e-3 * abs(self.state[1]), 1e-6), 1e-3, 1e-3, 1e-6])

    def _watched(self) -> list[tuple[_Watch, Callable[[], None]]]:
        """What may end a piece, and what to do then."""
        found: list[tuple[_Watch, Callable[[], None]]] = []
        if self.mode.in_contact:
            found.append((watch(self._leaving, 1), self._leave))
        else:
            for mark, way in self._marks():
                level = self._unknowns(np.array([mark, 0.0, 0.0, 0.0, 0.0]))[0]
                found.append((crossing(level, way), partial(self._arrive, mark, way)))
        if self.faces is not None and self._depth() > 0.0:
            turns = watch(lambda time, unknowns: float(unknowns[1]), -1 if self.pressing else 1)
            found.append((turns, self._turn))
        if self.valve is not None and self.applied <= 0.0 and not self.mode.blocked:
            found.append((watch(lambda time, unknowns: float(unknowns[2]), -1), self._block))
        return found

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
        """Remember the deepest point of rough faces, which decides their way out."""
        self.pressing = not self.pressing
        if self.valve is not None and self.faces is not None:
            gap, before = float(self.state[0]), self.mode.largest
            _, depth = law.rough_stop_force(self.valve.stop, self.faces, before, gap, 0.0)
            self.mode = self.mode._replace(largest=max(before, min(depth, self.faces.most)))

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
        if film is not None and mark == film.end:
            self.mode = self.mode._replace(broken=True)
            self._note("film breaks")

    def _fall(self, mark: float) -> None:
        fraction = self.plan.scene.meniscus.rewetting
        dry = self.mode.broken and mark <= self.loading.initial_gap
        if dry and fraction > 0.0 and self.plan.film_with(fraction).end > mark:
            self.mode = self.mode._replace(broken=False, volume_fraction=fraction)
            self._note("film wets again")
        if mark == self.loading.rest_gap:
            self._note("meets the end cap")
            self.mode = self.mode._replace(in_contact=True)
            self.state[1] = 0.0
