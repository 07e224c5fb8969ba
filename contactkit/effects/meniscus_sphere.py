"""The meniscus force on a sphere, solved once along the gap and read off a curve in the loop."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..errors import ConvergenceError, InfeasibleError
from .base import ForceLaw
from .film_shape import film_shape

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

    from ..accuracy import Accuracy
    from ..scene import SeparationScene

__all__ = ["sphere_law"]

_MOST_NODES = 4097


def sphere_law(scene: SeparationScene, accuracy: Accuracy, *, as_published: bool) -> ForceLaw:
    """Force of the arc meniscus of constant volume on a sphere, as a law of the gap.

    The arc is solved on nodes in the logarithm of the gap, doubled until the spline between them
    agrees with the arc at the midpoints to a tenth of the tolerance of time, and a spline is what
    the loop calls: microseconds in place of milliseconds.
    """
    import numpy as np

    from ..kernels import arc_sphere, published

    interface, meniscus = scene.interface, scene.interface.meniscus
    film = film_shape(scene)
    volume, n = film.volume, film.menisci
    tension = meniscus.liquid.at(scene.temperature).surface_tension
    assert tension is not None  # plan() has asked lacks() first
    lower, upper = meniscus.contact_angle_lower, meniscus.contact_angle_upper
    curvatures = (interface.lower.curvature, interface.upper.curvature)
    profile = "parabola" if as_published else "sphere"
    end = float(arc_sphere.zero_neck_gap(volume, lower, upper, *curvatures, profile=profile))

    def force(gap: Floats) -> Floats:
        state = arc_sphere.solve(gap, volume, lower, upper, *curvatures, profile=profile)
        if as_published:
            return np.asarray(published.meniscus_sphere_3_12(state, tension, upper) * left(gap))
        return np.asarray(tension * state.force)

    # The printed force grows without bound as the neck closes; a curve of it would ring. What is
    # tabulated is the force times the share of the way to the end that is left.
    def left(gap: Any) -> Any:
        return 1.0 - gap / end if as_published else 1.0

    # Lengths of the film: where it is thinner than this, the force hardly depends on the gap.
    thin = 0.1 * math.sqrt(volume / (math.pi * film.sphere_radius))
    top = min(scene.opening.final_gap * 2.0, end * (1.0 - 1e-9))
    curve = _spline(force, thin, top, 0.1 * accuracy.time_rtol)

    def law(gap: float, speed: float) -> float:
        gap = min(max(gap, 0.0), top)
        return n * curve(gap) / float(left(gap))

    return ForceLaw(law, end=end)


def _spline(
    force: Callable[[Floats], Floats], thin: float, top: float, rtol: float
) -> Callable[[float], float]:
    """Curve through a force on nodes in the logarithm of the gap, as many as it takes.

    Raises
    ------
    InfeasibleError
        If there is no arc at a gap on the way.
    ConvergenceError
        If the force is not smooth enough for a curve.
    """
    import numpy as np
    from scipy.interpolate import CubicSpline

    far = math.log1p(top / thin)
    nodes, error = 33, math.inf
    while error > max(rtol, 1e-12) and 2 * nodes - 1 <= _MOST_NODES:
        x = np.linspace(0.0, far, 2 * nodes - 1)
        gaps = np.minimum(thin * np.expm1(x), top)
        f = force(gaps)
        if not np.all(np.isfinite(f)):
            missing = float(gaps[~np.isfinite(f)][0])
            raise InfeasibleError(f"no arc meniscus spans a gap of {missing:g} m on the way")
        spline = CubicSpline(x[::2], f[::2])
        error = float(np.max(np.abs(spline(x[1::2]) - f[1::2])) / np.max(np.abs(f)))
        nodes = 2 * nodes - 1
    if error > 1e-6:
        raise ConvergenceError(
            f"the meniscus force on the sphere is rough: {error:.1e} off a curve"
        )
    fine = CubicSpline(x, f)
    return lambda gap: float(fine(math.log1p(gap / thin)))
