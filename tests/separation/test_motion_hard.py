"""Motions that are hard to follow: stuck, ruptured, resting, closing, light, heavy, limited."""

from __future__ import annotations

import math

import pytest
from selection import quick

import contactkit as ck
from contactkit.lubrication import squeeze_film as squeeze
from contactkit.separation.motion.state import Pull, outputs, start

pytestmark = [
    pytest.mark.hard,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

PUBLISHED = ck.MeniscusForce(profile=ck.AsPublished(radius="disc"))
VISCOUS = ck.ViscousForce()
FORCES = (PUBLISHED, VISCOUS)
FACE = 3.175e-3
FILM = math.pi * FACE**2 * 5e-6  # volume of the film of case B [m3]


def approx(value, rel):
    return pytest.approx(value, rel=rel, abs=0.0)


def is_finite(state):
    cavity = sum([*state.cavity[:3], *(sum(piece) for piece in state.cavity.history)])
    plain = state._replace(impulses=sum(state.impulses.values()), cavity=cavity)
    return all(math.isfinite(number) for number in plain)


def walk(made, pull, span, count, state=None):
    state = start(made) if state is None else state
    begin = state.time
    for i in range(1, count + 1):
        state = ck.advance(made, state, pull, begin + span * i / count - state.time)
    assert is_finite(state)
    return state


def run(scene, accuracy=None):
    result = ck.simulate(ck.plan(scene, accuracy))
    assert is_finite(result.state)
    return result


# Stuck --------------------------------------------------------------------------------------


@pytest.mark.parametrize("pull", [100.0, 1.0, 0.0, -5.0])
def test_a_pull_below_the_meniscus_is_stuck_and_reported(release_scene, pull):
    """10 nm under the full disc: 186 N hold against the pull."""
    scene = release_scene("B", initial_gap=1e-8, force=pull, rise_time=0.0, time_limit=10.0)
    result = ck.simulate(ck.plan(scene), throw=pull >= 0.0)
    assert is_finite(result.state)
    assert result.status in ("stuck", "time limit")
    assert 0.0 < result.state.gap <= 1e-8
    assert result.state.release_time == -1.0
    assert result.work.n_steps < 10_000


def test_stuck_names_the_two_forces(release_scene):
    scene = release_scene("B", initial_gap=1e-8, force=40.0, rise_time=0.0)
    result = run(scene)
    assert result.status == "stuck"
    assert "the pull of 40 N does not exceed the 186" in result.message
    assert "pull harder" in result.message


def test_a_stuck_film_yields_slowly_under_its_own_meniscus(release_cases, release_scene):
    """Coupling note 4.4: in 4 s the gap shrinks from 10 nm to 9.988 nm."""
    case = release_cases["B"]["case"]
    scene = release_scene(
        "B", initial_gap=1e-8, rise_time=0.0, meniscus={"volume": math.pi * case["R"] ** 2 * 1e-8}
    )
    made = ck.plan(scene)
    state = walk(made, ck.Pull(40.0), 4.0, 1)
    assert state.gap == approx(9.988e-9, 5e-5)
    assert outputs(made, state, 40.0).status is ck.FilmStatus.STUCK


def test_a_pull_that_grows_is_waited_for(release_scene):
    """With a rise time of 0.1 s a pull of 400 N is at first too small for 186 N: not stuck."""
    result = run(release_scene("B", initial_gap=1e-8, force=400.0, rise_time=0.1))
    assert result.status in ("released", "time limit")


# Held by the spring ------------------------------------------------------------------------------


def sprung(force, **changes):
    """A disc of 1 um on a spring of 27.5 kN/m: 275 uN hold it at the final gap."""
    given = {"mass": 1e-9, "rise_time": 0.0, "rupture": None} | changes
    rupture = given.pop("rupture")
    face = ck.Flat(radius=1e-6)
    oil = ck.Liquid(name="oil", viscosity=0.01)
    loading = ck.ImposedForce(
        initial_gap=1e-9, final_gap=1.1e-8, force=force, stiffness=27.5e3, **given
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil)),
        loading=loading,
        effects=(VISCOUS, *([ck.Rupture(gap=rupture)] if rupture else [])),
    )


