"""Layers on a rigid base: closed forms, their limits, and the equations of a layer themselves."""

from __future__ import annotations

from decimal import Decimal, getcontext

import numpy as np
import pytest
import scipy.linalg

from contactkit.elasticity.influence import coefficients, symbol
from contactkit.elasticity.layer_stack import Layers, uniform_compliance
from contactkit.elasticity.layered import compliance, normal_symbol
from contactkit.elasticity.layered_fields import plane_states, unit_stresses
from contactkit.elasticity.stress.planes import planes
from contactkit.elasticity.stress.tractions import Tractions

getcontext().prec = 60
BASES = ("bonded", "frictionless")
E, NU, H = [4.0, 0.5, 1.0], [0.3, 0.45, 0.2], [0.3, 0.5, 0.4]
each_base = pytest.mark.parametrize("base", BASES)


def closed_form(x, nu, base):
    """C E alpha/(2 (1 - nu^2)) of one layer, to sixty digits (Sneddon 1951)."""
    x, nu = Decimal(x), Decimal(nu)
    grown = (2 * x).exp()
    cosh, sinh = (grown + 1 / grown) / 2, (grown - 1 / grown) / 2
    if base == "frictionless":
        return float((cosh - 1) / (sinh + 2 * x))
    a = 3 - 4 * nu
    return float((a * sinh - 2 * x) / (a * cosh + 2 * x * x + 5 - 12 * nu + 8 * nu * nu))


@each_base
@pytest.mark.parametrize("nu", [-0.5, 0.0, 0.3, 0.49, 0.5])
def test_one_layer_has_its_closed_form(base, nu):
    alpha = np.logspace(-7, 3, 21)
    found = compliance(alpha, [2.0], [nu], [1.0], base).C * alpha / (1.0 - nu * nu)
    expected = [closed_form(float(a), nu, base) for a in alpha]
    np.testing.assert_allclose(found, expected, rtol=2e-15)


@each_base
def test_a_thick_solid_is_a_half_space(base):
    on_base, half = compliance(20.0, [2.0], [0.3], [1.0], base), compliance(20.0, [2.0], [0.3], [])
    np.testing.assert_allclose(on_base, half, rtol=1e-13)


def test_long_waves_compress_a_bonded_solid_in_uniaxial_strain():
    limit = uniform_compliance(E, NU, H, "bonded")
    assert pytest.approx(limit, rel=1e-12) == compliance(1e-7, E, NU, H, "bonded").C
    assert uniform_compliance([2.0], [0.3], [1.5], "bonded") == pytest.approx(
        1.3 * 0.4 * 1.5 / (0.7 * 2.0), rel=1e-15
    )


def test_long_waves_let_a_sliding_solid_extend_along_themselves():
    found = compliance(1e-7, [2.0], [0.3], [1.5], "frictionless").C
    assert found == pytest.approx((1.0 - 0.3**2) * 1.5 / 2.0, rel=1e-12)


def test_long_waves_move_an_incompressible_film_like_a_viscous_one():
    alpha = 1e-3
    found = compliance(alpha, [2.0], [0.5], [1.5], "bonded").C
    assert found == pytest.approx(alpha**2 * 1.5**3 / 2.0, rel=1e-5)


def test_a_bonded_base_is_the_limit_of_stiff_substrates():
    alpha = np.logspace(-1, 2, 7)
    on_base = np.array(compliance(alpha, E, NU, H, "bonded"))
    error = [
        np.max(np.abs(np.array(compliance(alpha, [*E, s], [*NU, 0.3], H)) / on_base - 1.0))
        for s in (1e10, 1e12)
    ]
    assert error[1] < 1e-9
    assert error[0] / error[1] == pytest.approx(100.0, rel=0.01)


def test_a_sliding_base_is_a_plane_of_symmetry():
    """Two equal halves pressed alike from both sides: the middle neither shears nor moves."""
    alpha = np.array([0.3, 1.0, 4.0])
    half = compliance(alpha, E, NU, H, "frictionless").C
    for a, C in zip(alpha, half, strict=True):
        y = propagated(float(a), [*zip(E, NU, H, strict=True), *zip(E, NU, H, strict=True)][:3])
        mirror = np.diag([1.0, -1.0, -1.0, 1.0])
        whole = mirror @ np.linalg.inv(y) @ mirror @ y  # back up through the mirrored layers
        top, bottom = np.eye(4), whole
        rows = np.array([top[2], top[3], bottom[2], bottom[3]])
        state = np.linalg.solve(rows, [0.0, -1.0, 0.0, -1.0])
        assert state[1] == pytest.approx(C, rel=1e-9)


