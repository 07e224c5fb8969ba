"""Cavities at the edges of what there is: strengths, viscosities, thin films, many cycles."""

import math
import random

import pytest

import contactkit as ck
from contactkit.separation.cavity.law import CavityLaw
from contactkit.separation.cavity.path import along_path
from contactkit.separation.cavity.stages import shown_cavity
from contactkit.separation.cavity.state import FULL, Phase
from contactkit.separation.motion.advance import advance
from contactkit.separation.motion.state import Pull, outputs, start

pytestmark = [pytest.mark.hard, pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")]

AMBIENT = 1e5


def film(radius=3.175e-3, gap=5e-6, viscosity=0.1, volume=None, strength=1e6, drop=None, **loading):
    face = ck.Flat(radius=radius)
    liquid = ck.Liquid(name="oil", viscosity=viscosity)
    meniscus = ck.Meniscus(liquid=liquid, volume=volume)
    given = {"initial_gap": gap, "final_gap": 5.0 * gap, "force": 40.0, "mass": 0.02} | loading
    drop = strength if drop is None else drop
    limit = ck.TensionLimit(
        strength=strength, cavity_pressure=AMBIENT - drop, ambient_pressure=AMBIENT
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=meniscus),
        loading=ck.ImposedForce(**given),
        effects=(ck.ViscousForce(), limit),
    )


def released(**given):
    return ck.simulate(ck.plan(film(**given))).state.release_time


def test_without_strength_the_film_is_dry_and_with_enough_it_never_cavitates():
    dry = math.sqrt(2.0 * 0.02 * 20e-6 / 40.0)
    assert released(strength=1e-3) == pytest.approx(dry, rel=1e-5)
    whole = film(strength=1e12)
    plain = ck.SeparationScene(
        interface=whole.interface, loading=whole.loading, effects=(ck.ViscousForce(),)
    )
    never = ck.simulate(ck.plan(plain)).state.release_time
    assert released(strength=1e12) == pytest.approx(never, rel=1e-9)


@pytest.mark.parametrize("viscosity", [1e-6, 1e-3, 1.0, 1e3, 1e6])
def test_any_viscosity_is_released_between_dry_and_held_by_the_cavity(viscosity):
    """However stiff the film, it holds area times tension and no more."""
    dry = math.sqrt(2.0 * 0.02 * 20e-6 / 40.0)
    held = math.pi * 3.175e-3**2 * 1e6
    slowest = math.sqrt(2.0 * 0.02 * 20e-6 / (40.0 - held))
    found = released(viscosity=viscosity)
    assert dry * (1.0 - 1e-9) < found < slowest * (1.0 + 1e-6)
    if viscosity >= 1e3:
        assert found == pytest.approx(slowest, rel=1e-2)


@pytest.mark.parametrize("gap", [2e-9, 1e-7, 1e-4])
@pytest.mark.parametrize("radius", [1e-6, 1e-2])
def test_thin_and_thick_films_cavitate_as_the_dimensionless_film_does(gap, radius):
    """Forces with area times tension, times with the root of mass times gap over that."""
    strength = 1e6
    force = 1.3 * math.pi * radius**2 * strength
    mass = 1e-3 * force
    scale = math.sqrt(mass * gap / force)
    # the same ratio of viscous to inertial time everywhere
    viscosity = 1e-2 * strength * gap**2 / radius**2 * scale
    found = released(
        gap=gap, radius=radius, force=force, mass=mass, viscosity=viscosity, strength=strength
    )
    again = released(
        gap=1e-6,
        radius=1e-3,
        force=1.3 * math.pi,
        mass=1e-3 * 1.3 * math.pi,
        viscosity=1e-2 * strength * 1e-6 * math.sqrt(1e-9),
        strength=strength,
    )
    assert found / scale == pytest.approx(again / math.sqrt(1e-9), rel=1e-5)


@pytest.mark.parametrize("excess", [1e-12, 1e-6, 1e-3])
def test_a_pull_that_barely_cavitates_the_film_does(excess):
    """Two pressures, so that all is at stake: at rest it cavitates at half of strength x area."""
    half = 0.5 * math.pi * 3.175e-3**2 * 1e6
    cavitated = film(force=half * (1.0 + excess), drop=1e5, mass=1e-6)
    state = advance(
        ck.plan(cavitated), start(ck.plan(cavitated)), Pull(half * (1.0 + excess)), 1e-3
    )
    whole = film(force=half * (1.0 - 1e-6), drop=1e5, mass=1e-6)
    kept = advance(ck.plan(whole), start(ck.plan(whole)), Pull(half * (1.0 - 1e-6)), 1e-4)
    assert kept.n_inceptions == 0
    assert state.n_inceptions == (excess > 1e-9) or state.n_inceptions == 1


def oscillating(count, viscosity=0.05):
    """Edge at its largest in each cycle of an oscillating disc."""
    law = CavityLaw(1, 25e-6, math.inf, viscosity, 1e5, 1e5)
    pace = math.tau * 50.0

    def place(time):
        angle = pace * time
        return 20e-6 - 10e-6 * math.cos(angle), pace * 10e-6 * math.sin(angle)

    cavity, widest, step = FULL, [], 0.0
    for n in range(count):
        largest = 0.0
        for point in along_path(law, cavity, place, 0.02 * n, 0.02 * (n + 1), 1e-6, step):
            cavity, step = point.cavity, point.step
            largest = max(largest, cavity.fraction)
        assert cavity.phase is Phase.FULL
        assert shown_cavity(law, FULL, *place(0.0)).void == 0.0
        widest.append(math.sqrt(largest))
    return widest


def test_the_tenth_cycle_is_as_the_first():
    widest = oscillating(10)
    assert widest[-1] == pytest.approx(widest[0], rel=1e-6)


@pytest.mark.exhaustive
def test_the_thousandth_cycle_is_as_the_first():
    widest = oscillating(1000)
    assert max(widest) - min(widest) < 2e-6


@pytest.mark.parametrize("seed", range(6))
def test_any_history_of_pulls_leaves_a_film_that_is_possible(seed):
    """Thin to thick, weak to strong, flooded or not, pulled and pressed at random."""
    chance = random.Random(seed)
    radius, gap = 10.0 ** chance.uniform(-4, -2), 10.0 ** chance.uniform(-7.5, -4.5)
    strength, area = 10.0 ** chance.uniform(4, 7), math.pi * radius**2
    force = area * strength * 10.0 ** chance.uniform(-1.0, 1.0)
    mass = 10.0 ** chance.uniform(-5, 0)
    plan = ck.plan(
        film(
            radius,
            gap,
            10.0 ** chance.uniform(-3, 2),
            chance.choice([None, area * gap]),
            strength,
            strength * chance.choice([1.0, 0.1]),
            force=force,
            mass=mass,
            rest_gap=0.5 * gap,
        )
    )
    state, span = start(plan), math.sqrt(10.0 * mass * gap / force)
    for _ in range(8):
        pull = force * chance.choice([1.0, 1.0, -1.0, 0.3, 0.0, 2.0])
        state = advance(plan, state, Pull(pull), span * 10.0 ** chance.uniform(-1.0, 0.7))
        rim, _ = plan.film.cavity.rim(state.gap, state.cavity.void)
        assert 0.0 <= state.cavity.void <= math.pi * rim * state.gap * (1.0 + 1e-9)
        assert 0.0 <= state.cavity.fraction < 1.0
        assert math.isfinite(outputs(plan, state, pull).film)
        if state.gap > 1e3 * gap:
            break
