"""Figures of a gradient, ``gradient.plot``."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ...scene.gradient import Gradient
from ..style import Axes
from .base import Figures, registered_figures

__all__ = ["GradientFigures"]


@registered_figures.register(Gradient)
class GradientFigures(Figures[Gradient]):
    """Figures of the slopes of a number."""

    def pictures(self) -> dict[str, Callable[[], Axes]]:
        """See `Figures.pictures`: those of the slopes that there are."""
        found: dict[str, Callable[[], Axes]] = {}
        if "heights" in self._owner.slopes:
            found["heights"] = self.heights
        if self._owner.bases:
            found["relative"] = self.relative
        return found

    def heights(self, *, ax: Axes | None = None) -> Axes:
        """Draw the slope over the height of each pixel.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if not given.

        Raises
        ------
        DescriptionError
            If the gradient is not over the heights.
        """
        from ..gradient import gradient_map  # contacts, for this alone

        return gradient_map(self._owner, ax)

    def relative(self, *, names: Mapping[str, str] | None = None, ax: Axes | None = None) -> Axes:
        """Draw the relative change of the number per relative change of each parameter.

        Parameters
        ----------
        names : mapping, optional
            What to call the parameters, by path; else the end of the path.
        ax : Axes, optional
            Where to draw; a new figure if not given.
        """
        from ..gradient import relative_bars  # as above

        return relative_bars(self._owner, ax, names)
