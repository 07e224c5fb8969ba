"""What any layered half-space must obey, whatever its layers."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from contactkit.elasticity.depths import default_depths, locate
from contactkit.elasticity.layered import compliance
from contactkit.elasticity.layered_fields import plane_states, unit_stresses

ALPHA = np.geomspace(1e-3, 1e2, 24)
moduli = st.floats(-3.0, 3.0).map(lambda exponent: 10.0**exponent)
ratios = st.floats(-0.9, 0.5)
lengths = st.floats(-2.0, 1.0).map(lambda exponent: 10.0**exponent)


@st.composite
def stacks(draw, most=5):
    n = draw(st.integers(1, most))
    E, nu = (draw(st.lists(kind, min_size=n + 1, max_size=n + 1)) for kind in (moduli, ratios))
    return E, nu, draw(st.lists(lengths, min_size=n, max_size=n))


def agree(found, expected, tolerance=4e-15):
    for name in ("F11", "C", "Fs"):
        np.testing.assert_allclose(
            getattr(found, name), getattr(expected, name), rtol=tolerance, err_msg=name
        )
    scale = np.sqrt(expected.F11 * expected.C)
    assert np.max(np.abs(found.F12 - expected.F12) / scale) < tolerance


@given(stacks(), st.data())
def test_a_layer_cut_in_two_is_the_same_layer(stack, data):
    E, nu, h = stack
    j = data.draw(st.integers(0, len(h) - 1))
    fraction = data.draw(st.floats(0.01, 0.99))
    cut = [*h[:j], h[j] * fraction, h[j] * (1 - fraction), *h[j + 1 :]]
    agree(
        compliance(ALPHA, [*E[:j], E[j], *E[j:]], [*nu[:j], nu[j], *nu[j:]], cut),
        compliance(ALPHA, E, nu, h),
    )


@given(stacks(), st.floats(0.1, 10.0), st.floats(0.1, 10.0))
def test_lengths_and_moduli_scale(stack, s, t):
    E, nu, h = stack
    scaled = compliance(ALPHA, np.multiply(E, s), nu, np.multiply(h, t))
    base = compliance(ALPHA * t, E, nu, h)
    for found, expected in zip(scaled, base, strict=True):
        np.testing.assert_allclose(found, expected * t / s, rtol=2e-14, atol=1e-14 * base.C.max())
    np.testing.assert_allclose(scaled.C, base.C * t / s, rtol=2e-14)


@given(stacks())
def test_the_compliance_is_positive_definite(stack):
    found = compliance(ALPHA, *stack)
    assert np.all(found.F11 > 0)
    assert np.all(found.Fs > 0)
    assert np.all(found.F11 * found.C > found.F12**2)


@given(stacks(), st.data())
def test_a_stiffer_material_lowers_the_compliance(stack, data):
    E, nu, h = stack
    j = data.draw(st.integers(0, len(h)))
    stiffer = [*E[:j], E[j] * data.draw(st.floats(1.1, 100.0)), *E[j + 1 :]]
    before, after = compliance(ALPHA, E, nu, h), compliance(ALPHA, stiffer, nu, h)
    assert np.all(after.C <= before.C * (1 + 1e-14))
    assert np.all(after.Fs <= before.Fs * (1 + 1e-14))


@given(stacks(), ratios)
def test_one_ratio_of_poisson_bounds_the_compliance_by_the_moduli(stack, nu):
    E, _, h = stack
    C = compliance(ALPHA, E, [nu] * len(E), h).C * ALPHA / (2 * (1 - nu**2))
    assert C.min() * max(E) >= 1 - 1e-14
    assert C.max() * min(E) <= 1 + 1e-14


@given(stacks(most=3))
def test_short_waves_feel_the_top_and_long_ones_the_substrate(stack):
    E, nu, h = stack
    top = compliance(50.0 / h[0], E, nu, h)
    agree(top, compliance(50.0 / h[0], E[:1], nu[:1], []), 1e-13)
    far = 1e-12 / (sum(h) * max(1.0, max(E) / E[-1], E[-1] / min(E)))
    agree(compliance(far, E, nu, h), compliance(far, E[-1:], nu[-1:], []), 1e-9)


# At depth -----------------------------------------------------------------------------------


@given(stacks(most=4))
def test_tractions_and_displacements_pass_through_interfaces(stack):
    E, nu, h = stack
    z = np.repeat(np.cumsum(h), 2)
    alpha = np.geomspace(0.01, 5.0, 6) / sum(h)
    states = list(plane_states(alpha, E, nu, h, z, ["-", "+"] * len(h)))
    for above, below in zip(states[::2], states[1::2], strict=True):
        assert (above.layer + 1, above.side, below.side) == (below.layer, "-", "+")
        for name in ("pressure", "traction", "transverse"):
            a, b = getattr(above, name).copy(), getattr(below, name).copy()
            moved = 1 if name == "transverse" else 2
            b[:moved] *= above.shear_modulus / below.shear_modulus
            assert np.max(np.abs(a - b)) <= 1e-13 * max(np.abs(a).max(), np.abs(b).max())


@given(stacks(most=3), st.floats(0.05, 0.95))
def test_the_states_obey_equilibrium_and_elasticity(stack, fraction):
    """Differences in depth against the equations of one wavenumber, which the code never solves.

    With x = alpha z and u, w, v = 2 G alpha (U, W), G alpha V: u' = 2 T - w, T' = (u - nu S)/
    (1 - nu), S' = T and v' = Q, Q' = v.
    """
    E, nu, h = stack
    layer = len(h) - 1
    alpha = np.array([min(1.0 / h[-1], 20.0 / sum(h))])
    d = 2e-3 * alpha[0] * h[-1]
    middle = sum(h[:-1]) + fraction * h[-1]
    z = middle + np.array([-2.0, -1.0, 0.0, 1.0, 2.0]) * d / alpha[0]
    states = list(plane_states(alpha, E, nu, h, z))
    n = nu[layer]
    weights = np.array([1, -8, 0, 8, -1]) / (12 * d)

    def slope(name):
        return sum(w * getattr(s, name)[:, 0] for w, s in zip(weights, states, strict=True))

    assert states[2].layer == layer
    for name in ("pressure", "traction"):
        u, w, T, S = getattr(states[2], name)[:, 0]
        expected = (
            2 * T - w,
            (1 - 2 * n) / (1 - n) * S + n / (1 - n) * u,
            (u - n * S) / (1 - n),
            T,
        )
        error = np.abs(slope(name) - expected).max()
        assert error < 1e-7 * np.abs([u, w, T, S]).max()
    v, Q = states[2].transverse[:, 0]
    assert np.abs(slope("transverse") - [Q, v]).max() < 1e-7 * max(abs(v), abs(Q))


@pytest.mark.parametrize("nu", [-0.5, 0.0, 0.3, 0.5])
def test_a_half_space_in_layers_has_the_fields_of_one(nu):
    """sigma_LL = (k - 1) exp(-k) under a pressure, (k - 2) exp(-k) under a traction."""
    alpha, z = np.geomspace(0.1, 10.0, 9), [0.0, 0.4, 1.0, 1.7, 3.0]
    for states in plane_states(alpha, [2.0] * 3, [nu] * 3, [1.0, 0.7], z):
        k = alpha * states.depth
        decay = np.exp(-k)
        pressure, traction, transverse = unit_stresses(states)
        one = [-(1 - k), -2 * nu + 0 * k, -(1 + k), k] * decay[None, :]
        two = [k - 2, -2 * nu + 0 * k, -k, k - 1] * decay[None, :]
        found_one = [*pressure, states.pressure[3], states.pressure[2]]
        found_two = [*traction, states.traction[3], states.traction[2]]
        np.testing.assert_allclose(found_one, one, rtol=0, atol=4e-15)
        np.testing.assert_allclose(found_two, two, rtol=0, atol=4e-15)
        np.testing.assert_allclose(transverse, decay, rtol=1e-13)


@given(stacks(most=4), st.floats(0.01, 30.0), st.integers(1, 9))
def test_default_planes_miss_no_interface_and_repeat_none(stack, deepest, count):
    h = stack[2]
    depths, sides = default_depths(h, deepest, count)
    planes = locate(depths, sides, h)
    assert depths[0] == 0.0
    assert len(set(zip(depths, sides, strict=True))) == len(depths)
    assert [(z, layer) for z, _, layer in planes] == sorted((z, layer) for z, _, layer in planes)
    inside = [z for z in np.cumsum(h) if z <= deepest]
    for z in inside:
        assert [side for d, side in zip(depths, sides, strict=True) if d == z] == ["-", "+"]


def test_a_plane_on_an_interface_up_to_round_off_is_on_it():
    (above, below) = locate([0.3, 0.3], "-+", [0.1, 0.2])
    assert (above[2], below[2]) == (1, 2)
    assert above[0] == below[0] == 0.1 + 0.2
