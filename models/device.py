"""Base class of devices, and of the reports that run them, which are imported when called for."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any, ClassVar, Protocol, cast

from ..export.report import FmuStart, Report
from ..scene.scenes import InWords

__all__ = ["Device", "DeviceReport", "Progress"]

Progress = Callable[[float], None]


class DeviceReport(Protocol):
    """Functions of the module that reports about a device, each of the scene of the device."""

    def plan_text(self, scene: Any) -> str:
        """Say what will be simulated, what will not, and by which sources."""

    def run(self, scene: Any, out: Path | None, progress: Progress) -> Report:
        """Simulate, and write curves and figures to a folder."""

    def cost(self, scene: Any, out: Path | None, progress: Progress, error: float) -> Report:
        """Show what accuracy costs in time."""

    def fmu_start(self, scene: Any) -> FmuStart:
        """Name of the FMU that holds the device, and its start values; or refuse."""


class Device(InWords):
    """Base class of the scenes of devices, which have equations of motion of their own.

    A device of one's own is a frozen attrs class with a field `name`. `reported_by` names the
    module of its `DeviceReport`; `models.library.register_device` gives it a name in files.
    """

    __slots__ = ()

    reported_by: ClassVar[str]
    name: str

    @property
    def report(self) -> DeviceReport:
        """Functions that report about the device."""
        return cast("DeviceReport", import_module(self.reported_by))
