"""Delays of a spool valve by its film: how long it sticks, and how late it closes.

Conventions: the first firing cycle, by the monolithic model. Opening counts from the start of the
current pulse until the spool passes ``loading.final_gap``; closing from the end of the pulse until
the spool has come back over half of its stroke. Each delay is compared with that of the same valve
without a film, so that what remains is due to the film.
"""

from __future__ import annotations

import math

import numpy as np
from attrs import evolve
from scipy.interpolate import CubicHermiteSpline

from ...numerics.roots import bracketed_root
from ...separation.effects.viscous import ViscousForce
from ...separation.plan import Plan, plan
from .monolithic import MonolithicResult, simulate
from .scene import InjectorScene, end_stop_faces

__all__ = [
    "closing_delay",
    "closing_lag",
    "delay",
    "dry_delay",
    "residual_gap",
    "sticking_time",
]

_CLOSED = 0.5  # fraction of the stroke that is left: in full motion, where the time is well defined
# Viscosity of a film that is none [Pa.s]: 1e-12 of an oil's. Its release delay is below all
# round-off, and no other code than that of a film is needed.
_THIN = 1e-15


def delay(
    scene: InjectorScene,
    temperature: float,
    *,
    cavitates: bool = True,
    strength: float | None = None,
    cavity_pressure: float | None = None,
    ambient_pressure: float | None = None,
    rtol: float = 1e-6,
) -> float:
    """Delay of the first release [s], nan if it is not released within the pulse.

    For an oil as in `InjectorScene.separation`.
    """
    film = scene.separation(
        temperature,
        cavitates=cavitates,
        strength=strength,
        cavity_pressure=cavity_pressure,
        ambient_pressure=ambient_pressure,
    )
    return _release(scene, plan(film), rtol)


def dry_delay(scene: InjectorScene) -> float:
    """Delay of the first release [s] without a film: what magnet, spring and mass alone take."""
    return _release(scene, _dry(scene), 1e-8)


def sticking_time(scene: InjectorScene) -> float:
    """Time [s] that the film adds to the first opening; nan if it holds for the whole pulse."""
    return delay(scene, scene.temperature) - dry_delay(scene)


def closing_delay(scene: InjectorScene, *, dry: bool = False) -> float:
    """Time [s] from the end of the first pulse until the spool has closed by half of its stroke.

    nan if it never was that far open, or does not come back before the next pulse.
    """
    found = _first_cycle(scene, _dry(scene) if dry else plan(scene.separation(scene.temperature)))
    rest, stop = scene.loading.rest_gap, scene.valve.stop.gap
    mark, end = rest + _CLOSED * (stop - rest), scene.first_pulse_end
    time, gap = found["time"], found["gap"]
    if float(gap[time <= end].max()) < mark:
        return math.nan
    back = (gap[:-1] >= mark) & (gap[1:] < mark) & (time[1:] > end)
    if not back.any():
        return math.nan
    step = slice(int(np.argmax(back)), int(np.argmax(back)) + 2)
    cubic = CubicHermiteSpline(time[step], gap[step] - mark, found["speed"][step])
    return bracketed_root(lambda when: float(cubic(when)), *time[step].tolist()) - end


def closing_lag(scene: InjectorScene) -> float:
    """Time [s] that the film adds to the first closing; nan as for `closing_delay`."""
    return closing_delay(scene) - closing_delay(scene, dry=True)


def residual_gap(scene: InjectorScene) -> float:
    """Gap [m] beyond the rest gap when the second pulse begins."""
    found = _first_cycle(scene, plan(scene.separation(scene.temperature)))
    return float(found["gap"][-1]) - scene.loading.rest_gap


def _first_cycle(scene: InjectorScene, made: Plan) -> MonolithicResult:
    """Simulate up to the second pulse."""
    end = scene.valve.profile.start_delay + scene.valve.profile.period
    return simulate(made, scene.valve, end, rtol=1e-6, faces=end_stop_faces(scene.valve))


def _dry(scene: InjectorScene) -> Plan:
    """Plan of the same spool without a film."""
    film = scene.separation(scene.temperature)
    meniscus = film.meniscus
    thin = evolve(meniscus.liquid, viscosity=_THIN, kinematic_viscosity=None)
    interface = evolve(film.interface, meniscus=evolve(meniscus, liquid=thin))
    return plan(evolve(film, interface=interface, effects=(ViscousForce(),)))


def _release(scene: InjectorScene, made: Plan, rtol: float) -> float:
    end = scene.first_pulse_end
    return simulate(made, scene.valve, end, rtol=rtol, until_release=True).cycles[0].release_time