@pytest.mark.parametrize("rtol", [1e-4, 1e-8])
@pytest.mark.parametrize(
    ("force", "changes"),
    [
        (17.5e-6, {"rupture": 1.2e-9}),  # swings about 1.6 nm for good, without a film
        (17.5e-6, {}),
        (0.9 * 275e-6, {}),  # creeps to its equilibrium
        (0.9 * 275e-6, {"mass": None}),
        (0.9 * 275e-6, {"rise_time": 1e-3}),
    ],
)
def test_a_spring_that_holds_the_mass_ends_the_run(force, changes, rtol):
    result = run(sprung(force, **changes), ck.Accuracy(time_rtol=rtol))
    assert result.status == "stuck"
    assert result.work.n_steps < 500
    assert "the spring of 2.75e+04 N/m balances the pull" in result.message
    assert "more than stiffness*(final_gap - initial_gap) = 0.000275 N" in result.message


@pytest.mark.parametrize(
    ("force", "changes"),
    [
        (1.01 * 275e-6, {}),  # what the message asks for
        (0.6 * 275e-6, {"rupture": 1.2e-9}),  # momentum carries it beyond its equilibrium
        (0.4 * 275e-6, {"rupture": 1.2e-9, "mass": 1e-6, "initial_speed": 0.1}),
    ],
)
def test_a_mass_that_reaches_the_final_gap_on_its_spring_is_released(force, changes):
    assert run(sprung(force, **changes)).status == "released"


def test_a_massless_pull_of_absurd_strength_is_followed():
    """139 mN on a disc of 106 nm: transients of 1e-28 s."""
    face = ck.Flat(radius=1.06e-7)
    oil = ck.Liquid(name="oil", viscosity=0.01)
    scene = ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil)),
        loading=ck.ImposedForce(initial_gap=1e-8, final_gap=1.1e-8, force=0.139),
        effects=(VISCOUS,),
    )
    needed = squeeze.disc_impulse_flooded(1.06e-7, 1e-8, 1.1e-8, 0.01) / 0.139
    for rtol in (1e-4, 1e-8):
        assert run(scene, ck.Accuracy(time_rtol=rtol)).state.release_time == approx(needed, rtol)


# Division of time ---------------------------------------------------------------------------


@pytest.mark.parametrize("count", quick([1000, 10_000], 0))
@pytest.mark.parametrize("name", quick(["A", "B", "D", "E"], 0, 3))
def test_the_release_is_the_same_in_one_call_or_many(release_cases, release_scene, name, count):
    case = release_cases[name]["case"]
    made = ck.plan(release_scene(name))
    rise = case["tau"]

    def pull(time):
        return case["F0"] * (-math.expm1(-time / rise) if rise else 1.0)

    span = 1.001 * release_cases[name]["values"]["t_rel"]
    one, many = (walk(made, pull, span, count) for count in (1, count))
    assert one.n_releases == many.n_releases == 1
    assert many.release_time == approx(one.release_time, 1e-7)
    assert many.release_speed == approx(one.release_speed, 1e-7)


# Rupture ------------------------------------------------------------------------------------


def ruptured(release_scene, **changes):
    return release_scene("B", ck.Rupture(gap=12e-6), effects=FORCES, rise_time=0.0, **changes)


def test_rupture_inside_a_long_step_is_located(release_scene):
    made = ck.plan(ruptured(release_scene))
    states = [walk(made, ck.Pull(40.0), 0.05, count) for count in (1, 7, 1000)]
    for state in states:
        assert state.broken
        assert state.n_breaks == 1
        assert state.break_time == approx(states[0].break_time, 1e-8)
        assert state.gap == approx(states[0].gap, 1e-6)


def test_after_rupture_the_mass_is_free(release_scene):
    """From break to release: constant force, a parabola."""
    result = run(ruptured(release_scene, stiffness=0.0))
    state, acceleration = result.state, 40.0 / 0.02
    rows = result.columns
    last = max(i for i, gap in enumerate(rows["gap"]) if gap <= 12e-6)
    speed = rows["speed"][last]
    assert rows["gap"][last] == 12e-6
    assert rows["time"][last] == state.break_time
    assert state.release_speed == approx(math.sqrt(speed**2 + 2.0 * acceleration * 88e-6), 1e-9)
    assert set(rows["film_status"][last:]) == {ck.FilmStatus.BROKEN}
    assert (rows["viscous_force"][last:] == 0.0).all()
    assert (rows["meniscus_force"][last:] == 0.0).all()


