"""Cavities on faces that are no disc: the liquid on its grid, stepped with the motion.

A disc with a notch of a micrometre at its rim has no closed form, and is a disc for all that.
"""

import math

import attrs
import numpy as np
import pytest
from reynolds_cases import CASES, inputs
from selection import quick

import contactkit as ck
from contactkit.separation.cavity.state import Phase, restored_cavity
from contactkit.separation.motion.advance import advance
from contactkit.separation.motion.state import Pull, outputs, start

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

R = 3.175e-3
DISC = ck.Flat(radius=R)
NOTCHED = ck.Flat(planform=ck.Disc(radius=R) - ck.Disc(radius=1e-6, centre=(R, 0.0)))
PULL = ck.ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0, mass=0.02)
ROUGHLY = ck.Accuracy(film_rtol=1e-2, curve_rtol=1e-1)
AMBIENT = 101_325.0


def scene(face, limit, loading=PULL, viscosity=0.1):
    film = ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=viscosity))
    return ck.SeparationScene(
        interface=ck.Interface(upper=face, meniscus=film),
        loading=loading,
        effects=(ck.ViscousForce(), limit),
    )


def one_pressure(tension):
    return ck.TensionLimit(strength=tension, cavity_pressure=AMBIENT - tension)


@pytest.mark.parametrize(
    ("name", "accuracy", "error"),
    quick(
        [
            ("pull_flooded_jfo_0.1", ROUGHLY, 4e-3),
            ("pull_flooded_jfo_0.1", ck.Accuracy.standard, 2e-3),
            ("pull_flooded_jfo_dp1.25e+06", ck.Accuracy.standard, 1e-2),
        ],
        long=[0],
    ),
)
def test_a_disc_is_pulled_apart_as_its_edge_says(name, accuracy, error):
    """Release of the injector by the ODE of the exact edge of a round cavity."""
    given, values = inputs(name), CASES[name]["values"]
    limit = one_pressure(given["tension"])
    pulled = scene(NOTCHED, limit, viscosity=given["viscosity"])
    found = ck.simulate(ck.plan(pulled, accuracy)).state
    assert found.release_time == pytest.approx(values["t_release"], rel=error)
    assert found.release_speed == pytest.approx(values["v_release"], rel=5.0 * error)
    assert found.cavity.void == pytest.approx(values["void_volume_end"], rel=5.0 * error)


@pytest.mark.slow
def test_two_pressures_release_nearly_as_a_dry_face():
    limit = ck.TensionLimit(strength=1e6, cavity_pressure=AMBIENT - 1e5)
    result = ck.simulate(ck.plan(scene(NOTCHED, limit), ROUGHLY))
    assert result.status == "released"
    assert result.state.release_time == pytest.approx(0.1473e-3, rel=4e-3)
    assert result.state.n_inceptions == 1


@pytest.fixture(scope="module")
def opened():
    """Opening at a speed, of a disc and of a notched one."""
    loading = ck.ImposedSpeed(speed=0.02, initial_gap=5e-6, final_gap=20e-6)
    return [
        ck.simulate(
            ck.plan(scene(face, one_pressure(1e6), loading), attrs.evolve(ROUGHLY, points=20))
        )
        for face in (DISC, NOTCHED)
    ]


@pytest.mark.slow
def test_forces_at_a_speed_are_those_of_the_round_cavity(opened):
    disc, notched = opened
    gaps = np.geomspace(5e-6, 20e-6, 12)
    for name, off in (("viscous_force", 0.02), ("void_volume", 0.03), ("cavity_radius", 0.05)):
        exact, found = (np.interp(gaps, one["gap"], one[name]) for one in (disc, notched))
        assert found == pytest.approx(exact, abs=off * exact.max())
    assert notched.impulses["viscous_impulse"] == pytest.approx(
        disc.impulses["viscous_impulse"], rel=2e-2
    )


@pytest.mark.slow
def test_a_result_with_a_cavity_is_one_like_any_other(opened, tmp_path):
    _, notched = opened
    notched.save(tmp_path / "notched.npz")
    again = ck.load_result(tmp_path / "notched.npz")
    assert np.array_equal(again["viscous_force"], notched["viscous_force"])
    assert again.plan.scene == notched.plan.scene
    assert "Jakobsson" in str(notched.plan.cite())
    assert any(one.name == "error of the film on its grid" for one in notched.validity)
    assert notched.of(ck.TensionLimit).acts.any()


def motion(face, pulls, step, accuracy=ROUGHLY):
    """Gap [m], force [N] and void [m3] of a mass under pulls, one after the other."""
    plan = ck.plan(scene(face, one_pressure(1e6), attrs.evolve(PULL, final_gap=1e-4)), accuracy)
    state, found = start(plan), []
    for force in pulls:
        state = advance(plan, state, Pull(force), step)
        shown = outputs(plan, state, force)
        found.append((state.gap, shown.viscous, shown.void))
    return np.array(found), state


@pytest.mark.exhaustive
def test_what_has_cavitated_is_remembered_until_liquid_is_back():
    """Pulled, pushed back and pulled again, as the round cavity of the same liquid."""
    pulls = [40.0] * 4 + [-40.0] * 4
    (disc, _), (notched, state) = (motion(face, pulls, 2e-5) for face in (DISC, NOTCHED))
    assert disc[:, 2].max() > 0.25 * math.pi * R**2 * 5e-6
    assert disc[-1, 2] == 0.0  # full again
    assert notched[:, 0] == pytest.approx(disc[:, 0], rel=2e-2)
    assert notched[:, 2] == pytest.approx(disc[:, 2], abs=0.03 * disc[:, 2].max())
    saved = [*state.cavity]
    assert restored_cavity(saved) == state.cavity


@pytest.mark.slow
def test_a_tilted_face_cavitates_where_it_is_thin_and_pulls_less_than_its_area():
    tilted = ck.Flat(planform=ck.Rectangle(length=4e-3, width=3e-3), tilt=(5e-4, 0.0))
    made = ck.plan(scene(tilted, one_pressure(1e6)), attrs.evolve(ROUGHLY, film_rtol=5e-2))
    grid = made.film.cavity.grid

    def cavity(pull, time):
        """Its middle along x [m] and the viscous force [N]."""
        state = advance(made, start(made), Pull(pull), time)
        assert state.cavity.phase is not Phase.FULL
        void = grid.relief + state.gap - np.array(state.cavity.liquid)
        void[~grid.face.loaded] = 0.0
        middle = float((void * grid.face.x).sum() / void.sum())
        return middle, outputs(made, state, pull).viscous

    # Where it begins: of an endless strip at h = 2 h1 h2/(h1 + h2), a third of a millimetre from
    # the middle; a rectangle lets liquid in at its ends, too, and most where it is open.
    begun, _ = cavity(6.0, 2e-5)
    assert -6e-4 < begun < -1e-3 / 3.0
    grown, force = cavity(20.0, 1e-6)
    assert begun < grown < -2e-4
    assert 6.0 < force < 1e6 * 12e-6
