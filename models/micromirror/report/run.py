"""Report of a run of the micromirror: adhesion, release, flips; signals and figures."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ....export.report import FmuStart, Report, validity_lines
from ....files.results import save_csv, save_npz
from ....files.scenes import unstructure
from ....separation.effects.meniscus import MeniscusForce
from ....validity import ValidityNumber
from ..coupling import HELD, SIGNALS
from ..electrostatics import pull_in
from ..release import Landing, Release, landing, release_curve
from ..scene import MicromirrorScene
from ..tip_film import condensate_validity, tip_law
from .cosimulation import MirrorRun, cosimulate_flips, tip_start
from .deformation import deformation_numbers
from .landing_sites import landing_numbers

__all__ = ["cost", "fmu_start", "plan_text", "report", "run", "run_errors"]

Progress = Callable[[float], None]

UNITS = ("s", "rad", "rad/s", "V", "V", "m", "m", "N", "N", "N", "N", "-", "-")


def plan_text(scene: MicromirrorScene) -> str:
    """Say what will be simulated, what will not, and by which sources."""
    study = scene.study
    made = tip_law(scene.tip, study.humidity)
    wave, meniscus = scene.mirror.waveform, made.scene.meniscus
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


def run(scene: MicromirrorScene, out: Path | None, progress: Progress) -> Report:
    """Co-simulate the flips, look for release, and write signals and figures to a folder."""
    run = cosimulate_flips(scene, out, lambda done: progress(0.6 * done))
    return report(scene, run, out, lambda done: progress(0.6 + 0.4 * done))


def cost(scene: MicromirrorScene, out: Path | None, progress: Progress, error: float) -> Report:
    """See `models.device.DeviceReport.cost`."""
    from ....benchmarks.report import cost_report
    from .cost import mirror_sweep

    return cost_report(mirror_sweep(scene, progress), out, error, scene.name)


def fmu_start(scene: MicromirrorScene) -> FmuStart:
    """See `models.device.DeviceReport.fmu_start`."""
    return FmuStart("tip-contact", tip_start(scene, scene.study.humidity))


def report(scene: MicromirrorScene, run: MirrorRun, out: Path | None, progress: Progress) -> Report:
    """Turn the runs into text and numbers and, with a folder, into signals and figures."""
    found = release_curve(scene, progress)
    landed = landing(scene)
    free, error = run_errors(scene, run)
    landings, numbers = landing_numbers(scene, run)
    softened, changes = deformation_numbers(scene, _held_states(run))
    validity = _validity(run, found)
    lines = [
        f"{scene.name}: does it release?",
        *_landed_text(scene, landed),
        "",
        *_table(scene, found),
        "",
        *_verdict(scene, found),
        *_flips(scene, run, free, error),
        *landings,
        *softened,
        *validity_lines(validity),
    ]
    scalars: dict[str, tuple[Any, str]] = {
        "landed_tilt": (landed.tilt, "rad"),
        "tip_bend": (landed.bend, "m"),
        "preload": (landed.preload, "N"),
        "hinge_force": (landed.hinge_force, "N"),
        "spring_energy": (landed.spring_energy, "J"),
        "hinge_energy": (landed.hinge_energy, "J"),
        "first_free_time": (free, "s"),
        "coupling_error": (error, "-"),
        "seconds": (run.seconds, "s"),
        **numbers,
        **changes,
    }
    for one in found:
        scalars |= _scalars(scene, one)
    text = "\n".join(lines)
    if out is None:
        return Report(scalars, text, validity=validity)
    write = partial(_write, scene, run, found, out)
    return Report(scalars, text, write, partial(_draw, scene, run, found, out), validity)


def _landed_text(scene: MicromirrorScene, landed: Landing) -> list[str]:
    electrode, hinge = scene.mirror.electrode, scene.mirror.hinge
    edge = pull_in(electrode, hinge.stiffness)
    n = scene.mirror.tips.per_side
    return [
        f"at rest: tilt {math.degrees(landed.tilt):.2f} deg, {n} tips bent {landed.bend * 1e9:.1f} "
        f"nm press with {landed.preload * 1e9:.1f} nN; the hinge alone would lift with "
        f"{landed.hinge_force * 1e9:.1f} nN",
        f"stored: {landed.spring_energy * 1e15:.2f} fJ in the tips, "
        f"{landed.hinge_energy * 1e15:.2f} fJ in the hinge; the mirror pulls in at "
        f"{math.degrees(edge.tilt):.2f} deg, {edge.voltage:.2f} V",
    ]


def _table(scene: MicromirrorScene, found: Sequence[Release]) -> list[str]:
    n = scene.mirror.tips.per_side
    lines = [
        f"{'humid-':>7s} {'Kelvin':>7s} {'meniscus':>9s} {'solids':>7s} {'both':>7s} "
        f"{'energy':>9s} {'breaks at':>9s} {'spring alone':>13s} {'smallest':>9s} {'free at':>8s}",
        f"{'ity':>7s} {'radius':>7s} {'[nN]':>9s} {'[nN]':>7s} {'[nN]':>7s} "
        f"{'[fJ]':>9s} {'[nm]':>9s} {'releases':>13s} {'pulse [V]':>9s} {'[us]':>8s}",
    ]
    for one in found:
        held = one.adhesion
        dry = held.volume == 0.0
        alone = "no" if math.isnan(one.alone) else f"{one.alone * 1e6:.2f} us"
        none = math.isnan(one.reset_voltage)
        least = one.reset_voltage == abs(scene.mirror.waveform.bias_voltage)
        pulse = "none" if none else "the bias" if least else f"{one.reset_voltage:.2f}"
        radius = "dry" if dry else f"{held.kelvin_radius * 1e9:.2f} nm"
        lines.append(
            f"{100 * held.humidity:5.0f} % {radius:>7s} "
            f"{n * held.meniscus_force * 1e9:9.1f} {n * held.solid_force * 1e9:7.1f} "
            f"{n * held.force * 1e9:7.1f} {n * held.energy * 1e15:9.3f} "
            f"{'-' if dry else f'{held.break_gap * 1e9:.1f}':>9s} {alone:>13s} "
            f"{pulse:>9s} "
            f"{'-' if none else f'{one.reset_delay * 1e6:.2f}':>8s}"
        )
    return [*lines, f"forces and energies of the {n} tips of a side together"]


def _verdict(scene: MicromirrorScene, found: Sequence[Release]) -> list[str]:
    study, wave = scene.study, scene.mirror.waveform
    lines = []
    alone = [one for one in found if not math.isnan(one.alone)]
    stuck = [one for one in found if math.isnan(one.alone)]
    if stuck:
        first = stuck[0].adhesion.humidity
        ratio = landing(scene).spring_energy / _energy(scene, stuck[0])
        lines.append(
            f"the spring tips alone release {len(alone)} of {len(found)} cases; from a humidity of "
            f"{100 * first:g} % a reset pulse is needed"
        )
        if ratio > 1.0:
            lines.append(
                f"the energy stored in the tips is {ratio:.0f} times that of the separation then: "
                "it is the force that fails"
            )
    elif found:
        lines.append("the spring tips alone release every case")
    never = [one.adhesion.humidity for one in found if math.isnan(one.reset_voltage)]
    if never:
        lines.append(
            f"no pulse up to {study.largest_reset:g} V releases at a humidity of "
            f"{100 * never[0]:g} %"
        )
    most = max((one.reset_voltage for one in found if not math.isnan(one.reset_voltage)), default=0)
    if most and not never:
        lines.append(
            f"{most:.1f} V for {wave.reset_time * 1e6:g} us release every case; the scene gives "
            f"{abs(wave.reset_voltage):g} V"
        )
    return lines


def _energy(scene: MicromirrorScene, one: Release) -> float:
    return scene.mirror.tips.per_side * one.adhesion.energy


def run_errors(scene: MicromirrorScene, run: MirrorRun) -> tuple[float, float]:
    """Time [s] at which the side + is first free, and error of the tilt over the landing tilt [-].

    The tilt is compared with that of the monolithic model up to the first touch of the other side.
    """
    free = run.monolithic.first("is free")
    both = run.coupled["tilt"][: len(run.monolithic.time)] - run.monolithic.unknowns[0]
    return free, float(np.abs(both).max()) / scene.mirror.tips.landing_tilt


def _flips(scene: MicromirrorScene, run: MirrorRun, free: float, error: float) -> list[str]:
    wave, coupled = scene.mirror.waveform, run.coupled
    lands = [e for e in run.log if e.startswith("landed")]
    begun = wave.start_delay
    ending = "not released" if math.isnan(free) else f"free {(free - begun) * 1e6:.3f} us after it"
    final = math.degrees(float(coupled["tilt"][-1]))
    return [
        f"run at {100 * scene.study.humidity:g} %: {wave.flips} flips, pulse of "
        f"{abs(wave.reset_voltage):g} V begins at {begun * 1e6:g} us, {ending}; {len(lands)} "
        f"landings and bounces of tips; at the end {final:+.2f} deg",
        f"two FMUs tip-contact: {coupled.n_steps} steps of at most "
        f"{scene.study.communication_step * 1e9:g} ns in {run.seconds:.2f} s wall time; tilt off "
        f"the monolithic model by {error:.1e} of the landing tilt up to the first touch of the "
        "other side",
    ]


def _held_states(run: MirrorRun) -> list[tuple[float, float]]:
    """Gaps [m] and speeds [m/s] of the tips of the side + while a film spans their gap."""
    held = run.coupled["state_plus"] == HELD
    if not held.any():
        return []
    gaps = run.coupled["gap_plus"]
    speeds = np.gradient(gaps, run.coupled["time"])
    # Only while a film spans the gap has the film any validity to speak of.
    law = run.plan.film.laws.get(MeniscusForce)
    spans = held & (gaps < (law.end if law is not None else math.inf))
    return list(zip(gaps[spans].tolist(), speeds[spans].tolist(), strict=True))


def _validity(run: MirrorRun, found: Sequence[Release]) -> list[tuple[str, ValidityNumber]]:
    """How far the models were inside their ranges."""
    pairs = _held_states(run)
    held = run.plan.validity(pairs) if pairs else ()
    condensed = condensate_validity(one.adhesion for one in found)
    return [*(("lift-off", one) for one in held), *(("condensate", one) for one in condensed)]


def _scalars(scene: MicromirrorScene, one: Release) -> dict[str, tuple[Any, str]]:
    held, n = one.adhesion, scene.mirror.tips.per_side
    key = f"{100 * held.humidity:.0f}_percent"
    return {
        f"meniscus_force_{key}": (n * held.meniscus_force, "N"),
        f"solid_force_{key}": (n * held.solid_force, "N"),
        f"separation_energy_{key}": (n * held.energy, "J"),
        f"free_time_spring_alone_{key}": (one.alone, "s"),
        f"smallest_reset_{key}": (one.reset_voltage, "V"),
        f"free_time_reset_{key}": (one.reset_delay, "s"),
    }


def _write(
    scene: MicromirrorScene, run: MirrorRun, found: Sequence[Release], out: Path
) -> tuple[Path, ...]:
    columns = dict(run.coupled.signals)
    units = dict(zip(SIGNALS, UNITS, strict=True))
    headings = {name: f"{name} [{unit}]" for name, unit in units.items()}
    header = {
        "scene": unstructure(scene),
        "humidity": scene.study.humidity,
        "units": units,
    }
    curve = {
        "humidity": [one.adhesion.humidity for one in found],
        "meniscus_force": [one.adhesion.meniscus_force for one in found],
        "solid_force": [one.adhesion.solid_force for one in found],
        "energy": [one.adhesion.energy for one in found],
        "reset_voltage": [one.reset_voltage for one in found],
    }
    table = {name: np.array(values) for name, values in curve.items()}
    heads = dict(
        zip(
            table,
            (
                "humidity [-]",
                "meniscus_force [N]",
                "solid_force [N]",
                "energy [J]",
                "reset_voltage [V]",
            ),
            strict=True,
        )
    )
    return (
        save_csv(out / "signals", columns, headings),
        save_npz(out / "signals", columns, header),
        save_csv(out / "release", table, heads),
    )


def _draw(
    scene: MicromirrorScene, run: MirrorRun, found: Sequence[Release], out: Path
) -> tuple[Path, ...]:
    from .figures import draw

    return draw(scene, run, found, out)
