"""Stick-slip of a block that is pulled over a surface through a spring."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from attrs import Attribute, field, frozen

from ..errors import DescriptionError
from ..export.contents import Contents
from ..scene.tabular import Tabular, curve_contents
from ..units import si
from ..validators import Described, fraction, non_negative, optional, positive, refuse

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Curve = NDArray[np.float64]

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
        Coefficient of friction at rest [-], 0 to 1.
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

    Examples
    --------
    >>> block = SpringSlider(
    ...     load=1.0, static_coefficient=0.5, kinetic_coefficient=0.3, stiffness=1e3, speed=1e-3
    ... )
    >>> block.force_drop, block.total_stiffness
    (0.2, 1000.0)
    """

    load: float = field(validator=positive, metadata=si("N"))
    static_coefficient: float = field(validator=fraction, metadata=si("-"))
    kinetic_coefficient: float = field(validator=fraction, metadata=si("-"))
    stiffness: float = field(validator=positive, metadata=si("N/m"))
    speed: float = field(validator=positive, metadata=si("m/s"))
    mass: float = field(default=0.0, validator=non_negative, metadata=si("kg"))
    contact_stiffness: float | None = field(
        default=None, validator=optional(positive), metadata=si("N/m")
    )

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

    @property
    def static_friction(self) -> float:
        """Force at which the block begins to slip [N]."""
        return self.static_coefficient * self.load

    @property
    def kinetic_friction(self) -> float:
        """Friction of the moving block [N]."""
        return self.kinetic_coefficient * self.load

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
class StickSlip(Tabular):
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

    slider: SpringSlider
    time: Curve = field(repr=False)
    force: Curve = field(repr=False)
    displacement: Curve = field(repr=False)
    events: tuple[SlipEvent, ...] = field(repr=False)
    stick_time: float
    slip_time: float
    largest_force: float

    def contents(self) -> Contents:
        """Return force and displacement along the points of the curve."""
        columns = {
            "time": (self.time, "s"),
            "force": (self.force, "N"),
            "displacement": (self.displacement, "m"),
        }
        return curve_contents("point", columns, "stick-slip")

    @property
    def period(self) -> float:
        """Period [s] of stick and slip together."""
        return self.stick_time + self.slip_time

    @property
    def dissipated_work(self) -> float:
        """Energy [J] that a slip dissipates: kinetic friction times its length."""
        return self.slider.kinetic_friction * (self.events[0].length if self.events else 0.0)


class _Cycle(NamedTuple):
    """Times [s], forces [N] and slips [m] of one slip, and its numbers."""

    time: Curve
    force: Curve
    slip: Curve
    end_force: float
    top_force: float
    top_speed: float


def stick_slip(slider: SpringSlider, slips: int = 5) -> StickSlip:
    r"""Motion of a spring-driven block with a lower friction in motion than at rest.

    From a relaxed spring the block sticks until the force reaches F_s = mu_s P, then slips against
    F_k = mu_k P until it is at rest again. With k the stiffness, d = (F_s - F_k)/k and
    w = sqrt(k/m)

    .. math:: t_{stick} = \frac{2 d}{V}, \quad t_{slip} = \frac{2}{w} \left[ \pi
              - \arctan\frac{d w}{V} \right], \quad F_{after} = 2 F_k - F_s, \quad
              \Delta x = V t_{slip} + 2 d

    Without inertia (m = 0, strong damping) the force falls to F_k at once: a jump of d in a period
    of d/V, half of the one with inertia.

    Parameters
    ----------
    slider : SpringSlider
        Block, spring and friction.
    slips : int
        Number of slips to follow.

    Returns
    -------
    StickSlip
        Force over time and the slips.

    Raises
    ------
    DescriptionError
        If `slider` is no `SpringSlider`, or `slips` not a whole number of at least 1.

    Notes
    -----
    Exact for Coulomb friction with two coefficients, which carry no memory: no creep, no ageing at
    rest, no dependence on the speed. With equal coefficients there is no stick-slip: without
    inertia the block slides steadily; with inertia it swings about kinetic friction for ever, as
    nothing damps it, and rests for an instant in every swing. A contact stiffness adds to the
    compliance of the spring; the inertia of the block against that of the contact alone is left
    out. (Rabinowicz, Friction and Wear of Materials, 1965.)

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
    if isinstance(slips, bool) or not isinstance(slips, int) or slips < 1:
        raise DescriptionError("stick_slip(slips)", slips, "be a whole number of at least 1")
    k, speed = slider.total_stiffness, slider.speed
    begin = slider.static_friction
    if slider.mass == 0.0 and slider.force_drop == 0.0:
        return _steady(slider, slips)
    cycle = _without_inertia(slider) if slider.mass == 0.0 else _with_inertia(slider)
    times, forces, moved = [np.zeros(1)], [np.zeros(1)], [np.zeros(1)]
    events, now, force, place = [], 0.0, 0.0, 0.0
    for _ in range(slips):
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


def _steady(slider: SpringSlider, slips: int) -> StickSlip:
    """Motion of a block that sticks once and then slides steadily."""
    high = slider.static_friction
    first = high / (slider.total_stiffness * slider.speed)
    later = first * (slips if first else 1) + (0.0 if first else 1.0)
    time = np.array([0.0, first, first + later])
    force = np.array([0.0, high, high])
    slip = np.array([0.0, 0.0, slider.speed * later])
    for column in (time, force, slip):
        column.flags.writeable = False
    return StickSlip(slider, time, force, slip, (), 0.0, 0.0, high)
