"""What holds of influence coefficients whatever the stack, the pixels and the window."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigvalsh

from contactkit.elasticity import influence as free_kernel
from contactkit.elasticity import love

modulus = st.floats(-3.0, 3.0).map(lambda exponent: 10.0**exponent)
ratio = st.floats(-0.5, 0.5)
length = st.floats(-2.0, 2.0).map(lambda exponent: 10.0**exponent)
stacks = st.integers(1, 3).flatmap(
    lambda n: st.tuples(
        st.lists(modulus, min_size=n + 1, max_size=n + 1),
        st.lists(ratio, min_size=n + 1, max_size=n + 1),
        st.lists(length, min_size=n, max_size=n),
    )
)
pixels = st.tuples(st.floats(0.5, 2.0), st.floats(0.5, 2.0))
modest = settings(max_examples=12)


def matrix(k):
    """The full matrix of a window of n by n pixels from its coefficients."""
    n = k.shape[0] - 1
    row, column = np.divmod(np.arange(n * n), n)
    return k[np.abs(row[:, None] - row), np.abs(column[:, None] - column)]


@modest
@given(stacks, pixels)
def test_the_energy_of_any_pressure_is_positive(stack, pixel):
    values = eigvalsh(matrix(free_kernel.coefficients((6, 6), pixel, *stack)))
    assert values[0] > 0.0


@modest
@given(pixels, st.booleans())
def test_the_energy_on_a_half_space_is_positive(pixel, average):
    dy, dx = pixel
    i = np.arange(8)
    k = love.rectangle(i * dx, i[:, None] * dy, dx / 2, dy / 2, 1.0, average=average)
    assert eigvalsh(matrix(np.pad(k, ((0, 1), (0, 1)))))[0] > 0.05 * k[0, 0]


@modest
@given(stacks, pixels)
def test_turning_the_pixels_turns_the_coefficients(stack, pixel):
    k = free_kernel.coefficients((7, 12), pixel, *stack)
    turned = free_kernel.coefficients((12, 7), pixel[::-1], *stack)
    np.testing.assert_allclose(turned.T, k, rtol=0, atol=1e-12 * k[0, 0])


@modest
@given(stacks, st.floats(0.1, 10.0), st.floats(0.1, 10.0))
def test_lengths_and_moduli_scale(stack, stretch, harden):
    """u / p has the unit of length over modulus; 1e-9 of the centre."""
    young, nu, thickness = (np.array(values) for values in stack)
    k = free_kernel.coefficients((8, 8), (1.0, 1.3), young, nu, thickness)
    scaled = free_kernel.coefficients(
        (8, 8), (stretch, 1.3 * stretch), harden * young, nu, stretch * thickness
    )
    np.testing.assert_allclose(scaled * harden / stretch, k, rtol=0, atol=1e-9 * k[0, 0])


@modest
@given(stacks, st.integers(0, 3), st.floats(1.1, 100.0))
def test_a_stiffer_material_gives_way_less(stack, which, factor):
    """In energy, for a smooth pressure; only of means over cells would it hold for any."""
    young, nu, thickness = (np.array(values) for values in stack)
    stiffer = young.copy()
    stiffer[which % young.size] *= factor
    soft = matrix(free_kernel.coefficients((12, 12), (1.0, 1.0), young, nu, thickness))
    hard = matrix(free_kernel.coefficients((12, 12), (1.0, 1.0), stiffer, nu, thickness))
    i = np.arange(12) - 5.5
    pressure = np.exp(-0.5 * (i**2 + i[:, None] ** 2) / 2.0**2).ravel()
    assert pressure @ (soft - hard) @ pressure > -1e-9 * pressure @ soft @ pressure


@modest
@given(stacks)
def test_four_pixels_make_one(stack):
    """A pixel of twice the side at a distance is four; the window of the coarse grid fits."""
    fine = free_kernel.coefficients((16, 16), (1.0, 1.0), *stack)
    coarse = free_kernel.coefficients((8, 8), (2.0, 2.0), *stack)
    # The centre of the coarse pixel is a corner of the fine ones: compare areas of pressure seen
    # from there with pixels of a third of the side instead.
    third = free_kernel.coefficients((24, 24), (2.0 / 3.0, 2.0 / 3.0), *stack)
    i, j = 5, 3
    parts = third[3 * i - 1 : 3 * i + 2, 3 * j - 1 : 3 * j + 2]
    assert parts.sum() == pytest.approx(coarse[i, j], abs=1e-10 * fine[0, 0])


@modest
@given(st.floats(-50.0, 50.0), st.floats(-50.0, 50.0), st.floats(0.0, 10.0), st.booleans())
def test_love_is_even(x, y, c, average):
    values = [
        float(love.rectangle(i * x, j * y, 1.0, 0.3, 1.0, c, average))
        for i in (-1, 1)
        for j in (-1, 1)
    ]
    assert len(set(values)) == 1
    assert values[0] > 0.0
