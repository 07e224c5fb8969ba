"""Adhesion of maps where it is hard: extreme ranges and works, far apart, stiff films, refusals."""

from __future__ import annotations

import math
import warnings

import numpy as np
import pytest
from attrs import evolve
from selection import quick

import contactkit as ck

pytestmark = pytest.mark.hard

HEIGHTS = 1e-9 * np.random.default_rng(3).normal(size=(12, 16))
SOLID = ck.Material(young_modulus=1e9, poisson_ratio=0.3, hardness=1e8)
WEAK = ck.ExponentialAttraction(work_of_adhesion=0.01, range=5e-9)


def scene(law, *effects, periodic=False, solid=SOLID, approach=0.0, loading=None, heights=HEIGHTS):
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Heights(heights=heights, pixel_size=2e-8)),
        ),
        window=ck.Window(periodic=periodic),
        loading=loading or ck.Approach(approach=approach),
        effects=(ck.LayeredHalfSpace(), ck.Adhesion(law=law), *effects),
    )


def solved(*args, **given):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        result = ck.solve(ck.plan(scene(*args, **given)))
    assert result.residual <= 1e-8
    numbers = [value for value, _ in result.scalars().values()]
    assert np.all(np.isfinite(numbers))
    assert all(np.all(np.isfinite(result[name])) for name in result.columns)
    return result


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("reach", [1e-13, 1e-11, 1e-7, 1e-3, 1e3])
@pytest.mark.parametrize(
    "kind", [ck.ExponentialAttraction, ck.DugdaleAttraction, ck.LennardJonesAttraction]
)
def test_any_range_has_an_answer(kind, reach, periodic):
    result = solved(kind(work_of_adhesion=1e-3, range=reach), periodic=periodic, approach=1e-9)
    part = result.of(ck.Adhesion)
    assert result.status == "converged"
    assert part.adhesive_energy >= -1e-3 * result.plan.grid.area * (1.0 + 1e-12)


