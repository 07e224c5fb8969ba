"""Stick-slip of a block that is pulled over a surface through a spring."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np
from attrs import Attribute, field, frozen

from ..errors import DescriptionError
from ..numerics.roots import bracketed_root
from ..scene.curve import Curve
from ..units import si
from ..validators import Described, friction_coefficient, non_negative, optional, positive, refuse

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["SlipEvent", "SpringSlider", "StickSlip", "stick_slip"]

_SAMPLES = 65  # of the force during a slip


@frozen(kw_only=True)
class SpringSlider(Described):
    """A block under a load, pulled through a spring whose end moves at a constant speed.

    Parameters
    ----------
    load : float
        Normal load on the block [N].
    static_coefficient : float
        Coefficient of friction at rest [-], 0 to 1000; rubber has above 1.
    kinetic_coefficient : float
        Coefficient of friction in motion [-], at most the static one.
    stiffness : float
        Stiffness of the spring [N/m].
    speed : float
        Speed of the end of the spring [m/s].
    mass : float
        Mass of the block [kg]; 0: motion without inertia.
    contact_stiffness : float, optional
        Tangential stiffness of the contact [N/m], in series with the spring, such as
        ``result.of(PartialSlip).stiffness[0]``; None: rigid.
    meniscus_force : float
        Attraction of menisci on the block at rest [N], which adds to the load.
    moving_meniscus_force : float, optional
        The same in motion [N], at most that at rest; None: as at rest.
    damping : float
        Viscous drag on the moving block over its speed [N.s/m], such as the force of
        `CouetteForce` at a speed of 1 m/s.

    Examples
    --------
    >>> block = SpringSlider(
    ...     load=1.0, static_coefficient=0.5, kinetic_coefficient=0.3, stiffness=1e3, speed=1e-3
    ... )
    >>> block.force_drop, block.total_stiffness
    (0.2, 1000.0)
    """

    load: float = field(validator=positive, metadata=si("N"))
    static_coefficient: float = field(validator=friction_coefficient, metadata=si("-"))
    kinetic_coefficient: float = field(validator=friction_coefficient, metadata=si("-"))
    stiffness: float = field(validator=positive, metadata=si("N/m"))
    speed: float = field(validator=positive, metadata=si("m/s"))
    mass: float = field(default=0.0, validator=non_negative, metadata=si("kg"))
    contact_stiffness: float | None = field(
        default=None, validator=optional(positive), metadata=si("N/m")
    )
    meniscus_force: float = field(default=0.0, validator=non_negative, metadata=si("N"))
    moving_meniscus_force: float | None = field(
        default=None, validator=optional(non_negative), metadata=si("N")
    )
    damping: float = field(default=0.0, validator=non_negative, metadata=si("N.s/m"))

    @kinetic_coefficient.validator
    def _at_most_static(self, attribute: Attribute[float], value: float) -> None:
        if value > self.static_coefficient:
            raise refuse(
                self,
                attribute,
                value,
                f"be at most static_coefficient = {self.static_coefficient:g}",
                "a block whose friction grows as it moves does not slip, it creeps",
            )

    @moving_meniscus_force.validator
    def _at_most_at_rest(self, attribute: Attribute[float | None], value: float | None) -> None:
        if value is not None and value > self.meniscus_force:
            raise refuse(
                self,
                attribute,
                value,
                f"be at most meniscus_force = {self.meniscus_force:g} N",
                "menisci grow at rest and not in motion",
            )

    @property
    def static_friction(self) -> float:
        """Force at which the block begins to slip [N]."""
        return self.static_coefficient * (self.load + self.meniscus_force)

    @property
    def kinetic_friction(self) -> float:
        """Friction of the moving block [N], without the viscous drag."""
        moving = self.moving_meniscus_force
        return self.kinetic_coefficient * (
            self.load + (self.meniscus_force if moving is None else moving)
        )

    @property
    def force_drop(self) -> float:
        """Static less kinetic friction [N]."""
        return self.static_friction - self.kinetic_friction

    @property
    def total_stiffness(self) -> float:
        """Stiffness of spring and contact in series [N/m]."""
        if self.contact_stiffness is None:
            return self.stiffness
        return 1.0 / (1.0 / self.stiffness + 1.0 / self.contact_stiffness)


class SlipEvent(NamedTuple):
    """A slip: its start and end [s], forces of the spring then [N], length [m], top speed [m/s].

    Without inertia it takes no time, and its speed is infinite.
    """

    start: float
    end: float
    force_before: float
    force_after: float
    length: float
    top_speed: float


@frozen(eq=False)
class StickSlip(Curve):
    """Force of the spring over time, and the slips of the block; arrays are read-only.

    Attributes
    ----------
    slider : SpringSlider
        The block.
    time : ndarray (n,)
        [s]; a slip without inertia is two equal times.
    force : ndarray (n,)
        Force of the spring [N].
    displacement : ndarray (n,)
        Slip of the block since the start [m].
    events : tuple of SlipEvent
        The slips; empty if the block slides steadily.
    stick_time, slip_time, period : float
        Of the periodic motion, which is reached with the first slip [s]; zero if it slides
        steadily.
    largest_force : float
        Largest force of the spring [N]; with inertia slightly above static friction.
    """

    axis: ClassVar[str] = "point"
    title: ClassVar[str] = "stick-slip"

    slider: SpringSlider
    time: Floats = field(repr=False, metadata=si("s"))
    force: Floats = field(repr=False, metadata=si("N"))
    displacement: Floats = field(repr=False, metadata=si("m"))
    events: tuple[SlipEvent, ...] = field(repr=False)
    stick_time: float = field(metadata=si("s"))
    slip_time: float = field(metadata=si("s"))
    largest_force: float = field(metadata=si("N"))

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Curve.sources`."""
        return ("Rabinowicz 1965",)

    @property
    def parts(self) -> Mapping[str, Any]:
        """See `Curve.parts`."""
        return {"events": self.events}

    @property
    def period(self) -> float:
        """Period [s] of stick and slip together."""
        return self.stick_time + self.slip_time

    @property
    def dissipated_work(self) -> float:
        """Energy [J] that a slip dissipates: kinetic friction times its length, and viscous drag.

        With drag it is what the spring's end and the spring give during the slip.
        """
        if not self.events:
            return 0.0
        one, block = self.events[0], self.slider
        friction = block.kinetic_friction * one.length
        if block.damping == 0.0:
            return friction
        pulled = block.kinetic_friction * self.slip_time + block.damping * one.length
        stored = (one.force_before**2 - one.force_after**2) / (2.0 * block.total_stiffness)
        return block.speed * pulled + stored


