"""The surfaces a liquid film lies between."""

from __future__ import annotations

from attrs import field, frozen

from ..units import si
from ..validators import optional, positive

__all__ = ["Flat", "Sphere", "Surface"]


@frozen(kw_only=True)
class Flat:
    """A flat face, round and bounded, or without end.

    Parameters
    ----------
    radius : float, optional
        Radius of the face [m]; the film cannot spread beyond it. None: no rim within reach.

    Examples
    --------
    >>> Flat(radius=3.175e-3).curvature
    0.0
    """

    radius: float | None = field(default=None, validator=optional(positive), metadata=si("m"))

    @property
    def curvature(self) -> float:
        """Curvature of the surface [1/m]: none."""
        return 0.0


@frozen(kw_only=True)
class Sphere:
    """A sphere, or a body whose apex is round.

    Parameters
    ----------
    radius : float
        Radius of curvature at the apex [m].

    Examples
    --------
    >>> Sphere(radius=100e-9).curvature
    10000000.0
    """

    radius: float = field(validator=positive, metadata=si("m"))

    @property
    def curvature(self) -> float:
        """Curvature of the surface [1/m], positive for a body that bulges into the gap."""
        return 1.0 / self.radius


Surface = Flat | Sphere
