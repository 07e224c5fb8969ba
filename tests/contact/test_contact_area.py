"""The area of contact, freed from the excess of pixels at its edge."""

from __future__ import annotations

import numpy as np
import pytest

import contactkit as ck

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

SOFT = ck.Material(young_modulus=1e9, poisson_ratio=0.0)


def pressed(surface, grid, **window):
    interface = ck.Interface(lower=ck.Body(solid=SOFT), upper=ck.Body(surface=surface))
    loading = window.pop("loading")
    scene = ck.ContactScene(
        interface=interface,
        window=ck.Window(**window),
        loading=loading,
        effects=(ck.HalfSpace(),),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=grid, rtol=1e-6)))


def test_a_disc_of_hertz_has_its_area():
    """Counting is right to about a hundredth; the correction to a fifth of that."""
    radius = 1e-6
    force = 4.0 * 1e9 * radius**3 / (3.0 * 1e-3)
    ball = ck.Paraboloid(radius=1e-3)
    runs = [
        pressed(ball, n, width=2.5e-6, periodic=False, loading=ck.Pressing(force=force))
        for n in range(60, 120, 8)
    ]
    exact = np.pi * radius**2
    counted = np.mean([run.contact_area / exact - 1.0 for run in runs])
    corrected = np.mean([run.corrected_contact_area / exact - 1.0 for run in runs])
    assert counted > 5e-3
    assert abs(corrected) < 2e-3


def test_a_rough_contact_converges_much_sooner():
    rough = ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=5e-7, cutoff=1e-7)
    fine, coarse = (
        pressed(rough, n, width=2e-6, loading=ck.Pressing(pressure=3e5)) for n in (512, 128)
    )
    exact = fine.corrected_contact_area
    assert coarse.contact_area / exact - 1.0 > 0.1
    assert abs(coarse.corrected_contact_area / exact - 1.0) < 0.02


@pytest.mark.parametrize("periodic", [True, False])
def test_the_edges_are_counted_along_both_axes_and_round_the_window(periodic):
    """A strip along y: two edges for each row, or with its free ends two more for each column."""
    strip = ck.Wave(amplitude=1e-9, wavelength=1e-6)
    run = pressed(
        strip,
        (8, 64),
        width=1e-6,
        height=0.125e-6,
        periodic=periodic,
        loading=ck.Pressing(pressure=1e5),
    )
    rows, columns = run.contact.sum(0).max(), run.contact.sum(1).max()
    fraction = (np.pi - 1.0 + np.log(2.0)) / 24.0
    if periodic:
        edges = 2 * rows
        area = run.contact_area - fraction * edges * (1e-6 / 64) ** 2
        assert run.corrected_contact_area == pytest.approx(area)
    else:
        assert run.corrected_contact_area < run.contact_area
    assert columns > 0


def test_one_pixel_has_no_negative_area():
    peak = np.zeros((16, 16))
    peak[3, 4] = 1e-9
    run = ck.press(peak, 1e-8, SOFT, 1e3)
    assert run.contact.sum() == 1
    assert 0.0 <= run.corrected_contact_area < run.contact_area
