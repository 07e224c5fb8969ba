"""Linear systems of three equations, for the stages of a step: plain floats, as in an FMU."""

from __future__ import annotations

import math

__all__ = ["Three", "solved_three"]

Three = tuple[float, float, float]


def solved_three(a: Three, b: Three, c: Three, right: Three) -> Three | None:
    """Solution by Cramer's rule; None if the matrix is singular or a number is not finite.

    Parameters
    ----------
    a, b, c : tuple of 3 floats
        Rows of the matrix.
    right : tuple of 3 floats
        Right-hand side.

    Examples
    --------
    >>> solved_three((2.0, 0.0, 0.0), (0.0, 4.0, 0.0), (0.0, 1.0, 1.0), (2.0, 2.0, 1.0))
    (1.0, 0.5, 0.5)
    """
    (a0, a1, a2), (b0, b1, b2), (c0, c1, c2), (x, y, z) = a, b, c, right
    m0, m1, m2 = b1 * c2 - b2 * c1, b2 * c0 - b0 * c2, b0 * c1 - b1 * c0
    det = a0 * m0 + a1 * m1 + a2 * m2
    if det == 0.0 or not math.isfinite(det):
        return None
    i, j, k = (
        (x * m0 + a1 * (b2 * z - y * c2) + a2 * (y * c1 - b1 * z)) / det,
        (a0 * (y * c2 - b2 * z) + x * m1 + a2 * (b0 * z - y * c0)) / det,
        (a0 * (b1 * z - y * c1) + a1 * (y * c0 - b0 * z) + x * m2) / det,
    )
    return (i, j, k) if math.isfinite(i + j + k) else None
