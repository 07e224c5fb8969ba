"""The load-displacement curve of rough faces as the numbers that the C kernel reads."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from ...analyses.load_displacement.curve import HERTZ, LoadDisplacementCurve, normalized
from ...errors import PlanError
from ...numerics.monotone_cubic import Curve, monotone_curve, power_curve

__all__ = ["face_numbers", "stop_numbers"]

_MOST_UNLOADING_CURVES = 64  # CK_UNLOADING_CURVES of native/kernel/drive.h
# Of the dissipated work, between two unloading curves: a monotone cubic through 64 pieces follows
# it to the fourth power of a piece, 6e-8.
_PIECES = 64


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
            f"a native FMU holds {_MOST_UNLOADING_CURVES} unloading curves of rough faces, "
            f"these have {len(out)}; make them with fewer, or leave out --native"
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


def stop_numbers(curve: LoadDisplacementCurve) -> list[float]:
    """Numbers of faces with their areas and the work they dissipate, after those of the force.

    Raises
    ------
    PlanError
        See `face_numbers`.
    """
    numbers = face_numbers(curve)
    numbers += _in_logarithms(power_curve(curve.approach, curve.contact_area, 1.0), curve.approach)
    nodes = (0.0, *curve.approach)
    numbers += _plain(monotone_curve(nodes, (0.0, *curve.plastic_area)), nodes)
    if curve.unloading:
        numbers += _dissipated(curve)
    for one in curve.unloading:
        numbers += _in_logarithms(normalized(one).area, one.fractions)
    return numbers


def _dissipated(curve: LoadDisplacementCurve) -> list[float]:
    """Work dissipated up to a maximum approach: smooth between the unloading curves."""
    ends = [curve.elastic_limit, *(one.max_approach for one in curve.unloading), curve.max_approach]
    nodes = [ends[0]]
    for low, high in pairwise(sorted(set(ends))):
        nodes += [low + (high - low) * k / _PIECES for k in range(1, _PIECES)] + [high]
    works = [curve.dissipated_work(x) for x in nodes]
    return _plain(monotone_curve(nodes, _ascending(works)), nodes)


def _ascending(values: Sequence[float]) -> list[float]:
    """Values that nowhere fall: by interpolation the work may, by a thousandth of it."""
    found, most = list[float](), 0.0
    for value in values:
        most = max(most, value)
        found.append(most)
    return found


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
