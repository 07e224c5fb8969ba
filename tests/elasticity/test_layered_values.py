"""Layered half-space against 60-digit tables and closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from contactkit.benchmarks.references.tables import reference
from contactkit.elasticity.layer_stack import small_wavenumber_constant, uniform_compliance
from contactkit.elasticity.layered import (
    compliance,
    normal_symbol,
)
from contactkit.elasticity.layered_fields import plane_states
from contactkit.elasticity.stress.periodic import grid_of_modes, on_modes, table_of
from contactkit.elasticity.stress.planes import component

DATA = reference("layered")
each_stack = pytest.mark.parametrize("stack", DATA["stacks"].values(), ids=DATA["stacks"])


def elastic(stack):
    return stack["young_modulus"], stack["poisson_ratio"], stack["thickness"]


@each_stack
def test_compliance_is_that_of_the_table(stack):
    alpha, F11, F12, C, Fs = np.array(stack["rows"]).T
    found = compliance(alpha, *elastic(stack))
    np.testing.assert_allclose(found.F11, F11, rtol=2e-15)
    np.testing.assert_allclose(found.C, C, rtol=2e-15)
    np.testing.assert_allclose(found.Fs, Fs, rtol=2e-15)
    assert np.max(np.abs(found.F12 - F12) / np.sqrt(F11 * C)) < 1e-15


@each_stack
def test_long_waves_and_uniform_pressure(stack):
    scale = sum(stack["thickness"]) / min(stack["young_modulus"])
    assert abs(small_wavenumber_constant(*elastic(stack)) - stack["c0"]) <= 4e-16 * max(
        abs(stack["c0"]), scale
    )
    assert uniform_compliance(*elastic(stack)) == pytest.approx(stack["uniform"], rel=1e-15)


@each_stack
def test_expansion_for_long_waves_leaves_a_rest_of_first_order(stack):
    E, nu, h = elastic(stack)
    c0 = small_wavenumber_constant(E, nu, h)
    alpha = np.array([1e-3, 1e-4]) / sum(h) * min(E[-1] / max(E), 1.0)
    rest = compliance(alpha, E, nu, h).C - 2 * (1 - nu[-1] ** 2) / (E[-1] * alpha) - c0
    if c0 == 0.0:
        assert np.all(np.abs(rest) < 1e-14 / (E[-1] * alpha))
    else:
        assert rest[0] / rest[1] == pytest.approx(10.0, rel=0.02)


@each_stack
def test_states_at_depth_are_those_of_the_table(stack):
    """To 1e-14 of the largest component, of which alpha z times the rounding unit is due."""
    rows = stack["states"]
    alpha = sorted({row[0] for row in rows})
    planes = sorted({(row[1], row[2] == "+") for row in rows})
    depths, sides = [z for z, _ in planes], ["+" if below else "-" for _, below in planes]
    states = dict(zip(planes, plane_states(alpha, *elastic(stack), depths, sides), strict=True))
    for a, z, side, layer, *values in rows:
        at = states[z, side == "+"]
        assert at.layer == layer
        unit = at.shear_modulus * a
        for found, expected, weight in (
            (at.traction, values[:4], [2 * unit, 2 * unit, 1, 1]),
            (at.pressure, values[4:8], [2 * unit, 2 * unit, 1, 1]),
            (at.transverse, values[8:], [unit, 1]),
        ):
            expected = np.multiply(expected, weight)
            error = np.abs(found[:, alpha.index(a)] - expected).max() / np.abs(expected).max()
            assert error < 1e-14 + 4e-16 * a * z, (a, z, side)


@each_stack
def test_stresses_and_displacements_of_one_mode(stack):
    """Signs, rotation and every component, for the three loads."""
    for xi, eta, z, side, load, *expected in stack["modes"]:
        pixel = 2 * np.pi / abs(eta) / 4, 2 * np.pi / abs(xi) / 4
        modes = grid_of_modes((4, 4), pixel)
        # xi > 0 is mode 1; the half plane holds xi < 0 as the conjugate of -(xi, eta)
        at = (1 if xi * eta > 0 else -1, 1)
        turn = {"p": 1.0, "x": -1j, "y": -1j}
        loads = [np.full((4, 3), turn[k], complex) if load == k else None for k in "pxy"]
        states = next(plane_states(modes.length, *elastic(stack), [z], side))
        tables = table_of(states, modes.length, displacement=True)
        unit = on_modes(tables, modes, tractions=True)
        found = np.array([component(k, loads, unit, modes)[at] for k in range(9)])
        found = np.concatenate([found[6:], found[:6]])
        values = np.array([complex(*pair) for pair in expected])
        values = values if xi > 0 else values.conj()
        for part in (slice(0, 3), slice(3, 9)):
            scale = np.abs(values[part]).max()
            assert np.abs(found[part] - values[part]).max() < 2e-14 * scale


def test_half_space():
    E, nu, alpha = 3.0, 0.2, np.array([[0.1, 1.0], [7.0, 1e5]])
    G = E / 2 / (1 + nu)
    found = compliance(alpha, [E], [nu], [])
    np.testing.assert_allclose(found.C, 2 * (1 - nu**2) / (E * alpha), rtol=1e-15)
    np.testing.assert_allclose(found.F11, found.C, rtol=0)
    np.testing.assert_allclose(found.F12, (1 - 2 * nu) / (2 * G * alpha), rtol=1e-15)
    np.testing.assert_allclose(found.Fs, 1 / (G * alpha), rtol=1e-15)


@pytest.mark.parametrize(
    ("stiff", "nu1", "nu2"), [(4.0, 0.3, 0.2), (0.1, 0.1, 0.45), (1.0, 0, 0.5)]
)
def test_one_layer_in_closed_form(stiff, nu1, nu2):
    """C of one layer from its two reflection numbers; m is the ratio of shear moduli."""
    h, x = 0.7, np.array([0.3, 1.0, 3.0, 20.0])
    G1, G2 = stiff / (2 * (1 + nu1)), 1 / (2 * (1 + nu2))
    m = G1 / G2
    kappa = (m - 1) / (m + 3 - 4 * nu1)
    lam = 1 - 4 * (1 - nu1) / (1 + m * (3 - 4 * nu2))
    two, four = np.exp(-2 * x), np.exp(-4 * x)
    above = 1 + 4 * x * kappa * two - lam * kappa * four
    below = 1 - (lam + kappa + 4 * kappa * x**2) * two + lam * kappa * four
    expected = (1 - nu1) / (G1 * x / h) * above / below
    found = compliance(x / h, [stiff, 1.0], [nu1, nu2], [h]).C
    np.testing.assert_allclose(found, expected, rtol=1e-13)


SHAPES = [
    ((8, 8), (1.0, 1.0)),
    ((7, 9), (1.0, 2.0)),
    ((1, 8), (1.0, 1.0)),
    ((6, 6), (1.0, 1.1)),
    ((5, 5), (1.0, 1.0)),
    ((2, 1), (1.0, 1.0)),
    ((1, 1), (1.0, 1.0)),
    ((4, 8), (1.0, 0.5)),
    ((1, 64), (64.0, 1.0)),
]


@pytest.mark.parametrize(("shape", "pixel"), SHAPES)
def test_symbol_of_a_map_is_the_compliance_at_every_mode(shape, pixel):
    stack = [4.0, 1.0], [0.3, 0.2], [1.5]
    ky, kx = np.fft.fftfreq(shape[0], pixel[0])[:, None], np.fft.rfftfreq(shape[1], pixel[1])
    alpha = 2 * np.pi * np.hypot(ky, kx)
    expected = np.zeros_like(alpha)
    expected[alpha > 0] = compliance(alpha[alpha > 0], *stack).C
    found = normal_symbol(shape, pixel, *stack)
    assert found.shape == expected.shape
    np.testing.assert_allclose(found, expected, rtol=1e-14)


def test_many_layers_and_wavenumbers_at_once_change_nothing():
    """The route that sorts a long array first."""
    E, nu, h = np.linspace(1, 9, 9), np.linspace(0.1, 0.5, 9), np.full(8, 0.3)
    alpha = np.tile(np.geomspace(1e-3, 1e3, 5000), (4, 1))
    together, alone = compliance(alpha, E, nu, h), compliance(alpha[0], E, nu, h)
    for found, expected in zip(together, alone, strict=True):
        assert found.shape == alpha.shape
        np.testing.assert_allclose(found, np.tile(expected, (4, 1)), rtol=1e-15)


@pytest.mark.parametrize("shape", [(200, 200), (201, 200)])
def test_the_modes_of_a_map_are_evaluated_once_and_found_again(shape):
    """The route for an array whose rows mirror each other."""
    alpha = np.hypot(np.fft.fftfreq(shape[0])[:, None], np.fft.rfftfreq(shape[1]) + 0.01)
    stack = [4.0, 1.0], [0.3, 0.2], [1.5]
    together = compliance(alpha, *stack)
    for i in (0, 1, shape[0] // 2, shape[0] // 2 + 1, shape[0] - 1):
        for found, expected in zip(together, compliance(alpha[i], *stack), strict=True):
            np.testing.assert_allclose(found[i], expected, rtol=1e-15)
