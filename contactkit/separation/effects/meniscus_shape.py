"""Shape of the meniscus along the gap: its neck, contact circles, pressure, volume, break gap."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from ...errors import ConvergenceError
from ...scene.column import Column
from .base import MovingAngle, VolumeLoss
from .prepared import with_fraction

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.scenes import SeparationScene
    from .base import RunCurves, SeparationForce
    from .prepared import PreparedScene

    Curve = NDArray[np.float64]

__all__ = ["SHAPE_COLUMNS", "MeniscusShape", "meniscus_shape", "shape_curves"]

_JUST_BELOW = 1.0 - 1e-12  # of the end of a bridge: a gap that is the end is still spanned

SHAPE_COLUMNS = (
    Column("neck_radius", "m", "neck radius of a meniscus"),
    Column("contact_radius_lower", "m", "contact radius on the lower body"),
    Column("contact_radius_upper", "m", "contact radius on the upper body"),
    Column("liquid_pressure", "Pa", "pressure of the liquid, over ambient"),
    Column("liquid_volume", "m3", "liquid in all menisci"),
    Column("break_gap", "m", "gap at which the film breaks"),
)


class MeniscusShape(NamedTuple):
    """Radii of one meniscus [m], its pressure [Pa] and its volume [m3] at some gaps."""

    neck: Curve
    lower: Curve
    upper: Curve
    pressure: Curve
    volume: Curve


def _end_of(run: RunCurves) -> float:
    """Gap [m] at which the film breaks; nan where the motion decides it and it did not break."""
    film = run.plan.film
    if not film.moving_ends and run.plan.volume_rate is None:
        return film.end
    broke = (run.whole[:-1] & ~run.whole[1:]).nonzero()[0]
    return float(run.gap[broke[-1]]) if broke.size else math.nan


class _Moved(NamedTuple):
    """Volume of one meniscus [m3] and contact angles [rad] at each gap of a motion."""

    volume: Curve
    angles: tuple[Curve, Curve]


def meniscus_shape(
    prepared: PreparedScene[SeparationScene],
    profile: str,
    gaps: Curve,
    *,
    is_disc: bool = False,
    moved: _Moved | None = None,
) -> MeniscusShape:
    """Shape of one meniscus at gaps [m] that it spans, by the profile of its force.

    With `is_disc` the printed law between flats is that of an upright disc. `moved` has volume and
    contact angles where they change along the gap. nan where the shape of a bridge is not found.
    """
    import numpy as np

    try:
        if moved is not None:
            return _as_it_moves(prepared, gaps, moved)
        pressure = prepared.liquid_pressure
        if pressure is not None:
            return _at_pressure(prepared, pressure, gaps)
        if prepared.scene.interface.is_flat:
            return _between_flats(prepared, profile, gaps, is_disc)
        return _on_sphere(prepared, profile, gaps)
    except ConvergenceError:
        return MeniscusShape(*(np.full(gaps.shape, np.nan) for _ in MeniscusShape._fields))


def shape_curves(
    force: type[SeparationForce], profile: str, run: RunCurves, *, is_disc: bool
) -> dict[str, Curve]:
    """Curves of `SHAPE_COLUMNS` along a run, of the meniscus of a force; nan where it broke."""
    import numpy as np

    plan = run.plan
    curves = {column.name: np.full(run.gap.shape, np.nan) for column in SHAPE_COLUMNS}

    def fill(here: NDArray[np.bool_], found: MeniscusShape, end: float) -> None:
        volume = plan.scene.meniscus.count * found.volume
        values = (found.neck, found.lower, found.upper, found.pressure, volume, end)
        for column, value in zip(SHAPE_COLUMNS, values, strict=True):
            curves[column.name][here] = value

    moved = _moved(run)
    if moved is not None:
        here, end = run.whole, _end_of(run)
        gaps = np.fmin(run.gap[here], end * _JUST_BELOW)
        fill(here, meniscus_shape(plan.prepared, profile, gaps, moved=moved), end)
    else:
        for fraction in np.unique(run.volume_fraction[run.whole]).tolist():
            here = run.whole & (run.volume_fraction == fraction)
            film = plan.film_with(fraction)
            gaps = np.minimum(run.gap[here], film.laws[force].end * _JUST_BELOW)
            prepared = with_fraction(plan.prepared, fraction)
            fill(here, meniscus_shape(prepared, profile, gaps, is_disc=is_disc), film.end)
    for curve in curves.values():
        curve.flags.writeable = False
    return curves


def _moved(run: RunCurves) -> _Moved | None:
    """Volume and angles where the film is whole; None where no effect of the scene moves them."""
    import numpy as np

    plan = run.plan
    moving = plan.scene.effect(MovingAngle)
    if moving is None and plan.scene.effect(VolumeLoss) is None:
        return None
    volume = plan.prepared.film.volume * run.volume_fraction[run.whole]
    if moving is None:
        lower, upper = (np.full(volume.shape, angle) for angle in plan.prepared.angles)
        return _Moved(volume, (lower, upper))
    angles = moving.prepare_angles(plan.prepared)
    places = zip(run.gap[run.whole].tolist(), run.speed[run.whole].tolist(), strict=True)
    found = [angles(gap, speed) for gap, speed in places]
    lower, upper = np.reshape(found, (-1, 2)).T
    return _Moved(volume, (lower, upper))


def _as_it_moves(
    prepared: PreparedScene[SeparationScene], gaps: Curve, moved: _Moved
) -> MeniscusShape:
    """Exact bridges; beyond the limit at rest, where a fast film may last, there is none."""
    from ...capillary.exact.bridge import bridge

    exact = bridge(gaps, moved.volume, *moved.angles, *prepared.curvatures, beyond="nan")
    radii = (exact.neck, exact.radius_lower, exact.radius_upper)
    return MeniscusShape(*radii, prepared.liquid.surface_tension * exact.pressure, moved.volume)


def _at_pressure(
    prepared: PreparedScene[SeparationScene], pressure: float, gaps: Curve
) -> MeniscusShape:
    from ...capillary.exact.at_pressure import bridge_at_pressure

    tension = prepared.liquid.surface_tension
    fixed = (*prepared.angles, *prepared.curvatures)
    found = bridge_at_pressure(gaps, pressure / tension, *fixed, beyond="nan")
    radii = (found.neck, found.radius_lower, found.radius_upper)
    return MeniscusShape(*radii, tension * found.pressure, found.volume)


def _between_flats(
    prepared: PreparedScene[SeparationScene], profile: str, gaps: Curve, is_disc: bool
) -> MeniscusShape:
    import numpy as np

    from .meniscus_flat import volume_of_one

    tension = prepared.liquid.surface_tension
    printed = -tension * prepared.wetting / gaps  # the curvature of the arc alone
    if is_disc:
        radius = np.array([prepared.film.radius(gap) for gap in gaps.tolist()])
        return MeniscusShape(radius, radius, radius, printed, np.pi * radius**2 * gaps)
    one = volume_of_one(prepared, profile)
    volume = np.array([one(gap) for gap in gaps.tolist()])
    if profile == "exact":
        from ...capillary.exact.bridge import bridge

        exact = bridge(gaps, volume, *prepared.angles, beyond="nan")
        radii = (exact.neck, exact.radius_lower, exact.radius_upper)
        return MeniscusShape(*radii, tension * exact.pressure, volume)
    from ...capillary.arc.bridge import arc_bridge

    arc = arc_bridge(gaps, volume, *prepared.angles, beyond="nan")
    pressure = printed if profile == "as-published" else tension * arc.pressure
    return MeniscusShape(arc.neck, arc.radius_lower, arc.radius_upper, pressure, volume)


def _on_sphere(
    prepared: PreparedScene[SeparationScene], profile: str, gaps: Curve
) -> MeniscusShape:
    import numpy as np

    tension, volume = prepared.liquid.surface_tension, prepared.film.volume
    fixed = (*prepared.angles, *prepared.curvatures)
    volumes = np.full(gaps.shape, volume)
    if profile == "exact":
        from ...capillary.exact.bridge import bridge

        exact = bridge(gaps, volume, *fixed, beyond="nan")
        radii = (exact.neck, exact.radius_lower, exact.radius_upper)
        return MeniscusShape(*radii, tension * exact.pressure, volumes)
    from ...capillary.arc import sphere as arc_sphere

    shape = "parabola" if profile == "as-published" else "sphere"
    arc = arc_sphere.solve(gaps, volume, *fixed, profile=shape)
    pressure = tension * arc.pressure
    if profile == "as-published":  # what Eq. (3.12) has beside the surface tension
        from ...as_published.printed.common import meniscus_sphere_3_12

        x, upper = arc.radius_upper, prepared.angles.upper
        line = 2.0 * np.pi * tension * x * np.sin(arc.slope_upper + upper)
        pressure = (line - meniscus_sphere_3_12(arc, tension, upper)) / (np.pi * x**2)
    return MeniscusShape(arc.neck, arc.radius_lower, arc.radius_upper, pressure, volumes)
