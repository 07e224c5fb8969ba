"""Report of the fuel injector's co-simulations: table, signals in files, figures."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from ....files.results import save_csv, save_npz
from ....files.scenes import unstructure
from ....models.injector.scene import InjectorScene
from ....separation.effects.base import FilmStatus
from ....separation.effects.registry import TensionLimit
from ....separation.plan import plan
from ....units import bar, celsius
from ...report import Report
from .cosimulation import InjectorRun, cosimulate_cases
from .cycles import Cycle, cycles, dry_delay, run_error, stem
from .end_stop import end_stop_numbers

__all__ = ["plan_text", "report", "run_injector"]

Progress = Callable[[float], None]


def _held_by(run: InjectorRun, found: Sequence[Cycle], dry: float) -> str:
    """Which force held the spool, in words."""
    first = found[0]
    total = first.viscous_impulse + first.meniscus_impulse
    viscous = first.viscous_impulse / total if total > 0.0 else 0.0
    name = "viscous film" if viscous >= 0.5 else "meniscus"
    text = f"{name} ({100 * max(viscous, 1.0 - viscous):.0f} % of the impulse)"
    if first.limited_fraction > 0.0:
        cap = _tension(run) * math.pi * run.plan.scene.interface.rim_radius**2
        text += f", cut off near {cap:.1f} N {100 * first.limited_fraction:.0f} % of the time"
    if not math.isnan(first.delay) and first.delay < 1.1 * dry:
        text += "; hardly: mostly mass and coil"
    return text


def _tension(run: InjectorRun) -> float:
    """Tensile strength [Pa] of the oil in a run; inf without a limit."""
    limit = run.plan.scene.effect(TensionLimit)
    return math.inf if limit is None else limit.tension


def _limit_text(run: InjectorRun) -> str:
    tension = _tension(run)
    return "none" if math.isinf(tension) else f"{tension / bar:g} bar"


def plan_text(scene: InjectorScene) -> str:
    """Say what will be simulated, what will not, and by which sources."""
    made = plan(scene.separation(scene.temperature))
    loading, meniscus = scene.loading, made.scene.meniscus
    degrees = ", ".join(f"{t - celsius(0.0):g} degC" for t in scene.study.temperatures)
    head = [
        f"{scene.name}: pulled by a valve over {scene.valve.profile.cycles} cycles, gap "
        f"{loading.initial_gap:g} m to {loading.final_gap:g} m, faces of radius "
        f"{scene.interface.rim_radius:g} m",
        f"  at   {degrees}: {meniscus.liquid.name}",
        f"  by   FMUs valve-drive and stiction-mass, communication step "
        f"{scene.study.communication_step:g} s",
        f"  on   {'valve':19s} coil, return spring, opposite stop",
    ]
    sources = ["sources:", *(f"  {line}" for line in made.cite().splitlines())]
    return "\n".join([*head, *str(made).splitlines()[1:], *sources])


def run_injector(scene: InjectorScene, out: Path | None, progress: Progress) -> Report:
    """Co-simulate the injector at all temperatures, and write signals and figures to a folder."""
    return report(scene, cosimulate_cases(scene, out, progress), out)


def report(scene: InjectorScene, runs: Sequence[InjectorRun], out: Path | None) -> Report:
    """Turn the runs into a table and, with a folder, into signals and figures."""
    dry = dry_delay(scene)
    lines = [
        f"{scene.name}: {scene.valve.profile.cycles} firing cycles, FMUs valve-drive and "
        f"stiction-mass, communication step {scene.study.communication_step * 1e6:g} us",
        f"a dry spool would be released {dry * 1e3:.3f} ms after energising",
        "",
        f"{'oil':>9s}  {'tension':>8s}  {'release':>9s}  {'sticks':>9s}  {'peak force':>10s}  "
        f"{'impulse':>9s}  {'coupling':>8s}  {'seconds':>7s}  held by",
        f"{'':>9s}  {'limit':>8s}  {'[ms]':>9s}  {'[ms]':>9s}  {'[N]':>10s}  {'[N.s]':>9s}  "
        f"{'error':>8s}  {'':>7s}",
    ]
    scalars: dict[str, tuple[Any, str]] = {"dry_release_delay": (dry, "s")}
    spread = [""]
    for run in runs:
        found = cycles(run, scene)
        delays = [c.delay for c in found]
        delay = delays[0]
        spread.append(_spread(run, delays))
        error = run_error(run, found)
        peak = max(c.peak_force for c in found)
        stuck = math.isnan(delay)
        lines.append(
            f"{run.label:>9s}  {_limit_text(run):>8s}  "
            f"{'never' if stuck else f'{delay * 1e3:.4f}':>9s}  "
            f"{'all pulse' if stuck else f'{(delay - dry) * 1e3:.4f}':>9s}  {peak:10.2f}  "
            f"{found[0].viscous_impulse + found[0].meniscus_impulse:9.2e}  "
            f"{'-' if math.isnan(error) else f'{error:.0e}':>8s}  {run.seconds:7.2f}  "
            f"{_held_by(run, found, dry)}"
        )
        key = f"{stem(run.temperature)}_{_limited(run)}"
        scalars |= {
            f"release_delay_{key}": (delay, "s"),
            f"sticking_time_{key}": (delay - dry, "s"),
            f"releases_{key}": (sum(not math.isnan(d) for d in delays), "-"),
            f"peak_force_{key}": (peak, "N"),
            f"viscous_impulse_{key}": (found[0].viscous_impulse, "N.s"),
            f"meniscus_impulse_{key}": (found[0].meniscus_impulse, "N.s"),
            f"coupling_error_{key}": (error, "-"),
            f"seconds_{key}": (run.seconds, "s"),
        }
    keys = [f"{stem(run.temperature)}_{_limited(run)}" for run in runs]
    impacts, numbers = end_stop_numbers(scene, runs, keys)
    scalars |= numbers
    lines += [*spread, *impacts, *_validity(runs)]
    text = "\n".join(lines)
    if out is None:
        return Report(scalars, text)
    files = _write(scene, runs, out)
    return Report(scalars, text, files, partial(_draw, scene, runs, out, dry))


def _limited(run: InjectorRun) -> str:
    return "limited" if run.limited else "unlimited"


def _spread(run: InjectorRun, delays: Sequence[float]) -> str:
    """Say how many cycles of a run were released, and how far they agree."""
    good = [d for d in delays if not math.isnan(d)]
    text = (
        f"{run.label}, tension limit {_limit_text(run)}: "
        f"{len(good)} of {len(delays)} cycles released"
    )
    if good:
        text += f", after {min(good) * 1e3:.4f} to {max(good) * 1e3:.4f} ms"
    return text


def _validity(runs: Sequence[InjectorRun]) -> list[str]:
    """Say for each temperature how far the models were inside their ranges."""
    lines = [""]
    for run in runs:
        if not run.limited:
            continue
        whole = run.coupled["state"] != FilmStatus.BROKEN
        gaps, speeds = run.coupled["h"][whole], run.coupled["v"][whole]
        found = run.plan.validity(list(zip(gaps.tolist(), speeds.tolist(), strict=True)))
        numbers = [
            f"{n.name} {n.value:.2g} {'ok' if n.is_valid else 'OUT OF RANGE'}"
            for n in found
            if n.value is not None
        ]
        lines.append(f"validity, {run.label}: {', '.join(numbers)}")
    return lines


def _write(scene: InjectorScene, runs: Sequence[InjectorRun], out: Path) -> tuple[Path, ...]:
    files = []
    for run in runs:
        limit = "" if run.limited else "_without_tension_limit"
        file = out / f"signals_{stem(run.temperature)}{limit}"
        columns = {"time": run.coupled.time, **run.coupled.columns}
        headings = {"time": "time [s]"} | {n: p.heading for n, p in run.coupled.ports.items()}
        header = {
            "scene": unstructure(scene),
            "temperature": run.temperature,
            "tension_limit": run.limited,
            "units": {n: p.unit for n, p in run.coupled.ports.items()} | {"time": "s"},
        }
        files += [save_csv(file, columns, headings), save_npz(file, columns, header)]
    return tuple(files)


def _draw(
    scene: InjectorScene, runs: Sequence[InjectorRun], out: Path, dry: float
) -> tuple[Path, ...]:
    from .figures import draw

    return draw(scene, runs, out, dry)
