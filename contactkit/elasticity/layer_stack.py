"""Validated materials of a layered solid, and its compliance at long wavelengths.

Conventions as in `layered`: arrays from the top layer to the substrate, which has no thickness, or
to the lowest layer where a rigid base carries them; displacements into the solid and pressures on
it are positive.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import DescriptionError

__all__ = [
    "BASES",
    "Base",
    "Layers",
    "Stack",
    "small_wavenumber_constant",
    "stack_of",
    "uniform_compliance",
]

Array = NDArray[np.float64]
Base = Literal["bonded", "frictionless"]
BASES: tuple[Base, ...] = ("bonded", "frictionless")


class Layers(NamedTuple):
    """Materials of a layered solid, the top layer first, the substrate last.

    Young's moduli [Pa] and Poisson's ratios, (n_layers + 1,), and thicknesses [m], (n_layers,).
    On a rigid `base`, to which they are "bonded" or on which they slide "frictionless", there is
    no substrate: all are (n_layers,).
    """

    young_modulus: ArrayLike
    poisson_ratio: ArrayLike
    thickness: ArrayLike = ()
    base: Base | None = None


class Stack(NamedTuple):
    """Validated shear moduli [Pa], Poisson's ratios and thicknesses [m], top first; the base."""

    G: Array
    nu: Array
    h: Array
    base: Base | None = None


def stack_of(
    young_modulus: ArrayLike,
    poisson_ratio: ArrayLike,
    thickness: ArrayLike,
    base: Base | None = None,
) -> Stack:
    """Validate a layered solid.

    Parameters
    ----------
    young_modulus, poisson_ratio : array_like, shape (n_layers + 1,)
        From the top layer to the substrate [Pa], [1]; (n_layers,) on a rigid base.
    thickness : array_like, shape (n_layers,)
        Of the layers [m].
    base : {"bonded", "frictionless"}, optional
        How the lowest layer rests on a rigid base, which has no material; None: a substrate
        without end carries the layers.

    Returns
    -------
    Stack
        Shear moduli, Poisson's ratios and thicknesses as arrays.

    Raises
    ------
    DescriptionError
        For inconsistent shapes, a modulus or thickness that is not positive and finite, or a
        Poisson's ratio outside (-1, 1/2].

    Examples
    --------
    >>> stack_of([2.5, 1.0], [0.25, 0.5], [1.0]).G.round(6).tolist()
    [1.0, 0.333333]
    """
    E, nu, h = (np.asarray(v, dtype=np.float64) for v in (young_modulus, poisson_ratio, thickness))
    if base is not None:
        _check_base(base, E, nu, h)
    elif E.ndim != 1 or nu.shape != E.shape or h.shape != (E.size - 1,):
        raise DescriptionError(
            "layers.shape",
            (E.shape, nu.shape, h.shape),
            "be (n+1,), (n+1,) and (n,) for young_modulus, poisson_ratio and thickness",
            hint="the substrate comes last and has no thickness",
        )
    for name, values, unit in (("young_modulus", E, "Pa"), ("thickness", h, "m")):
        if not np.all((values > 0.0) & np.isfinite(values)):
            raise DescriptionError(
                f"layers.{name}", values.tolist(), "be positive and finite", unit=unit
            )
    if not np.all((nu > -1.0) & (nu <= 0.5)):
        raise DescriptionError("layers.poisson_ratio", nu.tolist(), "lie in (-1, 0.5]")
    return Stack(E / (2.0 * (1.0 + nu)), nu, h, base)


def _check_base(base: Base, E: Array, nu: Array, h: Array) -> None:
    if base not in BASES:
        raise DescriptionError("layers.base", base, f"be None or one of {', '.join(BASES)}")
    if E.ndim != 1 or not E.size or nu.shape != E.shape or h.shape != E.shape:
        raise DescriptionError(
            "layers.shape",
            (E.shape, nu.shape, h.shape),
            "be (n,) for young_modulus, poisson_ratio and thickness, n >= 1",
            hint="on a rigid base every layer has a thickness, and there is no substrate",
        )


def small_wavenumber_constant(
    young_modulus: ArrayLike, poisson_ratio: ArrayLike, thickness: ArrayLike
) -> float:
    """Constant c0 of ``C(alpha) = 2 (1 - nu_s^2)/(E_s alpha) + c0 + O(alpha)`` for long waves.

    ``c0 = sum h_j (chi_j - chi_s)(1 + 2 G_j chi_s)/(1 - nu_j)`` with ``chi = (1 - 2 nu)/(2 G)``:
    exactly zero where a layer is of the substrate's material.

    Parameters
    ----------
    young_modulus, poisson_ratio, thickness : array_like
        As in `stack_of`.

    Returns
    -------
    float
        c0, of either sign [m/Pa].

    Raises
    ------
    DescriptionError
        As `stack_of`.

    Examples
    --------
    >>> small_wavenumber_constant([1e9, 1e9], [0.3, 0.3], [1e-9])
    0.0
    """
    G, nu, h, _ = stack_of(young_modulus, poisson_ratio, thickness)
    chi = (1.0 - 2.0 * nu) / (2.0 * G)
    excess = chi[:-1] - chi[-1]
    return float(np.sum(h * excess * (1.0 + 2.0 * G[:-1] * chi[-1]) / (1.0 - nu[:-1])))


def uniform_compliance(
    young_modulus: ArrayLike,
    poisson_ratio: ArrayLike,
    thickness: ArrayLike,
    base: Base | None = None,
) -> float:
    """Compliance of the layers in uniaxial strain under a uniform pressure.

    ``sum h_j (1 + nu_j)(1 - 2 nu_j)/(E_j (1 - nu_j))``, without the substrate, whose compression
    is unbounded.  It is the compliance at wavenumber 0, not the limit of `layered.compliance` for
    long waves (which it is on a bonded base alone).  It is zero where all layers are
    incompressible: their mean thickness cannot change.

    Parameters
    ----------
    young_modulus, poisson_ratio, thickness, base
        As in `stack_of`; bonded and frictionless bases are alike here.

    Returns
    -------
    float
        Thinning of all layers together per unit pressure [m/Pa].

    Raises
    ------
    DescriptionError
        As `stack_of`.

    Examples
    --------
    >>> round(uniform_compliance([2.0, 1.0], [0.3, 0.3], [1.0]), 6)
    0.371429
    >>> round(uniform_compliance([2.0], [0.3], [1.0], "bonded"), 6)
    0.371429
    """
    G, nu, h, _ = stack_of(young_modulus, poisson_ratio, thickness, base)
    return float(np.sum(h * ((1.0 - 2.0 * nu) / (2.0 * G * (1.0 - nu)))[: h.size]))
