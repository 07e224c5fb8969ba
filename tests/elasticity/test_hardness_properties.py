"""Laws of the hardness of a layered solid, for any layers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from contactkit.elasticity.hardness_rules import (
    effective_hardness,
    effective_hardness_literal,
    layer_on_substrate,
)

VALUE = st.floats(-2.0, 2.0).map(lambda power: 10.0**power)
SHIFT = st.sampled_from([0.0, 0.3, 1.0])


@st.composite
def stacks(draw, most=5):
    n = draw(st.integers(1, most))
    hardness = draw(st.lists(VALUE, min_size=n + 1, max_size=n + 1))
    same = draw(st.integers(0, n - 1))
    if draw(st.booleans()):
        hardness[same + 1] = hardness[same]
    return (
        draw(st.lists(VALUE, min_size=n + 1, max_size=n + 1)),
        hardness,
        draw(st.lists(VALUE, min_size=n, max_size=n)),
    )


@given(stacks(), SHIFT)
def test_it_starts_at_the_top_and_ends_at_the_substrate(stack, shift):
    young_modulus, hardness, thickness = stack
    u = np.array([-1.0, 0.0, np.inf])
    found = effective_hardness(u, young_modulus, hardness, thickness, shift)
    np.testing.assert_array_equal(found, [hardness[0], hardness[0], hardness[-1]])


@given(stacks(), SHIFT, st.lists(st.floats(0.0, 1e4), min_size=1, max_size=8))
def test_it_lies_between_the_least_and_the_greatest(stack, shift, depths):
    young_modulus, hardness, thickness = stack
    found = effective_hardness(np.array(depths), young_modulus, hardness, thickness, shift)
    assert (found >= min(hardness) * (1.0 - 1e-14)).all()
    assert (found <= max(hardness) * (1.0 + 1e-14)).all()


def largest_step(function):
    """Change of a function over 1e-9 of the depth, where it changes most: zooms in on a jump."""
    u = np.geomspace(1e-6, 1e6, 4001)
    for _ in range(6):
        steps = np.abs(np.diff(function(u)))
        k = int(steps.argmax())
        u = np.linspace(u[k], u[k + 1], 33)
    return np.abs(np.diff(function(u))).max()


@given(stacks(), SHIFT)
def test_it_has_no_jumps(stack, shift):
    young_modulus, hardness, thickness = stack
    step = largest_step(lambda u: effective_hardness(u, young_modulus, hardness, thickness, shift))
    assert step <= 1e-7 * max(hardness)


def test_a_jump_would_be_seen():
    """The negative control: the rule of the source jumps by 12 % of 2."""
    rule = [1.0, 1.0], [2.0, 1.0], [1.0]
    assert largest_step(lambda u: effective_hardness_literal(u, *rule)) > 0.24


@given(stacks(), SHIFT, st.floats(0.05, 0.95), st.integers(0, 4), st.floats(0.0, 1e3))
def test_a_layer_cut_in_two_stays_the_layer_it_was(stack, shift, fraction, which, u):
    young_modulus, hardness, thickness = stack
    k = which % len(thickness)
    cut = [
        *thickness[:k],
        fraction * thickness[k],
        (1.0 - fraction) * thickness[k],
        *thickness[k + 1 :],
    ]
    doubled = [[*v[: k + 1], *v[k:]] for v in (young_modulus, hardness)]
    whole = effective_hardness(u, young_modulus, hardness, thickness, shift)
    np.testing.assert_allclose(effective_hardness(u, *doubled, cut, shift), whole, rtol=1e-11)


@given(stacks(), SHIFT, st.integers(1, 3), st.floats(0.0, 1e3))
def test_the_top_of_the_substrate_is_substrate(stack, shift, n, u):
    young_modulus, hardness, thickness = stack
    whole = effective_hardness(u, young_modulus, hardness, thickness, shift)
    more = [[*v, *[v[-1]] * n] for v in (young_modulus, hardness)]
    found = effective_hardness(u, *more, [*thickness, *[1.0] * n], shift)
    np.testing.assert_array_equal(found, whole)


@given(stacks(), SHIFT, st.floats(0.0, 1e3))
def test_stiffness_does_not_matter_where_all_is_equally_hard(stack, shift, u):
    young_modulus, hardness, thickness = stack
    found = effective_hardness(u, young_modulus, [hardness[0]] * len(hardness), thickness, shift)
    assert found == pytest.approx(hardness[0], rel=1e-14)


@given(stacks(), SHIFT, st.floats(0.0, 1e3), st.floats(-12.0, 12.0), st.floats(-12.0, 12.0))
def test_only_ratios_matter(stack, shift, u, length_power, pressure_power):
    young_modulus, hardness, thickness = map(np.array, stack)
    length, pressure = 10.0**length_power, 10.0**pressure_power
    one = effective_hardness(u, young_modulus, hardness, thickness, shift)
    two = effective_hardness(
        u * length, young_modulus * pressure, hardness * pressure, thickness * length, shift
    )
    np.testing.assert_allclose(two / pressure, one, rtol=1e-9)


@given(stacks(), SHIFT)
def test_it_takes_a_map_and_each_pixel_for_itself(stack, shift):
    young_modulus, hardness, thickness = stack
    u = np.geomspace(1e-3, 1e2, 12).reshape(3, 4)
    found = effective_hardness(u, young_modulus, hardness, thickness, shift)
    assert found.shape == (3, 4)
    alone = effective_hardness(u[2, 1], young_modulus, hardness, thickness, shift)
    assert found[2, 1] == pytest.approx(alone, rel=1e-13)  # arrays and scalars may round apart


@given(VALUE, VALUE, VALUE, VALUE, st.floats(0.0, 1e3), st.floats(1.0, 2.0))
def test_one_layer_changes_one_way_with_depth(e1, e2, h1, h2, u, factor):
    """Towards the substrate, whatever it is."""
    one, two = layer_on_substrate(np.array([u, u * factor]), e1, e2, h1, h2, 1.0)
    assert (two - one) * (h2 - h1) >= -1e-14 * max(h1, h2) * abs(h2 - h1)
