"""Sobol' indices against those that are known, and what they refuse."""

import math

import pytest

import contactkit as ck

PULL = {
    "loading.force": (0.5, 1.5),
    "loading.mass": (0.001, 0.003),
    "loading.initial_gap": (4e-6, 6e-6),
}
OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
SCENE = ck.SeparationScene(
    interface=ck.Interface(
        lower=ck.Flat(radius=1e-3), upper=ck.Flat(radius=1e-3), meniscus=ck.Meniscus(liquid=OIL)
    ),
    loading=ck.ImposedForce(force=1.0, mass=2e-3, initial_gap=5e-6, final_gap=2e-5),
    effects=(ck.ViscousForce(),),
)


def test_a_sum_has_first_order_indices_as_its_variances_and_no_others():
    """Y = 3 a + b with a, b even in ranges of 1 and 2: 9/13 and 4/13; c has no part."""

    def total(scene):
        loading = scene.loading
        return 3.0 * loading.force + (loading.mass - 0.002) / 0.001

    found = ck.sobol_indices(SCENE, PULL, total, n=256)
    assert found.paths[0] == "loading.force"
    by_path = dict(zip(found.paths, zip(found.first, found.total, strict=True), strict=True))
    for path, wanted in (("loading.force", 9.0 / 13.0), ("loading.mass", 4.0 / 13.0)):
        assert by_path[path] == pytest.approx((wanted, wanted), abs=0.02)
    assert by_path["loading.initial_gap"] == pytest.approx((0.0, 0.0), abs=1e-9)
    assert found.deviation == pytest.approx(math.sqrt(13.0 / 12.0), rel=0.02)
    low, high = found.first_interval[0]
    assert low < 9.0 / 13.0 < high


def test_a_product_acts_in_pairs_alone():
    """Y = (a - 1)(b - 2): neither has a first-order index, both a total one of 1."""

    def product(scene):
        return (scene.loading.force - 1.0) * (scene.loading.mass - 0.002) / 0.001

    two = {path: PULL[path] for path in ("loading.force", "loading.mass")}
    found = ck.sobol_indices(SCENE, two, product, n=256)
    assert found.first == pytest.approx((0.0, 0.0), abs=0.05)
    assert found.total == pytest.approx((1.0, 1.0), abs=0.1)


def test_ranges_of_decades_are_spread_by_ratios():
    def decade(scene):
        return math.log10(scene.interface.meniscus.liquid.viscosity)

    wide = {"interface.meniscus.liquid.viscosity": (1e-3, 1.0)}
    found = ck.sobol_indices(SCENE, wide, decade, n=64, unit="-")
    assert found.mean == pytest.approx(-1.5, abs=0.02)
    assert found.first[0] == pytest.approx(1.0, abs=0.02)


@pytest.mark.slow
def test_a_quantity_by_its_name_is_that_of_the_runs_and_the_same_every_time():
    ranges = {"interface.meniscus.liquid.viscosity": (0.09, 0.11), "loading.mass": (1e-3, 1.1e-3)}
    timed = ck.SeparationScene(
        interface=SCENE.interface,
        loading=ck.ImposedForce(force=1.0, mass=1e-3, initial_gap=5e-6, final_gap=2e-5),
        effects=SCENE.effects,
    )
    one, again = (
        ck.sobol_indices(timed, ranges, "release_time", ck.Accuracy.draft, n=4) for _ in range(2)
    )
    assert one.unit == "s"
    assert one.first == again.first
    assert one.total_interval == again.total_interval
    assert one.paths[0] == "interface.meniscus.liquid.viscosity"
    assert one.to_dataframe()["total"].tolist() == list(one.total)
    assert "release_time = " in str(one)


def test_scenes_without_an_answer_leave_no_variance():
    def none(scene):
        return math.nan if scene.loading.force > 1.0 else 1.0

    with pytest.raises(ck.InfeasibleError, match=r"scenes have no answer.*narrow the ranges"):
        ck.sobol_indices(SCENE, PULL, none, n=4)


def test_what_does_not_vary_has_no_part():
    found = ck.sobol_indices(SCENE, PULL, lambda scene: 2.0, n=4)
    assert found.total == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("n", [0, 3, 2.0, True])
def test_the_number_of_samples_is_a_power_of_two(n):
    with pytest.raises(ck.DescriptionError, match="power of 2"):
        ck.sobol_indices(SCENE, PULL, lambda scene: 2.0, n=n)


def test_a_range_of_names_has_no_variance():
    with pytest.raises(ck.DescriptionError, match="range of one number"):
        ck.sobol_indices(SCENE, {"name": ("a", "b")}, lambda scene: 2.0)


@pytest.mark.slow
def test_the_indices_are_drawn():
    found = ck.sobol_indices(SCENE, PULL, lambda scene: scene.loading.force, n=8)
    assert "part of the variance" in found.plot.indices().get_xlabel()
