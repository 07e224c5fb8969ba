"""Meniscus force on a sphere: bridges solved along the gap, and a curve through them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from ...errors import ConvergenceError, InfeasibleError
from ...numerics.cubic_spline import cubic_spline
from ...numerics.roots import bracketed_root
from ...scene.loading import ImposedForce
from .base import ForceLaw

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

    from ...scene.scenes import SeparationScene
    from .film_shape import FilmShape
    from .prepared import PreparedScene

__all__ = [
    "Bridges",
    "bridge_curve",
    "contact_radius",
    "exact_end",
    "printed_neck",
    "sphere_law",
    "thin_gap",
]

_DEGREES = 24, 48, 96  # of the polynomials
_CLOSE = 1e-3  # of a curve, a stretch at its end that is not divided further
_MAX_NODES = 4097  # of one of its stretches


class Bridges(NamedTuple):
    """Bridges at gaps [m], up to an end.

    A curve goes through `solved`: their force over surface tension [m], or the radius of their
    contact circle [m], from which `force` then gives the former at a gap in closed form. `thin` is
    a gap below which they hardly depend on it, and at `poles` the force is infinite.
    """

    solved: Callable[[Floats], Floats]
    end: float
    thin: float
    force: Callable[[float, float], float] = lambda gap, found: found
    poles: tuple[float, ...] = ()


def sphere_law(prepared: PreparedScene[SeparationScene], profile: str) -> ForceLaw:
    """Force of the meniscus on a sphere, as a law of the gap.

    Some dozens of bridges are solved, until the curve through them is known to a tenth of the
    tolerance of time, and a spline is what the loop calls: microseconds in place of milliseconds.
    """
    scene, tension = prepared.scene, prepared.liquid.surface_tension
    n = scene.meniscus.count
    bridges = _BRIDGES[profile](prepared)
    known_to = bridges.end if math.isfinite(bridges.end) else 2.0 * scene.loading.final_gap
    top = min(known_to, bridges.end * (1.0 - 1e-9))
    curve = bridge_curve(bridges, top, 0.1 * prepared.accuracy.time_rtol)

    def law(gap: float, speed: float) -> float:
        gap = min(max(gap, 0.0), top)
        return n * tension * bridges.force(gap, curve(gap))

    return ForceLaw(law, end=bridges.end, known_to=known_to, poles=bridges.poles, rate="none")


def _fixed(prepared: PreparedScene[SeparationScene]) -> tuple[float, float, float, float]:
    """Angles [rad] and curvatures [1/m] of the bodies."""
    return (*prepared.angles, *prepared.curvatures)


def exact_end(prepared: PreparedScene[SeparationScene]) -> float:
    """Gap [m] at which the exact bridge ends: on a sphere, and a free one between flats."""
    pressure, fixed = prepared.liquid_pressure, _fixed(prepared)
    if pressure is not None:
        from ...capillary.exact.at_pressure import max_gap_at_pressure

        return max_gap_at_pressure(pressure / prepared.liquid.surface_tension, *fixed)
    from ...capillary.exact.stability import stability_limit

    return float(stability_limit(prepared.film.volume, *fixed).gap)


def contact_radius(prepared: PreparedScene[SeparationScene], profile: str, gap: float) -> float:
    """Radius [m] of the contact circle on the flat body at a gap [m]; nan without a meniscus."""
    pressure, film, fixed = prepared.liquid_pressure, prepared.film, _fixed(prepared)
    found: Any
    if profile != "exact":
        from ...capillary.arc import sphere as arc_sphere

        shape = "parabola" if profile == "as-published" else "sphere"
        found = arc_sphere.solve(gap, film.volume, *fixed, profile=shape)
    elif pressure is None:
        from ...capillary.exact.bridge import bridge

        found = bridge(gap, film.volume, *fixed, beyond="nan")
    else:
        from ...capillary.exact.at_pressure import bridge_at_pressure

        over = pressure / prepared.liquid.surface_tension
        found = bridge_at_pressure(gap, over, *fixed, beyond="nan")
    is_lower = prepared.curvatures.lower == 0.0
    return float(found.radius_lower if is_lower else found.radius_upper)


def _exact(prepared: PreparedScene[SeparationScene]) -> Bridges:
    pressure = prepared.liquid_pressure
    film, fixed, end = prepared.film, _fixed(prepared), exact_end(prepared)
    if pressure is None:
        from ...capillary.exact.bridge import bridge

        return Bridges(
            lambda gap: bridge(gap, film.volume, *fixed, beyond="nan").force, end, thin_gap(film)
        )
    from ...capillary.exact.at_pressure import bridge_at_pressure

    over = pressure / prepared.liquid.surface_tension
    return Bridges(
        lambda gap: bridge_at_pressure(gap, over, *fixed, beyond="nan").force, end, 0.1 * end
    )


def _arcs(prepared: PreparedScene[SeparationScene]) -> Bridges:
    from ...capillary.arc import sphere as arc_sphere

    volume, fixed = prepared.film.volume, _fixed(prepared)
    end = float(arc_sphere.zero_neck_gap(volume, *fixed))
    return Bridges(
        lambda gap: arc_sphere.solve(gap, volume, *fixed).force, end, thin_gap(prepared.film)
    )


def _printed(prepared: PreparedScene[SeparationScene]) -> Bridges:
    """Eq. (3.12): closed in the contact circle of the arc, so that only this is tabulated.

    The force itself has a pole where the printed radius of the neck is zero, and no curve follows
    that.
    """
    from ...as_published.printed.common import meniscus_of_circle_3_12
    from ...capillary.arc import sphere as arc_sphere

    volume, fixed = prepared.film.volume, _fixed(prepared)
    lower, upper, _, bend = fixed
    end = float(arc_sphere.zero_neck_gap(volume, *fixed, profile="parabola"))
    poles = _poles(prepared, end)

    def circle(gap: Floats) -> Floats:
        return arc_sphere.solve(gap, volume, *fixed, profile="parabola").radius_upper

    def force(gap: float, x: float) -> float:
        slope = math.atan(bend * x)
        inverse = (math.cos(lower) + math.cos(upper + slope)) / (gap + 0.5 * bend * x * x)
        return float(meniscus_of_circle_3_12(x, slope, inverse, upper))

    return Bridges(circle, end, thin_gap(prepared.film), force, poles)


def printed_neck(prepared: PreparedScene[SeparationScene], gaps: Sequence[float]) -> Floats:
    """Radius of the neck in Eq. (3.12) at gaps [m], times the curvature of the arc [-].

    The printed force is infinite where it is zero. Positive for an arc that bulges; nan without
    an arc.
    """
    import numpy as np

    from ...as_published.printed.common import neck_by_curvature_3_12
    from ...capillary.arc import sphere as arc_sphere

    volume, fixed = prepared.film.volume, _fixed(prepared)
    arc = arc_sphere.solve(np.array(gaps), volume, *fixed, profile="parabola")
    inverse = arc.inverse_arc_radius
    neck = neck_by_curvature_3_12(arc.radius_upper, arc.slope_upper, inverse, fixed[1])
    found: Floats = np.where(inverse < 0.0, np.abs(neck), neck)
    return found


def _poles(prepared: PreparedScene[SeparationScene], end: float) -> tuple[float, ...]:
    """Gaps [m] at which the printed force is infinite.

    Raises
    ------
    InfeasibleError
        If a pull, or a vibration, would move the sphere through one.
    """
    import numpy as np

    loading = prepared.scene.loading
    last = end if math.isfinite(end) else loading.final_gap
    gaps = np.append(0.0, np.geomspace(1e-4, 1.0 - 1e-9, 400) * last)
    sign = np.sign(printed_neck(prepared, gaps.tolist()))
    found = [
        bracketed_root(
            lambda gap: float(printed_neck(prepared, [gap])[0]), float(gaps[i]), float(gaps[i + 1])
        )
        for i in np.flatnonzero(sign[1:] * sign[:-1] < 0.0).tolist()
    ]
    moves = isinstance(loading, ImposedForce) or getattr(loading, "vibration", None) is not None
    for pole in found:
        if moves and loading.smallest_gap <= pole <= loading.final_gap:
            raise InfeasibleError(
                f"Eq. (3.12) as printed is infinite at a gap of {pole:.3g} m, between initial_gap "
                f"= {loading.initial_gap:g} m and final_gap = {loading.final_gap:g} m: there the "
                f"circle of the arc reaches the axis, x_c = r1, and no force moves the sphere "
                f"through; take MeniscusForce() or MeniscusForce(profile='arc'), or impose a speed"
            )
    return tuple(found)


def thin_gap(film: FilmShape) -> float:
    """A tenth of the height of the film [m]: below, little depends on the gap; 0 between flats."""
    return 0.1 * math.sqrt(film.volume / (math.pi * film.sphere_radius))


_BRIDGES: Mapping[str, Callable[[PreparedScene[SeparationScene]], Bridges]] = {
    "exact": _exact,
    "arc": _arcs,
    "as-published": _printed,
}


def bridge_curve(
    bridges: Bridges, top: float, rtol: float, begin: float = 0.0
) -> Callable[[float], float]:
    """Curve through bridges from a gap to another [m]: polynomials through some dozens of them.

    It runs in the root of the logarithm of the gap's distance to the end, in which a force that
    ends in a fold, with an infinite slope, is smooth too: polynomials converge exponentially.

    Raises
    ------
    InfeasibleError
        If there is no bridge at a gap on the way.
    ConvergenceError
        If the bridges are on no smooth curve.
    """
    import numpy as np

    thin = bridges.thin
    end = bridges.end if math.isfinite(bridges.end) else 2.0 * top
    first, far = (math.sqrt(math.log((end + thin) / (gap + thin))) for gap in (top, begin))

    def force(x: Floats) -> Floats:
        gaps = np.clip((end + thin) * np.exp(-x * x) - thin, begin, top)
        f = bridges.solved(gaps)
        if not np.all(np.isfinite(f)):
            missing = float(gaps[~np.isfinite(f)][0])
            raise InfeasibleError(
                f"no meniscus spans a gap of {missing:g} m on the way; give less "
                "liquid, or another profile"
            )
        return f

    x, f = [first], list[float]()
    for a, b, series in _stretches(force, first, far, rtol):
        places, values = _nodes(series, a, b, rtol)
        x += places[1:]
        f += values[1 if f else 0 :]
    fine = cubic_spline(x, f)  # a float in and out: ten times as quick as arrays
    return lambda gap: fine(math.sqrt(math.log((end + thin) / (gap + thin))))[0]


def _stretches(
    force: Callable[[Floats], Floats], first: float, far: float, rtol: float
) -> list[tuple[float, float, Callable[[Floats], Floats]]]:
    """Stretches of a force and their polynomials; one, but where it ends as no power does."""
    import numpy as np
    from numpy.polynomial import Chebyshev

    found: list[tuple[float, float, Callable[[Floats], Floats]]] = []
    waiting = [(first, far)]
    while waiting:
        a, b = waiting.pop()
        # A contact circle that shrinks to a point needs the finer stretches the nearer they are.
        enough = max(1e-3 * rtol, 1e-14) if a == first else max(rtol, 1e-12)
        for degree in _DEGREES:
            series = Chebyshev.interpolate(force, degree, [a, b])
            tail = float(np.max(np.abs(series.coef[-4:])) / np.max(np.abs(series.coef)))
            if tail <= enough:
                break
        if tail > enough and b - a > _CLOSE * (far - first):
            waiting += [(0.5 * (a + b), b), (a, 0.5 * (a + b))]
            continue
        if tail > 1e-6:
            raise ConvergenceError(
                f"bridges on the sphere do not lie on one curve of the gap, {tail:.1e} off it: "
                f"give less liquid, whose film is thin against the sphere"
            )
        found.append((a, b, series))
    return found


def _nodes(
    series: Callable[[Floats], Floats], a: float, b: float, rtol: float
) -> tuple[list[float], list[float]]:
    """Nodes and values of a spline, quicker to call than a polynomial of high degree."""
    import numpy as np
    from scipy.interpolate import CubicSpline

    nodes, error = 65, math.inf
    while error > max(rtol, 1e-12) and nodes <= _MAX_NODES:
        x = np.linspace(a, b, 2 * nodes - 1)
        f = series(x)
        spline = CubicSpline(x[::2], f[::2])
        error = float(np.max(np.abs(spline(x[1::2]) - f[1::2])) / np.max(np.abs(f)))
        nodes = 2 * nodes - 1
    return x.tolist(), f.tolist()
