"""Figures of curves and other answers that take many solves, ``curve.plot``."""

from __future__ import annotations

from ...analyses.division import DivisionResult
from ...analyses.load_displacement.curve import LoadDisplacementCurve
from ...analyses.pull_off import PullOffCurve
from ...analyses.stick_slip import StickSlip
from .. import adhesion, load_displacement, slip
from ..style import Axes
from .base import CurveFigures, registered_figures

__all__ = [
    "DivisionFigures",
    "LoadDisplacementFigures",
    "PullOffFigures",
    "StickSlipFigures",
]


@registered_figures.register(DivisionResult)
class DivisionFigures(CurveFigures[DivisionResult]):
    """Figures of a film divided into menisci."""

    def forces(self, *, ax: Axes | None = None) -> Axes:
        """Draw the forces that the scene lists over the number of menisci."""
        names = [n for n in self.curve_names if n.endswith("_force")]
        return self.curves(*names, ax=ax)


@registered_figures.register(LoadDisplacementCurve)
class LoadDisplacementFigures(CurveFigures[LoadDisplacementCurve]):
    """Figures of a load-displacement curve."""

    def force(self, *, ax: Axes | None = None) -> Axes:
        """Draw first loading and the unloading curves."""
        return load_displacement.force(self._owner, ax)


@registered_figures.register(PullOffCurve)
class PullOffFigures(CurveFigures[PullOffCurve]):
    """Figures of a contact under adhesion that is approached and separated."""

    def load(self, *, ax: Axes | None = None) -> Axes:
        """Draw the load over the approach of both branches; jumps are dotted."""
        return adhesion.pull_off_curve(self._owner, ax)

    def area(self, *, ax: Axes | None = None) -> Axes:
        """Draw the contact area over the approach of both branches; jumps are dotted."""
        return adhesion.contact_area(self._owner, ax)


@registered_figures.register(StickSlip)
class StickSlipFigures(CurveFigures[StickSlip]):
    """Figures of stick-slip."""

    def force(self, *, ax: Axes | None = None) -> Axes:
        """Draw the force of the spring over time, with the levels of friction."""
        return slip.stick_slip_force(self._owner, ax)
