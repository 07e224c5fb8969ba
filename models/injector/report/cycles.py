"""Firing cycles of the fuel injector: release delays, impulses and forces of each."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from ....numerics.roots import bracketed_root
from ....separation.effects.base import LimitKind
from ....separation.effects.viscous import TensionLimit
from ....separation.plan import plan
from ..monolithic import simulate
from ..scene import InjectorScene
from ..valve import energising_times
from .cosimulation import InjectorRun

__all__ = [
    "Cycle",
    "cycles",
    "held_pressure",
    "largest_pull",
    "run_error",
]


class Cycle(NamedTuple):
    """One firing cycle of a co-simulation; times [s] from energising, nan if never released."""

    delay: float
    peak_force: float
    viscous_impulse: float
    meniscus_impulse: float
    cavitated_fraction: float
    """Fraction of the time up to the release in which the film is cavitated."""


def cycles(run: InjectorRun, scene: InjectorScene) -> list[Cycle]:
    """Read each firing cycle off the signals of a co-simulation."""
    signals, profile = run.coupled, scene.valve.profile
    time = signals.time
    found = []
    for start in energising_times(profile):
        if start >= time[-1]:
            break
        release = _release_time(run, scene.loading.final_gap, start, start + profile.period)
        delay = release - start
        until = start + profile.on_time if math.isnan(release) else release
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


def _release_time(run: InjectorRun, gap: float, start: float, end: float) -> float:
    """When the spool first rises past a gap [m] between two times [s]; nan if it does not.

    From gap and speed at the communication points: `t_release` of the FMU does not count a spool
    that has not closed since the last release.
    """
    time, gaps, speeds = run.coupled.time, run.coupled["h"], run.coupled["v"]
    risen = (gaps[:-1] < gap) & (gaps[1:] >= gap) & (time[:-1] >= start) & (time[1:] <= end)
    if not risen.any():
        return math.nan
    step = slice(int(np.argmax(risen)), int(np.argmax(risen)) + 2)
    cubic = CubicHermiteSpline(time[step], gaps[step] - gap, speeds[step])
    return bracketed_root(lambda moment: float(cubic(moment)), *time[step].tolist())


def largest_pull(scene: InjectorScene) -> float:
    """Largest pull of magnet less spring on a spool that stays on its end cap [N]."""
    coldest = plan(scene.separation(min(scene.study.temperatures), cavitates=False))
    pull = simulate(coldest, scene.valve, scene.first_pulse_end, rtol=1e-6)["pull"]
    return float(pull.max())


def held_pressure(scene: InjectorScene, limit: TensionLimit, pull: float) -> float:
    """Pressure around the face [Pa], absolute, from which on a cavity holds a pull [N].

    A cavity over nearly all of the face holds area times its drop below the pressure around.
    """
    return pull / (math.pi * scene.interface.rim_radius**2) + limit.pressure_in_cavity


def run_error(run: InjectorRun, found: Sequence[Cycle]) -> float:
    """Coupling error of a run and its cycles against the monolithic solve, see `coupling_error`."""
    from ....fmu.master.injector import coupling_error

    checked = [cycle.release_time for cycle in run.monolithic.cycles]
    return coupling_error([cycle.delay for cycle in found[: len(checked)]], checked)
