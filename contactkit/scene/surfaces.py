"""Smooth surfaces (flat, sphere, paraboloid, wave), and the base class of all surfaces."""

from __future__ import annotations

import abc
from typing import ClassVar

from attrs import field, frozen

from ..units import si
from ..validators import Described, optional, positive

__all__ = ["Flat", "Paraboloid", "Sphere", "Surface", "Wave"]


@frozen(kw_only=True)
class Surface(Described, abc.ABC):
    """The surface of a body, smooth or rough. Its kind is its name in files, under ``shape``."""

    kind: ClassVar[str]

    @property
    @abc.abstractmethod
    def curvature(self) -> float | None:
        """Curvature at the apex [1/m], positive towards the gap; None without one round apex."""


@frozen(kw_only=True)
class Flat(Surface):
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

    kind: ClassVar[str] = "flat"

    radius: float | None = field(default=None, validator=optional(positive), metadata=si("m"))

    @property
    def curvature(self) -> float:
        """See `Surface.curvature`."""
        return 0.0


@frozen(kw_only=True)
class Sphere(Surface):
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

    kind: ClassVar[str] = "sphere"

    radius: float = field(validator=positive, metadata=si("m"))

    @property
    def curvature(self) -> float:
        """See `Surface.curvature`."""
        return 1.0 / self.radius


@frozen(kw_only=True)
class Paraboloid(Surface):
    """The body of Hertz's theory, ``-x^2/(2 R_x) - y^2/(2 R_y)``.

    Parameters
    ----------
    radius : float
        Radius of curvature at the apex along x [m].
    radius_y : float, optional
        The same along y [m]; None: as along x.
    """

    kind: ClassVar[str] = "paraboloid"

    radius: float = field(validator=positive, metadata=si("m"))
    radius_y: float | None = field(default=None, validator=optional(positive), metadata=si("m"))

    @property
    def curvature(self) -> float | None:
        """See `Surface.curvature`."""
        is_round = self.radius_y in (None, self.radius)
        return 1.0 / self.radius if is_round else None


@frozen(kw_only=True)
class Wave(Surface):
    """A wavy surface ``amplitude*cos(2 pi x/wavelength)``, or the product of two such waves.

    Parameters
    ----------
    amplitude : float
        Half of the height between trough and crest [m].
    wavelength : float
        Length of the wave along x [m].
    wavelength_y : float, optional
        Length of the wave along y [m]; the heights are then the product of both cosines.
    """

    kind: ClassVar[str] = "wave"

    amplitude: float = field(validator=positive, metadata=si("m"))
    wavelength: float = field(validator=positive, metadata=si("m"))
    wavelength_y: float | None = field(default=None, validator=optional(positive), metadata=si("m"))

    @property
    def curvature(self) -> None:
        """See `Surface.curvature`."""
        return None
