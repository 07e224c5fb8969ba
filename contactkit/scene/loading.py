"""Loadings: what is imposed in a separation, a contact or a sliding, one class per kind.

The gap is positive when open; travel and tangential force are positive in the direction of
sliding. A field that does not belong to a kind cannot be written.
"""

from __future__ import annotations

import abc
import math
from typing import Any, ClassVar, Literal, NamedTuple

from attrs import Attribute, field, fields, frozen

from ..accuracy import Accuracy
from ..errors import DescriptionError, PlanError
from ..units import si
from ..validators import (
    Described,
    as_whole,
    count,
    finite,
    non_negative,
    optional,
    part,
    positive,
    refuse,
)

__all__ = [
    "Approach",
    "ContactLoading",
    "ImposedForce",
    "ImposedSpeed",
    "ImposedTime",
    "Imposed",
    "Loading",
    "PressAndPull",
    "Pressing",
    "SeparationLoading",
    "Sliding",
    "TangentialStep",
    "Vibration",
]


@frozen(kw_only=True)
class Loading(Described, abc.ABC):
    """A loading of two bodies; its kind is its name in files."""

    kind: ClassVar[str]
    reads: ClassVar[tuple[str, ...]] = tuple(Accuracy.standard.values)
    """Settings of `Accuracy` that its solution reads; all of them, unless it says which."""

    @property
    @abc.abstractmethod
    def summary(self) -> str:
        """The loading in a few words, for the head of a plan."""


def _exactly_one(loading: Described, **units: str) -> str:
    """Name of the only one of some fields that is given."""
    given = [name for name in units if getattr(loading, name) is not None]
    if len(given) != 1:
        raise DescriptionError(
            type(loading).__name__,
            given or "none",
            f"be given exactly one of {' or '.join(f'{n} [{u}]' for n, u in units.items())}",
        )
    return given[0]


# --- Separation -----------------------------------------------------------------------------------


def _beyond_start(loading: SeparationLoading, attribute: Attribute[float], value: float) -> None:
    positive(loading, attribute, value)
    if value <= loading.initial_gap:
        raise refuse(loading, attribute, value, f"exceed initial_gap = {loading.initial_gap:g} m")


@frozen(kw_only=True)
class SeparationLoading(Loading):
    """A gap that opens along the common normal of the bodies.

    Parameters
    ----------
    initial_gap, final_gap : float
        Gap at the start and gap at which the bodies count as separated [m].
    """

    family: ClassVar[str] = "separation loading"
    imposed: ClassVar[str]

    initial_gap: float = field(validator=non_negative, metadata=si("m"))
    final_gap: float = field(validator=_beyond_start, metadata=si("m"))

    @property
    def summary(self) -> str:
        """See `Loading.summary`."""
        return f"{self.imposed} imposed, gap {self.initial_gap:g} m to {self.final_gap:g} m"

    @property
    def smallest_gap(self) -> float:
        """Smallest gap [m] of an opening."""
        return self.initial_gap


@frozen(kw_only=True)
class Vibration(Described):
    r"""A vibration of the gap, on top of an imposed opening speed.

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
    rest_gap : float
        Gap at which asperities carry the bodies, to be kept clear of [m]; 0: none.

    Examples
    --------
    >>> shaken = Vibration(amplitude=1e-6, frequency=20e3)
    >>> round(shaken.offset(1.25e-5) * 1e6, 9), round(shaken.speed(0.0), 9)
    (1.0, 0.125663706)
    """

    amplitude: float = field(validator=positive, metadata=si("m"))
    frequency: float = field(validator=positive, metadata=si("Hz"))
    phase: float = field(default=0.0, validator=finite, metadata=si("rad"))
    rest_gap: float = field(default=0.0, validator=non_negative, metadata=si("m"))

    def angle(self, time: float) -> float:
        """Phase [rad] at a time [s]."""
        return math.tau * self.frequency * time + self.phase

    def offset(self, time: float) -> float:
        """Part of the gap [m] that is due to the vibration, at a time [s]."""
        return self.amplitude * math.sin(self.angle(time))

    def speed(self, time: float) -> float:
        """Part of the opening speed [m/s] that is due to the vibration, at a time [s]."""
        return math.tau * self.frequency * self.amplitude * math.cos(self.angle(time))


