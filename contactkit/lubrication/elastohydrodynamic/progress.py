"""Progress of a motion: steps that end at the times asked for, and the rupture of a whole film.

The liquid ruptures at a tension that may exceed that of a cavity. Until then no cavity opens; the
instant is located, and from there on the pressure of the cavity is the floor, until the last void
is filled again.
"""

from __future__ import annotations

import abc
import math
from collections.abc import Sequence
from typing import Any, ClassVar, Generic, TypeVar

from ...numerics.roots import bracketed_root
from .step import StepFailedError

__all__ = ["Progress"]

S = TypeVar("S")  # state: a named tuple with time, fields and ruptured
T = TypeVar("T")  # a step that was solved

_SHORTEST = 1e-10  # step over the whole span, below which there is none


class Progress(abc.ABC, Generic[S, T]):
    """Progress of a motion, by steps that a kind of bodies solves.

    Parameters
    ----------
    start : named tuple
        State at the first time.
    times : sequence of float
        Ascending.
    control : Control or MapControl
        Tolerance, first step and strength of the film.
    floor : float
        Pressure of a cavity.
    """

    located: ClassVar[float]
    """Where in a step the film ruptures, of its length: how exactly it is found."""
    after_rupture: ClassVar[float]
    """Step after a rupture over that before it: the pressures jump."""

    def __init__(self, start: S, times: Sequence[float], control: Any, floor: float) -> None:
        self.control, self.floor = control, floor
        self.state: Any = start
        self.every_step, self.until = False, math.inf
        self.kept, self.ruptures = [start], list[float]()
        self.span = times[-1] - times[0]
        self.length = control.first * self.span

    @property
    def waits(self) -> bool:
        """Whether the film is whole, and stronger than a cavity."""
        return -self.control.strength < self.floor and not self.state.ruptured

    @property
    def is_over(self) -> bool:
        """Whether the gap has reached its end."""
        return bool(self.state.fields.rigid_gap >= self.until)

    def go_through(self, times: Sequence[float]) -> None:
        """Step to each of the times, or to the end."""
        for time in times:
            self._go_to(time)
            if self.is_over:
                return

    def _go_to(self, time: float) -> None:
        """Step until a time or the end; keep its state."""
        near = 0.1 * _SHORTEST * self.span  # sums of steps meet it but for round-off
        while time - self.state.time > near and not self.is_over:
            left = time - self.state.time
            cut = self.length >= left * (1.0 - 1e-9)
            # Two steps rather than one and a tiny rest.
            length = left if cut else min(self.length, max(0.5 * left, 0.1 * self.length))
            if length < _SHORTEST * self.span:
                raise StepFailedError(f"no step can be solved at t = {self.state.time:g}")
            accepted = self._try(length, self.length if cut else 0.0)
            if accepted and self.every_step and not (cut or self.is_over):
                self._keep()
        if not self.is_over:
            self.state = self.state._replace(time=time)
        self._keep()

    def _keep(self) -> None:
        """Keep the state of now among those of the result."""
        self.kept.append(self.state)

    def _ruptures(self, solved: T) -> bool:
        """Whether the tension exceeds the strength of a whole film at the end of a step."""
        return self.waits and self._lowest(solved) < -self.control.strength

    def _rupture(self, length: float) -> None:
        """Step up to the instant at which the tension reaches the strength."""

        def excess(share: float) -> float:
            lowest = float(self.state.fields.pressure.min())
            if share > 0.0:
                lowest = self._lowest(self._solve(share * length))
            return float(-self.control.strength - lowest)

        share = bracketed_root(excess, 0.0, 1.0, self.located) if excess(0.0) < 0.0 else 0.0
        if share > self.located:
            self._accept(self._solve(share * length), share * length)
        self.ruptures.append(self.state.time)
        self.state = self.state._replace(ruptured=True)
        self._keep()
        self.length = self.after_rupture * length

    @abc.abstractmethod
    def _try(self, length: float, cut_from: float) -> bool:
        """Try a step, cut from a longer one or not (0); whether it was accepted.

        Sets the length of the next.
        """

    @abc.abstractmethod
    def _solve(self, length: float) -> T:
        """Solve a step from the state of now."""

    @abc.abstractmethod
    def _accept(self, solved: T, length: float) -> None:
        """Go on to the end of a step."""

    @abc.abstractmethod
    def _lowest(self, solved: T) -> float:
        """Lowest pressure at the end of a step."""
