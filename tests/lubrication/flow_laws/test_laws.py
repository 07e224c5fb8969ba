"""Flow laws against brute quadrature of the velocity, closed forms, limits and extremes."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_bvp
from scipy.optimize import brentq
from scipy.special import hyp2f1

from contactkit.errors import DescriptionError
from contactkit.lubrication.flow_laws.carreau import Carreau
from contactkit.lubrication.flow_laws.eyring import Eyring
from contactkit.lubrication.flow_laws.newtonian import Newtonian
from contactkit.lubrication.flow_laws.power_law import PowerLaw
from contactkit.lubrication.flow_laws.pressure_laws import Barus

GAP = 1e-6  # [m]
EXACT = 1e-13
QUAD = 1e-10

THIN = PowerLaw(consistency=3.0, exponent=0.4)
BENT = PowerLaw(consistency=3.0, exponent=0.4, plateau_viscosity=0.1)
THICK = PowerLaw(consistency=1e-4, exponent=1.4, plateau_viscosity=0.1)
EYRING = Eyring(viscosity=0.1, eyring_stress=5e5)
CARREAU = Carreau(viscosity=0.1, relaxation_time=1e-6, exponent=0.4, limit_viscosity=1e-3)
YASUDA = Carreau(viscosity=0.1, relaxation_time=1e-6, exponent=0.7, transition=0.8)


def carreau_rate(law, stress):
    """Shear rate at a stress, by bisection of the definition."""

    def excess(log_rate):
        rate = math.exp(log_rate)
        bent = 1.0 + (law.relaxation_time * rate) ** law.transition
        thins = (law.viscosity - law.limit_viscosity) * bent ** (
            (law.exponent - 1.0) / law.transition
        )
        return (law.limit_viscosity + thins) * rate - stress

    return math.exp(brentq(excess, -200.0, 200.0, xtol=1e-13, rtol=1e-14)) if stress else 0.0


# Shear rate over stress as each law defines it, written down again, and a gradient [Pa/m] in the
# range where it bends.
CASES = {
    "newtonian": (Newtonian(viscosity=0.1), lambda t: t / 0.1, 1e12),
    "power-law": (THIN, lambda t: (t / 3.0) ** 2.5, 1e12),
    "plateau": (BENT, lambda t: max(t / 0.1, (t / 3.0) ** 2.5), 1.2e8),
    "thickens": (THICK, lambda t: min(t / 0.1, (t / 1e-4) ** (1 / 1.4)), 1.5e13),
    "eyring": (EYRING, lambda t: 5e6 * math.sinh(t / 5e5), 1e13),
    "eyring-small": (EYRING, lambda t: 5e6 * math.sinh(t / 5e5), 3e11),
    "carreau": (CARREAU, lambda t: carreau_rate(CARREAU, t), 1e12),
    "yasuda": (YASUDA, lambda t: carreau_rate(YASUDA, t), 1e12),
}
# Stresses [Pa] at which the plateaus above end; quadrature across that kink is off by 3e-10.
KINKS = [(3.0**2.5 / 0.1) ** (1.0 / 1.5), (0.1 * 1e4 ** (1 / 1.4)) ** 3.5]
SLIPS = [(0.0, 0.0), (1e-7, 1e-7), (0.0, 2e-6), (3e-7, 1e-7)]


def brute_flux(rate, gradient, gap, slips):
    """Flux by quadrature of the rate over the stress, with the plane without stress searched."""

    def moment(stress, power):
        ends = [0.0, *(kink for kink in KINKS if kink < stress), stress]
        return sum(
            quad(lambda s: s**power * rate(s), *part, epsabs=0.0, epsrel=1e-11, limit=400)[0]
            for part in pairwise(ends)
        )

    lower, upper = slips

    def jump(plane):
        below, above = gradient * plane, gradient * (gap - plane)
        one = lower * rate(below) + moment(below, 0) / gradient
        return one - upper * rate(above) - moment(above, 0) / gradient

    plane = brentq(jump, 0.0, gap, xtol=1e-20, rtol=1e-12) if lower != upper else 0.5 * gap
    below, above = gradient * plane, gradient * (gap - plane)
    slipped = lower * rate(below) * plane + upper * rate(above) * (gap - plane)
    return slipped + (moment(below, 1) + moment(above, 1)) / gradient**2


@pytest.mark.parametrize("slips", [(0.0, 0.0), (0.0, 2e-6)])
@pytest.mark.parametrize("name", CASES)
def test_the_flux_is_the_quadrature_of_the_velocity(name, slips):
    law, rate, gradient = CASES[name]
    slipping = evolve(law, slip_length=slips)
    expected = brute_flux(rate, gradient, GAP, slips)
    assert slipping.flux(gradient, GAP) == pytest.approx(expected, rel=QUAD)


@pytest.mark.parametrize("slips", SLIPS)
@pytest.mark.parametrize("name", CASES)
def test_gradient_and_flux_are_inverse(name, slips):
    law = evolve(CASES[name][0], slip_length=slips, pressure_law=Barus(coefficient=2e-8))
    flux = np.logspace(-20, 2, 12)
    if isinstance(law, Eyring):
        flux = flux[:11]
    gradient = law.gradient(flux, GAP, 1e8)
    assert law.flux(gradient, GAP, 1e8) == pytest.approx(flux, rel=EXACT)
    assert (np.diff(gradient) > 0.0).all()
    assert law.gradient(-flux, GAP, 1e8) == pytest.approx(-gradient, rel=EXACT)


def test_the_velocity_of_an_eyring_film_solves_its_boundary_value_problem():
    """u' = rate(tau), tau' = dp/dx, with u = 0 at both walls, by collocation across the gap."""
    gradient, stress = 4e12, 5e5

    def slopes(z, y):
        return np.vstack([5e6 * np.sinh(y[1] / stress), np.full(z.size, gradient * GAP)])

    z = np.linspace(0.0, 1.0, 201)
    start = np.vstack([-1e7 * z * (1.0 - z), gradient * GAP * (z - 0.5)])
    found = solve_bvp(slopes, lambda a, b: np.array([a[0], b[0]]), z, start, tol=1e-6)
    assert found.success
    flux = -quad(lambda x: found.sol(x)[0], 0.0, 1.0, limit=200)[0] * GAP * GAP
    assert EYRING.flux(gradient, GAP) == pytest.approx(flux, rel=1e-5)


@pytest.mark.parametrize("ratio", [1e-3, 1.0, 30.0, 1e8])
@pytest.mark.parametrize("shape", [(0.5, 2.0), (0.1, 2.0), (0.3, 5.0), (0.9, 0.5)])
def test_the_moments_of_carreau_are_hypergeometric(shape, ratio):
    """Integral of the squared stress over the rate is 2F1; by parts it is the apparent rate."""
    n, a = shape
    law = Carreau(viscosity=2.0, relaxation_time=1e-3, exponent=n, transition=a)
    rate = ratio / 1e-3
    bent = hyp2f1(3.0 / a, 2.0 * (1.0 - n) / a, 1.0 + 3.0 / a, -(ratio**a))
    thins = (1.0 + ratio**a) ** ((n - 1.0) / a)
    expected = 1.5 * rate * (1.0 - bent / (3.0 * thins**2))
    found = float(law.wall_flow(np.array([rate])).apparent_rate[0])
    assert found == pytest.approx(expected, rel=1e-10)


LIMITS = {
    "n = 1": PowerLaw(consistency=0.1, exponent=1.0),
    "tau_0 -> inf": Eyring(viscosity=0.1, eyring_stress=1e30),
    "lambda -> 0": Carreau(viscosity=0.1, relaxation_time=1e-40, exponent=0.3),
    "Carreau n = 1": Carreau(viscosity=0.1, relaxation_time=1.0, exponent=1.0),
    "alpha -> 0": Newtonian(viscosity=0.1, pressure_law=Barus(coefficient=0.0)),
    "b -> 0": Newtonian(viscosity=0.1, slip_length=1e-40),
    "plateau": PowerLaw(consistency=3.0, exponent=0.4, plateau_viscosity=0.1),
}


@pytest.mark.parametrize("name", LIMITS)
def test_limits_are_newtonian(name):
    flux = 1e-14 if name == "plateau" else 1e-9
    expected = 12.0 * 0.1 * flux / GAP**3
    assert LIMITS[name].gradient(flux, GAP, 1e7) == pytest.approx(expected, rel=1e-10)
    assert LIMITS[name].wall_shear_rate(flux, GAP) == pytest.approx(6.0 * flux / GAP**2, rel=1e-10)
    assert LIMITS[name].mean_shear_rate(flux, GAP) == pytest.approx(3.0 * flux / GAP**2, rel=1e-10)


@pytest.mark.parametrize("slips", SLIPS)
def test_the_slip_of_a_newtonian_liquid_has_a_closed_form(slips):
    one, other = slips
    both, product = one + other, one * other
    more = 1.0 + (3.0 * both * GAP + 12.0 * product) / (GAP * (GAP + both))
    law = Newtonian(viscosity=0.1, slip_length=slips)
    assert law.flux(1e10, GAP) == pytest.approx(more * 1e10 * GAP**3 / 1.2, rel=EXACT)


def test_a_wall_that_slips_freely_leaves_a_quarter():
    for law in (Newtonian(viscosity=0.1), THIN, EYRING):
        half = evolve(law, slip_length=(0.0, 1e40))
        # A symmetric film of twice the gap has the same middle: half its flux, the same gradient.
        expected = 0.5 * law.flux(1e11, 2.0 * GAP)
        assert half.flux(1e11, GAP) == pytest.approx(expected, rel=1e-9)


def test_which_wall_slips_changes_nothing_but_how_much_does():
    one, other = (evolve(EYRING, slip_length=s) for s in ((1e-7, 4e-7), (4e-7, 1e-7)))
    assert one.gradient(1e-5, GAP) == other.gradient(1e-5, GAP)
    assert one.gradient(1e-5, GAP) < evolve(EYRING, slip_length=1e-7).gradient(1e-5, GAP)


def test_the_stress_is_half_the_gap_times_the_gradient():
    """Balance of forces on the liquid, whatever the law."""
    for law, _, gradient in CASES.values():
        flux = law.flux(gradient, GAP)
        assert law.wall_stress(flux, GAP) == pytest.approx(0.5 * GAP * gradient, rel=EXACT)


def test_a_pressure_divides_rates_at_a_stress_by_the_growth_of_the_viscosity():
    pressed = evolve(CARREAU, pressure_law=Barus(coefficient=2e-8))
    assert pressed.flux(1e12, GAP, 5e7) == pytest.approx(
        CARREAU.flux(1e12, GAP) / math.e, rel=EXACT
    )
    thin = evolve(THIN, pressure_law=Barus(coefficient=2e-8))
    grown = math.exp(0.4)  # K grows as M^n
    assert thin.gradient(1e-9, GAP, 5e7) == pytest.approx(
        grown * THIN.gradient(1e-9, GAP), rel=EXACT
    )


@pytest.mark.parametrize(
    "law",
    [
        PowerLaw(consistency=3.0, exponent=0.1),
        evolve(EYRING, slip_length=(0.0, 1e-7)),
        evolve(CARREAU, exponent=0.1),
        evolve(CARREAU, slip_length=1e-3, pressure_law=Barus(coefficient=2e-8)),
        evolve(THICK, slip_length=(1e-9, 1e-3)),
    ],
    ids=lambda law: type(law).__name__,
)
def test_extremes_stay_finite_and_consistent(law):
    """Shear rates up to 1e12/s, pressures up to 20/alpha and down to -1 GPa."""
    flux = 1e12 * GAP**2 / 6.0 * np.logspace(-24, 0, 9)[:, None]
    pressure = np.array([-1e9, -1e5, 0.0, 1e8, 1e9])
    gradient = law.gradient(flux, GAP, pressure)
    assert np.isfinite(gradient).all()
    assert (gradient > 0.0).all()
    assert law.flux(gradient, GAP, pressure) == pytest.approx(
        np.broadcast_to(flux, gradient.shape), rel=1e-12, abs=0.0
    )


@pytest.mark.parametrize("law", [EYRING, CARREAU, BENT], ids=lambda law: type(law).__name__)
def test_unlike_slip_holds_up_to_the_largest_rates(law):
    """Eyring's velocities at both walls are exponentials of stresses 60 times its own."""
    slips = evolve(law, slip_length=(6e-6, 7e-9))
    flux = np.logspace(-30, 18, 17)
    gradient = slips.gradient(flux, 1.6e-9)
    assert slips.flux(gradient, 1.6e-9) == pytest.approx(flux, rel=1e-12)


