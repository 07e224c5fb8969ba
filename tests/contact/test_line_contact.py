"""Windows that repeat along one axis: line contact, both axes alike, every effect."""

from __future__ import annotations

import math

import numpy as np
import pytest
from refusals import each_refused

import contactkit as ck
from contactkit.contact.patches import contact_patches
from contactkit.contact.solver.optimality import optimality
from contactkit.elasticity.layer_stack import Layers
from contactkit.elasticity.one_axis import coefficients
from contactkit.files.results import from_bytes, to_bytes

E, NU, R, WIDTH = 1e9, 0.3, 1e-3, 100e-6
MODULUS = E / (1.0 - NU**2)
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")


def solid(modulus=E, nu=NU):
    return ck.Material(young_modulus=modulus, poisson_ratio=nu, hardness=5e6)


def scene(heights, along, loading, lower=None, effects=(), pixel=None):
    lower = solid() if lower is None else lower
    law = ck.LayeredHalfSpace() if isinstance(lower, ck.Stack) else ck.HalfSpace()
    surface = ck.Heights(heights=heights, pixel_size=pixel or WIDTH / max(heights.shape))
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=lower), upper=ck.Body(surface=surface)),
        window=ck.Window(periodic=along),
        loading=loading,
        effects=(law, *effects),
    )


def cylinder(n, along="x", m=4):
    y = ((np.arange(n) + 0.5) / n - 0.5) * WIDTH
    heights = np.repeat(-(y**2)[:, None] / (2.0 * R), m, axis=1)
    return heights if along == "x" else heights.T


def rough(shape, seed=0):
    rng = np.random.default_rng(seed)
    k = np.hypot(*np.meshgrid(*(np.fft.fftfreq(n) for n in shape), indexing="ij"))
    spectrum = np.fft.fft2(rng.normal(size=shape)) / np.maximum(k, 2.0 / max(shape)) ** 1.8
    spectrum[k > 0.25] = 0.0
    heights = np.fft.ifft2(spectrum).real
    return 1e-8 * (heights - heights.mean()) / heights.std()


def rubber(thickness):
    """An incompressible sheet on a rigid table."""
    layer = ck.Layer(material=solid(nu=0.5), thickness=thickness)
    return ck.Stack(layers=(layer,), substrate=ck.RigidBase(bonded=True))


def solved(*args, **kwargs):
    return ck.solve(ck.plan(scene(*args, **kwargs)))


@pytest.mark.parametrize("along", ["x", "y"])
def test_a_cylinder_is_hertzs_line_contact(along):
    """Johnson 1985, section 4.2: half-width, pressure and, from the stated datum, approach."""
    line_load, errors = 200.0, []
    half_width = math.sqrt(4.0 * line_load * R / (math.pi * MODULUS))
    peak = 2.0 * line_load / (math.pi * half_width)
    approach = line_load / (math.pi * MODULUS) * (2.0 * math.log(2.0 * WIDTH / half_width) + 1.0)
    for n in (64, 256):
        run = solved(
            cylinder(n, along), along, ck.Pressing(force=line_load * 4 * WIDTH / n), pixel=WIDTH / n
        )
        assert run.contact_area / (4 * WIDTH / n) == pytest.approx(
            2 * half_width, abs=2 * WIDTH / n
        )
        assert np.ptp(run.pressure, axis=1 if along == "x" else 0).max() < 1e-5 * peak
        # From the highest line of pixels, half a pixel beside the apex.
        first = run.approach + (0.5 * WIDTH / n) ** 2 / (2.0 * R)
        errors.append((run.max_pressure / peak - 1.0, first / approach - 1.0))
    assert abs(errors[0][0]) < 3e-3
    assert abs(errors[1][0]) < 2e-4
    assert abs(errors[1][1]) < 1e-4
    assert "line load" in run.approach_datum


def test_both_axes_are_alike():
    heights = rough((32, 48))
    along_x = solved(heights, "x", ck.Pressing(pressure=1e6))
    along_y = solved(heights.T, "y", ck.Pressing(pressure=1e6))
    np.testing.assert_allclose(
        along_x.pressure, along_y.pressure.T, atol=1e-6 * along_x.max_pressure
    )
    assert along_x.approach == pytest.approx(along_y.approach, rel=1e-7)
    assert along_x.corrected_contact_area == pytest.approx(along_y.corrected_contact_area)
    assert along_x.energy == pytest.approx(along_y.energy, rel=1e-7)


