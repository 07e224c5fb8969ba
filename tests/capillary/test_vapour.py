"""Vapour around a meniscus: saturation, diffusion through the gap, time to dry up."""

import math

import pytest
from scipy.integrate import quad

from contactkit.capillary import vapour


@pytest.mark.parametrize(("celsius", "pressure"), [(0.01, 611.66), (25.0, 3169.9), (60.0, 19947.0)])
def test_saturation_pressure_is_that_of_the_steam_tables(celsius, pressure):
    """IAPWS-IF97."""
    found = vapour.water_saturation_pressure(273.15 + celsius)
    assert found == pytest.approx(pressure, rel=5e-3)


@pytest.mark.parametrize("gap", [1e-9, 1e-7, 1e-5])
def test_conductance_is_the_integral_over_the_gap(gap):
    radius, rim = 1e-3, 2e-5
    inverse = quad(
        lambda s: 1.0 / (2.0 * math.pi * (gap + math.exp(2.0 * s) / (2.0 * radius))),
        math.log(rim),
        math.log(rim) + 25.0,
        epsabs=0.0,
        epsrel=1e-11,
    )[0]
    found = vapour.gap_conductance(rim, gap, radius)
    assert found == pytest.approx(1.0 / inverse, rel=1e-9)


def test_a_meniscus_dries_as_diffusion_carries_its_moles():
    """V/v_m moles through D G c_s (1 - H) mol/s; 0.96 mol/m3 saturate air of 20 degC."""
    time = vapour.drying_time(1e-18, 1e-7, 1.8e-5, 293.15, 0.5)
    assert time == pytest.approx(1e-18 / 1.8e-5 / (2.48e-5 * 1e-7 * 0.957 * 0.5), rel=5e-3)
    assert vapour.drying_time(1e-18, 1e-7, 1.8e-5, 293.15, 0.9) == pytest.approx(5.0 * time)
