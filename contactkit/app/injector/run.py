"""The fuel injector: a spool valve held by an oil film, co-simulated over its firing cycles."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from attrs import evolve, field, frozen

from ...errors import DescriptionError, PlanError
from ...files.scenes import structure
from ...models.injector.valve import Valve
from ...scene.interface import Interface, Opening
from ...scene.scenes import SeparationScene
from ...separation.effects.registry import SeparationEffect, TensionLimit
from ...separation.plan import Plan, plan
from ...units import celsius, si
from ...validators import as_tuple, part, positive
from ..scenes import Report, mass_values

if TYPE_CHECKING:
    from ...analyses.load_displacement.curve import StopCurve
    from ...fmu.master.injector import CoSimulation
    from ...models.injector.monolithic_result import MonolithicResult

__all__ = [
    "FuelInjector",
    "InjectorScene",
    "Run",
    "Study",
    "drive_values",
    "open_device",
    "stop_curve_of",
]

Progress = Callable[[float], None]


def _all_positive(study: object, attribute: Any, values: tuple[float, ...]) -> None:
    for value in values:
        positive(study, attribute, value)


def _temperatures(study: object, attribute: Any, values: tuple[float, ...]) -> None:
    if not values:
        raise DescriptionError(
            "Study.temperatures", values, "name at least one temperature", unit="K"
        )
    _all_positive(study, attribute, values)


@frozen(kw_only=True)
class Study:
    """What the injector is run at.

    Parameters
    ----------
    temperatures : tuple of float
        Temperatures of the oil [K].
    tension_limits : tuple of float
        Tensions [Pa] the figure of the delays compares, beside none.
    communication_step : float
        Communication step of the co-simulation [s].
    """

    temperatures: tuple[float, ...] = field(
        converter=tuple, validator=_temperatures, metadata=si("K")
    )
    tension_limits: tuple[float, ...] = field(
        default=(), converter=tuple, validator=_all_positive, metadata=si("Pa")
    )
    communication_step: float = field(validator=positive, metadata=si("s"))


@frozen(kw_only=True)
class InjectorScene:
    """A separation scene whose pull comes from a valve, and the temperatures to run it at."""

    name: str = "fuel injector"
    temperature: float = field(default=celsius(20.0), validator=positive, metadata=si("K"))
    interface: Interface = field(validator=part(Interface))
    opening: Opening = field(validator=part(Opening))
    effects: tuple[SeparationEffect, ...] = field(converter=as_tuple)
    valve: Valve
    study: Study

    def separation(
        self, temperature: float, *, limited: bool = True, tension: float | None = None
    ) -> SeparationScene:
        """Film of the injector at a temperature [K].

        Without its tension limit if not `limited`, with another tension [Pa] if one is given.
        """
        kept = tuple(e for e in self.effects if limited or not isinstance(e, TensionLimit))
        if tension is not None:
            kept = tuple(
                evolve(e, tension=tension) if isinstance(e, TensionLimit) else e for e in kept
            )
        return SeparationScene(
            name=self.name,
            temperature=temperature,
            interface=self.interface,
            opening=self.opening,
            effects=kept,
        )

    @property
    def first_pulse_end(self) -> float:
        """Time at which the first current pulse ends [s]."""
        return self.valve.profile.start_delay + self.valve.profile.on_time

    @property
    def stop_time(self) -> float:
        """Time at which the last cycle ends [s]."""
        profile = self.valve.profile
        return profile.start_delay + profile.cycles * profile.period


class Run(NamedTuple):
    """One co-simulation at a temperature [K], with or without the tension limit, and its check."""

    temperature: float
    limited: bool
    plan: Plan
    coupled: CoSimulation
    whole: MonolithicResult
    seconds: float

    @property
    def label(self) -> str:
        """Temperature in degrees Celsius."""
        return f"{self.temperature - celsius(0.0):+.0f} degC"


def open_device(tables: Mapping[str, Any], origin: str) -> FuelInjector:
    """Open the tables of a fuel-injector scene file."""
    return FuelInjector(structure(tables, InjectorScene, origin))


@frozen
class FuelInjector:
    """The fuel injector as the command line runs it."""

    scene: InjectorScene

    @property
    def name(self) -> str:
        """Title of the scene."""
        return self.scene.name

    def plan_text(self) -> str:
        """See `Runnable.plan_text`."""
        scene = self.scene
        made = plan(scene.separation(scene.temperature))
        opening, meniscus = scene.opening, scene.interface.meniscus
        degrees = ", ".join(f"{t - celsius(0.0):g} degC" for t in scene.study.temperatures)
        head = [
            f"{scene.name}: pulled by a valve over {scene.valve.profile.cycles} cycles, gap "
            f"{opening.initial_gap:g} m to {opening.final_gap:g} m, faces of radius "
            f"{scene.interface.rim_radius:g} m",
            f"  at   {degrees}: {meniscus.liquid.name}",
            f"  by   FMUs valve-drive and stiction-mass, communication step "
            f"{scene.study.communication_step:g} s",
            f"  on   {'valve':19s} coil, return spring, opposite stop",
        ]
        sources = ["sources:", *(f"  {line}" for line in made.cite().splitlines())]
        return "\n".join([*head, *str(made).splitlines()[1:], *sources])

    def fmu_start(self) -> tuple[str, Mapping[str, Any]]:
        """See `Runnable.fmu_start`."""
        return "stiction-mass", mass_values(self.scene.separation(self.scene.temperature))

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `Runnable.run`."""
        from .report import report

        return report(self.scene, self.runs(out, progress), out)

    def runs(self, out: Path | None, progress: Progress) -> list[Run]:
        """Build and validate the FMUs, and co-simulate each temperature with and without limit."""
        study = self.scene.study
        has_limit = self.scene.separation(self.scene.temperature).effect(TensionLimit) is not None
        limited = (True, False) if has_limit else (True,)
        cases = [(t, limit) for t in study.temperatures for limit in limited]
        with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
            drive, mass = self.build(out if out is not None else Path(folder))
            runs = []
            for i, (temperature, limit) in enumerate(cases):
                done = partial(_share, progress, i, len(cases))
                runs.append(self._run(drive, mass, temperature, limit, done))
        return runs

    def build(self, folder: Path) -> tuple[Path, Path]:
        """Build both FMUs with the values of the scene baked in, and validate them.

        Raises
        ------
        PlanError
            If an FMU is not valid.
        """
        from ...fmu.python.build import build, validate

        name, start = self.fmu_start()
        drive = build(
            "valve-drive", folder / "valve-drive.fmu", start=drive_values(self.scene.valve)
        )
        mass = build(name, folder / f"{name}.fmu", start=start)
        problems = validate(drive) + validate(mass)
        if problems:
            raise PlanError("FMU not valid: " + "; ".join(problems))
        return drive, mass

    def _run(
        self, drive: Path, mass: Path, temperature: float, limited: bool, progress: Progress
    ) -> Run:
        from time import perf_counter

        from ...fmu.master.injector import cosimulate
        from ...models.injector.monolithic import simulate

        scene = self.scene.separation(temperature, limited=limited)
        begun = perf_counter()
        coupled = cosimulate(
            drive,
            mass,
            self.scene.stop_time,
            self.scene.study.communication_step,
            mass_start=mass_values(scene),
            progress=progress,
        )
        seconds = perf_counter() - begun
        made, valve = plan(scene), self.scene.valve
        whole = simulate(made, valve, self.scene.stop_time, faces=stop_curve_of(valve))
        return Run(temperature, limited, made, coupled, whole, seconds)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `Runnable.cost`."""
        from ..cost.separation import cost_report, injector_sweep

        return cost_report(injector_sweep(self, progress), out, error, self.name)


def _share(progress: Progress, i: int, n: int, share: float) -> None:
    """Report the share that is done of the i-th of n runs as one of them all."""
    progress((i + share) / n)


def drive_values(valve: Valve) -> dict[str, Any]:
    """Parameters of the FMU ``valve-drive`` for a valve."""
    coil, spring, stop, profile = valve.coil, valve.spring, valve.stop, valve.profile
    faces = stop_curve_of(valve)
    return {
        "R_coil": coil.resistance,
        "N_turns": coil.turns,
        "A_pole": coil.pole_area,
        "g_air": coil.air_gap,
        "g_iron": coil.iron_gap,
        "B_sat": coil.saturation or 0.0,
        "k_spring": spring.stiffness,
        "F_preload": spring.preload,
        "h_stop": stop.gap,
        "k_stop": stop.stiffness,
        "d_stop": stop.damping,
        "t_delay": profile.start_delay,
        "T_period": profile.period,
        "t_on": profile.on_time,
        "U_boost": profile.boost_voltage,
        "t_boost": profile.boost_time,
        "U_hold": profile.hold_voltage,
        "U_off": profile.off_voltage,
        "n_cycles": profile.cycles,
        **({"curve": faces} if faces is not None else {}),
    }


def stop_curve_of(valve: Valve) -> StopCurve | None:
    """Curve of the rough faces of the stop, if it has any."""
    if valve.stop.faces is None:
        return None
    from ...models.end_stop.solve import solved

    return solved(valve.stop.faces)