@pytest.mark.parametrize("layered", [False, True])
def test_a_rough_strip_meets_the_conditions_of_the_dense_problem(layered):
    film = ck.Stack(layers=(ck.Layer(material=solid(1e10), thickness=5e-6),), substrate=solid())
    heights = rough((20, 24))
    run = solved(heights, "x", ck.Pressing(pressure=1e6), lower=film if layered else None)
    layers = Layers([1e10, E], [NU, NU], [5e-6]) if layered else Layers([E], [NU])
    K = coefficients((20, 24), (WIDTH / 24, WIDTH / 24), layers)
    dy = np.abs(np.subtract.outer(np.arange(20), np.arange(20)))
    dx = np.abs(np.subtract.outer(np.arange(24), np.arange(24)))
    dx = np.minimum(dx, 24 - dx)
    u = np.einsum("ijkl,kl->ij", K[dy[:, None, :, None], dx[None, :, None, :]], run.pressure)
    found = optimality(run.pressure, u, heights)
    assert found.residual < 1e-7 * heights.std()
    assert found.approach == pytest.approx(run.rigid_approach, rel=1e-7)


def test_a_strip_as_wide_as_many_periods_is_periodic_in_its_middle():
    """The pressure of a wave across a wide strip is Westergaard's away from the ends."""
    n, count = 32, 8
    wave = 1e-8 * np.cos(2.0 * np.pi * (np.arange(n) + 0.5) / n)
    strip = np.repeat(wave[None, :], count * n, axis=0)
    length = WIDTH / n * n
    star = math.pi * MODULUS * 1e-8 / length
    run = solved(strip, "x", ck.Pressing(pressure=0.5 * star), pixel=WIDTH / n)
    middle = run.pressure[count * n // 2]
    touching = float(np.mean(middle > 0.0))
    assert math.sin(0.5 * math.pi * touching) ** 2 == pytest.approx(middle.mean() / star, abs=0.04)
    x = (np.arange(n) + 0.5) / n
    share = middle.mean() / star
    inside = np.maximum(share - np.sin(math.pi * (x - np.round(x))) ** 2, 0.0)
    westergaard = 2.0 * star * np.abs(np.cos(math.pi * x)) * np.sqrt(inside)
    np.testing.assert_allclose(middle, westergaard, atol=0.03 * middle.max())


def test_an_approach_gives_its_load_back():
    heights = rough((24, 24))
    pressed = solved(heights, "y", ck.Pressing(pressure=2e6))
    moved = solved(heights, "y", ck.Approach(approach=pressed.approach))
    assert moved.mean_pressure == pytest.approx(2e6, rel=1e-6)


def test_the_hardness_bounds_the_pressure():
    effects = (ck.HardnessLimit(rule="material"), ck.FrictionTraction(coefficient=0.1))
    run = solved(rough((24, 24)), "x", ck.Pressing(pressure=2e6), effects=effects)
    assert run.max_pressure == pytest.approx(5e6, rel=1e-12)
    assert run.of(ck.FrictionTraction).force == pytest.approx(0.1 * run.load)


def test_two_bodies_add():
    heights = rough((16, 24))
    surface = ck.Heights(heights=heights, pixel_size=WIDTH / 24)
    made = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid()), upper=ck.Body(surface=surface, solid=solid())
        ),
        window=ck.Window(periodic="x"),
        loading=ck.Pressing(pressure=1e6),
        effects=(ck.HalfSpace(),),
    )
    both = ck.solve(ck.plan(made))
    one = solved(heights, "x", ck.Pressing(pressure=1e6), lower=solid(E / 2))
    np.testing.assert_allclose(both.pressure, one.pressure, atol=1e-6 * one.max_pressure)