def generator(alpha, E, nu):
    """Matrix of the equations (U, W, T, S)' in a layer (physics: equilibrium and Hooke's law)."""
    G = E / (2.0 * (1.0 + nu))
    k = nu / (1.0 - nu)
    return np.array(
        [
            [0.0, -alpha, 1.0 / G, 0.0],
            [k * alpha, 0.0, 0.0, (1.0 - 2.0 * nu) / (2.0 * G * (1.0 - nu))],
            [2.0 * G / (1.0 - nu) * alpha**2, 0.0, 0.0, -k * alpha],
            [0.0, 0.0, alpha, 0.0],
        ]
    )


def propagated(alpha, layers):
    """Matrix from the state at the top to the one at the bottom, by matrix exponentials."""
    total = np.eye(4)
    for E_j, nu_j, h_j in layers:
        total = scipy.linalg.expm(generator(alpha, E_j, nu_j) * h_j) @ total
    return total


def by_exponentials(alpha, base, load):
    """State at the top for a load (T, S) = -load there, from the condition at the base."""
    to_base = propagated(alpha, zip(E, NU, H, strict=True))
    held = to_base[[0, 1]] if base == "bonded" else to_base[[1, 2]]
    top = np.eye(4)[[2, 3]]
    return np.linalg.solve(np.vstack([top, held]), [-load[0], -load[1], 0.0, 0.0])


@each_base
@pytest.mark.parametrize("alpha", [0.05, 0.7, 3.0])
def test_the_surface_obeys_the_equations_of_the_layers(base, alpha):
    found = compliance(alpha, E, NU, H, base)
    pressed, pulled = by_exponentials(alpha, base, (0, 1)), by_exponentials(alpha, base, (1, 0))
    expected = [pulled[0], pulled[1], pressed[1]]
    np.testing.assert_allclose([found.F11, found.F12, found.C], expected, rtol=1e-11)


@each_base
@pytest.mark.parametrize("alpha", [0.05, 0.7, 3.0])
def test_planes_down_to_the_base_obey_the_equations(base, alpha):
    depths, sides = [0.0, 0.1, 0.3, 0.3, 0.6, 0.8, 0.8, 0.9, 1.2], "++-++-+++"
    states = list(plane_states([alpha], E, NU, H, depths, list(sides), base=base))
    tops = np.concatenate([[0.0], np.cumsum(H)])
    for k, load in (("pressure", (0, 1)), ("traction", (1, 0))):
        surface = by_exponentials(alpha, base, load)
        for at in states:
            above = list(zip(E, NU, H, strict=True))[: at.layer]
            rest = (E[at.layer], NU[at.layer], at.depth - tops[at.layer])
            y = propagated(alpha, [*above, rest]) @ surface
            y[:2] *= 2.0 * at.shear_modulus * alpha
            np.testing.assert_allclose(getattr(at, k)[:, 0], y, rtol=1e-10, atol=1e-12)


@each_base
def test_shear_follows_a_string_of_springs(base):
    alpha = 0.7
    value = np.inf if base == "frictionless" else 0.0
    for E_j, nu_j, h_j in reversed(list(zip(E, NU, H, strict=True))):
        G, t = E_j / (2.0 * (1.0 + nu_j)), np.tanh(alpha * h_j)
        fs = G * alpha * value
        value = (1.0 / t if np.isinf(fs) else (fs + t) / (1.0 + fs * t)) / (G * alpha)
    assert compliance(alpha, E, NU, H, base).Fs == pytest.approx(value, rel=1e-14)


@each_base
def test_nothing_crosses_the_base(base):
    """At the base a bonded solid does not move, a sliding one neither sinks nor shears."""
    at = next(plane_states([0.2, 1.0, 30.0], E, NU, H, [1.2], base=base))
    assert at.layer == 2
    rows = [0, 1] if base == "bonded" else [1, 2]
    assert not at.pressure[rows].any()
    assert not at.traction[rows].any()
    assert not at.transverse[0 if base == "bonded" else 1].any()
    near = next(plane_states([0.2, 1.0, 30.0], E, NU, H, [1.2 - 1e-9], base=base))
    np.testing.assert_allclose(near.pressure, at.pressure, rtol=1e-6, atol=1e-7)
    np.testing.assert_allclose(near.transverse, at.transverse, rtol=1e-6, atol=1e-7)


@each_base
@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_elastic_energy_is_positive(base, nu):
    alpha = np.logspace(-6, 3, 19)
    F = compliance(alpha, [1e3, 1.0], [nu, 0.3], [0.01, 1.0], base)
    assert np.all(F.C > 0.0)
    assert np.all(F.Fs > 0.0)
    assert np.all(F.F11 * F.C > F.F12**2)


def test_a_bond_stiffens():
    alpha = np.logspace(-3, 1, 9)
    bonded, sliding = (compliance(alpha, E, NU, H, base).C for base in BASES)
    half = compliance(alpha, [*E, 1.0], [*NU, 0.2], H).C
    assert np.all(bonded < sliding)
    assert np.all(sliding < half)


