"""Forces of films with a rheology against a method of their own, their limits, their motions."""

from __future__ import annotations

import math

import pytest
from films import BARUS, CARREAU, ETA, EYRING, POWER, RIM, ROELANDS, SPHERE, film_scene, force
from scipy.integrate import quad

import contactkit as ck
from contactkit.liquids.rheology.pressure import BarusViscosity
from contactkit.liquids.rheology.shear import EyringViscosity, PowerLawViscosity

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

ALL = ck.ViscousForce(rheology="all")
LAWS = {
    "barus": {"pressure": BARUS},
    "eyring": {"shear": EYRING},
    "carreau": {"shear": CARREAU},
    "power law": {"shear": POWER},
    "eyring and barus": {"shear": EYRING, "pressure": BARUS},
}


def liquid_of(law):
    names = {"shear": "shear_viscosity", "pressure": "pressure_viscosity"}
    return {names[key]: value for key, value in law.items()}


def plan_of(law, *effects, slip=0.0, **more):
    meniscus = {"slip_length_lower": slip, "slip_length_upper": slip} if slip else {}
    return ck.plan(
        film_scene(*(effects or (ALL,)), liquid=liquid_of(law), meniscus=meniscus, **more)
    )


# Another method -----------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("body", ["flat", "sphere"])
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_force_by_profiles_of_velocity(law, body):
    plan = plan_of(law, body=body)
    gap = {"flat": 3e-6, "sphere": 1.2e-6}[body]
    expected = force(gap, 1e-3, body=body, **law)
    assert plan.force(gap, 1e-3) == pytest.approx(expected, rel=2e-4)
    # Each law changes the force by far more than the tolerance.
    plain = ck.plan(film_scene(body=body)).force(gap, 1e-3)
    assert abs(expected / plain - 1.0) > 3e-3


@pytest.mark.slow
def test_force_with_slip_by_profiles_of_velocity():
    plan = plan_of({"shear": CARREAU}, slip=1e-6)
    expected = force(3e-6, 1e-3, shear=CARREAU, slip=1e-6)
    assert plan.force(3e-6, 1e-3) == pytest.approx(expected, rel=2e-4)
    assert expected < 0.6 * plan_of({"shear": CARREAU}).force(3e-6, 1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("law", [BARUS, ROELANDS], ids=["barus", "roelands"])
def test_a_film_that_closes_thickens(law):
    shaken = ck.ImposedSpeed(
        speed=1e-4,
        initial_gap=4e-6,
        final_gap=1e-5,
        vibration=ck.Vibration(amplitude=1e-6, frequency=300.0),
    )
    plan = plan_of({"pressure": law}, loading=shaken)
    expected = force(4e-6, -1.5e-3, pressure=law)
    assert plan.force(4e-6, -1.5e-3) == pytest.approx(expected, rel=2e-4)
    assert expected < -1.02 * ck.plan(film_scene()).force(4e-6, 1.5e-3)


@pytest.mark.slow
def test_truncated_pressure_of_a_film_that_thins():
    limit = ck.TensionLimit(strength=1e5, cavity="truncated")
    for body in ("flat", "sphere"):
        plan = plan_of(LAWS["eyring and barus"], ALL, limit, body=body)
        gap = {"flat": 3e-6, "sphere": 1.2e-6}[body]
        expected = force(gap, 1e-3, strength=1e5, body=body, **LAWS["eyring and barus"])
        assert plan.force(gap, 1e-3) == pytest.approx(expected, rel=3e-4)
        assert expected < 0.7 * plan_of(LAWS["eyring and barus"], body=body).force(gap, 1e-3)


# Closed forms -------------------------------------------------------------------------------


def test_barus_between_flats_by_its_transformation():
    """p = -ln(1 + alpha q)/alpha of the Newtonian tension q."""
    gap, speed, alpha = 3e-6, 1e-3, BARUS.pressure_coefficient
    peak = 3.0 * ETA * speed * RIM**2 / gap**3

    def ring(r):
        newtonian = peak * (1.0 - (r / RIM) ** 2)
        return 2.0 * math.pi * r * math.log1p(alpha * newtonian) / alpha

    expected, _ = quad(ring, 0.0, RIM, epsrel=1e-12)
    assert plan_of(LAWS["barus"]).force(gap, speed) == pytest.approx(expected, rel=1e-6)


def test_one_slipping_wall_between_flats():
    """Flux h^3/(12 eta) (h + 4 b)/(h + b)."""
    plan = ck.plan(film_scene(meniscus={"slip_length_upper": 5e-7}))
    gap = 2e-6
    ratio = (gap + 5e-7) / (gap + 2e-6)
    plain = ck.plan(film_scene())
    assert plan.force(gap, 1e-3) == pytest.approx(ratio * plain.force(gap, 1e-3), rel=1e-12)
    assert plan.film.laws[ck.ViscousForce].rate == "proportional"


def test_slip_under_an_immersed_sphere_is_that_of_vinogradova():
    """2 h/(6 b) [(1 + h/(6 b)) ln(1 + 6 b/h) - 1] of the force, with slip at both walls."""
    gap, slip = 1e-6, 3e-7
    made = {"slip_length_lower": slip, "slip_length_upper": slip}
    immersed = ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Flat(),
            upper=ck.Sphere(radius=SPHERE),
            meniscus=ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=ETA), **made),
        ),
        loading=ck.ImposedSpeed(speed=1e-3, initial_gap=gap, final_gap=1e-5),
        effects=(ck.ViscousForce(),),
    )
    x = 6.0 * slip / gap
    factor = 2.0 / x * ((1.0 + 1.0 / x) * math.log1p(x) - 1.0)
    expected = 6.0 * math.pi * ETA * SPHERE**2 * 1e-3 / gap * factor
    assert ck.plan(immersed).force(gap, 1e-3) == pytest.approx(expected, rel=1e-6)


