"""The digital micromirror: whether it lets go of its landing sites, and by which pulse."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from attrs import frozen

from ...errors import PlanError
from ...files.scenes import structure
from ...models.micromirror.coupling import FmuTip, Motion, couple
from ...models.micromirror.mirror import Mirror, root_height
from ...models.micromirror.scene import MicromirrorScene, MirrorStudy, tip_values
from ...models.micromirror.tip_film import tip_law
from ...separation.plan import Plan
from ..report import Report

if TYPE_CHECKING:
    from ...fmu.framework.instance import Instance
    from ...models.micromirror.monolithic import Whole

__all__ = ["FmuRun", "Micromirror", "MicromirrorScene", "MirrorRun", "MirrorStudy", "open_device"]

Progress = Callable[[float], None]


class MirrorRun(NamedTuple):
    """The run over time: both sides' tips as FMUs, and the first flip as one system."""

    plan: Plan
    coupled: Motion
    whole: Whole
    seconds: float
    log: tuple[str, ...]
    sites: tuple[Mapping[str, float], ...] = ()


class FmuRun(NamedTuple):
    """A mirror coupled to FMUs: signals, seconds, what they said, when the side + was free."""

    motion: Motion
    seconds: float
    log: tuple[str, ...]
    free_time: float
    sites: tuple[Mapping[str, float], ...] = ()


def open_device(tables: Mapping[str, Any], origin: str) -> Micromirror:
    """Open the tables of a micromirror scene file."""
    return Micromirror(structure(tables, MicromirrorScene, origin))


@frozen
class Micromirror:
    """The micromirror as the command line runs it."""

    scene: MicromirrorScene

    @property
    def name(self) -> str:
        """Title of the scene."""
        return self.scene.name

    def plan_text(self) -> str:
        """See `Runnable.plan_text`."""
        scene, study = self.scene, self.scene.study
        made = tip_law(scene.tip, study.humidity)
        wave, meniscus = scene.mirror.waveform, made.scene.interface.meniscus
        volume = f"{meniscus.volume:.3g} m3 under each tip" if meniscus.volume else "none"
        head = [
            f"{scene.name}: {wave.flips} flips between landing sites at "
            f"{scene.mirror.tips.landing_tilt:.4g} rad",
            f"  at   {100.0 * study.humidity:g} % relative humidity, condensed: {volume}; release "
            f"is looked for at {len(study.humidities)} humidities",
            f"  by   two FMUs tip-contact and the mirror's equation of motion, communication step "
            f"{study.communication_step:g} s",
            f"  on   {'mirror':19s} hinge, electrodes, spring tips, voltages",
        ]
        sources = ["sources:", *(f"  {line}" for line in made.cite().splitlines())]
        return "\n".join([*head, *str(made).splitlines()[1:], *sources])

    def fmu_start(self) -> tuple[str, Mapping[str, Any]]:
        """See `Runnable.fmu_start`."""
        return "tip-contact", tip_values(self.scene, self.scene.study.humidity)

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `Runnable.run`."""
        from .report import report

        run = self.cosimulate(out, partial(_share, progress, 0.0, 0.6))
        return report(self.scene, run, out, partial(_share, progress, 0.6, 1.0))

    def build(self, folder: Path) -> Path:
        """Build the FMU of the tips with the values of the scene baked in, and validate it.

        Raises
        ------
        PlanError
            If the FMU is not valid, or cannot represent the scene.
        """
        from ...fmu.python.build import build, validate

        name, start = self.fmu_start()
        made = build(name, folder / f"{name}.fmu", start=start)
        if problems := validate(made):
            raise PlanError("FMU not valid: " + "; ".join(problems))
        return made

    def cosimulate(self, out: Path | None, progress: Progress) -> MirrorRun:
        """Run all flips with an FMU on each side, and the first one as one system."""
        mirror = self.scene.mirror
        with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
            fmu = self.build(out if out is not None else Path(folder))
            done = self.couple_fmus(
                fmu,
                mirror,
                mirror.waveform.stop_time,
                self.scene.study.communication_step,
                progress,
            )
        from ...models.micromirror.monolithic import simulate_whole

        made = tip_law(self.scene.tip, self.scene.study.humidity)
        end = self.first_landing(done.motion)
        times = done.motion["time"]
        whole = simulate_whole(
            mirror, made, self.scene.start, end, times=times[times <= end], stop=self.scene.stop
        )
        return MirrorRun(made, done.motion, whole, done.seconds, done.log, done.sites)

    def couple_fmus(
        self,
        fmu: Path,
        mirror: Mirror,
        stop_time: float,
        step: float,
        progress: Progress | None = None,
    ) -> FmuRun:
        """Couple a mirror at rest to an FMU on each side."""
        from time import perf_counter

        from ...fmu.framework.instance import Instance

        scene = self.scene
        with Instance(fmu) as plus, Instance(fmu) as minus:
            for one, side in ((plus, 1.0), (minus, -1.0)):
                height = root_height(mirror.tips, scene.start[0], side)
                one.start({"z": height}, stop_time)
            begun = perf_counter()
            motion = couple(
                mirror,
                (FmuTip(plus), FmuTip(minus)),
                scene.opening.stiffness,
                scene.start,
                stop_time,
                step,
                progress=progress,
            )
            seconds = perf_counter() - begun
            sites = tuple(_site(one) for one in (plus, minus))
            free_time = plus.get(plus.references("t_free"))[0]
            return FmuRun(motion, seconds, tuple(plus.log + minus.log), free_time, sites)

    def first_landing(self, coupled: Motion) -> float:
        """Time [s] up to which runs are compared: the first touch of the other side, or its end."""
        touched = coupled["state_minus"] < 3.0
        end = coupled["time"][touched.argmax()] if touched.any() else coupled["time"][-1]
        return float(min(end, self.scene.mirror.waveform.start_delay + 20e-6))

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `Runnable.cost`."""
        from ..cost.micromirror import mirror_sweep
        from ..cost.separation import cost_report

        return cost_report(mirror_sweep(self, progress), out, error, self.name)


def _site(tips: Instance) -> dict[str, float]:
    """What the landing sites of a side have had, from the outputs of its FMU."""
    names = ("d_max", "F_max", "W_land", "W_plastic")
    found = dict(zip(names, tips.get(tips.references(*names)), strict=True))
    return found | {"n_land": float(tips.get_integers(tips.references("n_land"))[0])}


def _share(progress: Progress, low: float, high: float, share: float) -> None:
    """Report the share that is done of a part of a run as one of all of it."""
    progress(low + (high - low) * share)
