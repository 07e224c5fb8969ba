"""The summits of a rough surface as a population of spheres."""

from __future__ import annotations

from attrs import field, frozen

from ..units import si
from ..validators import Described, count, non_negative, optional, positive

__all__ = ["AsperityPopulation"]


@frozen(kw_only=True)
class AsperityPopulation(Described):
    """Spherical summits of one radius on a flat face, of one height or of normal heights.

    Parameters
    ----------
    density : float
        Number of summits per area of the face [1/m2].
    radius : float
        Radius of curvature of a summit [m].
    rms_height : float
        Standard deviation of the heights of the summits about their mean plane [m]; 0: all are
        equally high. That of the surface is larger, and its mean plane lies below.
    count : int, optional
        Number of summits in all [-]. None: they cover the face, as many as `density` times its
        area. `split` sets it.

    Notes
    -----
    The three numbers depend on the shortest wave that a measurement resolves: a finer pixel has
    more and sharper summits. Say where they come from.

    Examples
    --------
    >>> round(AsperityPopulation(density=1e14, radius=1e-6).spacing * 1e9, 6)
    100.0
    """

    density: float = field(validator=positive, metadata=si("1/m2"))
    radius: float = field(validator=positive, metadata=si("m"))
    rms_height: float = field(default=0.0, validator=non_negative, metadata=si("m"))

    count: int | None = field(default=None, validator=optional(count), metadata=si("-"))

    def counted_area(self, face: float) -> float:
        """Area [m2] that bears the summits of a face of an area [m2]: that of `count`, if given.

        Examples
        --------
        >>> everywhere = AsperityPopulation(density=1e14, radius=1e-6)
        >>> everywhere.counted_area(1e-10)
        1e-10
        >>> round(AsperityPopulation.split(radius=1e-6, count=9).counted_area(1e-10) * 1e12, 9)
        4.0
        """
        return face if self.count is None else self.count / self.density

    @property
    def spacing(self) -> float:
        """Side of the square that a summit has on average [m]."""
        return float(self.density**-0.5)

    @classmethod
    def split(cls, *, radius: float, count: int) -> AsperityPopulation:
        r"""Equal summits, n x n = `count`, side by side in place of one sphere of a radius R [m].

        .. math:: R' = R/n, \qquad \text{one to each square of side } 2R/n

        Eq. (3.14). They are `count` on any face, as they stand for one sphere: over (2R)^2, not
        over the round face of radius R, which has 21 % less. Their menisci stay apart up to
        n = R/(2 (s - D)) only, with the height s of the film and the gap D: see the coverage in
        the results.

        Examples
        --------
        >>> AsperityPopulation.split(radius=50e-6, count=100).radius
        5e-06
        """
        side = count**0.5
        return cls(density=count / (2.0 * radius) ** 2, radius=radius / side, count=count)
