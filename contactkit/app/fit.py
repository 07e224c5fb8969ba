"""Fitting a scene of any kind to a measured curve of a CSV file: report, files, figures."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from ..accuracy import Accuracy
from ..errors import DescriptionError
from ..export.report import Report
from ..fitting.data import NUISANCES
from ..fitting.fit import fit
from ..fitting.readers import read_measured_curve
from ..fitting.result import Fit
from ..scene.scenes import Scene
from ..studies.sensitivity import Range

__all__ = ["FitOptions", "fit_scene"]

_RANGE = re.compile(r"\s*(?P<path>[^=]+?)\s*=\s*(?P<low>.+?)\s*\.\.\s*(?P<high>.+?)\s*")


class FitOptions(NamedTuple):
    """Options of a fit from the command line.

    `over` and `quantity` are ``NAME`` or ``NAME=COLUMN`` of the file, `parameters` are texts such
    as ``PATH=lo..hi``, nuisances among them; `noise` is as of a `MeasuredCurve`; `workers` are
    processes.
    """

    data: Path
    over: str
    quantity: str
    parameters: tuple[str, ...]
    noise: str | None = None
    branch: Any = None
    workers: int = 1


def fit_scene(
    scene: Any,
    accuracy: Accuracy,
    out: Path | None,
    progress: Callable[[float], None],
    options: FitOptions,
) -> Report:
    """Fit a scene to a curve; write the fit, the fitted scene and figures to a folder.

    The accuracy of a file that states none is that of `fit`.
    """
    ranges = dict(map(_range, options.parameters))
    nuisances = {name: one for name, one in ranges.items() if name in NUISANCES}
    paths = {name: one for name, one in ranges.items() if name not in NUISANCES}
    (over, x), (quantity, y) = _column(options.over), _column(options.quantity)
    curve = read_measured_curve(
        options.data,
        over,
        quantity,
        columns={over: x or over.rpartition(".")[2], quantity: y or quantity},
        noise=options.noise,
        branch=options.branch,
    )
    settings = accuracy if accuracy.given or accuracy != Accuracy.standard else None
    found = fit(scene, curve, paths, settings, nuisance=nuisances, workers=options.workers)
    progress(1.0)
    numbers: Mapping[str, tuple[Any, str]] = {"status": (found.status, "-"), **found.scalars()}
    if out is None:
        return Report(numbers, str(found))
    return Report(numbers, str(found), partial(_write, found, out), partial(_draw, found, out))


def _range(text: str) -> tuple[str, Range]:
    """Path and range of a text such as ``loading.speed=1 um/s..10 um/s``."""
    match = _RANGE.fullmatch(text)
    if match is None:
        expected = "be a path and a range, such as loading.speed='1 um/s..10 um/s'"
        raise DescriptionError("--parameter", text, expected)
    return match["path"], Range(_value(match["low"]), _value(match["high"]))


def _value(text: str) -> Any:
    try:
        return float(text)
    except ValueError:
        return text


def _column(text: str) -> tuple[str, str]:
    """Name of the result, and of the column of the file if it is another one."""
    name, _, column = text.partition("=")
    return name.strip(), column.strip()


def _write(found: Fit, out: Path) -> Sequence[Path]:
    from ..files.scenes import save_scene

    files = [found.save(out / "fit")]
    if isinstance(found.scene, Scene):
        files.append(save_scene(found.scene, out / "fitted.toml"))  # type: ignore[arg-type]
    return files


def _draw(found: Fit, out: Path) -> list[Path]:
    from ..plot import style
    from ..plot.accessors.base import pictures

    return [
        style.save(draw().figure, out / f"fit-{name}")  # type: ignore[arg-type]
        for name, draw in pictures(found).items()
    ]