def test_power_law_between_flats_is_that_of_scott():
    """Far beyond the plateau: 2 pi K a^(n+3)/((n+3) h^(2n+1)) ((2n+1) v/n)^n."""
    law = PowerLawViscosity(exponent=0.6, critical_rate=1e-2)
    n, consistency, gap, speed = 0.6, ETA * 1e-2**0.4, 3e-6, 1e-3
    drive = consistency * ((2.0 * n + 1.0) * speed / n) ** n
    expected = 2.0 * math.pi * drive * RIM ** (n + 3.0) / ((n + 3.0) * gap ** (2.0 * n + 1.0))
    assert plan_of({"shear": law}).force(gap, speed) == pytest.approx(expected, rel=1e-4)


# Limits -------------------------------------------------------------------------------------


@pytest.mark.parametrize("body", ["flat", "sphere"])
@pytest.mark.parametrize(
    "law",
    [
        {"pressure": BarusViscosity(pressure_coefficient=1e-20)},
        {"shear": PowerLawViscosity(exponent=1.0, critical_rate=1.0)},
        {"shear": EyringViscosity(stress=1e15)},
    ],
    ids=["no coefficient", "exponent 1", "endless stress"],
)
def test_what_does_nothing_leaves_the_newtonian_film(law, body):
    plan, plain = plan_of(law, body=body), ck.plan(film_scene(body=body))
    for gap in (2e-6, 9e-6):
        ratio = plan.force(gap, 1e-3) / plain.force(gap, 1e-3)
        assert ratio == pytest.approx(1.0, abs=1e-9)


def test_a_slip_that_fades_leaves_the_newtonian_film():
    for body in ("flat", "sphere"):
        slips = ck.plan(film_scene(body=body, meniscus={"slip_length_lower": 1e-18}))
        plain = ck.plan(film_scene(body=body))
        assert slips.force(3e-6, 1e-3) == pytest.approx(plain.force(3e-6, 1e-3), rel=1e-9)


@pytest.mark.slow
def test_a_film_at_rest_has_no_force():
    plan = plan_of(LAWS["eyring and barus"])
    assert plan.force(3e-6, 0.0) == 0.0
    slow = plan.force(3e-6, 1e-12) / ck.plan(film_scene()).force(3e-6, 1e-12)
    assert slow == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("more", [{}, {"meniscus": {"volume": 1e-11}}])
def test_a_plain_liquid_is_as_before(more):
    """Bit for bit: the choice of a rheology that the liquid does not have changes nothing."""
    one, other = (ck.plan(film_scene(ck.ViscousForce(rheology=r), **more)) for r in (None, "all"))
    assert one.prepared.rheology is other.prepared.rheology is None
    assert one.force(3e-6, 1e-3) == other.force(3e-6, 1e-3)
    assert not one.notes


