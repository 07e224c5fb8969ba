"""Errors of the arc and the published forces against the exact bridge, up to its rupture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...as_published.printed import common as published
from ...capillary.arc import flat as arc_flat
from ...capillary.arc import sphere as arc_sphere
from ...capillary.exact.bridge import bridge
from ...capillary.exact.stability import stability_limit

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = [
    "FLAT_BANDS",
    "SPHERE_BANDS",
    "BandError",
    "flat_errors",
    "flat_forces",
    "relative_errors",
    "sphere_errors",
    "sphere_forces",
]

# Gaps over the stability limit, in which errors are given: they grow towards it, where the slope of
# the exact force is infinite; between flats nothing is left to show below 0.02.
FLAT_BANDS = ((0.02, 0.1), (0.1, 0.3), (0.3, 0.6), (0.6, 0.9), (0.9, 0.99))
SPHERE_BANDS = ((0.0, 0.02), (0.05, 0.2), (0.3, 0.6), (0.6, 0.9), (0.9, 0.99))
_POINTS = 33  # to a band
_SMALL = 0.3  # a force smaller than this times gamma V^(1/3) is judged against that


class BandError(NamedTuple):
    """Largest relative errors [-] in a band of distances over the exact limit, by closure."""

    low: float
    high: float
    errors: Mapping[str, float]


def flat_forces(gaps: Array, lower: float, upper: float) -> dict[str, Array]:
    """Forces over surface tension between flats, for unit volume, with the neck radius beside.

    As published the upper body is pulled, with its contact circle and its angle.
    """
    shape = arc_flat.shape(lower, upper)
    radius = arc_flat.contact_radius(shape, gaps, 1.0)
    above = arc_flat.upper_contact_radius(shape, gaps, radius)
    printed = published.meniscus_flat_3_11(above, gaps, 1.0, lower, upper, "upper")
    return {
        "arc": np.asarray(arc_flat.force(shape, gaps, radius)),
        "as published": np.asarray(printed),
        "neck": np.asarray(arc_flat.neck(shape, gaps, radius)),
    }


def sphere_forces(gaps: Array, lower: float, upper: float, volume: float) -> dict[str, Array]:
    """Forces over surface tension on a sphere of unit radius above a flat."""
    found = {}
    for name, profile in (("arc", "sphere"), ("arc on a parabola", "parabola")):
        state = arc_sphere.solve(gaps, volume, lower, upper, 0.0, 1.0, profile)
        found[name] = np.asarray(state.force)
    found["as published"] = np.asarray(published.meniscus_sphere_3_12(state, 1.0, upper))
    return found


def relative_errors(found: Array, exact: Array, size: float = 1.0) -> Array:
    """Errors of forces over gamma relative to the exact ones, or to 0.3 of the size if larger.

    The size is the cube root of the volume [m].
    """
    return np.asarray(np.abs(found - exact) / np.maximum(np.abs(exact), _SMALL * size))


def flat_errors(
    lower: float, upper: float, bands: Sequence[tuple[float, float]] = FLAT_BANDS
) -> tuple[BandError, ...]:
    """Errors of the force of the arc, of Eq. (3.11), and of the neck of the arc, between flats.

    Forces relative to the exact one, or to 0.3 gamma V^(1/3) where that is larger.
    """
    limit = float(stability_limit(1.0, lower, upper).gap)
    found = []
    for low, high in bands:
        gaps = np.linspace(low, high, _POINTS) * limit
        exact, forces = bridge(gaps, 1.0, lower, upper), flat_forces(gaps, lower, upper)
        neck = forces.pop("neck")
        errors = {
            name: float(relative_errors(force, exact.force).max()) for name, force in forces.items()
        }
        errors["neck"] = float(np.max(np.abs(neck / exact.neck - 1.0)))
        found.append(BandError(low, high, errors))
    return tuple(found)


def sphere_errors(
    lower: float, upper: float, volume: float, bands: Sequence[tuple[float, float]] = SPHERE_BANDS
) -> tuple[BandError, ...]:
    """Errors of the force of the arc on a sphere and on its parabola, and of Eq. (3.12)."""
    limit = float(stability_limit(volume, lower, upper, 0.0, 1.0).gap)
    found = []
    for low, high in bands:
        gaps = np.linspace(low, high, _POINTS) * limit
        exact = bridge(gaps, volume, lower, upper, 0.0, 1.0).force
        size = volume ** (1.0 / 3.0)
        errors = {
            name: float(relative_errors(force, exact, size).max())
            for name, force in sphere_forces(gaps, lower, upper, volume).items()
        }
        found.append(BandError(low, high, errors))
    return tuple(found)
