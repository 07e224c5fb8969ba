"""Equivalent stresses: von Mises, Tresca, principal stresses, interface shear.

Conventions: tension positive, z into the solid, components ordered xx, yy, zz, xy, xz, yz along
the first axis.  s1 >= s2 >= s3 are the principal stresses of the three-dimensional tensor; J2 is
half the square of its deviator.  Yield begins where sqrt(J2) is the yield stress in pure shear
(von Mises) or where (s1 - s3)/2 is (Tresca).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "interface_shear",
    "max_principal_stress",
    "principal_stresses",
    "sqrt_j2",
    "tresca",
    "von_mises",
]

Array = NDArray[np.float64]

# Points per block, so that intermediate results stay in the cache: 1024 take twice as long (calls),
# a million 1.6 times.
BLOCK = 16384


def sqrt_j2(stress: Array) -> Array:
    """Square root of the second invariant of the deviator, the shear stress of von Mises.

    ``J2 = [(xx - yy)^2 + (yy - zz)^2 + (zz - xx)^2]/6 + xy^2 + xz^2 + yz^2``

    Parameters
    ----------
    stress : ndarray, shape (6, ...)
        [Pa].

    Returns
    -------
    ndarray, shape (...)
        [Pa].

    Examples
    --------
    >>> float(sqrt_j2(np.array([0.0, 0.0, 0.0, 0.0, 2.0, 0.0])))
    2.0
    """
    xx, yy, zz, xy, xz, yz = stress
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    squared: Array = normal / 6.0 + xy * xy + xz * xz + yz * yz
    return np.sqrt(squared)


def von_mises(stress: Array) -> Array:
    """Von Mises stress, ``sqrt(3 J2)``: the uniaxial tension of equal J2.

    Parameters
    ----------
    stress : ndarray, shape (6, ...)
        [Pa].

    Returns
    -------
    ndarray, shape (...)
        [Pa].

    Examples
    --------
    >>> float(von_mises(np.array([-3.0, 0.0, 0.0, 0.0, 0.0, 0.0])).round(12))
    3.0
    """
    return math.sqrt(3.0) * sqrt_j2(stress)


def principal_stresses(stress: Array) -> Array:
    """Principal stresses s1 >= s2 >= s3.

    ``s = mean + 2 sqrt(J2/3) cos(t + 2 pi k/3)`` with ``tan 3t = sqrt(D)/(3 sqrt(3) J3)``.  The
    discriminant ``D = 4 J2^3 - 27 J3^2`` is formed as a sum of squares (the determinant of Gram of
    1, B and B^2 for the deviator B; Parlett, Linear Algebra Appl. 355, 2002, 85), so that two
    nearly equal stresses are as accurate as all others: a few units of round-off of the largest.

    Parameters
    ----------
    stress : ndarray, shape (6, ...)
        [Pa].

    Returns
    -------
    ndarray, shape (3, ...)
        In descending order [Pa].

    Examples
    --------
    >>> principal_stresses(np.array([1.0, 1.0, -2.0, 0.0, 0.0, 0.0])).round(12).tolist()
    [1.0, 1.0, -2.0]
    """
    flat = np.asarray(stress, dtype=np.float64).reshape(6, -1)
    out = np.empty((3, flat.shape[1]))
    for start in range(0, flat.shape[1], BLOCK):
        part = slice(start, start + BLOCK)
        mean, root, t = _polar(flat[:, part])
        reach = 2.0 / math.sqrt(3.0) * root
        for k, turn in enumerate((0.0, -2.0, 2.0)):
            out[k, part] = mean + reach * np.cos(t + turn * math.pi / 3.0)
    return out.reshape(3, *np.shape(stress)[1:])


def max_principal_stress(stress: Array) -> Array:
    """Maximum principal stress s1, negative where all directions are in compression.

    Parameters
    ----------
    stress : ndarray, shape (6, ...)
        [Pa].

    Returns
    -------
    ndarray, shape (...)
        [Pa].

    Examples
    --------
    >>> float(max_principal_stress(np.array([0.0, 0.0, 0.0, 0.0, 0.0, 2.0])).round(12))
    2.0
    """
    first: Array = principal_stresses(stress)[0]
    return first


def tresca(stress: Array) -> Array:
    """Maximum shear stress (Tresca), ``(s1 - s3)/2``.

    Parameters
    ----------
    stress : ndarray, shape (6, ...)
        [Pa].

    Returns
    -------
    ndarray, shape (...)
        [Pa].

    Examples
    --------
    >>> float(tresca(np.array([3.0, 1.0, -1.0, 0.0, 0.0, 0.0])).round(12))
    2.0
    """
    first, _, last = principal_stresses(stress)
    half: Array = 0.5 * (first - last)
    return half


def interface_shear(stress: Array) -> Array:
    """Resultant of the shear tractions on a plane z = const, ``sqrt(xz^2 + yz^2)``.

    Parameters
    ----------
    stress : ndarray, shape (6, ...)
        [Pa].

    Returns
    -------
    ndarray, shape (...)
        The same on both sides of an interface [Pa].

    Examples
    --------
    >>> float(interface_shear(np.array([9.0, 9.0, 9.0, 9.0, 3.0, 4.0])))
    5.0
    """
    resultant: Array = np.hypot(stress[4], stress[5])
    return resultant


def _polar(stress: Array) -> tuple[Array, Array, Array]:
    """Mean, sqrt(J2) and the angle t in [0, pi/3] of the principal stresses."""
    xx, yy, zz, xy, xz, yz = stress
    mean = (xx + yy + zz) / 3.0
    # The deviator from differences, which are exact where the normal stresses are nearly equal.
    a, b, c = (2 * xx - yy - zz) / 3.0, (2 * yy - xx - zz) / 3.0, (2 * zz - xx - yy) / 3.0
    a2, b2, c2 = a * a + xy * xy + xz * xz, b * b + xy * xy + yz * yz, c * c + xz * xz + yz * yz
    twice = math.sqrt(2.0)
    first = _five(a - b, a + b - 2.0 * c, twice * xy, twice * xz, twice * yz)
    second = _five(
        a2 - b2,
        a2 + b2 - 2.0 * c2,
        twice * ((a + b) * xy + xz * yz),
        twice * ((a + c) * xz + xy * yz),
        twice * ((b + c) * yz + xy * xz),
    )
    minors = np.zeros_like(mean)
    for i in range(5):
        for j in range(i):
            minors += (first[i] * second[j] - first[j] * second[i]) ** 2
    j3 = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz)
    t = np.arctan2(np.sqrt(3.0 * minors), 3.0 * math.sqrt(3.0) * j3) / 3.0
    root: Array = np.sqrt(0.5 * (a2 + b2 + c2))
    return mean, root, t


def _five(difference: Array, sum_: Array, *shears: Array) -> tuple[Array, ...]:
    """Coordinates of a deviator in five orthonormal directions."""
    return difference / math.sqrt(2.0), sum_ / math.sqrt(6.0), *shears
