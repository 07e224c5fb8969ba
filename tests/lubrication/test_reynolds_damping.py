"""Damping laws: closed forms against the solver and reference values, tables, rough gaps."""

from __future__ import annotations

import math

import numpy as np
import pytest
from refusals import each_refused
from reynolds_cases import (
    CASES,
    OIL,
    R,
    inputs,
    quarter_disc,
    reference,
    squeeze,
)
from scipy.integrate import quad

import contactkit as ck
from contactkit.errors import DescriptionError
from contactkit.lubrication import reynolds

# Their tensions and grids are chosen for the numbers, not for a liquid.
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

DISC = ck.Disc(radius=R)
LAWS = {
    "disc": reynolds.disc_damping(R),
    "annulus_vented_0.3": reynolds.ring_damping(R, 0.3 * R),
    "annulus_sealed_0.5": reynolds.ring_damping(R, 0.5 * R, is_sealed=True),
    "annulus_vented_0.01": reynolds.ring_damping(R, 0.01 * R),
    "rectangle_1": reynolds.rectangle_damping(4e-3, 4e-3),
    "rectangle_2": reynolds.rectangle_damping(4e-3, 8e-3),
    "rectangle_5": reynolds.rectangle_damping(20e-3, 4e-3),
    "ellipse_1.5": reynolds.ellipse_damping((R, R / 1.5)),
    "disc_recess_0.0015_4e-05": reynolds.recess_damping(R, 1.5e-3, 3e-5),
    "disc_dome_1.0": reynolds.dome_damping(R, 1.0),
}
FACES = {
    "disc": reynolds.rasterise(DISC, 64),
    "vented": reynolds.rasterise(ck.Ring(radius=R, hole_radius=0.3 * R), 64),
    "sealed": reynolds.rasterise(DISC, 64, holes=[reynolds.Pocket(shape=ck.Disc(radius=0.5 * R))]),
    "rectangle": reynolds.rasterise(ck.Rectangle(length=8e-3, width=4e-3), 64),
    "ellipse": reynolds.rasterise(ck.Ellipse(semi_axes=(R, R / 1.5)), 64),
    "triangle": reynolds.rasterise(ck.equilateral_triangle(4e-3), 64),
}
EXACT = {
    "disc": LAWS["disc"],
    "vented": LAWS["annulus_vented_0.3"],
    "sealed": LAWS["annulus_sealed_0.5"],
    "rectangle": LAWS["rectangle_2"],
    "ellipse": LAWS["ellipse_1.5"],
    "triangle": reynolds.triangle_damping(4e-3),
}


@pytest.mark.parametrize("name", LAWS)
def test_closed_forms(name):
    assert LAWS[name].force(1e-5, 1e-3, OIL) == pytest.approx(reference(name), rel=1e-12)


@pytest.mark.parametrize("name", FACES)
def test_the_solver_finds_the_closed_forms(name):
    """Force and onset; both have the error of the grid."""
    law, exact = reynolds.face_damping(FACES[name]), EXACT[name]
    assert law.coefficient(1e-5) == pytest.approx(exact.coefficient(1e-5), rel=6e-3)
    assert law.onset(1e-5) == pytest.approx(exact.onset(1e-5), rel=6e-3)
    assert law.area == pytest.approx(exact.area, rel=2e-2)


@pytest.mark.parametrize("name", LAWS)
def test_impulse_and_exponent_are_integral_and_slope(name):
    law = LAWS[name]
    by_quadrature = quad(law.coefficient, 4e-6, 3e-5, epsrel=1e-12)[0]
    assert law.impulse(4e-6, 3e-5) == pytest.approx(by_quadrature, rel=1e-11)
    assert law.impulse(3e-5, 4e-6) == pytest.approx(-by_quadrature, rel=1e-11)
    rest = law.impulse(4e-6, math.inf) - law.impulse(3e-5, math.inf)
    assert rest == pytest.approx(by_quadrature, rel=1e-9)
    slope = math.log(law.coefficient(1.001e-5) / law.coefficient(0.999e-5))
    slope /= math.log(0.999 / 1.001)
    assert law.exponent(1e-5) == pytest.approx(slope, rel=1e-5)


def test_recess_and_dome_meet_their_limits():
    shallow, disc = reynolds.recess_damping(R, 0.5 * R, 0.0), LAWS["disc"]
    assert shallow.coefficient(1e-5) == pytest.approx(disc.coefficient(1e-5), rel=1e-12)
    assert shallow.onset(1e-5) == pytest.approx(disc.onset(1e-5), rel=1e-12)
    deep, sealed = reynolds.recess_damping(R, 0.5 * R, 1.0), LAWS["annulus_sealed_0.5"]
    assert deep.coefficient(1e-5) == pytest.approx(sealed.coefficient(1e-5), rel=1e-12)
    flat = reynolds.dome_damping(R, 1e6)
    assert flat.coefficient(1e-5) == pytest.approx(disc.coefficient(1e-5), rel=1e-5)
    assert flat.onset(1e-5) == pytest.approx(disc.onset(1e-5), rel=1e-5)


