"""How long a constant pull takes: closed forms, quadrature, and the motion of a massless body."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

import contactkit as ck
from contactkit.lubrication import constant_force
from contactkit.lubrication import squeeze_film as squeeze

# The printed injector is outside the range of its models, and reports it.
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

VOLUME, START, END, OIL = 6.333843488718721e-11, 2e-6, 20e-6, 0.1
WETTING = 0.05  # surface tension times the cosines [N/m]
FACE = math.sqrt(VOLUME / (math.pi * START))


def approx(value, rel):
    return pytest.approx(value, rel=rel, abs=0.0)


def conserved(pull, wetting=WETTING, start=START, end=END):
    return constant_force.disc_time_conserved(VOLUME, start, end, OIL, wetting, pull)


def flooded(pull, wetting=WETTING, start=START, end=END):
    return constant_force.disc_time_flooded(FACE, start, end, OIL, wetting, pull)


def by_quadrature(pull, wetting, radius, start=START, end=END):
    """Integral of c dh/(F - F_m), by the forces themselves."""

    def rate(x):
        gap = math.exp(x)
        meniscus = wetting * math.pi * radius(gap) ** 2 / gap
        return gap * squeeze.disc_force(radius(gap), gap, 1.0, OIL) / (pull - meniscus)

    return quad(rate, math.log(start), math.log(end), epsrel=1e-12, epsabs=0.0)[0]


def drawn_in(gap):
    return squeeze.disc_radius(VOLUME, gap)


def full(_gap):
    return FACE


def test_the_reference_case_takes_its_time(viscous_cases):
    case = viscous_cases["flat_constant_force_F=5"]
    given = (case["V_m3"], case["h0_m"], case["hs_m"], case["eta_Pa_s"])
    pull, wetting = case["F_N"], case["gamma_c_N_m"]
    time = constant_force.disc_time_conserved(*given, wetting, pull)
    assert time == approx(case["t_with_meniscus_s"], 1e-13)
    viscous_only = constant_force.disc_time_conserved(*given, 0.0, pull)
    assert viscous_only == approx(case["t_viscous_only_s"], 1e-13)


@pytest.mark.parametrize(
    ("pull", "wetting", "time"),
    [
        (5.0, WETTING, 0.670315),
        (5.0, 0.0, 0.598525),
        (10.0, WETTING, 0.316062),
        (100.0, WETTING, 0.0300852),
    ],
)
def test_the_printed_times_come_out(pull, wetting, time):
    assert conserved(pull, wetting) == approx(time, 2e-6)  # six digits are printed


@pytest.mark.parametrize("pull", [0.8, 1.0, 5.0, 100.0, 1e4, 1e8])
@pytest.mark.parametrize("wetting", [0.05, 1e-3, 1e-9, 1e-15, 0.0, -1e-9, -0.05])
def test_the_closed_form_is_the_integral_of_resistance_over_pull(pull, wetting):
    """Tiny wetting cancels in the formula as printed; repelling pairs open sooner."""
    assert conserved(pull, wetting) == approx(by_quadrature(pull, wetting, drawn_in), 1e-11)
    assert flooded(pull, wetting) == approx(by_quadrature(pull, wetting, full), 1e-11)


def test_between_the_series_and_the_logarithm_nothing_jumps():
    """The formula changes where the meniscus takes a tenth of the pull."""
    at = 10.0 * WETTING * VOLUME / START**2
    for time in (conserved, flooded):
        below, above = time(at * (1.0 - 1e-9)), time(at * (1.0 + 1e-9))
        # The time falls as about 1/pull: 2e-9 between the two, and 1e-14 of rounding.
        assert below / above - 1.0 == pytest.approx(2e-9, rel=0.3)


@pytest.mark.parametrize("time", [conserved, flooded])
def test_a_pull_below_the_meniscus_never_opens_the_gap(time):
    holding = WETTING * VOLUME / START**2
    assert time(holding) == math.inf
    assert time(0.5 * holding) == math.inf
    assert time(0.0) == math.inf
    assert time(-1.0) == math.inf
    assert math.isfinite(time(1.0001 * holding))


@pytest.mark.parametrize("time", [conserved, flooded])
def test_without_a_meniscus_time_is_impulse_over_pull(time):
    impulse = (
        squeeze.disc_impulse_conserved(VOLUME, START, END, OIL)
        if time is conserved
        else squeeze.disc_impulse_flooded(FACE, START, END, OIL)
    )
    assert time(5.0, 0.0) == approx(impulse / 5.0, 1e-13)


@pytest.mark.parametrize("time", [conserved, flooded])
@pytest.mark.parametrize("wetting", [WETTING, 0.0, -WETTING])
def test_a_way_may_be_walked_in_two_parts(time, wetting):
    parts = time(5.0, wetting, START, 3e-6) + time(5.0, wetting, 3e-6, END)
    assert parts == approx(time(5.0, wetting), 1e-12)


@pytest.mark.parametrize("time", [conserved, flooded])
def test_a_gap_may_be_opened_to_infinity(time):
    # What is left beyond a thousand gaps is 1e-6 (flooded) and 1e-12 (conserving) of it.
    assert time(5.0, 0.0, START, math.inf) == approx(time(5.0, 0.0, START, 1e3 * START), 2e-6)
    assert math.isfinite(time(5.0, WETTING, START, math.inf))


# The same, from a scene ---------------------------------------------------------------------

ANGLE = 0.0  # no line tension: the published meniscus is then the Laplace pressure alone
PULLED = {"initial_gap": START, "final_gap": END}


def injector(film_scene, *effects, volume=VOLUME, face=FACE, **loading):
    flat = ck.Flat(radius=face)
    return film_scene(
        *effects,
        lower=flat,
        upper=flat,
        liquid={"surface_tension": WETTING / 2.0},
        film={"volume": volume, "contact_angle_lower": ANGLE, "contact_angle_upper": ANGLE},
        **(PULLED | loading),
    )


LAPLACE = ck.MeniscusForce(profile=ck.AsPublished(radius="disc"))


def test_a_result_gives_the_time_of_a_pull(film_scene):
    scene = injector(film_scene, ck.MeniscusForce(), ck.ViscousForce(), time=1.0)
    viscous = ck.simulate(ck.plan(scene)).of(ck.ViscousForce)
    assert viscous.time_at_constant_force(5.0) == approx(conserved(5.0), 1e-13)
    assert viscous.time_at_constant_force(0.5) == math.inf


def test_a_film_full_at_first_draws_in_later(film_scene):
    """Flooded to the gap at which the volume just fills the faces, conserving beyond."""
    scene = injector(film_scene, ck.ViscousForce(), volume=3.0 * VOLUME, time=1.0)
    time = ck.simulate(ck.plan(scene)).of(ck.ViscousForce).time_at_constant_force(5.0)
    turn = 3.0 * START
    later = constant_force.disc_time_conserved(3.0 * VOLUME, turn, END, OIL, 0.0, 5.0)
    assert time == approx(flooded(5.0, 0.0, START, turn) + later, 1e-12)


@pytest.mark.parametrize("count", [1, 100])
def test_each_of_many_menisci_carries_its_part(film_scene, count):
    """N films of V/N share the faces: each has the wetted area over N and takes F/N."""
    scene = film_scene(
        ck.MeniscusForce(),
        ck.ViscousForce(),
        lower=ck.Flat(radius=FACE),
        upper=ck.Flat(radius=FACE),
        liquid={"surface_tension": WETTING / 2.0},
        film={"volume": VOLUME, "count": count},
        time=1.0,
        **PULLED,
    )
    time = ck.simulate(ck.plan(scene)).of(ck.ViscousForce).time_at_constant_force(5.0)
    one = constant_force.disc_time_conserved(VOLUME / count, START, END, OIL, WETTING, 5.0 / count)
    assert time == approx(one, 1e-12)


def test_the_time_of_a_small_sphere_is_as_exact_as_that_of_a_large_one(film_scene):
    """50 ps for the impulse over the pull: the quadrature may have no absolute tolerance."""
    scene = film_scene(
        ck.ViscousForce(),
        lower=ck.Sphere(radius=1e-6),
        film={"volume": 1e-22},
        time=1.0,
        initial_gap=1e-10,
        final_gap=1e-4,
    )
    viscous = ck.simulate(ck.plan(scene)).of(ck.ViscousForce)
    assert viscous.time_at_constant_force(1e-3) == approx(viscous.impulse / 1e-3, 1e-9)


def test_a_sphere_held_by_its_meniscus_takes_longer_or_for_ever(film_scene):
    scene = film_scene(
        ck.MeniscusForce(profile="as-published"),
        ck.ViscousForce(),
        upper=ck.Sphere(radius=1e-3),
        film={"volume": 1e-15},
        time=1.0,
        initial_gap=1e-8,
        final_gap=1e-6,
    )
    viscous = ck.simulate(ck.plan(scene)).of(ck.ViscousForce)
    holding = 4.0 * math.pi * 1e-3 * 0.03  # 2 pi R gamma (c1 + c2)
    assert viscous.time_at_constant_force(0.9 * holding) == math.inf
    free = viscous.impulse / (2.0 * holding)
    assert free < viscous.time_at_constant_force(2.0 * holding) < 2.0 * free


@pytest.mark.parametrize("closure", ["volume-conserving", "flooded"])
@pytest.mark.parametrize("pull", [5.0, 100.0])
def test_the_motion_of_a_body_without_mass_takes_this_time(film_scene, pull, closure):
    """Two codes: a closed form, and the time step with next to no mass."""
    scene = injector(film_scene, LAPLACE, ck.ViscousForce(closure=closure), force=pull)
    result = ck.simulate(ck.plan(scene))
    if closure == "volume-conserving":
        expected = conserved(pull)
        viscous = result.of(ck.ViscousForce)
        assert viscous.time_at_constant_force() == approx(expected, 1e-12)
    else:  # here only the film stays full; its meniscus draws in

        def rate(x):
            gap = math.exp(x)
            resistance = squeeze.disc_force(FACE, gap, 1.0, OIL)
            return gap * resistance / (pull - WETTING * VOLUME / gap**2)

        expected = quad(rate, math.log(START), math.log(END), epsrel=1e-12, epsabs=0.0)[0]
    # time_rtol is 1e-8 for each step; the rest is the momentum of the little mass, 1e-10.
    assert result.state.release_time == approx(expected, 1e-7)
