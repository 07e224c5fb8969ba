"""Flat-ended punches: the rigid punch of Boussinesq, and a plastic one that is Love's patch."""

from __future__ import annotations

import math

import loadings
import numpy as np
import pytest

import contactkit as ck
from contactkit.reference import flat_punch, love_patch

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

NU = 0.3
UNIT = ck.Material(young_modulus=1.0 - NU**2, poisson_ratio=NU)  # E* = 1 [Pa]
LOAD = 1e-3


def distance(n_pixels, pixel):
    x = (np.arange(n_pixels) - n_pixels // 2) * pixel
    return np.hypot(x[:, None], x[None, :])


def punch(cells, solid=UNIT, **loading):
    """A punch of radius 1, `cells` pixels to the radius, in a window of 2.5 radii."""
    grid, pixel = int(2.5 * cells), 1.0 / cells
    on = distance(grid, pixel) <= 1.0
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Heights(heights=np.where(on, 0.0, -1.0), pixel_size=pixel)),
        ),
        window=ck.Window(periodic=False),
        loading=loadings.pressed(**loading),
        effects=(ck.HalfSpace(),),
    )
    return ck.solve(ck.plan(scene)), on


def order(sizes, errors):
    return float(np.polyfit(np.log(sizes), np.log(np.abs(errors)), 1)[0])


def test_a_rigid_punch_converges_with_first_order():
    """The pressure is singular at the rim: first order is what equal pixels can do."""
    cells = np.array([12, 16, 24, 32, 48, 64, 96])
    depths, centres = [], []
    for n in cells:
        run, on = punch(int(n), force=LOAD)
        middle = run.pressure[run.plan.grid.shape[0] // 2, run.plan.grid.shape[1] // 2]
        depths.append(run.approach / flat_punch.approach(LOAD, 1.0, 1.0) - 1.0)
        centres.append(middle / flat_punch.pressure(0.0, LOAD, 1.0) - 1.0)
        np.testing.assert_array_equal(run.contact, on)
    assert abs(depths[-1]) < 2e-3
    assert abs(centres[-1]) < 4e-3
    assert order(1.0 / cells, depths) > 0.85
    assert order(1.0 / cells, centres) > 0.85


def test_the_pressure_under_a_punch_rises_to_the_rim_and_the_surface_dips_around_it():
    run, _ = punch(64, force=LOAD)
    r = distance(run.plan.grid.shape[0], 1.0 / 64)
    inner, outer = r < 0.8, r > 1.1
    wanted = flat_punch.pressure(r, LOAD, 1.0)
    np.testing.assert_allclose(run.pressure[inner], wanted[inner], rtol=1.5e-2)
    moved = flat_punch.surface_displacement(r, LOAD, 1.0, 1.0)
    np.testing.assert_allclose(run.displacement[outer], moved[outer], rtol=7e-3)
    np.testing.assert_allclose(run.displacement[r < 0.95], run.approach, rtol=1e-6)
    assert run.pressure.max() > 3.0 * wanted[r == 0.0][0]


def test_the_load_of_an_imposed_approach_is_that_of_boussinesq():
    depth = flat_punch.approach(LOAD, 1.0, 1.0)
    run, _ = punch(48, approach=depth)
    assert run.approach == pytest.approx(depth, rel=1e-12)
    assert run.load == pytest.approx(LOAD, rel=5e-3)
    back, _ = punch(48, force=run.load)
    assert back.approach == pytest.approx(depth, rel=1e-7)


@pytest.mark.parametrize(("ny", "nx", "dy", "dx"), [(8, 8, 1.0, 1.0), (6, 14, 1.5, 0.5)])
def test_a_punch_on_the_point_of_yielding_is_the_patch_of_love(ny, nx, dy, dx):
    """At H*A of its area the pressure is H all over, and the solid moves as Love says."""
    hardness, margin = 1e-3, 12
    shape = (ny + 2 * margin, nx + 2 * margin)
    heights = np.full(shape, -1.0)
    heights[margin : margin + ny, margin : margin + nx] = 0.0
    fraction = ny * nx / (shape[0] * shape[1])
    pressure = hardness * fraction * (1.0 - 1e-9)
    run = ck.press(heights, (dy, dx), UNIT, pressure, hardness=hardness, periodic=False)
    pressed = heights == 0.0
    np.testing.assert_allclose(run.pressure[pressed], hardness, rtol=1e-6)
    assert not run.pressure[~pressed].any()
    # The corners are singular in the elastic solution and yield first; a few pixels need not.
    assert run.plastic_area == pytest.approx(ny * nx * dy * dx, rel=0.1)
    # The engine gives the displacement of the middle of a pixel or the mean over one; both are
    # Love's to the curvature over one pixel, which falls like the square of the distance.
    y0, x0 = margin + 0.5 * (ny - 1), margin + 0.5 * (nx - 1)
    places = [(0, 0), (shape[0] - 1, 3), (margin - 6, margin + nx + 5), (margin + 2, margin + 3)]
    for row, column in places:
        love = love_patch.displacement(
            (column - x0) * dx, (row - y0) * dy, 0.5 * nx * dx, 0.5 * ny * dy, 1.0
        )
        assert run.displacement[row, column] == pytest.approx(hardness * love, rel=2e-3)
    assert math.isclose(run.load, pressure * run.plan.grid.area, rel_tol=1e-9)
