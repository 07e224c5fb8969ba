"""Walls of an axisymmetric film: flats, a paraboloid, any profile; their rim at a given volume."""

from __future__ import annotations

import abc
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import field, frozen

from ...numerics.quadrature import gauss_legendre
from ...units import si
from ...validators import positive
from ..squeeze_film import disc_radius, sphere_film_height
from .gap_flow import positive_root

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["Flats", "Paraboloid", "Profile", "Walls"]

_PANELS = 24  # of a volume, with eight nodes each


@frozen(kw_only=True)
class Walls(abc.ABC):
    """Shape of the gap of an axisymmetric film above its gap at the axis."""

    @abc.abstractmethod
    def rise(self, radius: Array) -> Array:
        """Gap at a radius [m] less that at the axis [m]."""

    @abc.abstractmethod
    def core(self, gap: Array, rim_radius: Array) -> Array:
        """Radius [m] at which the gap has doubled, the rim at most."""

    @abc.abstractmethod
    def rim_radius(self, volume: Array, gap: Array) -> Array:
        """Radius [m] of a film of a volume [m3] and a gap at the axis [m]."""


@frozen(kw_only=True)
class Flats(Walls):
    """Parallel flats.

    Examples
    --------
    >>> round(float(Flats().rim_radius(np.pi * 1e-12, np.array(1e-6))), 9)
    0.001
    """

    def rise(self, radius: Array) -> Array:
        """See `Walls.rise`."""
        return np.zeros_like(radius)

    def core(self, gap: Array, rim_radius: Array) -> Array:
        """See `Walls.core`."""
        return rim_radius + 0.0 * gap

    def rim_radius(self, volume: Array, gap: Array) -> Array:
        """See `Walls.rim_radius`."""
        return np.asarray(disc_radius(volume, gap))


@frozen(kw_only=True)
class Paraboloid(Walls):
    """A sphere of a radius R [m] near a flat, or two of this reduced radius: r^2/(2 R).

    Examples
    --------
    >>> walls, gap = Paraboloid(radius=1e-3), np.array(1e-6)
    >>> rim = walls.rim_radius(np.array(1e-15), gap)
    >>> volume = np.pi * rim**2 * (gap + 0.5 * walls.rise(rim))
    >>> round(float(volume) / 1e-15, 12)
    1.0
    """

    radius: float = field(validator=positive, metadata=si("m"))

    def rise(self, radius: Array) -> Array:
        """See `Walls.rise`."""
        return radius * radius / (2.0 * self.radius)

    def core(self, gap: Array, rim_radius: Array) -> Array:
        """See `Walls.core`."""
        core: Array = np.minimum(np.sqrt(2.0 * self.radius * gap), rim_radius)
        return core

    def rim_radius(self, volume: Array, gap: Array) -> Array:
        """See `Walls.rim_radius`; without the cancellation of H - D."""
        height = sphere_film_height(gap, volume, self.radius)
        rim: Array = np.sqrt(2.0 * volume / (math.pi * (height + gap)))
        return rim


@frozen(kw_only=True)
class Profile(Walls):
    """Any profile that rises from the axis outwards.

    Parameters
    ----------
    height : callable
        Gap at an array of radii [m] less that at the axis [m]; smooth over the logarithm of the
        radius, for the error that is stated with a force.

    Examples
    --------
    >>> cone = Profile(height=lambda radius: 0.01 * radius)
    >>> rim = float(cone.rim_radius(np.array(1e-12), np.array(1e-6)))
    >>> round((np.pi * rim**2 * 1e-6 + 2.0 * np.pi * 0.01 * rim**3 / 3.0) / 1e-12, 9)
    1.0
    """

    height: Callable[[Array], Array]

    def rise(self, radius: Array) -> Array:
        """See `Walls.rise`."""
        return np.asarray(self.height(radius))

    def core(self, gap: Array, rim_radius: Array) -> Array:
        """See `Walls.core`; to a factor of 1.1, by halving in the logarithm."""
        gap, high = (np.array(one, dtype=float) for one in np.broadcast_arrays(gap, rim_radius))
        low = 1e-12 * high
        wide = self.rise(high) <= gap
        rim = high.copy()
        for _ in range(9):  # halves 28 logarithms of the radius to 0.05
            middle = np.sqrt(low * high)
            below = self.rise(middle) < gap
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        return np.where(wide, rim, high)

    def rim_radius(self, volume: Array, gap: Array) -> Array:
        """See `Walls.rim_radius`; to 1e-9 of smooth profiles."""
        target, height = (np.array(one, dtype=float) for one in np.broadcast_arrays(volume, gap))

        def residual(radius: Array) -> tuple[Array, Array]:
            held = self._volume(radius, height)
            at_rim = 2.0 * math.pi * radius**2 * (height + self.rise(radius))
            return np.log(target / held), at_rim / held

        return positive_root(residual, np.asarray(disc_radius(target, height)))

    def _volume(self, radius: Array, gap: Array) -> Array:
        """Volume within a radius [m3], by panels of the logarithm of the radius."""
        nodes, weights = (np.array(one) for one in gauss_legendre(8))
        total = np.zeros_like(radius)
        for panel in range(_PANELS):
            for node, weight in zip(nodes, weights, strict=True):
                r = radius * math.exp(-float(panel + node))
                total += weight * 2.0 * math.pi * r * r * (gap + self.rise(r))
        return total
