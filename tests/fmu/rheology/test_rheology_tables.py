"""Tables of ratios of forces: splines, units, poles, and what a viscosity at rest scales."""

from __future__ import annotations

import math

import numpy as np
import pytest
from rheology_scenes import BARUS, CARREAU, EYRING, POWER_LAW, RADIUS, ROELANDS, VISCOSITY, scene
from scipy.interpolate import BSpline

from contactkit.errors import ConvergenceError
from contactkit.fmu.native.ratios import Axes, Units, ratio
from contactkit.fmu.native.records import Scaling
from contactkit.fmu.native.rheology import rheological_film, rheology_record, scaling_of
from contactkit.separation.effects.prepared import prepare_scene
from contactkit.separation.rheology.prepared_film import PreparedFilm

GAPS = (1e-6, 1e-5)


def value(made, gap, speed):
    """Value of a table, as its members say it is."""
    y, x = math.log(gap), math.log(speed)
    piece = made.unit.pieces[0]
    x += float(np.interp(y, piece.x, piece.y))  # of units that are powers of the gap
    if made.has_pole:
        x -= math.log1p(-math.exp(x))
    grid = np.reshape(made.coefficient, (made.gaps, made.speeds))
    for first, per, place in (
        (made.first_gap, made.per_gap, y),
        (made.first_speed, made.per_speed, x),
    ):
        knots = first + np.arange(-5, grid.shape[0] + 1) / per
        grid = BSpline(knots, grid, 5)(place)
    return float(grid)


def logarithm(gap, speed):
    """Of a liquid that thins, with a unit of the speed that is the square of the gap."""
    return -0.25 * np.log1p((speed / gap**2 * 1e-6) ** 2) * (1.0 + 0.1 * np.log(gap / 1e-6))


SQUARE = Units(lambda gaps: 2.0 * np.log(gaps))


def test_a_table_is_its_function_between_its_nodes():
    made = ratio(logarithm, SQUARE, Axes(GAPS, (0.0, 25.0), 2.0))
    random = np.random.default_rng(3)
    for _ in range(200):
        gap = math.exp(random.uniform(*np.log(GAPS)))
        speed = gap**2 * math.exp(random.uniform(0.0, 25.0))
        assert value(made, gap, speed) == pytest.approx(logarithm(gap, speed), abs=2e-6)


def test_it_is_exact_for_polynomials_of_degree_five():
    def function(gap, speed):
        y, x = np.log(gap / 1e-6), np.log(speed / gap**2)
        return (1.0 + y - 0.3 * y**5) * (x - 0.02 * x**5)

    made = ratio(function, SQUARE, Axes(GAPS, (-1.0, 1.0), 1.0))
    assert (made.gaps, made.speeds) == (10, 12)
    assert value(made, 3.3e-6, 2e-11) == pytest.approx(function(3.3e-6, 2e-11), rel=1e-11)


def test_a_pole_is_smooth_in_its_variable():
    """Of Barus' law between flats: (1 - r) ln(1 - r), whose slope has no bound."""

    def function(gap, speed):
        r = speed / gap**2
        return (1.0 - r) * np.log1p(-r) + r

    made = ratio(function, Units(SQUARE.logarithm, True), Axes(GAPS, (-8.0, 7.0), 1.0))
    for r in (1e-3, 0.3, 0.9, 0.999):
        speed = r * 3e-6**2
        assert value(made, 3e-6, speed) == pytest.approx(function(3e-6, speed), abs=2e-6)


def test_a_jump_is_refused():
    with pytest.raises(ConvergenceError, match="too rough for a table"):
        ratio(
            lambda gap, speed: np.where(speed > 3.3 * gap**2, 1.0, 0.0),
            SQUARE,
            Axes(GAPS, (0.0, 5.0), 1.0),
        )


def film(**liquid):
    return rheological_film(prepare_scene(scene(**liquid)))


@pytest.mark.parametrize(
    ("scaling", "liquid"),
    [
        (Scaling.SPEED, {"shear": CARREAU}),
        (Scaling.SPEED, {"shear": POWER_LAW}),
        (Scaling.STRESS, {"shear": EYRING}),
        (Scaling.STRESS, {"pressure": BARUS}),
        (Scaling.STRESS, {"pressure": BARUS, "shear": EYRING}),
        (Scaling.NONE, {"pressure": ROELANDS}),
        (Scaling.NONE, {"pressure": BARUS, "shear": CARREAU}),
    ],
)
def test_what_a_film_of_another_viscosity_is_a_function_of(scaling, liquid, monkeypatch):
    """The ratio of the forces of a liquid three times as thick, at the same speed or stress."""
    one, speed = film(**liquid), -1e-3
    assert scaling_of(one) is scaling
    monkeypatch.setattr("rheology_scenes.VISCOSITY", 3.0 * VISCOSITY)
    thick = film(**liquid)

    def of(film, speed):
        return film.force(5e-6, speed) / film.linear_force(5e-6, speed)

    is_same = {
        Scaling.SPEED: of(thick, speed) == pytest.approx(of(one, speed), rel=1e-9),
        Scaling.STRESS: of(thick, speed / 3.0) == pytest.approx(of(one, speed), rel=1e-9),
    }
    assert [one for one, same in is_same.items() if same] == [scaling] * (
        scaling is not Scaling.NONE
    )


def test_a_closing_film_ends_at_the_pole_of_its_law():
    """Barus' transformation: where the pressure at a constant viscosity would be 1/alpha."""
    one = film(pressure=BARUS)
    made = rheology_record(PreparedFilm(one, (1e-6, 1e-5), 1e6), (1e-6, 1e-5), 2e-5)
    (stretch,) = made.stretches
    gap, alpha = 3e-6, BARUS.pressure_coefficient
    pole = gap**3 / (3.0 * VISCOSITY * RADIUS**2 * alpha)
    piece = stretch.closing.unit.pieces[0]
    assert math.exp(-np.interp(math.log(gap), piece.x, piece.y)) == pytest.approx(pole, rel=1e-4)
    for r in (0.1, 0.9, 0.99):  # 2 ((1 - r) ln(1 - r) + r)/r^2 of the force at rest
        exact = math.log(2.0 * ((1.0 - r) * math.log1p(-r) + r) / r**2)
        assert value(stretch.closing, gap, r * pole) == pytest.approx(exact, abs=1e-4)
        opening = math.log(2.0 * ((1.0 + r) * math.log1p(r) - r) / r**2)
        assert value(stretch.opening, gap, r * pole) == pytest.approx(opening, abs=1e-6)
