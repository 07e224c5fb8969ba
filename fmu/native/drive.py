"""Writing a native ``valve-drive``: the C kernel, its variables, and rough end-stop faces."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from ...analyses.load_displacement.curve import HERTZ, LoadDisplacementCurve, normalized
from ...errors import PlanError
from ...numerics.monotone_cubic import Curve, monotone_curve, power_curve
from ..contents.end_stop import bake
from ..framework.description import Description
from ..framework.ports import Value, start_value
from ..slaves.valve_drive import ValveDrive, check_drive
from .build import chosen_platforms, target, write_native
from .description import CATEGORIES

__all__ = ["build_native_drive", "face_numbers"]

_NAME = "valve-drive"
_MOST_UNLOADING_CURVES = 64  # CK_UNLOADING_CURVES of native/drive.h


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
        See `native_build.build_native`. In FMI 3.0 a step may end early where the voltage switches.

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
    faces = bake(_NAME, given).get("curve")
    ports = ValveDrive.ports
    values: dict[str, Value] = ValveDrive.start_values()
    values |= {name: start_value(ports, name, value) for name, value in given.items()}
    check_drive(values)
    about = Description(
        identifier=_NAME.replace("-", "_"),
        guid="",
        tool="contactkit",
        ports=ports,
        start=values,
        summary=ValveDrive.summary,
        log_categories=CATEGORIES,
        experiment=ValveDrive.experiment,
    )
    tables = face_numbers(LoadDisplacementCurve.from_data(faces) if faces is not None else None)
    return write_native(_NAME, about, tables, place, fmi, chosen_platforms(platforms), compiler)


def face_numbers(curve: LoadDisplacementCurve | None) -> list[float]:
    """Numbers of rough faces, in the order in which ``native/data.c`` reads them.

    Every curve is its nodes, values and slopes, those of forces in logarithms.

    Raises
    ------
    PlanError
        If there are more unloading curves than the kernel holds.
    """
    if curve is None:
        return [0.0]
    out = curve.unloading
    if len(out) > _MOST_UNLOADING_CURVES:
        raise PlanError(
            f"a native valve-drive holds {_MOST_UNLOADING_CURVES} unloading curves of its "
            f"faces, this one has {len(out)}; make it with fewer, or leave out --native"
        )
    numbers = [1.0, curve.elastic_limit, float(len(out))]
    numbers += _in_logarithms(power_curve(curve.approach, curve.force, HERTZ), curve.approach)
    if out:
        nodes = (curve.elastic_limit, *(one.max_approach for one in out))
        left = (0.0, *(one.residual_approach for one in out))
        numbers += _plain(monotone_curve(nodes, left), nodes)
    for one in out:
        numbers += [one.max_approach, *_in_logarithms(normalized(one).force, one.fractions)]
    return numbers


def _plain(curve: Curve, nodes: Sequence[float]) -> list[float]:
    points = [curve(x) for x in nodes]
    return [
        float(len(nodes)),
        *nodes,
        *(value for value, _ in points),
        *(slope for _, slope in points),
    ]


def _in_logarithms(curve: Curve, nodes: Sequence[float]) -> list[float]:
    points = [curve(x) for x in nodes]
    return [
        float(len(nodes)),
        *map(math.log, nodes),
        *(math.log(value) for value, _ in points),
        *(slope * x / value for x, (value, slope) in zip(nodes, points, strict=True)),
    ]
