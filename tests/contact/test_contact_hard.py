"""Contacts at the edge of what can be asked: extreme stacks, loads, grids, rules and films."""

from __future__ import annotations

import math

import loadings
import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.contact.solver.optimality import height_scale

pytestmark = [
    pytest.mark.hard,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

E, NU = 1e9, 0.3
SOLID = ck.Material(young_modulus=E, poisson_ratio=NU, hardness=5e7)
ROUGH = ck.GaussianRoughness(rms=1e-9, correlation_length=1e-7, cutoff=6e-8, seed=3)
WATER = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.07275)
FILM = ck.Meniscus(
    liquid=WATER, contact_angle_lower=math.pi / 3.0, contact_angle_upper=math.pi / 3.0
)
NAN = float("nan")


def made(
    *effects,
    lower=SOLID,
    upper=None,
    surface=ROUGH,
    meniscus=None,
    grid=48,
    width=0.8e-6,
    height=None,
    periodic=True,
    accuracy=None,
    **loading,
):
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=lower),
            upper=ck.Body(surface=surface, solid=upper),
            meniscus=meniscus,
        ),
        window=ck.Window(width=width, height=height, periodic=periodic),
        loading=loadings.pressed(**loading),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    return ck.plan(scene, ck.Accuracy(grid=grid, **(accuracy or {})))


def solved(*effects, **given):
    return ck.solve(made(*effects, **given))


def layer(modulus, thickness, poisson_ratio=NU, hardness=None):
    material = ck.Material(young_modulus=modulus, poisson_ratio=poisson_ratio, hardness=hardness)
    return ck.Layer(material=material, thickness=thickness)


def check(run, cap=math.inf, rtol=1e-8):
    """The contact conditions, from the maps alone."""
    p, gap = run.pressure, run.gap
    assert run.status == "converged"
    assert np.isfinite(p).all()
    assert np.isfinite(gap).all()
    assert p.min() >= 0.0
    assert (p <= np.asarray(cap) * (1.0 + 1e-12)).all()
    assert gap.min() >= 0.0
    scale = 2.0 * rtol * height_scale(run.heights, run.displacement)
    scale += 8.0 * np.finfo(float).eps * float(np.abs(run.heights).max())
    bearing = p > 0.0
    overlap = run.heights + run.rigid_approach - run.displacement
    yielding = p >= np.asarray(cap) * (1.0 - 1e-12)
    assert gap[bearing].max(initial=0.0) <= scale
    assert overlap[~yielding].max(initial=0.0) <= scale
    if run.plan.mean_pressure is not None:
        assert run.mean_pressure == pytest.approx(run.plan.mean_pressure, rel=1e-11)


def rough_map(shape, seed=0):
    return 1e-9 * np.random.default_rng(seed).normal(size=shape)


# Stacks -------------------------------------------------------------------------------------

STACKS = {
    "1 nm of diamond on soft": ck.Stack(layers=(layer(1e12, 1e-9),), substrate=SOLID),
    "1 nm film a thousandth as stiff": ck.Stack(layers=(layer(1e6, 1e-9),), substrate=SOLID),
    "1e6 stiffer": ck.Stack(layers=(layer(1e15, 5e-9),), substrate=SOLID),
    "1e6 softer": ck.Stack(layers=(layer(1e3, 5e-9),), substrate=SOLID),
    "incompressible": ck.Stack(
        layers=(layer(1e8, 1e-8, 0.5), layer(1e10, 1e-8, 0.5)),
        substrate=ck.Material(young_modulus=E, poisson_ratio=0.5),
    ),
    "soft incompressible film": ck.Stack(layers=(layer(1e5, 5e-9, 0.5),), substrate=SOLID),
    "auxetic": ck.Stack(layers=(layer(E, 1e-8, -0.9),), substrate=SOLID),
    "twenty graded layers": ck.Stack(
        layers=tuple(layer(E * 1.5 ** (10 - k), 2e-9 * 1.2**k, 0.1 + 0.02 * k) for k in range(20)),
        substrate=SOLID,
    ),
    "sandwich": ck.Stack(
        layers=(layer(1e15, 1e-9), layer(1e3, 1e-9), layer(1e15, 1e-9)), substrate=SOLID
    ),
}


