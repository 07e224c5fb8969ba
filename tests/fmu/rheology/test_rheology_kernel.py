"""Forces of the kernel of a film whose viscosity follows pressure and shear, and their slopes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve
from native_scenes import HAS_CC, probed
from rheology_scenes import EYRING, GAP, SCENES, VISCOSITY, scene
from selection import quick

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

import contactkit as ck
from contactkit.fmu.native.film import moving, prepared_film
from contactkit.separation.effects.base import LimitKind

KINK = 1e-4  # of a force next to the kink of a power law, whose integral is 1e-5 off itself


@pytest.fixture(scope="module")
def tables():
    """Tables of the scenes and the films that they are of, made once each."""
    made = {}

    def of(name):
        if name not in made:
            made[name] = prepared_film(moving(SCENES[name], None))
        return made[name].tables, made[name].prepared.rheology.film.film

    return of


def kernel(probe, tables, folder, points, viscosity=VISCOSITY):
    """Viscous force, its slopes by gap and by speed, and the limit."""
    return probed(probe, tables, folder, points, (viscosity, 0.0, 0.0, 0.0))[2:]


def path(film, name):
    """Gaps and speeds, opening and closing, in a corridor about a force of 1 N at rest."""
    start = SCENES[name].loading.initial_gap
    gaps = np.geomspace(0.5 * start, 8.0 * start, 41).tolist()
    factors = (1e-4, 3.0, 0.1, 30.0, -0.1, -1.0, 300.0, -5.0)
    return [(h, factors[i % 8] / film.linear_force(h, 1.0)) for i, h in enumerate(gaps)]


@pytest.mark.parametrize("name", quick(SCENES, 0, 2, 3))
def test_forces_are_those_of_the_film(name, probe, tables, tmp_path):
    made, film = tables(name)
    points = path(film, name)
    force, by_gap, by_speed, limit = kernel(probe, made, tmp_path, points)
    expected = [film.bounded_force(*point) for point in points]
    rtol = KINK if name == "power law" else 1e-5
    np.testing.assert_allclose(force, expected, rtol=rtol)
    full = [film.force(*point) for point in points]
    is_cut = np.abs(full) > np.abs(expected) * (1.0 + 1e-4)
    assert set(limit[is_cut]) <= {LimitKind.TENSION}
    assert is_cut.any() == ("cut off" in name)
    step = 1e-5
    for i, (gap, speed) in enumerate(points):
        near = [(gap * (1.0 + s), speed) for s in (-step, step)]
        near += [(gap, speed * (1.0 + s)) for s in (-step, step)]
        values = kernel(probe, made, tmp_path, near)[0] if i % 4 == 0 else None
        if values is None or abs(film.shape.full_gap / gap - 1.0) < 1e-3:
            continue
        size = abs(force[i]) * 1e-6
        assert by_gap[i] * gap == pytest.approx((values[1] - values[0]) / (2.0 * step), abs=size)
        slope = (values[3] - values[2]) / (2.0 * step)
        assert by_speed[i] * speed == pytest.approx(slope, abs=size)


@pytest.mark.parametrize("name", ["carreau, drop", "eyring"])
def test_another_viscosity_at_rest_is_that_of_another_liquid(name, probe, tables, tmp_path):
    """Three times as thick, where the viscosity is a parameter of the FMU."""
    made, film = tables(name)
    points = path(film, name)
    force = kernel(probe, made, tmp_path, points, 3.0 * VISCOSITY)[0]
    shear = SCENES[name].meniscus.liquid.shear_viscosity
    thick = evolve(film, law=shear.flow_law(3.0 * VISCOSITY), viscosity=3.0 * VISCOSITY)
    np.testing.assert_allclose(force, [thick.force(*point) for point in points], rtol=1e-5)


def test_at_rest_and_slowly_a_film_is_newtonian(probe, tables, tmp_path):
    made, film = tables("carreau, drop")
    force, _, damping, _ = kernel(probe, made, tmp_path, [(GAP, 0.0), (GAP, 1e-12), (GAP, -1e-30)])
    rest = film.linear_force(GAP, 1.0)
    assert force.tolist() == pytest.approx([0.0, 1e-12 * rest, -1e-30 * rest], rel=1e-9)
    assert damping.tolist() == pytest.approx([rest] * 3, rel=1e-9)


def test_beyond_its_gaps_a_film_between_flats_is_known(probe, tables, tmp_path):
    """Its ratio is one of the rate of shear, whose unit is a power of the gap there."""
    made, film = tables("carreau, drop")
    points = [(1e-3 * GAP, 1e-9), (100.0 * GAP, 300.0)]
    force = kernel(probe, made, tmp_path, points)[0]
    expected = [film.force(*point) for point in points]
    assert film.linear_force(*points[1]) > 1.02 * expected[1]
    np.testing.assert_allclose(force, expected, rtol=1e-5)


@pytest.mark.slow
def test_beyond_its_pole_and_its_tables_a_force_is_no_number(probe, tables, tmp_path):
    made, film = tables("barus")
    alpha = 2e-8
    pole = GAP**3 / (3.0 * VISCOSITY * film.shape.rim**2 * alpha)
    points = [(GAP, -0.99 * pole), (GAP, -1.01 * pole), (GAP, 30.0), (GAP, 1e9)]
    force = kernel(probe, made, tmp_path, points)[0]
    assert [math.isfinite(one) for one in force] == [True, False, True, False]


def test_a_scene_that_says_nothing_of_its_rheology_has_all_of_it():
    """Also what the pull of the scene does not call for: in a host it may be any."""
    weak = ck.ImposedForce(force=0.01, mass=0.1, initial_gap=GAP, final_gap=5.0 * GAP)
    given = evolve(scene(ck.ViscousForce(), shear=EYRING), loading=weak)
    assert ck.plan(given).prepared.rheology.computed == ()
    (film,) = prepared_film(moving(given, None)).tables.films
    assert film.rheology is not None
