"""What each way of coupling the film of the injector to its spool costs, and where it fails."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ...errors import ConvergenceError
from ...scene.scenes import SeparationScene
from ...work_precision import Outcome, Setting, WorkPrecision
from ..scenes import mass_values

if TYPE_CHECKING:
    from ...fmu.master.couple import Mass, Scheme
    from ..injector.run import InjectorScene

__all__ = ["coupling_picture", "coupling_settings"]

_NAMES: dict[Scheme, str] = {
    "jacobi": "film by force, Jacobi",
    "gauss-seidel": "film by force, Gauss-Seidel",
    "end-point": "film by force, implicit",
    "impulse": "film by impulse, fixed step",
}
_STEPS = (50e-6, 20e-6, 10e-6, 5e-6, 2e-6, 1e-6)  # [s]
_TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5)


def coupling_settings(
    scene: InjectorScene, film: SeparationScene, drive: Path, folder: Path
) -> list[Setting]:
    """Every way to couple a film that is an FMU of its own, by step or by tolerance.

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
    from ...fmu.python.build import build
    from ...fmu.slaves.stiction_force import PORTS

    known = {port.name for port in PORTS if port.causality == "parameter"}
    values = {name: value for name, value in mass_values(film).items() if name in known}
    target = folder / "stiction-force.fmu"
    part = build("stiction-force", target, start=values)
    return [
        *(
            Setting(
                name,
                f"step {step * 1e6:g} us",
                partial(_run, scene, film, part, drive, scheme=scheme, step=step),
            )
            for scheme, name in _NAMES.items()
            for step in _STEPS
        ),
        *(
            Setting(
                "film by impulse, steps by error",
                f"tolerance {tolerance:.0e}",
                partial(_run, scene, film, part, drive, tolerance=tolerance),
            )
            for tolerance in _TOLERANCES
        ),
    ]


def _run(
    scene: InjectorScene,
    film: SeparationScene,
    part: Path,
    drive: Path,
    *,
    scheme: Scheme = "impulse",
    step: float | None = None,
    tolerance: float = 1e-3,
) -> Outcome:
    """First release by one way of coupling; what the master would refuse is let through."""
    from ...fmu.master.couple import couple

    profile = scene.valve.profile
    found = couple(
        part,
        _spool(film),
        drive,
        scene.first_pulse_end,
        release_gap=film.opening.final_gap,
        tolerance=tolerance,
        scheme=scheme,
        step=step,
        jumps=(profile.start_delay, profile.start_delay + profile.boost_time),
        refuse=False,
    )
    if found.release_time < 0.0:
        raise ConvergenceError("never released")
    counts = {"steps": found.n_steps, "film calls": found.n_calls}
    if scheme in ("jacobi", "gauss-seidel"):
        counts["warnings of the film"] = sum("m_ref/c" in line for line in found.log)
    return Outcome(found.release_time - profile.start_delay, counts)


def _spool(film: SeparationScene) -> Mass:
    from ...fmu.master.couple import Mass

    opening = film.opening
    assert opening.mass is not None  # the injector gives one
    return Mass(mass=opening.mass, stiffness=opening.stiffness, rest_gap=opening.rest_gap)


def coupling_picture(found: WorkPrecision, out: Path, name: str) -> Path:
    """Draw all ways of coupling, on a harmless, a stiff and a very stiff film.

    The films are those of `coupling_ways`, as the one of the injector lies between the first two;
    what was found for it is in the table and in ``cost.png``.
    """
    import tempfile

    from ...fmu.python.build import build
    from .coupling_figure import coupling_figure
    from .coupling_schemes import CASES, runs

    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        film = build("stiction-force", Path(folder))
        mass = build("stiction-mass", Path(folder))
        return coupling_figure([(case, *runs(case, film, mass)) for case in CASES], out)
