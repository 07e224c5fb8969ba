"""Limits of a wet map: rigid bodies with a film, and deforming bodies without one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ....errors import ConvergenceError
from ....numerics.blas import one_thread
from ...reynolds.linear_systems import factorised
from ..drive import Imposed
from ..wet_gap import Sets
from .preconditioner import LocalCompliance
from .step import step
from .wet_map import MapFields, WetMap

__all__ = ["dry_contact", "rigid_damping"]

Array = NDArray[np.float64]

# Time of a rest over that in which a film of the cut-off drains from the face: what is left of the
# pressure of the film is then round-off.
_RESTED = 1e6


def rigid_damping(wet: WetMap, rigid_gap: float) -> float:
    """Damping coefficient of rigid bodies at a gap [N.s/m], with a full film.

    Raises
    ------
    ConvergenceError
        If the bodies overlap, and have no cut-off.
    """
    shape = rigid_gap + wet.of_map(wet.shape)
    gap = np.maximum(shape, wet.cutoff)
    if not gap.min() > 0.0:
        raise ConvergenceError(f"rigid bodies overlap at a gap of {rigid_gap:g} m")
    # Where they touch nothing can open, but for its film.
    solve = factorised(wet.matrix(gap))
    found = solve(wet.storage * np.where(shape >= gap, 1.0, 0.0))
    return wet.thrust(found.astype(np.float64))


@one_thread()
def dry_contact(wet: WetMap, rigid_gaps: Sequence[float]) -> Array:
    """Contact force at the cut-off, after a rest without end, at each of some gaps [N].

    Parameters
    ----------
    wet : WetMap
        With a cut-off.
    rigid_gaps : sequence of float
        [m], from the largest on downwards.

    Raises
    ------
    StepFailedError
        If a contact cannot be solved.
    """
    dry = evolve(wet, floor=-np.inf)
    local = LocalCompliance(dry)
    none = np.zeros(dry.mesh.size)
    sets = Sets(none > 0.0, none > 0.0)
    rim2 = dry.mesh.size * dry.cell_area
    modulus = 1.0 / (local.of_face / np.sqrt(rim2))
    length = _RESTED * 12.0 * dry.viscosity * rim2 / (dry.cutoff**2 * modulus)
    forces = []
    total = none
    for gap in rigid_gaps:
        at = evolve(dry, drive=Imposed(lambda _, gap=gap: gap))  # type: ignore[misc]
        shape = gap + at.of_map(at.shape)
        start = MapFields(none, np.maximum(shape, at.cutoff), total, gap, 0.0)
        done = step(at, local, start, (start, sets), 0.0, length)
        sets, total = done.sets, done.fields.total
        forces.append(at.thrust(done.fields.total - done.fields.pressure))
    return np.array(forces)
