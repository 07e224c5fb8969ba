"""Squeezed axisymmetric films: closed forms, shooting in radius, limits, extremes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve
from scipy.integrate import quad, solve_ivp

from contactkit.errors import DescriptionError
from contactkit.lubrication import squeeze_film as stefan
from contactkit.lubrication.flow_laws import closed_forms
from contactkit.lubrication.flow_laws.carreau import Carreau
from contactkit.lubrication.flow_laws.eyring import Eyring
from contactkit.lubrication.flow_laws.newtonian import Newtonian
from contactkit.lubrication.flow_laws.power_law import PowerLaw
from contactkit.lubrication.flow_laws.pressure_laws import Barus, Roelands
from contactkit.lubrication.flow_laws.squeeze import squeeze_film, squeeze_force
from contactkit.lubrication.flow_laws.walls import Flats, Paraboloid, Profile

OIL = Newtonian(viscosity=0.1)
SPHERE = Paraboloid(radius=5e-3)
BARUS = Barus(coefficient=2e-8)
ROELANDS = Roelands(viscosity=0.1, exponent=0.6)
CLOSED = 1e-11


def approx(value, rel):
    return pytest.approx(value, rel=rel, abs=0.0)


# Closed forms -------------------------------------------------------------------------------


@pytest.mark.parametrize("speed", [1e-3, -1e-3])
@pytest.mark.parametrize("heights", [(1e-12, 1e-3), (1e-9, 1e-3), (1e-6, 2e-6), (1e-6, 1.01e-6)])
def test_a_newtonian_sphere_is_that_of_matthewson(heights, speed):
    gap, height = heights
    rim = math.sqrt(2.0 * 5e-3 * (height - gap))
    expected = stefan.sphere_force(5e-3, gap, height, speed, 0.1)
    assert squeeze_force(OIL, SPHERE, gap, speed, rim) == approx(expected, CLOSED)


@pytest.mark.parametrize("exponent", [0.1, 0.3, 0.5, 1.0, 1.5])
def test_a_power_law_between_discs_is_that_of_scott(exponent):
    law = PowerLaw(consistency=2.0, exponent=exponent)
    film = squeeze_film(law, Flats(), 1e-4, 1e-3, 5e-3)
    expected = closed_forms.power_law_disc_force(5e-3, 1e-4, 1e-3, 2.0, exponent)
    assert film.force == approx(expected, CLOSED)
    # p(0) = g(a) a/(n + 1), as the gradient is a power of the radius.
    at_rim = law.gradient(0.5 * 5e-3 * 1e-3, 1e-4)
    assert film.centre_pressure == approx(-at_rim * 5e-3 / (exponent + 1.0), CLOSED)


@pytest.mark.parametrize("slip", [1e-10, 1e-7, 1e-5, 1e-2])
def test_slip_under_a_sphere_is_that_of_vinogradova(slip):
    plain = stefan.sphere_force(5e-3, 1e-6, math.inf, 1e-3, 0.1)
    for number, lengths in ((2, slip), (1, (0.0, slip))):
        law = evolve(OIL, slip_length=lengths)
        expected = plain * closed_forms.slip_sphere_factor(1e-6, slip, number)
        assert squeeze_force(law, SPHERE, 1e-6, 1e-3, math.inf) == approx(expected, CLOSED)


@pytest.mark.parametrize("slips", [(1e-7, 1e-7), (0.0, 3e-6), (1e-8, 1e-6)])
def test_slip_between_discs_divides_the_force(slips):
    law = evolve(OIL, slip_length=slips)
    expected = stefan.disc_force(3e-3, 1e-6, 1e-3, 0.1)
    expected *= closed_forms.slip_disc_factor(1e-6, *slips)
    assert squeeze_force(law, Flats(), 1e-6, 1e-3, 3e-3) == approx(expected, CLOSED)


@pytest.mark.parametrize("speed", [1e-9, 1e-3, 0.1, 100.0, -1e-3, -1e-2])
def test_barus_between_discs_has_a_closed_form(speed):
    """From 5e-8 to 5400 times 1/alpha of Newtonian tension: a thin layer at the rim."""
    law = evolve(OIL, pressure_law=BARUS)
    film = squeeze_film(law, Flats(), 1e-5, speed, 3e-3)
    expected = closed_forms.barus_disc_force(3e-3, 1e-5, speed, 0.1, 2e-8)
    assert film.force == approx(expected, CLOSED)
    grown = 3.0 * 2e-8 * 0.1 * speed * 3e-3**2 / 1e-5**3
    assert film.centre_pressure == approx(-math.log1p(grown) / 2e-8, CLOSED)


@pytest.mark.parametrize("speed", [1e-6, 1e-2, 10.0, 1e5])
def test_barus_under_a_sphere_has_a_closed_form(speed):
    law = evolve(OIL, pressure_law=BARUS)
    expected = closed_forms.barus_sphere_force(5e-3, 1e-6, speed, 0.1, 2e-8)
    assert squeeze_force(law, SPHERE, 1e-6, speed, math.inf) == approx(expected, CLOSED)


def test_the_closed_forms_join_their_series():
    at = np.array([1.0 - 1e-9, 1.0 + 1e-9])
    sphere = closed_forms.slip_sphere_factor(1.0, at * 1e-3 / 6.0)
    assert sphere[0] == approx(sphere[1], 1e-11)
    speed = at * 1e-3 * 1e-15 / (3.0 * 2e-8 * 0.1 * 9e-6)
    disc = closed_forms.barus_disc_force(3e-3, 1e-5, speed, 0.1, 2e-8) / speed
    assert disc[0] == approx(disc[1], 1e-11)
    speed = at * 1e-3 * 1e-12 / (3.0 * 2e-8 * 0.1 * 5e-3)
    under = closed_forms.barus_sphere_force(5e-3, 1e-6, speed, 0.1, 2e-8) / speed
    assert under[0] == approx(under[1], 1e-11)


# Shooting -----------------------------------------------------------------------------------

LAWS = {
    "eyring": Eyring(viscosity=0.1, eyring_stress=5e6),
    "carreau": Carreau(viscosity=0.1, relaxation_time=1e-5, exponent=0.4),
    "power-law": PowerLaw(consistency=1e2, exponent=0.3),
    "plateau": PowerLaw(consistency=1e2, exponent=0.3, plateau_viscosity=0.1),
}
PRESSURES = {
    "none": None,
    "barus": BARUS,
    "roelands": ROELANDS,
    "held": Barus(coefficient=2e-8, thins_in_tension=False),
}


def shooting(law, walls, gap, speed, rim, rim_pressure=0.0):
    """Force and pressure at the axis, from the rim inwards by DOP853 in ln(radius)."""
    sign = math.copysign(1.0, speed)

    def slopes(x, y):
        r = rim * math.exp(x)
        gradient = law.gradient(0.5 * r * abs(speed), gap + float(walls.rise(np.array(r))), y[0])
        return [sign * gradient * r, -math.pi * r**3 * gradient]

    depth = 30.0 + math.log(rim / float(walls.core(np.array(gap), np.array(rim))))
    found = solve_ivp(
        slopes, (0.0, -depth), [rim_pressure, 0.0], "DOP853", rtol=1e-9, atol=[1e-3, 1e-12]
    )
    return sign * found.y[1, -1], found.y[0, -1]


@pytest.mark.slow
@pytest.mark.parametrize("pressure", PRESSURES)
@pytest.mark.parametrize("name", LAWS)
def test_films_are_those_of_shooting(name, pressure):
    law = evolve(LAWS[name], pressure_law=PRESSURES[pressure])
    for walls, gap, speed, rim in ((Flats(), 1e-6, 1e-3, 3e-3), (SPHERE, 1e-7, 0.1, 1e-3)):
        film = squeeze_film(law, walls, gap, speed, rim)
        force, centre = shooting(law, walls, gap, speed, rim)
        assert film.force == approx(force, 1e-7)
        assert film.centre_pressure == approx(centre, 1e-6)


def test_a_slipping_film_on_a_cone_that_closes_is_that_of_shooting():
    law = evolve(LAWS["carreau"], slip_length=(0.0, 3e-7), pressure_law=ROELANDS)
    cone = Profile(height=lambda radius: 0.01 * radius)
    film = squeeze_film(law, cone, 1e-6, -1e-3, 1e-3, 2e5)
    force, centre = shooting(law, cone, 1e-6, -1e-3, 1e-3, 2e5)
    assert film.force == approx(force, 1e-7)
    assert film.centre_pressure == approx(centre, 1e-7)


def test_the_power_of_the_force_is_dissipated():
    """Force times speed is the integral of flux times gradient over the film."""
    law = evolve(LAWS["eyring"], slip_length=1e-7)

    def density(x):
        r = 1e-3 * math.exp(x)
        flux = 0.5 * r * 0.1
        height = 1e-7 + float(SPHERE.rise(np.array(r)))
        return 2.0 * math.pi * r * r * flux * law.gradient(flux, height)

    power = quad(density, -25.0, 0.0, epsrel=1e-10, limit=400)[0]
    assert 0.1 * squeeze_force(law, SPHERE, 1e-7, 0.1, 1e-3) == approx(power, 1e-8)


# Limits and extremes ------------------------------------------------------------------------

NEARLY = {
    "n": PowerLaw(consistency=0.1, exponent=1.0),
    "tau_0": Eyring(viscosity=0.1, eyring_stress=1e30),
    "lambda": Carreau(viscosity=0.1, relaxation_time=1e-40, exponent=0.3),
    "alpha": evolve(OIL, pressure_law=Barus(coefficient=1e-30)),
    "alpha=0": evolve(OIL, pressure_law=Barus(coefficient=0.0)),
    "slip": evolve(OIL, slip_length=(0.0, 1e-30)),
}


@pytest.mark.parametrize("name", NEARLY)
def test_limits_are_newtonian(name):
    law = NEARLY[name]
    disc = squeeze_force(law, Flats(), 1e-6, 1e-3, 3e-3)
    assert disc == approx(stefan.disc_force(3e-3, 1e-6, 1e-3, 0.1), 1e-10)
    sphere = squeeze_force(law, SPHERE, 1e-7, -1e-3, math.inf)
    assert sphere == approx(stefan.sphere_force(5e-3, 1e-7, math.inf, -1e-3, 0.1), 1e-10)


def test_a_film_of_constant_volume_follows_its_rim():
    """Between flats Scott's force falls as h^-(2n + 1 + (n + 3)/2)."""
    law, volume = PowerLaw(consistency=2.0, exponent=0.5), 1e-12
    gaps = np.array([1e-6, 2e-6])
    rims = Flats().rim_radius(volume, gaps)
    one, other = squeeze_force(law, Flats(), gaps, 1e-3, rims)
    assert one / other == approx(2.0 ** (2.0 + 1.75), CLOSED)
    rim = SPHERE.rim_radius(np.array(volume), np.array(1e-6))
    by_height = stefan.sphere_film_height(1e-6, volume, 5e-3)
    assert 1e-6 + SPHERE.rise(rim) == approx(by_height, 1e-12)


