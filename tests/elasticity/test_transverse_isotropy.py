"""Transversely isotropic half-space: waves of its two roots, the isotropic limit, bounds."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from contactkit.elasticity.transverse_isotropy import (
    Stiffness,
    indentation_modulus,
    plane_constants,
    stiffness_of,
)
from contactkit.errors import DescriptionError

# Engineering constants of solids as published in round numbers [GPa]: zinc is soft along its axis,
# a unidirectional composite stiff.
SOLIDS = {
    "zinc": Stiffness(161.0, 50.1, 61.0, 38.3),
    "graphite": Stiffness(1060.0, 15.0, 36.5, 4.5),
    "composite": stiffness_of(9.0, 140.0, 0.4, 0.3, 5.0),
    "complex roots": Stiffness(100.0, 20.0, 110.0, 60.0),
}


def modulus_by_waves(stiffness):
    """From two decaying waves without shear at the surface, each a root of the characteristic."""
    c11, c13, c33, c44 = stiffness
    both = c13 + c44
    quadratic = [c33 * c44, both**2 - c11 * c33 - c44**2, c11 * c44]
    roots = [cmath.sqrt(one) for one in np.roots(quadratic)]
    waves = []
    for s in roots:
        u, w = both * s, c44 * s**2 - c11
        assert abs(w * (c33 * s**2 - c44) + both * s * u) < 1e-9 * c11**2 * abs(s**2)
        waves.append((w, c44 * (w - s * u), -c13 * u - c33 * s * w))
    (w1, t1, n1), (w2, t2, n2) = waves
    pressure = n1 * t2 - n2 * t1  # of amplitudes t2 and -t1: the shear vanishes
    displacement = w1 * t2 - w2 * t1
    return (-2.0 * pressure / displacement).real


@pytest.mark.parametrize("stiffness", SOLIDS.values(), ids=SOLIDS)
def test_the_modulus_is_that_of_two_waves(stiffness):
    found = indentation_modulus(stiffness)
    assert found == pytest.approx(modulus_by_waves(stiffness), rel=1e-9)


@pytest.mark.parametrize("nu", [-0.9, 0.0, 0.3, 0.4999])
def test_an_isotropic_solid_is_a_limit(nu):
    same = stiffness_of(2e9, 2e9, nu, nu, 1e9 / (1.0 + nu))
    assert indentation_modulus(same) == pytest.approx(2e9 / (1.0 - nu**2), rel=1e-9)


def test_constants_invert_to_the_compliance():
    e1, e3, nu, along = 9.0, 140.0, 0.4, 0.3
    c11, c13, c33, _ = stiffness_of(e1, e3, nu, along, 5.0)
    full = np.array(
        [
            [1.0 / e1, -nu / e1, -along / e3],
            [-nu / e1, 1.0 / e1, -along / e3],
            [-along / e3, -along / e3, 1.0 / e3],
        ]
    )
    inverse = np.linalg.inv(full)
    np.testing.assert_allclose(
        [c11, c13, c33], [inverse[0, 0], inverse[0, 2], inverse[2, 2]], rtol=1e-12
    )


@pytest.mark.errors
@pytest.mark.parametrize(
    "given",
    [
        (1.0, 1.0, 0.3, 0.7, 0.4),
        (1.0, 1.0, 1.0, 0.1, 0.4),
        (0.0, 1.0, 0.3, 0.3, 0.4),
        (1.0, math.inf, 0.3, 0.3, 0.4),
        (1.0, 1.0, 0.3, 0.3, -0.4),
    ],
)
def test_constants_of_no_solid_are_refused(given):
    with pytest.raises(DescriptionError, match="plane_constants"):
        stiffness_of(*given)


@pytest.mark.errors
def test_an_incompressible_solid_has_constants_of_waves_but_no_stiffness():
    ratio, modulus = 0.5, 3.0  # nu_12 = 1 - E_1/(2 E_3)
    given = (modulus, 2.0, 1.0 - 0.25 * modulus, ratio, 0.7)
    assert plane_constants(*given).axial == 0.0
    with pytest.raises(DescriptionError, match="compressible"):
        stiffness_of(*given)


@pytest.mark.errors
def test_a_stiffness_that_releases_energy_is_refused():
    for wrong in ((1.0, 2.0, 1.0, 1.0), (1.0, 0.0, 1.0, 0.0), (math.nan, 0.0, 1.0, 1.0)):
        with pytest.raises(DescriptionError, match="c13"):
            indentation_modulus(Stiffness(*wrong))