class _Cycle(NamedTuple):
    """Times [s], forces [N] and slips [m] of one slip, and its numbers."""

    time: Floats
    force: Floats
    slip: Floats
    end_force: float
    top_force: float
    top_speed: float


def stick_slip(slider: SpringSlider, n_slips: int = 5) -> StickSlip:
    r"""Motion of a spring-driven block with a lower friction in motion than at rest.

    From a relaxed spring the block sticks until the force reaches F_s = mu_s P, then slips against
    F_k = mu_k P until it is at rest again. With k the stiffness, d = (F_s - F_k)/k and
    w = sqrt(k/m)

    .. math:: t_{stick} = \frac{2 d}{V}, \quad t_{slip} = \frac{2}{w} \left[ \pi
              - \arctan\frac{d w}{V} \right], \quad F_{after} = 2 F_k - F_s, \quad
              \Delta x = V t_{slip} + 2 d

    Without inertia (m = 0, strong damping) the force falls to F_k at once: a jump of d in a period
    of d/V, half of the one with inertia. Menisci add to the load, F_s = mu_s (P + F_m), and the
    film adds a drag c v in motion: with b = c/(2 m)

    .. math:: v = V + e^{-bt} \left[ -V \cos w' t + \frac{(F_s - F_k)/m - bV}{w'} \sin w' t
              \right], \quad w'^2 = w^2 - b^2, \quad F = F_k + c v + m \dot v

    until v = 0. Above a speed or a damping at which v stays positive the block slides on steadily,
    under F_k + c V.

    Parameters
    ----------
    slider : SpringSlider
        Block, spring and friction.
    n_slips : int
        Number of slips to follow.

    Returns
    -------
    StickSlip
        Force over time and the slips.

    Raises
    ------
    DescriptionError
        If `slider` is no `SpringSlider`, or `n_slips` not a whole number of at least 1.

    Notes
    -----
    Exact for Coulomb friction with two coefficients, which carry no memory: no creep, no ageing at
    rest, no dependence on the speed but of the drag. Equal coefficients leave no stick-slip:
    without inertia the block slides steadily; with inertia and no drag it swings about kinetic
    friction for ever, and rests for an instant in every swing. A contact stiffness adds to the
    compliance of the spring; the inertia of the block against that of the contact alone is left
    out. (Rabinowicz 1965.)

    Examples
    --------
    >>> block = SpringSlider(
    ...     load=1.0,
    ...     static_coefficient=0.5,
    ...     kinetic_coefficient=0.3,
    ...     stiffness=1e3,
    ...     speed=1e-3,
    ...     mass=0.01,
    ... )
    >>> motion = stick_slip(block)
    >>> f"{motion.stick_time:.3f} s, {motion.slip_time:.5f} s, {motion.events[1].force_after:.3f} N"
    '0.400 s, 0.01003 s, 0.100 N'
    """
    _check_slider(slider)
    if isinstance(n_slips, bool) or not isinstance(n_slips, int) or n_slips < 1:
        raise DescriptionError("stick_slip(n_slips)", n_slips, "be a whole number of at least 1")
    k, speed = slider.total_stiffness, slider.speed
    begin = slider.static_friction
    cycle = _cycle(slider)
    if cycle is None:
        return _steady(slider, n_slips)
    times, forces, moved = [np.zeros(1)], [np.zeros(1)], [np.zeros(1)]
    events, now, force, place = [], 0.0, 0.0, 0.0
    for _ in range(n_slips):
        start = now + (begin - force) / (k * speed)
        end = start + float(cycle.time[-1])
        times.append(start + cycle.time)
        forces.append(cycle.force)
        moved.append(place + cycle.slip)
        length = float(cycle.slip[-1])
        events.append(SlipEvent(start, end, begin, cycle.end_force, length, cycle.top_speed))
        now, force, place = end, cycle.end_force, place + length
    time, pull, slip = (np.concatenate(one) for one in (times, forces, moved))
    for column in (time, pull, slip):
        column.flags.writeable = False
    stick = (begin - cycle.end_force) / (k * speed)
    taken = float(cycle.time[-1])
    return StickSlip(slider, time, pull, slip, tuple(events), stick, taken, cycle.top_force)