@pytest.mark.parametrize("periodic", quick([True, False], 0), ids=["periodic", "free"])
@pytest.mark.parametrize("name", STACKS)
def test_no_stack_is_too_hard_to_press(name, periodic):
    stack = STACKS[name]
    softest = min(m.young_modulus for m in stack.materials[:1])
    run = solved(lower=stack, pressure=2e-3 * min(softest, E), periodic=periodic, grid=32)
    check(run)
    assert 0.0 < run.contact_fraction <= 1.0


@pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "free"])
@pytest.mark.parametrize("modulus", [1e6, 1e9, 1e12, 1e15])
def test_a_film_of_one_nanometre_on_a_window_of_twenty_micrometres(modulus, periodic):
    stack = ck.Stack(layers=(layer(modulus, 1e-9),), substrate=SOLID)
    surface = ck.GaussianRoughness(rms=1e-9, correlation_length=2e-6, cutoff=1e-6)
    given = {"surface": surface, "width": 20e-6, "grid": 64, "periodic": periodic}
    run = solved(lower=stack, pressure=1e5, **given)
    check(run)
    if modulus == 1e9:  # it is not there
        bare = solved(lower=SOLID, pressure=1e5, **given)
        np.testing.assert_allclose(run.pressure, bare.pressure, atol=1e-6 * bare.max_pressure)


# Loads --------------------------------------------------------------------------------------


@pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "free"])
def test_without_load_the_bodies_just_touch(periodic):
    run = solved(pressure=0.0, periodic=periodic)
    assert run.status == "no contact"
    assert not run.pressure.any()
    assert not run.displacement.any()
    assert run.gap.min() == 0.0
    assert run.approach == pytest.approx(0.0, abs=1e-24)
    assert (run.load, run.contact_area, run.energy) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "free"])
def test_under_the_least_load_one_point_touches(periodic):
    run = solved(pressure=1e-6, periodic=periodic)
    check(run)
    assert run.contact.sum() == 1
    assert run.contact.flat[np.argmax(run.heights)]
    assert run.max_pressure == pytest.approx(1e-6 * 48**2, rel=1e-10)
    assert run.approach > 0.0


def test_one_pixel_that_stands_out_carries_all():
    heights = np.zeros((32, 32))
    heights[7, 9] = 1e-6
    run = ck.press(heights, 1e-8, SOLID, 1e4, periodic=False)
    check(run)
    assert np.argwhere(run.contact).tolist() == [[7, 9]]


@pytest.mark.parametrize("offset", [0.0, 1e-3, -1.0])
def test_a_flat_on_a_flat_carries_evenly(offset):
    run = ck.press(np.full((24, 20), offset), 1e-8, SOLID, 3e6)
    check(run)
    np.testing.assert_allclose(run.pressure, 3e6, rtol=1e-12)
    assert run.contact_fraction == 1.0


def test_a_flat_punch_of_the_size_of_the_window_is_fully_in_contact():
    run = ck.press(np.zeros((24, 20)), 1e-8, SOLID, 3e6, periodic=False)
    check(run)
    assert run.contact_fraction == 1.0
    assert run.pressure[0, 0] > 2.0 * run.pressure[12, 10]  # singular at the rim


def test_full_contact_closes_every_gap():
    run = solved(pressure=1e11)
    check(run)
    assert run.contact_fraction == 1.0
    assert np.ptp(run.displacement - run.heights) < 1e-7 * run.heights.std()


def test_an_offset_of_all_heights_changes_nothing_but_the_level():
    heights = rough_map((32, 30))
    run, moved = (ck.press(heights + by, 1e-8, SOLID, 1e6) for by in (0.0, 1e-6))
    np.testing.assert_allclose(moved.pressure, run.pressure, atol=1e-6 * run.max_pressure)
    assert moved.approach == pytest.approx(run.approach, rel=1e-6)


# Units and grids ----------------------------------------------------------------------------


