"""Release of a micromirror: by the spring alone, or by the smallest reset pulse."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from ...errors import InfeasibleError
from ...numerics.roots import first_true
from ...separation.plan import Plan
from .coupling import couple
from .scene import MicromirrorScene
from .tip_film import Adhesion, adhesion, tip_law

__all__ = [
    "Landing",
    "Release",
    "Reset",
    "humidity_limit",
    "landing",
    "release",
    "release_curve",
    "smallest_reset",
    "voltage_needed",
]

# Each trial solves a motion. Release need not be monotone in the voltage: the first one that works
# is looked for upwards, so that a window narrower than the coarse step may be missed.
_COARSE = 2.0  # [V] between the pulses tried first
_FINE = 0.05  # [V]
# Relative humidities [-]. Above 0.98 the Kelvin radius (26 nm) is that of the tip: other films
# than those of this model. The step is below the error of a hygrometer, 1 %.
_WETTEST, _STEP = 0.98, 0.005
_AWAY = 0.5  # [-] over the landing tilt, below which a mirror has left: beyond any bend of the tip


class Release(NamedTuple):
    """Adhesion of a mirror at a humidity, and the voltage and time of its release."""

    adhesion: Adhesion
    """Of one tip."""
    alone: float
    """Time after the bias ends at which the last tip is free [s]; nan if the spring fails."""
    reset_voltage: float
    """Smallest reset pulse that releases [V], of the time the scene gives it; nan if none does."""
    reset_delay: float
    """Time after the start of that pulse at which the tips are free [s]."""


class Reset(NamedTuple):
    """A reset pulse, and what it does."""

    voltage: float
    """[V]; nan if none releases."""
    delay: float
    """Time after its start at which the tips are free [s]; nan if it does not release."""


class Landing(NamedTuple):
    """A mirror at rest on its tips: what is stored in it, of all tips of a side together."""

    tilt: float
    """[rad]"""
    bend: float
    """Of each tip [m]."""
    preload: float
    """Force of the tips on their sites without adhesion [N]."""
    spring_energy: float
    """In the bent tips [J]."""
    hinge_energy: float
    """[J]"""
    hinge_force: float
    """Force of the hinge at the tips [N]."""


def landing(scene: MicromirrorScene) -> Landing:
    """Forces and energies of the mirror at rest under its bias."""
    from .mirror import root_height

    mirror, (tilt, _) = scene.mirror, scene.start
    tips, hinge = mirror.tips, mirror.hinge
    bend, stiffness = -root_height(tips, tilt, 1.0), tips.per_side * scene.loading.stiffness
    return Landing(
        tilt=tilt,
        bend=bend,
        preload=stiffness * bend,
        spring_energy=0.5 * stiffness * bend * bend,
        hinge_energy=0.5 * hinge.stiffness * tilt * tilt,
        hinge_force=hinge.stiffness * tilt / (tips.arm * math.cos(tilt)),
    )


def release(scene: MicromirrorScene, made: Plan, reset_voltage: float | None) -> float:
    """Time [s] after the start of a reset pulse, or the end of the bias, at which tips are free.

    Parameters
    ----------
    scene : MicromirrorScene
    made : Plan
        Law of one tip, from `tip_law`.
    reset_voltage : float, optional
        Amplitude of the pulse [V]. None: the bias just ends.

    Returns
    -------
    float
        nan if the mirror has not come to half of its landing tilt within the patience of the
        study.

    Raises
    ------
    InfeasibleError
        If the pulse presses the plate on its electrode.
    """
    mirror = scene.first_flip(reset_voltage)
    wave, away = mirror.waveform, _AWAY * mirror.tips.landing_tilt
    motion = couple(
        mirror,
        scene.tips(made),
        scene.loading.stiffness,
        scene.start,
        wave.reset_time + wave.release_time,
        scene.study.communication_step,
        until=lambda time, tilt: tilt < away,
    )
    if motion["tilt"][-1] >= away:
        return math.nan
    held = motion["state_plus"] < 3.0
    return float(motion["time"][held][-1])


def smallest_reset(scene: MicromirrorScene, made: Plan) -> Reset:
    """Smallest reset voltage that releases; nan if none does.

    Looked for upwards from the bias in steps of 2 V, then halved to 0.05 V: the mirror swings on
    its tips during the pulse, so that larger voltages need not all do, and smaller ones could.
    """
    low, most = abs(scene.mirror.waveform.bias_voltage), scene.study.largest_reset
    high, found = low, _try(scene, made, low)
    while math.isnan(found):
        if high >= most:
            return Reset(math.nan, math.nan)
        low, high = high, min(high + _COARSE, most)
        try:
            found = _try(scene, made, high)
        except InfeasibleError:  # it would reach the electrode
            return Reset(math.nan, math.nan)
    times = {low: math.nan, high: found}

    def releases(voltage: float) -> bool:
        if voltage not in times:
            times[voltage] = _try(scene, made, voltage)
        return not math.isnan(times[voltage])

    least = first_true(releases, low, high, atol=_FINE)
    return Reset(least, times[least])


def _try(scene: MicromirrorScene, made: Plan, reset_voltage: float) -> float:
    return release(scene, made, reset_voltage)


def voltage_needed(scene: MicromirrorScene) -> float:
    """Smallest reset voltage [V] that releases at the humidity of the runs; nan if none does."""
    return smallest_reset(scene, tip_law(scene.tip, scene.study.humidity)).voltage


def humidity_limit(scene: MicromirrorScene) -> float:
    """Least relative humidity at which the springs alone do not release the mirror.

    To 0.005, by halving between dry air and 98 %: 1 if the springs release there, too; nan if they
    do not even release a dry mirror.
    """

    def sticks(humidity: float) -> bool:
        return math.isnan(release(scene, tip_law(scene.tip, humidity), None))

    if sticks(0.0):
        return math.nan
    return first_true(sticks, 0.0, _WETTEST, atol=_STEP) if sticks(_WETTEST) else 1.0


def release_curve(scene: MicromirrorScene, progress: Callable[[float], None]) -> list[Release]:
    """Adhesion and release at each humidity of the study."""
    found: list[Release] = []
    humidities = scene.study.humidities
    for i, humidity in enumerate(humidities):
        held = adhesion(scene.tip, humidity)
        if found and held.volume == found[-1].adhesion.volume == 0.0:  # as dry as before
            found.append(found[-1]._replace(adhesion=held))
            continue
        made = tip_law(scene.tip, humidity)
        alone = release(scene, made, None)
        reset = smallest_reset(scene, made)
        found.append(Release(held, alone, reset.voltage, reset.delay))
        progress((i + 1) / len(humidities))
    return found