@pytest.mark.parametrize("work", [1e-30, 1e-9])
def test_little_adhesion_changes_little(work):
    law = ck.ExponentialAttraction(work_of_adhesion=work, range=1e-9)
    dry = scene(law, approach=1e-9)
    bare = ck.ContactScene(
        interface=dry.interface, window=dry.window, loading=dry.loading, effects=dry.effects[:1]
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        expected = ck.solve(ck.plan(bare))
    assert solved(law, approach=1e-9).load == pytest.approx(expected.load, rel=1e-5)


@pytest.mark.parametrize("approach", [-1e-6, -1.0, -1e3])
def test_far_apart_nothing_pulls(approach):
    result = solved(ck.DugdaleAttraction(work_of_adhesion=0.05, range=1e-9), approach=approach)
    assert (result.load, result.status) == (0.0, "no contact")
    assert result.of(ck.Adhesion).tabor_parameter is None


def test_attraction_without_contact_is_a_state():
    result = solved(WEAK, approach=-4e-9)
    assert result.status == "no contact"
    assert result.contact_area == 0.0
    assert result.load < 0.0


@pytest.mark.parametrize(
    ("periodic", "loading"),
    [
        (False, ck.Approach(approach=0.0)),
        (False, ck.Pressing(force=0.0)),
        (True, ck.Pressing(force=0.0)),
    ],
)
def test_strong_adhesion_closes_the_gap(periodic, loading):
    law = ck.DugdaleAttraction(work_of_adhesion=5.0, range=2e-8)
    result = solved(law, periodic=periodic, loading=loading)
    assert result.contact_fraction == 1.0
    assert result.pressure.min() < 0.0
    assert result.of(ck.Adhesion).adhesive_energy == pytest.approx(
        -5.0 * result.plan.grid.area, rel=1e-6, abs=0.0
    )


@pytest.mark.parametrize(
    ("ratio", "periodic"),
    quick([(1e-3, False), (1e-3, True), (1e3, False), (1e3, True)], 0),
)
def test_layers_of_any_stiffness(ratio, periodic):
    film = ck.Material(young_modulus=ratio * 1e9, poisson_ratio=0.3)
    stack = ck.Stack(layers=(ck.Layer(material=film, thickness=4e-9),), substrate=SOLID)
    assert solved(WEAK, solid=stack, periodic=periodic, approach=1e-9).status == "converged"


def waves(n, rms):
    """Heights of a rough map without waves shorter than six pixels [m]."""
    x = 2.0 * math.pi * np.arange(n) / n
    rng = np.random.default_rng(45)
    found = np.zeros((n, n))
    for ky in range(-n // 6 + 1, n // 6):
        for kx in range(n // 6):
            if (k := math.hypot(kx, ky)) >= 1.0:
                phase = ky * x[:, None] + kx * x + rng.uniform(0.0, 2.0 * math.pi)
                found += k**-1.8 * rng.normal() * np.cos(phase)
    return rms / found.std() * found


def on_stiff_film(end_width=None, *, ratio=100.0, pixels=3.0, periodic=True, load=0.0):
    """State of a Dugdale attraction, whose end the grid makes r/75 wide, on a stiff film."""
    solid = ck.Material(young_modulus=8e9, poisson_ratio=0.3)
    film = ck.Material(young_modulus=ratio * 8e9, poisson_ratio=0.3)
    layer = ck.Layer(material=film, thickness=pixels * 2e-8)
    stack = ck.Stack(layers=(layer,), substrate=solid)
    law = ck.DugdaleAttraction(work_of_adhesion=0.24, range=1.2e-9, end_width=end_width)
    loading = ck.Pressing(pressure=load * 2e8)
    heights = waves(36, 2e-9)
    return solved(law, solid=stack, periodic=periodic, loading=loading, heights=heights)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("load", quick([0.0, 1.0], 1))
@pytest.mark.parametrize(("ratio", "pixels"), quick([(100.0, 3.0), (800.0, 1.5)], 0))
def test_the_steep_end_of_a_law_settles_on_a_stiff_film(ratio, pixels, load, periodic):
    result = on_stiff_film(ratio=ratio, pixels=pixels, periodic=periodic, load=load)
    part = result.of(ck.Adhesion)
    law = result.plan.scene.demand(ck.Adhesion).prepare(part.self_influence)
    assert law.numbers[2] < 0.1 * law.reach
    assert part.tension / law.strength == pytest.approx(
        law.tension(result.gap) / law.strength, abs=1e-6
    )
    assert part.n_contacts < 60


def test_the_end_of_the_grid_is_that_of_narrower_and_wider_ones_on_a_stiff_film():
    found = [on_stiff_film(width, load=0.5) for width in (None, 4e-12, 6e-11)]
    areas = [one.contact_area for one in found]
    assert found[0].of(ck.Adhesion).trapping_number == pytest.approx(0.5, rel=2e-3)
    assert areas == pytest.approx([areas[0]] * 3, rel=0.01)
    approaches = [one.approach for one in found]
    assert approaches == pytest.approx([approaches[0]] * 3, rel=2e-3)


def test_the_end_of_a_law_is_no_narrower_than_matters():
    law = ck.DugdaleAttraction(work_of_adhesion=0.05, range=1e-9)
    assert law.on_grid(1e-30).numbers[2] == pytest.approx(1e-12, rel=1e-6)


def test_what_does_not_settle_names_the_width_of_the_end(monkeypatch):
    monkeypatch.setattr("contactkit.contact.outer.iteration.MAX_MONOTONIC", 3)
    with pytest.raises(ck.ConvergenceError, match=r"end_width = 2\.4e-10 m, now") as caught:
        on_stiff_film()
    monkeypatch.undo()
    assert "raise Accuracy.rtol" in str(caught.value)
    assert on_stiff_film(2.4e-10).status == "converged"


@pytest.mark.parametrize("end_width", [1e-11, 1e-9])
def test_the_cure_of_a_steep_end_helps(end_width):
    law = ck.DugdaleAttraction(work_of_adhesion=0.01, range=1e-9, end_width=end_width)
    text = law.cure_of_trapping(2.0, 0.5)
    value = float(text.split(" m")[0].split()[-1])
    steepest = law.on_grid(1.0).steepest
    cured = (
        evolve(law, end_width=value)
        if "at least" in text
        else evolve(law, range=value, end_width=value)
    )
    assert cured.on_grid(1.0).steepest == pytest.approx(0.25 * steepest, rel=0.01)


def test_a_flat_pulls_with_the_tension_of_its_gap():
    flat = np.zeros((8, 8))
    result = solved(WEAK, periodic=True, approach=-5e-9, heights=flat)
    assert result.mean_pressure == pytest.approx(-0.01 / 5e-9 * math.exp(-1.0), rel=1e-9)


def test_a_layer_on_a_base_is_drawn_out_by_a_uniform_tension():
    layer = ck.Material(young_modulus=1e9, poisson_ratio=0.0)
    stack = ck.Stack(
        layers=(ck.Layer(material=layer, thickness=1e-7),), substrate=ck.RigidBase(bonded=True)
    )
    result = solved(WEAK, periodic=True, approach=-5e-9, heights=np.zeros((8, 8)), solid=stack)
    assert result.displacement == pytest.approx(1e-7 / 1e9 * result.mean_pressure, rel=1e-6)
    assert result.gap == pytest.approx(result.displacement + 5e-9, rel=1e-9)
    assert result.mean_pressure == pytest.approx(-2e6 * np.exp(-result.gap.mean() / 5e-9), rel=1e-6)


def test_a_study_of_approaches_finds_the_state_of_an_approach_at_each():
    law = ck.DugdaleAttraction(work_of_adhesion=0.2, range=3e-9)
    levels = [0.0, -2e-9, -4e-9]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        found = ck.study(scene(law), {"loading.approach": levels}).column("load")
        alone = [ck.solve(ck.plan(scene(law, approach=one))).load for one in levels]
        path = ck.pull_off_curve(ck.plan(scene(law)), levels[::-1], n_refinements=0)
    assert list(found) == pytest.approx(alone, rel=1e-6)
    assert abs(path.separating.load[-1] - alone[-1]) > 0.01 * abs(path.separating.load[-1])


@pytest.mark.parametrize("load", [0.0, 1e5, 1e7])
def test_a_load_below_and_above_the_attraction(load):
    result = solved(WEAK, loading=ck.Pressing(pressure=load))
    assert result.mean_pressure == pytest.approx(load, rel=1e-8, abs=1e-3)
    assert result.contact.any()


def test_pixels_at_the_hardness_beside_pixels_that_pull():
    limit = ck.HardnessLimit(rule="material")
    result = solved(WEAK, limit, loading=ck.Pressing(pressure=2e7))
    assert result.max_pressure == pytest.approx(1e8, rel=1e-9)
    assert result.pressure.min() < 0.0


def test_a_range_below_the_grid_rule_warns_and_names_one_above():
    law = ck.ExponentialAttraction(work_of_adhesion=0.05, range=0.3e-9)
    with pytest.warns(ck.ValidityWarning) as caught:
        ck.solve(ck.plan(scene(law)))
    text = next(str(one.message) for one in caught if "trapping number" in str(one.message))
    assert "scale the range up to 1." in text


@pytest.mark.parametrize(
    ("effect", "words"),
    [
        (ck.FilmMeniscus(film_thickness=1e-9), "no FilmMeniscus beside it"),
        (ck.IslandBridges(film_thickness=1e-9), "no IslandBridges beside it"),
    ],
)
def test_liquid_in_the_gap_is_refused_beside_adhesion_across_air(effect, words):
    with pytest.raises(ck.PlanError, match=words):
        ck.plan(scene(WEAK, effect))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: ck.ExponentialAttraction(work_of_adhesion=0.0, range=1e-9), "leave Adhesion out"),
        (lambda: ck.ExponentialAttraction(work_of_adhesion=-1.0, range=1e-9), "J/m2"),
        (lambda: ck.LennardJonesAttraction(work_of_adhesion=0.05, range=0.0), "positive"),
        (
            lambda: ck.DugdaleAttraction(work_of_adhesion=0.05, range=1e-9, end_width=2e-9),
            "at most range",
        ),
        (lambda: ck.Adhesion(law="exponential"), "be a AttractionLaw"),
        (
            lambda: ck.DugdaleAttraction.from_meniscus(
                surface_tension=0.07, contact_angle_lower=2.0, contact_angle_upper=2.0, height=1e-9
            ),
            "so that the film attracts",
        ),
    ],
)
def test_what_is_no_attraction_is_refused(make, words):
    with pytest.raises(ck.DescriptionError, match=words):
        make()