def _check_slider(given: object) -> None:
    if not isinstance(given, SpringSlider):
        cure = "describe it: SpringSlider(load=..., ...)"
        raise DescriptionError("stick_slip(slider)", given, "be a SpringSlider", hint=cure)


def _cycle(slider: SpringSlider) -> _Cycle | None:
    """Return one slip, or None if the block does not come to rest again."""
    if slider.damping > 0.0:
        return _with_drag(slider)
    if slider.mass > 0.0:
        return _with_inertia(slider)
    return _without_inertia(slider) if slider.force_drop > 0.0 else None


def _without_inertia(slider: SpringSlider) -> _Cycle:
    """Slip that takes no time, down to kinetic friction."""
    low, high = slider.kinetic_friction, slider.static_friction
    slip = np.array([0.0, slider.force_drop / slider.total_stiffness])
    return _Cycle(np.zeros(2), np.array([high, low]), slip, low, high, math.inf)


def _with_inertia(slider: SpringSlider) -> _Cycle:
    """Slip of a mass on a spring against a constant friction, until it is at rest."""
    k, v, drop = slider.total_stiffness, slider.speed, slider.force_drop
    w = math.sqrt(k / slider.mass)
    d = drop / k
    duration = 2.0 / w * (math.pi - math.atan2(d * w, v))
    time = np.linspace(0.0, duration, _SAMPLES)
    low = slider.kinetic_friction
    force = low + drop * np.cos(w * time) + k * v / w * np.sin(w * time)
    slip = v * time - (force - slider.static_friction) / k
    end = low - drop
    force[-1], slip[-1] = end, v * duration + 2.0 * d
    return _Cycle(
        time, force, slip, end, low + math.hypot(drop, k * v / w), v + math.hypot(v, d * w)
    )