@frozen(kw_only=True)
class ImposedSpeed(SeparationLoading):
    """An imposed opening speed; the force follows.

    Parameters
    ----------
    speed : float
        Opening speed [m/s].
    initial_gap, final_gap : float
        Gap at the start and gap at which the bodies count as separated [m].
    vibration : Vibration, optional
        Vibration of the gap on top of the speed.

    Examples
    --------
    >>> ImposedSpeed(speed=0.04, initial_gap=5e-6, final_gap=25e-6).summary
    'speed imposed, gap 5e-06 m to 2.5e-05 m'
    """

    kind: ClassVar[str] = "imposed-speed"
    imposed: ClassVar[str] = "speed"
    reads: ClassVar[tuple[str, ...]] = ("points", "curve_rtol")

    speed: float = field(validator=positive, metadata=si("m/s"))
    vibration: Vibration | None = field(default=None, validator=optional(part(Vibration)))

    def __attrs_post_init__(self) -> None:
        if self.vibration is None:
            return
        rest = self.vibration.rest_gap
        if self.vibration.amplitude >= self.initial_gap - rest:
            raise DescriptionError(
                "Vibration.amplitude",
                self.vibration.amplitude,
                f"be below initial_gap = {self.initial_gap:g} m"
                + (f" less rest_gap = {rest:g} m" if rest else ""),
                unit="m",
                hint="the bodies would touch; shake less, or start from a larger gap",
            )

    @property
    def smallest_gap(self) -> float:
        """See `SeparationLoading.smallest_gap`: at most so small, with a vibration."""
        return self.initial_gap - (self.vibration.amplitude if self.vibration else 0.0)

    @property
    def summary(self) -> str:
        """See `Loading.summary`."""
        shaken, text = self.vibration, super().summary
        if shaken is None:
            return text
        return f"{text}, vibration of {shaken.amplitude:g} m at {shaken.frequency:g} Hz"


@frozen(kw_only=True)
class ImposedTime(SeparationLoading):
    """An imposed duration of the separation; the mean force follows.

    Parameters
    ----------
    time : float
        Duration [s].
    initial_gap, final_gap : float
        Gap at the start and gap at which the bodies count as separated [m].
    """

    kind: ClassVar[str] = "imposed-time"
    imposed: ClassVar[str] = "time"
    reads: ClassVar[tuple[str, ...]] = ("points", "curve_rtol")

    time: float = field(validator=positive, metadata=si("s"))


@frozen(kw_only=True)
class ImposedForce(SeparationLoading):
    """An imposed pull, on a mass if there is one; the motion follows.

    Parameters
    ----------
    force : float
        Pull [N].
    mass : float, optional
        Moving mass [kg]. None: inertia is left out.
    stiffness : float
        Stiffness of a spring that pulls back towards `initial_gap` [N/m].
    rise_time : float
        The pull grows as ``force*(1 - exp(-t/rise_time))`` [s]; 0: at once.
    initial_speed : float
        Speed of the mass at the start [m/s].
    initial_gap, final_gap : float
        Gap at the start and gap at which the bodies count as separated [m].
    rest_gap : float
        Gap at which asperities carry the bodies and closing stops [m]; 0: none.
    time_limit : float
        Longest time to wait for separation [s].
    """

    kind: ClassVar[str] = "imposed-force"
    imposed: ClassVar[str] = "force"
    reads: ClassVar[tuple[str, ...]] = ("time_rtol", "curve_rtol", "max_steps")

    force: float = field(validator=finite, metadata=si("N"))
    mass: float | None = field(default=None, validator=optional(positive), metadata=si("kg"))
    stiffness: float = field(default=0.0, validator=non_negative, metadata=si("N/m"))
    rise_time: float = field(default=0.0, validator=non_negative, metadata=si("s"))
    initial_speed: float = field(default=0.0, validator=finite, metadata=si("m/s"))
    rest_gap: float = field(default=0.0, validator=non_negative, metadata=si("m"))
    time_limit: float = field(default=3600.0, validator=positive, metadata=si("s"))

    @rest_gap.validator
    def _within_start(self, attribute: Attribute[float], value: float) -> None:
        if value > self.initial_gap:
            expected = f"not exceed initial_gap = {self.initial_gap:g} m"
            raise refuse(self, attribute, value, expected)

    @property
    def moving_mass(self) -> float:
        """The mass [kg]; a pull without one is refused."""
        if self.mass is None:
            raise PlanError("a motion with inertia needs loading.mass [kg]: give the moving mass")
        return self.mass


