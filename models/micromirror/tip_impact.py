r"""Impact of a spring tip on a deformable landing site: stepped in time, then at rest in contact.

.. math:: m\ddot d = A - k\,(z + d) - F(d, d_{max})\,\max(1 + c\,\dot d, 0)

with d the approach of apex and site from first touch, F their `LoadDisplacementCurve`, z the
height of the root, and A the attraction of film and solids, taken at its value at touch. An impact
ends where F vanishes and the tip rebounds; or the tip turns with less energy than a rebound takes,
and rests in equilibrium, the ringing dissipated at once. The site thus dissipates plastic work,
damping work, and that energy.

Errors: A as at touch misses some A d, a few per cent of an impact that matters. Left out: elastic
waves radiated into the tip. Plain floats only: this also runs inside an FMU.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import IntEnum
from itertools import pairwise
from typing import NamedTuple

from ...analyses.load_displacement.curve import LoadDisplacementCurve, area_below
from ...analyses.load_displacement.impact import in_series
from ...errors import ConvergenceError, InfeasibleError
from ...numerics.roots import bracketed_root
from ...numerics.step_size import StepSize
from .flight import Root

__all__ = [
    "Impact",
    "ImpactEnd",
    "Contact",
    "TipStop",
    "follow_impact",
    "rest_depth",
    "rebound_work",
]

_CONTROL = StepSize(order=5, grow=5.0, unsolved=0.1)
# Halvings of an unloading curve towards its end, in which its work is summed by Gauss' rule: the
# force ends there like a power 3/2 of the depth, and 2^-30 of the curve holds 1e-22 of the work.
_OUT_PIECES = 30

# Dormand and Prince, order 5 with an error of order 4.
_NODES = (0.2, 0.3, 0.8, 8.0 / 9.0, 1.0)
_ROWS = (
    (0.2,),
    (3.0 / 40.0, 9.0 / 40.0),
    (44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0),
    (19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0),
    (9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0),
)
_LAST = (35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0)
_ERROR = (
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
)

_Four = tuple[float, float, float, float]
_Rates = Callable[[float, _Four], _Four]


class TipStop(NamedTuple):
    """Site of one tip: curve of the faces, and damping over force [s/m]."""

    curve: LoadDisplacementCurve
    damping: float = 0.0


class Contact(NamedTuple):
    """A tip in contact: attraction [N], spring [N/m], mass [kg], and its root."""

    stop: TipStop
    attraction: float
    stiffness: float
    mass: float
    root: Root


class ImpactEnd(IntEnum):
    """End of an impact: by the end of the time, off the site, or at rest on it."""

    TIME = 1
    OUT = 2
    REST = 3


class Impact(NamedTuple):
    """State of an impact."""

    time: float
    depth: float
    """Approach [m]."""
    speed: float
    """Of approach [m/s]."""
    largest: float
    """Largest approach the faces have had, at a turning point [m]."""
    end: ImpactEnd = ImpactEnd.TIME
    impulse: float = 0.0
    """Of the spring [N.s]."""
    dissipated: float = 0.0
    """By plasticity, damping and ringing [J]."""
    peak: float = 0.0
    """Largest force of the site [N]."""
    n_steps: int = 0


def follow_impact(
    contact: Contact, begin: Impact, end: float, rtol: float, most_steps: int = 20_000
) -> Impact:
    """Follow an impact from a state until it is over, or to a time [s], in at most so many steps.

    Raises
    ------
    InfeasibleError
        If the faces are pressed beyond the end of their curve.
    ConvergenceError
        If no step meets the tolerance.
    """
    here, length = begin._replace(end=ImpactEnd.TIME), _first_length(contact, begin)
    for _ in range(most_steps):
        left = end - here.time
        if left <= 1e-15 * abs(end) or here.end is not ImpactEnd.TIME:
            return here
        rates = _rates_of(contact, here.largest)
        start = (here.depth, here.speed, 0.0, 0.0)
        length, reached, following = _accepted(rates, here.time, start, min(length, left), rtol)
        length, reached = _shortened(contact, rates, here, length, reached)
        here, length = _moved(contact, here, length, reached), following
        here = here._replace(n_steps=here.n_steps + 1)
    raise ConvergenceError(
        f"{most_steps} steps did not end an impact of a tip at {here.time:g} s; loosen "
        "Accuracy.time_rtol or raise Accuracy.max_steps",
        here,
    )


def rest_depth(contact: Contact, largest: float, time: float, near: float = 0.0) -> float:
    """Approach [m] of a tip that is pressed slowly, by its spring and what attracts it.

    Raises
    ------
    InfeasibleError
        If the faces are pressed beyond the end of their curve.
    """
    curve = contact.stop.curve
    together = contact.attraction / contact.stiffness - contact.root.height_at(time)
    _, faces = in_series(curve, together, largest, contact.stiffness, beyond=True, near=near)
    return _known(curve, max(faces, curve.residual(largest)), time)


def rebound_work(curve: LoadDisplacementCurve, depth: float, largest: float) -> float:
    """Elastic work [J] of unloading from an approach, after the maximum."""
    begin = curve.residual(largest)
    length = depth - begin
    if length <= 0.0:
        return 0.0
    edges = [length * 2.0**-i for i in range(_OUT_PIECES, -1, -1)]
    return sum(
        area_below(lambda s: curve.force_at(begin + s, largest), a, b) for a, b in pairwise(edges)
    )


def _known(curve: LoadDisplacementCurve, depth: float, time: float) -> float:
    if depth > curve.max_approach * (1.0 + 1e-12):
        raise InfeasibleError(
            f"at t = {time:.9g} s a tip is pressed {depth:.4g} m deep, beyond "
            f"{curve.max_approach:.4g} m and {curve.force[-1]:.4g} N where its curve ends; make it "
            "with a larger approach"
        )
    return min(depth, curve.max_approach)


def _rates_of(contact: Contact, largest: float) -> _Rates:
    """Rates of depth, speed, impulse of the spring, and work of the damping."""
    stop, attraction, stiffness, mass, root = contact
    force_at, damping = stop.curve.force_at, stop.damping

    def rates(time: float, state: _Four) -> _Four:
        depth, speed = state[0], state[1]
        spring = stiffness * (root.height_at(time) + depth)
        force = force_at(depth, largest)[0] if depth > 0.0 else 0.0
        held = force * max(1.0 + damping * speed, 0.0)
        return speed, (attraction - spring - held) / mass, spring, (held - force) * speed

    return rates


def _first_length(contact: Contact, begin: Impact) -> float:
    curve = contact.stop.curve
    slope = curve.force_at(begin.depth, begin.largest)[1] if begin.depth > 0.0 else 0.0
    swing = math.sqrt(contact.mass / (slope + contact.stiffness))
    reach = 0.1 * curve.approach[0] / abs(begin.speed) if begin.speed else math.inf
    return min(0.05 * swing, reach) if slope == 0.0 else 0.05 * swing


def _step(rates: _Rates, time: float, state: _Four, length: float) -> tuple[_Four, _Four]:
    """Take one step: where it ends, and its error."""
    slopes = [rates(time, state)]
    for node, row in zip(_NODES, _ROWS, strict=True):
        slopes.append(rates(time + node * length, _combined(state, slopes, row, length)))
    end = _combined(state, slopes, _LAST, length)
    slopes.append(rates(time + length, end))
    return end, _combined((0.0, 0.0, 0.0, 0.0), slopes, _ERROR, length)


def _combined(
    state: _Four, slopes: list[_Four], weights: tuple[float, ...], length: float
) -> _Four:
    a, b, c, d = state
    for weight, slope in zip(weights, slopes, strict=True):
        w = weight * length
        a, b, c, d = a + w * slope[0], b + w * slope[1], c + w * slope[2], d + w * slope[3]
    return a, b, c, d


def _accepted(
    rates: _Rates, time: float, state: _Four, length: float, rtol: float
) -> tuple[float, _Four, float]:
    """Length and end of a step that meets the tolerance, and the length of the next."""
    while length > 1e-15 * max(abs(time), 1e-15):
        end, error = _step(rates, time, state, length)
        swift = max(abs(state[1]), abs(end[1]), abs(end[1] - state[1]))
        far = max(abs(end[0] - state[0]), swift * length)
        ratio = max(abs(error[1]) / swift, abs(error[0]) / far) / rtol if swift else 0.0
        if ratio <= 1.0:
            return length, end, _CONTROL.following(length, ratio)
        length = _CONTROL.shorter(length, ratio)
    raise ConvergenceError(
        f"no step of an impact of a tip meets Accuracy.time_rtol = {rtol:g} at {time:g} s; loosen "
        "it",
        state,
    )


def _shortened(
    contact: Contact, rates: _Rates, here: Impact, length: float, reached: _Four
) -> tuple[float, _Four]:
    """End a step where the tip is deepest, or where the faces detach."""
    start = (here.depth, here.speed, 0.0, 0.0)
    out = contact.stop.curve.residual(here.largest)
    if here.speed > 0.0 >= reached[1]:
        what, level = 1, 0.0
    elif reached[1] < 0.0 and reached[0] < out < here.depth:
        what, level = 0, out
    else:
        return length, reached

    def left(fraction: float) -> float:
        return _step(rates, here.time, start, fraction * length)[0][what] - level

    length *= bracketed_root(left, 0.0, 1.0, 1e-13)
    found = list(_step(rates, here.time, start, length)[0])
    found[what] = level
    return length, (found[0], found[1], found[2], found[3])


def _moved(contact: Contact, here: Impact, length: float, reached: _Four) -> Impact:
    """State at the end of a step, and whether the impact is over."""
    curve, (depth, speed, impulse, damped) = contact.stop.curve, reached
    time = here.time + length
    force = curve.force_at(depth, here.largest)[0] if depth > 0.0 else 0.0
    held = force * max(1.0 + contact.stop.damping * speed, 0.0)
    now = here._replace(
        time=time,
        depth=_known(curve, depth, time),
        speed=speed,
        impulse=here.impulse + impulse,
        dissipated=here.dissipated + damped,
        peak=max(here.peak, held),
    )
    if here.speed > 0.0 and speed == 0.0:
        return _turned(contact, now)
    # A tip that came and was drawn off before it pressed has nothing to turn at.
    if speed < 0.0 and depth <= curve.residual(here.largest):
        return now._replace(depth=curve.residual(here.largest), end=ImpactEnd.OUT)
    return now


def _turned(contact: Contact, now: Impact) -> Impact:
    """At the deepest point: remember it, and rest if there is not the energy to come out."""
    curve, depth = contact.stop.curve, now.depth
    largest = max(now.largest, depth)
    work = curve.dissipated_work(largest) - curve.dissipated_work(now.largest)
    now = now._replace(largest=largest, dissipated=now.dissipated + max(work, 0.0))
    out = curve.residual(largest)

    def stored(at: float) -> float:
        """Energy at an approach, over that where the faces detach [J]."""
        spring = contact.stiffness * (contact.root.height_at(now.time) + 0.5 * (at + out))
        return rebound_work(curve, at, largest) - (contact.attraction - spring) * (at - out)

    if stored(depth) > 0.0:
        return now
    rest = rest_depth(contact, largest, now.time, depth)
    ringing = max(stored(depth) - stored(rest), 0.0)
    return now._replace(
        depth=rest, speed=0.0, dissipated=now.dissipated + ringing, end=ImpactEnd.REST
    )
