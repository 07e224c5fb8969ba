"""Writing native FMUs without a film: ``valve-drive``, ``contact-stop``."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from ...analyses.load_displacement.curve import LoadDisplacementCurve
from ..contents.end_stop import bake
from ..framework.description import Description
from ..framework.ports import Value, start_value
from .build import NativeContent, chosen_platforms, native_about, target, write_native
from .faces import faces_of
from .models import native_model

__all__ = ["build_native_drive", "build_native_stop"]


def build_native_drive(
    out: str | os.PathLike[str],
    *,
    start: Mapping[str, Any] | None = None,
    curve: LoadDisplacementCurve | None = None,
    platforms: Sequence[str] | None = None,
    compiler: str = "auto",
    fmi: Literal[2, 3] = 2,
) -> Path:
    """Write a ``valve-drive`` that runs without Python (co-simulation).

    It has the variables of the Python FMU of that name, under the same value references, and its
    numbers to round-off.

    Parameters
    ----------
    out : path
        The file to write, ``*.fmu``.
    start : mapping, optional
        Start values by variable; a text carries its unit (``"25 um"``). As in `build`, a ``curve``
        may be among them.
    curve : LoadDisplacementCurve, optional
        Rough faces in front of the spring ``k_stop``.
    platforms, compiler, fmi
        See `build.build_native`. In FMI 3.0 a step may end early where the voltage switches.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    DescriptionError
        If a name, a start value, the curve, a platform or a version is not possible.
    PlanError
        If the curve has more unloading curves than the kernel holds.
    ContactkitError
        If a compiler is missing.
    """
    place = target(out, fmi)
    given = dict(start or {})
    if curve is not None:
        given["curve"] = curve
    baked = bake("valve-drive", given).get("curve")
    faces = faces_of(LoadDisplacementCurve.from_data(baked)) if baked is not None else None
    about = _about("valve-drive", given)
    native_model("valve-drive").slave.check_start(about.start)
    content = NativeContent(faces=faces)
    names = chosen_platforms(platforms)
    return write_native("valve-drive", about, content, place, fmi, names, compiler)


def build_native_stop(
    out: str | os.PathLike[str],
    *,
    start: Mapping[str, Any] | None = None,
    curve: LoadDisplacementCurve | None = None,
    platforms: Sequence[str] | None = None,
    compiler: str = "auto",
    fmi: Literal[2, 3] = 2,
) -> Path:
    """Write a ``contact-stop`` that runs without Python (co-simulation).

    Parameters
    ----------
    out, start, platforms, compiler, fmi
        See `build_native_drive`.
    curve : LoadDisplacementCurve, optional
        The faces; those of the scene ``contact-stop`` of contactkit if not given.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ContactkitError
        As `build_native_drive`.
    """
    place = target(out, fmi)
    given = dict(start or {})
    if curve is not None:
        given["curve"] = curve
    faces = faces_of(LoadDisplacementCurve.from_data(bake("contact-stop", given)["curve"]))
    about, content = _about("contact-stop", given), NativeContent(faces=faces)
    names = chosen_platforms(platforms)
    return write_native("contact-stop", about, content, place, fmi, names, compiler)


def _about(name: str, given: Mapping[str, Any]) -> Description:
    """Description of the native counterpart of a slave, with start values."""
    ports, slave = native_model(name).ports, native_model(name).slave
    values: dict[str, Value] = slave.start_values()
    values |= {key: start_value(slave.ports, key, value) for key, value in given.items()}
    return native_about(name, ports, values)
