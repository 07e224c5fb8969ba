"""Work and precision of the fuel injector: solvers, couplings, steps and closures.

The error is that of the first release against a monolithic solution at a tight tolerance.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ....benchmarks.report import cost_report
from ....benchmarks.separation import TOLERANCES, monolithic_release, other_menisci, with_effect
from ....errors import ConvergenceError
from ....export.report import Report
from ....fmu.slaves.stiction_mass import mass_values
from ....scene.scenes import SeparationScene
from ....separation.effects.viscous import TensionLimit
from ....work_precision import Outcome, Point, Setting, WorkPrecision, sweep
from ...library import bundled_device
from ..scene import InjectorScene
from .cosimulation import InjectorFmus, build_fmus

if TYPE_CHECKING:
    from ....fmu.master.couple import AdaptiveSteps, FixedSteps, Mass
    from ....fmu.master.steps import Scheme

__all__ = [
    "coupling_settings",
    "injector_cost",
    "injector_settings",
    "injector_sweep",
    "release_study",
]

Progress = Callable[[float], None]

_NAMES: dict[Scheme, str] = {
    "jacobi": "film by force, Jacobi",
    "gauss-seidel": "film by force, Gauss-Seidel",
    "implicit-force": "film by force, implicit",
    "impulse": "film by impulse, fixed step",
}
_STEPS = (50e-6, 20e-6, 10e-6, 5e-6, 2e-6, 1e-6)  # [s]
_IMPULSE_TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5)  # a line of the table each


def injector_cost(
    scene: InjectorScene, out: Path | None, progress: Progress, error: float
) -> Report:
    """Measure the injector: a table, numbers, and pictures of it and of the coupling schemes."""
    found = cost_report(injector_sweep(scene, progress), out, error, scene.name)
    if out is None or found.draw is None:
        return found
    return found._replace(draw=partial(_draw, found.draw, out))


def _draw(cost_picture: Callable[[], Sequence[Path]], out: Path) -> tuple[Path, ...]:
    """The picture of the costs, then that of the coupling schemes, which are run for it."""
    from .coupling import coupling_picture

    return (*cost_picture(), coupling_picture(out))


def release_study() -> list[Point]:
    """Error of the first release of the shipped injector; CPU seconds, each setting run once."""
    scene = bundled_device("fuel-injector")
    assert isinstance(scene, InjectorScene)
    film, valve, end = scene.separation(scene.temperature), scene.valve, scene.first_pulse_end
    exact = monolithic_release(film, valve, end, 1e-11).value
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        found = sweep(
            injector_settings(scene, film, build_fmus(scene, Path(folder))),
            exact,
            quantity="release time",
            floor=1e-10,
            repeats=0,
        )
    return list(found.points)


def injector_sweep(scene: InjectorScene, progress: Progress) -> WorkPrecision:
    """Error of the first release of the injector, by solver, coupling, step and closure."""
    film = scene.separation(scene.temperature)
    end = scene.first_pulse_end
    exact, near = (monolithic_release(film, scene.valve, end, rtol) for rtol in (1e-11, 1e-9))
    floor = max(abs(near.value / exact.value - 1.0), 1e-14)
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        pair = build_fmus(scene, Path(folder))
        settings = injector_settings(scene, film, pair)
        settings += coupling_settings(scene, film, pair[0], Path(folder))
        return sweep(
            settings,
            exact.value,
            quantity="release time",
            floor=floor,
            repeats=3,
            progress=progress,
        )


def injector_settings(
    scene: InjectorScene, film: SeparationScene, pair: InjectorFmus
) -> list[Setting]:
    """Monolithic model over tolerances, FMU pairs over steps, published closures as models."""
    monolithic: list[tuple[str, SeparationScene, tuple[float, ...], bool]] = [
        ("monolithic, scipy", film, TOLERANCES[::2], False)
    ]
    coupled = [
        ("FMU pair, pull a straight line", film, True, False),
        ("FMU pair, pull held", film, False, False),
    ]
    coupled += [
        (f"FMU pair, {name}", other, True, True) for name, other in other_menisci(film).items()
    ]
    monolithic += [
        (name, other, TOLERANCES[:5:2], True) for name, other in _truncated(film).items()
    ]
    settings = [
        Setting(
            method,
            f"rtol {rtol:.0e}",
            partial(monolithic_release, one, scene.valve, scene.first_pulse_end, rtol),
            is_model,
        )
        for method, one, tolerances, is_model in monolithic
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


def _truncated(film: SeparationScene) -> dict[str, SeparationScene]:
    """Scenes whose film remembers nothing: its pressure is truncated at one tension."""
    limit = film.effect(TensionLimit)
    if limit is None or limit.cavity != "mass-conserving":
        return {}
    tensions = {"at the strength": limit.tension, "at that of the cavity": limit.cavity_drop}
    return {
        f"pressure truncated {name}": with_effect(
            film, TensionLimit(strength=tension, cavity="truncated")
        )
        for name, tension in tensions.items()
    }


def _injector_pair(
    scene: InjectorScene, film: SeparationScene, pair: InjectorFmus, step: float, linear: bool
) -> Outcome:
    from ....fmu.master.injector import Fmu, cosimulate

    found = cosimulate(
        pair.drive,
        Fmu(pair.mass, mass_values(film)),
        scene.first_pulse_end,
        step,
        linear=linear,
    )
    return Outcome(
        float(found["t_release"][-1]) - scene.valve.profile.start_delay, {"steps": found.n_steps}
    )


def coupling_settings(
    scene: InjectorScene, film: SeparationScene, drive: Path, folder: Path
) -> list[Setting]:
    """All coupling schemes of a film that is an FMU of its own, by step or by tolerance.

    Parameters
    ----------
    scene : InjectorScene
        The injector; its valve drives.
    film : SeparationScene
        Film and spool at one temperature.
    drive : Path
        The FMU ``valve-drive`` with the values of the scene.
    folder : Path
        Where the FMU ``stiction-force`` is written.
    """
    from ....fmu.master.couple import AdaptiveSteps, FixedSteps
    from ....fmu.python.build import build
    from ....fmu.slaves.stiction_force import PORTS

    known = {port.name for port in PORTS if port.causality == "parameter"}
    values = {name: value for name, value in mass_values(film).items() if name in known}
    target = folder / "stiction-force.fmu"
    part = build("stiction-force", target, start=values)
    return [
        *(
            Setting(
                name,
                f"step {step * 1e6:g} us",
                partial(
                    _coupled_release,
                    scene,
                    film,
                    part,
                    drive,
                    FixedSteps(step=step, scheme=scheme, refuse_unstable=False),
                ),
            )
            for scheme, name in _NAMES.items()
            for step in _STEPS
        ),
        *(
            Setting(
                "film by impulse, adaptive steps",
                f"tolerance {tolerance:.0e}",
                partial(
                    _coupled_release, scene, film, part, drive, AdaptiveSteps(tolerance=tolerance)
                ),
            )
            for tolerance in _IMPULSE_TOLERANCES
        ),
    ]


def _coupled_release(
    scene: InjectorScene,
    film: SeparationScene,
    part: Path,
    drive: Path,
    steps: AdaptiveSteps | FixedSteps,
) -> Outcome:
    """First release by one coupling scheme, those the master would refuse included."""
    from ....fmu.master.couple import FixedSteps, couple

    profile = scene.valve.profile
    found = couple(
        part,
        _spool(film),
        drive,
        scene.first_pulse_end,
        release_gap=film.loading.final_gap,
        steps=steps,
        jumps=(profile.start_delay, profile.start_delay + profile.boost_time),
    )
    if math.isnan(found.release_time):
        raise ConvergenceError("never released; give the pull more time or force")
    counts = {"steps": found.n_steps, "film calls": found.n_calls}
    if isinstance(steps, FixedSteps) and steps.scheme in ("jacobi", "gauss-seidel"):
        counts["warnings of the film"] = sum("m_ref/c" in line for line in found.log)
    return Outcome(found.release_time - profile.start_delay, counts)


def _spool(film: SeparationScene) -> Mass:
    from ....fmu.master.couple import Mass

    loading = film.imposed_force
    return Mass(mass=loading.moving_mass, stiffness=loading.stiffness, rest_gap=loading.rest_gap)