@frozen(kw_only=True)
class PressAndPull(SeparationLoading):
    """A load that presses for a time, and then a pull: at a speed, or by a force.

    The bodies begin at rest at `initial_gap`, are pressed towards each other for `rest`, and pulled
    from wherever they are then. Exactly one of `speed` and `force` is given.

    Parameters
    ----------
    press : float
        Load [N] from the start, positive.
    rest : float
        How long it presses [s].
    speed : float, optional
        Opening speed of the pull [m/s].
    force : float, optional
        Pull [N], in place of the load from then on.
    initial_gap, final_gap : float
        Gap at the start and gap at which the bodies count as separated [m].
    time_limit : float
        Longest time to wait for separation after the rest [s].

    Examples
    --------
    >>> PressAndPull(press=0.01, rest=10.0, speed=1e-5, initial_gap=1e-6, final_gap=1e-5).summary
    'pressed by 0.01 N for 10 s, then pulled at 1e-05 m/s, gap 1e-06 m to 1e-05 m'
    """

    kind: ClassVar[str] = "press-and-pull"
    imposed: ClassVar[str] = "load and pull"

    press: float = field(validator=positive, metadata=si("N"))
    rest: float = field(validator=positive, metadata=si("s"))
    speed: float | None = field(default=None, validator=optional(positive), metadata=si("m/s"))
    force: float | None = field(default=None, validator=optional(positive), metadata=si("N"))
    time_limit: float = field(default=3600.0, validator=positive, metadata=si("s"))

    def __attrs_post_init__(self) -> None:
        _exactly_one(self, speed="m/s", force="N")

    @property
    def summary(self) -> str:
        """See `Loading.summary`."""
        pull = f"at {self.speed:g} m/s" if self.force is None else f"by {self.force:g} N"
        return (
            f"pressed by {self.press:g} N for {self.rest:g} s, then pulled {pull}, "
            f"gap {self.initial_gap:g} m to {self.final_gap:g} m"
        )


# --- Contact --------------------------------------------------------------------------------------


class Imposed(NamedTuple):
    """Imposed quantity of a loading: the name of its field, its value and its unit."""

    name: str
    value: float
    unit: str


@frozen(kw_only=True)
class ContactLoading(Loading):
    """A loading that brings two bodies into contact: a load is imposed, or the approach.

    One's own needs `kind` and `mean_pressure`, and fields of which the first that is given is what
    load curves and studies state.

    Examples
    --------
    >>> @frozen(kw_only=True)
    ... class DeadWeight(ContactLoading):
    ...     kind = "dead-weight"
    ...     mass: float = field(validator=positive, metadata=si("kg"))
    ...
    ...     def mean_pressure(self, area):
    ...         return 9.81 * self.mass / area
    >>> DeadWeight(mass=0.5).summary, DeadWeight(mass=0.5).quantity.value
    ('mass 0.5 kg', 0.5)
    """

    family: ClassVar[str] = "contact loading"
    reads: ClassVar[tuple[str, ...]] = ("grid", "rtol", "method", "max_iterations", "threads")

    @abc.abstractmethod
    def mean_pressure(self, area: float) -> float | None:
        """Mean pressure [Pa] over a window of an area [m2]; None if the approach is imposed."""

    @property
    def imposed_approach(self) -> float | None:
        """Imposed approach of the bodies from first touch [m]; None if a load is imposed."""
        return None

    def imposed_over(self, area: float) -> float:
        """Mean pressure [Pa] over a window of an area [m2], or the approach [m] that is imposed.

        Examples
        --------
        >>> Pressing(force=2.0).imposed_over(0.5), Approach(approach=1e-9).imposed_over(0.5)
        (4.0, 1e-09)
        """
        pressure = self.mean_pressure(area)
        return float((self.imposed_approach if pressure is None else pressure) or 0.0)

    @property
    def quantity(self) -> Imposed:
        """The imposed quantity.

        Examples
        --------
        >>> Pressing(force=2.0).quantity
        Imposed(name='force', value=2.0, unit='N')
        """
        given = ((a, getattr(self, a.name)) for a in fields(type(self)))
        a, value = next((a, value) for a, value in given if value is not None)
        return Imposed(a.name, value, a.metadata.get("unit", ""))

    @property
    def summary(self) -> str:
        """See `Loading.summary`."""
        name, value, unit = self.quantity
        return f"{name} {value:g} {unit}"


@frozen(kw_only=True)
class Pressing(ContactLoading):
    """A load that presses the bodies together. Exactly one of the two is given.

    With `Adhesion` a load may be negative: bodies that came to rest under no load are pulled, up to
    the pull-off force.

    Parameters
    ----------
    pressure : float, optional
        Mean pressure over the window [Pa].
    force : float, optional
        Normal force on the window [N].
    """

    kind: ClassVar[str] = "pressing"

    pressure: float | None = field(default=None, validator=optional(finite), metadata=si("Pa"))
    force: float | None = field(default=None, validator=optional(finite), metadata=si("N"))

    def __attrs_post_init__(self) -> None:
        _exactly_one(self, pressure="Pa", force="N")

    def mean_pressure(self, area: float) -> float | None:
        """See `ContactLoading.mean_pressure`."""
        return self.pressure if self.force is None else self.force / area

    @property
    def summary(self) -> str:
        """See `Loading.summary`."""
        return super().summary if self.pressure is None else f"mean {super().summary}"


