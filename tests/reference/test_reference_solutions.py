"""The closed forms to compare with, each checked by another method."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import minimize
from scipy.special import j0

from contactkit.elasticity import layered
from contactkit.reference import (
    flat_punch,
    hamilton,
    hertz,
    layered_wave,
    product_wave,
    westergaard,
)

DATA = json.loads((Path(__file__).parents[1] / "data" / "free_contact.json").read_text())


def root_j2(s):
    xx, yy, zz, xy, xz, yz = s
    apart = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.sqrt(apart / 6 + xy**2 + xz**2 + yz**2)


# Hertz --------------------------------------------------------------------------------------


def test_hertz_pressure_carries_the_load():
    contact = hertz.sphere(3.0, 0.02, 5e9)
    a, p0, _ = contact
    load, _ = quad(
        lambda r: 2 * np.pi * r * hertz.pressure(r, a, p0), 0, a, epsabs=0.0, epsrel=1e-11
    )
    assert load == pytest.approx(3.0, rel=1e-9)


@pytest.mark.parametrize("r", [0.0, 0.5, 1.5, 4.0])
def test_hertz_displacement_is_the_transform_of_its_pressure(r):
    """u = 2/E* int p^(alpha) J0(alpha r) d alpha, of a pressure transformed by quadrature."""
    ends = np.linspace(0.0, 400.0, 801)
    nodes, weights = np.polynomial.legendre.leggauss(16)
    alpha = (ends[:-1, None] + 0.25 * (1 + nodes)).ravel()
    weight = np.tile(0.25 * weights, 800)
    transform = (np.sin(alpha) - alpha * np.cos(alpha)) / alpha**3
    u = 2.0 * np.sum(weight * transform * j0(alpha * r))
    exact = hertz.surface_displacement(r, 1.0, 1.0, 1.0)
    assert float(exact) == pytest.approx(u, abs=1e-4)  # the tail of the transform beyond 400


def test_hertz_follows_the_sphere_and_leaves_it():
    a, p0, approach = hertz.sphere(1.0, 2.0, 3.0)
    r = np.linspace(0.0, 5 * a, 101)
    u = hertz.surface_displacement(r, a, p0, 3.0)
    gap = u - (approach - r**2 / 4.0)
    np.testing.assert_allclose(gap, hertz.gap(r, a, 2.0), atol=1e-13 * approach * 25)
    assert np.all(hertz.gap(r[r > a], a, 2.0) > 0.0)


def test_hertz_load_is_the_slope_of_the_energy():
    """Castigliano: the work of the pressure on its displacement, against the approach."""

    def energy(a, p0):
        def work(r):
            u = float(hertz.surface_displacement(r, a, p0, 1.0))
            return np.pi * r * float(hertz.pressure(r, a, p0)) * u

        return quad(work, 0, a, epsrel=1e-12)[0]

    def total(load):
        a, p0, approach = hertz.sphere(load, 1.0, 1.0)
        return energy(a, p0), approach

    before, after = total(0.999), total(1.001)
    assert (after[0] - before[0]) / (after[1] - before[1]) == pytest.approx(1.0, rel=1e-6)


@pytest.mark.parametrize(
    "row", DATA["hertz_axis_maxima"], ids=lambda row: str(row["poisson_ratio"])
)
def test_hertz_maxima_on_the_axis(row):
    z = np.linspace(0.0, 1.0, 2_001)
    radial, axial = hertz.axis_stress(z, 1.0, 1.0, row["poisson_ratio"])
    shear = 0.5 * np.abs(radial - axial)
    assert shear.max() == pytest.approx(row["tresca"], rel=1e-6)
    assert z[np.argmax(shear)] == pytest.approx(row["depth"], abs=5e-4)
    field = hamilton.stress(0.0, 0.0, z, 1.0, 1.0, row["poisson_ratio"])
    assert root_j2(field).max() == pytest.approx(row["root_j2"], rel=1e-6)
    assert np.sqrt(3) * root_j2(field).max() == pytest.approx(row["von_mises"], rel=1e-6)
    np.testing.assert_allclose(field[0], radial, atol=1e-14)
    np.testing.assert_allclose(field[1], radial, atol=1e-14)
    np.testing.assert_allclose(field[2], axial, atol=1e-14)


# Hamilton -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "row", DATA["sliding_maxima"], ids=lambda r: str(r["friction_coefficient"])
)
def test_largest_stress_under_a_sliding_sphere(row):
    mu = row["friction_coefficient"]

    def minus(place):
        return -float(root_j2(hamilton.stress(place[0], 0.0, abs(place[1]), 1.0, 1.0, 0.3, mu)))

    at = minus((row["x"], row["z"]))
    best = minimize(minus, (row["x"], row["z"]), method="Nelder-Mead", options={"xatol": 1e-9})
    assert -at == pytest.approx(row["root_j2"], rel=2e-7)
    assert -best.fun == pytest.approx(row["root_j2"], rel=2e-7)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("mu", [-0.4, 0.0, 0.25])
def test_surface_carries_pressure_and_friction_and_nothing_outside(nu, mu):
    x, y = np.meshgrid(np.linspace(-2, 2, 21), np.linspace(-2, 2, 21))
    s = hamilton.stress(x, y, 0.0, 1.0, 3.0, nu, mu)
    p = hertz.pressure(np.hypot(x, y), 1.0, 3.0)
    np.testing.assert_allclose(s[2], -p, atol=1e-14)
    np.testing.assert_allclose(s[4], -mu * p, atol=1e-14)
    np.testing.assert_allclose(s[5], 0.0, atol=1e-14)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("mu", [0.0, 0.25, 0.5])
def test_trailing_edge(nu, mu):
    edge = hamilton.stress(-1.0, 0.0, 0.0, 1.0, 2.0, nu, mu)[0]
    assert float(edge) == pytest.approx(hamilton.trailing_edge_stress(2.0, nu, mu), rel=1e-13)


PLACES = np.array(
    [[0.3, 0.2, 0.4], [-0.9, 0.1, 0.1], [1.4, -0.8, 0.3], [0.0, 0.0, 0.6], [1e-5, 0.0, 1.0]]
)
STEP = 1e-3  # errors of the differences below: STEP^4 times derivatives


def around(place, nu, mu):
    """Stresses on a cube of points around a place."""
    offsets = STEP * np.arange(-2, 3)
    x, y, z = np.meshgrid(*(p + offsets for p in place), indexing="ij")
    return hamilton.stress(x, y, z, 1.0, 1.0, nu, mu)


FIRST = np.array([1, -8, 0, 8, -1]) / 12 / STEP
SECOND = np.array([-1, 16, -30, 16, -1]) / 12 / STEP**2
HERE = np.array([0, 0, 1.0, 0, 0])


def derive(field, *weights):
    return np.einsum("...ijk,i,j,k->...", field, *weights)


@pytest.mark.parametrize("place", PLACES, ids=str)
@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_the_field_is_in_equilibrium(place, nu):
    s = around(place, nu, 0.6)
    dx, dy, dz = (
        derive(s, FIRST, HERE, HERE),
        derive(s, HERE, FIRST, HERE),
        derive(s, HERE, HERE, FIRST),
    )
    xx, yy, zz, xy, xz, yz = range(6)
    assert dx[xx] + dy[xy] + dz[xz] == pytest.approx(0.0, abs=1e-7)
    assert dx[xy] + dy[yy] + dz[yz] == pytest.approx(0.0, abs=1e-7)
    assert dx[xz] + dy[yz] + dz[zz] == pytest.approx(0.0, abs=1e-7)


@pytest.mark.parametrize("place", PLACES, ids=str)
@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_the_field_belongs_to_displacements(place, nu):
    """Compatibility after Beltrami and Michell: the Laplacian of the stress and its trace."""
    s = around(place, nu, 0.6)
    trace = s[0] + s[1] + s[2]
    laplacian = (
        derive(s, SECOND, HERE, HERE)
        + derive(s, HERE, SECOND, HERE)
        + derive(s, HERE, HERE, SECOND)
    )
    hessian = [
        derive(trace, SECOND, HERE, HERE),
        derive(trace, HERE, SECOND, HERE),
        derive(trace, HERE, HERE, SECOND),
        derive(trace, FIRST, FIRST, HERE),
        derive(trace, FIRST, HERE, FIRST),
        derive(trace, HERE, FIRST, FIRST),
    ]
    defect = (1 + nu) * laplacian + hessian
    np.testing.assert_allclose(defect, 0.0, atol=1e-5 * max(1.0, np.abs(hessian).max()))


@pytest.mark.parametrize("z", [0.3, 2.0])
def test_a_plane_under_the_contact_carries_load_and_friction(z):
    """Integrals over a disc of radius 200: what is left beyond falls like its inverse."""
    t = np.linspace(0.0, np.log1p(200.0), 4_001)
    r, theta = np.expm1(t), (np.arange(32) + 0.5) * np.pi / 16
    s = hamilton.stress(
        r[:, None] * np.cos(theta), r[:, None] * np.sin(theta), z, 1.0, 1.0, 0.3, 0.5
    )
    ring = 2 * np.pi * r * (1 + r) * s.mean(axis=-1)
    totals = t[1] * (ring.sum(axis=-1) - 0.5 * ring[..., -1])  # the ring at zero is empty
    assert totals[2] == pytest.approx(-2 * np.pi / 3, rel=1e-3)
    assert totals[4] == pytest.approx(-np.pi / 3, rel=2e-2)


# Punch --------------------------------------------------------------------------------------


def test_the_punch_carries_its_load():
    load, _ = quad(
        lambda t: 2 * np.pi * np.sin(t) * np.cos(t) * flat_punch.pressure(np.sin(t), 3.0, 1.0),
        0,
        np.pi / 2,
    )
    assert load == pytest.approx(3.0, rel=1e-9)
    assert float(flat_punch.pressure(1.0, 3.0, 1.0)) == np.inf


def test_the_punch_displaces_evenly():
    """u(0) = 1/(pi E*) int p / r dA over the disc, with r = a sin t."""
    integral, _ = quad(
        lambda t: 2 * np.pi * np.cos(t) * flat_punch.pressure(2.0 * np.sin(t), 3.0, 2.0) * 2.0,
        0,
        np.pi / 2,
    )
    assert integral / (np.pi * 5.0) == pytest.approx(flat_punch.approach(3.0, 2.0, 5.0), rel=1e-9)
    far = float(flat_punch.surface_displacement(1e5, 3.0, 2.0, 5.0))
    assert far == pytest.approx(3.0 / (np.pi * 5.0 * 1e5), rel=1e-9)  # Boussinesq


def test_a_sphere_is_a_growing_punch():
    """dP / d approach = 2 a E*, for any axisymmetric contact."""
    loads = np.array([1.0, 1.0 + 1e-6])
    contacts = [hertz.sphere(p, 3.0, 2.0) for p in loads]
    stiffness = 1e-6 / (contacts[1].approach - contacts[0].approach)
    a = contacts[0].contact_radius
    assert stiffness == pytest.approx(1.0 / flat_punch.approach(1.0, a, 2.0), rel=1e-5)


# Waves --------------------------------------------------------------------------------------


@pytest.mark.parametrize("row", DATA["westergaard"], ids=lambda row: str(row["half_width"]))
def test_westergaard_against_the_table(row):
    full = westergaard.full_contact_pressure(1.0, 1.0, 1.0)
    ratio = row["mean_pressure"] / full
    assert westergaard.half_width(ratio, 1.0) == pytest.approx(row["half_width"], rel=1e-12)
    assert westergaard.mean_gap(ratio, 1.0) == pytest.approx(row["mean_gap"], rel=1e-9)
    peak = westergaard.pressure(0.0, row["mean_pressure"], full, 1.0)
    assert float(peak) == pytest.approx(row["peak"], rel=1e-12)


@pytest.mark.parametrize("ratio", [0.1, 0.5, 0.9, 1.0, 1.3])
def test_westergaard_pressure_solves_the_contact(ratio):
    """Its displacement, C(alpha) = 2/(E* alpha) mode by mode, fits the wave where they touch."""
    n, full = 1 << 14, np.pi
    x = (np.arange(n) + 0.5) / n
    p = westergaard.pressure(x, ratio * full, full, 1.0)
    assert p.mean() == pytest.approx(ratio * full, rel=1e-5)
    alpha = 2 * np.pi * np.arange(n // 2 + 1) * 1.0
    symbol = np.concatenate(([0.0], 2.0 / alpha[1:]))
    gap = np.fft.irfft(symbol * np.fft.rfft(p)) + 1.0 - np.cos(2 * np.pi * x)
    gap -= gap[p > 0].mean()
    assert np.abs(gap[p > 0]).max() < 1e-4
    assert gap.min() > -1e-4
    assert gap.mean() == pytest.approx(westergaard.mean_gap(ratio, 1.0), abs=1e-4)


def test_product_wave_under_light_load_is_hertz():
    """Two spheres of radius l^2 / (4 pi^2 D) in each cell, each under half of its load."""
    amplitude, wavelength, modulus, ratio = 0.01, 2.0, 3.0, 1e-4
    mean = ratio * product_wave.full_contact_pressure(amplitude, wavelength, modulus)
    radius = wavelength**2 / (4 * np.pi**2 * amplitude)
    a = hertz.sphere(0.5 * mean * wavelength**2, radius, modulus).contact_radius
    fraction = 2 * np.pi * a**2 / wavelength**2
    assert product_wave.area_under_light_load(ratio) == pytest.approx(fraction, rel=1e-12)
    assert product_wave.area_near_full_contact(1.2) == 1.0


def test_full_contact_pressures_are_amplitude_over_compliance():
    """The product of two waves of one period is a wave of sqrt 2 times the wavenumber."""
    one = westergaard.full_contact_pressure(1.0, 1.0, 1.0 / 0.91)
    two = product_wave.full_contact_pressure(1.0, 1.0, 1.0 / 0.91)
    stack = ([1.0, 1.0], [0.3, 0.3], [0.2])
    wave = 2 * np.pi
    assert layered_wave.full_contact_pressure(1.0, wave, *stack) == pytest.approx(one, rel=1e-10)
    oblique = layered_wave.full_contact_pressure(1.0, np.sqrt(2) * wave, *stack)
    assert oblique == pytest.approx(two, rel=1e-10)


def test_full_contact_on_a_layer():
    case = DATA["layered_wave"]
    stack = (case["young_modulus"], case["poisson_ratio"], case["thickness"])
    p = layered_wave.full_contact_pressure(1.0, 2 * np.pi, *stack)
    assert p == pytest.approx(case["full_contact_pressure"], rel=1e-10)


@pytest.mark.parametrize("wave", [1e-3, 0.3, 3.0, 30.0])
@pytest.mark.parametrize(
    "stack",
    [
        ([1e6, 1.0], [0.2, 0.4], [1.0]),
        ([1e-6, 1.0], [0.5, 0.3], [1.0]),
        ([100.0, 50.0, 100.0], [0.3, 0.2, 0.45], [1.0, 0.3]),
    ],
)
def test_equations_of_elasticity_integrated_over_the_depth(wave, stack):
    """The compliance of the engine, which climbs in closed form, against the integration."""
    expected = layered_wave.compliance(wave, *stack)
    c = layered.compliance(np.array([wave]), *(np.array(v) for v in stack)).C[0]
    assert float(c) == pytest.approx(expected, rel=1e-9)