def test_a_curve_needs_adhesion_and_approaches_that_rise():
    plan = ck.plan(scene(WEAK))
    bare = ck.plan(ck.ContactScene(**{**_fields(plan.scene), "effects": (ck.HalfSpace(),)}))
    with pytest.raises(ck.NotSimulatedError, match="adhesion"):
        ck.pull_off_curve(bare, [-1e-9, 0.0])
    for wrong in ([0.0], [0.0, -1e-9], [0.0, math.nan], [[0.0, 1.0]]):
        with pytest.raises(ck.DescriptionError, match="pull_off_curve"):
            ck.pull_off_curve(plan, wrong)


def _fields(made):
    return {name: getattr(made, name) for name in ("interface", "window", "loading")}


def test_a_result_is_read_back_with_its_contact(tmp_path):
    result = solved(WEAK)
    again = ck.load_result(result.save(tmp_path / "stuck.npz"))
    assert np.array_equal(again.contact, result.contact)
    assert np.array_equal(again.of(ck.Adhesion).tension, result.of(ck.Adhesion).tension)
    assert [one.value for one in again.validity] == [one.value for one in result.validity]


def test_a_scene_file_names_the_law(tmp_path):
    file = tmp_path / "sphere.toml"
    made = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=SOLID), upper=ck.Body(surface=ck.Paraboloid(radius=1e-6))
        ),
        window=ck.Window(width=1e-7, periodic=False),
        loading=ck.Approach(approach=0.0),
        effects=(ck.HalfSpace(), ck.Adhesion(law=WEAK)),
    )
    ck.save_scene(made, file)
    text = file.read_text("utf-8")
    assert 'law = "exponential"' in text
    assert ck.load_scene(file) == made
    file.write_text(text.replace("exponential", "exponentiel"), "utf-8")
    with pytest.raises(ck.DescriptionError, match="did you mean 'exponential'"):
        ck.load_scene(file)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"approaches": ["-1 um"]}, "two finite numbers"),
        ({"approaches": [True, False]}, r"approaches\) must be a number"),
        (
            {"approaches": [-1e-9, 0.0], "n_refinements": 1.5},
            r"refinements\) must be a whole number",
        ),
        (
            {"approaches": [-1e-9, 0.0], "n_refinements": -1},
            r"refinements\) must be a whole number",
        ),
    ],
)
def test_a_curve_refuses_what_is_no_path(given, words):
    with pytest.raises(ck.DescriptionError, match=words):
        ck.pull_off_curve(ck.plan(scene(WEAK)), **given)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("work", [1e-12, 0.2])
