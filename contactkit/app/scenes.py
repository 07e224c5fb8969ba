"""Opening a scene by file or by name, and running it: plain separations and devices alike."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from attrs import frozen

from ..errors import DescriptionError, PlanError
from ..files.scenes import nearest, read_tables, scene_kind, structure, without_humidity
from ..models.end_stop.faces import beside
from ..models.library import bundled_scene
from ..scene.contact_scene import ContactScene
from ..scene.scenes import SeparationScene, SlidingScene
from ..separation.plan import Plan, plan
from .report import Report

if TYPE_CHECKING:
    from ..separation.results import SeparationResult

__all__ = ["Report", "Runnable", "open_scene"]

Progress = Callable[[float], None]

DEVICES = {
    "fuel-injector": "injector.run",
    "micromirror": "micromirror.run",
    "bridges": "bridges.run",
}
"""Modules of this package that run a scene with a ``device`` key."""


class Runnable(Protocol):
    """What the command line asks of a scene."""

    @property
    def name(self) -> str:
        """Title of the scene."""

    def run(self, out: Path | None, progress: Progress) -> Report:
        """Simulate, and write curves and figures to a folder."""

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """Show what accuracy costs in time."""

    def plan_text(self) -> str:
        """Say what will be simulated, what will not, and by which sources."""

    def fmu_start(self) -> tuple[str, Mapping[str, Any]]:
        """Name of the FMU that holds this scene, and the start values to bake in."""


def open_scene(name: str) -> Runnable:
    """Open a scene file, or a scene of this package by its name, such as ``fuel-injector``.

    Raises
    ------
    DescriptionError
        If there is no such file or name, or the file has mistakes.
    """
    path = Path(name)
    if not path.suffix and not path.exists():
        path = bundled_scene(name)
    tables = read_tables(path)
    device = tables.pop("device", None)
    if device is None:
        tables = dict(without_humidity(tables, path.name))
    if device is None and scene_kind(tables) is ContactScene:
        from .contact import open_contact

        return open_contact(tables, path.name)
    if device is None and scene_kind(tables) is SlidingScene:
        from .sliding import PlainSliding

        return PlainSliding(structure(tables, SlidingScene, path.name))
    if device is None:
        return PlainScene(structure(tables, SeparationScene, path.name))
    if device not in DEVICES:
        hint = nearest(device, sorted(DEVICES))
        raise DescriptionError(f"{path.name}, device", device, "be a known device", hint=hint)
    module = import_module(f".{DEVICES[device]}", __package__)
    opened: Runnable = module.open_device(beside(tables, path.parent), path.name)
    return opened


@frozen
class PlainScene:
    """A separation scene as the command line runs it."""

    scene: SeparationScene

    @property
    def name(self) -> str:
        """Title of the scene."""
        return self.scene.name or "separation"

    def plan_text(self) -> str:
        """See `Runnable.plan_text`."""
        made = plan(self.scene)
        return f"{made}\nsources:\n" + "\n".join(f"  {line}" for line in made.cite().splitlines())

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `Runnable.run`."""
        import warnings

        from ..errors import ValidityWarning
        from ..separation.simulate import simulate

        made = plan(self.scene)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ValidityWarning)  # the report prints every number
            result = simulate(made, progress=progress)
        scalars: dict[str, tuple[Any, str]] = {"status": (result.status, "-"), **result.scalars()}
        files = _write(result, out) if out is not None else ()
        return Report(scalars, _text(made, result), files)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `Runnable.cost`."""
        from .cost.separation import cost_report, separation_sweep

        return cost_report(separation_sweep(self.scene, progress), out, error, self.name)

    def fmu_start(self) -> tuple[str, Mapping[str, Any]]:
        """See `Runnable.fmu_start`."""
        return "stiction-mass", mass_values(self.scene)


def _text(made: Plan, result: SeparationResult) -> str:
    width = max(len(name) for name in result.scalars())
    numbers = [f"  {n:{width}s}  {v:.6g} {u}" for n, (v, u) in result.scalars().items()]
    validity = [f"  {number}" for number in result.validity]
    errata = [f"  {line}" for one in result.errata for line in str(one).splitlines()]
    if errata:
        errata = ["errata of what is taken as printed, at the start:", *errata]
    work = result.work
    cost = f"{work.n_steps} steps, {work.n_evaluations} force evaluations, {work.seconds:.3f} s"
    lines = [str(made), result.message, *numbers, "validity:", *validity, *errata, cost]
    return "\n".join(lines)


def _write(result: SeparationResult, out: Path) -> tuple[Path, ...]:
    from ..files.results import save_csv, save_result
    from ..plot import separation as plot
    from ..separation.results import COLUMNS

    headings = {c.name: f"{c.name} [{c.unit}]" for c in COLUMNS}
    files = [
        save_result(result, out / "result"),
        save_csv(out / "result", result.columns, headings),
    ]
    if {"viscous_force", *result.plan.film.static_columns} & result.columns.keys():
        made, ax = plot.figure()
        plot.forces(result, ax)
        plot.title(ax, result.plan.scene.name)
        files.append(plot.save(made, out / "forces"))
    if "mean_pull" in result.columns:
        made, ax = plot.figure()
        plot.cycles(result, ax)
        plot.title(ax, result.plan.scene.name)
        files.append(plot.save(made, out / "cycles"))
    if result.state is not None:
        made, ax = plot.figure()
        plot.motion(result, ax)
        plot.title(ax, result.plan.scene.name)
        files.append(plot.save(made, out / "motion"))
    return tuple(files)


def mass_values(scene: SeparationScene) -> dict[str, Any]:
    """Parameters of the FMU ``stiction-mass`` for a scene.

    Raises
    ------
    PlanError
        If the FMU cannot represent the scene; says what stands against it.
    """
    from ..separation.effects.base import SeparationForce
    from ..separation.effects.registry import (
        MeniscusForce,
        Rupture,
        ShearLimit,
        TensionLimit,
        ViscousForce,
    )

    interface, opening, meniscus = scene.interface, scene.opening, scene.interface.meniscus
    liquid = meniscus.liquid.at(scene.temperature)
    viscous, film = scene.effect(ViscousForce), scene.effect(MeniscusForce)
    tension, shear, rupture = (
        scene.effect(TensionLimit),
        scene.effect(ShearLimit),
        scene.effect(Rupture),
    )
    against = [
        reason
        for reason, holds in {
            "two flats": interface.is_flat,
            "a face with a radius [m]": math.isfinite(interface.rim_radius),
            "opening.mass [kg]": opening.mass is not None,
            "an opening without vibration": opening.vibration is None,
            "no force of the solids": not any(
                isinstance(e, SeparationForce) and not e.needs_film for e in scene.effects
            ),
            "ViscousForce() with closure='volume-conserving'": viscous is not None
            and viscous.closure == "volume-conserving",
            "TensionLimit with cavity='truncated'": tension is None
            or tension.cavity == "truncated",
            "Rupture with a gap [m]": rupture is None
            or rupture.gap is not None
            or (rupture.criterion == "limit" and film is not None and film.profile == "exact"),
            "MeniscusForce(profile='as-published') with pulled='lower'": film is None
            or film.profile != "as-published"
            or film.pulled == "lower",
        }.items()
        if not holds
    ]
    if against:
        cure = "change the scene, or add --native, which takes any scene with a mass"
        raise PlanError(f"the Python FMU stiction-mass needs {'; '.join(against)}; {cure}")
    laws = {"exact": "EXACT", "arc": "ARC", "as-published": "PUBLISHED"}
    law = "NONE" if film is None else laws[film.profile]
    return {
        "m": opening.mass,
        "h0": opening.initial_gap,
        "v0": opening.initial_speed,
        "k_s": opening.stiffness,
        "h_rel": opening.final_gap,
        "h_min": opening.rest_gap,
        "h_break": (rupture.gap or 0.0) if rupture is not None else 0.0,
        "rewet": meniscus.rewetting,
        "R": interface.rim_radius,
        "eta": liquid.viscosity,
        "gamma": liquid.surface_tension or 0.0,
        "theta1": meniscus.contact_angle_lower,
        "theta2": meniscus.contact_angle_upper,
        "V": meniscus.volume or 0.0,
        "N": meniscus.count,
        "meniscus_law": law,
        "dp_cav": tension.pressure_drop if tension is not None else 0.0,
        "tau_lim": shear.strength if shear is not None else 0.0,
    }
