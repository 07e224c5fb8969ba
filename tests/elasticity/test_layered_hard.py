"""Layered half-spaces that break other formulations, against a reference with 120 digits.

The reference shares nothing with the recursion: it multiplies the propagator of the equations of
one wavenumber, exp(-A x) with (A^2 - 1)^2 = 0, into the compliance and inverts 2 x 2 matrices, in
decimal arithmetic with so many digits that its cancellations do not matter.
"""

from __future__ import annotations

import decimal
from decimal import Decimal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from contactkit.elasticity.depths import default_depths, locate
from contactkit.elasticity.layer_stack import uniform_compliance
from contactkit.elasticity.layered import compliance, normal_symbol
from contactkit.elasticity.layered_fields import plane_states
from contactkit.errors import DescriptionError

pytestmark = pytest.mark.hard

DIGITS = 120


def product(A, B):
    return [
        [sum(a * b for a, b in zip(r, c, strict=True)) for c in zip(*B, strict=True)] for r in A
    ]


def combined(*terms):
    """Sum of numbers times 4 x 4 matrices."""
    return [[sum(k * M[i][j] for k, M in terms) for j in range(4)] for i in range(4)]


UNIT = [[Decimal(int(i == j)) for j in range(4)] for i in range(4)]


def propagator(G, nu, x):
    """exp(-A x) of (alpha U, alpha W, T, S)' = A (...), the derivative by alpha z."""
    k = nu / (1 - nu)
    A = [
        [Decimal(0), Decimal(-1), 1 / G, Decimal(0)],
        [k, Decimal(0), Decimal(0), (1 - 2 * nu) / (2 * G * (1 - nu))],
        [2 * G / (1 - nu), Decimal(0), Decimal(0), -k],
        [Decimal(0), Decimal(0), Decimal(1), Decimal(0)],
    ]
    N = combined((1, product(A, A)), (-1, UNIT))
    grown, fallen = x.exp(), (-x).exp()
    c, s = (grown + fallen) / 2, (fallen - grown) / 2
    return combined((c, UNIT), (s, A), (-x * s / 2, N), ((s + x * c) / 2 * -1, product(A, N)))


def reference(E, nu, h):
    """alpha F11, alpha F12, alpha C, alpha Fs at alpha = 1."""
    E, nu, h = ([Decimal(v) for v in values] for values in (E, nu, h))
    G = [e / (2 * (1 + n)) for e, n in zip(E, nu, strict=True)]
    F = [[(1 - nu[-1]) / G[-1], (1 - 2 * nu[-1]) / (2 * G[-1])]]
    F.append([F[0][1], F[0][0]])
    Fs = 1 / G[-1]
    for j in reversed(range(len(h))):
        P = propagator(G[j], nu[j], h[j])
        state = product(P, [*F, [Decimal(-1), Decimal(0)], [Decimal(0), Decimal(-1)]])
        (a, b), (c, d) = [[-v for v in row] for row in state[2:]]
        det = a * d - b * c
        F = product(state[:2], [[d / det, -b / det], [-c / det, a / det]])
        grown, fallen = h[j].exp(), (-h[j]).exp()
        tanh = (grown - fallen) / (grown + fallen)
        Fs = (Fs + tanh / G[j]) / (1 + Fs * G[j] * tanh)
    return [float(v) for v in (F[0][0], F[0][1], F[1][1], Fs)]


def worst(E, nu, h, alpha=1.0):
    """Largest relative error; of F12 relative to sqrt(F11 F22)."""
    with decimal.localcontext() as context:
        context.prec, context.Emax, context.Emin = DIGITS, decimal.MAX_EMAX, decimal.MIN_EMIN
        exact = np.array(reference(E, nu, [Decimal(v) * Decimal(alpha) for v in h]))
    found = np.array(compliance(alpha, E, nu, h)) * alpha
    scale = exact.copy()
    scale[1] = np.sqrt(exact[0] * exact[2])
    return np.max(np.abs(found - exact) / scale)


def test_the_reference_is_right_where_the_answer_is_known():
    """A layer of the substrate's own material, and the symmetry it does not enforce."""
    with decimal.localcontext() as context:
        context.prec = DIGITS
        exact = reference([1.0, 1.0], [0.25, 0.25], [0.7])
    np.testing.assert_allclose(exact, [1.875, 0.625, 1.875, 2.5], rtol=1e-15)


@given(st.data())
def test_fourteen_digits_for_any_stack(data):
    n = data.draw(st.integers(1, 20))
    ratios = st.one_of(st.just(0.5), st.just(0.4999999), st.floats(-0.95, 0.5))
    E = data.draw(st.lists(st.floats(-6, 6).map(lambda v: 10.0**v), min_size=n + 1, max_size=n + 1))
    nu = data.draw(st.lists(ratios, min_size=n + 1, max_size=n + 1))
    h = data.draw(st.lists(st.floats(-9, 5).map(lambda v: 10.0**v), min_size=n, max_size=n))
    assert worst(E, nu, h) < 1e-14


HARD = {
    "sandwich": ([1e6, 1e-6, 1e6, 1.0], [0.3, 0.5, 0.2, 0.4], [0.01, 1.0, 0.1]),
    "incompressible": ([1.0, 3.0, 1.0], [0.5, 0.5, 0.5], [1e-3, 1.0]),
    "auxetic": ([100.0, 1.0], [-0.95, -0.9], [0.3]),
    "thickness": ([1.0, 50.0, 0.02, 1.0], [0.3, 0.1, 0.45, 0.3], [1e-3, 1.0, 1e3]),
    "film on rubber": ([1e11, 1e6], [0.2, 0.4999], [1e-4]),
    "graded": (np.geomspace(1e3, 1.0, 21), np.full(21, 0.3), np.full(20, 0.05)),
}


