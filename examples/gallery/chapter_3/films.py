"""Films of chapter 3: what the captions state, the volumes, and the three closures of the force.

The captions state water of 72 mN/m and 0.89 mPa.s (printed as cSt, used as mPa.s), menisci of
100 nm between flats, spheres of 100 nm, heights of the film of 2 to 6 nm and a separation time of
0.1 us. They do not state the body that is pulled, nor the volume of the liquid: the circle of
100 nm is taken for that on the lower body, which is pulled, and the volume for that of the arc at
the initial gap, as section 3.2.1.4 prescribes.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contactkit.as_published.corrected import film_volume
from contactkit.as_published.printed.common import meniscus_flat_3_11, meniscus_sphere_3_12
from contactkit.capillary.arc import flat as arc_flat
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.capillary.arc.bridge import arc_bridge
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.stability import stability_limit
from contactkit.plot import style as plot
from contactkit.units import deg, nm, us

__all__ = [
    "GAMMA",
    "HEIGHTS",
    "PAIRS",
    "RADIUS",
    "SHADES",
    "STYLES",
    "TIME",
    "VISCOSITY",
    "Forces",
    "angles",
    "break_gaps",
    "flats",
    "heights_legend",
    "key",
    "ratio_text",
    "separations",
    "sphere",
    "sphere_break_gaps",
    "sphere_volume",
    "volume",
]

Array = NDArray[np.float64]

GAMMA, VISCOSITY, TIME = 0.072, 0.89e-3, 0.1 * us
RADIUS = 100 * nm  # of the meniscus between flats, and of the sphere
HEIGHTS = np.array([2.0, 3.0, 4.0, 5.0, 6.0]) * nm
PAIRS = ((60, 60), (0, 60), (120, 120), (180, 120))  # contact angles [deg], lower and upper

SHADES = ("#440154", "#3b528b", "#21918c", "#5ec962", "#d9a400")  # one for each height
STYLES = {"exact": "-", "arc": "--", "printed": ":"}


class Forces(NamedTuple):
    """Forces [N] of a bridge over the gap by the three closures; nan where there is no bridge."""

    exact: Array
    arc: Array
    printed: Array


def key(pair: Sequence[int]) -> str:
    """Name of a pair of contact angles in the data of a figure."""
    return f"{pair[0]}_{pair[1]}"


def angles(pair: Sequence[float]) -> tuple[float, float]:
    """Contact angles [rad] of a pair in degrees."""
    return pair[0] * deg, pair[1] * deg


def volume(gap: float, pair: Sequence[float], radius: float = RADIUS) -> float:
    """Volume [m3] of the arc between flats with a contact circle on the lower one."""
    return arc_flat.volume(arc_flat.shape(*angles(pair)), gap, radius)


def sphere_volume(
    gap: float, height: float, pair: Sequence[int] = (60, 60), radius: float = RADIUS
) -> float:
    """Volume [m3] of the arc under a sphere that is wetted up to a height above the flat."""
    return film_volume(radius, gap, height, *angles(pair))


def break_gaps(liquid: float, pair: Sequence[float]) -> tuple[float, float]:
    """Gaps [m] at which a bridge between flats breaks: exact limit, neck of the arc closed."""
    pair_of = angles(pair)
    closed = arc_flat.zero_neck_gap(arc_flat.shape(*pair_of), liquid)
    return float(stability_limit(liquid, *pair_of).gap), float(closed)


def sphere_break_gaps(
    liquid: float, pair: Sequence[int] = (60, 60), radius: float = RADIUS
) -> tuple[float, float]:
    """Gaps [m] at which a bridge under a sphere breaks: exact limit, neck of the arc closed."""
    pair_of = angles(pair)
    curved = (0.0, 1.0 / radius)
    closed = arc_sphere.zero_neck_gap(liquid, *pair_of, *curved, profile="parabola")
    return float(stability_limit(liquid, *pair_of, *curved).gap), float(closed)


def separations(start: float, limits: Iterable[float], n: int) -> Array:
    """Gaps [m] from a start to the last limit, dense at the start, with all limits among them."""
    ends = [end * (1.0 - 1e-9) for end in limits]
    step = 0.005 * start if start else 1e-3 * min(ends)
    gaps = start + np.concatenate(([0.0], np.geomspace(step, ends[-1] - start, n - 1)))
    found = np.sort(np.concatenate((gaps[:-1], ends)))
    return np.asarray(found[np.append(True, np.diff(found) > 1e-12 * found[-1])])


def flats(gaps: Any, liquid: Any, pair: Sequence[int]) -> Forces:
    """Forces between flats; Eq. (3.11) has the circle of the arc on the lower, pulled flat."""
    lower, upper = angles(pair)
    gaps, liquid = np.broadcast_arrays(np.asarray(gaps, float), np.asarray(liquid, float))
    exact = GAMMA * bridge(gaps, liquid, lower, upper, beyond="nan").force
    arc = arc_bridge(gaps, liquid, lower, upper, beyond="nan")
    printed = meniscus_flat_3_11(arc.radius_lower, gaps, GAMMA, lower, upper)
    return Forces(exact, GAMMA * arc.force, printed)


def sphere(
    gaps: Any, liquid: Any, pair: Sequence[int] = (60, 60), radius: float = RADIUS
) -> tuple[Forces, Array]:
    """Forces on a sphere, and Eq. (3.12) with a minus for its second curvature."""
    lower, upper = angles(pair)
    gaps, liquid = np.broadcast_arrays(np.asarray(gaps, float), np.asarray(liquid, float))
    curved = (0.0, 1.0 / radius)
    exact = GAMMA * bridge(gaps, liquid, lower, upper, *curved, beyond="nan").force
    state = arc_sphere.solve(gaps, liquid, lower, upper, *curved, profile="parabola")
    printed = meniscus_sphere_3_12(state, GAMMA, upper)
    x, inverse, slope = state.radius_upper, state.inverse_arc_radius, state.slope_upper
    laplace = np.pi * x**2 * inverse  # of the curvature of the arc alone
    line = 2.0 * np.pi * x * np.sin(slope + upper)
    minus = GAMMA * 2.0 * (laplace + line) - printed
    return Forces(exact, GAMMA * state.force, printed), minus


def ratio_text(ratios: Iterable[float]) -> str:
    """Least and greatest of some ratios, as text."""
    found = list(ratios)
    return f"{min(found):.3g} to {max(found):.3g}"


def heights_legend(
    ax: Any, styles: Sequence[tuple[str, str]], symbol: str = "$h_0$", **more: Any
) -> None:
    """Legend of a panel: a colour for each height of the film, a line style for each closure."""
    for height, shade in zip(HEIGHTS, SHADES, strict=True):
        ax.plot([], [], "-", lw=4, color=shade, label=f"{symbol} = {height / nm:g} nm")
    for label, style in styles:
        ax.plot([], [], style, color="0.2", label=label)
    plot.legend(ax, **({"fontsize": 8, "handlelength": 2.4} | more))
