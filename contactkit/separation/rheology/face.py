"""Film that slips on an even face of any planform: in closed form, as between discs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from attrs import frozen

from ...errors import PlanError
from ...lubrication.flow_laws.closed_forms import slip_disc_factor
from ...lubrication.flow_laws.newtonian import Newtonian
from ..effects.force_law import ForceLaw
from ..face.film import FaceFilm

if TYPE_CHECKING:
    from ..effects.base import Limiter

__all__ = ["SlippingFace"]


@frozen(eq=False)
class SlippingFace:
    """Full film of a Newtonian liquid that slips, on an even face.

    The gap is the same everywhere, and with it what slip adds to the flux.

    Parameters
    ----------
    full : FaceFilm
        The film without slip.
    law : Newtonian
        Flow of the liquid, with slip.
    """

    full: FaceFilm
    law: Newtonian

    def force_ratio(self, gap: float, speed: float) -> float:
        """Force over that without slip [-] at a gap [m], at any speed."""
        return float(slip_disc_factor(gap, *self.law.slip_length))

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
