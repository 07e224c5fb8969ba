"""Stress of a map that is read as uniform pixels, or as a cubic spline: no ripples off it."""

from __future__ import annotations

import functools

import numpy as np
import pytest
from scipy import ndimage
from selection import quick

import contactkit as ck
from contactkit.elasticity.layer_stack import Layers
from contactkit.elasticity.stress.measures import von_mises
from contactkit.elasticity.stress.planes import StressField, planes
from contactkit.elasticity.stress.tractions import Tractions
from contactkit.errors import DescriptionError

# Two and four pixels to the shortest wave are meant to be too few.
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

HALF = Layers([1.0], [0.3])
STACK = Layers([4.0, 0.5, 1.0], [0.3, 0.4, 0.2], [0.3, 0.5])


def uniform(t):
    return np.where(np.abs(t) < 0.5, 1.0, 0.0)


def cubic(t):
    """The cubic spline that is one at a pixel and zero at all others, of a long row."""
    n = 64
    waves = 2.0 * np.pi * np.fft.fftfreq(n)
    weights = np.fft.ifft(3.0 / (2.0 + np.cos(waves))).real
    off = np.abs(np.asarray(t)[..., None] - np.arange(-n // 2, n // 2))
    near, far = 2.0 / 3.0 - off**2 + off**3 / 2.0, (2.0 - off) ** 3 / 6.0
    b_spline = np.where(off < 1.0, near, np.where(off < 2.0, far, 0.0))
    return b_spline @ np.fft.fftshift(weights)


KERNELS = {"uniform": uniform, "spline": cubic}


def finer(values, kernel, times):
    """A map on `times` as many points along each axis, an odd number, read by a kernel."""
    for axis in (0, 1):
        n = values.shape[axis]
        at = (np.arange(n * times) - times // 2) / times
        off = at[:, None] - np.arange(n)
        weights = sum(kernel(off + turn * n) for turn in range(-4, 5))
        values = np.moveaxis(np.tensordot(weights, values, (1, axis)), 0, axis)
    return values


@pytest.mark.parametrize("reading", KERNELS)
@pytest.mark.parametrize(
    ("shape", "pixel"),
    quick([((12, 12), (0.2, 0.2)), ((9, 14), (0.1, 0.25)), ((1, 10), (1.0, 0.3))], 2),
)
def test_a_reading_is_the_finer_map_it_stands_for(reading, shape, pixel):
    """All components under pressure and both tractions, on layers, at a third of a pixel and on."""
    rng, times = np.random.default_rng(3), 9
    maps = rng.uniform(0.0, 1.0, (3, *shape)) * (rng.uniform(size=(3, *shape)) < 0.3)
    fine = [finer(one, KERNELS[reading], times) for one in maps]
    small = tuple(d / times for d in pixel)
    depths = [max(pixel) * k for k in (0.35, 0.8, 2.0, 4.4, 4.6)]
    exact = planes(Tractions(small, *fine), STACK, depths)
    found = planes(Tractions(pixel, *maps), STACK, depths, reading=reading)
    middle = (slice(None), *(slice(times // 2, None, times) for _ in shape))
    for one, other in zip(found, exact, strict=True):
        expected = other.stress[middle]
        error = np.abs(one.stress - expected).max() / np.abs(expected).max()
        # The finer map has the steps between uniform pixels to second order only.
        assert error < (3e-3 if reading == "uniform" else 1e-3)


def point_load(x, y, z, nu):
    """Stress of a unit force on a half-space (Boussinesq), xx, yy, zz, xy, xz, yz."""
    r2, rho = x * x + y * y, np.sqrt(x * x + y * y + z * z)
    ring, part = (1 - z / rho) / r2, (1 - 2 * nu) / r2
    xx = part * (ring * (x * x - y * y) + z * y * y / rho**3) - 3 * z * x * x / rho**5
    yy = part * (ring * (y * y - x * x) + z * x * x / rho**3) - 3 * z * y * y / rho**5
    xy = part * (2 * ring * x * y - x * y * z / rho**3) - 3 * x * y * z / rho**5
    rest = [-3 * z**3 / rho**5, xy, -3 * x * z * z / rho**5, -3 * y * z * z / rho**5]
    return np.array([xx, yy, *rest]) / (2 * np.pi)


@pytest.mark.parametrize("z", [0.3, 0.5, 1.0, 3.0, 6.0])
def test_a_lone_uniform_pixel_is_the_integral_of_point_loads(z):
    nodes, weights = np.polynomial.legendre.leggauss(40)
    nodes, weights = 0.5 * nodes, 0.5 * weights
    p = np.zeros((20, 20))
    p[6, 7] = 1.0
    field = StressField(Tractions((1.0, 1.0), p), HALF, mean="free", reading="uniform")
    (plane,) = field.planes([z])
    size = np.abs(plane.stress).max()
    for down, right in ((0, 0), (0, 1), (1, 1), (2, 0), (3, 2), (0, 6), (9, 11)):
        loads = point_load(right - nodes[None, :] + 1e-9, down - nodes[:, None], z, 0.3)
        expected = (loads * np.outer(weights, weights)).sum(axis=(1, 2))
        found = plane.stress[:, 6 + down, 7 + right]
        assert np.abs(found - expected).max() < 1e-3 * size
        assert np.abs(found - expected).max() < 2e-2 * np.abs(expected).max()


def test_on_the_surface_the_stress_of_a_square_is_that_of_love():
    """sigma_xx = sigma_yy = -(1 + 2 nu)/2 p at the centre, and the tractions are the load."""
    p = np.zeros((16, 16))
    p[5, 8] = 2.0
    field = StressField(
        Tractions((1.0, 1.0), p), HALF, mean="free", reading="uniform", friction=(0.5, 0.0)
    )
    (plane,) = field.planes([0.0])
    np.testing.assert_array_equal(plane.stress[2], -p)
    np.testing.assert_array_equal(plane.stress[4], -0.5 * p)
    np.testing.assert_array_equal(plane.stress[5], 0.0)
    assert plane.stress[:2, 5, 8] == pytest.approx([-1.6, -1.6], rel=1e-3)


@pytest.mark.parametrize(
    ("mean", "reading"),
    quick([("periodic", "trigonometric"), ("free", "uniform"), ("periodic", "spline")], 0, 2),
)
def test_friction_is_linear_and_takes_no_transform_of_its_own(reading, mean):
    p = np.random.default_rng(2).uniform(size=(10, 8))
    pixel, options = (0.2, 0.3), {"mean": mean, "reading": reading}
    depths, along, sliding = [0.0, 0.15, 3.0], (0.6, 0.8), (0.0, 0.5)
    field = StressField(Tractions(pixel, p), STACK, friction=(0.06, 0.08), drag=along, **options)
    loads = [Tractions(pixel, p, mu * along[0] * p, mu * along[1] * p) for mu in sliding]
    alone = [planes(load, STACK, depths, **options) for load in loads]
    for plane, *expected in zip(field.planes(depths), *alone, strict=True):
        for mu, one in zip(sliding, expected, strict=True):
            found = plane.stress + (mu - 0.1) * plane.dragged
            np.testing.assert_allclose(found, one.stress, rtol=0, atol=1e-13)


def test_a_reading_of_no_name_is_refused():
    with pytest.raises(DescriptionError, match="trigonometric, uniform, spline"):
        planes(Tractions((1.0, 1.0), np.ones((4, 4))), HALF, [0.0], reading="linear")


# A rough contact ----------------------------------------------------------------------------


@functools.cache
def rough(pixels_per_wave):
    """Pressure of a rough contact, 96 x 96 pixels, and its pixel."""
    steel = ck.Material(name="steel", young_modulus=100e9, poisson_ratio=0.3)
    pixel = 20e-6 / 512
    roughness = ck.GaussianRoughness(
        rms=1e-9, correlation_length=0.5e-6, cutoff=pixels_per_wave * pixel, seed=1
    )
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=steel, surface=roughness)),
        window=ck.Window(width=96 * pixel),
        loading=ck.Pressing(pressure=1e6),
        effects=(ck.HalfSpace(),),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=96))).pressure, pixel


@pytest.mark.parametrize("pixels_per_wave", [2, 4, 8])
def test_off_the_contact_no_ripple_exceeds_the_stress(pixels_per_wave):
    """At half a pixel's depth, against uniform pixels on a transform nine times finer."""
    p, pixel = rough(pixels_per_wave)
    times = 9
    load = Tractions((pixel / times,) * 2, np.kron(p, np.ones((times, times))))
    (exact,) = planes(load, HALF, [pixel / 2])
    off = p == 0.0
    expected = von_mises(exact.stress[:, times // 2 :: times, times // 2 :: times])[off]

    def ratios(reading):
        (plane,) = planes(Tractions((pixel, pixel), p), HALF, [pixel / 2], reading=reading)
        return von_mises(plane.stress)[off] / expected

    beside = np.tile(p == 0.0, (3, 3))
    away = ndimage.distance_transform_edt(beside)[96:192, 96:192][off]
    same, smooth, rippled = (ratios(one) for one in ("uniform", "spline", "trigonometric"))
    assert np.abs(same - 1.0).max() < 0.02
    assert np.median(smooth) == pytest.approx(1.0, abs=0.01)
    # As the docstring of `SubsurfaceStress` says of the pixels off a contact.
    for up_to, low, high in ((0.0, 0.2, 4.1), (3.5, 0.5, 2.3), (6.5, 0.85, 1.15)):
        assert low < smooth[away > up_to].min() < smooth[away > up_to].max() < high
    assert smooth[away < 3.5].max() > 1.5  # and it is that far off there
    assert np.quantile(smooth, 0.99) < 1.6
    assert rippled.max() > 5.0 * smooth.max()  # the negative control
