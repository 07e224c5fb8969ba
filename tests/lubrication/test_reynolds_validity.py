"""Ranges of validity of films on any face: what leaves one is a warning with value, limit, cure."""

from __future__ import annotations

import math
import warnings

import numpy as np
import pytest
from reynolds_cases import OIL, R

import contactkit as ck
from contactkit.errors import ValidityWarning
from contactkit.lubrication import reynolds

FACE = reynolds.rasterise(ck.Disc(radius=R), 48)
FILM = reynolds.GridFilm(face=FACE, viscosity=OIL)


def numbers(result):
    return {one.name: one for one in result.validity}


def warned(call):
    """Result of a call, and what it has warned of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = call()
    assert all(one.category is ValidityWarning for one in caught)
    return result, [str(one.message) for one in caught]


def test_a_film_far_below_vacuum_warns():
    """3 eta v R^2/h^3 in the middle: -478 bar passed without a word."""
    state, (said,) = warned(lambda: reynolds.solve_pressure(FILM, 5e-6, 2e-3))
    tension = 3.0 * OIL * 2e-3 * R**2 / 5e-6**3
    assert tension == pytest.approx(484e5, rel=1e-3)
    found = numbers(state)["tension over the strength of the liquid"]
    assert found.value == pytest.approx(tension / 101_325.0, rel=5e-3)
    assert "OUT OF RANGE; the liquid is at 48" in said
    assert (
        "bar below ambient, and would have cavitated at 1.01 bar; give the film a Tension" in said
    )
    still, nothing = warned(lambda: reynolds.solve_pressure(FILM, 5e-6, 1e-6))
    assert nothing == []
    assert all(one.is_valid is not False for one in still.validity)


def test_tension_of_a_film_with_a_cavity_is_at_most_its_strength():
    film = reynolds.GridFilm(face=FACE, viscosity=OIL, drop=1e5, tensile_strength=1e6)
    start = reynolds.at_rest(film, 5e-6)
    after, nothing = warned(lambda: reynolds.step_film(start, 5.1e-6, 1e-4))
    assert nothing == []
    assert 0.0 < numbers(after)["tension over the strength of the liquid"].value <= 1.0


def test_steps_warn_once():
    """Of a film in time each number, where it first leaves its range."""
    times = [0.0, 1e-5, 2e-5, 3e-5, 4e-5]
    states, said = warned(
        lambda: [*reynolds.follow_gap(FILM, lambda t: 5e-6 + 1e-3 * max(t - 1e-5, 0.0), times)]
    )
    assert len(said) == 1
    assert [all(one.is_valid is not False for one in s.validity) for s in states] == [
        True,
        False,
        False,
        False,
    ]


def test_slopes_are_those_of_the_map_and_no_steps():
    tilted, said = warned(
        lambda: reynolds.solve_pressure(FILM, reynolds.gap_map(FACE, 1e-3, tilt=(0.2, 0.0)))
    )
    found = numbers(tilted)["slope of the gap"]
    assert found.value == pytest.approx(0.2, rel=1e-9)
    assert any(one.startswith("slope of the gap = 0.2 (at most 0.1): OUT") for one in said)
    gentle = reynolds.gap_map(FACE, 1e-5, dome_radius=1.0)
    state = reynolds.solve_pressure(FILM, gentle)
    assert numbers(state)["slope of the gap"].value == pytest.approx(R, rel=0.1)  # r/R_c
    recess = ck.Recess(shape=ck.Disc(radius=0.5 * R), depth=2e-4)
    stepped, nothing = warned(
        lambda: reynolds.solve_pressure(FILM, reynolds.gap_map(FACE, 1e-5, recesses=[recess]))
    )
    assert numbers(stepped)["slope of the gap"].value == 0.0
    assert nothing == []


@pytest.mark.parametrize(
    ("gap", "name", "value"),
    [
        (1e-9, "thinnest gap over 2 nm", 0.5),
        (1e-3, "slenderness of the film", R / 1e-3),
    ],
)
def test_thin_and_thick_films(gap, name, value):
    state, (said,) = warned(lambda: reynolds.solve_pressure(FILM, gap))
    assert numbers(state)[name].value == pytest.approx(value, rel=0.05)
    assert said.startswith(f"{name} = ")


def test_a_coarse_grid():
    coarse = reynolds.GridFilm(face=reynolds.rasterise(ck.Disc(radius=R), 12), viscosity=OIL)
    state, (said,) = warned(lambda: reynolds.solve_pressure(coarse, 1e-5, 1e-6))
    assert said.startswith("cells across the film = ")
    right = 1.5 * math.pi * OIL * 1e-6 * R**4 / 1e-15
    assert abs(state.force / right - 1.0) > 5e-3  # and rightly so


def test_inertia_needs_a_density():
    """Of a disc the mean flow at the rim is v R/(2 h): rho v h/(4 eta) with its width 2 R."""
    plain = numbers(reynolds.solve_pressure(FILM, 1e-4, 1e-3))["Reynolds number"]
    assert plain.value is None
    assert "density [kg/m3] is not given" in str(plain)
    heavy = reynolds.GridFilm(face=FACE, viscosity=1e-3, density=1000.0)
    state, said = warned(lambda: reynolds.solve_pressure(heavy, 2e-4, 0.1))
    assert numbers(state)["Reynolds number"].value == pytest.approx(0.25 * 20.0, rel=0.05)
    assert any(one.startswith("Reynolds number = ") and "inertia" in one for one in said)


def test_a_law_has_its_numbers_at_a_gap_and_a_speed():
    law = reynolds.disc_damping(R)
    tension, slender, inertia = law.validity(5e-6, 2e-3, OIL, strength=1e7, density=880.0)
    assert tension.value == pytest.approx(4.84, rel=1e-3)
    assert slender.value == pytest.approx(R / 5e-6, rel=1e-12)
    assert inertia.value == pytest.approx(880.0 * 2e-3 * 5e-6 / OIL, rel=1e-12)
    assert law.validity(5e-6, -1.0, OIL)[0].value == 0.0  # pressed, not drawn


def test_rough_gaps():
    heights = np.cos(2.0 * np.pi * np.arange(64) / 64) * np.ones((64, 1))
    open_gap, nothing = warned(lambda: reynolds.flow_factors(2.0 + heights))
    assert nothing == []
    assert open_gap.validity[0].value == pytest.approx(2.0 * math.sqrt(2.0), rel=1e-12)
    _, (said,) = warned(lambda: reynolds.flow_factors(heights - 0.1))
    assert said.startswith("mean gap over rms roughness = ")
    even = reynolds.flow_factors(np.ones((4, 4))).validity[0]
    assert even.value is None
    assert even.is_valid is None
    flow = reynolds.leakage(np.full((16, 32), 1e-6), 1e-5, viscosity=OIL, pressure_drop=1e5)
    assert numbers(flow)["thinnest gap over 2 nm"].value == pytest.approx(500.0)
    blocked = reynolds.leakage(np.zeros((4, 4)), viscosity=OIL, pressure_drop=1.0)
    assert blocked.validity == ()
