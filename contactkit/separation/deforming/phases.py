"""Phases of the loading of deforming bodies: what drives them, and until when."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from ...errors import DescriptionError
from ...lubrication.elastohydrodynamic.drive import Driven, Imposed
from ...lubrication.elastohydrodynamic.motion import Phase, SmoothGap, with_times
from ...scene.loading import ImposedForce, ImposedSpeed, PressAndPull
from .numbers import hertz_approach
from .plan import DeformingPlan, characteristic_speed

__all__ = ["phases", "pressing_speed"]

_POINTS = 40  # of the curve of an imposed speed, beside those that the steps add
_RAMP = 0.01  # of the time in which rigid bodies part
_SHALLOW = 2.0  # times Hertz' approach, within which a pressed pair starts its pull


def pressing_speed(plan: DeformingPlan) -> float:
    """Speed of rigid bodies at the start under the load [m/s]; 0 of a loading without one."""
    loading = plan.scene.loading
    if not isinstance(loading, PressAndPull):
        return 0.0
    return loading.press / plan.rigid_damping


def phases(plan: DeformingPlan, fields_at: Sequence[float] = ()) -> list[Phase]:
    """Phases of the loading, with steps that end at some times [s].

    Raises
    ------
    DescriptionError
        If one of these times is not within the motion.
    """
    found = _phases(plan)
    last = found[-1].times[-1]
    for time in fields_at:
        if not 0.0 <= time <= last:
            raise DescriptionError(
                "simulate.fields_at", time, f"lie within the motion, 0 to {last:g} s", unit="s"
            )
    return with_times(found, np.array([time for time in fields_at if time > 0.0]))


def _phases(plan: DeformingPlan) -> list[Phase]:
    loading = plan.scene.loading
    if isinstance(loading, ImposedSpeed):
        length = (loading.final_gap - loading.initial_gap) / loading.speed
        return [Phase(_at_speed(loading.speed), _times(plan, 0.0, length))]
    if isinstance(loading, ImposedForce):
        return [Phase(_by_force(loading), [loading.time_limit], loading.final_gap)]
    assert isinstance(loading, PressAndPull)
    press = Driven(lambda _: -loading.press)
    pressing = Phase(lambda *_: press, [loading.rest])
    end = loading.rest + loading.time_limit
    if loading.force is not None:
        return [pressing, Phase(_reversed(plan, loading), [end], loading.final_gap)]
    speed = loading.speed or 0.0
    length = (loading.final_gap + _sunk(plan, loading.press)) / speed
    times = _times(plan, loading.rest, loading.rest + length)
    return [pressing, Phase(_at_speed(speed), times, loading.final_gap)]


def _reversed(plan: DeformingPlan, loading: PressAndPull) -> Callable[[float, float], Driven]:
    """Pull by a force after a load: at once, on a map within a hundredth of the time of the film.

    There a contact opens cell by cell, which takes a path.
    """
    film, force = plan.film, loading.force or 0.0
    if isinstance(film, SmoothGap):
        return lambda *_: Driven(lambda _: force)
    within = _RAMP * film.gap / characteristic_speed(plan.scene, film)

    def drive(_: float, start: float) -> Driven:
        def acting(time: float) -> float:
            share = min(max((time - start) / within, 0.0), 1.0)
            return share * force - (1.0 - share) * loading.press

        return Driven(acting)

    return drive


def _sunk(plan: DeformingPlan, press: float) -> float:
    """Bound of how far a load presses the bodies into each other [m]."""
    film = plan.film
    if math.isfinite(film.radius):
        return _SHALLOW * hertz_approach(press, film.radius, plan.modulus)
    # On a map a flat is pressed in as a punch, and its asperities by less than the initial gap.
    return 0.0 if isinstance(film, SmoothGap) else film.gap + press / (plan.modulus * film.rim)


def _times(plan: DeformingPlan, start: float, end: float) -> list[float]:
    """Points of the curve of an imposed speed; of a map those of the steps suffice."""
    points = _POINTS if isinstance(plan.film, SmoothGap) else 1
    found: list[float] = np.linspace(start, end, points + 1)[1:].tolist()
    return found


def _at_speed(speed: float) -> Callable[[float, float], Imposed]:
    return lambda gap, start: Imposed(lambda time: gap + speed * (time - start))


def _by_force(loading: ImposedForce) -> Callable[[float, float], Driven]:
    def pull(time: float) -> float:
        if loading.rise_time == 0.0:
            return loading.force
        return -loading.force * math.expm1(-time / loading.rise_time)

    driven = Driven(pull, loading.mass or 0.0, loading.stiffness, lambda _: loading.initial_gap)
    return lambda *_: driven