def test_only_the_edges_that_repeat_must_fit():
    run = solved(cylinder(64), "x", ck.Pressing(pressure=1e5), pixel=WIDTH / 64)
    (jump,) = [one for one in run.validity if one.name.startswith("jump")]
    assert jump.value == 0.0
    tilted = cylinder(64, m=32) + 1e-9 * np.arange(32)
    run = solved(tilted, "x", ck.Pressing(pressure=1e5), pixel=WIDTH / 64)
    (jump,) = [one for one in run.validity if one.name.startswith("jump")]
    assert jump.value == pytest.approx(31.0)


def test_a_wave_must_fit_along_the_axis_that_repeats_alone():
    def made(along):
        wave = ck.Wave(amplitude=1e-8, wavelength=WIDTH / 2, wavelength_y=0.7 * WIDTH)
        return ck.ContactScene(
            interface=ck.Interface(lower=ck.Body(solid=solid()), upper=ck.Body(surface=wave)),
            window=ck.Window(width=WIDTH, periodic=along),
            loading=ck.Pressing(pressure=1e5),
            effects=(ck.HalfSpace(),),
        )

    assert ck.solve(ck.plan(made("x"), ck.Accuracy(grid=32))).status == "converged"
    with pytest.raises(ck.DescriptionError, match="wavelength_y"):
        ck.plan(made("y"), ck.Accuracy(grid=32))


def test_files_keep_the_axis(tmp_path):
    wave = ck.Wave(amplitude=1e-8, wavelength=WIDTH / 2)
    made = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid()), upper=ck.Body(surface=wave)),
        window=ck.Window(width=WIDTH, periodic="x"),
        loading=ck.Pressing(pressure=1e5),
        effects=(ck.HalfSpace(),),
    )
    file = ck.save_scene(made, tmp_path / "strip.toml")
    assert 'periodic = "x"' in file.read_text()
    assert ck.load_scene(file) == made
    run = ck.solve(ck.plan(made, ck.Accuracy(grid=16)))
    assert "periodic along x" in str(run.plan)
    again = from_bytes(to_bytes(run))
    assert again.plan.grid == run.plan.grid
    assert again.plan.grid.along == "x"


test_what_such_a_window_cannot_do_is_refused_with_its_cure = each_refused(
    [
        (lambda: ck.Window(periodic="z"), 'True, False, "x" or "y"'),
        (lambda: ck.Window(periodic=1.0), 'True, False, "x" or "y"'),
        (
            lambda: solved(
                cylinder(16), "x", ck.Pressing(pressure=1e5), lower=rubber(0.003 * WIDTH / 16)
            ),
            "Layer.thickness must be at least a tenth of the pixel of .* incompressible",
        ),
    ],
    error=ck.ContactkitError,
)


@pytest.mark.parametrize("along", ["x", "y"])
def test_patches_continue_across_the_edges_that_repeat_alone(along):
    """A strip of contact that ends in the window, and goes on from its first to its last pixel."""
    ends = np.zeros((8, 16))
    ends[3:5, :3] = ends[3:5, -2:] = 1e-6
    run = solved(ends if along == "x" else ends.T, along, ck.Pressing(pressure=1e4))
    found = contact_patches(run, fewest_pixels=1)
    assert (found.number, found.areas[0]) == (1, pytest.approx(run.contact_area))
    assert run.contact.sum() > 4


@pytest.mark.parametrize("along", ["x", "y"])
def test_a_nip_through_the_window_is_as_wide_as_it_is(along):
    """Strips, straight or rough, by their width; spots that end inside the window as discs."""

    def spots(heights, force):
        run = solved(heights, along, ck.Pressing(force=force), pixel=WIDTH / 64)
        found = {number.name: number.value for number in run.validity}
        return run, found["pixels across a contact spot"]

    run, width = spots(cylinder(64, along), 12.5)
    assert width == run.contact.sum() / 4  # the window is four pixels long
    wavy = cylinder(64, along, 16)
    ripple = 3e-8 * np.cos(2.0 * np.pi * np.arange(16) / 16)
    wavy = wavy + (ripple if along == "x" else ripple[:, None])
    run, width = spots(wavy, 50.0)
    assert width == run.contact.sum() / 16
    ball = cylinder(64, "x", 64) + cylinder(64, "y", 64)
    run, width = spots(ball, 0.01)
    assert width == pytest.approx(2.0 * math.sqrt(run.contact.sum() / math.pi), rel=0.1)