def test_a_profile_is_the_paraboloid_it_describes():
    profile = Profile(height=lambda radius: radius**2 / 10e-3)
    volume, gap = np.array([1e-15, 1e-12]), np.array(1e-7)
    rim = SPHERE.rim_radius(volume, gap)
    assert profile.rim_radius(volume, gap) == approx(rim, 1e-9)
    law = LAWS["eyring"]
    assert squeeze_force(law, profile, gap, 0.1, rim) == approx(
        squeeze_force(law, SPHERE, gap, 0.1, rim), 1e-10
    )


def test_many_pairs_are_the_single_ones():
    law = evolve(LAWS["carreau"], pressure_law=BARUS)
    gaps, speeds = np.logspace(-8, -5, 9)[:, None], np.logspace(-6, 0, 8)
    together = squeeze_force(law, SPHERE, gaps, speeds, 1e-3)
    assert together.shape == (9, 8)
    for i, j in ((0, 0), (0, 7), (8, 0), (5, 3)):
        alone = squeeze_force(law, SPHERE, gaps[i, 0], speeds[j], 1e-3)
        assert together[i, j] == approx(alone, 1e-9)
    assert (np.diff(together, axis=0) < 0.0).all()
    assert (np.diff(together, axis=1) > 0.0).all()


def test_a_film_at_rest_has_no_force():
    film = squeeze_film(evolve(OIL, pressure_law=BARUS), Flats(), 1e-6, [0.0, 1e-3], 3e-3, 1e5)
    assert film.force[0] == 0.0
    assert film.centre_pressure[0] == 1e5
    assert (film.gradient[0] == 0.0).all()