HOLLOW = reynolds.dome_damping(R, -2.0)


@pytest.mark.parametrize("rim_gap", [1e-6, 1e-5, 1e-3])
def test_a_hollow_face_has_the_pressure_of_its_profile(rim_gap):
    """Reynolds' equation once integrated is p' = -6 eta v r/h^3; the rest by quadrature."""
    depth = R**2 / 4.0
    gap = rim_gap + depth

    def slope(r):
        return 6.0 * r / (gap - r**2 / 4.0) ** 3

    force = quad(lambda r: math.pi * r**2 * slope(r), 0.0, R, epsabs=0.0, epsrel=1e-12)[0]
    assert HOLLOW.coefficient(gap) == pytest.approx(force, rel=1e-9)
    assert HOLLOW.onset(gap) == pytest.approx(
        quad(slope, 0.0, R, epsabs=0.0, epsrel=1e-12)[0], rel=1e-9
    )
    for end in (1.0 + 1e-6, 1.3, 1e4):
        last = depth + end * rim_gap
        area = quad(
            lambda x: math.exp(x) * HOLLOW.coefficient(depth + math.exp(x)),
            math.log(rim_gap),
            math.log(end * rim_gap),
            epsabs=0.0,
            epsrel=1e-12,
        )[0]
        rounded = np.finfo(float).eps * gap / (last - gap)  # 1.8e-9 of 1e-12 m
        assert HOLLOW.impulse(gap, last) == pytest.approx(area, rel=1e-13 + 5.0 * rounded)
        assert HOLLOW.impulse(last, gap) == -HOLLOW.impulse(gap, last)
    by = 1e-6 * gap
    fall = math.log(HOLLOW.coefficient(gap - by) / HOLLOW.coefficient(gap + by))
    assert HOLLOW.exponent(gap) == pytest.approx(fall / math.log((gap + by) / (gap - by)), rel=1e-4)


def test_a_hollow_face_is_met_by_the_grid_and_ends_at_its_rim():
    face = quarter_disc(R, 65)
    gap = 1.2e-5 - (face.x**2 + face.y**2) / 4.0  # 2.5 um deep
    state = squeeze(face, np.maximum(gap, 5e-6))
    assert 4.0 * state.force == pytest.approx(HOLLOW.force(1.2e-5, 1e-3, OIL), rel=1e-3)
    far = HOLLOW.impulse(1e-5, math.inf)
    assert far == pytest.approx(HOLLOW.impulse(1e-5, 1e-2) + 0.5e4 * 1.5 * math.pi * R**4, rel=1e-3)
    shallow = reynolds.dome_damping(R, -1e6)
    assert shallow.impulse(1e-5, 2e-5) == pytest.approx(LAWS["disc"].impulse(1e-5, 2e-5), rel=1e-5)
    for ask in (HOLLOW.coefficient, HOLLOW.onset, HOLLOW.exponent):
        with pytest.raises(DescriptionError, match=r"gap must exceed 2\.52016e-06.*rim is closed"):
            ask(2.52e-6)
    with pytest.raises(DescriptionError, match="have the sign of curvature_radius"):
        reynolds.DomeDamping(area=1.0, curvature_radius=-1.0, rise=1e-6)
    with pytest.raises(DescriptionError, match="curvature_radius must be positive and finite"):
        reynolds.dome_damping(R, 0.0)


def test_a_table_of_a_dome():
    """The grid's error at the points; between and beyond them no more."""
    face = quarter_disc(R, 49)
    shape = (face.x**2 + face.y**2) / 2.0
    law = reynolds.tabulate_damping(face, (2e-6, 2e-4), shape, copies=4)
    exact = LAWS["disc_dome_1.0"]
    for gap in np.geomspace(2e-6, 2e-4, 50):
        assert law.coefficient(gap) == pytest.approx(exact.coefficient(gap), rel=4e-3)
        assert law.exponent(gap) == pytest.approx(exact.exponent(gap), rel=3e-3)
        assert law.onset(gap) == pytest.approx(exact.onset(gap), rel=2e-2)
    assert law.coefficient(1e-3) == pytest.approx(exact.coefficient(1e-3), rel=1e-3)
    assert law.coefficient(1e-6) == pytest.approx(exact.coefficient(1e-6), rel=0.1)
    assert law.impulse(2e-6, math.inf) == pytest.approx(exact.impulse(2e-6, math.inf), rel=4e-3)
    by_quadrature = quad(law.coefficient, 1e-6, 1e-3, epsrel=1e-10, limit=400)[0]
    assert law.impulse(1e-6, 1e-3) == pytest.approx(by_quadrature, rel=1e-8)


