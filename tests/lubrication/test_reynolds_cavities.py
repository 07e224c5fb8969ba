"""Cavities with memory: exact edges, journal bearings, conserved liquid, work, and hard cases."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from reynolds_cases import (
    CASES,
    OIL,
    R,
    inputs,
    quarter_disc,
    reference,
    strip,
)

import contactkit as ck
from contactkit.lubrication import reynolds
from contactkit.lubrication.reynolds import complementarity

# Their tensions and grids are chosen for the numbers, not for a liquid.
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

DISC = ck.Disc(radius=R)


def gained(before, after):
    """Error of the volume balance of a step, over the liquid."""
    change = after.liquid_volume - before.liquid_volume
    return abs(change - (after.time - before.time) * after.inflow) / before.liquid_volume


# Exact edges ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "cells", "error"),
    [
        ("disc_expanding_3", 64, 5e-4),
        ("disc_expanding_1000", 64, 6e-3),
        pytest.param("disc_expanding_3", 256, 3e-5, marks=pytest.mark.slow),
        pytest.param("disc_expanding_1000", 256, 5e-4, marks=pytest.mark.slow),
    ],
)
def test_a_first_opening(name, cells, error):
    """While it grows, the cavity of a step is that of Swift and Stieber, and exact to 2nd order."""
    given = inputs(name)
    film = reynolds.GridFilm(
        face=reynolds.rasterise(DISC, cells), viscosity=OIL, drop=given["tension"]
    )
    gap, speed, dt = given["gap"], given["opening_speed"], 1e-12
    before = reynolds.at_rest(film, gap)
    after = reynolds.step_film(before, gap + speed * dt, dt)
    assert abs(after.force / reference(name, "pull") - 1.0) < error
    radius = math.sqrt(after.cavity_area / math.pi)
    assert abs(radius - reference(name, "cavity_radius")) < 1.5 * R / cells
    at_once = reynolds.solve_pressure(film, gap, speed)
    assert at_once.force == pytest.approx(after.force, rel=2e-6)
    assert gained(before, after) < 1e-13
    assert after.iterations <= 9


@pytest.mark.parametrize(("cells", "steps", "error"), [(66, 128, 0.03), (130, 256, 0.015)])
def test_an_oscillating_strip(cells, steps, error):
    """Rupture, turn and reformation; the error is one cell at the edge (first order)."""
    face, width = strip(1.0, cells, pressure=0.025)
    film = reynolds.GridFilm(face=face, viscosity=1.0 / 12.0, ambient=0.025, drop=0.025)

    def gap(t):
        return 0.125 * math.cos(4.0 * math.pi * t) + 0.375

    times = 0.25 + 0.5 / steps * np.arange(steps)
    before, force, half, worst = reynolds.at_rest(film, gap(0.25)), [], [], 0.0
    before = reynolds.step_film(before, gap(0.25), 0.25)  # at the time 0.25
    for state in reynolds.follow_gap(film, gap, list(times), start=before):
        force.append(state.force / width)
        half.append(0.5 * state.cavity_area / width)
        worst = max(worst, gained(before, state)) if before.time == state.time - 0.5 / steps else 0
        assert state.iterations <= 9
        before = state
    values = CASES["oscillating_strip_1"]["values"]
    assert worst < 1e-13
    found = np.interp(values["t"], times[1:], force)[:-1]  # the last is in the collapse
    assert np.abs(found / np.array(values["pull"])[:-1] - 1.0).max() < error
    edge = np.interp(values["t"], times[1:], half)
    assert np.abs(edge - values["half_width"]).max() < 1.0 / cells
    full = next(t for t, x in zip(times[1:], half, strict=True) if x == 0.0 and t > 0.3)
    assert full == pytest.approx(values["t_full_again"], abs=2.0 / steps)


@pytest.mark.slow
def test_an_oscillating_disc():
    face = quarter_disc(5e-3, 64, pressure=1e5)
    film = reynolds.GridFilm(face=face, viscosity=0.05, ambient=1e5, drop=1e5)

    def gap(t):
        return 2e-5 - 1e-5 * math.cos(100.0 * math.pi * t)

    times = list(np.linspace(0.0, 0.0135, 301))
    states = [(4.0 * s.force, s.cavity_area) for s in reynolds.follow_gap(film, gap, times)]
    values = CASES["oscillating_disc_0.005"]["values"]
    force = np.interp(values["t"][:-1], times[1:], [f for f, _ in states])
    radius = np.interp(
        values["t"][:-1], times[1:], [math.sqrt(4.0 * a / math.pi) for _, a in states]
    )
    assert np.abs(force / values["pull"][:-1] - 1.0).max() < 5e-3
    assert np.abs(radius / values["cavity_radius"][:-1] - 1.0).max() < 1e-2


def test_a_disc_refills_at_rest_and_collapses_to_a_point():
    name = "disc_refill_0.1_0.9_1e+06"
    given, values = inputs(name), CASES[name]["values"]
    face = quarter_disc(R, 32)
    film = reynolds.GridFilm(face=face, viscosity=OIL, drop=given["tension"])
    cavitated = np.hypot(face.x, face.y) < given["cavity_radius"]
    fraction = np.where(cavitated, given["gap_at_rupture"] / given["gap"], 1.0)
    start = reynolds.at_rest(film, given["gap"], fraction)
    times = list(np.linspace(0.0, 1.02 * values["t_full"], 61))
    states = list(reynolds.follow_gap(film, lambda t: given["gap"], times, start=start))
    depth = given["gap"] - given["gap_at_rupture"]
    void = np.interp(values["t_at_radius"], times[1:], [4.0 * s.void_volume for s in states])
    exact = math.pi * np.array(values["cavity_radius"]) ** 2 * depth
    assert np.abs(void / exact - 1.0).max() < 6e-3
    full = next(s.time for s in states if s.void_volume == 0.0)
    assert full == pytest.approx(values["t_full"], rel=2e-2)
    assert max(gained(a, b) for a, b in pairwise([start, *states])) < 1e-13
    at_start = 4.0 * reynolds.step_film(start, given["gap"], 1e-9).force
    assert at_start == pytest.approx(values["pull_at_start"], rel=2e-2)


@pytest.mark.parametrize("name", ["journal_long_0.6_200000", "journal_long_0.9_0"])
@pytest.mark.parametrize(("cells", "error"), [(130, 7e-3), (1026, 2e-4)])
def test_long_journal_bearings(name, cells, error):
    given, values = inputs(name), CASES[name]["values"]
    face, width = strip(2.0 * math.pi * given["radius"], cells, pressure=given["p_groove"])
    turn = face.x / given["radius"]
    gap = given["clearance"] * (1.0 + given["eccentricity"] * np.cos(turn))
    film = reynolds.GridFilm(face=face, viscosity=given["viscosity"], drop=0.0)
    state = reynolds.steady_film(film, gap, lower_velocity=(given["wall_speed"], 0.0))
    p = np.where(face.inside, state.pressure, 0.0)
    along = -float((p * np.cos(turn)).sum()) * face.cell_area / width
    across = float((p * np.sin(turn)).sum()) * face.cell_area / width
    assert math.hypot(along, across) == pytest.approx(values["load_per_length"], rel=error)
    attitude = math.degrees(math.atan2(across, along))
    assert attitude == pytest.approx(values["attitude_deg"], abs=0.1)
    void = np.degrees(turn[state.liquid_fraction < 1.0])
    assert void[0] == pytest.approx(values["rupture_deg"], abs=720.0 / cells)
    assert void[-1] == pytest.approx(values["reformation_deg"], abs=720.0 / cells)
    assert state.liquid_fraction.min() == pytest.approx(values["theta_min"], rel=1e-2)
    assert abs(state.inflow) < 1e-11 * values["flux_per_width"] * width
    assert state.iterations <= 9


# Two pressures --------------------------------------------------------------------------------


def test_a_strong_liquid_holds_a_cavity_of_its_own_pressure():
    face = quarter_disc(R, 24)
    film = reynolds.GridFilm(face=face, viscosity=OIL, drop=1e5, tensile_strength=1e6)
    weak = reynolds.GridFilm(face=face, viscosity=OIL, drop=1e5)
    start = reynolds.at_rest(film, 5e-6)
    onset = 1e6 * 5e-6**3 / (3.0 * OIL * R**2)  # speed at which the centre has 10 bar of tension
    intact = reynolds.step_film(start, 5e-6 + 0.9 * onset * 1e-9, 1e-9)
    assert intact.pressure.min() < -8e5
    assert not intact.beside_cavity.any()
    cavitated = reynolds.step_film(intact, intact.gap + 1.3 * onset * 1e-9, 1e-9)
    assert cavitated.pressure.min() == -1e5
    assert cavitated.beside_cavity[face.inside].all()
    assert cavitated.force < 0.3 * intact.force
    same = reynolds.step_film(
        reynolds.at_rest(weak, intact.gap), intact.gap + 1.3 * onset * 1e-9, 1e-9
    )
    assert cavitated.force == pytest.approx(same.force, rel=1e-9)
    # The floor stays that of the cavity until the film is full again, then it is intact.
    closed = reynolds.step_film(cavitated, cavitated.gap - 3.0 * onset * 1e-9, 1e-9)
    assert not closed.beside_cavity.any()
    again = reynolds.step_film(closed, closed.gap + 0.9 * onset * 1e-9, 1e-9)
    assert again.pressure.min() < -8e5


def test_strength_zero_and_infinite():
    face = quarter_disc(R, 24)
    none = reynolds.GridFilm(face=face, viscosity=OIL, drop=0.0)
    cavitated = reynolds.step_film(reynolds.at_rest(none, 5e-6), 6e-6, 1e-6)
    assert cavitated.force == 0.0
    assert (cavitated.liquid_fraction[face.inside] < 1.0).all()  # all cavitated
    assert cavitated.liquid_fraction[0, 0] == pytest.approx(5.0 / 6.0, rel=1e-12)
    again = reynolds.step_film(cavitated, 7e-6, 1e-6)
    assert again.liquid_fraction[0, 0] == pytest.approx(5.0 / 7.0, rel=1e-12)
    closed = reynolds.step_film(again, 4.9e-6, 1e-6)
    assert (closed.liquid_fraction == 1.0).all()
    for strength, drop in ((math.inf, 1e5), (None, math.inf), (1e12, 1e5)):
        film = reynolds.GridFilm(face=face, viscosity=OIL, drop=drop, tensile_strength=strength)
        state = reynolds.step_film(reynolds.at_rest(film, 5e-6), 6e-6, 1e-3)
        exact = 0.25 * 1.5 * math.pi * OIL * R**4 * 1e-3 / 6e-6**3
        assert state.force == pytest.approx(exact, rel=1e-3)
        assert not state.beside_cavity.any()


# Memory, work, iterations ---------------------------------------------------------------------


def test_a_closing_face_meets_no_full_film_above_the_gap_of_rupture():
    """Of a film that ruptured at h_b nothing is felt until the gap is nearly h_b again."""
    face = quarter_disc(R, 24)
    film = reynolds.GridFilm(face=face, viscosity=OIL, drop=1e5)
    start = reynolds.at_rest(film, 5e-6, np.where(face.inside, 1.0, 1.0))
    gaps = [5e-6 * (1.0 + 0.2 * k) for k in range(1, 11)]
    state = start
    for gap in gaps:
        state = reynolds.step_film(state, gap, 1e-6)
    held = state.force
    assert held > 0.0
    squeezed = {}
    for gap in gaps[::-1][1:]:
        state = reynolds.step_film(state, gap, 1e-6)
        squeezed[round(gap * 1e6, 3)] = state.force
    assert min(squeezed.values()) > 0.5 * held
    squeezed = reynolds.step_film(state, 4.8e-6, 1e-6)
    assert squeezed.void_volume == 0.0
    assert squeezed.force < -100.0 * held


def test_work_is_dissipated_or_stored_in_the_cavity():
    """While the cavity grows the balance holds to round-off; over a cycle to first order."""
    face = quarter_disc(R, 24)
    film = reynolds.GridFilm(face=face, viscosity=OIL, drop=1e6)
    errors = {}
    for steps in (50, 200):
        period = 4e-4
        times = list(np.linspace(0.0, 0.75 * period, steps + 1))

        def gap(t, period=period):
            return 1e-5 - 5e-6 * math.cos(2.0 * math.pi * t / period)

        work = lost = 0.0
        before, errors[steps], growing = gap(0.0), 0.0, 0.0
        for state in reynolds.follow_gap(film, gap, times):
            dt = times[1]
            work += state.force * (gap(state.time) - before)
            lost += state.dissipation * dt
            error = abs(work - lost - 1e6 * state.void_volume) / work
            growing = error if state.time < 0.15 * period else growing
            errors[steps] = error
            before = gap(state.time)
        assert growing < 1e-9
    assert errors[200] < 0.4 * errors[50] < 0.02


@pytest.mark.parametrize("cells", [34, 66, 130, 258, 514, 1026])
def test_newton_steps_do_not_grow_with_the_grid(cells):
    """Onset of a cavity over most of a strip, and its collapse within a step."""
    face, _ = strip(1.0, cells)
    film = reynolds.GridFilm(face=face, viscosity=1.0 / 12.0, drop=1.0)
    onset = reynolds.step_film(reynolds.at_rest(film, 1.0), 1.0 + 3e-5, 1e-6)
    assert 0.2 < onset.cavity_area / (face.inside.sum() * face.cell_area) < 0.9
    cavitated = np.where(np.abs(face.x - 0.5) < 0.45, 0.9, 1.0)
    collapse = reynolds.step_film(reynolds.at_rest(film, 1.0, cavitated), 0.89, 0.1)
    assert collapse.void_volume == 0.0
    partly = reynolds.step_film(reynolds.at_rest(film, 1.0, cavitated), 0.905, 5e-5)
    assert partly.void_volume > 0.0
    assert max(s.iterations for s in (onset, collapse, partly)) <= 9


def test_a_textured_slider_and_both_methods():
    """Dimples with cavities: the active set and Fischer-Burmeister have the same answer."""
    n = 48
    level = np.minimum(np.arange(n) - 0.5, n - 1.5 - np.arange(n))[None, :] * np.ones((n, 1))
    face = reynolds.face_from_level(level * 1e-5, 1e-5, periodic=(True, False))
    dimples = [
        ck.Recess(
            shape=ck.Disc(radius=4e-5, centre=((i + 0.5) * 1.2e-4, (j + 0.5) * 1.2e-4)),
            depth=3e-6,
        )
        for i in range(4)
        for j in range(4)
    ]
    gap = reynolds.gap_map(face, 2e-6, recesses=dimples)
    film = reynolds.GridFilm(face=face, viscosity=0.02, drop=1e5)
    state = reynolds.steady_film(film, gap, lower_velocity=(2.0, 0.0))
    assert 0.005 < 1.0 - state.liquid_fraction[face.inside].mean() < 0.3
    assert state.iterations <= 12
    solve = reynolds.solve
    problem = []
    make = solve._problem

    def kept(task):
        found = make(task)
        problem.append(found[1])
        return found

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(solve, "_problem", kept)
        reynolds.steady_film(film, gap, lower_velocity=(2.0, 0.0))
    zero = np.zeros(problem[0].drop.size)
    start = complementarity.Solution(zero, zero, 0, False)
    smooth = complementarity.solve_fischer_burmeister(problem[0], start)
    void = 1.0 - state.liquid_fraction[face.inside]
    assert np.abs(smooth.void - void).max() < 1e-8
    pressure = state.pressure[face.inside]
    assert np.abs(smooth.q - pressure).max() < 1e-7 * np.abs(pressure).max()


# Hard cases -----------------------------------------------------------------------------------


def test_a_cavity_begins_where_the_film_is_thinnest():
    """In the corner of a tilted square, and at the rim of a sliding pad whose gap diverges."""
    square = reynolds.rasterise(ck.Rectangle(length=1e-3, width=1e-3), 34)
    gap = reynolds.gap_map(square, 1e-5, tilt=(1.9e-2 / 2, 1.9e-2 / 2))
    film = reynolds.GridFilm(face=square, viscosity=OIL, drop=1e5)
    state = reynolds.step_film(reynolds.at_rest(film, gap), gap + 2e-12, 1e-9)
    row, column = np.unravel_index(np.argmin(state.liquid_fraction), gap.shape)
    assert row < 10
    assert column < 10
    assert 0.0 < state.cavity_area < 0.4e-6
    face, width = strip(1e-3, 66)
    gap = 1e-5 + 1e-2 * face.x
    film = reynolds.GridFilm(face=face, viscosity=OIL, drop=1.0)
    state = reynolds.steady_film(film, gap, lower_velocity=(1.0, 0.0))
    void = np.flatnonzero(state.liquid_fraction[0] < 1.0)
    assert void[0] == 1  # the first cell at the rim
    assert state.cavity_area > 0.9e-3 * width


def test_a_ring_of_cavity_closes():
    """Between the rim and a vent a ring cavitates, and closes again without losing liquid."""
    vented = ck.Ring(radius=R, hole_radius=0.3 * R)
    face = reynolds.rasterise(vented, 48)
    film = reynolds.GridFilm(face=face, viscosity=OIL, drop=1e5)
    before = reynolds.at_rest(film, 1e-5)
    cavitated = reynolds.step_film(before, 1.2e-5, 1e-4)
    radius = np.hypot(face.x, face.y)[cavitated.liquid_fraction < 1.0]
    assert 0.3 * R < radius.min() < 0.5 * R
    assert 0.7 * R < radius.max() < R
    states = [before, cavitated]
    for gap in (1.15e-5, 1.1e-5, 1.05e-5, 1e-5, 9.9e-6):
        states.append(reynolds.step_film(states[-1], gap, 1e-4))
    assert states[-1].void_volume == 0.0
    assert max(gained(a, b) for a, b in pairwise(states)) < 1e-13


def test_one_cell_cavitates_and_closes():
    face = reynolds.face_from_mask(np.pad(np.ones((1, 1), bool), 1), 1e-3)
    film = reynolds.GridFilm(face=face, viscosity=OIL, drop=1e5)
    cavitated = reynolds.step_film(reynolds.at_rest(film, 1e-6), 2e-6, 1e-9)
    assert cavitated.force == pytest.approx(0.1, rel=1e-12)
    assert cavitated.liquid_fraction[1, 1] == pytest.approx(0.5, rel=1e-3)
    closed = reynolds.step_film(cavitated, 0.9e-6, 1e-9)
    assert closed.liquid_fraction[1, 1] == 1.0
    assert closed.force < 0.0


def test_an_enclosed_film_needs_compressible_liquid():
    face = reynolds.face_from_mask(np.ones((4, 4), bool), 1e-3)
    film = reynolds.GridFilm(face=face, viscosity=OIL, compressibility=5e-10, drop=1e5)
    pressed = reynolds.step_film(reynolds.at_rest(film, 1e-5), 0.99e-5, 1e-6)
    assert pressed.pressure[1, 1] == pytest.approx(0.01 / 0.99 / 5e-10, rel=1e-6)
    cavitated = reynolds.step_film(reynolds.at_rest(film, 1e-5), 1.01e-5, 1e-6)
    assert cavitated.pressure[1, 1] == -1e5
    assert cavitated.liquid_fraction[1, 1] == pytest.approx(1.0 / 1.01, rel=1e-4)


@pytest.mark.slow
def test_a_thousand_cycles_do_not_drift():
    """Two cells and a viscosity that changes a million times: volumes stay what they were."""
    face = reynolds.face_from_mask(np.pad(np.ones((1, 2), bool), 1), 1e-4)
    state, after = None, []
    for cycle in range(1000):
        viscosity = 1e-3 if cycle % 2 else 1e3
        film = reynolds.GridFilm(face=face, viscosity=viscosity, drop=1e5)
        start = reynolds.at_rest(film, 1e-5, 1.0 if state is None else state.liquid_fraction)
        opened = reynolds.step_film(start, 1.5e-5, 1e-3)
        state = reynolds.step_film(opened, 1e-5, 1e-3)
        assert max(gained(start, opened), gained(opened, state)) < 1e-13 or cycle == 0
        after.append(state.liquid_volume)
    assert after[1] == pytest.approx(after[-1], rel=1e-12)
    assert after[0] == pytest.approx(after[-2], rel=1e-12)


def test_a_pocket_empties_and_fills_without_losing_liquid():
    """Its volume beyond the gap has the liquid fraction of the pocket, before and after a step."""
    pocket = reynolds.Pocket(
        shape=ck.Rectangle(length=0.4 * R, width=0.3 * R, angle=0.3), volume=1e-11
    )
    face = reynolds.rasterise(DISC, 24, holes=[pocket])
    film = reynolds.GridFilm(face=face, viscosity=OIL, drop=1e5)
    states = [reynolds.at_rest(film, 5e-6)]
    for gap in (6e-6, 8e-6, 1e-5, 9e-6, 7e-6, 6e-6, 5e-6, 4.9e-6):
        states.append(reynolds.step_film(states[-1], gap, 1e-5, lower_velocity=(0.5, 0.2)))
    held = [float(s.liquid_fraction[face.owner == 1].min()) for s in states]
    assert 0.0 < min(held) < 0.99
    assert held[-1] == 1.0
    assert max(gained(a, b) for a, b in pairwise(states)) < 1e-12
