"""Firing cycles of the fuel injector: release delays, impulses and forces of each."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from attrs import evolve

from ....models.injector.monolithic import simulate
from ....models.injector.scene import InjectorScene
from ....models.injector.valve import energising_times
from ....separation.effects.base import LimitKind
from ....separation.effects.registry import ViscousForce
from ....separation.plan import plan
from ....units import celsius
from .cosimulation import InjectorRun

__all__ = ["Cycle", "cycles", "delays_over_temperature", "dry_delay", "run_error", "stem"]


class Cycle(NamedTuple):
    """One firing cycle of a co-simulation; times [s] from energising, nan if never released."""

    delay: float
    peak_force: float
    viscous_impulse: float
    meniscus_impulse: float
    limited_fraction: float


def cycles(run: InjectorRun, scene: InjectorScene) -> list[Cycle]:
    """Read each firing cycle off the signals of a co-simulation."""
    signals, profile = run.coupled, scene.valve.profile
    time = signals.time
    releases = np.unique(signals["t_release"])
    found = []
    for start in energising_times(profile):
        after = [float(t) for t in releases if start <= t < start + profile.period]
        delay = after[0] - start if after else math.nan
        until = after[0] if after else start + profile.on_time
        inside = (time >= start) & (time <= until)
        acts = signals["limit"][inside] == LimitKind.TENSION
        viscous, meniscus = (
            float(np.interp(until, time, signals[n]) - np.interp(start, time, signals[n]))
            for n in ("J", "J_m")
        )
        found.append(
            Cycle(delay, float(signals["F"][inside].max()), viscous, meniscus, float(acts.mean()))
        )
    return found


def stem(temperature: float) -> str:
    """Temperature [K] as part of a file name: ``minus20degC``, ``80degC``."""
    degrees = temperature - celsius(0.0)
    return f"{'minus' if degrees < 0.0 else ''}{abs(degrees):.0f}degC"


def dry_delay(scene: InjectorScene) -> float:
    """Release delay [s] of a spool without a film: what magnet, spring and mass alone take."""
    film = scene.separation(scene.temperature)
    meniscus = film.meniscus
    thin = evolve(meniscus.liquid, viscosity=1e-15, kinematic_viscosity=None)
    interface = evolve(film.interface, meniscus=evolve(meniscus, liquid=thin))
    dry = plan(evolve(film, interface=interface, effects=(ViscousForce(),)))
    return float(simulate(dry, scene.valve, scene.first_pulse_end).cycles[0].release_time)


def delays_over_temperature(
    scene: InjectorScene, *, limited: bool, tension: float | None = None, n: int = 9
) -> tuple[list[float], list[float]]:
    """Temperatures [K] over the range of the study, and the release delay [s] at each."""
    span = scene.study.temperatures
    temperatures = sorted({*np.linspace(min(span), max(span), n).tolist(), *span})
    delays = []
    for temperature in temperatures:
        made = plan(scene.separation(temperature, limited=limited, tension=tension))
        first = simulate(made, scene.valve, scene.first_pulse_end, rtol=1e-6).cycles[0]
        delays.append(float(first.release_time))
    return temperatures, delays


def run_error(run: InjectorRun, found: Sequence[Cycle]) -> float:
    """Coupling error of a run and its cycles against the monolithic solve, see `coupling_error`."""
    from ....fmu.master.injector import coupling_error

    coupled = [cycle.delay for cycle in found]
    return coupling_error(coupled, [cycle.release_time for cycle in run.monolithic.cycles])
