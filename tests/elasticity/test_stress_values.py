"""Stresses at depth against Hertz, layered spheres, equilibrium and reciprocity."""

from __future__ import annotations

import functools

import numpy as np
import pytest
from numpy.polynomial import polynomial
from scipy.interpolate import RectBivariateSpline
from selection import quick

from contactkit.benchmarks.references.tables import reference
from contactkit.elasticity.layer_stack import Layers
from contactkit.elasticity.stress.maxima import (
    DepthSearch,
    Maximum,
    maxima,
    plane_maxima,
    plane_maximum,
)
from contactkit.elasticity.stress.measures import (
    max_principal_stress,
    principal_stresses,
    sqrt_j2,
    tresca,
    von_mises,
)
from contactkit.elasticity.stress.planes import Plane, planes
from contactkit.elasticity.stress.tractions import Tractions, traction_coupling
from contactkit.errors import DescriptionError

DATA = reference("layered")
MEASURES = {"sqrt_j2": sqrt_j2, "von_mises": von_mises, "tresca": tresca}
HALF = Layers([1.0], [0.3])
STACK = Layers([4.0, 0.5, 1.0], [0.3, 0.4, 0.2], [0.3, 0.5])


def sphere(count, width, radius=1.0, shape=(1.0,)):
    """Pressure sqrt(1 - r^2) times a polynomial in r^2, its points and its pixel."""
    x = (np.arange(count) - count // 2) * width / count
    r2 = (x**2 + x[:, None] ** 2) / radius**2
    root = np.sqrt(np.clip(1 - r2, 0, None))
    return np.where(r2 < 1, polynomial.polyval(r2, shape) * root, 0.0), x, (width / count,) * 2


# Hertz --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "row", quick(DATA["hertz_axis_maxima"]["rows"], 0, 3, 7), ids=lambda row: f"nu={row[0]}"
)
def test_largest_stresses_under_a_hertzian_pressure(row):
    nu, z, *expected = row
    pressure, _, pixel = sphere(96, 2.4)
    depths = z + np.linspace(-0.02, 0.02, 5)
    below = planes(Tractions(pixel, pressure), Layers([1.0], [nu]), depths, mean="free")
    found = maxima(below, MEASURES, pixel)
    for name, value in zip(MEASURES, expected, strict=True):
        assert found[name].value == pytest.approx(value, rel=2e-4)
        assert found[name].z == pytest.approx(z, abs=3e-3)
        assert (found[name].x, found[name].y) == (48 * pixel[0], 48 * pixel[0])


def test_trailing_edge_of_a_sliding_sphere():
    """Largest tension at x = -a, (1 - 2 nu)/3 + (4 + nu) pi mu/8.

    It falls off as a square root of the distance, so a map reaches it as the root of its pixel.
    """
    exact, errors = 0.4 / 3 + 4.3 * np.pi / 16, []
    for count in (80, 320):
        pressure, _, pixel = sphere(count, 2.4)
        load = Tractions(pixel, pressure, 0.5 * pressure)
        surface = next(planes(load, HALF, [0.0], mean="free"))
        found = plane_maximum(max_principal_stress(surface.stress), pixel, 0.0, "+", 0)
        assert found.x - 1.2 == pytest.approx(-1.0, abs=1.5 * pixel[1])
        assert found.y == pytest.approx(1.2, abs=0.2)
        errors.append(1 - found.value / exact)
    assert 0.0 < errors[1] < 0.05
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.3)


@pytest.mark.parametrize(
    "case",
    quick(DATA["spheres"], 0, long=[1, 2, 3]),
    ids=[case["name"] for case in DATA["spheres"]],
)
def test_stress_under_a_sphere_on_layers(case):
    """Points of an axisymmetric solver, with friction; pressure by its five values."""
    a, r = case["a"], np.array(case["r/a"])
    even = polynomial.polyfit(r**2, np.array(case["p"]) / np.sqrt(1 - r**2), 4)
    pressure, x, pixel = sphere(128, 2.4 * a, a, even)
    stack = Layers(case["young_modulus"], case["poisson_ratio"], case["thickness"])
    inside = [s for s in case["samples"] if s[0] > 0.2 and max(abs(s[2]), abs(s[3])) < x[-1]]
    assert len(inside) >= 5

    @functools.cache
    def stresses(z, side, mu):
        load = Tractions(pixel, pressure, mu * pressure)
        (plane,) = planes(load, stack, [z], side, mean="free")
        return [RectBivariateSpline(x, x, one) for one in plane.stress]

    for z, side, px, py, mu, *expected in inside:
        found = [one(py, px)[0, 0] for one in stresses(z, side, mu)]
        assert np.abs(np.array(found) - expected).max() < 5e-5


