"""Work-precision of the lift-off of a micromirror."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path

from attrs import evolve

from ....errors import ConvergenceError, PlanError
from ....separation.effects.meniscus import MeniscusForce
from ....separation.plan import Plan
from ....work_precision import Outcome, Point, Setting, WorkPrecision, sweep
from ...library import bundled_device
from ..coupling import couple
from ..mirror import Mirror
from ..monolithic import simulate_monolithic
from ..scene import MicromirrorScene
from ..tip_film import tip_law
from .cosimulation import build_tips, couple_fmus

__all__ = ["mirror_sweep", "release_study"]

_STEPS = (100e-9, 50e-9, 20e-9, 10e-9, 5e-9, 2e-9)  # [s]
_TOLERANCES = (1e-4, 1e-6, 1e-8)  # a line of the table each


def release_study() -> list[Point]:
    """Error of the time at which the tips of the shipped mirror are free; CPU seconds."""
    scene = bundled_device("micromirror")
    assert isinstance(scene, MicromirrorScene)
    return list(mirror_sweep(scene, lambda done: None).points)


def mirror_sweep(scene: MicromirrorScene, progress: Callable[[float], None]) -> WorkPrecision:
    """Error of the time at which the tips are free, by solver, communication step and profile.

    Raises
    ------
    PlanError
        If the reset pulse of the scene does not release.
    """
    pulse = abs(scene.mirror.waveform.reset_voltage)
    mirror = scene.first_flip(pulse if scene.mirror.waveform.reset_time > 0.0 else None)
    law = tip_law(scene.tip, scene.study.humidity, 1e-9)
    first = mirror.waveform.reset_time + mirror.waveform.release_time
    exact = simulate_monolithic(mirror, law, scene.start, first, rtol=1e-10, stop=scene.stop).first(
        "is free"
    )
    if math.isnan(exact):
        raise PlanError(
            f"cost needs a pulse that releases; {pulse:g} V do not at a relative humidity of "
            f"{scene.study.humidity:g}: raise Waveform.reset_voltage"
        )
    end = 1.02 * exact
    near = simulate_monolithic(mirror, law, scene.start, end, rtol=1e-8, stop=scene.stop).first(
        "is free"
    )
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        fmu = build_tips(scene, Path(folder))
        settings = _settings(scene, mirror, law, fmu, end)
        return sweep(
            settings,
            exact,
            quantity="time at which the tips are free",
            floor=max(abs(near / exact - 1.0), 1e-14),
            repeats=3,
            progress=progress,
        )


def _settings(
    scene: MicromirrorScene, mirror: Mirror, law: Plan, fmu: Path, end: float
) -> list[Setting]:
    """Monolithic model over tolerances, coupled tips over steps, and the arc as a model."""
    settings = [
        Setting(
            "monolithic, scipy", f"rtol {rtol:.0e}", partial(_whole, scene, mirror, law, end, rtol)
        )
        for rtol in _TOLERANCES
    ]
    coupled = [("tips in this process", law, False)]
    film = scene.tip.effect(MeniscusForce)
    if film is not None and film.form == "exact":
        arc = tuple(evolve(e, profile="arc") if e is film else e for e in scene.effects)
        less = tip_law(evolve(scene, effects=arc).tip, scene.study.humidity)
        coupled.append(("arc in place of the exact meniscus", less, True))
    settings += [
        Setting(
            name,
            f"step {step * 1e9:g} ns",
            partial(_local, scene, mirror, one, end, step),
            is_model,
        )
        for name, one, is_model in coupled
        for step in (_STEPS[2:5] if is_model else _STEPS)
    ]
    settings += [
        Setting(
            "FMU pair tip-contact",
            f"step {step * 1e9:g} ns",
            partial(_fmus, scene, mirror, fmu, end, step),
        )
        for step in _STEPS
    ]
    return settings


def _whole(scene: MicromirrorScene, mirror: Mirror, law: Plan, end: float, rtol: float) -> Outcome:
    whole = simulate_monolithic(mirror, law, scene.start, end, rtol=rtol, stop=scene.stop)
    counts = {"steps": whole.n_steps, "evaluations": whole.n_evaluations}
    return Outcome(_freed(whole.first("is free")), counts)


def _local(scene: MicromirrorScene, mirror: Mirror, law: Plan, end: float, step: float) -> Outcome:
    tips = scene.tips(law)
    motion = couple(mirror, tips, scene.loading.stiffness, scene.start, end, step)
    return Outcome(_freed(tips.plus.state.free_time), {"steps": motion.n_steps})


def _fmus(scene: MicromirrorScene, mirror: Mirror, fmu: Path, end: float, step: float) -> Outcome:
    done = couple_fmus(scene, fmu, mirror, end, step)
    return Outcome(_freed(done.free_time), {"steps": done.motion.n_steps})


def _freed(time: float) -> float:
    """Time [s] at which tips were free, or the error that says they were not."""
    if not time > 0.0:
        raise ConvergenceError("the tips were not free in time; the step is too long")
    return time
