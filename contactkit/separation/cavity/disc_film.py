"""Film between flats that can cavitate, as numbers."""

from __future__ import annotations

import math

from attrs import frozen

__all__ = ["DiscFilm"]


@frozen
class DiscFilm:
    """One of `menisci` equal films between flats, and the tensions at which its liquid cavitates.

    Parameters
    ----------
    menisci : int
        Number of equal films.
    rim_square : float
        Square of the radius of the face of one of them [m2].
    volume : float
        Volume of its liquid [m3]; inf where the rim is flooded.
    viscosity : float
        Viscosity of the liquid [Pa.s].
    strength : float
        Tension at which the full film cavitates [Pa], as a drop below ambient pressure.
    drop : float
        Ambient pressure less that in the cavity [Pa]; not above `strength`.
    """

    menisci: int
    rim_square: float
    volume: float
    viscosity: float
    strength: float
    drop: float

    def conductance(self, gap: float) -> float:
        """Conductance h^3/(12 eta) of the film [m3/(Pa.s)] at a gap [m]."""
        return gap * gap * gap / (12.0 * self.viscosity)

    def rim(self, gap: float, void: float) -> tuple[float, float]:
        """Square of the radius of the film [m2] at a gap [m] with a void [m3], and its slope [1/m].

        A film of a given volume reaches as far as liquid and void fill the gap, and the face.
        """
        reach = math.pi * gap
        free = (self.volume + void) / reach
        return (free, 1.0 / reach) if free < self.rim_square else (self.rim_square, 0.0)

    def tension(self, gap: float, speed: float, void: float = 0.0) -> float:
        """Tension in the centre of the full film [Pa], as a drop below ambient pressure."""
        return 0.25 * speed * self.rim(gap, void)[0] / self.conductance(gap)
