"""What accuracy costs in time, for the scenes of the command line."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attrs import evolve

from ...accuracy import Accuracy
from ...errors import InfeasibleError, PlanError, ValidityWarning
from ...scene.scenes import SeparationScene
from ...separation.effects.registry import MeniscusForce, Rupture, SeparationEffect, ViscousForce
from ...separation.plan import plan
from ...work_precision import Outcome, Setting, WorkPrecision, sweep
from ..scenes import Report, mass_values
from .coupling import coupling_picture, coupling_settings

if TYPE_CHECKING:
    from ...models.injector.monolithic import Drive
    from ..injector.run import FuelInjector, InjectorScene

__all__ = ["cost_report", "injector_sweep", "separation_sweep"]

Progress = Callable[[float], None]

_TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
_STEPS = (50e-6, 20e-6, 10e-6, 5e-6, 2e-6, 1e-6)  # [s]


def cost_report(found: WorkPrecision, out: Path | None, error: float, name: str) -> Report:
    """Turn a sweep into a table, numbers, and with a folder a picture and a CSV file."""
    try:
        best = found.cheapest(error)
        advice = (
            f"cheapest with an error of at most {error:g}: {best.method}, {best.label}, "
            f"{best.seconds:.4f} s"
        )
    except InfeasibleError as problem:
        advice = str(problem)
    scalars: dict[str, tuple[Any, str]] = {found.quantity: (found.reference, "s")}
    for point in found.points:
        key = f"{point.method} / {point.label}"
        scalars |= {f"{key} / error": (point.error, "-"), f"{key} / seconds": (point.seconds, "s")}
        scalars |= {f"{key} / {count}": (value, "-") for count, value in point.counts.items()}
    files = _write(found, out, name) if out is not None else ()
    return Report(scalars, f"{found.table()}\n{advice}", files)


def _write(found: WorkPrecision, out: Path, name: str) -> tuple[Path, ...]:
    from ...files.scenes import write_whole
    from ...plot import separation as plot

    made, ax = plot.figure(size=(8.0, 5.2))
    plot.work_precision(found, ax, "osD^vP*X<>hdp")
    plot.title(ax, f"{name}: what accuracy costs")
    table = out / "cost.csv"
    with write_whole(table) as temporary:
        rows = [f'"{p.method}","{p.label}",{p.error!r},{p.seconds!r}' for p in found.points]
        temporary.write_text("\n".join(["method,setting,error [-],seconds [s]", *rows, ""]))
    written: tuple[Path, ...] = (plot.save(made, out / "cost"), table)
    if any(p.method.startswith("film by impulse") for p in found.points):
        written += (coupling_picture(found, out, name),)
    return written


def separation_sweep(scene: SeparationScene, progress: Progress) -> WorkPrecision:
    """Error of the release time of a pull over the tolerance of time, against another solver."""
    if scene.opening.imposed != "force" or scene.opening.mass is None:
        raise PlanError(
            "cost needs a scene with opening.force [N] and opening.mass [kg]: a curve at an "
            "imposed speed or time is closed form and costs microseconds"
        )
    from ...separation.simulate import drive

    made = plan(scene)
    end = 1.001 * _release(scene, 1e-8).value
    pull = drive(made)
    exact, near = (_whole_release(scene, pull, end, rtol) for rtol in (1e-11, 1e-9))
    settings = [
        Setting("contactkit motion", f"rtol {rtol:.0e}", partial(_release, scene, rtol))
        for rtol in _TOLERANCES
    ]
    settings += [
        Setting(
            "one system, scipy Radau",
            f"rtol {rtol:.0e}",
            partial(_whole_release, scene, pull, end, rtol),
        )
        for rtol in _TOLERANCES[1::2]
    ]
    settings += [
        Setting(name, f"rtol {rtol:.0e}", partial(_release, other, rtol), is_model=True)
        for name, other in _other_menisci(scene).items()
        for rtol in _TOLERANCES[::3]
    ]
    floor = max(abs(near.value / exact.value - 1.0), 1e-14)
    return sweep(settings, exact.value, quantity="release time", floor=floor, progress=progress)


def _release(scene: SeparationScene, rtol: float) -> Outcome:
    from ...separation.simulate import simulate

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        result = simulate(plan(scene, Accuracy(time_rtol=rtol)))
    if result.status != "released" or result.state is None:
        raise PlanError(f"cost needs a scene that is released; {result.message}")
    counts = {"steps": result.work.n_steps, "evaluations": result.work.n_evaluations}
    return Outcome(result.state.release_time, counts)


def _whole_release(film: SeparationScene, pulled_by: Drive, end: float, rtol: float) -> Outcome:
    """First release of film and drive solved as one system."""
    from ...models.injector.monolithic import simulate

    whole = simulate(plan(film), pulled_by, end, rtol=rtol)
    counts = {"steps": whole.n_steps, "evaluations": whole.n_evaluations}
    return Outcome(whole.cycles[0].release_time, counts)


def _swap(scene: SeparationScene, new: SeparationEffect) -> SeparationScene:
    effects = tuple(new if type(e) is type(new) else e for e in scene.effects)
    return evolve(scene, effects=effects)


def _other_menisci(scene: SeparationScene) -> dict[str, SeparationScene]:
    """Scenes with the models of the meniscus that are cheaper than the one of this scene."""
    profile = next((e.profile for e in scene.effects if isinstance(e, MeniscusForce)), None)
    found = {}
    if profile == "exact":
        found["meniscus as an arc"] = _swap(scene, MeniscusForce(profile="arc"))
    if profile in ("exact", "arc") and scene.interface.is_flat:
        printed = _swap(scene, MeniscusForce(profile="as-published"))
        if any(isinstance(e, Rupture) and e.gap is None for e in scene.effects):
            printed = _swap(printed, Rupture(criterion="zero-neck"))  # its own, never mixed
        found["published meniscus, Eq. (3.11)"] = printed
    return found


def injector_sweep(device: FuelInjector, progress: Progress) -> WorkPrecision:
    """Error of the first release of the injector, by solver, coupling, step and closure."""
    import tempfile

    scene = device.scene
    film = scene.separation(scene.temperature)
    end = scene.first_pulse_end
    exact, near = (_whole_release(film, scene.valve, end, rtol) for rtol in (1e-11, 1e-9))
    floor = max(abs(near.value / exact.value - 1.0), 1e-14)
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        pair = device.build(Path(folder))
        settings = _injector_settings(scene, film, pair)
        settings += coupling_settings(scene, film, pair[0], Path(folder))
        return sweep(
            settings,
            exact.value,
            quantity="release time",
            floor=floor,
            repeats=3,
            progress=progress,
        )


def _injector_settings(
    scene: InjectorScene, film: SeparationScene, pair: tuple[Path, Path]
) -> list[Setting]:
    """One system over tolerances, FMU pairs over steps, published closures as models."""
    wholes: list[tuple[str, SeparationScene, tuple[float, ...], bool]] = [
        ("one system, scipy", film, _TOLERANCES[::2], False)
    ]
    coupled = [
        ("FMU pair, pull a straight line", film, True, False),
        ("FMU pair, pull held", film, False, False),
    ]
    coupled += [
        (f"FMU pair, {name}", other, True, True) for name, other in _other_menisci(film).items()
    ]
    flooded = _swap(film, ViscousForce(closure="flooded"))
    wholes.append(("published constant radius (3.19)", flooded, _TOLERANCES[:5:2], True))
    settings = [
        Setting(
            method,
            f"rtol {rtol:.0e}",
            partial(_whole_release, one, scene.valve, scene.first_pulse_end, rtol),
            is_model,
        )
        for method, one, tolerances, is_model in wholes
        for rtol in tolerances
    ]
    settings += [
        Setting(
            method,
            f"step {step * 1e6:g} us",
            partial(_injector_pair, scene, one, pair, step, linear),
            is_model,
        )
        for method, one, linear, is_model in coupled
        for step in _STEPS
    ]
    return settings


def _injector_pair(
    scene: InjectorScene, film: SeparationScene, pair: tuple[Path, Path], step: float, linear: bool
) -> Outcome:
    from ...fmu.master.injector import cosimulate

    found = cosimulate(
        *pair, scene.first_pulse_end, step, mass_start=mass_values(film), linear=linear
    )
    return Outcome(
        float(found["t_release"][-1]) - scene.valve.profile.start_delay, {"steps": found.n_steps}
    )
