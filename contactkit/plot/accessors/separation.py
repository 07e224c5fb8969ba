"""Figures of a separation and of a sliding, ``result.plot``."""

from __future__ import annotations

from ...separation.effects.base import effects_of
from ...separation.results import SeparationResult
from ...separation.sliding.result import SlidingResult
from .. import separation
from ..style import Axes
from .base import CurveFigures, of_absent_effects, registered_figures

__all__ = ["SeparationFigures", "SlidingFigures"]


@registered_figures.register(SeparationResult)
class SeparationFigures(CurveFigures[SeparationResult]):
    """Figures of a separation; those of what the run does not determine are not there."""

    def _hidden(self) -> frozenset[str]:
        columns, plan = self._owner.columns, self._owner.plan
        known = {
            c.name for effect in effects_of(plan.scene) for c in effect.curves() if c.unit == "N"
        }
        needs = {
            "gap": {"time", "gap"} <= set(columns),
            "forces": bool((known | {"pull"}) & set(columns)),
            "cycles": "mean_pull" in columns,
        }
        return of_absent_effects(plan) | {name for name, there in needs.items() if not there}

    def gap(self, *, ax: Axes | None = None) -> Axes:
        """Draw the gap over time."""
        return separation.motion(self._owner, ax)

    def forces(self, *, ax: Axes | None = None) -> Axes:
        """Draw the forces over the gap; hatched where a limit of the liquid acts."""
        return separation.forces(self._owner, ax)

    def cycles(self, *, ax: Axes | None = None) -> Axes:
        """Draw the pull over the cycles of a vibration."""
        return separation.cycles(self._owner, ax)

    def scaled(self, *names: str, over: str = "gap", ax: Axes | None = None) -> Axes:
        """Draw curves over another one, each in units of its reference scale."""
        return separation.over_scales(self._owner, names, ax, over)


@registered_figures.register(SlidingResult)
class SlidingFigures(CurveFigures[SlidingResult]):
    """Figures of a sliding."""

    def _hidden(self) -> frozenset[str]:
        return of_absent_effects(self._owner.plan)

    def forces(self, *, ax: Axes | None = None) -> Axes:
        """Draw the tangential forces over the travel, or the impulse if a time is imposed."""
        return separation.slide(self._owner, ax)

    def scaled(self, *names: str, over: str = "travel", ax: Axes | None = None) -> Axes:
        """Draw curves over another one, each in units of its reference scale."""
        return separation.over_scales(self._owner, names, ax, over)