@pytest.mark.parametrize(
    "case",
    quick(DATA["spheres"], 0, 2, long=[1, 3]),
    ids=[case["name"] for case in DATA["spheres"]],
)
def test_largest_stress_under_a_sphere_on_layers(case):
    a, r = case["a"], np.array(case["r/a"])
    even = polynomial.polyfit(r**2, np.array(case["p"]) / np.sqrt(1 - r**2), 4)
    pressure, _, pixel = sphere(96, 2.4 * a, a, even)
    stack = Layers(case["young_modulus"], case["poisson_ratio"], case["thickness"])
    faces = [(z, side) for z in np.cumsum(case["thickness"]) for side in "-+"]
    z = case["z"]
    near = [] if any(abs(z - f) < 1e-9 for f, _ in faces) else [(z * s, "+") for s in (0.9, 1, 1.1)]
    chosen = sorted(faces + near, key=lambda plane: (plane[0], plane[1] == "+"))
    depths, sides = zip(*chosen, strict=True)
    below = planes(Tractions(pixel, pressure), stack, depths, sides, mean="free")
    found = maxima(below, {"sqrt_j2": sqrt_j2}, pixel)["sqrt_j2"]
    assert found.value == pytest.approx(case["largest_sqrt_j2"], rel=1e-3)
    assert (found.layer, found.z) == (case["layer"], pytest.approx(z))


# Maps ---------------------------------------------------------------------------------------


def rough(shape, seed=1):
    return np.random.default_rng(seed).uniform(0.0, 1.0, shape)


@pytest.mark.parametrize("shape", [(8, 8), (7, 9), (1, 12), (6, 5)])
def test_the_surface_carries_the_tractions_and_every_plane_their_sum(shape):
    p, qx, qy = (rough(shape, seed) for seed in range(3))
    deep = planes(
        Tractions((0.3, 0.2), p, qx, qy), STACK, [0.0, 0.3, 0.3, 2.0], ["+", "-", "+", "+"]
    )
    for plane in deep:
        for k, load in ((2, p), (4, qx), (5, qy)):
            assert plane.stress[k].mean() == pytest.approx(-load.mean(), rel=1e-13)
            if plane.depth == 0.0:
                # the mode that alternates from pixel to pixel has no odd part, and loses none here
                np.testing.assert_allclose(plane.stress[k], -load, rtol=0, atol=2e-14)


def test_a_uniform_pressure_lets_no_layer_strain_sideways():
    nu = STACK.poisson_ratio
    p, q = np.full((4, 6), 2.0), np.full((4, 6), 0.5)
    for plane in planes(Tractions((1.0, 1.0), p, q), STACK, [0.1, 0.5, 3.0]):
        lateral = -nu[plane.layer] / (1 - nu[plane.layer]) * 2.0
        uniform = [lateral, lateral, -2.0, 0.0, -0.5, 0.0]
        np.testing.assert_allclose(plane.stress.mean(axis=(1, 2)), uniform, atol=1e-15)
        assert np.ptp(plane.stress, axis=(1, 2)).max() < 1e-14


def test_exchanging_x_and_y_exchanges_the_components():
    p, q = rough((6, 9)), rough((6, 9), 2)
    (one,) = planes(Tractions((0.2, 0.3), p, q), STACK, [0.25], displacement=True)
    (two,) = planes(Tractions((0.3, 0.2), p.T, y=q.T), STACK, [0.25], displacement=True)
    swapped = two.stress[[1, 0, 2, 3, 5, 4]].transpose(0, 2, 1)
    np.testing.assert_allclose(one.stress, swapped, rtol=0, atol=1e-14)
    moved = two.displacement[[1, 0, 2]].transpose(0, 2, 1)
    np.testing.assert_allclose(one.displacement, moved, rtol=0, atol=1e-14)


