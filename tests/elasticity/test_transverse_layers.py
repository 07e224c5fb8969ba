"""Transversely isotropic layers: boundary value problems, limits, and the isotropic recursion."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext

import numpy as np
import pytest
import scipy.linalg

from contactkit.elasticity import influence, layered, one_axis
from contactkit.elasticity.layer_stack import Layers
from contactkit.elasticity.transverse_isotropy import (
    PlaneConstants,
    Stiffness,
    indentation_modulus,
    isotropic_constants,
    plane_constants,
    roots_of,
)
from contactkit.elasticity.transverse_layers import TransverseLayers, normal_compliance
from contactkit.elasticity.transverse_symbols import (
    isolated_symbol,
    one_axis_symbol,
    periodic_symbol,
)
from contactkit.errors import DescriptionError

BASES = (None, "bonded", "frictionless")
each_base = pytest.mark.parametrize("base", BASES, ids=str)
# As published in round numbers [GPa]: zinc, pyrolytic graphite, a columnar coating of TiN, muscle
# [kPa] with fibres along the surface, and a solid that is far stiffer in shear than isotropic ones.
SOLIDS = {
    "zinc": Stiffness(161.0, 50.1, 61.0, 38.3),
    "graphite": Stiffness(1060.0, 15.0, 36.5, 4.5),
    "columnar": Stiffness(480.0, 130.0, 560.0, 110.0),
    "muscle": Stiffness(330.0, 310.0, 300.0, 4.0),
    "stiff in shear": Stiffness(100.0, 95.0, 110.0, 60.0),
}
each_solid = pytest.mark.parametrize("stiffness", SOLIDS.values(), ids=SOLIDS)


def constants(stiffness):
    c11, c13, c33, c44 = stiffness
    return PlaneConstants(c11 - c13**2 / c33, c13 / c33, 1.0 / c33, 1.0 / c44)


def layers_of(stiffnesses, thickness=(), base=None):
    return TransverseLayers(tuple(constants(one) for one in stiffnesses), thickness, base)


# Boundary value problems ----------------------------------------------------------------------


def generator(stiffness):
    """Equilibrium and Hooke's law: (U, W, T, S)' by depth times wavenumber."""
    c11, c13, c33, c44 = stiffness
    u = np.eye(4)[0]
    w_slope = np.array([c13 / c33, 0.0, 0.0, 1.0 / c33])  # S = -c13 U + c33 W'
    return np.array(
        [
            [0.0, -1.0, 1.0 / c44, 0.0],  # T = c44 (U' + W)
            w_slope,
            c11 * u - c13 * w_slope,  # T' = -sigma_LL, with u_L = iU
            [0.0, 0.0, 1.0, 0.0],
        ]
    )


def by_exponentials(alpha, stiffnesses, thickness, base):
    """Displacement under a unit pressure, from the states that the bottom admits."""
    if base is None:
        values, vectors = np.linalg.eig(generator(stiffnesses[-1]))
        states = vectors[:, values.real < 0.0]
    else:
        states = np.eye(4)[:, [2, 3] if base == "bonded" else [0, 3]]
    for stiffness, h in reversed(list(zip(stiffnesses, thickness, strict=False))):
        states = scipy.linalg.expm(-alpha * h * generator(stiffness)) @ states
        states = states / np.abs(states).max()
    amplitudes = np.linalg.solve(states[2:], [0.0, -1.0])
    return (states[1] @ amplitudes).real / alpha


@each_base
@pytest.mark.parametrize("order", [(0, 1, 2), (1, 3, 0), (2, 4, 1), (4, 2, 3), (3, 0, 4)])
def test_layers_solve_the_equations_of_equilibrium(order, base):
    stack = [list(SOLIDS.values())[i] for i in order]
    thickness = (0.3, 0.5, 0.4)[: 3 if base else 2]
    for alpha in (0.05, 0.4, 1.5):
        found = float(normal_compliance(alpha, layers_of(stack, thickness, base)))
        assert found == pytest.approx(by_exponentials(alpha, stack, thickness, base), rel=1e-8)


def exponential(rows, length):
    """Matrix exponential in decimals, by scaling and squaring."""
    halvings = 8 + max(0, math.frexp(max(abs(v) for v in rows.ravel()) * length)[1])
    step = rows * (length / 2**halvings)
    total = term = np.array([[Decimal(int(i == j)) for j in range(4)] for i in range(4)])
    for k in range(1, 40):
        term = term @ step / k
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total


def exact_constants(stiffness):
    c11, c13, c33, c44 = (Decimal(v) for v in stiffness)
    return PlaneConstants(*map(float, (c11 - c13 * c13 / c33, c13 / c33, 1 / c33, 1 / c44)))


def by_digits(alpha, stiffnesses, thickness, base):
    """As `by_exponentials`, in so many digits that none is lost to growing waves."""
    states = np.array([[Decimal(0)] * 2 for _ in range(4)])
    states[2 if base == "bonded" else 0, 0] = states[3, 1] = Decimal(1)
    for stiffness, h in reversed(list(zip(stiffnesses, thickness, strict=True))):
        c11, c13, c33, c44 = (Decimal(v) for v in stiffness)
        rows = np.full((4, 4), Decimal(0))
        rows[0, 1], rows[0, 2], rows[1, 0], rows[1, 3] = Decimal(-1), 1 / c44, c13 / c33, 1 / c33
        rows[2, 0], rows[2, 3], rows[3, 2] = c11 - c13 * c13 / c33, -c13 / c33, Decimal(1)
        states = exponential(-rows, Decimal(alpha) * Decimal(h)) @ states
    (_, _), (w1, w2), (t1, t2), (s1, s2) = states
    return float((w1 * t2 - w2 * t1) / (t1 * s2 - t2 * s1) / Decimal(alpha))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(8))
def test_the_error_is_round_off_for_stiffnesses_that_differ_a_million_times(seed):
    rng, decades = np.random.default_rng(seed), 3.0
    for base in ("bonded", "frictionless"):
        stack = []
        for _ in range(2):
            c11, c33 = 10.0 ** rng.uniform(-decades, decades, 2)
            mean = np.sqrt(c11 * c33)
            share = rng.choice([rng.uniform(-0.5, 0.9), 1.0 - 10.0 ** rng.uniform(-6.0, -1.0)])
            stack.append(Stiffness(c11, share * mean, c33, mean * 10.0 ** rng.uniform(-1.5, 1.0)))
        thickness = tuple(10.0 ** rng.uniform(-1.0, 1.0, 2))
        fastest = sum(h * roots_of(constants(s)).sum for s, h in zip(stack, thickness, strict=True))
        for turns in (1e-4, 0.1, 5.0, 100.0):
            alpha = turns / fastest
            with localcontext(prec=400):
                solids = tuple(exact_constants(one) for one in stack)
                expected = by_digits(alpha, stack, thickness, base)
            found = normal_compliance(alpha, TransverseLayers(solids, thickness, base))
            assert float(found) == pytest.approx(expected, rel=1e-12)


@each_base
@pytest.mark.parametrize("contrast", [1.0, 1e6])
def test_isotropic_layers_are_those_of_the_isotropic_recursion(contrast, base):
    E, nu, h = [4.0, 1.0 / contrast, 2.0, 1.0], [0.3, 0.5, -0.5, 0.4999999], [0.3, 5.0, 0.02, 1.0]
    h = h if base else h[:3]
    alpha = np.logspace(-9, 5, 57)
    solids = tuple(isotropic_constants(*one) for one in zip(E, nu, strict=True))
    found = normal_compliance(alpha, TransverseLayers(solids, tuple(h), base))
    np.testing.assert_allclose(found, layered.compliance(alpha, E, nu, h, base).C, rtol=1e-14)


# Limits ---------------------------------------------------------------------------------------


@each_solid
def test_a_layer_on_its_own_material_is_not_there(stiffness):
    alpha = np.logspace(-6, 6, 49)
    half_space = 2.0 / (indentation_modulus(stiffness) * alpha)
    found = normal_compliance(alpha, layers_of([stiffness] * 3, (1.0, 0.02)))
    np.testing.assert_allclose(found, half_space, rtol=1e-13)


@each_base
@each_solid
def test_short_waves_feel_the_layer_and_long_ones_what_is_below(stiffness, base):
    steel = Stiffness(280.0, 120.0, 280.0, 80.0)
    layers = layers_of([stiffness] if base else [stiffness, steel], (1.0,), base)
    short, long = 1e6, 1e-8
    found = normal_compliance([short, long], layers)
    assert found[0] == pytest.approx(2.0 / (indentation_modulus(stiffness) * short), rel=1e-13)
    c11, c13, c33, _ = stiffness
    compressed = {"bonded": 1.0 / c33, "frictionless": c11 / (c11 * c33 - c13**2)}
    expected = compressed[base] if base else 2.0 / (indentation_modulus(steel) * long)
    assert found[1] == pytest.approx(expected, rel=1e-5)


def test_long_waves_squeeze_an_incompressible_layer_by_shear_alone():
    """As a film of viscosity c44 between impermeable walls: alpha^2 h^3/(3 c44)."""
    gel = plane_constants(3.0, 2.0, 0.25, 0.5, 0.7)
    alpha, h = 1e-4, 1.5
    found = normal_compliance(alpha, TransverseLayers((gel,), (h,), "bonded"))
    assert found == pytest.approx(alpha**2 * h**3 / (3.0 * 0.7), rel=1e-6)


def test_nothing_happens_where_roots_become_equal_or_conjugate():
    c11, c13, c33 = 3.0, 1.0, 2.0
    equal = (c11 * c33 - c13**2) / (2.0 * (np.sqrt(c11 * c33) + c13))  # c44 of equal roots
    alpha = np.logspace(-6, 6, 25)
    steps = (1.0 - 1e-3, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.0 + 1e-3)
    solids = [Stiffness(c11, c13, c33, equal * one) for one in steps]
    squares = [roots_of(constants(one)).difference2 for one in solids]
    assert squares[0] > 0.0 > squares[-1]
    low, below, middle, above, high = (
        normal_compliance(alpha, layers_of([one], (1.0,), "bonded")) for one in solids
    )
    np.testing.assert_allclose(below, middle, rtol=1e-8)
    np.testing.assert_allclose(above, middle, rtol=1e-8)
    np.testing.assert_allclose(0.5 * (low + high), middle, rtol=1e-6)  # smooth: c44 to second order


@each_base
def test_a_compliance_is_positive_and_falls_with_stiffness(base):
    """For all ratios of stiffnesses and thicknesses over wavelengths; Rayleigh: energy is work."""
    alpha = np.logspace(-6, 6, 25)
    for c33 in (1e-3, 1.0, 1e3):
        for c44 in (1e-3, 0.3, 1e3):
            for share in (-0.6, 0.0, 0.9, 1.0 - 1e-9):
                stiffness = Stiffness(1.0, share * np.sqrt(c33), c33, c44 * np.sqrt(c33))
                stack = [stiffness] if base else [stiffness, SOLIDS["zinc"]]
                found = normal_compliance(alpha, layers_of(stack, (1.0,), base))
                assert np.all(found > 0.0)
                stiffer = [Stiffness(*(1.3 * v for v in stiffness)), *stack[1:]]
                less = normal_compliance(alpha, layers_of(stiffer, (1.0,), base))
                assert np.all(less <= found * (1.0 + 1e-13))
                assert np.any(less < 0.8 * found)


# Windows --------------------------------------------------------------------------------------


@pytest.mark.parametrize("base", [None, "bonded"], ids=str)
def test_symbols_of_isotropic_layers_are_those_of_every_window(base):
    # Without a base so thick and stiff that along one axis the substrate is felt from afar only.
    E, nu, h = ([4.0, 1.0], [0.3, 0.3], [0.7, 2.0]) if base else ([400.0, 1.0], [0.3, 0.3], [70.0])
    layers = TransverseLayers(
        tuple(isotropic_constants(*one) for one in zip(E, nu, strict=True)), tuple(h), base
    )
    shape, pixel, plain = (12, 10), (0.5, 0.3), Layers(E, nu, h, base)
    pairs = [
        (periodic_symbol(shape, pixel, layers), layered.normal_symbol(shape, pixel, *plain)),
        (isolated_symbol(shape, pixel, layers), influence.symbol(shape, pixel, *plain)),
        (
            one_axis_symbol(shape, pixel, layers, "y"),
            one_axis.symbol(shape, pixel, plain, "y"),
        ),
    ]
    for found, expected in pairs:
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-11 * expected.max())


@pytest.mark.parametrize("name", ["graphite", "stiff in shear"])
def test_an_isolated_window_samples_the_displacement_by_a_pixel(name):
    """On a bonded base, whose displacements end in the window: a sum over all aliases."""
    layers = layers_of([SOLIDS[name]], (1.0,), "bonded")
    n, d = 24, 0.5
    symbol = isolated_symbol((n, n), (d, d), layers)
    aliases = np.arange(-150, 151)
    for k, j in ((0, 1), (3, 2), (9, 0)):
        q = [np.pi * i / (n * d) + 2.0 * np.pi / d * aliases for i in (k, j)]
        waves = normal_compliance(np.hypot(q[0][:, None], q[1]), layers)
        pixel = [np.sinc(0.5 * d * one / np.pi) for one in q]
        assert symbol[k, j] == pytest.approx(pixel[0] @ waves @ pixel[1], rel=2e-4)


@pytest.mark.errors
def test_what_is_no_layer_is_refused():
    zinc = constants(SOLIDS["zinc"])
    for layers, message in (
        (TransverseLayers((zinc,), (1.0,)), r"layers\.thickness .*one for each"),
        (TransverseLayers((zinc, zinc), (0.0,)), r"layers\.thickness .*positive"),
        (TransverseLayers((zinc,), (1.0,), "glued"), r"layers\.base"),
        (TransverseLayers((zinc._replace(shear=0.0),)), r"layers\.solids"),
    ):
        with pytest.raises(DescriptionError, match=message):
            normal_compliance(1.0, layers)
    with pytest.raises(DescriptionError, match=r"wavenumber .*1/m"):
        normal_compliance([1.0, 0.0], TransverseLayers((zinc,)))
    rigid = constants(Stiffness(100.0, 95.0, 110.0, 600.0))  # waves turn eleven times as they decay
    layers = TransverseLayers((rigid, zinc), (1.0,))
    assert periodic_symbol((4, 4), (1.0, 1.0), layers).min() == 0.0
    with pytest.raises(DescriptionError, match=r"shear_modulus must be at most .*periodic=True"):
        isolated_symbol((4, 4), (1.0, 1.0), layers)