# Motions ------------------------------------------------------------------------------------


@pytest.mark.slow
def test_time_under_a_constant_pull_is_that_of_a_power_law():
    """v = n/(2n+1) h^2 (F (n+3) h/(2 pi K a^(n+3)))^(1/n), integrated over the gap."""
    n, pull = 0.6, 0.2
    law = PowerLawViscosity(exponent=n, critical_rate=1e-3)
    consistency = ETA * 1e-3**0.4
    loading = ck.ImposedForce(force=pull, initial_gap=1e-6, final_gap=4e-6)
    result = ck.simulate(plan_of({"shear": law}, loading=loading))
    drive = pull * (n + 3.0) / (2.0 * math.pi * consistency * RIM ** (n + 3.0))

    def slowness(h):
        return (2.0 * n + 1.0) / n / (drive * h ** (2.0 * n + 1.0)) ** (1.0 / n)

    expected, _ = quad(slowness, 1e-6, 4e-6, epsrel=1e-12)
    assert result.state.release_time == pytest.approx(expected, rel=1e-4)
    assert result.viscous_impulse == pytest.approx(pull * expected, rel=1e-4)


@pytest.mark.slow
def test_momentum_of_a_mass_that_a_film_holds():
    loading = ck.ImposedForce(force=20.0, mass=10.0, initial_gap=1e-6, final_gap=8e-6)
    result = ck.simulate(plan_of(LAWS["carreau"], loading=loading))
    given = 20.0 * result.state.release_time
    kept = 10.0 * result.state.release_speed
    assert kept > 1e-2 * given
    assert result.viscous_impulse == pytest.approx(given - kept, rel=1e-6)
    # It opens sooner than the film that does not thin.
    plain = ck.simulate(ck.plan(film_scene(loading=loading)))
    assert result.state.release_time < 0.9 * plain.state.release_time


def test_impulse_at_a_speed_is_the_integral_of_the_force():
    plan = plan_of(LAWS["eyring"])
    result = ck.simulate(plan)
    expected, _ = quad(lambda h: plan.force(h, 1e-3) / 1e-3, 1e-6, 1e-5, epsrel=1e-10)
    assert result.viscous_impulse == pytest.approx(expected, rel=1e-8)
    with pytest.raises(ck.NotSimulatedError, match="viscosity depends on shear or pressure"):
        _ = result.of(ck.ViscousForce).newtonian_impulse


def test_impulse_of_a_slipping_film_does_not_depend_on_the_path():
    meniscus = {"slip_length_lower": 3e-7}
    gaps = {"initial_gap": 1e-6, "final_gap": 1e-5}
    within = ck.simulate(
        ck.plan(film_scene(meniscus=meniscus, loading=ck.ImposedTime(time=1.0, **gaps)))
    )
    pulled = ck.simulate(
        ck.plan(film_scene(meniscus=meniscus, loading=ck.ImposedForce(force=1.0, **gaps)))
    )

    def damping(h):
        return 1.5 * math.pi * ETA * RIM**4 / h**3 * (h + 3e-7) / (h + 1.2e-6)

    expected, _ = quad(damping, 1e-6, 1e-5, epsrel=1e-12)
    assert within.viscous_impulse == pytest.approx(expected, rel=1e-9)
    assert pulled.viscous_impulse == pytest.approx(expected, rel=1e-6)
    time = within.of(ck.ViscousForce).time_at_constant_force(1.0)
    assert time == pytest.approx(pulled.state.release_time, rel=1e-5)


def test_a_film_that_draws_in_has_the_force_of_its_radius():
    """A drop of a given volume, at a gap at which it no longer fills the face."""
    drop = {"volume": 0.5 * math.pi * RIM**2 * 2e-6}
    plan = ck.plan(film_scene(ALL, liquid=liquid_of(LAWS["barus"]), meniscus=drop))
    gap, alpha = 4e-6, BARUS.pressure_coefficient
    square = drop["volume"] / (math.pi * gap)
    peak = 3.0 * ETA * 1e-3 * square / gap**3
    # In x = (r/a)^2: the area times the mean of ln(1 + alpha q)/alpha.
    mean, _ = quad(lambda x: math.log1p(alpha * peak * (1.0 - x)) / alpha, 0.0, 1.0)
    assert plan.force(gap, 1e-3) == pytest.approx(math.pi * square * mean, rel=1e-6)