def test_a_pressure_at_the_rim_sets_the_viscosity():
    law = evolve(OIL, pressure_law=BARUS)
    plain, pressed = (squeeze_force(law, Flats(), 1e-5, 1e-9, 3e-3, p) for p in (0.0, 5e7))
    assert pressed / plain == approx(math.e, 1e-5)


def test_a_closing_film_of_barus_stops_where_no_pressure_carries_it():
    """The Newtonian pressure 3 eta v a^2/h^3 reaches 1/alpha at 0.0185 m/s."""
    law = evolve(OIL, pressure_law=BARUS)
    film = squeeze_film(law, Flats(), 1e-5, [-0.018, -0.019], 3e-3)
    assert film.force[0] == approx(
        closed_forms.barus_disc_force(3e-3, 1e-5, -0.018, 0.1, 2e-8), 1e-8
    )
    assert film.force[1] == -math.inf
    assert film.centre_pressure[1] == math.inf
    # The reduced pressure of this law of Roelands goes up to 1.087/alpha.
    stiff, unit = evolve(OIL, pressure_law=ROELANDS), 1e-15 / (2.7e-6 * ROELANDS.coefficient)
    bearable, beyond = squeeze_force(stiff, Flats(), 1e-5, [-1.05 * unit, -1.1 * unit], 3e-3)
    assert -math.inf < bearable < 0.0
    assert beyond == -math.inf


