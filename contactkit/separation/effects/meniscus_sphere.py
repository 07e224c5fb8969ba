"""Meniscus force on a sphere: bridges solved along the gap, and a curve through them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from ...errors import ConvergenceError, InfeasibleError
from ...numerics.cubic_spline import cubic_spline
from .base import ForceLaw

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

    from ...scene.scenes import SeparationScene
    from .prepared import PreparedScene

__all__ = ["contact_radius", "exact_end", "sphere_law"]

_DEGREES = 24, 48, 96  # of the polynomials
_CLOSE = 1e-3  # of a curve, a stretch at its end that is not divided further
_MAX_NODES = 4097  # of one of its stretches


class _Bridges(NamedTuple):
    """Force over surface tension [m] of one meniscus at gaps [m], up to an end.

    `thin` is a gap below which the force hardly depends on it. What is tabulated is the force
    times `left`, a known factor that takes a pole away.
    """

    force: Callable[[Floats], Floats]
    end: float
    thin: float
    left: Callable[[Any], Any] = lambda gap: 1.0


def sphere_law(prepared: PreparedScene[SeparationScene], profile: str) -> ForceLaw:
    """Force of the meniscus on a sphere, as a law of the gap.

    Some dozens of bridges are solved, until the curve through them is known to a tenth of the
    tolerance of time, and a spline is what the loop calls: microseconds in place of milliseconds.
    """
    scene, tension = prepared.scene, prepared.liquid.surface_tension
    n = scene.meniscus.count
    bridges = _exact(prepared) if profile == "exact" else _arcs(prepared, profile == "as-published")
    known_to = bridges.end if math.isfinite(bridges.end) else 2.0 * scene.loading.final_gap
    top = min(known_to, bridges.end * (1.0 - 1e-9))
    curve = _curve(bridges, top, 0.1 * prepared.accuracy.time_rtol)

    def law(gap: float, speed: float) -> float:
        gap = min(max(gap, 0.0), top)
        return n * tension * curve(gap) / float(bridges.left(gap))

    return ForceLaw(law, end=bridges.end, known_to=known_to)


def _fixed(prepared: PreparedScene[SeparationScene]) -> tuple[float, float, float, float]:
    """Angles [rad] and curvatures [1/m] of the bodies."""
    return (*prepared.angles, *prepared.curvatures)


def exact_end(prepared: PreparedScene[SeparationScene]) -> float:
    """Gap [m] at which the exact bridge on a sphere ends."""
    pressure, fixed = prepared.scene.liquid_pressure, _fixed(prepared)
    if pressure is not None:
        from ...capillary.exact.at_pressure import max_gap_at_pressure

        return max_gap_at_pressure(pressure / prepared.liquid.surface_tension, *fixed)
    from ...capillary.exact.stability import stability_limit

    return float(stability_limit(prepared.film.volume, *fixed).gap)


def contact_radius(prepared: PreparedScene[SeparationScene], profile: str, gap: float) -> float:
    """Radius [m] of the contact circle on the flat body at a gap [m]; nan without a meniscus."""
    pressure, film, fixed = prepared.scene.liquid_pressure, prepared.film, _fixed(prepared)
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


def _exact(prepared: PreparedScene[SeparationScene]) -> _Bridges:
    pressure = prepared.scene.liquid_pressure
    film, fixed, end = prepared.film, _fixed(prepared), exact_end(prepared)
    if pressure is None:
        from ...capillary.exact.bridge import bridge

        thin = 0.1 * math.sqrt(film.volume / (math.pi * film.sphere_radius))
        return _Bridges(lambda gap: bridge(gap, film.volume, *fixed, beyond="nan").force, end, thin)
    from ...capillary.exact.at_pressure import bridge_at_pressure

    over = pressure / prepared.liquid.surface_tension
    return _Bridges(
        lambda gap: bridge_at_pressure(gap, over, *fixed, beyond="nan").force, end, 0.1 * end
    )


def _arcs(prepared: PreparedScene[SeparationScene], as_published: bool) -> _Bridges:
    from ...as_published.printed import common as published
    from ...capillary.arc import sphere as arc_sphere

    film, fixed = prepared.film, _fixed(prepared)
    profile = "parabola" if as_published else "sphere"
    end = float(arc_sphere.zero_neck_gap(film.volume, *fixed, profile=profile))

    # The printed force grows without bound as the neck closes; a curve of it would ring. What is
    # tabulated is the force times 1 - gap/end.
    def left(gap: Any) -> Any:
        return 1.0 - gap / end if as_published else 1.0

    def force(gap: Floats) -> Floats:
        state = arc_sphere.solve(gap, film.volume, *fixed, profile=profile)
        if as_published:
            return published.meniscus_sphere_3_12(state, 1.0, fixed[1]) * left(gap)  # type: ignore[no-any-return]
        return state.force

    # Length of the film: where it is thinner than this, the force hardly depends on the gap.
    thin = 0.1 * math.sqrt(film.volume / (math.pi * film.sphere_radius))
    return _Bridges(force, end, thin, left)


def _curve(bridges: _Bridges, top: float, rtol: float) -> Callable[[float], float]:
    """Curve through a force: polynomials through some dozens of bridges, as a spline.

    It runs in the root of the logarithm of the gap's distance to the end, in which a force that
    ends in a fold, with an infinite slope, is smooth too: polynomials converge exponentially.

    Raises
    ------
    InfeasibleError
        If there is no bridge at a gap on the way.
    ConvergenceError
        If the force is not smooth enough for a curve.
    """
    import numpy as np

    thin = bridges.thin
    end = bridges.end if math.isfinite(bridges.end) else 2.0 * top
    first, far = (math.sqrt(math.log((end + thin) / (gap + thin))) for gap in (top, 0.0))

    def force(x: Floats) -> Floats:
        gaps = np.clip((end + thin) * np.exp(-x * x) - thin, 0.0, top)
        f = bridges.force(gaps)
        if not np.all(np.isfinite(f)):
            missing = float(gaps[~np.isfinite(f)][0])
            raise InfeasibleError(f"no meniscus spans a gap of {missing:g} m on the way")
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
                f"the meniscus force on the sphere is rough: {tail:.1e} off a curve; give less "
                f"liquid, or take MeniscusForce(profile='arc')"
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
