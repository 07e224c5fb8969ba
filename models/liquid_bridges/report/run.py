"""Report of liquid bridges: errors of their closures against the exact bridge, in bands of gaps."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from ....errors import PlanError
from ....export.report import FmuStart, Report
from ..closure_errors import BandError, flat_errors, sphere_errors
from ..scene import BridgeCase, Bridges
from .cost import bridge_cost

__all__ = ["cost", "fmu_start", "plan_text", "run"]

Progress = Callable[[float], None]

_SOURCES = (
    "exact: Young-Laplace equation, Eq. (3.1) of Cai 2008; Orr, Scriven and Rivas 1975",
    "arc: Eqs. (3.38)-(3.41) of Cai and Bhushan 2008a",
    "as published: Eqs. (3.11), (3.12) of Cai and Bhushan 2007a",
)


def plan_text(scene: Bridges) -> str:
    """See `models.device.DeviceReport.plan_text`."""
    lines = [f"{scene.name}: exact, arc, and as published (Eqs. (3.11), (3.12), zero neck)"]
    lines += [f"  {case.label}" for case in scene.bridges]
    lines.append("reference: Legendre's integrals")
    return "\n".join([*lines, "sources:", *(f"  {source}" for source in _SOURCES)])


def cost(scene: Bridges, out: Path | None, progress: Progress, error: float) -> Report:
    """See `models.device.DeviceReport.cost`."""
    return bridge_cost(scene, out, error, progress)


def fmu_start(scene: Bridges) -> FmuStart:
    """See `models.device.DeviceReport.fmu_start`."""
    raise PlanError("bridges are compared, not moved: they have no FMU; a separation has one")


def _errors(case: BridgeCase) -> tuple[BandError, ...]:
    angles = (case.contact_angle_lower, case.contact_angle_upper)
    if case.filling is None:
        return flat_errors(*angles)
    return sphere_errors(*angles, case.filling)


def run(scene: Bridges, out: Path | None, progress: Progress) -> Report:
    """Errors of the closures by bands: a table, numbers, and a CSV file."""
    lines, rows = [], []
    for i, case in enumerate(scene.bridges):
        lines.append(f"{case.label}: largest error [%] in a band of the way to the exact limit")
        found = _errors(case)
        for name in found[0].errors:
            shown = (
                f"{band.low:g}-{band.high:g}: {100.0 * band.errors[name]:.2g}" for band in found
            )
            lines.append(f"  {name:18s} " + "   ".join(shown))
        rows += [
            (case.label, b.low, b.high, name, e) for b in found for name, e in b.errors.items()
        ]
        progress((i + 1) / len(scene.bridges))
    scalars: dict[str, tuple[float, str]] = {
        f"{label} / {name} / {low:g}-{high:g}": (error, "-")
        for label, low, high, name, error in rows
    }
    write = partial(_write, rows, out) if out is not None else None
    return Report(scalars, "\n".join(lines), write)


def _write(rows: Sequence[tuple[str, float, float, str, float]], out: Path) -> tuple[Path, ...]:
    from ....files.csv_rows import write_rows

    edges = ("from [of the limit]", "to [of the limit]")
    head = ("bridge", *edges, "closure", "largest error [-]")
    return (write_rows(out / "errors.csv", head, rows),)
