"""Opening a scene by file or by name, and what the command line does with each kind."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from attrs import field, frozen

from ..accuracy import Accuracy
from ..errors import DescriptionError, PlanError, nearest
from ..files.scenes import (
    read_scene,
    read_tables,
    scene_kind,
    structure,
    telling_lines,
)
from ..models.injector.scene import InjectorScene
from ..models.library import bundled_scene
from ..models.liquid_bridges.scene import Bridges
from ..models.micromirror.scene import MicromirrorScene
from ..scene.scenes import ContactScene, SeparationScene, SlidingScene
from .report import Report
from .run.study import StudyOptions, study_lines

__all__ = [
    "FmuStart",
    "OpenedBridges",
    "OpenedContact",
    "OpenedInjector",
    "OpenedMicromirror",
    "OpenedScene",
    "OpenedSeparation",
    "OpenedSliding",
    "open_scene",
]

Progress = Callable[[float], None]


class FmuStart(NamedTuple):
    """Name of the FMU that holds a scene, and the start values to bake in.

    `film` is the scene of the film of a device, which a native FMU takes as it is.
    """

    name: str
    values: Mapping[str, Any]
    film: SeparationScene | None = None


class OpenedScene(Protocol):
    """A scene with what the command line does with it."""

    @property
    def name(self) -> str:
        """Title of the scene."""

    def plan_text(self) -> str:
        """Say what will be simulated, what will not, and by which sources."""

    def run(self, out: Path | None, progress: Progress) -> Report:
        """Simulate, and write curves and figures to a folder."""

    def study(self, out: Path | None, progress: Progress, options: StudyOptions) -> Report:
        """Run the study of the file, and write its columns and figure to a folder."""

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """Show what accuracy costs in time."""

    def fmu_start(self) -> FmuStart:
        """Name of the FMU that holds this scene, and the start values to bake in."""


def open_scene(name: str) -> OpenedScene:
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
    with telling_lines(path):
        return _opened(tables, path)


def _opened(tables: dict[str, Any], path: Path) -> OpenedScene:
    """Open the tables of a file."""
    device = tables.pop("device", None)
    if device is not None:
        return _open_device(device, tables, path.name)
    kind = scene_kind(tables)
    if kind is ContactScene:
        return OpenedContact(*read_scene(tables, ContactScene, path.name))
    if kind is SlidingScene:
        return OpenedSliding(*read_scene(tables, SlidingScene, path.name))
    return OpenedSeparation(*read_scene(tables, SeparationScene, path.name))


def _open_device(device: object, tables: Mapping[str, Any], origin: str) -> OpenedScene:
    """Open the tables of a file with a ``device`` key."""
    if device == "fuel-injector":
        return OpenedInjector(structure(tables, InjectorScene, origin))
    if device == "micromirror":
        return OpenedMicromirror(structure(tables, MicromirrorScene, origin))
    if device == "bridges":
        return OpenedBridges(structure(tables, Bridges, origin))
    hint = nearest(device, ["bridges", "fuel-injector", "micromirror"])
    raise DescriptionError(f"{origin}, device", device, "be a known device", hint=hint)


def _studied_by_run(name: str) -> PlanError:
    """Refusal of a study of a device."""
    return PlanError(
        f"{name} is a device: contactkit run includes what its file varies; contactkit study takes "
        "a contact, a separation or a sliding"
    )


def _with_sources(made: Any) -> str:
    """Text of a plan, and its sources."""
    return f"{made}\nsources:\n" + "\n".join(f"  {line}" for line in made.cite().splitlines())


@frozen
class OpenedSeparation:
    """A separation scene on the command line, with accuracy and study as in `OpenedContact`."""

    scene: SeparationScene
    accuracy: Accuracy = field(factory=Accuracy)
    vary: Mapping[str, list[Any]] = field(factory=dict)

    @property
    def name(self) -> str:
        """See `OpenedScene.name`."""
        return self.scene.name or "separation"

    def plan_text(self) -> str:
        """See `OpenedScene.plan_text`."""
        from ..separation.plan import plan

        text = _with_sources(plan(self.scene, self.accuracy))
        return "\n".join([text, *study_lines(self.scene, self.accuracy, self.vary)])

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `OpenedScene.run`."""
        from .run.separation import run_separation

        return run_separation(self.scene, self.accuracy, self.vary, out, progress)

    def study(self, out: Path | None, progress: Progress, options: StudyOptions) -> Report:
        """See `OpenedScene.study`."""
        from .run.study import run_study

        return run_study(self.scene, self.accuracy, self.vary, out, progress, options)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `OpenedScene.cost`."""
        from .cost.report import cost_report
        from .cost.separation import separation_sweep

        return cost_report(separation_sweep(self.scene, progress), out, error, self.name)

    def fmu_start(self) -> FmuStart:
        """See `OpenedScene.fmu_start`."""
        from ..fmu.slaves.stiction_mass import mass_values

        return FmuStart("stiction-mass", mass_values(self.scene))


@frozen
class OpenedContact:
    """A contact scene on the command line, with the tables ``accuracy`` and ``study`` of its file.

    `vary` holds the values of the study by the path of what is varied.
    """

    scene: ContactScene
    accuracy: Accuracy = field(factory=Accuracy)
    vary: Mapping[str, list[Any]] = field(factory=dict)

    @property
    def name(self) -> str:
        """See `OpenedScene.name`."""
        return self.scene.name or "contact"

    def plan_text(self) -> str:
        """See `OpenedScene.plan_text`."""
        from ..planning import plan

        text = _with_sources(plan(self.scene, self.accuracy))
        return "\n".join([text, *study_lines(self.scene, self.accuracy, self.vary)])

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `OpenedScene.run`."""
        from .run.contact import run_contact

        return run_contact(self.scene, self.accuracy, self.vary, out, progress)

    def study(self, out: Path | None, progress: Progress, options: StudyOptions) -> Report:
        """See `OpenedScene.study`."""
        from .run.study import run_study

        return run_study(self.scene, self.accuracy, self.vary, out, progress, options)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `OpenedScene.cost`."""
        from .cost.contact import contact_cost

        return contact_cost(self.scene, self.accuracy, out, progress, error)

    def fmu_start(self) -> FmuStart:
        """See `OpenedScene.fmu_start`."""
        from ..analyses.load_displacement.solve import load_displacement

        try:
            curve = load_displacement(self.scene, accuracy=self.accuracy)
            return FmuStart("contact-stop", {"curve": curve})
        except PlanError as error:
            raise PlanError(
                "of a contact scene the FMU contact-stop is built, whose tables are its "
                f"load-displacement curve, force and areas over the approach; {error}"
            ) from error


@frozen
class OpenedSliding:
    """A sliding scene on the command line, with accuracy and study as in `OpenedContact`."""

    scene: SlidingScene
    accuracy: Accuracy = field(factory=Accuracy)
    vary: Mapping[str, list[Any]] = field(factory=dict)

    @property
    def name(self) -> str:
        """See `OpenedScene.name`."""
        return self.scene.name or "sliding"

    def plan_text(self) -> str:
        """See `OpenedScene.plan_text`."""
        from ..separation.sliding.plan import plan_sliding

        text = _with_sources(plan_sliding(self.scene, self.accuracy))
        return "\n".join([text, *study_lines(self.scene, self.accuracy, self.vary)])

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `OpenedScene.run`."""
        from .run.sliding import run_sliding

        return run_sliding(self.scene, self.accuracy, self.vary, out, progress)

    def study(self, out: Path | None, progress: Progress, options: StudyOptions) -> Report:
        """See `OpenedScene.study`."""
        from .run.study import run_study

        return run_study(self.scene, self.accuracy, self.vary, out, progress, options)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `OpenedScene.cost`."""
        raise PlanError("cost has nothing to weigh: a sliding is closed form or one quadrature")

    def fmu_start(self) -> FmuStart:
        """See `OpenedScene.fmu_start`."""
        raise PlanError("no FMU holds a sliding scene; an FMU needs a scene with an opening")


@frozen
class OpenedBridges:
    """A comparison of closures of liquid bridges on the command line."""

    scene: Bridges

    @property
    def name(self) -> str:
        """See `OpenedScene.name`."""
        return self.scene.name

    def plan_text(self) -> str:
        """See `OpenedScene.plan_text`."""
        lines = [f"{self.name}: exact, arc, and as published (Eqs. (3.11), (3.12), zero neck)"]
        lines += [f"  {case.label}" for case in self.scene.bridges]
        lines.append("reference: Legendre's integrals; Orr, Scriven and Rivas 1975")
        return "\n".join(lines)

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `OpenedScene.run`."""
        from .run.bridges import run_bridges

        return run_bridges(self.scene, out, progress)

    def study(self, out: Path | None, progress: Progress, options: StudyOptions) -> Report:
        """See `OpenedScene.study`."""
        raise _studied_by_run(self.name)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `OpenedScene.cost`."""
        from .cost.bridges import bridge_cost

        return bridge_cost(self.scene, out, error, progress)

    def fmu_start(self) -> FmuStart:
        """See `OpenedScene.fmu_start`."""
        raise PlanError("bridges are compared, not moved: they have no FMU; a separation has one")


@frozen
class OpenedInjector:
    """The fuel injector on the command line."""

    scene: InjectorScene

    @property
    def name(self) -> str:
        """See `OpenedScene.name`."""
        return self.scene.name

    def plan_text(self) -> str:
        """See `OpenedScene.plan_text`."""
        from .run.injector.report import plan_text

        return plan_text(self.scene)

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `OpenedScene.run`."""
        from .run.injector.report import run_injector

        return run_injector(self.scene, out, progress)

    def study(self, out: Path | None, progress: Progress, options: StudyOptions) -> Report:
        """See `OpenedScene.study`."""
        raise _studied_by_run(self.name)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `OpenedScene.cost`."""
        from .cost.injector import injector_cost

        return injector_cost(self.scene, out, progress, error)

    def fmu_start(self) -> FmuStart:
        """See `OpenedScene.fmu_start`."""
        from ..fmu.slaves.stiction_mass import mass_values

        film = self.scene.separation(self.scene.temperature)
        return FmuStart("stiction-mass", mass_values(film), film)


@frozen
class OpenedMicromirror:
    """The digital micromirror on the command line."""

    scene: MicromirrorScene

    @property
    def name(self) -> str:
        """See `OpenedScene.name`."""
        return self.scene.name

    def plan_text(self) -> str:
        """See `OpenedScene.plan_text`."""
        from .run.micromirror.report import plan_text

        return plan_text(self.scene)

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `OpenedScene.run`."""
        from .run.micromirror.report import run_micromirror

        return run_micromirror(self.scene, out, progress)

    def study(self, out: Path | None, progress: Progress, options: StudyOptions) -> Report:
        """See `OpenedScene.study`."""
        raise _studied_by_run(self.name)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `OpenedScene.cost`."""
        from .cost.micromirror import mirror_sweep
        from .cost.report import cost_report

        return cost_report(mirror_sweep(self.scene, progress), out, error, self.name)

    def fmu_start(self) -> FmuStart:
        """See `OpenedScene.fmu_start`."""
        from .run.micromirror.cosimulation import tip_start

        return FmuStart("tip-contact", tip_start(self.scene, self.scene.study.humidity))
