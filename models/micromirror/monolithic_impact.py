"""Mirror and tips as one system where the sites give: blows as pieces of their own.

The laws are those of `contactkit.models.micromirror.tip_impact`; unknowns, stepping
and search for events are those of `contactkit.models.micromirror.monolithic`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...separation.plan import Plan
from ..ode_events import watch
from .coupling import FREE, HELD, LANDED
from .flight import Root
from .mirror import Mirror, root_height
from .monolithic import SIDES, WholeRun
from .tip_impact import Contact, TipStop, rest_depth, sprung_back

__all__ = ["StopRun"]

STRIKES = 1.5
"""State of a tip beside `LANDED`, `HELD` and `FREE`: in a blow on its site."""

_Floats = NDArray[np.float64]


class StopRun(WholeRun):
    """A simulation on its way; gaps count from the dents, see `tip`."""

    def __init__(
        self, mirror: Mirror, plan: Plan, start: tuple[float, float], rtol: float, stop: TipStop
    ) -> None:
        super().__init__(mirror, plan, start, rtol)
        self.stop = stop
        self.dents, self.largest = [0.0, 0.0], [0.0, 0.0]
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
        """Approach of a tip that is on its site [m], or the dent under one that is off it."""
        if self.modes[side] == LANDED:
            return rest_depth(self._contact(side, state), self.largest[side], 0.0)
        if self.modes[side] == STRIKES:
            return float(self.dents[side] + self.origin - state[2 + 2 * side])
        return self.dents[side]

    def _tip_force(self, side: int, state: Any) -> tuple[float, float]:
        height, moving = self._root(side, state)
        mode, gap, speed = self.modes[side], state[2 + 2 * side], state[3 + 2 * side]
        if mode in (LANDED, STRIKES):
            return self.stiffness * (height + self._depth(side, state)), moving
        force = self.stiffness * (self.origin + height + self.dents[side] - gap)
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
            out = self.origin + self.dents[side] - self.stop.curve.residual(self.largest[side])
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
        self._dent(side, self._depth(side, self.state))

    def _sink(self, side: int) -> None:
        """A tip on its way out is pressed back before it is out."""
        self.sinking[side] = True

    def _dent(self, side: int, depth: float) -> None:
        self.peak = max(self.peak, self._site_force(side, depth, 0.0))
        self.largest[side] = max(self.largest[side], depth)
        self.dents[side] = self.stop.curve.residual(self.largest[side])

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
        self._dent(side, depth)
        out = self.dents[side]
        self.state[2 + 2 * side : 4 + 2 * side] = self.origin + out - depth, 0.0
        back = sprung_back(self.stop.curve, depth, self.largest[side])
        pressed = contact.attraction - self.stiffness * (contact.root.height + 0.5 * (depth + out))
        if back <= pressed * (depth - out):
            self._settle(side)

    def _bounce(self, side: int) -> None:
        self.modes[side] = HELD
        self.state[2 + 2 * side] = self.origin
        self.dents[side] = self.stop.curve.residual(self.largest[side])
        self._note(side, "bounces")