def test_a_pull_is_carried_up_to_the_pull_off_force(work, periodic):
    law = ck.ExponentialAttraction(work_of_adhesion=work, range=5e-9)
    with pytest.raises(ck.InfeasibleError, match=r"a pull of 0.1 N exceeds the pull-off") as caught:
        solved(law, periodic=periodic, loading=ck.Pressing(force=-0.1))
    force = float(str(caught.value).split("about ")[1].split()[0])
    assert 0.0 < force <= work / 5e-9 * 12 * 16 * 4e-16
    result = solved(law, periodic=periodic, loading=ck.Pressing(force=-0.98 * force))
    assert result.load == pytest.approx(-0.98 * force, rel=1e-8)
    assert result.contact.any()
    with pytest.raises(ck.InfeasibleError, match="may hold more"):
        solved(law, periodic=periodic, loading=ck.Pressing(force=-1.03 * force))


def test_a_map_of_a_soft_contact_has_its_unit_and_the_tension_beside_it():
    plot = pytest.importorskip("contactkit.plot.contact")
    soft = ck.Material(young_modulus=1e6, poisson_ratio=0.3)
    weak = ck.ExponentialAttraction(work_of_adhesion=1e-5, range=5e-9)
    result = solved(weak, solid=soft, approach=-1e-9)
    assert not result.contact.any()
    drawn = plot.pressure(result)
    assert drawn.figure.axes[1].get_ylabel() == "pressure [kPa]"
    assert not np.ma.getmaskarray(drawn.images[0].get_array()).any()


