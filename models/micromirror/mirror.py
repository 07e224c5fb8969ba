r"""A torsional micromirror: hinge, electrodes, spring tips that land, and its voltages.

.. math::
    I\ddot\theta = -c\dot\theta - k\theta + T_+(\theta) - T_-(-\theta)
                   + a\cos\theta\,(F_+ - F_-), \qquad
    z_\pm = a\,(\sin\theta_l \mp \sin\theta)

Conventions: the tilt is positive where the side ``+`` goes down; a voltage is that of the mirror
less that of the electrode below, and its sign does not matter to the torque T. On each side
spring tips hang at an arm a from the axis; z is the height of their root, measured so that an
unbent tip has the gap z over its landing site, less the gap that roughness keeps open, and
:math:`\theta_l` is the tilt at which they touch. F is the force of all tips of a side on the
mirror, positive where it pulls that side down: adhesion is positive, a bent tip negative.

The tips have no place in the equation but their force: who owns a tip and its film is stated in
`contactkit.models.micromirror.tip`. Left out: bending of hinge and mirror (they are stiff against
torsion), heating, and the gas but for the damping of the hinge. Plain floats only: this also
runs inside an FMU.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from attrs import Attribute, field, frozen

from ...errors import DescriptionError, InfeasibleError
from ...numerics.roots import bracketed_root
from ...units import si
from ...validators import count, finite, non_negative, optional, part, positive, refuse
from ..end_stop.faces import StopFaces
from .electrostatics import Electrode, largest_tilt, torque

__all__ = [
    "Hinge",
    "Mirror",
    "SpringTips",
    "Waveform",
    "acceleration",
    "drive_torque",
    "Attitude",
    "Volts",
    "electrode_volts",
    "landed_tilt",
    "root_height",
    "switching_times",
]


@frozen(kw_only=True)
class Hinge:
    """The torsional hinge and what it carries.

    Parameters
    ----------
    inertia : float
        Moment of inertia of all that turns, about the axis [kg.m2].
    stiffness : float
        Torsional stiffness [N.m/rad].
    damping : float
        Torque per rate of tilt [N.m.s/rad], of the gas and of the hinge.
    """

    inertia: float = field(validator=positive, metadata=si("kg.m2"))
    stiffness: float = field(validator=positive, metadata=si("N.m/rad"))
    damping: float = field(default=0.0, validator=non_negative, metadata=si("N.m.s/rad"))

    @property
    def frequency(self) -> float:
        """Natural frequency without damping [Hz]."""
        return math.sqrt(self.stiffness / self.inertia) / (2.0 * math.pi)


def _tilt(owner: object, attribute: Attribute[Any], value: float) -> None:
    positive(owner, attribute, value)
    if value >= 0.5 * math.pi:
        cure = f"was it meant in degrees? write '{value:g} deg'"
        raise refuse(owner, attribute, value, "be less than a right angle", cure)


@frozen(kw_only=True)
class SpringTips:
    """The spring tips on each side; mass and stiffness of one are those of `ImposedForce`.

    Parameters
    ----------
    arm : float
        Distance of the tips from the axis [m].
    landing_tilt : float
        Tilt at which unbent tips touch their landing sites [rad].
    per_side : int
        Number of equal tips on each side [-].
    damping : float
        Damping of one tip while it is free [N.s/m]; a tip that a film holds is damped by that.
    faces : StopFaces, optional
        What the apex of one tip meets on its site; without it the site is rigid, and keeps it.
    landing_damping : float
        Fraction of the force of the faces that is added per speed of approach [s/m].
    """

    arm: float = field(validator=positive, metadata=si("m"))
    landing_tilt: float = field(validator=_tilt, metadata=si("rad"))
    per_side: int = field(default=1, validator=count, metadata=si("-"))
    damping: float = field(default=0.0, validator=non_negative, metadata=si("N.s/m"))
    faces: StopFaces | None = field(default=None, validator=optional(part(StopFaces)))
    landing_damping: float = field(default=0.0, validator=non_negative, metadata=si("s/m"))

    def __attrs_post_init__(self) -> None:
        if self.landing_damping > 0.0 and self.faces is None:
            raise DescriptionError(
                "SpringTips.landing_damping",
                self.landing_damping,
                "be 0 on a rigid site",
                unit="s/m",
                hint="give SpringTips.faces, such as contact = 'tip-landing'",
            )


@frozen(kw_only=True)
class Waveform:
    """Voltages of mirror and electrodes, in each of a number of flips from side to side.

    The mirror rests on the side ``+`` under the bias. At each flip the address changes to the
    other side; then come the reset pulse, no voltage while the mirror releases, and the bias.

    Parameters
    ----------
    bias_voltage : float
        Voltage of the mirror that holds it down [V].
    address_voltage : float
        Voltage of the electrode on the side the mirror is to go to [V], the other has none; of
        the sign opposite to the bias it attracts throughout.
    reset_voltage, reset_time : float
        Voltage of the mirror during the reset pulse [V], and how long that lasts [s]; 0: none.
    release_time : float
        How long the mirror then has no voltage [s].
    start_delay, period : float
        Time of the first flip, and between flips [s].
    flips : int
        Number of flips [-].
    """

    bias_voltage: float = field(validator=finite, metadata=si("V"))
    address_voltage: float = field(default=0.0, validator=finite, metadata=si("V"))
    reset_voltage: float = field(default=0.0, validator=finite, metadata=si("V"))
    reset_time: float = field(default=0.0, validator=non_negative, metadata=si("s"))
    release_time: float = field(validator=positive, metadata=si("s"))
    start_delay: float = field(default=0.0, validator=non_negative, metadata=si("s"))
    period: float = field(validator=positive, metadata=si("s"))
    flips: int = field(default=1, validator=count, metadata=si("-"))

    def __attrs_post_init__(self) -> None:
        longest = self.reset_time + self.release_time
        if longest > self.period:
            expected = f"be at least reset_time + release_time = {longest:g} s"
            raise DescriptionError("Waveform.period", self.period, expected, unit="s")

    @property
    def stop_time(self) -> float:
        """Time at which the last flip ends [s]."""
        return self.start_delay + self.flips * self.period


@frozen(kw_only=True)
class Mirror:
    """A torsional mirror between two electrodes, with spring tips; its sides are alike."""

    hinge: Hinge = field(validator=part(Hinge))
    electrode: Electrode = field(validator=part(Electrode))
    tips: SpringTips = field(validator=part(SpringTips))
    waveform: Waveform = field(validator=part(Waveform))

    def __attrs_post_init__(self) -> None:
        most = largest_tilt(self.electrode)
        if self.tips.landing_tilt >= most:
            raise DescriptionError(
                "SpringTips.landing_tilt",
                self.tips.landing_tilt,
                f"be less than {most:g} rad, where the plate meets the electrode",
                unit="rad",
                hint="raise Electrode.gap, or shorten Electrode.outer",
            )


def root_height(tips: SpringTips, tilt: float, side: float) -> float:
    """Height z [m] of the root of the tips of a side, +1 or -1, at a tilt [rad].

    Examples
    --------
    >>> tips = SpringTips(arm=6e-6, landing_tilt=0.17)
    >>> root_height(tips, 0.17, 1.0), round(root_height(tips, 0.0, -1.0) * 1e6, 3)
    (0.0, 1.015)
    """
    return tips.arm * (math.sin(tips.landing_tilt) - side * math.sin(tilt))


class Volts(NamedTuple):
    """Voltage of the mirror over the electrodes of the sides + and - [V]."""

    plus: float
    minus: float


class Attitude(NamedTuple):
    """Tilt [rad] and rate [rad/s] of the mirror."""

    tilt: float
    rate: float


def electrode_volts(waveform: Waveform, time: float) -> Volts:
    """Voltage of the mirror over the electrodes of the sides + and - [V], at a time [s].

    At a switching time that after it, but for rounding.

    Examples
    --------
    >>> wave = Waveform(bias_voltage=-20.0, address_voltage=5.0, reset_voltage=-30.0,
    ...                 reset_time=1e-6, release_time=4e-6, period=100e-6, start_delay=2e-6)
    >>> [tuple(electrode_volts(wave, t * 1e-6)) for t in (1, 2.5, 4, 50)]
    [(-25.0, -20.0), (-30.0, -35.0), (0.0, -5.0), (-20.0, -25.0)]
    """
    since = time - waveform.start_delay
    flip = min(math.floor(since / waveform.period), waveform.flips - 1)
    if flip < 0:  # before the first flip: as addressed to the side +
        return Volts(waveform.bias_voltage - waveform.address_voltage, waveform.bias_voltage)
    since -= flip * waveform.period
    mirror = waveform.bias_voltage
    if since < waveform.reset_time:
        mirror = waveform.reset_voltage
    elif since < waveform.reset_time + waveform.release_time:
        mirror = 0.0
    addressed = mirror - waveform.address_voltage
    return Volts(mirror, addressed) if flip % 2 == 0 else Volts(addressed, mirror)


def switching_times(waveform: Waveform, start: float, end: float) -> list[float]:
    """Times [s] between `start` and `end`, both left out, at which a voltage may jump."""
    found = set()
    for flip in range(waveform.flips):
        begin = waveform.start_delay + flip * waveform.period
        pulse = begin + waveform.reset_time
        found |= {begin, pulse, pulse + waveform.release_time}
    return sorted(time for time in found if start < time < end)


def drive_torque(mirror: Mirror, tilt: float, volts: Volts) -> float:
    """Torque [N.m] of both electrodes, positive towards the side +."""
    plus, minus = volts
    down = torque(mirror.electrode, tilt, plus) if plus else 0.0
    return down - (torque(mirror.electrode, -tilt, minus) if minus else 0.0)


def acceleration(mirror: Mirror, tilt: float, rate: float, volts: Volts, tip_force: float) -> float:
    """Angular acceleration [rad/s2]; `tip_force` is that of side + less that of side - [N]."""
    hinge = mirror.hinge
    turning = drive_torque(mirror, tilt, volts) + mirror.tips.arm * math.cos(tilt) * tip_force
    return (turning - hinge.stiffness * tilt - hinge.damping * rate) / hinge.inertia


def landed_tilt(mirror: Mirror, tip_stiffness: float, volts: Volts) -> float:
    """Tilt [rad] at which the mirror rests on the tips of the side +, bent by the voltages.

    Parameters
    ----------
    mirror : Mirror
    tip_stiffness : float
        Stiffness of one tip [N/m].
    volts : Volts
        Voltages of the electrodes.

    Raises
    ------
    InfeasibleError
        If the voltage does not hold the mirror down, or presses the plate on the electrode.
    """
    tips, landing = mirror.tips, mirror.tips.landing_tilt
    stiffness = tips.per_side * tip_stiffness

    def left(tilt: float) -> float:
        return acceleration(mirror, tilt, 0.0, volts, stiffness * root_height(tips, tilt, 1.0))

    if left(landing) <= 0.0:
        raise InfeasibleError(
            f"{abs(volts[0]):g} V do not hold the mirror at its landing tilt of {landing:g} rad: "
            "the hinge is stronger; raise Waveform.bias_voltage"
        )
    # The nearest balance on the way down; the torque outgrows the tips beyond the next one.
    n, low, most = 400, landing, largest_tilt(mirror.electrode)
    for i in range(1, n):
        high = landing + (most - landing) * i / n
        if left(high) <= 0.0:
            return bracketed_root(left, low, high)
        low = high
    raise InfeasibleError(
        f"{abs(volts[0]):g} V press the plate through its spring tips on to the electrode; give "
        "stiffer tips, a lower voltage, or more Electrode.gap"
    )