@each_base
def test_split_layers_are_one(base):
    alpha = np.logspace(-3, 2, 9)
    split = compliance(alpha, [2.0, 2.0], [0.4, 0.4], [0.3, 0.9], base)
    np.testing.assert_allclose(split, compliance(alpha, [2.0], [0.4], [1.2], base), rtol=2e-14)


def test_the_mean_of_a_periodic_map_compresses_the_solid():
    for base in BASES:
        C = normal_symbol((4, 6), (1.0, 1.0), E, NU, H, base)
        assert C[0, 0] == uniform_compliance(E, NU, H, base)
        assert C[0, 1] == pytest.approx(compliance(2 * np.pi / 6, E, NU, H, base).C, rel=1e-14)


@each_base
@pytest.mark.parametrize("h", [3.0, 0.5, 1e-3])
def test_influence_sums_to_the_compliance_for_long_waves(base, h):
    """Coefficients fall exponentially: a uniform pressure far from its edge is a long wave."""
    S = symbol((48, 48), (1.0, 1.0), [2.0], [0.3], [h], base)
    long_wave = compliance(1e-9, [2.0], [0.3], [h], base).C
    assert S[0, 0] == pytest.approx(long_wave, rel=1e-7)
    assert S.min() > 0.0


@each_base
def test_influence_of_a_thick_solid_is_loves_near_the_load(base):
    thick = coefficients((2, 2), (1.0, 1.0), [2.0], [0.3], [1e6], base)
    half = coefficients((2, 2), (1.0, 1.0), [2.0], [0.3], [])
    lowered = half - thick  # what the base at a depth of 1e6 takes away, the same everywhere
    assert np.ptp(lowered) < 1e-11
    assert 0.0 < lowered[0, 0] < 1e-6


def test_influence_falls_with_the_thickness():
    K = coefficients((1, 24), (1.0, 1.0), [2.0], [0.3], [1.0], "bonded")
    assert abs(K[0, 24]) < 1e-9 * K[0, 0]


@each_base
@pytest.mark.parametrize("mean", ["periodic", "free"])
def test_stress_of_a_wide_load_is_that_of_its_compression(base, mean):
    """Under the middle of a wide pressure the solid is compressed between load and base."""
    nu = np.array(NU)
    load = Tractions((8.0, 8.0), np.ones((17, 17)))
    for at in planes(load, Layers(E, NU, H, base), [0.1, 0.5, 1.2], mean=mean):
        ratio = nu[at.layer] / (1.0 - nu[at.layer])
        xx, _, zz, _, xz, _ = at.stress[:, 8, 8]
        assert zz == pytest.approx(-1.0, abs=2e-3)
        assert xz == pytest.approx(0.0, abs=2e-3)
        if mean == "periodic" or base == "bonded":
            assert xx == pytest.approx(-ratio, abs=2e-3)


def test_a_sliding_sheet_is_held_by_what_is_not_loaded():
    """An isolated load: half of the free extension is left, as of an inclusion (Eshelby)."""
    load = Tractions((8.0, 8.0), np.ones((17, 17)))
    found = planes(load, Layers([1.0], [0.3], [1.0], "frictionless"), [0.5], mean="free")
    xx, yy, zz, *_ = next(found).stress[:, 8, 8]
    np.testing.assert_allclose([xx, yy, zz], [-0.15, -0.15, -1.0], atol=2e-3)


def test_a_sliding_solid_under_a_load_on_a_part_is_free_to_extend():
    """Over the whole thickness, the force along a layered sheet is small far from the edge."""
    load = np.zeros((64, 64))
    load[:, 24:40] = 1.0  # a strip, wide against the thickness, in a periodic map
    found = planes(Tractions((1.0, 1.0), load), Layers([1.0], [0.3], [1.0], "frictionless"), [0.5])
    xx, yy = next(found).stress[:2, 32, 32]
    # The mean strain along x of the periodic map is zero: the rest of it gives way.
    mean = -0.3 / 0.7 * load.mean()
    assert xx == pytest.approx(mean, abs=2e-3)
    assert yy == pytest.approx(-0.3 + 0.3 * mean, abs=2e-3)


@each_base
def test_in_plane_stress_follows_from_the_states(base):
    at = next(plane_states([0.7], E, NU, H, [1.2], base=base))
    LL, TT = unit_stresses(at).pressure[:, 0]
    S, U = at.pressure[3, 0], at.pressure[0, 0]
    nu = NU[-1]
    assert pytest.approx((nu * S - U) / (1.0 - nu)) == LL
    assert pytest.approx(nu * (S - U) / (1.0 - nu)) == TT