def test_a_state_kept_before_rupture_ruptures_again_the_same(release_scene):
    """The state is all there is: nothing is remembered elsewhere."""
    made = ck.plan(ruptured(release_scene))
    first = walk(made, ck.Pull(40.0), 0.02, 3)
    kept = walk(made, ck.Pull(40.0), 0.005, 1)
    assert not kept.broken
    once = walk(made, ck.Pull(40.0), 0.045, 2, kept)
    restored = ck.MotionState(*tuple(kept))
    other_plan = ck.plan(ruptured(release_scene))
    again = walk(other_plan, ck.Pull(40.0), 0.045, 2, restored)
    assert again == once
    assert once.break_time > 0.0
    assert first.break_time in (-1.0, approx(once.break_time, 1e-8))


def test_rupture_by_the_neck_of_the_arc_ends_the_film(release_scene):
    """A small drop on large faces: the neck of its arc closes before the release gap."""
    scene = release_scene(
        "B",
        effects=(ck.MeniscusForce(), VISCOUS, ck.Rupture()),
        meniscus={"volume": 1e-15},
        rise_time=0.0,
    )
    made = ck.plan(scene)
    assert 5e-6 < made.film.end < 100e-6
    result = ck.simulate(made)
    assert result.state.n_breaks == 1
    assert result.status == "released"
    assert is_finite(result.state)


# Rest and re-wetting ------------------------------------------------------------------------


def resting(release_scene, **changes):
    return release_scene("B", effects=FORCES, rise_time=0.0, rest_gap=5e-6, **changes)


def test_a_mass_at_rest_on_asperities_leaves_when_pulled_enough(release_scene):
    made = ck.plan(resting(release_scene))
    holding = made.film.static_force(5e-6)
    state = walk(made, ck.Pull(0.5 * holding), 1.0, 10)
    assert state.in_contact
    assert state.gap == 5e-6
    assert state.speed == 0.0
    assert outputs(made, state, 0.5 * holding).status is ck.FilmStatus.STUCK
    assert outputs(made, state, -1.0).status is ck.FilmStatus.CONTACT
    # The pull grows through what holds: it leaves when they are equal.
    pull = ck.Pull(0.5 * holding, rate=holding, time=1.0)
    left = walk(made, pull, 0.5 * (1.0 + 1e-9), 1, state)
    assert not left.in_contact
    assert left.gap >= 5e-6
    assert left.impulses["meniscus_impulse"] == approx(1.5 * holding, 1e-6)


def test_it_does_not_matter_how_a_rest_is_divided(release_scene):
    made = ck.plan(resting(release_scene))
    holding = made.film.static_force(5e-6)
    pull = ck.Pull(0.0, rate=2.0 * holding)  # equal after half a second
    states = [walk(made, pull, 0.9, count) for count in (1, 9, 500)]
    for state in states:
        assert state.gap == approx(states[0].gap, 1e-6)


@pytest.mark.parametrize("rest", [4e-6, 1e-7])
@pytest.mark.parametrize("count", [1, 100])
def test_a_closing_mass_comes_to_rest_at_its_rest_gap(release_scene, rest, count):
    scene = release_scene(
        "B", effects=FORCES, rise_time=0.0, rest_gap=rest, force=-40.0, stiffness=0.0
    )
    state = walk(ck.plan(scene), ck.Pull(-40.0), 200.0, count)
    assert state.in_contact
    assert state.gap == rest
    assert state.speed == 0.0


def test_a_short_hop_ends_at_the_rest_gap_too(release_scene):
    """Thrown up from its rest by 1 nm/s, and pushed back at once: never below the asperities."""
    made = ck.plan(resting(release_scene, initial_speed=1e-9, stiffness=0.0, force=-1.0))
    for count in (1, 10, 1000):
        state = walk(made, ck.Pull(-1.0), 1.0, count)
        assert state.gap >= 5e-6 * (1.0 - 1e-12)


