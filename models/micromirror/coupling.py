r"""Mirror and tips, coupled step by step: the mirror here, each side's tips wherever they live.

In each communication step the mirror first looks ahead with the force of the tips it knows; the
roots of the tips are led to where that puts them; the tips answer with the impulse they gave
their roots; and the mirror repeats the step with that impulse, as a force that changes steadily.
Momentum is exchanged without loss, nothing is rolled back, and the error falls with the square
of the step or faster. The film never crosses the interface, only the spring of the tip does: a
step is stable below :math:`2\sqrt{I/(n k a^2)}` however stiff the film is, and `couple` refuses
half of that and more.

The voltages jump only between steps: the grid of communication points is cut at each of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Generic, NamedTuple, Protocol, TypeVar

from attrs import frozen

from ...errors import DescriptionError, InfeasibleError
from ...separation.plan import Plan
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
from .tip import TipState, TipStop, advance_tip, film_force, tip_force

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = [
    "FmuTip",
    "LocalTip",
    "Motion",
    "RootForce",
    "Tip",
    "TipSides",
    "TipSignals",
    "couple",
    "longest_step",
    "mirror_step",
]

SIGNALS = (
    "time",
    "tilt",
    "rate",
    "volts_plus",
    "volts_minus",
    "gap_plus",
    "gap_minus",
    "force_plus",
    "force_minus",
    "film_plus",
    "film_minus",
    "state_plus",
    "state_minus",
)
"""What `couple` records; SI units, forces of all tips of a side, films of one tip."""

LANDED, HELD, FREE = 1.0, 2.0, 3.0  # floats, as columns of results are
"""State of a tip: on its site, off it but within reach of its forces, and free."""


class RootForce(NamedTuple):
    """Force of the tips of a side on their roots in a communication step [N]."""

    mean: float
    """Impulse over the length of the step."""
    last: float
    """At the end of the step."""


class TipSignals(NamedTuple):
    """Signals of the tips of a side, as they are recorded."""

    gap: float
    """Under a tip [m]."""
    force: float
    """Of all tips on their roots [N]."""
    film: float
    """Force of the film of one tip [N]."""
    state: float
    """`LANDED`, `HELD` or `FREE`."""


class Tip(Protocol):
    """The tips of one side, as the mirror sees them."""

    def step(self, root: Root, dt: float) -> RootForce:
        """Advance while the root moves on."""

    def read(self, height: float, speed: float) -> TipSignals:
        """Signals now."""


T_co = TypeVar("T_co", bound=Tip, covariant=True)


class TipSides(NamedTuple, Generic[T_co]):
    """Tips of both sides of a mirror."""

    plus: T_co
    minus: T_co


class FmuInstance(Protocol):
    """FMU instance as `FmuTip` uses it, such as `contactkit.fmu.framework.instance.Instance`."""

    def references(self, *names: str) -> list[int]:
        """Value references of variables."""

    def set(self, references: list[int], values: list[float]) -> None:
        """Set real inputs."""

    def get(self, references: list[int]) -> list[float]:
        """Read real outputs."""

    def get_integers(self, references: list[int]) -> list[int]:
        """Read whole numbers."""

    def step(self, time: float, length: float) -> None:
        """Take a communication step."""


class LocalTip:
    """Tips in this process: equal ones, so that one of them is stepped."""

    def __init__(
        self, plan: Plan, damping: float, count: int, state: TipState, stop: TipStop | None = None
    ) -> None:
        self.plan, self.damping, self.count, self.state = plan, damping, count, state
        self.stop = stop

    def step(self, root: Root, dt: float) -> RootForce:
        """See `Tip.step`."""
        before, there = self.state, root.after(dt)
        self.state = advance_tip(self.plan, self.damping, before, root, dt, self.stop)
        mean = self.count * (self.state.impulse - before.impulse) / dt
        return RootForce(mean, self.read(there.height, there.speed).force)

    def read(self, height: float, speed: float) -> TipSignals:
        """See `Tip.read`."""
        state = self.state
        force = self.count * tip_force(self.plan, self.damping, state, height, speed)
        return TipSignals(state.gap, force, film_force(self.plan, state), state_of(state))


class FmuTip:
    """Tips in an FMU ``tip-contact``, started."""

    def __init__(self, instance: FmuInstance) -> None:
        self.fmu = instance
        self._inputs = instance.references("z", "vz", "az")
        self._forces = instance.references("F_mean", "F")
        self._seen = instance.references("h", "F", "F_film")
        self._state = instance.references("state")

    def step(self, root: Root, dt: float) -> RootForce:
        """See `Tip.step`."""
        self.fmu.set(self._inputs, [root.height, root.speed, root.acceleration])
        self.fmu.step(root.time, dt)
        mean, last = self.fmu.get(self._forces)
        return RootForce(mean, last)

    def read(self, height: float, speed: float) -> TipSignals:
        """See `Tip.read`."""
        self.fmu.set(self._inputs, [height, speed, 0.0])
        gap, force, film = self.fmu.get(self._seen)
        return TipSignals(gap, force, film, float(self.fmu.get_integers(self._state)[0]))


def state_of(state: TipState) -> float:
    """Tell whether a tip is on its site, is held by its film, or is free."""
    if state.on_site:
        return LANDED
    return FREE if state.free else HELD


@frozen(eq=False)
class Motion:
    """Signals over time by the names of `SIGNALS`, and the number of steps."""

    signals: Mapping[str, NDArray[np.float64]]
    n_steps: int

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """Return the signal of a name."""
        return self.signals[name]


def longest_step(mirror: Mirror, tip_stiffness: float) -> float:
    """Longest communication step [s] with which bent tips and mirror are stable."""
    tips = mirror.tips
    return 2.0 * math.sqrt(mirror.hinge.inertia / (tips.per_side * tip_stiffness)) / tips.arm


def mirror_step(
    mirror: Mirror,
    tilt: float,
    rate: float,
    volts: Volts,
    force: float,
    slope: float,
    dt: float,
) -> Attitude:
    """Tilt and rate after a time, under a force of the tips that changes steadily.

    `force` [N] is that of the side + less that of the side - at the start, `slope` its rate
    [N/s]. Classical Runge-Kutta: a step is a thousandth of the mirror's own period, and its error
    nothing beside that of the coupling.
    """

    def pull(time: float, angle: float, speed: float) -> float:
        return acceleration(mirror, angle, speed, volts, force + slope * time)

    half = 0.5 * dt
    a1 = pull(0.0, tilt, rate)
    r2 = rate + half * a1
    a2 = pull(half, tilt + half * rate, r2)
    r3 = rate + half * a2
    a3 = pull(half, tilt + half * r2, r3)
    r4 = rate + dt * a3
    a4 = pull(dt, tilt + dt * r3, r4)
    moved = tilt + dt * (rate + 2.0 * (r2 + r3) + r4) / 6.0
    return Attitude(moved, rate + dt * (a1 + 2.0 * (a2 + a3) + a4) / 6.0)


def couple(
    mirror: Mirror,
    tips: TipSides[Tip],
    tip_stiffness: float,
    start: Attitude,
    stop_time: float,
    step: float,
    *,
    until: Callable[[float, float], bool] | None = None,
    progress: Callable[[float], None] | None = None,
) -> Motion:
    """Couple a mirror to its tips from time 0.

    Parameters
    ----------
    mirror : Mirror
    tips : TipSides
        At their state of the start.
    tip_stiffness : float
        Stiffness of one tip [N/m], for the check of the step.
    start : Attitude
        Tilt and rate at the start.
    stop_time, step : float
        Where to end, and the longest communication step [s].
    until : callable, optional
        Called with time and tilt after each step; ends the run when true.
    progress : callable, optional
        Called with the fraction of the time that is done.

    Raises
    ------
    InfeasibleError
        If the step is too long to be stable, or the plate meets its electrode.
    DescriptionError
        If a time is not positive and finite.
    """
    import numpy as np

    for name, value in (("stop_time", stop_time), ("step", step)):
        if not (math.isfinite(value) and value > 0.0):
            raise DescriptionError(name, value, "be positive and finite", unit="s")
    longest = longest_step(mirror, tip_stiffness)
    if step > 0.5 * longest:
        raise InfeasibleError(
            f"the communication step of {step:g} s exceeds half of {longest:.3g} s = 2 sqrt(I/(n k "
            "a^2)), the longest with which the spring tips can be coupled to the mirror; take a "
            "tenth of that"
        )
    points = _points(mirror, stop_time, step)
    (tilt, rate), slope = start, 0.0
    rows = [_row(mirror, tips, points[0], tilt, rate)]
    for i, (time, end) in enumerate(pairwise(points)):
        tilt, rate, slope = _exchange(mirror, tips, (time, end), tilt, rate, rows[-1], slope)
        rows.append(_row(mirror, tips, end, tilt, rate))
        if until is not None and until(end, tilt):
            break
        if progress is not None and i % 200 == 0:
            progress(end / stop_time)
    table = np.array(rows).T
    return Motion(dict(zip(SIGNALS, table, strict=True)), len(rows) - 1)


def _points(mirror: Mirror, stop_time: float, step: float) -> list[float]:
    """Communication points, equal steps between one jump of a voltage and the next."""
    marks = [0.0, *switching_times(mirror.waveform, 0.0, stop_time), stop_time]
    points = [0.0]
    for low, high in pairwise(marks):
        n = max(1, math.ceil((high - low) / step - 1e-9))
        points += [low + (high - low) * i / n for i in range(1, n)] + [high]
    return points


def _exchange(
    mirror: Mirror,
    tips: TipSides[Tip],
    span: tuple[float, float],
    tilt: float,
    rate: float,
    row: Sequence[float],
    slope: float,
) -> tuple[float, float, float]:
    """One communication step: the mirror ahead, the tips after it, the mirror for good."""
    time, end = span
    dt = end - time
    volts = electrode_volts(mirror.waveform, 0.5 * (time + end))
    known = row[SIGNALS.index("force_plus")] - row[SIGNALS.index("force_minus")]
    # Gauss-Seidel with an extrapolated start: the tips get a parabola through the roots' height and
    # speed now and the height ahead, so that the error falls with the square of the step.
    ahead, _ = mirror_step(mirror, tilt, rate, volts, known, slope, dt)
    mean = last = 0.0
    for tip, side in zip(tips, (1.0, -1.0), strict=True):
        height, speed = _root(mirror, tilt, rate, side)
        travel = root_height(mirror.tips, ahead, side) - height
        found = tip.step(Root(height, speed, 2.0 * (travel / dt - speed) / dt, time), dt)
        mean, last = mean + side * found.mean, last + side * found.last
    # A straight line with the impulse that was given, and as steep as the force changed.
    slope = (last - known) / dt
    return *mirror_step(mirror, tilt, rate, volts, mean - 0.5 * slope * dt, slope, dt), slope


def _row(mirror: Mirror, tips: TipSides[Tip], time: float, tilt: float, rate: float) -> list[float]:
    plus, minus = (
        tip.read(*_root(mirror, tilt, rate, side))
        for tip, side in zip(tips, (1.0, -1.0), strict=True)
    )
    volts = electrode_volts(mirror.waveform, time)
    pairs = [value for pair in zip(plus, minus, strict=True) for value in pair]
    return [time, tilt, rate, *volts, *pairs]


def _root(mirror: Mirror, tilt: float, rate: float, side: float) -> tuple[float, float]:
    """Height [m] and speed [m/s] of the roots of a side."""
    return root_height(mirror.tips, tilt, side), -side * mirror.tips.arm * math.cos(tilt) * rate
