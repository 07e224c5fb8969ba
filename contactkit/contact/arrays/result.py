"""Result of pressing maps: arrays of the namespace and on the device of the heights."""

from __future__ import annotations

from typing import Any

from attrs import field, frozen

from ...validity import ValidityNumber

__all__ = ["MapsResult"]


@frozen(eq=False, kw_only=True)
class MapsResult:
    """Contacts of maps; numbers of a map have the leading axes of the heights, ``(...)``.

    Attributes
    ----------
    heights, pressure, displacement : array (..., ny, nx)
        As given [m]; pressure [Pa]; displacement of the surface into the solid [m].
    rigid_approach : array (...)
        Rigid-body approach of the zero plane of the heights [m].
    kkt : array (...)
        Largest violation of a contact condition, relative to the rms height or the largest
        displacement, whichever is smaller [-]: as of `ck.press`.
    converged : array (...) of bool
        Whether `kkt` is at most the tolerance.
    n_applications : array (...)
        Applications of the operator on the full grid.
    validity : tuple of ValidityNumber
        Slope, peak pressure and jump at the edges that repeat, of the worst map.
    """

    heights: Any = field(repr=False)
    pressure: Any = field(repr=False)
    displacement: Any = field(repr=False)
    rigid_approach: Any
    kkt: Any
    converged: Any
    n_applications: Any
    validity: tuple[ValidityNumber, ...] = field(default=(), repr=False)

    @property
    def _xp(self) -> Any:
        from .namespace import space_of

        return space_of(self.pressure).xp

    @property
    def gap(self) -> Any:
        """Gap of the surfaces [m], (..., ny, nx)."""
        return self.displacement - self.heights - self.rigid_approach[..., None, None]

    @property
    def mean_pressure(self) -> Any:
        """Mean pressure over each map [Pa], (...)."""
        return self._xp.mean(self.pressure, axis=(-2, -1))

    @property
    def contact_fraction(self) -> Any:
        """Pixels that carry pressure over all pixels of each map [-], (...)."""
        xp = self._xp
        return xp.mean(xp.astype(self.pressure > 0.0, self.pressure.dtype), axis=(-2, -1))