def test_tension_bounds_lie_on_both_sides():
    """A viscosity that stays is an upper bound of an opening film, one that falls a lower one."""
    falls, stays = (
        squeeze_force(evolve(OIL, pressure_law=law), Flats(), 1e-5, 10.0, 3e-3)
        for law in (BARUS, PRESSURES["held"])
    )
    newtonian = stefan.disc_force(3e-3, 1e-5, 10.0, 0.1)
    assert falls < 0.1 * newtonian
    assert stays == approx(newtonian, CLOSED)


def test_shear_thinning_under_a_touching_sphere_is_bounded():
    """Eyring's stress grows as a logarithm: from 1e-12 m to 1e-15 m the force rises by 2 %."""
    law = Eyring(viscosity=0.1, eyring_stress=5e6)
    near, nearer = squeeze_force(law, SPHERE, [1e-12, 1e-15], 1e-2, 1e-3)
    assert 1.0 < nearer / near < 1.03


@pytest.mark.parametrize("gap", [0.0, -1e-6, math.inf, math.nan])
def test_a_gap_that_is_none_is_refused(gap):
    with pytest.raises(DescriptionError, match=r"gap .*positive and finite"):
        squeeze_force(OIL, Flats(), gap, 1e-3, 3e-3)


def test_a_power_law_without_a_rim_is_refused():
    """The force of n <= 1/3 does not converge outwards."""
    law = PowerLaw(consistency=1.0, exponent=0.5)
    with pytest.raises(DescriptionError, match=r"rim_radius.*finite"):
        squeeze_force(law, SPHERE, 1e-6, 1e-3, math.inf)
    with pytest.raises(DescriptionError, match=r"rim_radius.*finite"):
        squeeze_force(OIL, Flats(), 1e-6, 1e-3, math.inf)


@pytest.mark.parametrize("beyond", [0.9, 1.001, 1.06, 1.5])
def test_a_layer_at_a_rim_next_to_the_core_is_resolved(beyond):
    """Tension of Barus' law under a sphere, whose reduced pressure is the Newtonian one.

    With a panel as narrow as the rim is beyond the core the force was 12 % off.
    """
    alpha, radius, gap, speed, viscosity = 2e-8, 1e-2, 3e-6, 1e3, 0.1
    rim = beyond * math.sqrt(2.0 * radius * gap)
    law = Newtonian(viscosity=viscosity, pressure_law=Barus(coefficient=alpha))
    edge = gap + rim**2 / (2.0 * radius)

    def of(r):
        height = gap + r**2 / (2.0 * radius)
        plain = 3.0 * viscosity * radius * speed * (height**-2 - edge**-2)
        return 2.0 * math.pi * r * math.log1p(alpha * plain) / alpha

    exact = quad(of, 0.0, rim, points=[rim * (1.0 - 1e-4), rim * 0.99], epsrel=1e-11, limit=200)[0]
    found = squeeze_force(law, Paraboloid(radius=radius), gap, speed, rim)
    assert found == pytest.approx(exact, rel=1e-8)