def cycle(release_scene, fraction):
    """Open beyond rupture, close again, come to rest."""
    scene = release_scene(
        "B",
        ck.Rupture(gap=12e-6),
        effects=FORCES,
        rise_time=0.0,
        rest_gap=5e-6,
        stiffness=0.0,
        meniscus={"rewetting": fraction},
    )
    made = ck.plan(scene)
    opened = walk(made, ck.Pull(40.0), 0.02, 1)
    assert opened.broken
    closed = walk(made, ck.Pull(-40.0, time=opened.time), 1.0, 1, opened)
    assert closed.in_contact
    assert closed.gap == 5e-6
    return made, closed


@pytest.mark.parametrize("fraction", [0.5, 1.0])
def test_a_film_that_wets_again_holds_with_its_fraction(release_scene, fraction):
    made, closed = cycle(release_scene, fraction)
    assert not closed.broken
    assert closed.volume_fraction == fraction
    pull = made.film_with(fraction).static_force(5e-6)
    assert outputs(made, closed, 0.0).static == pull
    # Half the volume: half the wetted area at the same gap, and a rim shorter by its root.
    assert pull == approx(fraction * made.film.static_force(5e-6), 0.02)
    again = walk(made, ck.Pull(40.0, time=closed.time), 0.02, 1, closed)
    assert again.n_breaks == 2
    assert again.n_releases == 2


def test_half_a_film_is_released_sooner(release_scene):
    times = []
    for fraction in (0.5, 1.0):
        made, closed = cycle(release_scene, fraction)
        again = walk(made, ck.Pull(40.0, time=closed.time), 0.05, 1, closed)
        times.append(again.break_time - closed.time)
    # The viscous impulse goes with the square of the volume.
    assert times[0] < 0.3 * times[1]


def test_a_film_that_does_not_wet_again_stays_lost(release_scene):
    made, closed = cycle(release_scene, 0.0)
    assert closed.broken
    again = walk(made, ck.Pull(40.0, time=closed.time), 0.02, 1, closed)
    free = math.sqrt(2.0 * 95e-6 * 0.02 / 40.0)
    assert again.release_time - closed.time == approx(free, 1e-8)
    assert again.impulses["viscous_impulse"] == closed.impulses["viscous_impulse"]


# Closing ------------------------------------------------------------------------------------


@pytest.mark.parametrize("force", [-1e-3, -40.0, -1e5])
@pytest.mark.parametrize("volume", [FILM, None], ids=["conserving", "flooded"])
def test_a_film_pressed_together_thins_and_never_vanishes(release_scene, force, volume):
    scene = release_scene(
        "B", effects=FORCES, rise_time=0.0, force=force, stiffness=0.0, meniscus={"volume": volume}
    )
    made = ck.plan(scene)
    gaps = []
    state = start(made)
    for span in (1e-6, 1e-3, 1.0, 1e3):
        state = walk(made, ck.Pull(force), span, 1, state)
        gaps.append(state.gap)
        assert state.gap > 0.0
        assert state.speed <= 0.0
    assert gaps == sorted(gaps, reverse=True)
    assert outputs(made, state, force).viscous <= 0.0  # resists closing


def test_a_flooded_film_thins_as_the_closed_form_has_it(release_scene):
    """1/h^2 grows linearly in time under a constant push, once inertia is spent."""
    scene = release_scene(
        "B",
        effects=[VISCOUS],
        rise_time=0.0,
        force=-40.0,
        stiffness=0.0,
        mass=1e-9,
        meniscus={"volume": None},
    )
    state = walk(ck.plan(scene), ck.Pull(-40.0), 1.0, 1)
    pressed = squeeze.disc_impulse_flooded(FACE, state.gap, 5e-6, 0.1)
    assert pressed == approx(40.0, 1e-7)


def test_no_pull_and_no_meniscus_means_no_motion(release_scene):
    scene = release_scene("B", effects=[VISCOUS], rise_time=0.0, force=0.0)
    state = walk(ck.plan(scene), ck.Pull(0.0), 1.0, 10)
    assert state.gap == 5e-6
    assert state.speed == 0.0
    assert state.impulses["viscous_impulse"] == 0.0


