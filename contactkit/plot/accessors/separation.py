"""Figures of a separation and of a sliding, ``result.plot``."""

from __future__ import annotations

from pathlib import Path

from ...separation.deforming.result import DeformingResult
from ...separation.effects.base import effects_of
from ...separation.results import SeparationResult
from ...separation.sliding.result import SlidingResult
from .. import deforming, separation
from ..style import Axes
from .base import CurveFigures, of_absent_effects, registered_figures

__all__ = ["DeformingFigures", "SeparationFigures", "SlidingFigures"]


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

    def forces(self, *, over: str = "", ax: Axes | None = None) -> Axes:
        """Draw the forces over the gap, or over time where a limit of the liquid acts."""
        return separation.forces(self._owner, ax, over=over)

    def cycles(self, *, ax: Axes | None = None) -> Axes:
        """Draw the pull over the cycles of a vibration."""
        return separation.cycles(self._owner, ax)

    def scaled(self, *names: str, over: str = "gap", ax: Axes | None = None) -> Axes:
        """Draw curves over another one, each in units of its reference scale."""
        return separation.over_scales(self._owner, names, ax, over)


@registered_figures.register(DeformingResult)
class DeformingFigures(CurveFigures[DeformingResult]):
    """Figures of a separation of deforming bodies."""

    def _hidden(self) -> frozenset[str]:
        absent = of_absent_effects(self._owner.plan)
        return absent if self._owner.fields else absent | {"regions", "field", "animate"}

    def loop(self, *, ax: Axes | None = None) -> Axes:
        """Draw the forces over the gap of the undeformed bodies."""
        return deforming.loop(self._owner, ax)

    def gaps(self, *, ax: Axes | None = None) -> Axes:
        """Draw the gaps over time."""
        return deforming.gaps(self._owner, ax)

    def sections(self, *, ax: Axes | None = None) -> Axes:
        """Draw the gap over the radius at five instants; of a map over x."""
        return deforming.sections(self._owner, ax)

    def regions(self, time: float | None = None, *, ax: Axes | None = None) -> Axes:
        """Draw contact, film and void on the map, at a time [s] or where most is to be seen."""
        return deforming.regions(self._owner, time, ax)

    def field(self, name: str, time: float | None = None, *, ax: Axes | None = None) -> Axes:
        """Draw a map: "gap", "film_pressure", "solid_pressure" or "liquid"."""
        return deforming.field(self._owner, name, time, ax)

    def animate(self, path: str | Path, *, rate: int = 8) -> Path:
        """Write an animation of the map as GIF."""
        return deforming.animate(self._owner, path, rate=rate)

    def energies(self, *, ax: Axes | None = None) -> Axes:
        """Draw the energies over time."""
        return deforming.energies(self._owner, ax)


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
