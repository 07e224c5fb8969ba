"""A free spring tip about a root that is steadily accelerated: its swing, and where it lands.

Heights are over the place where an unbent tip just touches its landing site, positive upwards.
Plain floats only: this also runs inside an FMU.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ...errors import ConvergenceError
from ...numerics.roots import first_true

__all__ = ["Flight", "Root", "landing_time"]


_MOST_SWINGS = 62_500  # that are followed in one flight


class Root(NamedTuple):
    """Motion of the root: height [m] and speed [m/s] at a time [s], steady acceleration [m/s2]."""

    height: float
    speed: float = 0.0
    acceleration: float = 0.0
    time: float = 0.0

    def after(self, elapsed: float) -> Root:
        """Same motion, told from a later time."""
        speed = self.speed + self.acceleration * elapsed
        height = self.height + 0.5 * (self.speed + speed) * elapsed
        return Root(height, speed, self.acceleration, self.time + elapsed)

    def height_at(self, time: float) -> float:
        """Height [m] at a time [s]."""
        since = time - self.time
        return self.height + since * (self.speed + 0.5 * self.acceleration * since)


class Bend(NamedTuple):
    """Bend of a tip [m] and its rate [m/s]."""

    bend: float
    rate: float


class Flight(NamedTuple):
    """A free tip about its root: where it hangs [m], decay [1/s], frequency [rad/s], swing [m]."""

    rest: float
    decay: float
    frequency: float
    cosine: float
    sine: float

    def at(self, time: float) -> Bend:
        """Bend [m] and its rate [m/s] after a time [s]."""
        d, w = self.decay, self.frequency
        c, s, fade = math.cos(w * time), math.sin(w * time), math.exp(-d * time)
        swing = fade * (self.cosine * c + self.sine * s)
        rate = fade * w * (self.sine * c - self.cosine * s) - d * swing
        return Bend(self.rest + swing, rate)


def landing_time(flight: Flight, root: Root, left: float) -> float | None:
    """Time [s], at most `left`, after which a swinging tip first lands; None if it does not.

    Raises
    ------
    ConvergenceError
        If that time holds more than 62500 swings.

    Examples
    --------
    A tip that hangs still, under a root that comes down from 1 um at 1 m/s:

    >>> still = Flight(rest=0.0, decay=0.0, frequency=1e7, cosine=0.0, sine=0.0)
    >>> round(landing_time(still, Root(1e-6, -1.0), 2e-6) * 1e6, 9)
    1.0
    """
    swing = math.hypot(flight.cosine, flight.sine)
    lowest = min(0.0, root.speed, root.speed + root.acceleration * left) * left
    if root.height + lowest + flight.rest > swing:
        return None

    def over(time: float) -> float:
        return root.after(time).height + flight.at(time)[0]

    def lands(time: float) -> bool:
        return over(time) <= 0.0

    def sinks(time: float) -> float:
        return -root.after(time).speed - flight.at(time)[1]

    # A sixteenth of a swing at a time: between two of them there is at most one lowest point.
    swings = left * flight.frequency / (2.0 * math.pi)
    if not swings <= _MOST_SWINGS:
        raise ConvergenceError(
            f"a step of {left:.6g} s holds more than {_MOST_SWINGS} swings of a free tip; take "
            "shorter steps",
            root,
        )
    pieces = max(1, math.ceil(16.0 * swings))
    low, sinking, near = 0.0, sinks(0.0) > 0.0, 1e-16 * left
    i = 0
    while i < pieces:
        reach = swing * math.exp(-flight.decay * low)
        out = _out_of_reach(root.after(low), flight.rest - reach) * pieces / left
        if out >= 1.0:  # nothing lands in these pieces
            i += math.floor(min(out, pieces - i))
            low = left * i / pieces
            sinking = sinks(low) > 0.0
            continue
        i += 1
        high = left * i / pieces
        if over(high) <= 0.0 and (over(low) > 0.0 or sinking):
            return first_true(lands, low, high, atol=near)
        falls = sinks(high) > 0.0
        if sinking and not falls:  # the lowest point lies between
            bottom = first_true(lambda time: sinks(time) <= 0.0, low, high, atol=near)
            if over(bottom) <= 0.0:
                return first_true(lands, low, bottom, atol=near)
        low, sinking = high, falls
    return None


def _out_of_reach(root: Root, reach: float) -> float:
    """Time [s] for which a root stays higher than `-reach` [m], the farthest a tip swings down.

    Inf for good; the swing only decays, so that nothing lands before.

    Examples
    --------
    >>> _out_of_reach(Root(2.0, -1.0), -1.0)
    1.0
    >>> _out_of_reach(Root(2.0, -1.0, 0.5000001), -1.0)
    inf
    """
    above, speed, half = root.height + reach, root.speed, 0.5 * root.acceleration
    if above <= 0.0:
        return 0.0
    inside = speed * speed - 4.0 * half * above
    if inside < 0.0:
        return math.inf
    # The first positive root of above + speed t + half t^2, without cancellation.
    bottom = math.sqrt(inside) - speed
    return 2.0 * above / bottom if bottom > 0.0 else math.inf