@pytest.mark.parametrize("hardness", [None, 3e7])
@pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "free"])
def test_nanometres_with_gigapascals_take_the_same_steps_as_metres_with_pascals(periodic, hardness):
    """A factor of two to the thirty rounds nothing: bit for bit; 1e9 does, in the last digits."""
    heights = rough_map((48, 40))
    small = ck.press(heights, 1e-8, SOLID, 1e7, hardness=hardness, periodic=periodic)
    check(small, hardness or math.inf)
    for factor in (2.0**30, 1e9):
        solid = ck.Material(young_modulus=E / factor, poisson_ratio=NU)
        limit = hardness and hardness / factor
        large = ck.press(
            heights * factor, 1e-8 * factor, solid, 1e7 / factor, hardness=limit, periodic=periodic
        )
        check(large, limit or math.inf)
        if factor == 2.0**30:
            assert small.work.n_iterations == large.work.n_iterations
            assert small.work.n_operator_applications == large.work.n_operator_applications
            np.testing.assert_array_equal(factor * large.pressure, small.pressure)
            assert large.approach == factor * small.approach
        counts = [run.work.n_operator_applications for run in (small, large)]
        assert np.ptp(counts) <= 2  # a step more where a residual meets its tolerance by a digit
        np.testing.assert_allclose(
            factor * large.pressure, small.pressure, rtol=0, atol=1e-7 * small.max_pressure
        )
        assert large.approach == pytest.approx(factor * small.approach, rel=1e-9)


@pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "free"])
@pytest.mark.parametrize(
    ("shape", "pixel"),
    quick(
        [
            ((33, 47), 1e-8),
            ((17, 64), (3e-8, 1e-8)),
            ((2, 2), 1e-8),
            ((2, 51), 1e-8),
            ((64, 5), (1e-9, 5e-8)),
            ((31, 31), (1e-8, 1e-6)),
            ((130, 3), 1e-8),
        ],
        *(0, 2, 4, 5),
    ),
)
def test_any_grid_will_do(shape, pixel, periodic):
    run = ck.press(rough_map(shape), pixel, SOLID, 1e7, periodic=periodic)
    check(run)
    bounded = ck.press(rough_map(shape), pixel, SOLID, 1e7, hardness=3e7, periodic=periodic)
    check(bounded, 3e7)


@pytest.mark.parametrize(
    ("heights", "says"),
    [
        (np.zeros((1, 8)), "shape (1, 8)"),
        (np.zeros((8, 1)), "shape (8, 1)"),
        (np.zeros(8), "shape (8,)"),
        (np.zeros((2, 2, 2)), "shape (2, 2, 2)"),
        (np.zeros((0, 5)), "shape (0, 5)"),
        (np.array([[0.0, NAN], [0.0, 1.0]]), "at [y, x] = [0, 1] and 0 more"),
        (np.array([[0.0, 1.0], [math.inf, NAN]]), "at [y, x] = [1, 0] and 1 more"),
    ],
)
def test_a_map_with_holes_or_one_row_is_refused_with_the_reason(heights, says):
    with pytest.raises(ck.DescriptionError, match=r"Heights\.heights must") as caught:
        ck.press(heights, 1e-8, SOLID, 1e6)
    assert says in str(caught.value)
    assert "[m]" in str(caught.value)


# Approach -----------------------------------------------------------------------------------


@pytest.mark.parametrize("hardness", [None, 2e7])
@pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "free"])
def test_the_approach_that_a_load_makes_gives_the_load_back(periodic, hardness):
    limit = [ck.HardnessLimit(rule=ck.ConstantHardness(hardness=hardness))] if hardness else []
    run = solved(*limit, pressure=2e6, periodic=periodic)
    back = solved(*limit, approach=run.approach, periodic=periodic)
    check(back, hardness or math.inf)
    assert back.mean_pressure == pytest.approx(2e6, rel=1e-6)
    assert back.approach == pytest.approx(run.approach, rel=1e-12)
    np.testing.assert_allclose(back.pressure, run.pressure, atol=1e-6 * run.max_pressure)


@pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "free"])
@pytest.mark.parametrize("limit", [(), (ck.HardnessLimit(),)], ids=["elastic", "plastic"])
def test_a_negative_approach_is_no_contact(limit, periodic):
    stack = ck.Stack(layers=(layer(E, 3e-9, hardness=2.5e7),), substrate=SOLID)
    run = solved(*limit, lower=stack, approach=-1e-9, periodic=periodic)
    assert run.status == "no contact"
    assert not run.pressure.any()
    assert run.approach == pytest.approx(-1e-9, rel=1e-12)
    assert run.gap.min() == pytest.approx(1e-9, rel=1e-9)
    assert run.work.n_solves <= 2  # the hardness of a surface that is not touched is known


def test_an_approach_that_no_load_can_reach_is_refused():
    """In a periodic window the mean planes cannot meet; with a hardness they can."""
    with pytest.raises(ck.InfeasibleError, match=r"closes? .*gap|gap .* closed"):
        solved(approach=1e-7)
    run = solved(ck.HardnessLimit(rule=ck.ConstantHardness(hardness=2e7)), approach=1e-7)
    check(run, 2e7)
    assert run.mean_pressure == pytest.approx(2e7, rel=1e-12)


# Hardness -----------------------------------------------------------------------------------


@pytest.mark.parametrize("short", [1e-3, 1e-6, 1e-9])
def test_a_load_just_below_the_hardness_times_the_area_is_carried(short):
    run = solved(
        ck.HardnessLimit(rule=ck.ConstantHardness(hardness=1e7)), pressure=1e7 * (1.0 - short)
    )
    check(run, 1e7)
    assert run.plastic_area / run.plan.grid.area > 1.0 - 4.0 * math.sqrt(short) - 2.0 / 48**2


@pytest.mark.parametrize("load", [1e7, 1e7 * (1.0 + 1e-9), 1e9])
def test_a_load_above_the_hardness_times_the_area_is_refused_before_any_work(monkeypatch, load):
    import contactkit.contact.grid as grid
    import contactkit.contact.prepared as prepared

    def never(*_args, **_kwargs):
        raise AssertionError("work was done")

    monkeypatch.setattr(prepared, "ContactSolver", never)
    monkeypatch.setattr(prepared, "combined_heights", never)
    monkeypatch.setattr(grid, "realise", never)
    with pytest.raises(ck.InfeasibleError, match=r"load .* N reaches H\*A = .* N.*lower the load"):
        made(ck.HardnessLimit(rule=ck.ConstantHardness(hardness=1e7)), pressure=load)
    with pytest.raises(ck.InfeasibleError, match=r"H\*A"):
        ck.press(rough_map((8, 8)), 1e-8, SOLID, load, hardness=1e7)


def test_a_load_that_softens_its_own_support_is_refused_with_the_hardness_it_meets():
    """A hard film on a soft solid carries 8e7 Pa by its own hardness, but not so deep."""
    with pytest.raises(ck.InfeasibleError, match=r"exceeds H\*A = .*effective hardness has fallen"):
        solved(ck.HardnessLimit(), lower=HARD_ON_SOFT, pressure=8e7, periodic=False)


@pytest.mark.parametrize("pressure", [6e7, 7e7, 7.6e7, 8e7])
def test_a_rule_without_jumps_is_never_said_to_jump(pressure):
    """Close to the load that the hardness can bear, displacement runs ahead of hardness."""
    run = solved(ck.HardnessLimit(), lower=HARD_ON_SOFT, pressure=pressure)
    check(run, run.of(ck.HardnessLimit).hardness)


HARD_ON_SOFT = ck.Stack(layers=(layer(E, 1e-9, hardness=1e8),), substrate=SOLID)
JUMPING = ck.Stack(
    layers=(layer(E, 5e-9, hardness=1e8), layer(E, 5e-9, hardness=2.5e7)), substrate=SOLID
)