def test_nothing_flows_without_a_gradient():
    for law, _, _ in CASES.values():
        assert law.flux(0.0, GAP) == law.gradient(0.0, GAP) == law.wall_stress(0.0, GAP) == 0.0
        assert law.gradient(np.array([0.0, 1e-9]), GAP)[0] == 0.0


def test_shapes_follow_the_arguments():
    assert isinstance(EYRING.gradient(1e-9, GAP), float)
    assert EYRING.gradient(np.full((3, 1), 1e-9), np.full(4, GAP)).shape == (3, 4)


@given(st.floats(1e-16, 1e-2), st.floats(0.15, 1.0), st.floats(1e-9, 1e3), st.floats(0.0, 1e-5))
def test_a_liquid_that_thins_or_slips_flows_no_harder(flux, exponent, time, slip):
    law = Carreau(viscosity=0.1, relaxation_time=time, exponent=exponent, slip_length=slip)
    newtonian = Newtonian(viscosity=0.1).gradient(flux, GAP)
    assert 0.0 < law.gradient(flux, GAP) <= newtonian * (1.0 + EXACT)


@pytest.mark.parametrize(
    ("kind", "given", "field"),
    [
        (Newtonian, {"viscosity": 0.0}, "Newtonian.viscosity"),
        (Newtonian, {"viscosity": 0.1, "slip_length": -1e-9}, "Newtonian.slip_length"),
        (Newtonian, {"viscosity": 0.1, "slip_length": (1e-9,)}, "Newtonian.slip_length"),
        (PowerLaw, {"consistency": 1.0, "exponent": math.nan}, "PowerLaw.exponent"),
        (
            PowerLaw,
            {"consistency": 1.0, "exponent": 1.0, "plateau_viscosity": 2.0},
            "PowerLaw.plateau_viscosity",
        ),
        (Eyring, {"viscosity": 0.1, "eyring_stress": 0.0}, "Eyring.eyring_stress"),
        (
            Carreau,
            {"viscosity": 0.1, "relaxation_time": -1.0, "exponent": 0.5},
            "Carreau.relaxation_time",
        ),
    ],
)
def test_a_law_refuses_what_has_no_meaning(kind, given, field):
    with pytest.raises(DescriptionError, match=field.replace(".", r"\.")):
        kind(**given)
