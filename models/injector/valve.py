"""A spool valve drawn off its end cap by an electromagnet: coil, spring, stop and drive.

Conventions: the gap h lies between the end of the spool and the end cap and grows as the valve
opens. The magnet pulls the spool *away* from the end cap, so that each of its two air gaps
shrinks by what h grows: it is ``air_gap - h``. A spring pushes the spool back, an opposite stop
ends the stroke. `pull` is what is left for the film, positive where it opens; the film and the
end cap itself belong to `contactkit.separation.motion`.

Left out: what `coil` leaves out, the play and the friction of the spool in its bore, and the forces
of the oil that flows through the valve. Plain floats only: this also runs inside an FMU.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from attrs import Attribute, field, frozen

from ...analyses.load_displacement.curve import LoadDisplacementCurve
from ...analyses.load_displacement.impact import in_series
from ...errors import DescriptionError
from ...units import si
from ...validators import count, finite, non_negative, optional, part, positive, refuse
from ..end_stop.faces import StopFaces
from .coil import (
    Coil,
    StepCount,
    advance_flux,
    current,
    field_energy,
    flux_rate,
    inductance,
    magnet_force,
)

__all__ = [
    "Coil",
    "DriveProfile",
    "Spring",
    "Stop",
    "Valve",
    "StepCount",
    "advance_flux",
    "current",
    "energising_times",
    "field_energy",
    "flux_rate",
    "inductance",
    "magnet_force",
    "pull",
    "StopForce",
    "rough_stop_force",
    "spring_force",
    "stop_force",
    "stopping",
    "switching_times",
    "voltage",
]


@frozen(kw_only=True)
class Spring:
    """The return spring, which pushes the spool towards the end cap.

    Parameters
    ----------
    stiffness : float
        Stiffness [N/m].
    preload : float
        Force while the spool touches the end cap, h = 0 [N].
    """

    stiffness: float = field(validator=non_negative, metadata=si("N/m"))
    preload: float = field(validator=non_negative, metadata=si("N"))


@frozen(kw_only=True)
class Stop:
    """The opposite stop, which ends the stroke.

    Parameters
    ----------
    gap : float
        Gap h at which the spool meets the stop [m].
    stiffness : float
        Stiffness of stop and spool together [N/m].
    damping : float
        Fraction of the elastic force that is added per speed of approach [s/m]; 0: none.
    faces : StopFaces, optional
        Rough faces that meet in front of the stiffness; without them the stop is a spring.
    """

    gap: float = field(validator=positive, metadata=si("m"))
    stiffness: float = field(validator=positive, metadata=si("N/m"))
    damping: float = field(default=0.0, validator=non_negative, metadata=si("s/m"))
    faces: StopFaces | None = field(default=None, validator=optional(part(StopFaces)))


def _not_driving(profile: DriveProfile, attribute: Attribute[Any], value: float) -> None:
    finite(profile, attribute, value)
    if value > 0.0:
        raise refuse(profile, attribute, value, "be zero or negative: it ends the current")


@frozen(kw_only=True)
class DriveProfile:
    """Voltage across the circuit: boost, hold and off, in each of a number of cycles.

    Parameters
    ----------
    start_delay : float
        Time of the first energising [s].
    period, on_time : float
        Time between energisings, and how long each of them lasts [s].
    boost_voltage, boost_time : float
        Voltage [V] that builds up the current, and for how long [s].
    hold_voltage : float
        Voltage for the rest of the on time, as the mean of a chopped supply [V].
    off_voltage : float
        Voltage against which the current ends [V]: 0 freewheels through a diode, a negative one
        ends it sooner. A diode keeps the current from turning round.
    cycles : int
        Number of cycles [-].
    """

    start_delay: float = field(default=0.0, validator=non_negative, metadata=si("s"))
    period: float = field(validator=positive, metadata=si("s"))
    on_time: float = field(validator=positive, metadata=si("s"))
    boost_voltage: float = field(validator=positive, metadata=si("V"))
    boost_time: float = field(validator=non_negative, metadata=si("s"))
    hold_voltage: float = field(validator=non_negative, metadata=si("V"))
    off_voltage: float = field(default=0.0, validator=_not_driving, metadata=si("V"))
    cycles: int = field(default=1, validator=count, metadata=si("-"))

    def __attrs_post_init__(self) -> None:
        names = ("boost_time", "on_time", "period")
        times = [getattr(self, name) for name in names]
        for name, bound, time, limit in zip(names, names[1:], times, times[1:], strict=False):
            if time > limit:
                expected = f"not exceed {bound} = {limit:g} s"
                raise DescriptionError(f"DriveProfile.{name}", time, expected, unit="s")


@frozen(kw_only=True)
class Valve:
    """The drive of a spool; its mass and its film are those of a `SeparationScene`."""

    coil: Coil
    spring: Spring
    stop: Stop
    profile: DriveProfile

    def __attrs_post_init__(self) -> None:
        if self.stop.gap >= self.coil.air_gap:
            raise DescriptionError(
                "Stop.gap",
                self.stop.gap,
                f"be less than Coil.air_gap = {self.coil.air_gap:g} m",
                unit="m",
                hint="else the armature meets the poles before the spool meets the stop",
            )


def energising_times(profile: DriveProfile) -> list[float]:
    """Times [s] at which the coil is energised."""
    return [profile.start_delay + n * profile.period for n in range(profile.cycles)]


def voltage(profile: DriveProfile, time: float) -> float:
    """Voltage [V] at a time [s]; at a switching time that after it, but for rounding.

    Examples
    --------
    >>> profile = DriveProfile(period=10e-3, on_time=4e-3, boost_voltage=24.0, boost_time=1e-3,
    ...                        hold_voltage=6.0, off_voltage=-24.0, cycles=2)
    >>> [voltage(profile, t * 1e-3) for t in (0.5, 2, 5, 10.5, 25)]
    [24.0, 6.0, -24.0, 24.0, -24.0]
    """
    since = time - profile.start_delay
    if not 0.0 <= since < profile.cycles * profile.period:
        return profile.off_voltage
    since = math.fmod(since, profile.period)
    if since >= profile.on_time:
        return profile.off_voltage
    return profile.boost_voltage if since < profile.boost_time else profile.hold_voltage


def switching_times(profile: DriveProfile, start: float, end: float) -> list[float]:
    """Times [s] between `start` and `end`, both left out, at which the voltage may jump.

    Examples
    --------
    >>> profile = DriveProfile(period=10e-3, on_time=4e-3, boost_voltage=24.0, boost_time=1e-3,
    ...                        hold_voltage=6.0)
    >>> switching_times(profile, 0.0, 1.0)
    [0.001, 0.004]
    """
    found = []
    # One cycle early, as the quotient may be rounded up.
    cycle = max(0, math.floor((start - profile.start_delay) / profile.period) - 1)
    while cycle < profile.cycles:
        begin = profile.start_delay + cycle * profile.period
        if begin >= end:
            break
        times = (begin, begin + profile.boost_time, begin + profile.on_time)
        found += [time for time in dict.fromkeys(times) if start < time < end]
        cycle += 1
    return found


def spring_force(spring: Spring, gap: float) -> float:
    """Force [N] of the return spring at a gap [m]; positive closes."""
    return spring.preload + spring.stiffness * gap


def stop_force(stop: Stop, gap: float, speed: float) -> float:
    r"""Force [N] of the opposite stop, :math:`k\,x\,(1 + d\,v)` at a depth x; positive closes.

    Notes
    -----
    Hunt and Crossley's law with a linear spring: zero at touch, whatever the speed, and cut off
    at zero, so that the stop never pulls. For small losses a speed v comes back as
    :math:`v (1 - 2 d v/3)`. The film at the stop is left out.

    Examples
    --------
    >>> stop = Stop(gap=25e-6, stiffness=1e8, damping=5.0)
    >>> stop_force(stop, 25e-6, 0.2), round(stop_force(stop, 26e-6, 0.2), 6)
    (0.0, 200.0)
    """
    depth = gap - stop.gap
    return stop.stiffness * depth * max(1.0 + stop.damping * speed, 0.0) if depth > 0.0 else 0.0


class StopForce(NamedTuple):
    """Force of an end stop [N], positive closes, and approach of its rough faces [m]."""

    force: float
    approach: float


def rough_stop_force(
    stop: Stop, faces: LoadDisplacementCurve, largest: float, gap: float, speed: float
) -> StopForce:
    """Force [N] of a stop whose rough faces lie in series with its stiffness; positive closes.

    Parameters
    ----------
    stop : Stop
        The bodies behind the faces, and the damping, as in `stop_force`.
    faces : LoadDisplacementCurve
        The faces.
    largest : float
        Largest approach they have had [m].
    gap, speed : float
        Of the spool [m], [m/s].

    Returns
    -------
    StopForce
        Beyond the tables of the faces it follows their tangent.
    """
    point, approach = in_series(faces, gap - stop.gap, largest, stop.stiffness, beyond=True)
    return StopForce(point.force * max(1.0 + stop.damping * speed, 0.0), approach)


def stopping(
    stop: Stop, faces: LoadDisplacementCurve | None, largest: float, gap: float, speed: float
) -> float:
    """Force [N] of a stop with or without rough faces; positive closes."""
    if faces is None:
        return stop_force(stop, gap, speed)
    return rough_stop_force(stop, faces, largest, gap, speed).force


def pull(
    valve: Valve, flux: float, gap: float, speed: float, stopping: float | None = None
) -> float:
    """Force [N] that magnet, spring and stop leave for the film; positive opens.

    `stopping` [N] is the force of the stop where it is not that of `stop_force`.
    """
    if stopping is None:
        stopping = stop_force(valve.stop, gap, speed)
    return magnet_force(valve.coil, flux) - (spring_force(valve.spring, gap) + stopping)