@pytest.mark.parametrize(
    ("displacement", "problem"),
    [
        ("largest", "the hardness still changes by"),
        ("local", "the local hardness still changes by"),
    ],
)
def test_iterations_of_the_hardness_that_run_out_say_so_and_hand_over_what_they_reached(
    displacement, problem, monkeypatch
):
    monkeypatch.setattr("contactkit.contact.outer.iteration.MAX_ITERATIONS", 2)
    limit = ck.HardnessLimit(rule=ck.ContinuousHardness(displacement=displacement))
    plan = made(limit, lower=HARD_ON_SOFT, pressure=6e7)
    with pytest.raises(ck.ConvergenceError, match=problem) as caught:
        ck.solve(plan)
    reached = ck.solve(plan, throw=False)
    assert (reached.status, reached.message) == ("not converged", str(caught.value))
    np.testing.assert_array_equal(caught.value.result.pressure, reached.pressure)
    assert reached.residual <= 1e-8
    assert np.all(reached.pressure <= reached.of(ck.HardnessLimit).hardness * (1.0 + 1e-15))


@pytest.mark.parametrize("pressure", quick(np.geomspace(1e5, 2e7, 9), 0, 3, 6, 8))
def test_where_the_literal_rule_jumps_it_is_reported_and_never_cycled_through(pressure):
    """The source's criteria forget the hard top at once: at some loads no hardness agrees."""
    plan = made(ck.HardnessLimit(rule="literal"), lower=JUMPING, pressure=float(pressure))
    run = ck.solve(plan, throw=False)
    if run.status == "converged":
        hardness = run.of(ck.HardnessLimit).hardness
        check(run, hardness)
        assert literal(run) == pytest.approx(hardness, rel=1e-5)
        return
    assert run.work.n_solves < 60
    with pytest.raises(
        ck.ConvergenceError, match=r"the hardness rule jumps.*'continuous'"
    ) as caught:
        ck.solve(plan)
    assert caught.value.result.status == run.status == "not converged"
    assert caught.value.result.message == str(caught.value)


def literal(run):
    from contactkit.elasticity.hardness_rules import effective_hardness_literal

    layers = JUMPING.young_moduli, [m.hardness for m in JUMPING.materials], JUMPING.thicknesses
    return float(effective_hardness_literal(run.max_displacement, *layers))


def test_the_jump_is_met():
    """The test above proves nothing where every load converges."""
    met = 0
    for imposed in [{"pressure": float(p)} for p in np.geomspace(1e6, 2e7, 5)] + [
        {"approach": float(d)} for d in np.linspace(2.5e-9, 5e-9, 5)
    ]:
        try:
            solved(ck.HardnessLimit(rule="literal"), lower=JUMPING, **imposed)
        except ck.ConvergenceError:
            met += 1
    assert met >= 2


SOFT_ON_HARD = ck.Stack(layers=(layer(E, 1e-9, hardness=2.5e7),), substrate=SOLID)
INTERLAYER = ck.Stack(
    layers=(layer(E, 1e-9, hardness=2.5e7), layer(E, 1e-9, hardness=1e8)), substrate=SOLID
)


@pytest.mark.parametrize("displacement", ["largest", "local"])
@pytest.mark.parametrize("stack", [SOFT_ON_HARD, INTERLAYER], ids=["soft on hard", "interlayer"])
@pytest.mark.parametrize("pressure", quick([1e5, 2e6, 2e7], 1))
def test_the_continuous_rule_agrees_with_the_displacement_it_leads_to(
    stack, displacement, pressure
):
    from contactkit.elasticity.hardness_rules import effective_hardness

    limit = ck.HardnessLimit(rule=ck.ContinuousHardness(displacement=displacement))
    run = solved(limit, lower=stack, pressure=pressure)
    hardness = run.of(ck.HardnessLimit).hardness
    check(run, hardness)
    layers = stack.young_moduli, [m.hardness for m in stack.materials], stack.thicknesses
    moved = run.max_displacement if displacement == "largest" else run.displacement
    asked = effective_hardness(moved, *layers)
    touching = run.contact if displacement == "local" else ...
    np.testing.assert_allclose(
        np.asarray(asked)[touching], np.asarray(hardness)[touching], rtol=1e-5
    )