@pytest.mark.parametrize("stack", HARD.values(), ids=HARD)
@pytest.mark.parametrize("alpha", [1e-8, 1e-4, 0.1, 0.79, 0.81, 3.0, 37.0, 1e3, 1e5])
def test_fourteen_digits_for_hard_stacks(stack, alpha):
    assert worst(*stack, alpha=alpha) < 1e-14


def test_wavenumbers_to_the_ends_of_the_range():
    """The limits of the substrate and of the top layer, without a nan or a warning."""
    E, nu, h = [4.0, 1.0], [0.3, 0.2], [1e-9]
    alpha = np.array([1e-300, 1e-200, 1e-20, 1e20, 1e200, 1e300])
    with np.errstate(all="raise", under="ignore"):
        found = compliance(alpha, E, nu, h).C * alpha
    np.testing.assert_allclose(found[:3], 2 * 0.96, rtol=1e-14)
    np.testing.assert_allclose(found[3:], 2 * 0.91 / 4, rtol=1e-14)
    thick = compliance(alpha, E, nu, [1e300]).C * alpha
    np.testing.assert_allclose(thick[1:], 2 * 0.91 / 4, rtol=1e-14)
    denormal = compliance(1e-200, E, nu, [1e-120]).C * 1e-200
    assert denormal == pytest.approx(2 * 0.96, rel=1e-14)


def test_a_compliance_beyond_a_double_is_refused():
    with pytest.raises(DescriptionError, match="fits into a double"):
        compliance(5e-324, [1e-3], [0.3], [])


def test_planes_far_below_the_reach_of_a_wave_are_at_rest():
    states = list(plane_states([1.0, 1e3, 1e8], [2.0, 1.0], [0.3, 0.3], [1.0], [0.5, 1.0, 1e9]))
    for one in states:
        assert np.isfinite(one.pressure).all()
    assert np.all(states[-1].pressure == 0.0)
    assert np.all(np.abs(states[0].pressure[:, 1]) < 1e-200)


def test_the_cutoff_leaves_out_what_it_says():
    alpha = np.geomspace(0.01, 100.0, 40)
    stack = [2.0, 1.0], [0.3, 0.4], [1.0]
    every = list(plane_states(alpha, *stack, [0.5, 1.0, 3.0], ["+", "-", "+"]))
    some = list(plane_states(alpha, *stack, [0.5, 1.0, 3.0], ["+", "-", "+"], cutoff=40.0))
    for full, part in zip(every, some, strict=True):
        n = part.pressure.shape[1]
        assert n == np.sum(alpha * part.depth <= 40.0)
        np.testing.assert_array_equal(part.pressure, full.pressure[:, :n])
        assert n == alpha.size or np.abs(full.pressure[2:, n:]).max() < 2e-16


# What is refused ----------------------------------------------------------------------------

NAMES = ("wavenumber", "young_modulus", "poisson_ratio", "thickness")
GOOD = dict(zip(NAMES, (1.0, [2.0, 1.0], [0.3, 0.3], [1.0]), strict=True))
BAD = [
    ("wavenumber", 0.0, "wavenumber must be positive and finite .*uniform_compliance"),
    ("wavenumber", [1.0, -2.0], r"wavenumber must .* got -2\.0"),
    ("wavenumber", np.nan, "wavenumber must be positive"),
    ("wavenumber", np.inf, "wavenumber must be positive"),
    ("young_modulus", [2.0, 0.0], r"young_modulus must be positive and finite \[Pa\]"),
    ("young_modulus", [2.0, np.inf], "young_modulus"),
    ("young_modulus", [2.0], "shape must be .* substrate comes last"),
    ("poisson_ratio", [0.3, 0.51], r"poisson_ratio must lie in \(-1, 0\.5\]"),
    ("poisson_ratio", [-1.0, 0.3], "poisson_ratio"),
    ("poisson_ratio", [0.3, np.nan], "poisson_ratio"),
    ("thickness", [0.0], r"thickness must be positive and finite \[m\]"),
    ("thickness", [np.nan], "thickness"),
    ("thickness", [1.0, 1.0], "shape"),
    ("thickness", 1.0, "shape"),
]


@pytest.mark.parametrize(("name", "value", "message"), BAD)
def test_what_is_impossible_is_refused(name, value, message):
    with pytest.raises(DescriptionError, match=message):
        compliance(**{**GOOD, name: value})


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: normal_symbol((0, 4), (1, 1), [1], [0.3], []), "two positive integers"),
        (lambda: normal_symbol((4, 4), (1, 0), [1], [0.3], []), "two positive lengths"),
        (lambda: uniform_compliance([1], [0.6], []), "poisson_ratio"),
        (lambda: locate([-1.0], "+", []), "zero or positive"),
        (lambda: locate([np.nan], "+", []), "zero or positive"),
        (lambda: locate([1.0], ["x"], []), "below"),
        (lambda: locate([1.0, 2.0], ["+"], []), "one for each depth"),
        (lambda: default_depths([], 0.0), "deepest"),
        (lambda: plane_states([2.0, 1.0], [1], [0.3], [], [0.0]), "ascend"),
        (lambda: plane_states([0.0, 1.0], [1], [0.3], [], [0.0]), "positive"),
        (lambda: plane_states([1.0], [1], [0.3], [], [1.0, 0.0]), "ascend"),
        (lambda: plane_states([1.0], [1, 1], [0.3, 0.3], [1], [1, 1], "+-"), "ascend"),
    ],
)
def test_what_is_impossible_elsewhere_is_refused_too(call, message):
    with pytest.raises(DescriptionError, match=message):
        call()