@frozen(kw_only=True)
class Approach(ContactLoading):
    """An imposed approach of the bodies; the load follows.

    Parameters
    ----------
    approach : float
        Rigid-body approach from first touch [m]. In a window that is not periodic it is that of
        points far away; in a periodic window it is that of the mean planes of the deformed
        surfaces.
    """

    kind: ClassVar[str] = "approach"

    approach: float = field(validator=finite, metadata=si("m"))

    def mean_pressure(self, area: float) -> None:
        """See `ContactLoading.mean_pressure`."""
        return

    @property
    def imposed_approach(self) -> float:
        """See `ContactLoading.imposed_approach`."""
        return self.approach


@frozen(kw_only=True)
class TangentialStep(Described):
    """A step of a tangential load path: from the state before it to a target, in equal sub-steps.

    Parameters
    ----------
    force : float, optional
        Target of the tangential force on the lower body [N], at most the friction of full sliding.
    displacement : float, optional
        Target of the displacement of the upper body against the lower [m], from the start of the
        path; beyond full sliding the contact slides on.
    ratio : float, optional
        Target of the force over that of full sliding [-], -1 to 1. Exactly one of the three.
    steps : int
        Equal sub-steps, each of which is a state of the result [-].
    direction : float, optional
        Direction of this step, from the x axis towards y [rad]; None: that of the path.

    Examples
    --------
    A cycle after the first loading:

    >>> cycle = [TangentialStep(ratio=r, steps=8) for r in (0.6, -0.6, 0.6)]
    >>> TangentialStep(force=1.0, ratio=0.5)
    Traceback (most recent call last):
        ...
    contactkit.errors.DescriptionError: TangentialStep must be given exactly one of force [N] or
    displacement [m] or ratio [-], got ['force', 'ratio']
    """

    force: float | None = field(default=None, validator=optional(finite), metadata=si("N"))
    displacement: float | None = field(default=None, validator=optional(finite), metadata=si("m"))
    ratio: float | None = field(default=None, validator=optional(finite), metadata=si("-"))
    steps: int = field(default=1, converter=as_whole, validator=count, metadata=si("-"))
    direction: float | None = field(default=None, validator=optional(finite), metadata=si("rad"))

    @ratio.validator
    def _at_most_sliding(self, attribute: Attribute[Any], value: float | None) -> None:
        if value is not None and abs(value) > 1.0:
            raise refuse(
                self, attribute, value, "lie between -1 and 1", "beyond, impose a displacement"
            )

    def __attrs_post_init__(self) -> None:
        _exactly_one(self, force="N", displacement="m", ratio="-")

    @property
    def label(self) -> str:
        """The step in a few words, for a plan.

        Examples
        --------
        >>> TangentialStep(ratio=-0.6, steps=8).label
        'ratio -0.6 in 8 steps'
        """
        targets = (("force", "N"), ("displacement", "m"), ("ratio", ""))
        given = ((name, getattr(self, name), unit) for name, unit in targets)
        words = [
            f"{name} {value:g} {unit}".strip() for name, value, unit in given if value is not None
        ]
        if self.direction is not None:
            words.append(f"at {self.direction:g} rad")
        if self.steps > 1:
            words.append(f"in {self.steps} steps")
        return " ".join(words)


# --- Sliding --------------------------------------------------------------------------------------


@frozen(kw_only=True)
class Sliding(Loading):
    """A sliding of one body past the other at a held gap; `speed` or `time` is imposed.

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

    family: ClassVar[str] = "sliding loading"
    kind: ClassVar[str] = "sliding"
    reads: ClassVar[tuple[str, ...]] = ("points", "curve_rtol")

    gap: float = field(validator=non_negative, metadata=si("m"))
    speed: float | None = field(default=None, validator=optional(positive), metadata=si("m/s"))
    time: float | None = field(default=None, validator=optional(positive), metadata=si("s"))
    travel: float | None = field(default=None, validator=optional(positive), metadata=si("m"))

    def __attrs_post_init__(self) -> None:
        _exactly_one(self, speed="m/s", time="s")

    @property
    def imposed(self) -> Literal["speed", "time"]:
        """Name of the imposed quantity."""
        return "speed" if self.speed is not None else "time"

    @property
    def summary(self) -> str:
        """See `Loading.summary`."""
        return f"{self.imposed} imposed at a gap of {self.gap:g} m"
