r"""Effective hardness of a layered solid, from the hardness of its materials.

The pressure of a contact cannot exceed the hardness H. That of a layered solid falls or rises with
the depth of indentation, represented by the displacement u of the surface, u >= 0 into the solid.
Materials are listed from the top, the substrate last; layer j ends at the depth
:math:`D_j = h_1 + \dots + h_j`.

======= ================================================ =====
symbol  is                                               unit
======= ================================================ =====
u       displacement of the surface, indentation depth   m
h, D    thickness of a layer, depth of its lower face    m
E, H    Young's modulus, hardness of a material          Pa
m, n, p fitted exponents                                 -
======= ================================================ =====

The exponents were fitted to conical indentations of one layer on a substrate: (1.1, -0.5, 0.1) for
a hard layer on a soft one, (1.8, -0.9, 1) for a soft layer on a hard one. "Hard on soft" is read
as :math:`H_k > H_{k+1}`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import DescriptionError

__all__ = ["effective_hardness", "effective_hardness_literal", "layer_on_substrate"]

Array = NDArray[np.float64]
Values = Sequence[float] | Array

# Exponents m, n, p of Eq. (2.41) for a hard layer on a soft material and the reverse, as printed.
_HARD_ON_SOFT = (1.1, -0.5, 0.1)
_SOFT_ON_HARD = (1.8, -0.9, 1.0)
_PLATEAU = 0.3  # fraction of a thickness up to which the source takes the layer alone


def layer_on_substrate(
    displacement: ArrayLike,
    young_modulus: float,
    young_modulus_below: float,
    hardness: float,
    hardness_below: float,
    thickness: float,
) -> Array:
    r"""Hardness [Pa] of one layer on another material, from depth zero on.

    .. math:: \frac{H_e}{H_2} = 1 + \left(\frac{H_1}{H_2} - 1\right) \exp\left[
              -\left(\frac{u}{h}\right)^m \left(\frac{E_1}{E_2}\right)^n
              \left(\frac{H_1}{H_2}\right)^p\right]

    Parameters
    ----------
    displacement : array_like (...)
        Displacement u [m]; above the surface it counts as zero.
    young_modulus, young_modulus_below : float
        Young's moduli of the layer and of the material below [Pa].
    hardness, hardness_below : float
        Their hardness [Pa].
    thickness : float
        Thickness h of the layer [m].

    References
    ----------
    .. [1] Eq. (2.41) (Bhushan and Venkatesan 2005), after Bhattacharya and Nix (1988).

    Examples
    --------
    >>> round(float(layer_on_substrate(1e-9, 1e11, 1e11, 2e9, 1e9, 1e-9)) / 1e9, 9)
    1.342400744
    """
    weight = _weight_of_layer(
        displacement, 0.0, thickness, young_modulus / young_modulus_below, hardness / hardness_below
    )
    return np.asarray(hardness * weight + hardness_below * (1.0 - weight))


def effective_hardness(
    displacement: ArrayLike,
    young_modulus: Values,
    hardness: Values,
    thickness: Values,
    shift: float = 0.3,
) -> Array:
    r"""Hardness [Pa] of any number of layers: continuous, between the minimum and the maximum.

    .. math:: H_e(u) &= H_s + \sum_j (H_j - H_{j+1}) W_j, \\
              W_j &= \max(w_1, \dots, w_j), \qquad
              w_j = \exp\left[-\left(\frac{\langle u - s D_j \rangle}{D_j}\right)^m
              \left(\frac{E_j}{E_{j+1}}\right)^n \left(\frac{H_j}{H_{j+1}}\right)^p\right]

    Interfaces between materials of the same hardness are left out, of the running maximum too, so
    that a layer cut in two stays the layer it was. The exponents are those of
    `layer_on_substrate`, which this is for one layer and a shift of 0.

    Parameters
    ----------
    displacement : array_like (...)
        Displacement u [m]; above the surface it counts as zero.
    young_modulus, hardness : sequence (n_layers + 1)
        Young's moduli and hardness of the materials, substrate last [Pa].
    thickness : sequence (n_layers)
        Thicknesses of the layers [m].
    shift : float
        Fraction s of the depth of an interface up to which it has no effect [-]: 0.3 is the rule of
        thumb of the source, 0 is its fit.

    Notes
    -----
    A fit to one layer, carried over to many: for one layer it is the source's, for more a
    reading of it that has none of the jumps of `effective_hardness_literal`. A shift of 0.3 moves
    the fit of one layer deeper: 14 % in hardness for ratios of 2 and 1 of hardness and modulus,
    up to 53 % where the two ratios lie between 1/4 and 4.

    References
    ----------
    .. [1] Eq. (2.41) for each interface.

    Examples
    --------
    >>> effective_hardness([0.0, 1e-9, 1e-7], [1e11] * 3, [5e9, 2.5e9, 5e9], [1e-9, 1e-9]).round(-6)
    array([5.00e+09, 3.78e+09, 5.00e+09])
    """
    u = np.asarray(displacement, dtype=np.float64)
    total, above, depth = np.zeros_like(u), np.zeros_like(u), 0.0
    for j, thick in enumerate(thickness):
        depth += thick
        if hardness[j] == hardness[j + 1]:
            continue
        weight = _weight_of_layer(
            u, shift, depth, young_modulus[j] / young_modulus[j + 1], hardness[j] / hardness[j + 1]
        )
        # Summed over non-negative fractions of each material: bounded by the hardnesses.
        weight = np.maximum(weight, above)
        total += hardness[j] * (weight - above)
        above = weight
    return np.asarray(total + hardness[-1] * (1.0 - above))


def effective_hardness_literal(
    displacement: ArrayLike, young_modulus: Values, hardness: Values, thickness: Values
) -> Array:
    r"""Hardness [Pa] by the three criteria of the source, as they stand; they jump.

    Two layers: :math:`H_1` where :math:`u < 0.3 h_1`; else `layer_on_substrate` of the upper two
    materials where :math:`u < 0.3 h_2`, of the lower two elsewhere. One layer: :math:`H_1` where
    :math:`u < 0.3 h_1`, `layer_on_substrate` elsewhere.

    Parameters
    ----------
    displacement : array_like (...)
        Displacement u [m]. The source takes the largest of the surface.
    young_modulus, hardness : sequence (n_layers + 1)
        Young's moduli and hardness of the materials, substrate last [Pa].
    thickness : sequence (n_layers)
        Thicknesses of the layers, two at most [m].

    Raises
    ------
    DescriptionError
        For more than two layers, which the source does not treat.

    Notes
    -----
    For reproducing the source's figures; otherwise take `effective_hardness`. One layer twice or
    half as hard as the substrate jumps by -12 % or +6 % at :math:`u = 0.3 h`. For two layers with
    :math:`h_1 \ge h_2` the second criterion never holds, and the top layer has no effect
    beyond the first.

    References
    ----------
    .. [1] Eq. (2.41) and the criteria that follow it.

    Examples
    --------
    >>> effective_hardness_literal([2.9e-10, 3.1e-10], [1e11] * 2, [2e9, 1e9], [1e-9]).round(-7)
    array([2.00e+09, 1.74e+09])
    """
    if len(thickness) > 2:
        raise DescriptionError(
            "effective_hardness_literal.thickness",
            len(thickness),
            "be two layers at most",
            hint="effective_hardness takes any number",
        )
    u = np.asarray(displacement, dtype=np.float64)
    fits = [
        layer_on_substrate(
            u, young_modulus[k], young_modulus[k + 1], hardness[k], hardness[k + 1], thick
        )
        for k, thick in enumerate(thickness)
    ]
    found = np.full(u.shape, hardness[-1]) if not fits else fits[-1]
    if len(fits) == 2:
        found = np.where(u < _PLATEAU * thickness[1], fits[0], found)
    if fits:
        found = np.where(u < _PLATEAU * thickness[0], hardness[0], found)
    return np.asarray(found)


def _weight_of_layer(
    u: ArrayLike, shift: float, depth: float, moduli: float, hardnesses: float
) -> Array:
    """Weight of the material above an interface: 1 at the surface, 0 far below."""
    m, n, p = _HARD_ON_SOFT if hardnesses > 1.0 else _SOFT_ON_HARD
    beyond = np.maximum(np.asarray(u, dtype=np.float64) / depth - shift, 0.0)
    with np.errstate(over="ignore", under="ignore"):  # far below, the weight is 0
        return np.asarray(np.exp(-(beyond**m) * moduli**n * hardnesses**p))
