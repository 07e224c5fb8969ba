"""Film that slips on a face of any shape: generalised Reynolds' equation on a grid.

A grid gives the ratio to the film that does not slip on the same grid, and `FaceFilm` the force of
that: the error of the cells cancels but for what slip changes of it.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import frozen

from ...errors import PlanError
from ...lubrication.flow_laws.closed_forms import slip_disc_factor
from ...lubrication.flow_laws.newtonian import Newtonian
from ...lubrication.flow_laws.on_grid import solve_on_grid
from ...lubrication.reynolds.shape_factor import unit_damping
from ..effects.force_law import ForceLaw
from ..face.film import FaceFilm
from ..face.grid import FaceGrid, gridded
from .table import places

if TYPE_CHECKING:
    from ..effects.base import Limiter

__all__ = ["SlippingFace"]

_CELLS = 48  # along the longer side
_RTOL = 1e-8  # of the conductivities of a solution


@frozen(eq=False)
class SlippingFace:
    """Full film of a Newtonian liquid that slips, on a face; prepared for a motion.

    Parameters
    ----------
    full : FaceFilm
        The film without slip.
    law : Newtonian
        Flow of the liquid, with slip.
    gaps : (float, float)
        Smallest and largest gap of its table [m].
    """

    full: FaceFilm
    law: Newtonian
    gaps: tuple[float, float]

    @cached_property
    def _grid(self) -> FaceGrid:
        return gridded(self.full.shape, _CELLS)

    @cached_property
    def _table(self) -> Any:
        """Logarithm of what slip leaves of the force, over that of the gap."""
        from scipy.interpolate import make_interp_spline

        gaps = places(self.gaps)
        ratios = [self.exact_ratio(gap) for gap in gaps.tolist()]
        return make_interp_spline(np.log(gaps), np.log(ratios), k=5)

    def exact_ratio(self, gap: float) -> float:
        """Force over that without slip [-] at a gap [m]: even faces have that of a disc."""
        if self.full.shape.is_even:
            return float(slip_disc_factor(gap, *self.law.slip_length))
        grid = self._grid
        slips = solve_on_grid(grid.face, self.law, grid.relief + gap, 1.0, rtol=_RTOL).force
        plain = self.law.viscosity * unit_damping(grid.face, grid.relief + gap).coefficient
        return slips / plain

    def force_ratio(self, gap: float, speed: float) -> float:
        """Force over that without slip [-], at any speed."""
        low, high = self.gaps
        if self.full.shape.is_even or not low <= gap <= high:
            return self.exact_ratio(gap)
        return math.exp(float(self._table(math.log(gap))))

    def force(self, gap: float, speed: float) -> float:
        """Force [N] at a gap [m] and a speed [m/s]."""
        plain = self.law.viscosity * self.full.coefficient(gap)
        return plain * self.force_ratio(gap, speed) * speed

    def force_law(self) -> ForceLaw:
        """Force as a motion takes it."""
        return ForceLaw(self.force, rate="proportional")

    def limiter(self) -> Limiter:
        """Refuse a truncated pressure.

        Raises
        ------
        PlanError
            Always: on such a face a cavity is followed, or there is none.
        """
        raise PlanError("a truncated pressure is not known on a face that is no disc")
