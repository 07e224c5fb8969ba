"""One pass over the planes below a contact: maxima, a section, and the planes if wanted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ...elasticity.stress import measures as stress_measures
from ...elasticity.stress.maxima import maxima
from ...elasticity.stress.planes import Plane, planes
from .base import Contact
from .stress import StressPart

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["scan"]


def scan(
    contact: Contact,
    where: Sequence[tuple[float, str]],
    friction: tuple[float, float],
    keep_planes: bool,
    window: float,
) -> StressPart:
    """Stress of a contact on planes.

    Parameters
    ----------
    contact : Contact
        Solved.
    where : sequence of (float, str)
        Depth [m] and side of each plane, in order.
    friction : (float, float)
        Traction along x and y per unit of pressure [-]; what is 0 is not transformed.
    keep_planes : bool
        Whether to keep the planes themselves.
    window : float
        Padding of a window without neighbours [-].
    """
    stack = contact.scene.interface.lower.stack
    assert stack is not None
    pressure, (ny, nx) = contact.pressure, contact.grid.shape
    row = int(np.unravel_index(int(np.argmax(pressure)), pressure.shape)[0])
    tractions = [share * pressure if share != 0.0 else None for share in friction]
    n = len(where)
    section, largest = np.empty((6, n, nx)), []
    kept = np.empty((6, n, ny, nx)) if keep_planes else None
    layers = np.empty(n, dtype=int)
    found = planes(
        pressure, tractions[0], tractions[1], contact.grid.pixel_size,
        stack.young_moduli, stack.poisson_ratios, stack.thicknesses,
        [depth for depth, _ in where], [side for _, side in where],
        mean="periodic" if contact.grid.periodic else "free", padding=window,
        workers=contact.threads,
    )  # fmt: skip

    def passing() -> Iterator[Plane]:
        for i, plane in enumerate(found):
            section[:, i] = plane.stress[:, row]
            layers[i] = plane.layer
            if kept is not None:
                kept[:, i] = plane.stress
            yield plane

    def von_mises(stress: Map) -> Map:
        values = stress_measures.von_mises(stress)
        largest.append(float(values.max()))
        return values

    measures = {
        "von_mises": von_mises,
        "tension": stress_measures.largest_tension,
        "tresca": stress_measures.tresca,
        "sigma_xz": lambda stress: np.abs(stress[4]),
    }
    best = maxima(passing(), measures, contact.grid.pixel_size, refine=True)
    mises = best["von_mises"]
    best["sqrt_j2"] = mises._replace(value=mises.value / 3.0**0.5)
    depths = np.array([depth for depth, _ in where])
    sides = tuple(side for _, side in where)
    return StressPart(depths, sides, layers, best, row, section, np.array(largest), kept)
