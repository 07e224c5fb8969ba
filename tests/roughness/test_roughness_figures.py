"""Figures of surfaces, contacts and histories show the numbers that they are given."""

from __future__ import annotations

import numpy as np
import pytest

import contactkit as ck
from contactkit.analyses.area_over_load import area_over_load
from contactkit.contact.patches import contact_patches, patch_density, patches_of
from contactkit.plot import plastic_history as history_plot
from contactkit.plot import roughness as roughness_plot
from contactkit.plot import style as plot
from contactkit.roughness import spectra
from contactkit.roughness import statistics as stats
from contactkit.roughness.contact_theories import RANGES
from contactkit.roughness.random_surfaces import SelfAffineSpectrum, self_affine

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
SOLID = ck.Material(young_modulus=1e9, poisson_ratio=0.0)


def heights():
    spectrum = SelfAffineSpectrum(0.8, 16e-9, 8e-9)
    return self_affine((32, 32), (1e-9, 1e-9), None, spectrum, 3, "sample", rms_slope=0.1)


def lines(ax):
    return {line.get_label(): np.asarray(line.get_ydata(), dtype=float) for line in ax.lines}


@pytest.mark.slow
def test_the_area_stands_beside_every_theory(tmp_path):
    results = [ck.press(heights(), 1e-9, SOLID, p) for p in (1e6, 2e7)]
    found = area_over_load(results)
    figure, axes = plot.figure(1, 2, size=(11.0, 4.8))
    left, right = roughness_plot.area_and_theories(found, axes)
    shown = lines(left)
    np.testing.assert_array_equal(shown["solved, edge-corrected"], found.corrected)
    ratio = lines(right)["solved, pixel count"]
    np.testing.assert_allclose(ratio, found.counted / found.reduced_pressure)
    for name, (low, high, _) in RANGES.items():
        label = next(one for one in shown if one.startswith(name))
        line = np.ma.masked_invalid(
            next(one for one in left.lines if one.get_label() == label).get_ydata()
        )
        assert low <= line.min() <= line.max() <= high
    assert plot.save(figure, tmp_path / "theories").stat().st_size > 20_000


def test_spectra_bearing_curve_and_patches_are_drawn():
    z = heights()
    ring, curve = spectra.radial_spectrum(z, 1e-9, True), stats.bearing_curve(z, points=20)
    shown = lines(roughness_plot.power_spectrum([("map", ring)]))["map"]
    assert shown.max() == ring.density.max()
    np.testing.assert_array_equal(
        roughness_plot.bearing(curve).lines[0].get_xdata(), 100.0 * curve.fraction
    )
    patches = patches_of(z > z.std(), (1e-9, 1e-9), periodic=True)
    ax = roughness_plot.patch_sizes(patches)
    np.testing.assert_allclose(ax.lines[0].get_ydata(), patch_density(patches).density)
    assert {"number-weighted mean", "area-weighted mean"} <= set(lines(ax))
    empty = contact_patches(ck.press(z, 1e-9, SOLID, 0.0))
    assert "number-weighted mean" not in lines(roughness_plot.patch_sizes(empty))


def test_a_loop_and_what_it_leaves_are_drawn():
    surface = ck.Heights(heights=heights(), pixel_size=1e-9)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=SOLID), upper=ck.Body(surface=surface)),
        loading=ck.Pressing(pressure=1e7),
        effects=(
            ck.HalfSpace(),
            ck.HardnessLimit(rule=ck.ConstantHardness(hardness=8e7)),
            ck.PlasticHistory(pressures=(1e7, 0.0), steps=2),
        ),
    )
    result = ck.solve(ck.plan(scene))
    part = result.of(ck.PlasticHistory)
    shown = lines(history_plot.force_approach(result))["elastic"]
    np.testing.assert_allclose(shown / shown.max(), part.load / part.load.max())
    image = history_plot.residual_depth(result).images[0].get_array()
    np.testing.assert_array_equal(np.ma.getmaskarray(image), part.residual_depth == 0.0)
    ax = plot.figure()[1]
    assert history_plot.force_approach(result, ax) is ax
