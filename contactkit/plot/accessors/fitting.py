"""Figures of a fit, of a profile and of a posterior, ``fit.plot``."""

from __future__ import annotations

from ...errors import NotSimulatedError
from ...fitting.result import Fit
from .. import fit as of_fit
from ..style import Axes
from .base import Figures, registered_figures

__all__ = ["FitFigures"]


@registered_figures.register(Fit)
class FitFigures(Figures[Fit]):
    """Figures of a fit; curves of several units are drawn one by one, by their columns."""

    def data(self, *, ax: Axes | None = None) -> Axes:
        """Draw the readings with their noise, and the fitted model."""
        return of_fit.data(self._of_one_unit(), ax)

    def residuals(self, *, ax: Axes | None = None) -> Axes:
        """Draw the residuals in units of the noise."""
        return of_fit.residuals(self._of_one_unit(0), ax)

    def information(self, *, ax: Axes | None = None) -> Axes:
        """Draw which readings decide which parameter."""
        return of_fit.information(self._of_one_unit(0), ax)

    def correlation(self, *, ax: Axes | None = None) -> Axes:
        """Draw the correlations of the parameters."""
        return of_fit.correlation(self._owner, ax)

    def _hidden(self) -> frozenset[str]:
        units = {curve.units for curve in self._owner.curves}
        axes = {curve.units[0] for curve in self._owner.curves}
        hidden = {"data"} if len(units) > 1 else set()
        return frozenset(hidden | ({"residuals", "information"} if len(axes) > 1 else set()))

    def _of_one_unit(self, end: int = 2) -> Fit:
        """The fit, if its curves have the axis (and the unit of the quantity) in common."""
        known = {curve.units[:1] if end == 0 else curve.units for curve in self._owner.curves}
        if len(known) > 1:
            raise NotSimulatedError(
                "the curves of this fit have several units: draw the columns of fit.curves apart"
            )
        return self._owner