def test_a_pixel_without_hardness_bears_nothing_and_is_plastic_only_where_it_is_touched():
    heights = rough_map((32, 32))
    values = np.full((32, 32), 3e7)
    values[:, ::4] = 0.0
    run = ck.press(heights, 1e-8, SOLID, 4e6, hardness=values)
    check(run, values)
    part = run.of(ck.HardnessLimit)
    assert not run.pressure[:, ::4].any()
    apart = run.gap > 1e-3 * heights.std()
    assert apart[:, ::4].any()
    assert not (part.is_plastic & apart).any()
    assert run.plastic_area == pytest.approx(part.is_plastic.sum() * 1e-16)


# Friction coupling --------------------------------------------------------------------------


def coupled(friction, *, start=None, angle=0.0, **given):
    effects = (ck.FrictionTraction(coefficient=friction, direction=angle), ck.FrictionCoupling())
    run = ck.solve(made(*effects, **given), start=start)
    return run, run.of(ck.FrictionCoupling)


@pytest.mark.parametrize("friction", [0.1, 0.5])
@pytest.mark.parametrize("poisson_ratio", [0.0, 0.3, 0.45])
def test_in_full_contact_the_coupling_turns_the_phase_as_the_compliances_say(
    friction, poisson_ratio
):
    """p^ (1 - i mu k) = h^/C with k = F12/C = (1 - 2 nu)/(2 (1 - nu)): 0.286 for nu = 0.3."""
    solid = ck.Material(young_modulus=E, poisson_ratio=poisson_ratio)
    wave = ck.Wave(amplitude=1e-9, wavelength=1e-6)
    run, part = coupled(
        friction,
        lower=solid,
        surface=wave,
        width=1e-6,
        height=0.2e-6,
        grid=(2, 32),
        pressure=1e8,
        accuracy={"rtol": 1e-10},
    )
    k = (1.0 - 2.0 * poisson_ratio) / (2.0 * (1.0 - poisson_ratio))
    alone = math.pi * solid.plane_strain_modulus * 1e-9 / 1e-6
    got = np.fft.rfft(run.pressure[0])[1] / 16.0
    assert got == pytest.approx(alone / (1.0 - 1j * friction * k), rel=1e-6)
    ratio = np.ptp(part.displacement) / np.ptp(run.displacement - part.displacement)
    assert ratio == pytest.approx(friction * k, rel=1e-2)


@pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "free"])
def test_the_coupling_vanishes_where_nothing_couples(periodic):
    rubber = ck.Material(young_modulus=E, poisson_ratio=0.5)
    for given in ({"lower": rubber}, {"lower": SOLID, "upper": SOLID}):
        run, part = coupled(0.5, pressure=2e6, periodic=periodic, **given)
        check(run)
        assert np.abs(part.displacement).max() <= 1e-12 * run.max_displacement
        assert part.pressure_change <= 1e-6
        assert part.area_change == 0.0


@pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "free"])
def test_the_coupled_contact_does_not_depend_on_the_start(periodic):
    run, part = coupled(0.5, pressure=2e6, periodic=periodic)
    other = solved(pressure=1.2e7, periodic=periodic)
    again, _ = coupled(0.5, pressure=2e6, periodic=periodic, start=other)
    np.testing.assert_allclose(again.pressure, run.pressure, atol=2e-5 * run.max_pressure)
    assert run.gap.min() >= 0.0
    assert run.gap[run.contact].max() <= 1e-6 * run.heights.std()
    assert 0.5 * 0.286 * 0.3 < part.pressure_change < 0.5 * 0.286 * 2.0


def test_the_surface_sinks_ahead_of_the_traction_and_the_contact_moves_back():
    """Johnson 1985, section 2.3: ahead of a tangential force the surface is pressed in."""
    ball = ck.Paraboloid(radius=1e-5)
    given = {"surface": ball, "periodic": False, "width": 4e-7, "grid": 49, "force": 1e-7}
    run, part = coupled(0.5, **given)
    row = part.displacement[24]
    assert row[40] > 0.0 > row[8]
    x = np.arange(49) - 24
    centre = float((run.pressure.sum(axis=0) * x).sum() / run.pressure.sum())
    assert centre < -0.1
    back, _ = coupled(0.5, angle=math.pi, **given)
    np.testing.assert_allclose(back.pressure, run.pressure[:, ::-1], atol=1e-4 * run.max_pressure)


