"""Bridges on the islands of a rough contact: one sphere, many, and what is counted."""

from __future__ import annotations

import math

import numpy as np
import pytest

import contactkit as ck
from contactkit.capillary import island_bridges as kernel
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.film_islands import film_force, islands
from contactkit.files.results import load_result, save_result

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

LIQUID = ck.Liquid(name="oil", surface_tension=0.03, density=900.0, molar_mass=0.4)
RIGID = ck.Material(young_modulus=1e16, poisson_ratio=0.3)
SOFT = ck.Material(young_modulus=2e9, poisson_ratio=0.3)


def bumps(centres, n=160, pixel=2e-8, radius=1e-6, depth=20e-9, tops=(0.0,)):
    """Paraboloids of one radius on a flat, with their tops below zero."""
    x = (np.arange(n) + 0.5) * pixel
    tops = np.resize(tops, len(centres))
    heights = np.full((n, n), -depth)
    for (cy, cx), top in zip(centres, tops, strict=True):
        r2 = (x[:, None] - cy) ** 2 + (x[None, :] - cx) ** 2
        heights = np.maximum(heights, -top - r2 / (2.0 * radius))
    return ck.Heights(heights=heights, pixel_size=pixel)


def pressed(surface, *effects, solid=RIGID, load=1e-9, angles=(0.0, 0.0), periodic=True, **film):
    meniscus = ck.Meniscus(
        liquid=LIQUID, contact_angle_lower=angles[0], contact_angle_upper=angles[1], **film
    )
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid), upper=ck.Body(surface=surface), meniscus=meniscus
        ),
        window=ck.Window(periodic=periodic),
        loading=ck.Pressing(force=load),
        effects=(ck.HalfSpace(), *effects),
    )
    return ck.solve(ck.plan(scene))


FOUR = [(0.8e-6, 0.8e-6), (0.8e-6, 2.4e-6), (2.4e-6, 0.8e-6), (2.4e-6, 2.4e-6)]


@pytest.mark.parametrize("curvature", ["island", "summit"])
def test_four_equal_summits_have_four_bridges_of_their_sphere(curvature):
    film, surface = 4.1e-9, bumps(FOUR)
    effect = ck.IslandBridges(film_thickness=film, curvature=curvature)
    found = pressed(surface, effect, angles=(0.3, 0.5)).of(ck.IslandBridges)
    assert (found.n_menisci, found.n_dry, found.n_overlapping) == (4, 0, 0)
    assert found.radius == pytest.approx(1e-6, rel=0.02 if curvature == "island" else 1e-6)
    area = 2.0 * math.pi * 1e-6 * film  # where the gap is below the film
    below = np.count_nonzero(surface.heights > surface.heights.max() - film) / 4.0
    assert found.volume == pytest.approx(film * below * 4e-16, rel=1e-12)
    assert below * 4e-16 == pytest.approx(area, rel=0.07)  # 68 pixels for a circle of 64.4
    one = 0.03 * float(bridge(0.0, film * area, 0.3, 0.5, 0.0, 1e6).force)
    assert found.force == pytest.approx(4.0 * one, rel=0.02)
    assert found.force == pytest.approx(found.forces.sum(), rel=1e-14)
    assert found.law == f"exact bridge on each island, {curvature} curvature, film gathered on it"
    place = np.sort(found.point, axis=None).reshape(-1, 4)
    assert place[:, 0] == pytest.approx([0.8e-6, 2.4e-6], abs=2e-8)


def test_a_summit_below_the_others_has_its_own_gap():
    tops = (0.0, 0.0, 0.0, 2e-9)
    found = pressed(bumps(FOUR, tops=tops), ck.IslandBridges(film_thickness=4e-9)).of(
        ck.IslandBridges
    )
    assert np.sort(found.gap) == pytest.approx([0.0, 0.0, 0.0, 2e-9], abs=5e-11)
    least = int(np.argmax(found.gap))
    assert found.radius == pytest.approx(1e-6, rel=0.05)
    assert found.forces[least] == min(found.forces)
    each = bridge(found.gap, found.volume, 0.0, 0.0, 0.0, 1.0 / found.radius)
    assert found.forces == pytest.approx(0.03 * each.force, rel=1e-12)