def test_interpolation_leaves_little():
    """Against a table with the points between."""
    face = quarter_disc(R, 25)
    shape = (face.x**2 + face.y**2) / 2.0
    coarse = reynolds.tabulate_damping(face, (2e-6, 2e-4), shape, points=24)
    fine = reynolds.tabulate_damping(face, (2e-6, 2e-4), shape, points=47)
    worst = max(
        abs(coarse.coefficient(h) / c - 1.0)
        for h, c in zip(fine.gaps, fine.coefficients, strict=True)
    )
    assert worst < 2e-5


def test_a_table_of_a_flat_is_a_power_law_everywhere():
    law = reynolds.tabulate_damping(FACES["disc"], (1e-6, 1e-4), points=3)
    flat = reynolds.face_damping(FACES["disc"])
    for gap in (1e-9, 3e-6, 1e-5, 1e-2):
        assert law.exponent(gap) == pytest.approx(3.0, rel=1e-9)
        assert law.coefficient(gap) == pytest.approx(flat.coefficient(gap), rel=1e-9)
        assert law.onset(gap) == pytest.approx(flat.onset(gap), rel=1e-9)


def test_onset_of_the_injector():
    """t_on of the reference: 10 bar at the centre, here as a speed at the first gap."""
    speed = reynolds.disc_damping(R).onset_speed(5e-6, 1e6, 0.1)
    film = reynolds.GridFilm(face=FACES["disc"], viscosity=0.1)
    assert reynolds.solve_pressure(film, 5e-6, speed).pressure.min() == pytest.approx(
        -1e6, rel=1e-3
    )
    # With the mass at 40 N the speed grows by F/m at first, and the cavity opens at t_on.
    on = CASES["pull_flooded_jfo_0.1"]["values"]["t_on"]
    damping = LAWS["disc"].coefficient(5e-6) * 0.1
    assert 40.0 / damping * -math.expm1(-on * damping / 0.02) == pytest.approx(speed, rel=0.02)


# Rough gaps -----------------------------------------------------------------------------------


def test_flow_factors_of_ridges_and_of_their_rotation():
    name = "strip_wave_0.8_8"
    wave = 1.0 + 0.8 * np.cos(2.0 * math.pi * (np.arange(256) + 0.5) / 256)
    gap = np.repeat(wave[None, :], 3, axis=0)
    across, along = reynolds.flow_factors(gap).factors
    assert across == pytest.approx(reference(name, "flow_factor_across"), rel=2e-3)
    assert along == pytest.approx(reference(name, "flow_factor_along"), rel=1e-9)
    turned = reynolds.flow_factors(gap.T, (1.0, 2.0)).factors
    assert turned == pytest.approx((along, across), rel=1e-9)


def test_flow_factors_lie_within_their_bounds():
    """Between the mean of the inverse cubes and that of the cubes, and symmetric."""
    gap = rough(48, 0.3)
    found = reynolds.flow_factors(gap)
    lower, upper = 1.0 / (gap**-3.0).mean(), (gap**3).mean()
    assert lower < found.conductivity[0, 0] < upper
    assert lower < found.conductivity[1, 1] < upper
    assert found.conductivity[0, 1] == pytest.approx(found.conductivity[1, 0], rel=1e-9)
    assert found.contact_fraction == 0.0


def test_contacts_block_the_flow():
    gap = rough(48, 0.3)
    touching = gap - np.quantile(gap, 0.2)
    found = reynolds.flow_factors(touching)
    assert found.contact_fraction == pytest.approx(0.2, abs=0.01)
    assert 0.0 < found.factors[0] < reynolds.flow_factors(gap).factors[0]
    wall = np.ones((8, 8))
    wall[:, 3] = 0.0
    assert reynolds.flow_factors(wall).factors == pytest.approx((0.0, 1.0 / (7 / 8) ** 2))
    closed = reynolds.leakage(wall, viscosity=1.0, pressure_drop=1.0)
    assert closed.flow == 0.0
    assert not closed.carries.any()
    beside = reynolds.leakage(wall, viscosity=1.0 / 12.0, pressure_drop=1.0, axis=0)
    assert beside.flow == pytest.approx(7.0 / 8.0, rel=1e-12)
    assert np.array_equal(beside.carries, wall > 0.0)
    assert reynolds.flow_factors(np.zeros((4, 4))).factors[0] == 0.0