# A film that pulls --------------------------------------------------------------------------


def film(thickness, **given):
    return ck.FilmMeniscus(film_thickness=thickness, self_consistent=True, **given)


def balanced(run):
    """Relative imbalance of load, film and elastic bodies."""
    imposed = run.plan.mean_pressure * run.plan.grid.area
    return abs(run.load - imposed - run.of(ck.FilmMeniscus).force) / run.load


BALL = 1e-3
RIM = math.sqrt(2.0 * BALL * 1e-9)
PULL = 2.0 * math.pi * BALL * 0.07275  # cos + cos = 1
RIGID = ck.Material(young_modulus=1e15, poisson_ratio=NU)


def ball_on_film(force, solid=RIGID, grid=96, width=6.0 * RIM, wet=FILM):
    return solved(
        film(1e-9),
        lower=solid,
        surface=ck.Paraboloid(radius=BALL),
        meniscus=wet,
        grid=grid,
        width=width,
        periodic=False,
        force=force,
    )


def test_a_stiff_ball_on_a_film_is_pulled_by_the_classical_force():
    for force in (0.0, 1e-5):
        run = ball_on_film(force)
        part = run.of(ck.FilmMeniscus)
        assert part.force == pytest.approx(PULL, rel=2e-2)
        assert run.load == pytest.approx(force + part.force, rel=1e-5)
        assert part.equilibria[0] == pytest.approx(run.load)
        wanted = part.force / force if force else math.inf
        assert part.relative_force == pytest.approx(wanted)


def test_the_pull_on_a_ball_that_yields_grows_with_the_load():
    soft = ck.Material(young_modulus=1e12, poisson_ratio=NU)
    runs = [ball_on_film(force, soft, width=12.0 * RIM) for force in (0.0, 2e-2, 2e-1)]
    pulls = [run.of(ck.FilmMeniscus).force for run in runs]
    assert pulls == sorted(pulls)
    assert pulls[-1] > 1.1 * pulls[0] > 1.1 * PULL
    approaches = [run.approach for run in runs]
    assert approaches == sorted(approaches)


@pytest.mark.parametrize("force", [0.0, 1e-5, 1e-4, 1e-3])
def test_a_result_under_a_film_is_in_balance_or_says_that_it_is_not(force):
    """On few pixels the force moves in steps; one that straddles the balance must be reported."""
    soft = ck.Material(young_modulus=1e9, poisson_ratio=NU)
    plan = made(
        film(1e-9),
        lower=soft,
        surface=ck.Paraboloid(radius=BALL),
        meniscus=FILM,
        grid=64,
        width=60.0 * RIM,
        periodic=False,
        force=force,
    )
    run = ck.solve(plan, throw=False)
    assert balanced(run) < 1e-5 or run.status == "not converged" or "film" in run.message


@pytest.mark.parametrize(
    ("modulus", "thickness", "pressure"),
    quick(
        [(3e8, 1e-9, 0.0), (3e8, 2e-9, 3e6), (1e9, 1e-9, 0.0), (1e9, 1e-9, 1e5), (1e10, 1e-9, 3e6)],
        1,
        3,
    ),
)
def test_a_load_below_the_hardness_has_an_equilibrium_with_any_film(modulus, thickness, pressure):
    """As load and pull approach H*A the bodies touch all over, and there are no menisci left."""
    solid = ck.Material(young_modulus=modulus, poisson_ratio=NU, hardness=5e7)
    limit = ck.HardnessLimit(rule="material")
    wet = ck.Meniscus(liquid=WATER)
    run = solved(film(thickness), limit, lower=solid, meniscus=wet, pressure=pressure)
    assert run.max_pressure <= solid.hardness * (1.0 + 1e-12)
    assert pressure < run.mean_pressure < solid.hardness
    assert balanced(run) < 2e-2  # steps of whole pixels


