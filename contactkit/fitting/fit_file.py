"""Files of fits: values, intervals, data, residuals and the fitted scene in one npz file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import asdict

from ..accuracy import Accuracy
from ..files.curves import read_validity
from ..files.results import read_npz, save_npz
from ..files.scenes import read_scene, scene_kind, unstructure
from ..scene.scenes import Scene
from .fitted import FittedCurve, FittedParameter, FitWork
from .result import Fit

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Arrays = dict[str, NDArray[Any]]

__all__ = ["read_fit", "save_fit"]

_COLUMNS = ("x", "measured", "model", "noise", "fractions")
_TEXTS = ("name", "over", "quantity")


def save_fit(fit: Fit, path: str | Path) -> Path:
    """Write a fit to an npz file without pickle, whole or not at all; `read_fit` reads it.

    Parameters
    ----------
    fit : Fit
        Its curves become arrays; ``header`` is a JSON text with everything else, the fitted scene
        as the tables of its file. That of a device is left out.
    path : str or Path
        The file; its suffix becomes ``.npz``.
    """
    columns = {"correlation": fit.correlation}
    for i, curve in enumerate(fit.curves):
        columns |= {f"curve{i}_{name}": getattr(curve, name) for name in _COLUMNS}
    header = {
        "kind": "fit",
        "scene": unstructure(fit.scene) if isinstance(fit.scene, Scene) else None,
        "accuracy": fit.accuracy.saved(),
        "parameters": [asdict(one) for one in fit.parameters],
        "curves": [
            {name: getattr(curve, name) for name in _TEXTS}
            | {"units": list(curve.units), "is_estimated": curve.is_estimated}
            for curve in fit.curves
        ],
        "chi2": fit.chi2,
        "dof": fit.dof,
        "aicc": fit.aicc if np.isfinite(fit.aicc) else None,
        "undecided": list(fit.undecided),
        "validity": [asdict(number) for number in fit.validity],
        "sources": list(fit.sources),
        "work": fit.work._asdict(),
        "has_converged": fit.has_converged,
        "slopes": fit.slopes,
    }
    return save_npz(path, columns, header)


def read_fit(path: str | Path) -> Fit:
    """Read a fit that `Fit.save` has written.

    Parameters
    ----------
    path : str or Path
        The file.

    Returns
    -------
    Fit
        As it was saved, without the runs that a profile or a posterior would need.

    Raises
    ------
    DescriptionError
        If the file is no saved fit, is cut short, or exceeds a limit of `contactkit.reading`.
    """
    return read_npz(path, "fit", _unpacked)


def _unpacked(header: dict[str, Any], columns: Arrays, name: str) -> Fit:
    """The fit of a file; what is missing or of another type is refused by an error of Python."""
    if header.get("kind") != "fit":
        raise ValueError(f"it holds a {header.get('kind')!r:.40}")
    scene, tables = None, header["scene"]
    if tables is not None:
        scene = read_scene(tables, scene_kind(tables), name).scene
    parameters = tuple(_parameter(one) for one in header["parameters"])
    curves = tuple(
        _curve(one, {c: columns[f"curve{i}_{c}"] for c in _COLUMNS}, len(parameters))
        for i, one in enumerate(header["curves"])
    )
    correlation = columns["correlation"]
    if correlation.shape != (len(parameters),) * 2 or correlation.dtype.kind != "f":
        raise ValueError(f"correlations of shape {correlation.shape}")
    aicc = header["aicc"]
    return Fit(
        scene,
        Accuracy.of_file(header["accuracy"]),
        parameters,
        curves,
        correlation,
        float(header["chi2"]),
        int(header["dof"]),
        np.inf if aicc is None else float(aicc),
        tuple(map(_text, header["undecided"])),
        tuple(read_validity(one) for one in header["validity"]),
        tuple(map(_text, header["sources"])),
        FitWork(**{key: _number(value) for key, value in header["work"].items()}),
        bool(header["has_converged"]),
        _text(header.get("slopes", "")),
    )


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(f"a {type(value).__name__} is no text")
    return value


def _number(value: Any) -> Any:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError(f"a {type(value).__name__} is no number")
    return value


def _parameter(fields: dict[str, Any]) -> FittedParameter:
    low, high = map(_number, fields["bounds"])
    known: dict[str, Any] = {"bounds": (float(low), float(high))}
    for key in ("name", "unit", "verdict", "decided_by", "reason"):
        known[key] = _text(fields[key])
    for key in ("value", "low", "high"):
        known[key] = float(_number(fields[key]))
    for key in ("is_profile", "is_log"):
        known[key] = bool(fields[key])
    return FittedParameter(**known)


def _curve(fields: dict[str, Any], columns: Arrays, n_parameters: int) -> FittedCurve:
    n = columns["x"].size
    for name, column in columns.items():
        shape = (n, n_parameters) if name == "fractions" else (n,)
        if column.shape != shape or column.dtype.kind != "f":
            raise ValueError(f"{name} of shape {column.shape}")
    first, second = map(_text, fields["units"])
    known: dict[str, Any] = {"units": (first, second), **columns}
    known |= {key: _text(fields[key]) for key in _TEXTS}
    return FittedCurve(**known, is_estimated=bool(fields["is_estimated"]))
