"""Opening a scene by file or by name, and what the command line does with it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from attrs import field, frozen

from ..accuracy import Accuracy
from ..errors import DescriptionError, PlanError
from ..export.report import FmuStart, Report
from ..files.scenes import read_scene, read_tables, scene_kind, structure, telling_lines
from ..models.device import Device
from ..models.library import bundled_scene, device_kind
from ..planning import plan
from ..scene.scenes import Scene
from .study import StudyOptions, study_lines

if TYPE_CHECKING:
    from .fit import FitOptions

__all__ = ["Opened", "OpenedDevice", "OpenedScene", "described", "open_scene", "open_tables"]

Progress = Callable[[float], None]


class Opened(Protocol):
    """A scene or a device with what the command line does with it."""

    @property
    def name(self) -> str:
        """Title of the scene."""

    def plan_text(self) -> str:
        """Say what will be simulated, what will not, and by which sources."""

    def run(self, out: Path | None, progress: Progress) -> Report:
        """Simulate, and write curves and figures to a folder."""

    def study(self, out: Path | None, progress: Progress, options: StudyOptions) -> Report:
        """Run the study of the file, and write its columns and figure to a folder."""

    def fit(self, out: Path | None, progress: Progress, options: FitOptions) -> Report:
        """Fit parameters to a measured curve, and write the fit and its figures to a folder."""

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """Show what accuracy costs in time."""

    def fmu_start(self) -> FmuStart:
        """Name of the FMU that holds this scene, and the start values to bake in."""


def open_scene(name: str) -> OpenedScene | OpenedDevice:
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
        return open_tables(tables, path.name)


def open_tables(tables: dict[str, Any], origin: str) -> OpenedScene | OpenedDevice:
    """Open the tables of a file: of a device if it has a ``device`` key."""
    if "device" not in tables:
        return OpenedScene(*read_scene(tables, scene_kind(tables), origin))
    name = tables.pop("device")
    try:
        kind = device_kind(name)
    except DescriptionError as error:
        where = f"{origin}, {error.field}"
        raise DescriptionError(where, name, error.expected, hint=error.hint) from None
    return OpenedDevice(structure(tables, kind, origin))


@frozen
class OpenedScene:
    """A scene of any kind, with the tables ``accuracy`` and ``study`` of its file.

    `parameters` holds the values of the study by the path of what is varied.
    """

    scene: Scene
    accuracy: Accuracy = field(factory=Accuracy)
    parameters: Mapping[str, list[Any]] = field(factory=dict)

    @property
    def name(self) -> str:
        """See `Opened.name`."""
        return self.scene.name or type(self.scene).__name__.removesuffix("Scene").lower()

    def plan_text(self) -> str:
        """See `Opened.plan_text`."""
        made = plan(self.scene, self.accuracy)  # type: ignore[call-overload]
        sources = (f"  {line}" for line in made.cite().splitlines())
        varied = study_lines(self.scene, self.accuracy, self.parameters)
        return "\n".join([str(made), "sources:", *sources, *varied])

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `Opened.run`."""
        from .run import run_scene

        return run_scene(self.scene, self.accuracy, self.parameters, out, progress)

    def study(self, out: Path | None, progress: Progress, options: StudyOptions) -> Report:
        """See `Opened.study`."""
        from .study import run_study

        return run_study(self.scene, self.accuracy, self.parameters, out, progress, options)

    def fit(self, out: Path | None, progress: Progress, options: FitOptions) -> Report:
        """See `Opened.fit`."""
        from .fit import fit_scene

        return fit_scene(self.scene, self.accuracy, out, progress, options)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `Opened.cost`."""
        from ..benchmarks.scene_cost import scene_cost

        return scene_cost(self.scene, self.accuracy, out, progress, error)

    def fmu_start(self) -> FmuStart:
        """See `Opened.fmu_start`."""
        from .scene_fmu import fmu_start

        return fmu_start(self.scene, self.accuracy)


@frozen
class OpenedDevice:
    """A device, whose report comes with its model."""

    scene: Device

    @property
    def name(self) -> str:
        """See `Opened.name`."""
        return self.scene.name

    def plan_text(self) -> str:
        """See `Opened.plan_text`."""
        return self.scene.report.plan_text(self.scene)

    def run(self, out: Path | None, progress: Progress) -> Report:
        """See `Opened.run`."""
        return self.scene.report.run(self.scene, out, progress)

    def study(self, out: Path | None, progress: Progress, options: StudyOptions) -> Report:
        """See `Opened.study`."""
        raise PlanError(
            f"{self.name} is a device: contactkit run includes what its file varies; contactkit "
            "study takes a contact, a separation or a sliding"
        )

    def fit(self, out: Path | None, progress: Progress, options: FitOptions) -> Report:
        """See `Opened.fit`."""
        from .fit import fit_scene

        return fit_scene(self.scene, Accuracy(), out, progress, options)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """See `Opened.cost`."""
        return self.scene.report.cost(self.scene, out, progress, error)

    def fmu_start(self) -> FmuStart:
        """See `Opened.fmu_start`."""
        return self.scene.report.fmu_start(self.scene)


def described(opened: object, report: Report) -> dict[str, Any]:
    """Plan, scene and validity of a report of a device; a result of a scene has them itself."""
    if not isinstance(opened, OpenedDevice):
        return {}
    from .report_page import validity_rows

    rows = [(case, *row) for case, one in report.validity for row in validity_rows([one])]
    return {
        "plan": opened.plan_text(),
        "scene": str(opened.scene),
        "validity": tuple(sorted(rows, key=lambda row: "OUT OF RANGE" not in row[2])),
    }