def test_the_sum_over_thin_islands_is_the_cross_cut_of_the_same_film():
    """With wide shallow summits Eq. (2.43) and the bridges at fixed pressure agree."""
    tension, pressure = 0.03, -0.03 * 2.0 / 4e-9
    wide = [(100.0 * y, 100.0 * x) for y, x in FOUR]
    surface = bumps(wide, pixel=2e-6, radius=1e-2)
    found = pressed(surface, ck.IslandBridges(), pressure=pressure).of(ck.IslandBridges)
    cut = float(film_force(found.area, tension, 0.0, 0.0, 4e-9))
    assert found.n_menisci == 4
    assert found.force == pytest.approx(cut, rel=3e-3)


def test_the_force_of_an_island_across_the_edge_is_that_of_one_inside():
    inside = pressed(bumps([(1.6e-6, 1.6e-6)]), ck.IslandBridges(film_thickness=4e-9))
    shifted = ck.Heights(
        heights=np.roll(bumps([(1.6e-6, 1.6e-6)]).heights, (80, 75), (0, 1)), pixel_size=2e-8
    )
    across = pressed(shifted, ck.IslandBridges(film_thickness=4e-9))
    a, b = (r.of(ck.IslandBridges) for r in (inside, across))
    assert (a.n_menisci, b.n_menisci) == (1, 1)
    assert b.force == pytest.approx(a.force, rel=1e-9)


def test_neighbours_that_overlap_are_counted():
    near = [(0.99e-6, 0.99e-6), (0.99e-6, 1.19e-6), (2.59e-6, 2.59e-6)]
    found = pressed(bumps(near), ck.IslandBridges(film_thickness=4e-9)).of(ck.IslandBridges)
    assert found.n_menisci == 3
    assert found.n_overlapping == 2
    assert found.coverage == pytest.approx(
        math.pi * np.square(found.contact_radius).sum() / (3.2e-6) ** 2, rel=1e-12
    )


def test_repelling_liquid_pushes_and_one_that_nothing_spans_is_counted_dry():
    surface = bumps(FOUR, tops=(0.0, 0.0, 0.0, 3.9e-9))
    pushes = pressed(surface, ck.IslandBridges(film_thickness=4e-9), angles=(2.0, 2.0)).of(
        ck.IslandBridges
    )
    assert pushes.force < 0.0
    dry = pressed(surface, ck.IslandBridges(film_thickness=4e-9), angles=(0.0, math.pi)).of(
        ck.IslandBridges
    )
    assert (dry.n_menisci, dry.n_dry, dry.force) == (0, 4, 0.0)


def test_soft_bodies_flatten_the_summits_and_the_force_follows_the_gap_map():
    few = pressed(bumps(FOUR), ck.IslandBridges(film_thickness=4e-9), solid=SOFT, load=1e-8)
    more = pressed(bumps(FOUR), ck.IslandBridges(film_thickness=4e-9), solid=SOFT, load=1e-6)
    a, b = few.of(ck.IslandBridges), more.of(ck.IslandBridges)
    assert np.all(b.gap == 0.0)
    assert b.area > a.area
    assert b.force > a.force
    assert more.scalars()["n_island_bridges"] == (4, "-")
    assert b.relative_force == pytest.approx(b.force / 1e-6, rel=1e-6)


def test_the_finer_the_grid_the_nearer_to_the_sphere():
    errors = []
    one = 0.03 * float(bridge(0.0, 4e-9 * 2 * math.pi * 4e-15, 0.0, 0.0, 0.0, 1e6).force)
    for n in (40, 160, 640):
        surface = bumps([(1.6e-6, 1.6e-6)], n=n, pixel=3.2e-6 / n)
        found = pressed(surface, ck.IslandBridges(film_thickness=4e-9)).of(ck.IslandBridges)
        errors.append(abs(found.force / one - 1.0))
    assert errors[2] < 0.015  # an area counted in a thousand pixels
    assert errors[2] < errors[0]


def test_a_result_with_bridges_is_written_and_read(tmp_path):
    result = pressed(bumps(FOUR), ck.IslandBridges(film_thickness=4e-9))
    save_result(result, tmp_path / "islands.npz")
    again = load_result(tmp_path / "islands.npz").of(ck.IslandBridges)
    assert np.array_equal(again.forces, result.of(ck.IslandBridges).forces)
    assert again.law == result.of(ck.IslandBridges).law