def test_tractions_are_continuous_and_lateral_stresses_jump():
    above, below = planes(Tractions((0.1, 0.1), rough((16, 16))), STACK, [0.3, 0.3], ["-", "+"])
    assert (above.layer, below.layer) == (0, 1)
    np.testing.assert_allclose(above.stress[[2, 4, 5]], below.stress[[2, 4, 5]], atol=1e-14)
    assert np.abs(above.stress[0] - below.stress[0]).max() > 0.1


def test_stresses_balance_inside_of_a_layer():
    """div sigma = 0 by differences in z and by the transform in x and y."""
    n, pixel, d = 16, 0.1, 1e-3
    p, q = rough((n, n)), rough((n, n), 3)
    z = 0.15 + d * np.arange(-2, 3)
    stress = np.array([pl.stress for pl in planes(Tractions((pixel, pixel), p, q), STACK, z)])
    along_z = np.tensordot([1, -8, 0, 8, -1], stress, 1) / (12 * d)
    k = 2j * np.pi * np.fft.fftfreq(n, pixel)
    k[n // 2] = 0.0

    def slope(k_component, axis):
        shape = (-1, 1) if axis == 0 else (1, -1)
        return np.fft.ifft2(np.fft.fft2(stress[2, k_component]) * k.reshape(shape)).real

    rows = [(0, 3, 4), (3, 1, 5), (4, 5, 2)]
    for xs, ys, zs in rows:
        rest = slope(xs, 1) + slope(ys, 0) + along_z[zs]
        # rows and columns of the alternating mode are not differentiated: leave them out
        clean = np.fft.fft2(rest)
        clean[n // 2], clean[:, n // 2] = 0.0, 0.0
        assert np.abs(np.fft.ifft2(clean)).max() < 1e-7 * np.abs(along_z).max()


def test_reciprocity_of_pressure_and_traction():
    """Betti: the work of a pressure on what a traction does is that of the traction on its own."""
    shape, pixel = (9, 7), (0.2, 0.3)  # odd: no alternating mode
    p, qx, qy = (rough(shape, seed) for seed in range(3))
    (surface,) = planes(Tractions(pixel, p), STACK, [0.0], displacement=True)
    pushed = traction_coupling(shape, pixel, STACK)(qx, qy)
    work = np.sum(surface.displacement[0] * qx + surface.displacement[1] * qy)
    assert np.sum(p * pushed) == pytest.approx(work, rel=1e-12)
    (dragged,) = planes(Tractions(pixel, None, qx, qy), STACK, [0.0], displacement=True)
    np.testing.assert_allclose(dragged.displacement[2], pushed, rtol=0, atol=1e-14)


def test_nothing_is_pushed_by_tractions_on_an_incompressible_half_space():
    pushed = traction_coupling((8, 8), (1.0, 1.0), Layers([1.0], [0.5]))(rough((8, 8)), None)
    assert np.abs(pushed).max() < 1e-16


def test_a_load_that_acts_once_feels_no_repetition():
    """The coarse steps do what a window of zeros as wide does, which is hardly affordable."""
    x = (np.arange(24) - 11.5) * 0.1
    y = x[:, None]
    p = np.exp(-20 * (x**2 + y**2)) * (1 + x)
    q = np.exp(-20 * ((x - 0.1) ** 2 + (y + 0.1) ** 2))
    pixel, args = (0.1, 0.1), (STACK, [0.3, 0.9], ["-", "+"])
    far = planes(Tractions(pixel, p, q), *args, mean="free", padding=8.0)
    near = planes(Tractions(pixel, p, q), *args, mean="free", padding=4.0)
    wide = np.zeros((2, 192, 192))
    wide[:, :24, :24] = p, q
    direct = planes(Tractions(pixel, *wide), *args, mean="free", padding=1.0)
    for a, b, c in zip(far, near, direct, strict=True):
        exact = c.stress[:, :24, :24]
        assert np.abs(a.stress - exact).max() < 1e-8
        assert np.abs(b.stress - exact).max() > 1e-4


def test_the_push_of_a_single_traction_is_that_of_cerruti():
    """uz = (1 + nu)(1 - 2 nu)/(2 pi E) Q x/r^2 of each force, from afar."""
    weights = np.outer([1, 4, 6, 4, 1], [1, 4, 6, 4, 1]) / 256
    q = np.zeros((33, 33))
    q[14:19, 3:8] = weights
    pixel = 0.5
    found = traction_coupling(q.shape, (pixel, pixel), HALF, mean="free")(q, None)
    i = np.arange(-2, 3)
    x = (np.arange(12, 33)[:, None, None] - 5 - i) * pixel
    forces = weights * pixel**2 * x / (x**2 + (i[:, None] * pixel) ** 2)
    expected = 1.3 * 0.4 / (2 * np.pi) * forces.sum(axis=(1, 2))
    np.testing.assert_allclose(found[16, 12:], expected, rtol=1e-3)


# Measures -----------------------------------------------------------------------------------


def turned(values, seed=0, count=500):
    """Stresses of given principal values in random directions."""
    turn = np.linalg.qr(np.random.default_rng(seed).normal(size=(count, 3, 3)))[0]
    full = (turn * np.asarray(values)) @ turn.transpose(0, 2, 1)
    i, j = [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]
    return full[:, i, j].T


@pytest.mark.parametrize("gap", [0.0, 1e-15, 1e-12, 1e-8, 1e-4, 1.0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_principal_stresses_that_are_nearly_equal(gap, sign):
    values = np.sort(sign * np.array([1.0 + gap, 1.0, -2.0]))[::-1]
    stress = turned(values)
    found = principal_stresses(stress)
    np.testing.assert_allclose(found, np.tile(values[:, None], (1, 500)), rtol=0, atol=5e-15)
    np.testing.assert_allclose(tresca(stress), (values[0] - values[2]) / 2, rtol=4e-15)
    np.testing.assert_allclose(max_principal_stress(stress), values[0], rtol=0, atol=5e-15)
    j2 = np.sum((values - values.mean()) ** 2) / 2
    np.testing.assert_allclose(sqrt_j2(stress), np.sqrt(j2), rtol=4e-15)
    np.testing.assert_allclose(von_mises(stress), np.sqrt(3 * j2), rtol=4e-15)


def test_principal_stresses_of_any_tensor():
    stress = np.random.default_rng(4).normal(size=(6, 30, 40)) * np.array(1e9)
    full = stress[[0, 3, 4, 3, 1, 5, 4, 5, 2]].reshape(3, 3, -1).transpose(2, 0, 1)
    expected = np.linalg.eigvalsh(full)[:, ::-1].T.reshape(3, 30, 40)
    np.testing.assert_allclose(principal_stresses(stress), expected, rtol=0, atol=2e-5)


def test_a_hydrostatic_stress_has_no_shear():
    stress = np.zeros((6, 2, 2))
    stress[:3] = -3e9
    assert np.all(principal_stresses(stress) == -3e9)
    assert np.all(tresca(stress) == 0.0)


def test_the_maxima_of_a_plane_are_those_of_all_its_points():
    """Principal stresses are evaluated at a few points only."""
    rng = np.random.default_rng(5)
    for _ in range(5):
        stress, dragged = rng.normal(size=(2, 6, 40, 60)) * rng.uniform(0.2, 3.0, (2, 6, 1, 1))
        plane = Plane(1.0, "+", 0, stress, None, dragged)
        sliding = (0.0, 0.3, -0.2)
        for mu, found in zip(sliding, plane_maxima(plane, (0.5, 0.25), sliding), strict=True):
            total = stress + mu * dragged
            measures = {
                "von_mises": von_mises,
                "tension": max_principal_stress,
                "tresca": tresca,
                "sigma_xz": lambda one: np.abs(one[4]),
            }
            for name, measure in measures.items():
                expected = plane_maximum(measure(total), (0.5, 0.25), 1.0, "+", 0)
                assert found[name].value == pytest.approx(expected.value, rel=1e-13), name
                assert found[name][1:6] == expected[1:6], name


def test_the_maxima_of_a_plane_without_shear_are_there():
    stress = np.zeros((6, 3, 4))
    stress[:3] = -2e9
    (found,) = plane_maxima(Plane(0.0, "+", 0, stress), (1.0, 1.0))
    assert found["tension"].value == -2e9
    assert found["tresca"].value == found["von_mises"].value == 0.0


# Over depth ---------------------------------------------------------------------------------


def peak(z, value, layer=0, side="+"):
    return Maximum(value, 0.0, 0.0, z, side, layer)


def searched(curve, depths, tolerance, layers=(), deepest=4.0):
    """Search for the maximum of a curve; returns it with all depths that were evaluated."""
    search, tried = DepthSearch(tolerance, deepest), []
    while depths:
        for z in depths:
            layer = sum(z > bottom for bottom in layers)
            search.add("curve", peak(z, curve(z), layer))
        tried += depths
        depths = search.missing()
        assert len(tried) < 60
    return search.best("curve"), tried


@pytest.mark.parametrize("tolerance", [0.05, 1e-2, 1e-3, 1e-4])
@pytest.mark.parametrize("place", [0.03, 0.11, 0.4, 0.9, 3.3])
def test_planes_are_added_until_a_maximum_between_them_stands(place, tolerance):
    def curve(z):
        return z / place * np.exp(1.0 - z / place)

    best, tried = searched(curve, [0.0, 0.05, 0.2, 0.5, 1.0], tolerance)
    assert best.value == max(curve(z) for z in tried)  # never more than a plane has
    assert 1.0 - 2.0 * tolerance <= best.value <= 1.0
    assert best.error <= tolerance
    assert best.z == pytest.approx(place, rel=2.0 * tolerance**0.5)


def test_a_maximum_on_the_surface_needs_no_more_planes():
    best, tried = searched(lambda z: np.exp(-z), [0.0, 0.25, 0.5, 1.0, 2.0], 1e-3)
    assert (best.z, best.value, best.error) == (0.0, 1.0, 0.0)
    assert tried == [0.0, 0.25, 0.5, 1.0, 2.0]


def test_the_parabola_of_distant_planes_is_no_maximum():
    """Planes of the issue: 0.418, 1.039, 0.859, 0.406 at 0, 8.7, 34.7 and 78 nm gave 1.34."""
    search = DepthSearch(0.01, 1e-6)
    for z, value in ((0.0, 0.418), (8.7e-9, 1.039), (34.7e-9, 0.859), (78e-9, 0.406)):
        search.add("von_mises", peak(z, value))
    best = search.best("von_mises")
    assert best.value == 1.039
    assert best.error > 0.2  # and that is what such planes are worth
    assert search.missing() == [pytest.approx(21.7e-9)]


def test_each_layer_is_searched_on_its_own():
    search = DepthSearch(0.01, 1.0)
    for z, layer, value in ((0.0, 0, 1.0), (0.5, 0, 3.0), (0.5, 1, 1.0), (1.0, 1, 1.2)):
        search.add("shear", peak(z, value, layer))
    search.add("shear", peak(0.25, 2.0))
    best = search.best("shear")
    assert (best.value, best.z, best.layer) == (3.0, 0.5, 0)
    assert search.missing() == [0.375]  # above the face; not below, where 1.0 is another layer


def test_nothing_is_searched_below_the_deepest_plane_allowed():
    best, tried = searched(lambda z: 1.0, [0.0, 0.5, 1.0], 0.1, deepest=3.0)
    assert (best.value, max(tried)) == (1.0, 3.0)
    assert searched(lambda z: 0.0, [0.0, 1.0], 0.1)[0].error == 0.0


# What is refused ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"pressure": None}, "at least one map"),
        ({"pressure": np.ones(4)}, "shape"),
        ({"x": np.ones((2, 2))}, "share one shape"),
        ({"pressure": np.full((4, 4), np.nan)}, "finite"),
        ({"pixel_size": (1.0, 0.0)}, "two positive lengths"),
        ({"mean": "none"}, '"periodic", "free"'),
        ({"mean": "free", "padding": 0.5}, "padding must be 1 or more"),
        ({"mean": "free", "displacement": True}, "displacement must be False"),
        ({"depths": [-1.0]}, "zero or positive"),
        ({"poisson_ratio": [0.7]}, "poisson_ratio"),
    ],
)
def test_what_is_impossible_is_refused_before_anything_is_computed(change, message):
    load = {"pixel_size": (1.0, 1.0), "pressure": np.ones((4, 4))}
    load |= {name: value for name, value in change.items() if name in Tractions._fields}
    layers = {"young_modulus": [1.0], "poisson_ratio": [0.3]}
    layers |= {name: value for name, value in change.items() if name in Layers._fields}
    more = {n: v for n, v in change.items() if n not in Tractions._fields + Layers._fields}
    with pytest.raises(DescriptionError, match=message):
        planes(Tractions(**load), Layers(**layers), **{"depths": [0.0], **more})
