"""Motions that are imposed besides a plain opening: sliding at a held gap, and a vibration.

The gap is positive when open, travel and tangential force are positive in the direction of
sliding, and a tangential force is that which resists.
"""

from __future__ import annotations

import math
from typing import Literal

from attrs import field, frozen

from ..errors import DescriptionError
from ..units import si
from ..validators import finite, non_negative, optional, positive

__all__ = ["Sliding", "Vibration"]


@frozen(kw_only=True)
class Sliding:
    """How one body slides past the other, the gap held. One of `speed` and `time` is imposed.

    Parameters
    ----------
    gap : float
        Gap at which the bodies are held [m].
    speed : float, optional
        Imposed sliding speed [m/s]; the force follows.
    time : float, optional
        Imposed duration of the slide [s]; the mean force follows.
    travel : float, optional
        How far the body slides [m]. None: until the wetted circles no longer overlap.

    Examples
    --------
    >>> Sliding(gap=2e-9, speed=1.0).imposed
    'speed'
    """

    gap: float = field(validator=non_negative, metadata=si("m"))
    speed: float | None = field(default=None, validator=optional(positive), metadata=si("m/s"))
    time: float | None = field(default=None, validator=optional(positive), metadata=si("s"))
    travel: float | None = field(default=None, validator=optional(positive), metadata=si("m"))

    def __attrs_post_init__(self) -> None:
        given = [name for name in ("speed", "time") if getattr(self, name) is not None]
        if len(given) != 1:
            expected = "be given exactly one of speed [m/s] or time [s]"
            raise DescriptionError("Sliding", given or "none", expected)

    @property
    def imposed(self) -> Literal["speed", "time"]:
        """What is imposed."""
        return "speed" if self.speed is not None else "time"


@frozen(kw_only=True)
class Vibration:
    r"""A vibration of the gap, on top of an opening at an imposed speed.

    .. math:: h = h_0 + v t + a \sin(2\pi f t + \varphi)

    Parameters
    ----------
    amplitude : float
        Amplitude a of the gap [m], half of peak to peak; below the gap, so that the bodies do
        not touch.
    frequency : float
        Frequency f [Hz].
    phase : float
        Phase at the start [rad].

    Examples
    --------
    >>> shaken = Vibration(amplitude=1e-6, frequency=20e3)
    >>> round(shaken.offset(1.25e-5) * 1e6, 9), round(shaken.speed(0.0), 9)
    (1.0, 0.125663706)
    """

    amplitude: float = field(validator=positive, metadata=si("m"))
    frequency: float = field(validator=positive, metadata=si("Hz"))
    phase: float = field(default=0.0, validator=finite, metadata=si("rad"))

    def angle(self, time: float) -> float:
        """Phase [rad] at a time [s]."""
        return math.tau * self.frequency * time + self.phase

    def offset(self, time: float) -> float:
        """What the vibration adds to the gap [m] at a time [s]."""
        return self.amplitude * math.sin(self.angle(time))

    def speed(self, time: float) -> float:
        """What the vibration adds to the opening speed [m/s] at a time [s]."""
        return math.tau * self.frequency * self.amplitude * math.cos(self.angle(time))
