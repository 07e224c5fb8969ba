"""Displacement under ring pressures: Hertz, a half-space seen from afar, thin layers, waves."""

import numpy as np
import pytest
from scipy.special import j0
from selection import quick

from contactkit.elasticity import rings
from contactkit.elasticity.layer_stack import Layers
from contactkit.elasticity.layered import compliance
from contactkit.errors import DescriptionError


def test_pressure_of_hertz_displaces_a_parabola():
    """w = (pi p0/4 E* a)(2 a^2 - r^2), Johnson, Eq. 3.41a; order 1.5, as its slope is infinite."""
    errors = []
    for n in (50, 100):
        x = 1.0 - np.linspace(1.0, 0.0, n + 1) ** 2
        found = rings.half_space_matrix(x) @ np.sqrt(1.0 - x * x)
        errors.append(np.abs(found - 0.25 * np.pi * (2.0 - x * x)).max())
    assert errors[1] < 2e-4
    assert errors[0] / errors[1] > 2.6


def test_cone_of_pressure_is_exact():
    """p = 1 - r is one hat: its displacement on the axis is that of discs, int 2 a da = 1."""
    x = np.linspace(0.0, 1.0, 7)
    assert rings.half_space_matrix(x)[0] @ (1.0 - x) == pytest.approx(1.0, rel=1e-12)


def test_displacement_far_away_is_that_of_a_point():
    x = np.array([0.0, 0.5, 1.0, 1.5, 400.0])
    pressure = np.array([1.0, 1.0, 0.0, 0.0, 0.0])
    s = np.linspace(0.0, 1.0, 20001)
    shape = np.minimum(1.0, 2.0 - 2.0 * s)
    force = 2.0 * np.pi * np.trapezoid(shape * s, s)
    found = (rings.half_space_matrix(x) @ pressure)[-1]
    assert found == pytest.approx(force / (np.pi * 400.0), rel=1e-5)


def test_matrix_of_two_solids_is_the_sum():
    x = np.linspace(0.0, 1.0, 9)
    steel, glass = Layers([2e11], [0.3]), Layers([7e10], [0.2])
    both = rings.matrix(x, steel, glass)
    assert both == pytest.approx(rings.matrix(x, steel) + rings.matrix(x, glass), rel=1e-14)
    effective = 1.0 / (0.91 / 2e11 + 0.96 / 7e10)
    assert both == pytest.approx(rings.half_space_matrix(x) / effective, rel=1e-12)


@pytest.mark.parametrize(
    ("nu", "base"), quick([(0.3, "bonded"), (0.5, "bonded"), (0.3, "frictionless")], 0)
)
def test_wave_of_bessel_is_multiplied_by_its_symbol(nu, base):
    """Inside a wide window a pressure J0(q r), faded out, sinks as C(q) J0(q r)."""
    q, reach = 3.0, 24.0
    x = np.linspace(0.0, reach, 385)
    fade = np.exp(-((x / 14.0) ** 6))
    layers = Layers([1.0], [nu], [0.4], base)
    found = rings.matrix(x, layers) @ (j0(q * x) * fade)
    expected = compliance(np.array([q]), *layers).C[0]
    assert found[0] == pytest.approx(expected, rel=6e-3)


def test_thin_compressible_layer_is_a_foundation():
    x = np.linspace(0.0, 1.0, 41)
    layer = Layers([1e6], [0.3], [0.01], "bonded")
    smooth = 1.0 - x * x
    found = rings.matrix(x, layer) @ smooth
    winkler = 0.01 * 1.3 * 0.4 / (1e6 * 0.7)
    assert found[:30] == pytest.approx(winkler * smooth[:30], rel=5e-3)


def test_thin_incompressible_layer_sinks_as_the_curvature():
    """w = -(t^3/3G) laplacian p, Johnson, section 5.8: of 1 - r^2 it is uniform."""
    x = np.linspace(0.0, 1.0, 61)
    t, shear = 0.02, 1e6 / 3.0
    found = rings.matrix(x, Layers([1e6], [0.5], [t], "bonded")) @ (1.0 - x * x)
    assert found[5:30] == pytest.approx(4.0 * t**3 / (3.0 * shear), rel=0.02)


def test_layers_of_one_material_are_a_half_space():
    x = np.linspace(0.0, 2.0, 17)
    found = rings.matrix(x, Layers([3e9, 3e9], [0.3, 0.3], [0.5]))
    assert found == pytest.approx(rings.matrix(x, Layers([3e9], [0.3])), rel=1e-9)


@pytest.mark.errors
@pytest.mark.parametrize("nodes", [[0.0, 1.0], [0.1, 1.0, 2.0], [0.0, 2.0, 1.0]])
def test_nodes_ascend_from_the_axis(nodes):
    with pytest.raises(DescriptionError, match=r"rings\.nodes"):
        rings.half_space_matrix(np.array(nodes))
