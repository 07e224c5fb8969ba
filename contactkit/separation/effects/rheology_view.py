"""Rheology of a film as the effects of a scene see it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

from ...validity import ValidityNumber
from .force_law import ForceLaw

__all__ = ["FilmRheologyView", "RheologicalForce"]


class RheologicalForce(Protocol):
    """Prepared force of a film whose viscosity is not one number, or which slips."""

    def force_law(self) -> ForceLaw:
        """Force as a motion takes it."""

    def limiter(self) -> Callable[[float, float, float], float]:
        """Force that a truncated pressure leaves, at a gap, a speed and a force without limits."""

    def force_ratio(self, gap: float, speed: float) -> float:
        """Force over that without rheology and slip [-] at a gap [m] and a speed [m/s]."""


class FilmRheologyView(Protocol):
    """Rheology of a film: parts that are computed, and parts that are left out."""

    @property
    def computed(self) -> tuple[str, ...]:
        """Parts of the liquid that the force computes."""

    @property
    def is_linear(self) -> bool:
        """Whether the force is proportional to the speed."""

    @property
    def notes(self) -> tuple[str, ...]:
        """Parts that are computed and left out, in sentences."""

    @property
    def film(self) -> RheologicalForce | None:
        """Film with what is computed; None: it is Newtonian and does not slip."""

    def again(self, prepared: Any) -> FilmRheologyView | None:
        """The same choice for another volume of the liquid, of a prepared scene."""

    def numbers(
        self, prepared: Any, path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """Ranges along gaps [m] and speeds [m/s]."""
