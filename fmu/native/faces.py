"""The load-displacement curve of rough faces as the record that the C kernel reads."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from ...analyses.load_displacement.curve import HERTZ, LoadDisplacementCurve, normalized
from ...errors import PlanError
from ...numerics.monotone_cubic import Curve as Cubic
from ...numerics.monotone_cubic import monotone_curve, power_curve
from .records import Curve, Faces, PowerCurve, Unloading

__all__ = ["faces_of"]

# Of the dissipated work, between two unloading curves: a monotone cubic through 64 pieces follows
# it to the fourth power of a piece, 6e-8.
_PIECES = 64


def faces_of(curve: LoadDisplacementCurve) -> Faces:
    """Rough faces with force, areas and the work they dissipate.

    Every curve is its nodes, values and slopes, those of forces and of areas of contact in
    logarithms.

    Raises
    ------
    PlanError
        If there are more unloading curves than the kernel holds.
    """
    out, most = curve.unloading, Faces.most("unloading")
    if len(out) > most:
        raise PlanError(
            f"a native FMU holds {most} unloading curves of rough faces, "
            f"these have {len(out)}; make them with fewer, or leave out --native"
        )
    loaded = (0.0, *curve.approach)
    return Faces(
        limit=curve.elastic_limit,
        first=_power(power_curve(curve.approach, curve.force, HERTZ), curve.approach),
        area=_power(power_curve(curve.approach, curve.contact_area, 1.0), curve.approach),
        plastic=_plain(monotone_curve(loaded, (0.0, *curve.plastic_area)), loaded),
        residual=_residual(curve) if out else None,
        dissipated=_dissipated(curve) if out else None,
        unloading=tuple(
            Unloading(
                end=one.max_approach,
                force=_power(normalized(one).force, one.fractions),
                area=_power(normalized(one).area, one.fractions),
            )
            for one in out
        ),
    )


def _residual(curve: LoadDisplacementCurve) -> Curve:
    """Approach that is left after a maximum approach."""
    nodes = (curve.elastic_limit, *(one.max_approach for one in curve.unloading))
    left = (0.0, *(one.residual_approach for one in curve.unloading))
    return _plain(monotone_curve(nodes, left), nodes)


def _dissipated(curve: LoadDisplacementCurve) -> Curve:
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


def _plain(curve: Cubic, nodes: Sequence[float]) -> Curve:
    values, slopes = zip(*(curve(x) for x in nodes), strict=True)
    return Curve(x=tuple(nodes), y=values, slope=slopes)


def _power(curve: Cubic, nodes: Sequence[float]) -> PowerCurve:
    points = [(x, *curve(x)) for x in nodes]
    return PowerCurve(
        begin=points[0][0],
        end=points[-1][0],
        low=points[0][1],
        high=points[-1][1],
        log=Curve(
            x=tuple(math.log(x) for x, _, _ in points),
            y=tuple(math.log(value) for _, value, _ in points),
            slope=tuple(slope * x / value for x, value, slope in points),
        ),
    )
