"""Exact bridges between equal spheres against the fits that others have published."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from selection import quick

import contactkit as ck
from contactkit.capillary import bridge, stability_limit
from contactkit.capillary.exact.bridge import bridge_at_pressure
from contactkit.capillary.exact.pressure_branch import branch_at_pressure
from contactkit.capillary.kelvin import kelvin_radius
from contactkit.reference import sphere_bridges as fits

GALLERY = Path(__file__).parents[2] / "examples" / "gallery" / "measured"
CASES = json.loads((GALLERY / "measurements.json").read_text(encoding="utf-8"))
FRACTIONS = np.array([0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9])


def limit(volume, degrees):
    angle = math.radians(degrees)
    return float(stability_limit(volume, angle, angle, 1.0, 1.0).gap)


def off(fit, volume, degrees, fractions=FRACTIONS):
    """Relative error of a fit, for spheres of radius 1 and a surface tension of 1."""
    angle, gaps = math.radians(degrees), fractions * limit(volume, degrees)
    exact = bridge(gaps, volume, angle, angle, 1.0, 1.0).force
    return fit(gaps, 1.0, volume, 1.0, angle) / exact - 1.0


# Willett ------------------------------------------------------------------------------------


def test_the_fit_is_that_of_yade():
    """Values of another program's arithmetic, for the spheres of Willett's experiment."""
    case = CASES["willett_2000_fit"]["case"]
    given = (case["sphere_radius_m"], case["volume_m3"], case["surface_tension_N_m"], 0.0)
    found = fits.willett_force(case["s_m"], *given)
    np.testing.assert_allclose(found, case["fit_N"], rtol=2e-5)


@pytest.mark.parametrize(
    ("degrees", "mean"), [(0, 0.021), (10, 0.023), (20, 0.021), (40, 0.025), (50, 0.043)]
)
@pytest.mark.parametrize("volume", [1e-4, 1e-3, 1e-2, 0.1])
def test_exact_bridges_lie_on_the_fit_of_willett(volume, degrees, mean):
    error = off(fits.willett_force, volume, degrees)
    assert np.abs(error).mean() < mean
    assert np.abs(error).max() < 0.1


@pytest.mark.parametrize("degrees", [0, 20, 40])
def test_the_fit_of_willett_does_not_bend_at_rupture(degrees):
    """The exact force falls steeply there; the fit lies above it."""
    error = off(fits.willett_force, 1e-3, degrees, np.array([0.95, 0.99]))
    assert 0.05 < error[0] < error[1] < 0.6


def test_the_closed_form_is_for_small_volumes():
    errors = [
        np.abs(off(fits.willett_closed_form, volume, 0)).mean() for volume in (1e-5, 1e-3, 0.1)
    ]
    assert errors[0] < 0.06 < 0.09 < errors[1] < 0.12 < 0.15 < errors[2] < 0.18


# Rupture ------------------------------------------------------------------------------------


@pytest.mark.parametrize("volume", [1e-5, 1e-4, 1e-3, 1e-2, 0.1])
@pytest.mark.parametrize(
    ("degrees", "willett", "lian"),
    [
        (0, (-0.005, 0.005), (-0.05, -0.004)),
        (20, (0.0, 0.04), (-0.03, 0.04)),
        (40, (0.0, 0.04), (-0.05, 0.04)),
        (60, (0.0, 0.075), (0.0, 0.075)),
    ],
)
def test_bridges_break_where_willett_and_lian_say(volume, degrees, willett, lian):
    exact, angle = limit(volume, degrees), math.radians(degrees)
    assert willett[0] < fits.willett_rupture(1.0, volume, angle) / exact - 1.0 < willett[1]
    assert lian[0] < fits.lian_rupture(volume, angle) / exact - 1.0 < lian[1]


# Mikami -------------------------------------------------------------------------------------


@pytest.mark.parametrize("degrees", [0, 10, 20])
@pytest.mark.parametrize("volume", [1e-3, 1e-2, 0.03, 0.1])
def test_exact_bridges_lie_on_the_fit_of_mikami(volume, degrees):
    error = off(fits.mikami_force, volume, degrees)
    assert np.abs(error).mean() < 0.061
    assert np.abs(error).max() < 0.131


def test_the_logarithms_of_mikami_are_natural():
    """Coefficients for common logarithms with natural ones: far off as soon as liquids wet less."""

    def mistaken(s, radius, volume, tension, angle):
        log = math.log(volume)
        b = (-0.34 * log - 0.96) * angle**2 - 0.019 * log + 0.48
        return math.pi * (0.0042 * log + 0.078 + np.exp(-1.1 * volume**-0.53 * s + b))

    for degrees in (20, 40):
        right = np.abs(off(fits.mikami_force, 1e-2, degrees)).mean()
        assert np.abs(off(mistaken, 1e-2, degrees)).mean() > 3.0 * right


def test_the_fits_of_willett_and_mikami_agree():
    """Two groups, two fits: where both hold they are closer to each other than 10 %."""
    s = np.linspace(0.1, 0.8, 8) * fits.lian_rupture(1e-2, 0.0)
    one, other = (f(s, 1.0, 1e-2, 1.0, 0.0) for f in (fits.willett_force, fits.mikami_force))
    np.testing.assert_allclose(one, other, rtol=0.1)


# Arguments ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("fit", "given", "names"),
    [
        (fits.willett_force, (0.0, 1.0, 1e-3, 1.0, 0.0), "distance: must be above 0"),
        (fits.willett_force, (0.1, -1.0, 1e-3, 1.0, 0.0), "radius = -1.0 m"),
        (fits.willett_closed_form, (0.1, 1.0, 0.0, 1.0, 0.0), "volume = 0.0 m3"),
        (fits.mikami_force, (-0.1, 1.0, 1e-3, 1.0, 0.0), "distance: must be 0 or more"),
        (fits.mikami_force, (0.1, 1.0, 1e-3, math.nan, 0.0), "surface_tension = nan N/m"),
        (fits.willett_rupture, (1.0, 1e-3, 20.0), "contact_angle = 20.0 rad"),
        (fits.lian_rupture, (1e-3, -0.1), "contact_angle = -0.1 rad"),
    ],
)
def test_what_is_not_physical_is_refused(fit, given, names):
    with pytest.raises(ValueError, match=names):
        fit(*given)


# Work of rupture ----------------------------------------------------------------------------


def work_at_volume(volume, angle, start):
    """Work of drawing a sphere off a flat at constant volume, by quadrature to the limit."""
    end = float(stability_limit(volume, angle, angle, 0.0, 1.0).gap)
    return _work(lambda gaps: bridge(gaps, volume, angle, angle, 0.0, 1.0), start, end)


def work_at_pressure(pressure, angle):
    """The same at constant pressure, from touch."""
    end = float(branch_at_pressure(pressure, angle, angle, 0.0, 1.0).gap[-1])
    return _work(lambda gaps: bridge_at_pressure(gaps, pressure, angle, angle, 0.0, 1.0), 0.0, end)


def _work(state, start, end):
    # The force has a square root at the limit: gaps end - (end - start) t^2.
    t, weight = leggauss(48)
    t = 0.5 * (t + 1.0)
    gaps = end - (end - start) * t * t
    return float(np.sum(weight * state(gaps).force * (end - start) * t))


@pytest.mark.parametrize(
    ("degrees", "low", "high"), [(0, 1.9, 2.01), (30, 2.0, 2.06), (60, 2.02, 2.3)]
)
@pytest.mark.parametrize("kelvin", quick([1e-5, 1e-3, 1e-2], 1))
def test_evaporation_halves_the_work_of_rupture(kelvin, degrees, low, high):
    """De Boer and de Boer 2008: at constant pressure the work is less by a factor of about 2."""
    angle, pressure = math.radians(degrees), -1.0 / kelvin
    touching = bridge_at_pressure(0.0, pressure, angle, angle, 0.0, 1.0)
    kept = work_at_volume(float(touching.volume), angle, 0.0)
    ratio = kept / work_at_pressure(pressure, angle)
    assert ratio == pytest.approx(
        CASES["de_boer_2008_work"]["ratio_constant_volume_to_constant_pressure"], abs=0.3
    )
    assert low < ratio < high


def test_the_kelvin_radius_is_that_of_tas():
    """Tas et al. 1996: gamma v/(R T) = 0.54 nm, and 0.8 nm at 50 % humidity."""
    case = CASES["tas_1996_kelvin"]
    water, room = ck.load_liquid("water"), 293.15
    tension, molar_volume = water.at(room).surface_tension, water.molar_volume(room)
    radius = kelvin_radius(tension, molar_volume, room, 0.5)
    assert radius == pytest.approx(case["kelvin_radius_50_percent_m"], rel=0.03)  # one digit there
    length = radius * math.log(2.0)
    assert length == pytest.approx(case["gamma_v_over_RT_m"], abs=0.005e-9)
