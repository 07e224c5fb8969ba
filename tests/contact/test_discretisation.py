"""The error of the grid that is stated covers that against finer pixels, of each number."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.contact.discretisation import discretisation_error
from contactkit.roughness.highest_point import rise_between_pixels

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
E_STAR = 210e9 / (1.0 - 0.3**2)
HALF = (ck.HalfSpace(),)
N, PIXEL = 32, 30e-9


def band_limited(seed, per_wave, n=N):
    """Rough heights [m] without waves shorter than a number of pixels, rms 1 nm."""
    waves = np.hypot(*np.meshgrid(np.fft.fftfreq(n) * n, np.fft.fftfreq(n) * n))
    weight = np.where((waves >= 2) & (waves < n / per_wave * 0.999), np.maximum(waves, 1.0), np.inf)
    noise = np.fft.fft2(np.random.default_rng(seed).standard_normal((n, n)))
    heights = np.fft.ifft2(noise * weight**-1.8).real
    return 1e-9 * heights / heights.std()


def finer(heights, times):
    """The same waves on `times` as many pixels along each side."""
    n, m = heights.shape[0], heights.shape[0] * times
    padded, at = np.zeros((m, m), dtype=complex), m // 2 - n // 2
    padded[at + 1 : at + n, at + 1 : at + n] = np.fft.fftshift(np.fft.fft2(heights))[1:, 1:]
    return np.fft.ifft2(np.fft.ifftshift(padded)).real * times**2


def pressed(heights, pixel, effects=HALF, pressure=60e6, solid=STEEL, periodic=True):
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Heights(heights=heights, pixel_size=pixel)),
        ),
        window=ck.Window(periodic=periodic),
        loading=ck.Pressing(pressure=pressure),
        effects=effects,
    )
    return ck.solve(ck.plan(scene))


# Covered --------------------------------------------------------------------------------------

FILM = ck.Layer(material=evolve(STEEL, young_modulus=900e9), thickness=1.5 * PIXEL)
KINDS = {
    "half-space": (STEEL, HALF),
    "film": (ck.Stack(layers=(FILM,), substrate=STEEL), (ck.LayeredHalfSpace(),)),
    "hardness": (STEEL, (*HALF, ck.HardnessLimit(rule=ck.ConstantHardness(hardness=4e9)))),
}
NAMES = (
    "max_pressure",
    "contact_area",
    "corrected_contact_area",
    "approach",
    "max_displacement",
    "plastic_area",
)


@functools.cache
def stated():
    """True error, what is stated, and the change to every second pixel, of each number.

    Of nine contacts, against four times finer pixels.
    """
    found = []
    for solid, effects in KINDS.values():
        for per_wave in (2.2, 4, 8):
            heights = band_limited(1, per_wave)
            result = pressed(heights, PIXEL, effects, solid=solid)
            of = discretisation_error(result)
            right = pressed(finer(heights, 4), PIXEL / 4, effects, solid=solid).scalars()
            for name in NAMES:
                value = result.scalars().get(name, (0.0,))[0]
                if value:
                    true, change = (
                        abs(one[name][0] / value - 1.0) for one in (right, of.coarse.scalars())
                    )
                    found.append((true, max(of.errors[name], 1e-7), change))
    return np.array(found).T  # a peak at the hardness has no error


def test_the_true_error_seldom_exceeds_the_stated_one():
    true, error, _ = stated()
    assert true.size > 40
    assert (true > error).mean() <= 0.05
    assert (true > 2.0 * error).mean() <= 0.01
    assert np.median(true / error) > 0.1  # nor is it ten times as large


def test_the_change_to_every_second_pixel_alone_would_not_do():
    true, _, change = stated()
    assert (true > change).mean() > 0.15
    assert (true > 2.0 * change).mean() > 0.05


@pytest.mark.parametrize("grid", [48, 64, 96])
def test_it_covers_the_error_of_a_sphere(grid):
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=STEEL), upper=ck.Paraboloid(radius=1e-3)),
        window=ck.Window(width=60e-6, periodic=False),
        loading=ck.Pressing(force=0.162),
        effects=HALF,
    )
    result = ck.solve(ck.plan(scene, ck.Accuracy(grid=grid)))
    load, radius = result.load, 1e-3
    found = discretisation_error(result)
    peak = (6.0 * load * E_STAR**2 / (np.pi**3 * radius**2)) ** (1.0 / 3.0)
    contact = (0.75 * load * radius / E_STAR) ** (1.0 / 3.0)
    exact = {
        "max_pressure": peak,
        "contact_area": np.pi * contact**2,
        "corrected_contact_area": np.pi * contact**2,
        "approach": contact**2 / radius,
    }
    for name, right in exact.items():
        true = abs(result.scalars()[name][0] / right - 1.0)
        assert true <= found.errors[name] <= 0.25, name
    assert [c.plan.grid.shape[0] for c in found.companions] == [grid // 2] * 2 + [grid // 4] * 2


# Its parts ------------------------------------------------------------------------------------


def test_it_is_the_grid_convergence_index_of_four_companions():
    heights, load = band_limited(3, 8), 400e6
    result = pressed(heights, PIXEL, (*HALF, ck.SubsurfaceStress(depths=(0.0, 1e-8))), load)
    found = discretisation_error(result)
    twice = [pressed(heights[i::2, i::2], 2 * PIXEL, HALF, load).max_pressure for i in (0, 1)]
    wider = [pressed(heights[i::4, i::4], 4 * PIXEL, HALF, load).max_pressure for i in (0, 2)]
    near, far = (max(abs(p - result.max_pressure) for p in of) for of in (twice, wider))
    order = min(max(math.log2(far / near - 1.0), 1.0), 1.5)
    index = 1.25 * max(near / (2.0**order - 1.0), far / (4.0**order - 1.0))
    assert found.errors["max_pressure"] == pytest.approx(index / result.max_pressure, rel=5e-3)
    assert found.orders["max_pressure"] == pytest.approx(order, rel=5e-3)
    assert found.orders["max_tension"] == found.orders["max_sigma_xz"] == 0.5
    assert found.coarse is found.companions[0]
    assert not {"load", "mean_pressure", "residual"} & found.errors.keys()
    assert not [one for one in found.errors if one.endswith(("_layer", "_error"))]
    assert "max_pressure" in str(found)
    assert "16 x 16 and 8 x 8 pixels" in str(found)


def test_the_first_touch_lies_between_pixels():
    """A ball between four pixels: the approach is short of what the pixels do not show."""
    y, x = np.mgrid[-16:16, -16:16] * 1e-7
    ball = -((x - 0.5e-7) ** 2 + (y - 0.5e-7) ** 2) / (2.0 * 10e-6)
    result = pressed(ball, 1e-7, pressure=20e6, periodic=False)
    rise = 2.0 * (0.5e-7) ** 2 / (2.0 * 10e-6)
    assert rise_between_pixels(ball, (False, False)) == pytest.approx(rise, rel=1e-6)
    errors = discretisation_error(result).errors
    assert errors["approach"] > rise / result.approach
    centred = pressed(-(x**2 + y**2) / (2.0 * 10e-6), 1e-7, pressure=20e6, periodic=False)
    assert rise_between_pixels(centred.heights, (False, False)) < 1e-3 * rise
    true = 1.0 - result.approach / centred.approach
    assert 0.5 * rise / result.approach < true < errors["approach"]


@pytest.mark.parametrize(("per_wave", "error"), [(3, 0.03), (4, 0.01), (8, 1e-3)])
def test_the_highest_point_is_that_of_the_waves(per_wave, error):
    for seed in range(4):
        heights = band_limited(seed, per_wave, 48)
        exact = finer(heights, 8).max() - heights.max()
        found = rise_between_pixels(np.roll(heights, 5 * seed, (0, 1)), (True, True))
        assert found == pytest.approx(exact, abs=error * np.ptp(heights) * 0.1)


def test_a_plateau_has_no_higher_point():
    steps = np.zeros((24, 24))
    steps[5:15, 5:15] = 1e-9
    assert rise_between_pixels(steps, (True, True)) == 0.0
    assert rise_between_pixels(np.zeros((4, 4)), (True, False)) == 0.0
    assert rise_between_pixels(np.zeros((1, 9)), (True, True)) == 0.0


def test_areas_have_at_least_the_excess_of_cut_pixels():
    """Two pixels at the hardness on every grid state no zero."""
    y, x = np.mgrid[-12:12, -12:12] * 1e-7
    ball = -(x**2 + y**2) / (2.0 * 10e-6)
    bare = pressed(ball, 1e-7, pressure=60e6, periodic=False)
    for fraction, plastic in ((0.95, True), (1.02, False), (3.0, False)):
        limit = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=fraction * bare.max_pressure))
        result = pressed(ball, 1e-7, (*HALF, limit), pressure=60e6, periodic=False)
        assert (result.plastic_area > 0.0) == plastic
        found = discretisation_error(result)
        if plastic:
            assert found.errors["plastic_area"] > 0.1
        elif fraction < 2.0:  # the peak is at the hardness within its error
            assert found.errors["plastic_area"] == math.inf
            assert "0 on these pixels" in str(found)
        else:
            assert "plastic_area" not in found.errors


def test_a_hardness_map_goes_with_the_pixels():
    hardness = np.where(np.arange(N) % 2, 4e9, 6e9) * np.ones((N, 1))
    limit = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=ck.HardnessMap(hardness)))
    result = pressed(band_limited(1, 8), PIXEL, (*HALF, limit))
    found = discretisation_error(result)
    of = [one.plan.scene.effect(ck.HardnessLimit).rule.hardness.values for one in found.companions]
    assert [one.shape for one in of] == [(16, 16)] * 2 + [(8, 8)] * 2
    assert [one.flat[0] for one in of] == [6e9, 4e9, 6e9, 6e9]


def test_an_odd_number_of_pixels_has_no_companion():
    result = pressed(np.eye(15) * 1e-9, PIXEL)
    with pytest.raises(ck.DescriptionError, match=r"Accuracy.grid .*multiples of 2"):
        discretisation_error(result)


def test_without_multiples_of_four_two_companions_state_it():
    found = discretisation_error(pressed(band_limited(1, 8, 34), PIXEL))
    assert [one.plan.grid.shape for one in found.companions] == [(17, 17)] * 2
    assert set(found.orders.values()) == {1.0}
    assert found.errors["max_pressure"] > 0.0


def test_the_estimate_stays_on_the_branch_of_a_pulled_contact():
    law = ck.ExponentialAttraction(work_of_adhesion=0.05, range=0.4e-9)
    soft = ck.Material(young_modulus=1e9, poisson_ratio=0.0)
    given = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=soft), upper=ck.Body(surface=ck.Paraboloid(radius=1e-6))
        ),
        window=ck.Window(width=0.36e-6, periodic=False),
        loading=ck.Approach(approach=0.0),
        effects=(ck.HalfSpace(), ck.Adhesion(law=law)),
    )
    plan = ck.plan(given, ck.Accuracy(grid=64))
    states = ck.load_curve(plan, approaches=[8e-9, 0.0, -1.6e-9], keep_maps=True).results
    last = states[-1]
    assert last.contact_area > 0.0
    assert ck.solve(last.plan).contact_area == 0.0  # of an approach
    found = discretisation_error(last)
    assert found.coarse.contact_area == pytest.approx(last.contact_area, rel=0.1)
    assert found.errors["load"] < 0.5
