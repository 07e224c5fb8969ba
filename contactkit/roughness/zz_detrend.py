"""What is taken off a measured map before it is called roughness: mean, tilt, curvature."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

__all__ = ["Trend", "detrended"]

Array = NDArray[np.float64]
Trend = Literal["none", "mean", "tilt", "curvature"]


def detrended(heights: Array, trend: Trend = "tilt") -> Array:
    r"""Heights without the polynomial that fits them best, by least squares over all pixels.

    Parameters
    ----------
    heights : ndarray (ny, nx)
        Heights, any unit.
    trend : {"tilt", "none", "mean", "curvature"}
        The polynomial in x and y: nothing, a constant, of degree 1, or of degree 2.

    Returns
    -------
    ndarray (ny, nx)
        A new array.

    Notes
    -----
    Rough surfaces have waves longer than any window, of which this takes part: a tilt takes about
    the share of the variance that lies in waves longer than the window.

    Examples
    --------
    >>> y, x = np.mgrid[:3.0, :4.0]
    >>> abs(detrended(1.0 + 2.0 * x - y)).max() < 1e-14, detrended(x * x, "tilt").round(12)[0]
    (np.True_, array([ 1., -1., -1.,  1.]))
    """
    left = np.array(heights, dtype=np.float64)
    if trend == "none":
        return left
    left -= left.mean()
    if trend == "mean":
        return left
    y, x = (_centred(np.linspace(-1.0, 1.0, n) if n > 1 else np.zeros(1)) for n in left.shape)
    shapes = [(y, np.ones_like(x)), (np.ones_like(y), x)]
    if trend == "curvature":
        # On a full grid these are orthogonal to each other and to all above.
        shapes += [(_centred(y * y), np.ones_like(x)), (np.ones_like(y), _centred(x * x)), (y, x)]
    for of_y, of_x in shapes:
        square = float(of_y @ of_y) * float(of_x @ of_x)
        if square > 1e-12:  # a grid of one or two pixels holds no tilt or no curvature
            left -= (of_y @ left @ of_x / square * of_y)[:, None] * of_x
    return left


def _centred(values: Array) -> Array:
    return np.asarray(values - values.mean())
