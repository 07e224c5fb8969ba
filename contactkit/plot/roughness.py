"""Figures of rough surfaces: area over load beside theories, spectra, bearing curve, patches."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..analyses.area_over_load import AreaOverLoad
from ..analyses.heights import SurfaceHeights
from ..contact.patches import ContactPatches, patch_density
from ..roughness.contact_theories import in_range
from ..roughness.spectra import Spectrum
from ..roughness.statistics import BearingCurve
from .axis_units import axis_unit
from .style import Axes, figure, legend, title

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "area_and_theories",
    "bearing",
    "height_map",
    "heights_map",
    "patch_sizes",
    "power_spectrum",
]

_THEORIES = {  # the later ones lie on top
    "fit of slope 2": "#2a9d8f",
    "Persson": "#1f4e79",
    "Bush, Gibson and Thomas": "#c1440e",
    "Greenwood and Williamson": "#6a4c93",
}


def area_and_theories(found: AreaOverLoad, axes: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw the area of solved contacts over the load beside the theories, and their ranges.

    Left the fraction of area over the load, right their ratio, which spreads the theories out. A
    theory is drawn as a thick line in its range (`AreaOverLoad.ranges`), dotted outside, up to 1.

    Parameters
    ----------
    found : AreaOverLoad
        Solved contacts of one surface.
    axes : sequence of two Axes, optional
        Where to draw; a new figure if not given.
    """
    left, right = axes if axes is not None else figure(1, 2, size=(11.0, 4.8))[1]
    solved = found.reduced_pressure
    p = np.geomspace(min(0.5 * float(solved.min()), 2e-3), max(1.5 * float(solved.max()), 1.5), 400)
    theories = found.fractions_at(p)
    for name in (one for one in _THEORIES if one in theories):
        fraction, (low, high, _) = theories[name], found.ranges[name]
        label, inside = f"{name}, {_range(low, high)}", in_range(name, fraction)
        for ax, scale in ((left, 1.0), (right, p)):
            ax.plot(p, fraction / scale, ":", color=_THEORIES[name], lw=1.2)
            ax.plot(p, inside / scale, color=_THEORIES[name], lw=3.2, alpha=0.85, label=label)
    for ax, scale in ((left, 1.0), (right, solved)):
        ax.plot(solved, found.corrected / scale, "ko", ms=4.5, label="solved, edge-corrected")
        ax.plot(solved, found.counted / scale, "k+", ms=6.0, label="solved, pixel count")
        ax.set(xscale="log", xlabel="mean pressure over E* h' [-]")
    left.set(yscale="log", ylabel="fraction of area in contact [-]", ylim=(2e-3, 1.5))
    right.set(ylabel="fraction of area / (mean pressure over E* h') [-]", ylim=(0.0, None))
    title(left, "Area over load")
    title(right, "Its ratio to the load")
    legend(right, loc="lower left", fontsize=8.5)
    return left, right


def _range(low: float, high: float) -> str:
    if low <= 0.0:
        return f"area < {100.0 * high:g} %"
    return f"area > {100.0 * low:g} %" if high >= 1.0 else f"{100.0 * low:g} to {100.0 * high:g} %"


def power_spectrum(
    spectra: Sequence[tuple[str, Spectrum]], ax: Axes | None = None, unit: str = "m4"
) -> Axes:
    """Draw power spectral densities over the wavenumber, both logarithmic.

    Parameters
    ----------
    spectra : sequence of (label, Spectrum)
        One for each line.
    ax : Axes, optional
        Where to draw.
    unit : str
        Unit of the densities: ``m4`` of maps, ``m3`` of profiles.
    """
    ax = ax if ax is not None else figure()[1]
    for label, one in spectra:
        shown = (one.wavenumber > 0.0) & (one.density > 1e-12 * one.density.max(initial=0.0))
        ax.plot(one.wavenumber[shown], one.density[shown], label=label)
    ax.set(xscale="log", yscale="log", xlabel="wavenumber [rad/m]", ylabel=f"density [{unit}]")
    legend(ax)
    return ax


def height_map(found: SurfaceHeights, ax: Axes | None = None, limit: float | None = None) -> Axes:
    """Draw heights as a map with a colour bar, white at the mean.

    Parameters
    ----------
    found : SurfaceHeights
        Heights, see `analyses.heights.surface_heights`.
    ax : Axes, optional
        Where to draw.
    limit : float, optional
        Height [m] of the ends of the colour bar, above and below the mean; the largest deviation
        if not given.
    """
    return heights_map(found.heights, found.pixel_size, ax, limit)


def heights_map(
    heights: NDArray[np.float64],
    pixel_size: tuple[float, float],
    ax: Axes | None = None,
    limit: float | None = None,
) -> Axes:
    """Draw heights (ny, nx) [m] on pixels (dy, dx) [m]; see `height_map`."""
    ax = ax if ax is not None else figure()[1]
    (ny, nx), (dy, dx) = heights.shape, pixel_size
    length, unit = axis_unit(max(nx * dx, ny * dy), "m")
    deviation = heights - heights.mean()
    limit = limit if limit is not None else float(np.abs(deviation).max())
    factor, name = axis_unit(limit, "m")
    image = ax.imshow(
        deviation / factor,
        origin="lower",
        extent=(0.0, nx * dx / length, 0.0, ny * dy / length),
        cmap="PuOr_r",
        vmin=-limit / factor,
        vmax=limit / factor,
        interpolation="nearest",
    )
    ax.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]", aspect="equal")
    ax.grid(visible=False)
    ax.figure.colorbar(image, ax=ax, shrink=0.6).set_label(f"height [{name}]")
    return ax


def bearing(curve: BearingCurve, ax: Axes | None = None) -> Axes:
    """Draw the Abbott-Firestone curve: height over the fraction of the map above it."""
    ax = ax if ax is not None else figure()[1]
    factor, unit = axis_unit(float(np.ptp(curve.height)), "m")
    ax.plot(100.0 * curve.fraction, curve.height / factor)
    ax.set(xlabel="fraction at or above [%]", ylabel=f"height [{unit}]", xlim=(0.0, 100.0))
    return ax


def patch_sizes(patches: ContactPatches, ax: Axes | None = None) -> Axes:
    """Draw the number density of contact patches over their area, and both mean areas."""
    ax = ax if ax is not None else figure()[1]
    found = patch_density(patches)
    spread = _scatter(found.density, found.number)
    ax.errorbar(found.area, found.density, yerr=spread, fmt="o", label="patches")
    for label, mean, style in (
        ("number-weighted mean", patches.mean_area, "--"),
        ("area-weighted mean", patches.area_weighted_mean, ":"),
    ):
        if mean is not None:
            ax.axvline(mean, ls=style, color="k", lw=1.0, label=label)
    ax.set(xscale="log", yscale="log", xlabel="area of a patch [m2]", ylabel="density [1/m4]")
    legend(ax)
    return ax


def _scatter(density: NDArray[np.float64], number: NDArray[np.int64]) -> NDArray[np.float64]:
    """Standard deviations of counts [1/m4], below the value so that a logarithm shows them."""
    return np.asarray(density * np.minimum(1.0 / np.sqrt(number), 0.9))