def _speed_and_rate(slider: SpringSlider, time: Floats) -> tuple[Floats, Floats]:
    """Speed and acceleration of a block with a mass and a drag, from the start of its slip."""
    m, v = slider.mass, slider.speed
    b, square = 0.5 * slider.damping / m, slider.total_stiffness / m
    root = math.sqrt(abs(square - b * b))
    if square > b * b:
        fade = np.exp(-b * time)
        even, odd = fade * np.cos(root * time), fade * np.sin(root * time)
    else:  # both exponentials fall
        slow, fast = np.exp((root - b) * time), np.exp(-(root + b) * time)
        even, odd = 0.5 * (slow + fast), 0.5 * (slow - fast)
    odd = odd / root if root > 1e-7 * b else time * np.exp(-b * time)
    start = slider.force_drop / m
    speed = v - v * even + (start - b * v) * odd
    return speed, start * even + (square * v - b * start) * odd


def _with_drag(slider: SpringSlider) -> _Cycle | None:
    """Slip of a block with a viscous drag, or None if it does not come to rest."""
    m, k, c, v = slider.mass, slider.total_stiffness, slider.damping, slider.speed
    if m == 0.0 or 0.25 * c * c >= k * m:
        return None
    b = 0.5 * c / m
    w, start = math.sqrt(k / m - b * b), slider.force_drop / m
    phase = math.atan2(k / m * v - b * start, start * w)
    fastest, slowest = (phase + 0.5 * math.pi) / w, (phase + 1.5 * math.pi) / w
    if float(_speed_and_rate(slider, np.array(slowest))[0]) >= 0.0:
        return None
    duration = bracketed_root(
        lambda t: float(_speed_and_rate(slider, np.array(t))[0]), fastest, slowest
    )
    time = np.linspace(0.0, duration, _SAMPLES)
    speed, rate = _speed_and_rate(slider, time)
    force = slider.kinetic_friction + c * speed + m * rate
    slip = v * time - (force - slider.static_friction) / k
    even = np.array(math.atan2(v * w, start - b * v) / w)  # as fast as the end of the spring
    peak = slider.kinetic_friction + c * v + m * float(_speed_and_rate(slider, even)[1])
    top_speed = float(_speed_and_rate(slider, np.array(fastest))[0])
    return _Cycle(time, force, slip, float(force[-1]), peak, top_speed)


def _settling(slider: SpringSlider) -> tuple[Floats, Floats]:
    """Times and forces of a slip that ends in steady sliding."""
    high, low, v = slider.static_friction, slider.kinetic_friction, slider.speed
    m, k, c = slider.mass, slider.total_stiffness, slider.damping
    if c == 0.0:
        return np.zeros(1), np.full(1, high)
    if m == 0.0:
        time = np.linspace(0.0, 12.0 * c / k, _SAMPLES)
        return time, low + c * v + (high - low - c * v) * np.exp(-k / c * time)
    b = 0.5 * c / m
    slowest = b - math.sqrt(max(b * b - k / m, 0.0))
    time = np.linspace(0.0, 12.0 / slowest, 16 * _SAMPLES)
    speed, rate = _speed_and_rate(slider, time)
    return time, low + c * speed + m * rate


def _steady(slider: SpringSlider, n_slips: int) -> StickSlip:
    """Motion of a block that sticks once and then slides steadily."""
    high, k, v = slider.static_friction, slider.total_stiffness, slider.speed
    first = high / (k * v)
    later, settling = _settling(slider)
    last = first * (n_slips if first else 1) + (0.0 if first else 1.0)
    time = np.concatenate([[0.0], first + later, [first + later[-1] + last]])
    force = np.concatenate([[0.0], settling, settling[-1:]])
    slip = v * (time - first) - (force - high) / k
    slip[0] = 0.0
    for column in (time, force, slip):
        column.flags.writeable = False
    return StickSlip(slider, time, force, slip, (), 0.0, 0.0, float(settling.max()))