@pytest.mark.parametrize("speed", [-10.0, -1e-9, 1e-9, 10.0])
def test_a_start_with_any_speed_keeps_its_momentum_balance(release_scene, speed):
    scene = release_scene(
        "B", effects=FORCES, rise_time=0.0, stiffness=0.0, initial_speed=speed, mass=0.02
    )
    state = run(scene).state
    applied_impulse = 40.0 * state.release_time + 0.02 * speed
    kept = 0.02 * state.release_speed + sum(state.impulses.values())
    assert kept == approx(applied_impulse, 1e-7)
    made = ck.plan(scene)
    potential = made.film.laws[ck.ViscousForce].impulse(5e-6, 1e-4)
    assert state.impulses["viscous_impulse"] == approx(potential, 1e-7)


# Masses and drives --------------------------------------------------------------------------


@pytest.mark.parametrize("mass", quick([1e-9, 1e-3, 1e3], 0, 2))
@pytest.mark.parametrize("name", ["A", "B", "D"])
def test_any_mass_is_released_with_its_energy_accounted_for(
    release_cases, release_scene, name, mass
):
    case = release_cases[name]["case"]
    scene = release_scene(name, mass=mass, stiffness=0.0, rise_time=0.0)
    result = run(scene, ck.Accuracy(time_rtol=1e-9))
    assert result.status == "released"
    state = result.state
    kept = mass * state.release_speed + sum(state.impulses.values())
    assert kept == approx(case["F0"] * state.release_time, 1e-7)
    assert state.peak_force <= case["F0"] * (1.0 + 1e-6)


def test_a_very_light_mass_takes_the_time_of_none(release_scene):
    times = [
        run(release_scene("B", effects=[VISCOUS], stiffness=0.0, rise_time=0.0, mass=m))
        for m in (1e-9, None)
    ]
    one, none = (result.state.release_time for result in times)
    assert one == approx(none, 1e-6)
    impulse = squeeze.disc_impulse_conserved(FILM, 5e-6, 1e-4, 0.1)
    assert none == approx(impulse / 40.0, 1e-8)


@pytest.mark.parametrize("rise", [1e-9, 1e-2, 10.0])
def test_a_drive_may_rise_at_once_or_in_seconds(release_scene, rise):
    result = run(release_scene("B", rise_time=rise, stiffness=0.0))
    state = result.state
    assert result.status == "released"
    time = state.release_time
    applied_impulse = 40.0 * (time + rise * math.expm1(-time / rise))
    kept = 0.02 * state.release_speed + sum(state.impulses.values())
    assert kept == approx(applied_impulse, 1e-6)


def test_a_spring_stronger_than_the_pull_keeps_the_gap_below_the_release(release_scene):
    result = run(release_scene("A", stiffness=1e6, time_limit=0.1))
    assert result.status == "time limit"
    # At rest where pull, spring and meniscus balance.
    assert result.state.gap == approx(20e-6 + 40.0 / 1e6, 0.01)
    assert "not released within loading.time_limit = 0.1 s" in result.message


# Limits -------------------------------------------------------------------------------------


@pytest.mark.parametrize("tension", [1e-6, 1.0, 1e12])
def test_a_tiny_or_a_huge_tension_is_no_limit_or_no_film(release_scene, tension):
    def released(*more, **kept):
        # At once, so that the mass does not first sink: closing, the film has no such limit.
        return run(release_scene("B", *more, stiffness=0.0, rise_time=0.0, **kept)).state

    state = released(ck.TensionLimit(strength=tension, cavity="truncated"))
    if tension == 1e12:
        assert state.release_time == approx(released().release_time, 1e-9)
    else:
        # A tension of 1 Pa is 3e-5 N, of 40 N.
        assert state.release_time == approx(released(effects=[PUBLISHED]).release_time, 1e-6)


