"""Heating of a film: the heat equation across the gap, the balance of energy, bounds."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_bvp

from contactkit.lubrication.flow_laws import heating
from contactkit.lubrication.flow_laws.newtonian import Newtonian
from contactkit.lubrication.flow_laws.power_law import PowerLaw

GAP, CONDUCTIVITY, CAPACITY = 1e-5, 0.15, 1.7e6


@pytest.mark.parametrize("exponent", [0.3, 1.0, 1.5])
def test_the_conducted_rise_solves_the_heat_equation(exponent):
    """k T'' = -tau rate, with walls of constant temperature, for the flow of each law."""
    law = PowerLaw(consistency=0.5, exponent=exponent)
    gradient = 1e9
    flux = law.flux(gradient, GAP)

    def slopes(z, y):
        stress = gradient * np.abs(z - 0.5) * GAP
        power = stress * (stress / 0.5) ** (1.0 / exponent)
        return np.vstack([y[1], -power * GAP**2 / CONDUCTIVITY])

    z = np.linspace(0.0, 1.0, 101)
    found = solve_bvp(slopes, lambda a, b: np.array([a[0], b[0]]), z, np.zeros((2, 101)), tol=1e-8)
    rise = heating.conduction_rise(gradient * flux, GAP, CONDUCTIVITY, exponent)
    assert rise == pytest.approx(float(found.sol(0.5)[0]), rel=1e-5)


def test_the_adiabatic_rise_keeps_the_energy():
    """Work of a disc of constant volume, 2 F dh, over what warms its liquid."""
    volume, viscosity = 1e-12, 0.1
    work = quad(lambda h: 3.0 * viscosity * volume**2 / (2.0 * math.pi * h**5), 1e-6, 2e-6)[0]
    rise = heating.adiabatic_rise(work, volume, CAPACITY)
    assert rise * volume * CAPACITY == pytest.approx(work, rel=1e-12)


@pytest.mark.parametrize(("time", "expected"), [(1e-9, "adiabatic"), (1e3, "conduction")])
def test_the_bound_that_applies_is_that_of_the_fourier_number(time, expected):
    """Constant power: the adiabatic rise grows with time, the conducted one is steady."""
    flux = 1e-6
    power = Newtonian(viscosity=0.1).gradient(flux, GAP) * flux
    conduction = heating.conduction_rise(power, GAP, CONDUCTIVITY)
    fourier = heating.fourier_number(CONDUCTIVITY / CAPACITY, time, GAP)
    warm = heating.film_heating(power * time, GAP, CAPACITY, conduction, fourier, 0.05)
    assert warm.rise == getattr(warm, expected)
    assert (warm.fourier > 1.0) == (expected == "conduction")
    assert warm.nahme == pytest.approx(0.05 * warm.rise, rel=1e-14)


def test_both_bounds_meet_at_a_fourier_number_of_a_sixteenth():
    """Newtonian: g q h/(16 k) over g q t/(rho c h)."""
    time = GAP**2 / (16.0 * CONDUCTIVITY / CAPACITY)
    power = 3.0
    adiabatic = heating.adiabatic_rise(power * time, GAP, CAPACITY)
    assert heating.conduction_rise(power, GAP, CONDUCTIVITY) == pytest.approx(adiabatic, rel=1e-12)
