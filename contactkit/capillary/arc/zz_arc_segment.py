r"""Area and first moment of a circular segment, over powers of its chord, to full precision.

With half of the angle that the arc turns by, :math:`\delta`, positive where it bulges:

.. math::
    a = \frac{\delta - \sin\delta\cos\delta}{4\sin^2\delta}, \qquad
    m = \frac{1}{12} - \frac{a}{2}\cot\delta

The moment is about the chord. Both closed forms cancel as the arc turns straight; the moment
then matters most, since a slender bridge multiplies it by the cube of its height.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Segment", "segment"]

Array = NDArray[np.float64]

_SERIES = 0.25  # below this the nine terms leave less than rounding
_MOMENT = (
    1 / 60, 1 / 252, 1 / 1350, 1 / 8316, 691 / 38697750, 1 / 400950, 3617 / 10854718875,
    43867 / 1019066548500, 174611 / 32238515058750,
)  # fmt: skip


class Segment(NamedTuple):
    """Area over chord squared, moment over chord cubed, and their slopes by the half angle."""

    area: Array
    moment: Array
    d_area: Array
    d_moment: Array


def segment(half: Array) -> Segment:
    """Segment of an arc that turns by twice `half` [rad], between -pi and pi.

    Examples
    --------
    >>> right = segment(np.array([np.pi / 2]))  # half a disc on its diameter
    >>> round(float(right.area[0] * 8.0 / np.pi), 14), round(float(right.moment[0] * 12.0), 14)
    (1.0, 1.0)
    """
    squared = half**2
    tail = np.zeros_like(half)
    for k in range(12, 0, -1):  # (z - sin z) / z^3 at z = 2 half
        tail = (1.0 - 4.0 * squared * tail) / (2.0 * k * (2.0 * k + 1.0))
    near, slope = np.zeros_like(half), np.zeros_like(half)
    for k in range(len(_MOMENT), 0, -1):
        near = squared * (near + _MOMENT[k - 1])
        slope = squared * slope + 2.0 * k * _MOMENT[k - 1]
    straight, small = half == 0.0, abs(half) < _SERIES
    sine = np.where(straight, 1.0, np.sin(half))
    cosine = np.where(straight, 0.0, np.cos(half))
    cotangent = cosine / sine
    ratio = np.where(straight, 1.0, half / sine)
    far = 0.25 * (ratio - cosine) / sine
    area = np.where(squared < 1.0, half * ratio**2 * tail, far)
    moment = np.where(small, near, 1.0 / 12.0 - 0.5 * area * cotangent)
    d_area = np.where(straight, 1.0 / 6.0, 0.5 - 2.0 * area * cotangent)
    d_far = 0.5 * area + cotangent * (1.5 * area * cotangent - 0.25)
    return Segment(area, moment, d_area, np.where(small, half * slope, d_far))