REPELLED = ck.Meniscus(  # cos + cos = -1
    liquid=WATER, contact_angle_lower=2.0 * math.pi / 3.0, contact_angle_upper=2.0 * math.pi / 3.0
)


def test_a_stiff_ball_floats_on_a_film_that_repels_until_the_load_exceeds_its_push():
    """The push of a stiff ball is the classical force with the other sign, at any load."""
    run = ball_on_film(3.0 * PULL, wet=REPELLED)
    assert run.of(ck.FilmMeniscus).force == pytest.approx(-PULL, rel=2e-2)
    assert run.load == pytest.approx(2.0 * PULL, rel=2e-2)
    assert run.load == pytest.approx(3.0 * PULL + run.of(ck.FilmMeniscus).force, rel=1e-5)
    with pytest.raises(ck.InfeasibleError, match="they float on it; raise the load, lower the"):
        ball_on_film(0.9 * PULL, wet=REPELLED)


@pytest.mark.parametrize("thickness", [1e-10, 1e-9])
def test_a_film_that_repels_carries_a_part_of_the_load(thickness):
    run = solved(film(thickness), meniscus=REPELLED, pressure=3e7)
    part = run.of(ck.FilmMeniscus)
    assert len(part.equilibria) == 1
    assert 0.0 < run.mean_pressure < 0.5 * 3e7
    assert balanced(run) < 2e-2  # steps of whole pixels


def peak_on_a_plateau(**given):
    """One hard peak holds a wide plateau away from the film, up to a load."""
    x = (np.arange(48) - 24) * 2e-8
    peak = 3e-9 - (x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * 4e-7)
    surface = ck.Heights(heights=np.maximum(peak, 0.0), pixel_size=2e-8)
    solid = ck.Material(young_modulus=1e11, poisson_ratio=NU)
    wet = ck.Meniscus(liquid=WATER)
    return ck.solve(
        made(
            film(5e-10), lower=solid, surface=surface, meniscus=wet, width=None, grid=None, **given
        )
    )


def test_snap_in_is_reported_and_the_smallest_equilibrium_is_taken():
    light = peak_on_a_plateau(force=1e-6)
    part = light.of(ck.FilmMeniscus)
    assert len(part.equilibria) == 3
    assert list(part.equilibria) == sorted(part.equilibria)
    assert light.load == pytest.approx(part.equilibria[0])
    assert part.equilibria[1] > 2.0 * light.load
    assert light.scalars()["n_equilibria"] == (3, "-")
    # Pressed beyond the second, the bodies come together.
    heavy = peak_on_a_plateau(force=4.0 * part.equilibria[1])
    assert len(heavy.of(ck.FilmMeniscus).equilibria) == 1
    assert heavy.of(ck.FilmMeniscus).area > 20.0 * part.area


# Reuse --------------------------------------------------------------------------------------


def test_results_do_not_depend_on_what_was_solved_before():
    """One plan under many loads, each from the last, and back again."""
    first, last, runs = made(pressure=1e5), None, []
    plans = [first.with_loading(ck.Pressing(pressure=p)) for p in (1e5, 1e6, 1e7, 1e6, 1e5)]
    for plan in plans:
        last = ck.solve(plan, start=last)
        check(last)
        runs.append(last)
    for up, down in ((0, 4), (1, 3)):
        np.testing.assert_allclose(
            runs[down].pressure, runs[up].pressure, atol=1e-5 * runs[up].max_pressure
        )
    fresh = ck.solve(plans[2])
    np.testing.assert_allclose(runs[2].pressure, fresh.pressure, atol=1e-5 * fresh.max_pressure)


def test_no_friction_couples_nothing():
    free, rubbed = (
        solved(*effects, pressure=1e7)
        for effects in ((), (ck.FrictionTraction(coefficient=0.0), ck.FrictionCoupling()))
    )
    np.testing.assert_allclose(rubbed.pressure, free.pressure, atol=1e-6 * free.max_pressure)
    assert rubbed.residual <= 1e-8
    part = rubbed.of(ck.FrictionCoupling)
    assert not part.displacement.any()
    assert (part.pressure_change, part.area_change) == (0.0, 0.0)
