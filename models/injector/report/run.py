"""Report of the fuel injector's co-simulations: table, signals in files, figures."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from ....export.report import FmuStart, Report, validity_lines
from ....files.results import save_csv, save_npz
from ....files.scenes import unstructure
from ....separation.effects.base import FilmStatus
from ....separation.effects.viscous import TensionLimit
from ....separation.plan import plan
from ....units import bar, celsius
from ....validity import ValidityNumber
from ..delays import delay, dry_delay
from ..scene import InjectorScene
from .cosimulation import InjectorRun, cosimulate_cases
from .cycles import Cycle, cycles, held_pressure, largest_pull, run_error
from .deformation import deformation_numbers
from .end_stop import end_stop_numbers

__all__ = ["cost", "fmu_start", "plan_text", "report", "run"]

Progress = Callable[[float], None]


def _held_by(run: InjectorRun, found: Sequence[Cycle], dry: float) -> str:
    """Which force held the spool, in words."""
    first = found[0]
    total = first.viscous_impulse + first.meniscus_impulse
    viscous = first.viscous_impulse / total if total > 0.0 else 0.0
    name = "viscous film" if viscous >= 0.5 else "meniscus"
    text = name
    if first.meniscus_impulse:
        text += f" ({100 * max(viscous, 1.0 - viscous):.0f} % of the impulse)"
    if first.cavitated_fraction > 0.0:
        text += f", cavitated {100 * first.cavitated_fraction:.0f} % of the time"
    if not math.isnan(first.delay) and first.delay < 1.1 * dry:
        text += "; hardly: mostly mass and coil"
    return text


def _oil_text(run: InjectorRun) -> tuple[str, str]:
    """Tension at which the oil of a run cavitates, and pressure of the cavity then."""
    limit = run.plan.scene.effect(TensionLimit)
    if limit is None or math.isinf(limit.tension):
        return "never", "-"
    held = f"{limit.pressure_in_cavity / bar:.3g} bar"
    return f"{limit.tension / bar:g} bar", held


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


def run(scene: InjectorScene, out: Path | None, progress: Progress) -> Report:
    """Co-simulate the injector at all temperatures, and write signals and figures to a folder."""
    return report(scene, cosimulate_cases(scene, out, progress), out)


def cost(scene: InjectorScene, out: Path | None, progress: Progress, error: float) -> Report:
    """See `models.device.DeviceReport.cost`."""
    from .cost import injector_cost

    return injector_cost(scene, out, progress, error)


def fmu_start(scene: InjectorScene) -> FmuStart:
    """See `models.device.DeviceReport.fmu_start`."""
    from ....fmu.slaves.stiction_mass import mass_values

    film = scene.separation(scene.temperature)
    return FmuStart("stiction-mass", mass_values(film), film)


def report(scene: InjectorScene, runs: Sequence[InjectorRun], out: Path | None) -> Report:
    """Turn the runs into a table and, with a folder, into signals and figures."""
    dry, pull = dry_delay(scene), largest_pull(scene)
    lines = [
        f"{scene.name}: {scene.valve.profile.cycles} firing cycles, FMUs valve-drive and "
        f"stiction-mass, communication step {scene.study.communication_step * 1e6:g} us",
        f"a dry spool would be released {dry * 1e3:.3f} ms after energising",
        "",
        f"{'oil':>9s}  {'cavitates':>7s}  {'cavity':>9s}  {'release':>9s}  {'sticks':>9s}  "
        f"{'peak force':>10s}  {'impulse':>9s}  {'coupling':>8s}  {'seconds':>7s}  held by",
        f"{'':>9s}  {'at':>7s}  {'':>9s}  {'[ms]':>9s}  {'[ms]':>9s}  {'[N]':>10s}  "
        f"{'[N.s]':>9s}  {'error':>8s}  {'(wall)':>7s}",
    ]
    scalars: dict[str, tuple[Any, str]] = {"dry_release_delay": (dry, "s")}
    spread = [""]
    for run in runs:
        found = cycles(run, scene)
        lines.append(_row(run, found, dry))
        spread.append(_spread(run, [c.delay for c in found], scene))
        scalars |= _scalars(run, found, dry)
    impacts, numbers = end_stop_numbers(scene, runs, [run.name for run in runs])
    softened, changes = deformation_numbers(scene, pull)
    validity = _validity(runs)
    lines += [*spread, *_what_decides(scene, runs, pull), *softened, *impacts]
    lines += ["", *validity_lines(validity)]
    numbers |= changes
    text = "\n".join(lines)
    if out is None:
        return Report(scalars | numbers, text, validity=validity)
    write = partial(_write, scene, runs, out)
    draw = partial(_draw, scene, runs, out, dry, pull)
    return Report(scalars | numbers, text, write, draw, validity)


def _row(run: InjectorRun, found: Sequence[Cycle], dry: float) -> str:
    """Line of the table for a run."""
    delay, error = found[0].delay, run_error(run, found)
    stuck = math.isnan(delay)
    cavitates, cavity = _oil_text(run)
    return (
        f"{run.label:>9s}  {cavitates:>7s}  {cavity:>9s}  "
        f"{'never' if stuck else f'{delay * 1e3:.4f}':>9s}  "
        f"{'all pulse' if stuck else f'{(delay - dry) * 1e3:.4f}':>9s}  "
        f"{float(run.coupled['F_peak'][-1]):10.2f}  "
        f"{found[0].viscous_impulse + found[0].meniscus_impulse:9.2e}  "
        f"{'-' if math.isnan(error) else f'{error:.0e}':>8s}  {run.seconds:7.2f}  "
        f"{_held_by(run, found, dry)}"
    )


def _scalars(run: InjectorRun, found: Sequence[Cycle], dry: float) -> dict[str, tuple[Any, str]]:
    """Numbers of a run for scripts."""
    key, delay = run.name, found[0].delay
    return {
        f"release_delay_{key}": (delay, "s"),
        f"sticking_time_{key}": (delay - dry, "s"),
        f"releases_{key}": (sum(not math.isnan(c.delay) for c in found), "-"),
        f"peak_force_{key}": (float(run.coupled["F_peak"][-1]), "N"),
        f"viscous_impulse_{key}": (found[0].viscous_impulse, "N.s"),
        f"meniscus_impulse_{key}": (found[0].meniscus_impulse, "N.s"),
        f"coupling_error_{key}": (run_error(run, found), "-"),
        f"seconds_{key}": (run.seconds, "s"),
    }


def _spread(run: InjectorRun, delays: Sequence[float], scene: InjectorScene) -> str:
    """Say how many cycles of a run were released, how far they agree, and where it rests."""
    good = [d for d in delays if not math.isnan(d)]
    text = f"{run.label}, cavity at {_oil_text(run)[1]}: {len(good)} of {len(delays)} released"
    if good:
        each = ", ".join(f"{d * 1e3:.3f}" for d in good)
        text += f", after {each} ms"
    rests = float(run.coupled["h"][-1]) - scene.loading.rest_gap
    return f"{text}; at the end {rests * 1e6:.2f} um off the end cap"


def _what_decides(scene: InjectorScene, runs: Sequence[InjectorRun], pull: float) -> list[str]:
    """Say which property of the oil decides, and what an oil that never cavitates would do."""
    limit = scene.tension_limit
    if limit is None or limit.cavity != "mass-conserving" or math.isinf(limit.tension):
        return []
    area, holds = math.pi * scene.interface.rim_radius**2, held_pressure(scene, limit, pull)
    pressed = [delay(scene, t, ambient_pressure=holds) for t in scene.study.temperatures]
    above = ", ".join("never" if math.isnan(d) else f"{d * 1e3:.3f} ms" for d in pressed)
    never = [delay(scene, t, cavitates=False) for t in scene.study.temperatures]
    each = ", ".join("never" if math.isnan(d) else f"{d * 1e3:.3f} ms" for d in never)
    first: dict[bool, list[float]] = {}
    for run in runs:
        first.setdefault(run.sustained, []).append(cycles(run, scene)[0].delay)
    held = [
        f"{_oil_text(next(r for r in runs if r.sustained is sustained))[1]}: "
        + ", ".join("never" if math.isnan(d) else f"{d * 1e3:.3f}" for d in found)
        + " ms"
        for sustained, found in first.items()
    ]
    return [
        "",
        f"strength decides whether the film cavitates: at {0.5 * area * limit.tension:.1f} N, half "
        f"of strength times area; the pull reaches {pull:.1f} N, so an oil of up to "
        f"{2.0 * pull / area / bar:.1f} bar cavitates",
        f"an oil that never cavitates is released after, from cold to warm: {each}",
        f"the pressure in the cavity decides how long it holds then, by {'; by '.join(held)}",
        f"the pressure around the face, here {limit.ambient_pressure / bar:.3g} bar, decides "
        f"before both: from {holds / bar:.1f} bar on the cavity holds the whole pull, and the "
        f"spool is released after, from cold to warm: {above}",
        "none of the three is known for this valve: they are assumptions of the scene",
    ]


def _validity(runs: Sequence[InjectorRun]) -> list[tuple[str, ValidityNumber]]:
    """How far the models were inside their ranges, at each temperature."""
    found = list[tuple[str, ValidityNumber]]()
    for run in runs:
        if run.sustained:
            continue
        whole = run.coupled["state"] != FilmStatus.BROKEN
        gaps, speeds = run.coupled["h"][whole], run.coupled["v"][whole]
        pairs = list(zip(gaps.tolist(), speeds.tolist(), strict=True))
        found += [(run.label, number) for number in run.plan.validity(pairs)]
    return found


def _write(scene: InjectorScene, runs: Sequence[InjectorRun], out: Path) -> tuple[Path, ...]:
    files = []
    for run in runs:
        file = out / f"signals_{run.name}"
        columns = {"time": run.coupled.time, **run.coupled.columns}
        headings = {"time": "time [s]"} | {n: p.heading for n, p in run.coupled.ports.items()}
        header = {
            "scene": unstructure(scene),
            "temperature": run.temperature,
            "sustained": run.sustained,
            "units": {n: p.unit for n, p in run.coupled.ports.items()} | {"time": "s"},
        }
        files += [save_csv(file, columns, headings), save_npz(file, columns, header)]
    return tuple(files)


def _draw(
    scene: InjectorScene, runs: Sequence[InjectorRun], out: Path, dry: float, pull: float
) -> tuple[Path, ...]:
    from .figures import draw

    return draw(scene, runs, out, dry, pull)
