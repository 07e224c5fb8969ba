"""What each way of coupling the film of the injector to its spool costs, and where it fails."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import ConvergenceError
from ..scene import SeparationScene
from ..workprecision import Outcome, Setting, WorkPrecision
from .scenes import mass_values

if TYPE_CHECKING:
    from ..fmu.master import Mass, Scheme
    from .injector import InjectorScene

__all__ = ["coupling_picture", "coupling_settings"]

_NAMES: dict[Scheme, str] = {
    "jacobi": "film by force, Jacobi",
    "gauss-seidel": "film by force, Gauss-Seidel",
    "end-point": "film by force, implicit",
    "impulse": "film by impulse, fixed step",
}
# what the picture shows: its label, and how it is drawn
_DRAWN = {
    _NAMES["jacobi"]: ("force, explicit, Jacobi (refused)", "C3o-"),
    _NAMES["gauss-seidel"]: ("force, explicit, Gauss-Seidel (refused)", "C1s-"),
    _NAMES["end-point"]: ("force, implicit at the end point", "C8<-"),
    _NAMES["impulse"]: ("impulse, fixed steps", "C9>-"),
    "film by impulse, steps by error": ("impulse, steps by error", "C0D-"),
    "FMU pair, pull held": ("mass inside the FMU, pull held", "C7v-"),
    "FMU pair, pull a straight line": ("mass inside the FMU, pull a line", "C2^-"),
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
    from ..fmu.build import build
    from ..fmu.stiction_force import PORTS

    known = {port.name for port in PORTS if port.causality == "parameter"}
    values = {name: value for name, value in mass_values(film).items() if name in known}
    target = folder / "stiction-force.fmu"
    part = build("stiction-force", target, start=values)
    return [
        *(
            Setting(name, f"step {step * 1e6:g} us", partial(_run, scene, film, part, drive,
                                                             scheme=scheme, step=step))
            for scheme, name in _NAMES.items()
            for step in _STEPS
        ),
        *(
            Setting("film by impulse, steps by error", f"tolerance {tolerance:.0e}",
                    partial(_run, scene, film, part, drive, tolerance=tolerance))
            for tolerance in _TOLERANCES
        ),
    ]  # fmt: skip


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
    from ..fmu.master import couple

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
    from ..fmu.master import Mass

    opening = film.opening
    assert opening.mass is not None  # the injector gives one
    return Mass(mass=opening.mass, stiffness=opening.stiffness, rest_gap=opening.rest_gap)


def coupling_picture(found: WorkPrecision, out: Path, name: str) -> Path:
    """Draw error against steps and against seconds, for the ways of coupling alone.

    A hollow mark is a run the master refuses unless told not to: its error is no accident.
    """
    from .. import plot

    made, axes = plot.figure(1, 2, size=(11.0, 5.6), sharey=True)
    kept = [p for p in found.points if p.method in _DRAWN and p.error == p.error]
    for method, (label, style) in _DRAWN.items():
        points = [p for p in kept if p.method == method]
        face = "none" if method in (_NAMES["jacobi"], _NAMES["gauss-seidel"]) else None
        for ax, across in zip(
            axes,
            ([p.counts["steps"] for p in points], [p.seconds for p in points]),
            strict=True,
        ):
            ax.plot(across, [p.error for p in points], style, label=label, markerfacecolor=face)
    for ax, label in zip(axes, ("communication steps", "seconds"), strict=True):
        ax.set(xscale="log", yscale="log", xlabel=label)
        ax.axhline(1e-3, color="0.6", linewidth=0.8)
    axes[0].set_ylabel(f"relative error of the {found.quantity}")
    plot.title(axes[0], f"{name}: ways to couple the film")
    plot.legend(axes[0], fontsize=8, loc="upper left", bbox_to_anchor=(0.0, -0.14), ncols=2)
    return plot.save(made, out / "coupling")
