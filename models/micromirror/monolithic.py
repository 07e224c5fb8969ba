r"""Monolithic model of mirror, tips and films, by another method than their co-simulation.

The tilt, its rate, and gap and speed of a tip on each side are the unknowns of one set of
equations, those at the heads of `contactkit.models.micromirror.mirror` and
`contactkit.models.micromirror.tip`; while a film acts, its gap is written as a logarithm. scipy
integrates from one event to the next, by Radau (implicit, order 5) where a film acts and DOP853
(explicit, order 8) where none does. Events are voltages that jump, a tip that leaves its site, a
film that breaks, a tip that lands.
Laws are shared with the coupling; unknowns, stepping, search for events and the communication
step are not, so that an agreement says something about both.

On rough landing sites an impact is integrated as a piece of its own, with the law of
`contactkit.models.micromirror.tip_impact`.

Validity: as the laws themselves; the numerical error is about `rtol`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from ...errors import ConvergenceError
from ...separation.plan import Film, Plan
from ..ode_events import watch
from .coupling import FREE, HELD, LANDED
from .flight import Root
from .mirror import (
    Attitude,
    Mirror,
    Volts,
    acceleration,
    electrode_volts,
    root_height,
    switching_times,
)
from .tip import TipStop, free_gap
from .tip_impact import Contact, rebound_work, rest_depth

__all__ = ["SIDES", "Event", "MonolithicMotion", "simulate_monolithic"]

SIDES = (1.0, -1.0)  # of the hinge, by the sign of the tilt that lands there
STRIKES = 1.5
"""State of a tip beside `LANDED`, `HELD` and `FREE`: in an impact on its site."""
# Pieces of the motion between events: a tip that bounces ever faster would go on for ever.
_MOST_PIECES = 10_000
_Floats = NDArray[np.float64]


class Event(NamedTuple):
    """An event: time [s], side (+1 or -1), and ``leaves``, ``breaks``, ``is free`` or ``lands``."""

    time: float
    side: float
    what: str


class MonolithicMotion(NamedTuple):
    """Result of a monolithic run: tilt [rad] and rate [rad/s] and gaps [m] at times, and events.

    `unknowns` has the rows tilt, rate, gap and speed of the tip of side +, and of side -.
    """

    time: _Floats
    unknowns: _Floats
    events: tuple[Event, ...]
    n_steps: int
    n_evaluations: int

    def first(self, what: str, side: float = 1.0) -> float:
        """Time of the first event of a kind on a side [s]; nan if there is none."""
        return next((e.time for e in self.events if (e.what, e.side) == (what, side)), math.nan)


class _Integration:
    """Integration by events; `state` is tilt, rate, gap +, speed +, gap -, speed - in SI."""

    def __init__(self, mirror: Mirror, plan: Plan, start: Attitude, rtol: float) -> None:
        loading = plan.scene.imposed_force
        self.mirror, self.plan, self.rtol = mirror, plan, rtol
        self.origin, self.stiffness = loading.initial_gap, loading.stiffness
        self.mass, self.damping = loading.moving_mass, mirror.tips.damping
        far = self.origin + root_height(mirror.tips, start[0], -1.0)
        self.state = np.array([*start, self.origin, 0.0, far, 0.0])
        self.modes, self.broken = [LANDED, FREE], [False, True]
        self.volts = Volts(0.0, 0.0)
        self.time = 0.0
        self.pieces: list[tuple[_Floats, Callable[[_Floats], _Floats]]] = []
        self.events: list[Event] = []
        self.n_steps = self.n_evaluations = 0

    def to(self, start: float, stop: float) -> None:
        """Integrate from one jump of a voltage to the next."""
        self.time = start
        self.volts = electrode_volts(self.mirror.waveform, 0.5 * (start + stop))
        while self.time < stop:
            self._leave_if_pulled()
            self._piece(stop)
            if len(self.pieces) > _MOST_PIECES:
                raise ConvergenceError(
                    f"events follow each other without end at {self.time:g} s: tips land and leave "
                    "again; end earlier, or give their sites more SpringTips.landing_damping"
                )

    # equations --------------------------------------------------------------------------------

    def _tip_force(self, side: int, state: Any) -> tuple[float, float]:
        """Force of one tip on its root [N], and the speed of the root [m/s]."""
        tips, tilt, rate = self.mirror.tips, state[0], state[1]
        gap, speed = state[2 + 2 * side], state[3 + 2 * side]
        height = root_height(tips, tilt, SIDES[side])
        moving = -SIDES[side] * tips.arm * math.cos(tilt) * rate
        force = self.stiffness * (self.origin + height - gap)
        if self.modes[side] == FREE:
            force += self.damping * (moving - speed)
        return force, moving

    def _rates(self, _time: float, unknowns: _Floats) -> list[float]:
        state = self._in_si(unknowns)
        forces = [self._tip_force(side, state)[0] for side in (0, 1)]
        total = self.mirror.tips.per_side * (forces[0] - forces[1])
        found = [state[1], acceleration(self.mirror, state[0], state[1], self.volts, total)]
        for side, force in enumerate(forces):
            found += self._tip_rates(side, state, force)
        return found

    def _tip_rates(self, side: int, state: Any, force: float) -> list[float]:
        gap, speed = state[2 + 2 * side], state[3 + 2 * side]
        if self.modes[side] == LANDED:
            return [0.0, 0.0]
        if self.modes[side] == FREE:
            return [speed, force / self.mass]
        film = self._film(side)
        holding = film.force(gap, speed) if film is not None else 0.0
        return [speed / gap, (force - holding) / self.mass]

    def _film(self, side: int) -> Film | None:
        return self.plan.remaining_film(1.0, broken=self.broken[side], detached=False)

    def _in_si(self, unknowns: _Floats) -> list[float]:
        state: list[float] = unknowns.tolist()
        for side, mode in enumerate(self.modes):
            if mode == HELD:
                state[2 + 2 * side] = self.origin * math.exp(state[2 + 2 * side])
        return state

    def _unknowns(self) -> _Floats:
        unknowns: _Floats = self.state.copy()
        for side, mode in enumerate(self.modes):
            if mode == HELD:
                unknowns[2 + 2 * side] = math.log(unknowns[2 + 2 * side] / self.origin)
        return unknowns

    # one piece --------------------------------------------------------------------------------

    def _piece(self, stop: float) -> None:
        watched = [found for side in (0, 1) for found in self._watched(side)]
        # A tip that swings could dip to its site and be gone again between two long steps.
        swing = math.sqrt(self.mass / self.stiffness)
        sizes = [1e-3, 1e3, 1e-9, 1e-2, 1e-9, 1e-2]
        for side, mode in enumerate(self.modes):
            sizes[2 + 2 * side] = 1e-3 if mode == HELD else 1e-9
        method: dict[str, Any] = {"method": "Radau" if HELD in self.modes else "DOP853"}
        solution = solve_ivp(
            self._rates,
            (self.time, stop),
            self._unknowns(),
            dense_output=True,
            events=[watch for watch, _ in watched] or None,
            rtol=self.rtol,
            atol=self.rtol * np.array(sizes),
            max_step=2.0 * swing,
            **method,
        )
        if not solution.success or solution.sol is None:
            raise ConvergenceError(
                f"scipy stopped at {self.time:g} s: {solution.message} Use a larger rtol"
            )
        self.n_steps += len(solution.t) - 1
        self.n_evaluations += solution.nfev
        at = partial(_at, solution.sol, self.origin, tuple(self.modes))
        self.pieces.append((solution.t, at))
        self.time, self.state = float(solution.t[-1]), at(solution.t[-1:])[:, 0]
        if solution.status == 1:
            for (_, action), found in zip(watched, solution.t_events or [], strict=True):
                if len(found):
                    action()
                    return

    def _watched(self, side: int) -> list[tuple[Any, Callable[[], None]]]:
        place, mode = 2 + 2 * side, self.modes[side]
        if mode == LANDED:
            return [(watch(partial(self._excess, side), 1), partial(self._leave, side))]
        logarithmic = mode == HELD
        floor = 0.0 if logarithmic else self.origin
        found: list[tuple[Any, Callable[[], None]]] = [
            (watch(lambda _, y: float(y[place] - floor), -1), partial(self._land, side))
        ]
        if logarithmic and not self.broken[side] and math.isfinite(self.plan.film.end):
            found.append(self._rising(side, self.plan.film.end, self._break))
        elif logarithmic:
            found.append(self._rising(side, free_gap(self.plan), self._free))
        return found

    def _rising(self, side: int, gap: float, act: Callable[[int], None]) -> tuple[Any, Any]:
        place, level = 2 + 2 * side, math.log(gap / self.origin)
        return watch(lambda _, y: float(y[place] - level), 1), partial(act, side)

    # events -----------------------------------------------------------------------------------

    def _excess(self, side: int, _time: float, unknowns: _Floats) -> float:
        """Force [N] that would lift a landed tip off its site."""
        force, _ = self._tip_force(side, self._in_si(unknowns))
        film = self._film(side)
        return force - (film.static_force(self.origin) if film is not None else 0.0)

    def _leave_if_pulled(self) -> None:
        """A voltage that jumps does not move a tip; one that landed pulled leaves again."""
        for side, mode in enumerate(self.modes):
            if mode == LANDED and self._excess(side, self.time, self._unknowns()) > 0.0:
                self._leave(side)

    def _note(self, side: int, what: str) -> None:
        self.events.append(Event(self.time, SIDES[side], what))

    def _leave(self, side: int) -> None:
        self.modes[side] = HELD
        self._note(side, "leaves")

    def _break(self, side: int) -> None:
        self.broken[side] = True
        self.state[2 + 2 * side] = self.plan.film.end
        self._note(side, "breaks")
        if free_gap(self.plan) <= self.plan.film.end:
            self._free(side)

    def _free(self, side: int) -> None:
        self.modes[side] = FREE
        self.state[2 + 2 * side] = free_gap(self.plan)
        self._note(side, "is free")

    def _land(self, side: int) -> None:
        self.modes[side], self.broken[side] = LANDED, False
        self.state[2 + 2 * side : 4 + 2 * side] = self.origin, 0.0
        self._note(side, "lands")

    def result(self, times: _Floats | None) -> MonolithicMotion:
        """Read the unknowns off the pieces."""
        if times is None:
            time = np.concatenate([t for t, _ in self.pieces])
            table = np.concatenate([at(t) for t, at in self.pieces], axis=1)
        else:
            time = np.asarray(times, dtype=np.float64)
            ends = np.array([t[-1] for t, _ in self.pieces])
            which = np.minimum(np.searchsorted(ends, time), len(ends) - 1)
            table = np.empty((6, len(time)))
            for i in np.unique(which):
                table[:, which == i] = self.pieces[i][1](time[which == i])
        return MonolithicMotion(time, table, tuple(self.events), self.n_steps, self.n_evaluations)


class _IntegrationWithImpacts(_Integration):
    """The same with impacts on rough sites; gaps count from the residual indentation, see `tip`."""

    def __init__(
        self, mirror: Mirror, plan: Plan, start: Attitude, rtol: float, stop: TipStop
    ) -> None:
        super().__init__(mirror, plan, start, rtol)
        self.stop = stop
        self.indentations, self.largest = [0.0, 0.0], [0.0, 0.0]
        self.sinking = [False, False]
        self.peak = 0.0

    def _root(self, side: int, state: Any) -> tuple[float, float]:
        """Height [m] and speed [m/s] of the root of a side."""
        tips, tilt, rate = self.mirror.tips, state[0], state[1]
        speed = -SIDES[side] * tips.arm * math.cos(tilt) * rate
        return root_height(tips, tilt, SIDES[side]), speed

    def _contact(self, side: int, state: Any) -> Contact:
        film = self._film(side)
        held = film.static_force(self.origin) if film is not None else 0.0
        height, _ = self._root(side, state)
        return Contact(self.stop, held, self.stiffness, self.mass, Root(height))

    def _depth(self, side: int, state: Any) -> float:
        """Approach of a tip on its site [m], or the residual indentation under one off it."""
        if self.modes[side] == LANDED:
            return rest_depth(self._contact(side, state), self.largest[side], 0.0)
        if self.modes[side] == STRIKES:
            return float(self.indentations[side] + self.origin - state[2 + 2 * side])
        return self.indentations[side]

    def _tip_force(self, side: int, state: Any) -> tuple[float, float]:
        height, moving = self._root(side, state)
        mode, gap, speed = self.modes[side], state[2 + 2 * side], state[3 + 2 * side]
        if mode in (LANDED, STRIKES):
            return self.stiffness * (height + self._depth(side, state)), moving
        force = self.stiffness * (self.origin + height + self.indentations[side] - gap)
        return force + (self.damping * (moving - speed) if mode == FREE else 0.0), moving

    def _site_force(self, side: int, depth: float, speed: float) -> float:
        """Force of the site on a tip [N] that comes at a speed [m/s]."""
        if depth <= 0.0:
            return 0.0
        force = self.stop.curve.force_at(depth, self.largest[side])[0]
        return force * max(1.0 + self.stop.damping * speed, 0.0)

    def _tip_rates(self, side: int, state: Any, force: float) -> list[float]:
        if self.modes[side] != STRIKES:
            return super()._tip_rates(side, state, force)
        speed, held = state[3 + 2 * side], self._contact(side, state).attraction
        pushed = self._site_force(side, self._depth(side, state), -speed)
        return [speed, (force - held + pushed) / self.mass]

    # events -----------------------------------------------------------------------------------

    def _watched(self, side: int) -> list[tuple[Any, Callable[[], None]]]:
        place = 2 + 2 * side
        if self.modes[side] == STRIKES:
            out = (
                self.origin + self.indentations[side] - self.stop.curve.residual(self.largest[side])
            )
            if self.sinking[side]:
                return [(watch(lambda _, y: float(y[place + 1]), 1), partial(self._turn, side))]
            return [
                (watch(lambda _, y: float(y[place + 1]), -1), partial(self._sink, side)),
                (watch(lambda _, y: float(y[place] - out), 1), partial(self._bounce, side)),
            ]
        found = super()._watched(side)
        if self.modes[side] == LANDED:
            way = 1 if self.sinking[side] else -1
            lowest = watch(lambda _, y: self._root(side, y)[1], way)
            found.append((lowest, partial(self._reverse, side)))
        return found

    def _excess(self, side: int, _time: float, unknowns: _Floats) -> float:
        state = self._in_si(unknowns)
        contact = self._contact(side, state)
        lifted = contact.root.height + self.stop.curve.residual(self.largest[side])
        return self.stiffness * lifted - contact.attraction

    def _leave_if_pulled(self) -> None:
        for side, mode in enumerate(self.modes):
            if mode == LANDED:
                self._press(side)
        super()._leave_if_pulled()

    def _reverse(self, side: int) -> None:
        """The root turns: it was lowest, or is about to press deeper."""
        self.sinking[side] = not self.sinking[side]
        self._press(side)

    def _press(self, side: int) -> None:
        """Remember how deep a resting tip has sunk."""
        self._indent(side, self._depth(side, self.state))

    def _sink(self, side: int) -> None:
        """A rebounding tip is pressed back before it is off the site."""
        self.sinking[side] = True

    def _indent(self, side: int, depth: float) -> None:
        self.peak = max(self.peak, self._site_force(side, depth, 0.0))
        self.largest[side] = max(self.largest[side], depth)
        self.indentations[side] = self.stop.curve.residual(self.largest[side])

    def _land(self, side: int) -> None:
        self.modes[side], self.broken[side] = STRIKES, False
        self.state[2 + 2 * side] = self.origin
        self.sinking[side] = True
        self._note(side, "lands")
        if self.state[3 + 2 * side] >= 0.0:
            self._settle(side)

    def _settle(self, side: int) -> None:
        self.modes[side] = LANDED
        self.sinking[side] = self._root(side, self.state)[1] < 0.0
        self.state[2 + 2 * side : 4 + 2 * side] = self.origin, 0.0
        self._note(side, "rests")

    def _turn(self, side: int) -> None:
        """At the deepest point: remember it, and rest if there is not the energy to come out."""
        depth, contact = self._depth(side, self.state), self._contact(side, self.state)
        self.sinking[side] = False
        self._indent(side, depth)
        out = self.indentations[side]
        self.state[2 + 2 * side : 4 + 2 * side] = self.origin + out - depth, 0.0
        back = rebound_work(self.stop.curve, depth, self.largest[side])
        pressed = contact.attraction - self.stiffness * (contact.root.height + 0.5 * (depth + out))
        if back <= pressed * (depth - out):
            self._settle(side)

    def _bounce(self, side: int) -> None:
        self.modes[side] = HELD
        self.state[2 + 2 * side] = self.origin
        self.indentations[side] = self.stop.curve.residual(self.largest[side])
        self._note(side, "bounces")


def _at(
    solution: Callable[[_Floats], _Floats],
    origin: float,
    modes: tuple[float, ...],
    times: _Floats,
) -> _Floats:
    """Unknowns of a piece at times, in SI."""
    table: _Floats = np.array(solution(times), dtype=np.float64)
    for side, mode in enumerate(modes):
        if mode == HELD:
            table[2 + 2 * side] = origin * np.exp(table[2 + 2 * side])
    return table


def simulate_monolithic(
    mirror: Mirror,
    plan: Plan,
    start: Attitude,
    stop_time: float,
    *,
    rtol: float = 1e-9,
    times: _Floats | None = None,
    stop: TipStop | None = None,
) -> MonolithicMotion:
    """Integrate mirror and tips from time 0, the side + landed and the side - free.

    Parameters
    ----------
    mirror : Mirror
    plan : Plan
        Film of one tip; mass and stiffness of its `ImposedForce` are those of the tip.
    start : (float, float)
        Tilt [rad] and rate [rad/s] at the start.
    stop_time : float
        Where to end [s].
    rtol : float
        Tolerance of the solver, relative to each unknown.
    times : ndarray, optional
        Where to give the unknowns [s]. None: at the steps of the solver.
    stop : TipStop, optional
        Rough site of a tip; without one it lands for good on a rigid site.

    Raises
    ------
    ConvergenceError
        If the solver gives up.
    """
    if stop is None:
        run = _Integration(mirror, plan, start, rtol)
    else:
        run = _IntegrationWithImpacts(mirror, plan, start, rtol, stop)
    marks = [0.0, *switching_times(mirror.waveform, 0.0, stop_time), stop_time]
    for low, high in pairwise(marks):
        run.to(low, high)
    return run.result(times)
