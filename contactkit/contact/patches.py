"""Contact patches: the connected spots of a contact, and the distribution of their sizes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from ..capillary.film_islands import islands
from ..errors import DescriptionError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scene.window import Edges
    from .result import ContactResult

    Map = NDArray[np.float64]

__all__ = ["ContactPatches", "PatchDensity", "contact_patches", "patch_density", "patches_of"]


class ContactPatches(NamedTuple):
    """Connected spots of a contact, and their areas."""

    areas: Map
    """Areas of the patches of at least `fewest_pixels` pixels, the largest first [m2]."""
    labels: NDArray[np.int64]
    """Number of the patch of each pixel, of all patches, from 1; 0 out of contact (ny, nx)."""
    n_small: int
    """How many smaller patches there are, which are properties of the grid."""
    small_area: float
    """Their area together [m2]."""
    connectivity: int
    """4 if pixels of a patch share an edge, 8 if a corner is enough."""
    fewest_pixels: int
    """Number of pixels from which on a patch is counted."""
    window_area: float
    """Area of the window [m2]."""

    @property
    def number(self) -> int:
        """Number of patches in `areas`."""
        return int(self.areas.size)

    @property
    def mean_area(self) -> float | None:
        """Number-weighted mean area [m2]; None without patches."""
        return float(self.areas.mean()) if self.areas.size else None

    @property
    def area_weighted_mean(self) -> float | None:
        """Area-weighted mean area [m2]: of the patch in which a point of contact lies."""
        if not self.areas.size:
            return None
        return float((self.areas * self.areas).sum() / self.areas.sum())


class PatchDensity(NamedTuple):
    """Number density of the areas of patches."""

    area: Map
    """Geometric middle of each class of areas [m2]."""
    density: Map
    """Patches per area of the window and per area of the patch [1/m4]."""
    number: NDArray[np.int64]
    """Patches in each class; the relative scatter of `density` is one over its root."""


def contact_patches(
    result: ContactResult, connectivity: Literal[4, 8] = 8, fewest_pixels: int = 4
) -> ContactPatches:
    r"""Connected spots of a solved contact, across the edges beyond which its window repeats.

    Parameters
    ----------
    result : ContactResult
        A solved contact; contact is where the pressure is not zero.
    connectivity : {4, 8}
        8: pixels with a common corner belong to one patch; 4: only those with a common edge.
    fewest_pixels : int
        Smaller patches are counted apart: their number is that of the grid, and would dominate
        every mean over the number.

    Raises
    ------
    DescriptionError
        If `connectivity` or `fewest_pixels` is impossible.

    Notes
    -----
    Areas are pixel counts, too large by the excess that `ContactResult.corrected_contact_area`
    takes off, most of all those of small patches. Of a self-affine surface cut by a plane the
    density of areas falls as :math:`A^{-\tau}`, tau = 2 - H/2 (Hurst exponent H), between the
    square of the shortest wave and the largest patch; means depend on these two ends.

    Examples
    --------
    >>> import contactkit as ck
    >>> x = 2.0 * np.pi * np.arange(32) / 32
    >>> heights = 1e-9 * (np.cos(x)[:, None] + np.cos(2.0 * x)[None, :])
    >>> rubber = ck.Material(young_modulus=1e7, poisson_ratio=0.49)
    >>> found = contact_patches(ck.press(heights, 1e-8, rubber, mean_pressure=2e4))
    >>> found.number, found.n_small
    (2, 0)
    """
    grid = result.plan.grid
    return patches_of(result.contact, grid.pixel_size, grid.edges, connectivity, fewest_pixels)


def patches_of(
    touching: NDArray[np.bool_],
    pixel_size: tuple[float, float],
    periodic: Edges,
    connectivity: Literal[4, 8] = 8,
    fewest_pixels: int = 4,
) -> ContactPatches:
    """Connected spots of a map of pixels in contact, or of pixels above a bearing plane.

    Parameters
    ----------
    touching : ndarray of bool (ny, nx)
        Pixels in contact.
    pixel_size : (float, float)
        Size of a pixel (dy, dx) [m].
    periodic : bool, "x" or "y"
        Whether spots continue across the edges: all of them, or along one axis alone.
    connectivity, fewest_pixels
        As in `contact_patches`.

    Raises
    ------
    DescriptionError
        If `connectivity` or `fewest_pixels` is impossible.

    Examples
    --------
    >>> corner = np.array([[True, False], [False, True]])
    >>> [patches_of(corner, (1.0, 1.0), False, n, 1).areas.tolist() for n in (4, 8)]
    [[1.0, 1.0], [2.0]]
    """
    if connectivity not in (4, 8):
        raise DescriptionError("patches.connectivity", connectivity, "be 4 or 8")
    if isinstance(fewest_pixels, bool) or not isinstance(fewest_pixels, int) or fewest_pixels < 1:
        raise DescriptionError(
            "patches.fewest_pixels", fewest_pixels, "be a whole number of at least 1"
        )
    names, n = islands(touching, periodic, connectivity)
    pixels = np.sort(np.bincount(names.ravel(), minlength=n + 1)[1:])[::-1]
    is_small = pixels < fewest_pixels
    one = pixel_size[0] * pixel_size[1]
    return ContactPatches(
        areas=np.asarray(pixels[~is_small] * one, dtype=np.float64),
        labels=names,
        n_small=int(is_small.sum()),
        small_area=float(pixels[is_small].sum()) * one,
        connectivity=connectivity,
        fewest_pixels=fewest_pixels,
        window_area=names.size * one,
    )


def patch_density(patches: ContactPatches, per_decade: int = 5) -> PatchDensity:
    """Number density of the areas of patches, in classes of equal width on a logarithmic scale.

    Parameters
    ----------
    patches : ContactPatches
        Those of `contact_patches`.
    per_decade : int
        Classes per decade of area; empty ones are left out.

    Raises
    ------
    DescriptionError
        If `per_decade` is not a whole number of at least 1.

    Examples
    --------
    >>> spots = np.kron(np.eye(4), np.ones((2, 2))) > 0.0
    >>> found = patch_density(patches_of(spots, (1.0, 1.0), False, 4))
    >>> found.number.tolist()
    [4]
    """
    if isinstance(per_decade, bool) or not isinstance(per_decade, int) or per_decade < 1:
        raise DescriptionError(
            "patch_density.per_decade", per_decade, "be a whole number of at least 1"
        )
    if not patches.areas.size:
        return PatchDensity(np.zeros(0), np.zeros(0), np.zeros(0, dtype=np.int64))
    place = np.log10(patches.areas) * per_decade
    first, last = math.floor(float(place.min())), math.floor(float(place.max())) + 1
    number = np.bincount(np.floor(place).astype(np.int64) - first, minlength=last - first)
    edges = 10.0 ** (np.arange(first, last + 1) / per_decade)
    has = number > 0
    density = number / (np.diff(edges) * patches.window_area)
    middle = np.sqrt(edges[1:] * edges[:-1])
    return PatchDensity(middle[has], density[has], number[has].astype(np.int64))