def test_a_tension_that_leaves_round_off_of_the_pressure_is_refused():
    law = ck.DugdaleAttraction(work_of_adhesion=0.05, range=1e-30)
    with pytest.raises(ck.PlanError, match=r"work_of_adhesion/range is 5e.28 Pa.*check the units"):
        ck.plan(scene(law))


@pytest.mark.parametrize(("first", "words"), [(-60e-9, ""), (0.5e-9, "begin further apart")])
def test_a_curve_that_ends_before_the_pull_off_warns(first, words):
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always", ck.ValidityWarning)
        curve = ck.pull_off_curve(ck.plan(scene(WEAK)), [first, 2e-9], n_refinements=2)
    said = [one for one in heard if "tension at the end of the separation" in str(one.message)]
    assert bool(said) == bool(words)
    assert all(words in str(one.message) for one in said)
    assert curve.validity[-1].value == -curve.separating.load[-1] / curve.pull_off_force


def missed(curve):
    return [one.value for one in curve.validity if "by the approaches" in one.name]


def soft_pull(n):
    """A soft sphere whose load is smooth over the approach, at n approaches and no others."""
    rubber = ck.Material(young_modulus=1e6, poisson_ratio=0.5)
    made = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=rubber), upper=ck.Body(surface=ck.Paraboloid(radius=100e-6))
        ),
        window=ck.Window(width=50e-6, periodic=False),
        loading=ck.Approach(approach=0.0),
        effects=(
            ck.HalfSpace(),
            ck.Adhesion(law=ck.ExponentialAttraction(work_of_adhesion=0.05, range=2e-6)),
        ),
    )
    plan = ck.plan(made, ck.Accuracy(grid=24, rtol=1e-6))
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always", ck.ValidityWarning)
        curve = ck.pull_off_curve(plan, np.linspace(-3e-6, 1e-6, n), n_refinements=0)
    said = sum("give more approaches there" in str(one.message) for one in heard)
    return curve, said


def test_the_error_of_an_extreme_bounds_what_the_approaches_miss():
    """The extremes of sparse approaches against those of dense ones."""
    dense, said = soft_pull(65)
    assert max(missed(dense)) < 5e-3
    assert said == 0
    for n in (3, 4, 5, 7, 13):
        sparse, said = soft_pull(n)
        lost = 1.0 - sparse.pull_off_force / dense.pull_off_force
        assert 0.01 < lost < missed(sparse)[0], n
        assert said == 2


def test_a_reversible_loop_is_none_within_its_error():
    """A stiff sphere with a long range, whose branches have states in different places."""
    stiff = ck.Material(young_modulus=210e9, poisson_ratio=0.3)
    made = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=stiff), upper=ck.Body(surface=ck.Paraboloid(radius=1e-6))
        ),
        window=ck.Window(width=400e-9, periodic=False),
        loading=ck.Approach(approach=0.0),
        effects=(
            ck.HalfSpace(),
            ck.Adhesion(law=ck.DugdaleAttraction(work_of_adhesion=0.05, range=1e-9)),
        ),
    )
    levels = 1e-9 * np.array([-2.5, -1.0, -0.5, -0.2, 0.0, 0.05])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        curve = ck.pull_off_curve(ck.plan(made, ck.Accuracy(grid=32, rtol=1e-6)), levels)
    assert curve.is_closed
    assert 0.0 < abs(curve.loop_energy) <= curve.loop_error
    assert curve.loop_error < 0.2 * math.pi * 0.05 * 1e-6 * 1e-9