@pytest.mark.parametrize("strength", [1e-6, 1.0, 1e12])
@pytest.mark.parametrize("name", ["B", "D"])
def test_a_tiny_or_a_huge_shear_strength_is_no_limit_or_no_film(release_scene, strength, name):
    state = run(release_scene(name, ck.ShearLimit(strength=strength), stiffness=0.0)).state
    if strength == 1e12:
        free = run(release_scene(name, stiffness=0.0)).state
        assert state.release_time == approx(free.release_time, 1e-9)
    else:
        without = run(release_scene(name, effects=[PUBLISHED], stiffness=0.0)).state
        # 1 Pa leaves 0.013 N on the disc of 3 mm at 5 um, and at 10 nm on the small one 0.03 N.
        assert state.release_time == approx(without.release_time, 2e-3)


@pytest.mark.parametrize(
    ("strength", "release"), quick([(1e4, 1.9016), (3e3, 1.3709), (1e3, 3.19e-4)], 1)
)
@pytest.mark.parametrize("count", [1, 1000])
def test_a_weak_liquid_at_ten_nanometres_releases_on_time(release_scene, strength, release, count):
    """m/c is 1e-12 s, and the limit begins at 7 nm/s: slopes must be taken in nm/s too."""
    made = ck.plan(release_scene("D", ck.ShearLimit(strength=strength)))
    state = walk(made, ck.Pull(40.0), 1.01 * release, count)
    assert state.n_releases >= 1
    assert state.release_time == approx(release, 2e-3 if strength == 1e3 else 5e-5)


@pytest.mark.parametrize("cavity", ["truncated", "reynolds"])
def test_both_cavities_release_at_ten_nanometres(release_scene, cavity):
    """Tension bears 0.8 N per bar: the disc of 1 mm cavitates off 40 N at once at 10 bar."""
    scene = release_scene("D", ck.TensionLimit(strength=1e6, cavity=cavity), stiffness=0.0)
    state = run(scene).state
    free = math.sqrt(2.0 * 1e-4 * 0.02 / 40.0)
    assert free < state.release_time < 1.1 * free


def test_a_limit_on_a_sphere_does_not_stop_the_clock(film_scene):
    """Stiff film, limit far below the Newtonian force: the sphere's formulas too."""
    for limit in (ck.TensionLimit(strength=1e5, cavity="truncated"), ck.ShearLimit(strength=1e4)):
        scene = film_scene(
            VISCOUS,
            limit,
            lower=ck.Flat(),
            upper=ck.Sphere(radius=5e-3),
            film={"volume": 1e-13},
            initial_gap=1e-8,
            final_gap=1e-5,
            force=1.0,
            mass=1e-3,
        )
        state = run(scene).state
        kept = 1e-3 * state.release_speed + state.impulses["viscous_impulse"]
        assert kept == approx(1.0 * state.release_time, 1e-6)


# Too many steps -----------------------------------------------------------------------------


def test_an_integration_that_gives_up_keeps_what_it_has(release_scene):
    made = ck.plan(release_scene("D"), ck.Accuracy(max_steps=20))
    with pytest.raises(
        ck.ConvergenceError, match=r"after 20 steps; raise Accuracy\.max_steps"
    ) as e:
        ck.simulate(made)
    assert e.value.result.status == "not converged"
    assert len(e.value.result.gap) >= 20
    quiet = ck.simulate(made, throw=False)
    assert quiet.status == "not converged"
    assert quiet.state == e.value.result.state


# Where speed changes sign under a limit -------------------------------------------------------


@pytest.mark.parametrize(
    "limit", [ck.TensionLimit(strength=2e3, cavity="truncated"), ck.ShearLimit(strength=500.0)]
)
@pytest.mark.parametrize("speed", [1e-5, -1e-5, 0.1, -0.1])
@pytest.mark.parametrize("pull", [-500.0, 1e-3])
def test_a_thrown_mass_is_caught_by_a_limited_film_in_few_steps(film_scene, limit, speed, pull):
    """Opening, the film hardly holds; at rest m/c is 1e-15 s: no creeping around the turn."""
    scene = film_scene(
        VISCOUS,
        limit,
        initial_gap=1e-8,
        final_gap=1e-4,
        force=pull,
        mass=0.01,
        initial_speed=speed,
        rest_gap=1e-9,
        time_limit=1e-3,
    )
    result = ck.simulate(ck.plan(scene, ck.Accuracy(max_steps=3000)), throw=False)
    assert result.status != "not converged"
    assert is_finite(result.state)


