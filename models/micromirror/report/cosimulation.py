"""Co-simulation of the micromirror with an FMU of its spring tips on each side."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any, NamedTuple

from ....errors import PlanError
from ....separation.plan import Plan
from ..coupling import FmuTip, Motion, TipSides, couple
from ..mirror import Mirror, root_height
from ..scene import MicromirrorScene
from ..tip_film import tip_law, tip_scene

if TYPE_CHECKING:
    from ....fmu.framework.instance import Instance
    from ..monolithic import MonolithicMotion

__all__ = ["FmuRun", "MirrorRun", "build_tips", "cosimulate_flips", "couple_fmus", "tip_start"]

Progress = Callable[[float], None]


class MirrorRun(NamedTuple):
    """The run over time: tips of both sides as FMUs, and the first flip by the monolithic model."""

    plan: Plan
    coupled: Motion
    monolithic: MonolithicMotion
    seconds: float
    log: tuple[str, ...]
    sites: tuple[Mapping[str, float], ...] = ()


class FmuRun(NamedTuple):
    """A mirror coupled to FMUs: signals, seconds, their log, when the side + was free [s]."""

    motion: Motion
    seconds: float
    log: tuple[str, ...]
    free_time: float
    sites: tuple[Mapping[str, float], ...] = ()


def build_tips(scene: MicromirrorScene, folder: Path) -> Path:
    """Build the FMU of the tips with the values of the scene as start values, and validate it.

    Raises
    ------
    PlanError
        If the FMU is not valid, or cannot represent the scene.
    """
    from ....fmu.python.build import build, validate

    start = tip_start(scene, scene.study.humidity)
    made = build("tip-contact", folder / "tip-contact.fmu", start=start)
    if problems := validate(made):
        raise PlanError("FMU not valid: " + "; ".join(problems))
    return made


def tip_start(scene: MicromirrorScene, humidity: float) -> dict[str, Any]:
    """Start values of the FMU ``tip-contact`` of a side, at a relative humidity [-].

    Raises
    ------
    PlanError
        If the FMU cannot represent the scene; says what stands against it.
    """
    from ....fmu.slaves.tip_contact import tip_values

    tips, stop = scene.mirror.tips, scene.stop
    values = tip_values(tip_scene(scene.tip, humidity))
    values |= {"N": tips.per_side, "c": tips.damping}
    return values if stop is None else values | {"curve": stop.curve, "d_stop": stop.damping}


def cosimulate_flips(scene: MicromirrorScene, out: Path | None, progress: Progress) -> MirrorRun:
    """Run all flips with an FMU on each side, and the first one by the monolithic model."""
    from ..monolithic import simulate_monolithic

    mirror, step = scene.mirror, scene.study.communication_step
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        fmu = build_tips(scene, out if out is not None else Path(folder))
        done = couple_fmus(scene, fmu, mirror, mirror.waveform.stop_time, step, progress)
    made = tip_law(scene.tip, scene.study.humidity)
    end = _first_landing(scene, done.motion)
    times = done.motion["time"]
    whole = simulate_monolithic(
        mirror, made, scene.start, end, times=times[times <= end], stop=scene.stop
    )
    return MirrorRun(made, done.motion, whole, done.seconds, done.log, done.sites)


def couple_fmus(
    scene: MicromirrorScene,
    fmu: Path,
    mirror: Mirror,
    stop_time: float,
    step: float,
    progress: Progress | None = None,
) -> FmuRun:
    """Couple a mirror at rest to an FMU on each side."""
    from ....fmu.framework.instance import Instance

    with Instance(fmu) as plus, Instance(fmu) as minus:
        for one, side in ((plus, 1.0), (minus, -1.0)):
            one.start({"z": root_height(mirror.tips, scene.start[0], side)}, stop_time)
        begun = perf_counter()
        motion = couple(
            mirror,
            TipSides(FmuTip(plus), FmuTip(minus)),
            scene.loading.stiffness,
            scene.start,
            stop_time,
            step,
            progress=progress,
        )
        seconds = perf_counter() - begun
        sites = tuple(_site(one) for one in (plus, minus))
        free_time = plus.get(plus.references("t_free"))[0]
        return FmuRun(motion, seconds, tuple(plus.log + minus.log), free_time, sites)


def _first_landing(scene: MicromirrorScene, coupled: Motion) -> float:
    """Time [s] up to which runs are compared: the first touch of the other side, or its end."""
    touched = coupled["state_minus"] < 3.0
    end = coupled["time"][touched.argmax()] if touched.any() else coupled["time"][-1]
    return float(min(end, scene.mirror.waveform.start_delay + 20e-6))


def _site(tips: Instance) -> dict[str, float]:
    """Maxima and works of the landing sites of a side, from the outputs of its FMU."""
    names = ("d_max", "F_max", "W_land", "W_plastic")
    found = dict(zip(names, tips.get(tips.references(*names)), strict=True))
    return found | {"n_land": float(tips.get_integers(tips.references("n_land"))[0])}
