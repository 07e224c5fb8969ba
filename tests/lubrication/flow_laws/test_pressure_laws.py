"""Viscosity and density over pressure: definitions, the tangent in tension, reduced pressures."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from contactkit.lubrication.flow_laws.density import dowson_higginson
from contactkit.lubrication.flow_laws.pressure_laws import Barus, Roelands

ALPHA = 2e-8
BARUS = Barus(coefficient=ALPHA)
ROELANDS = Roelands(viscosity=0.04, exponent=0.68)
HELD = Roelands(viscosity=0.04, exponent=0.68, thins_in_tension=False)


def test_roelands_is_its_formula_and_begins_as_barus():
    p = np.array([1e6, 1e8, 1e9])
    height = math.log(0.04) + 9.67
    expected = np.exp(height * ((1.0 + p / 1.96e8) ** 0.68 - 1.0))
    assert ROELANDS.multiplier(p) == pytest.approx(expected, rel=1e-13)
    tangent = Barus(coefficient=ROELANDS.coefficient)
    assert ROELANDS.multiplier(1e3) == pytest.approx(tangent.multiplier(1e3), rel=1e-9)
    assert (ROELANDS.multiplier(p) < tangent.multiplier(p)).all()


@pytest.mark.parametrize("law", [BARUS, ROELANDS, HELD])
def test_slopes_are_those_of_the_logarithm(law):
    p = np.array([-1e8, 1e3, 1e7, 1e9])
    step = 1e-4 * np.abs(p)
    by_difference = (law.logarithm(p + step)[0] - law.logarithm(p - step)[0]) / (2.0 * step)
    assert law.logarithm(p)[1] == pytest.approx(by_difference, rel=1e-6, abs=1e-20)


def test_in_tension_a_law_is_its_tangent_or_stays():
    """Without a jump of the slope at ambient, also beyond the pole of Roelands' power."""
    p = np.array([-1e6, -1e8, -1e9])
    assert ROELANDS.multiplier(p) == pytest.approx(np.exp(ROELANDS.coefficient * p), rel=1e-13)
    assert (HELD.multiplier(p) == 1.0).all()
    assert ROELANDS.logarithm(-1e-3)[1] == pytest.approx(ROELANDS.logarithm(1e-3)[1], rel=1e-9)


@pytest.mark.parametrize("law", [BARUS, ROELANDS, HELD])
@pytest.mark.parametrize("pressure", [-1e9, -1e5, 0.0, 1e2, 1e8, 4e8])
def test_the_reduced_pressure_is_the_integral_and_comes_back(law, pressure):
    expected = quad(lambda p: 1.0 / law.multiplier(p), 0.0, pressure, epsrel=1e-12, limit=200)[0]
    reduced = law.reduced(pressure)
    assert reduced == pytest.approx(expected, rel=1e-10, abs=1e-12)
    assert law.pressure_of(reduced) == pytest.approx(pressure, rel=1e-8, abs=1e-12)


def test_no_pressure_is_as_high_as_beyond_the_limit_of_barus():
    """The reduced pressure tends to 1/alpha."""
    assert BARUS.pressure_of(1.0001 / ALPHA) == math.inf
    assert BARUS.pressure_of(0.99 / ALPHA) == pytest.approx(math.log(100.0) / ALPHA, rel=1e-9)
    constant = Barus(coefficient=0.0)
    assert constant.pressure_of(1e12) == pytest.approx(1e12, rel=1e-13)
    assert constant.reduced(1e12) == pytest.approx(1e12, rel=1e-13)


def test_multipliers_stay_doubles():
    assert np.isfinite(BARUS.multiplier(np.array([-1e13, 1e13]))).all()


def test_density_is_the_law_above_ambient_and_its_tangent_below():
    p = np.array([1e5, 1e8, 1e9])
    ratio, slope = dowson_higginson(p)
    assert ratio == pytest.approx(1.0 + 0.6e-9 * p / (1.0 + 1.7e-9 * p), rel=1e-14)
    step = 1e-4 * p
    rise = dowson_higginson(p + step)[0] - dowson_higginson(p - step)[0]
    assert slope == pytest.approx(rise / (2.0 * step), rel=1e-4)
    assert dowson_higginson(-1e9)[0] == pytest.approx(0.4, rel=1e-14)