def test_a_flooded_sphere_may_be_cavitated_at_once(film_scene):
    """Exponent 0, a weak liquid and a strong pull: trial steps reach beyond any float."""
    scene = film_scene(
        VISCOUS,
        ck.ShearLimit(strength=8e3),
        lower=ck.Flat(),
        upper=ck.Sphere(radius=1.2e-3),
        liquid={"viscosity": 4.6},
        initial_gap=3.4e-8,
        final_gap=6.9e-6,
        force=41.0,
        mass=1.5,
        rise_time=2.3e-5,
    )
    assert run(scene).status == "released"


@pytest.mark.parametrize(
    "more",
    [
        ck.TensionLimit(strength=1e5, cavity="truncated"),
        ck.ShearLimit(strength=1e5),
        ck.Rupture(gap=2e-6),
    ],
)
def test_without_a_mass_a_film_must_hold_all_the_way(film_scene, more):
    """Where a limit or a rupture ends the film, nothing sets the speed: ask for a mass."""
    scene = film_scene(VISCOUS, more, force=10.0, film={"volume": 3e-12})
    with pytest.raises(ck.PlanError, match=r"mass \[kg\]"):
        ck.plan(scene)


@pytest.mark.parametrize("volume", [None, 3e-15])
def test_a_pull_that_starts_from_nothing_moves_the_stiffest_film(film_scene, volume):
    """At time 0 no force acts at all, on a film of 1e16 N.s/m: no scale may come out as zero."""
    scene = film_scene(
        VISCOUS,
        liquid={"viscosity": 10.0},
        film={"volume": volume},
        initial_gap=1e-9,
        final_gap=1.5e-9,
        force=100.0,
        mass=0.02,
        rise_time=1e-3,
        time_limit=0.01,
    )
    state = run(scene).state
    # The gap has hardly moved: what was given, the film has taken.
    applied_impulse = 100.0 * (0.01 + 1e-3 * math.expm1(-10.0))
    assert state.impulses["viscous_impulse"] == approx(applied_impulse, 1e-7)


def test_a_film_may_break_at_the_very_gap_of_release(film_scene):
    """Two things happen at one gap; the first must not hide the second."""
    pull = {"force": 1.0, "mass": 0.02, "initial_gap": 1e-6, "final_gap": 1e-5}
    state = run(film_scene(PUBLISHED, VISCOUS, ck.Rupture(gap=1e-5), **pull)).state
    assert state.broken
    assert state.n_releases == state.n_breaks == 1
    assert state.release_time == state.break_time > 0.0


@pytest.mark.parametrize("time", [0.0, 1e-2, 1.0, 1e3])
@pytest.mark.parametrize("rate", [1e5, -1e5, 1.0])
def test_a_pull_may_begin_to_grow_late(film_scene, time, rate):
    """The transient of the film, 1e-16 s, is shorter than what the time can tell by then."""
    pull = {"force": 1.0, "mass": 1.72e-5, "initial_gap": 4.54e-8, "final_gap": 1e-6}
    made = ck.plan(film_scene(VISCOUS, liquid={"viscosity": 0.01}, film={"volume": None}, **pull))
    state = ck.advance(made, start(made)._replace(time=time), Pull(0.0, rate, time), 1e-6)
    span = state.time - time  # 1e-6 s, as far as the time can tell
    assert state.impulses["viscous_impulse"] == approx(0.5 * rate * span**2, 1e-6)
    assert state.n_steps < 200


def test_a_mass_in_free_motion_comes_to_rest_for_good(film_scene):
    """In neither many thousand steps nor the smallest of all numbers."""
    film = {"initial_gap": 1e-6, "final_gap": 1e-5, "force": 1.0, "mass": 1e-6}
    made = ck.plan(film_scene(VISCOUS, film={"volume": None}, **film))
    state = walk(made, Pull(0.0), 1e-3, 20, start(made)._replace(speed=1e-3))
    assert state.speed == 0.0
    assert state.impulses["viscous_impulse"] == approx(1e-9, 1e-7)
    assert state.n_steps < 2000