LACKS = [
    ({}, {}, r"either film_thickness \[m\] or interface.meniscus.pressure"),
    ({"film_thickness": 1e-9}, {"pressure": -1e6}, "either film_thickness"),
    ({"film_thickness": 1e-9}, {"volume": 1e-20}, "the islands set the volumes"),
    ({}, {"pressure": -1e6, "angles": (2.0, 1.5)}, "nothing condenses between others"),
]


@pytest.mark.parametrize(("choices", "film", "message"), LACKS)
def test_what_it_lacks_is_named(choices, film, message):
    with pytest.raises(ck.PlanError, match=message):
        pressed(bumps(FOUR), ck.IslandBridges(**choices), **film)


def test_a_film_law_refuses_a_pressure():
    with pytest.raises(ck.PlanError, match=r"a film thickness, not interface.meniscus.pressure"):
        pressed(bumps(FOUR), ck.FilmMeniscus(film_thickness=1e-9), pressure=-1e6)


# The kernel ---------------------------------------------------------------------------------


def test_islands_are_measured_pixel_by_pixel():
    rng = np.random.default_rng(7)
    gap = np.maximum(rng.normal(size=(40, 50)), 0.0)
    heights = rng.normal(size=gap.shape)
    contact = gap == 0.0
    names, n = islands(gap < 0.6, periodic=True)
    found = kernel.measure_islands(names, n, gap, contact, heights, 2.0)
    for i in range(1, n + 1):
        here = names == i
        assert found.area[i - 1] == 2.0 * here.sum()
        assert found.contact_area[i - 1] == 2.0 * (here & contact).sum()
        assert found.gap[i - 1] == gap[here].min()
        y, x = found.summit[i - 1]
        assert here[y, x]
        touching = here & contact
        value = heights[touching].max() if touching.any() else -gap[here].min()
        assert (heights if touching.any() else -gap)[y, x] == value


def test_overlap_agrees_with_looking_at_every_pair():
    rng = np.random.default_rng(5)
    points, radii = rng.uniform(0.0, 1.0, (300, 2)), rng.uniform(0.0, 0.04, 300)
    for period in ((math.inf, math.inf), (1.0, 1.0), (math.inf, 1.0), (1.0, math.inf)):
        apart = np.abs(points[:, None] - points[None])
        apart = np.minimum(apart, np.array(period) - apart)
        touch = np.hypot(apart[..., 0], apart[..., 1]) < radii[:, None] + radii[None]
        np.fill_diagonal(touch, False)
        assert np.array_equal(kernel.overlapping(points, radii, period), touch.any(axis=1))


def test_an_island_all_in_contact_has_no_room():
    one = kernel.Islands(np.zeros((1, 2), int), np.zeros(1), np.ones(1), np.ones(1))
    assert kernel.curvature_of_area(one, 1.0).tolist() == [math.inf]
    assert kernel.overlapping(np.zeros((1, 2)), np.ones(1)).tolist() == [False]


def test_curvature_at_the_edge_is_that_of_the_inner_neighbour():
    y, x = np.mgrid[0:5, 0:6].astype(float)
    heights = -0.5 * (x**2 / 3.0 + y**2 / 5.0)
    summit = np.array([[0, 0], [4, 5], [2, 3]])
    found = kernel.summit_curvature(heights, summit, (1.0, 1.0), (False, False))
    assert found == pytest.approx(0.5 * (1.0 / 3.0 + 1.0 / 5.0), rel=1e-12)


@pytest.mark.parametrize(("humidity", "is_valid"), [(0.7, True), (0.4, False)])
def test_the_radius_of_condensed_menisci_is_judged(humidity, is_valid, recwarn):
    """Below 1 nm the tension is not that of the bulk: water at 20 degC has 1.51 and 0.59 nm."""
    water = ck.Meniscus(liquid=ck.load_liquid("water"), relative_humidity=humidity)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=RIGID), upper=ck.Body(surface=bumps(FOUR)), meniscus=water
        ),
        window=ck.Window(periodic=True),
        loading=ck.Pressing(force=1e-9),
        effects=(ck.HalfSpace(), ck.IslandBridges()),
    )
    found = {one.name: one for one in ck.solve(ck.plan(scene)).validity}
    radius = found["Kelvin radius [m]"]
    hand = 0.07274 * 18.05e-6 / (8.31446 * 293.15 * -math.log(humidity))
    assert radius.value == pytest.approx(hand, rel=2e-3)
    assert radius.is_valid is is_valid