def test_leakage_and_flow_factors_agree_for_long_ways():
    """Two periods after each other leak half as much, but for their ends."""
    gap = rough(32, 0.2)
    conductivity = reynolds.flow_factors(gap).conductivity[0, 0]
    wide = np.tile(gap, (1, 6))
    found = reynolds.leakage(wide, viscosity=1.0 / 12.0, pressure_drop=6.0)
    assert found.flow == pytest.approx(conductivity, rel=2e-2)


def test_leakage_does_not_depend_on_its_direction():
    gap = rough(40, 0.3) - 0.4
    forward = reynolds.leakage(gap, viscosity=1.0, pressure_drop=1.0).flow
    backward = reynolds.leakage(gap, viscosity=1.0, pressure_drop=-1.0).flow
    turned = reynolds.leakage(gap.T, viscosity=1.0, pressure_drop=1.0, axis=0).flow
    assert backward == pytest.approx(-forward, rel=1e-9)
    assert turned == pytest.approx(forward, rel=1e-9)


def test_a_rough_flat_by_its_map_and_by_flow_factors():
    """Ridges across a square, as a map and as a patch: the same law but for the rim."""
    face = reynolds.rasterise(ck.Rectangle(length=4e-3, width=4e-3), 130)
    wave = 2e-6 * np.cos(2.0 * math.pi * (np.arange(8) + 0.5) / 8)
    heights = np.zeros(face.shape)
    heights[:, 1:-1] = np.tile(wave, 16)[None, :]
    by_map = reynolds.tabulate_damping(face, (4e-6, 4e-5), -heights, points=4)
    by_patch = reynolds.rough_damping(
        face, (4e-6, 4e-5), np.repeat(wave[None, :], 2, axis=0), face.pixel_size[1], points=4
    )
    for gap in by_map.gaps:
        assert by_patch.coefficient(gap) == pytest.approx(by_map.coefficient(gap), rel=2e-2)
    smooth = reynolds.face_damping(face)
    assert by_patch.coefficient(4e-6) > 1.1 * smooth.coefficient(4e-6)
    assert by_patch.coefficient(1e-3) == pytest.approx(smooth.coefficient(1e-3), rel=1e-2)


def rough(n, deviation, seed=3):
    """A gap of unit mean with waves of 8 cells and longer."""
    k = np.hypot(np.fft.fftfreq(n, 1.0 / n)[:, None], np.fft.rfftfreq(n, 1.0 / n))
    noise = np.fft.rfft2(np.random.default_rng(seed).standard_normal((n, n)))
    heights = np.fft.irfft2(np.where((k > 0.0) & (k <= n / 8.0), noise, 0.0), s=(n, n))
    return 1.0 + deviation * np.clip(heights / heights.std(), -3.0, 3.0)


REFUSED = [
    (lambda: reynolds.disc_damping(0.0), "disc_damping.radius must be positive"),
    (lambda: reynolds.ring_damping(1.0, 1.0), "smaller than the radius"),
    (lambda: LAWS["disc"].coefficient(0.0), "gap must be positive"),
    (lambda: LAWS["disc"].impulse(-1e-6, 1e-6), "gap must be positive"),
    (lambda: reynolds.tabulate_damping(FACES["disc"], (1e-5, 1e-6)), "ascend"),
    (lambda: reynolds.tabulate_damping(FACES["disc"], (1e-6, 1e-5), -1e-5), "leave a film"),
    (lambda: reynolds.flow_factors(np.ones(4)), "map of two dimensions"),
    (lambda: reynolds.leakage(np.ones((2, 2)), viscosity=1.0, pressure_drop=1.0, axis=2), "0 or 1"),
    (
        lambda: reynolds.face_damping(
            reynolds.rasterise(
                DISC, 32, holes=[reynolds.Hole(shape=ck.Disc(radius=1e-3), pressure=1e5)]
            )
        ),
        "same in all reservoirs",
    ),
]


test_bad_input_is_refused = each_refused(REFUSED)


def test_the_case_of_the_recess_is_met_by_the_grid():
    name = "disc_recess_0.0015_4e-05"
    given = inputs(name)
    face = quarter_disc(R, 49)
    hole = ck.Disc(radius=given["recess_radius"])
    gap = reynolds.gap_map(face, 1e-5, recesses=[ck.Recess(shape=hole, depth=3e-5)])
    assert 4.0 * squeeze(face, gap).force == pytest.approx(reference(name), rel=3e-3)
