"""Report of a work-precision study: table, numbers, advice, picture and CSV file."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

from ..errors import InfeasibleError
from ..export.report import Report
from ..work_precision import WorkPrecision

__all__ = ["cost_report"]


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
    scalars: dict[str, tuple[Any, str]] = {}
    if not found.judge:
        scalars[found.quantity] = (found.reference, "s")
    for point in found.points:
        key = f"{point.method} / {point.label}"
        scalars |= {f"{key} / error": (point.error, "-"), f"{key} / seconds": (point.seconds, "s")}
        scalars |= {f"{key} / {count}": (value, "-") for count, value in point.counts.items()}
    text = f"{found.table()}\n{advice}"
    if out is None:
        return Report(scalars, text)
    return Report(scalars, text, partial(_write, found, out), partial(_draw, found, out, name))


def _write(found: WorkPrecision, out: Path) -> tuple[Path, ...]:
    from ..files.csv_rows import write_rows

    head = ("method", "setting", "error [-]", "seconds [s]")
    rows = [(p.method, p.label, p.error, p.seconds) for p in found.points]
    return (write_rows(out / "cost.csv", head, rows),)


def _draw(found: WorkPrecision, out: Path, name: str) -> tuple[Path, ...]:
    from ..plot import cost as cost_plot
    from ..plot import style as plot

    made, ax = plot.figure(size=(9.6, 5.4))
    cost_plot.work_precision(found, ax, "osD^vP*X<>hdp")
    plot.title(ax, f"{name}: what accuracy costs")
    return (plot.save(made, out / "cost"),)
