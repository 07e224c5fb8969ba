"""Partial slip at its ends: no friction, no pressure, full sliding, one pixel, full contact."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.contact.slip.load_path import FrictionLaw, follow
from contactkit.contact.slip.states import Zone
from contactkit.elasticity.layer_stack import Layers
from contactkit.scene.window import Grid

pytestmark = pytest.mark.hard

SOLID = (Layers([1e9], [0.3]),)
BUMPS = np.maximum(np.random.default_rng(3).normal(size=(24, 20)), 0.0) * 1e6
PIXEL = (2e-8, 3e-8)
EDGES = pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "isolated"])
COMPONENTS = pytest.mark.parametrize("components", [1, 2])


def run(pressure, *steps, solids=SOLID, periodic=True, components=1, coefficient=0.3):
    grid = Grid(pressure.shape, PIXEL, periodic)
    law = FrictionLaw(coefficient, 0.0, components, True, 1e-8)
    return follow(pressure, grid, solids, steps, law)


def ratio(value, steps=1):
    return ck.TangentialStep(ratio=value, steps=steps)


def moved(value, steps=1):
    return ck.TangentialStep(displacement=value, steps=steps)


def full(pressure, coefficient=0.3):
    return coefficient * pressure.sum() * PIXEL[0] * PIXEL[1]


def is_finite(part):
    left_out = (part.stiffness, part.coupling)
    return all(np.isfinite(one).all() for one in part if not any(one is x for x in left_out))


@COMPONENTS
@EDGES
def test_without_friction_or_pressure_it_slides(components, periodic):
    given = {"components": components, "periodic": periodic}
    none = run(BUMPS, ratio(1.0), moved(1e-9), coefficient=0.0, **given)
    empty = run(np.zeros((24, 20)), ratio(0.5), moved(1e-9), **given)
    for part in (none, empty):
        assert part.displacement[-1] == pytest.approx(1e-9, rel=1e-12)
        assert not part.force.any()
        assert not part.dissipated_work.any()
        assert is_finite(part)
    assert (none.zones[-1][BUMPS > 0.0] == Zone.SLIP).all()
    assert not empty.zones.any()


@COMPONENTS
@EDGES
def test_nothing_moves_without_a_force(components, periodic):
    part = run(BUMPS, ratio(0.0), moved(0.0), periodic=periodic, components=components)
    assert not part.traction_x.any()
    assert not part.displacement.any()
    assert not part.dissipated_work.any()


@COMPONENTS
@EDGES
def test_full_sliding_and_back(components, periodic):
    steps = (ratio(1.0), ratio(-1.0), moved(1e-6), moved(2e-6), ratio(0.0))
    part = run(BUMPS, *steps, periodic=periodic, components=components)
    sliding = full(BUMPS)
    assert part.force[1:5] == pytest.approx([sliding, -sliding, sliding, sliding], rel=1e-6)
    assert np.abs(part.traction_x[0] - 0.3 * BUMPS).max() < 1e-6 * BUMPS.max()
    assert part.stick_fraction[1] == 0.0
    assert (part.zones[1][BUMPS > 0.0] == Zone.REVERSE_SLIP).all()
    assert part.energy_loss(2, 3) == pytest.approx(1e-6 * sliding, rel=1e-6)
    assert np.all(np.diff(part.dissipated_work) >= 0.0)
    assert part.residual < 1e-7
    assert is_finite(part)


@COMPONENTS
@EDGES
def test_one_pixel_sticks_until_it_slides(components, periodic):
    pressure = np.zeros((6, 5))
    pressure[2, 3] = 1e6
    part = run(pressure, ratio(0.999), ratio(-0.999), moved(1e-6), periodic=periodic)
    assert part.displacement[1] == pytest.approx(-part.displacement[2], rel=1e-9, abs=0.0)
    assert part.dissipated_work[2] == 0.0
    assert part.force[3] == pytest.approx(full(pressure), rel=1e-9)


@COMPONENTS
def test_a_periodic_window_all_in_contact(components):
    """No uniform traction displaces it, so that its tangential stiffness is infinite."""
    pressure = 1e6 + 0.9 * BUMPS
    steps = (ratio(0.2), ratio(0.7), ratio(0.2), moved(1e-8), moved(-1e-8))
    part = run(pressure, *steps, components=components)
    assert np.isinf(part.stiffness[1])
    assert part.displacement[1] == pytest.approx(0.0, abs=1e-18)
    assert part.force[4] == pytest.approx(full(pressure), rel=1e-6)
    assert part.force[5] == pytest.approx(-full(pressure), rel=1e-6)
    assert part.residual < 1e-7
    flat = run(np.full((4, 4), 1e6), moved(1e-9), moved(0.0))
    assert abs(flat.force[1]) == pytest.approx(full(np.full((4, 4), 1e6)), rel=1e-9)


SOLIDS = {
    "incompressible": (Layers([1e9], [0.5]),),
    "stiff film": (Layers([1e12, 1e9], [0.3, 0.3], [2e-8]),),
    "very stiff film": (Layers([1e15, 1e9], [0.3, 0.3], [2e-9]),),
    "soft film": (Layers([1e3, 1e9], [0.49, 0.3], [1e-7]),),
    "two bodies": (Layers([1e9], [0.2]), Layers([2e9, 5e9], [0.3, 0.1], [1e-8])),
    "bonded base": (Layers([1e9], [0.4], [2e-7], "bonded"),),
}
ANY_SOLID = [*itertools.product(SOLIDS, [True, False], [1, 2])]  # name, periodic, components
HARDEST = ("very stiff film", False, 2)


@pytest.mark.parametrize(
    ("name", "periodic", "components"),
    quick(ANY_SOLID, *(i for i, case in enumerate(ANY_SOLID) if i % 3 == 0 and case != HARDEST)),
)
def test_any_solid_converges_along_a_path(name, periodic, components):
    solids = SOLIDS[name]
    steps = (ratio(0.6), ratio(-0.3), ratio(0.9, 3))
    given = {"solids": solids, "periodic": periodic, "components": components}
    part = run(BUMPS, *steps, **given)
    assert part.force[-1] == pytest.approx(0.9 * full(BUMPS), rel=1e-9)
    is_hardest = solids is SOLIDS["very stiff film"] and not periodic
    assert part.residual <= (1e-3 if is_hardest else 1.01e-8)  # the first is reported
    assert part.applications < (1000 if is_hardest else 150) * (len(part.force) - 1)


@COMPONENTS
@EDGES
def test_tiny_reversals_leave_the_state_as_it_is(components, periodic):
    tiny = [ratio(0.5 + e) for e in (0.0, -1e-7, 0.0, -1e-7, 0.0)]
    part = run(BUMPS, *tiny, periodic=periodic, components=components)
    before, after = part.end_of(0), part.end_of(4)
    assert part.displacement[after] == pytest.approx(part.displacement[before], rel=1e-8, abs=0.0)
    change = part.displacement[part.end_of(1)] - part.displacement[before]
    expected = -1e-7 * full(BUMPS) / part.stiffness[0]
    assert change == pytest.approx(expected, rel=1e-3, abs=0.0)  # all of it sticks
    assert part.residual <= 1.01e-8


def test_layers_that_slide_on_their_base_are_refused_in_isolation():
    loose = (Layers([1e9], [0.4], [2e-7], "frictionless"),)
    with pytest.raises(ck.DescriptionError, match="bond them to the base, or use Window"):
        run(BUMPS, ratio(0.5), solids=loose, periodic=False)
    assert run(BUMPS, ratio(0.5), solids=loose).residual <= 1e-8


@COMPONENTS
@EDGES
@pytest.mark.parametrize("far", [1e-6, 1.0, -1e3])
def test_however_far_it_is_moved_it_slides(far, periodic, components):
    """The tolerance is of the elastic displacement, not of the length that the contact slides."""
    part = run(BUMPS, moved(far), moved(0.0), periodic=periodic, components=components)
    sign = np.sign(far)
    assert part.force[1:] == pytest.approx([sign * full(BUMPS), -sign * full(BUMPS)], rel=1e-4)
    assert not part.stick_fraction[1:].any()
    assert part.dissipated_work[2] == pytest.approx(2.0 * abs(far) * full(BUMPS), rel=0.02)
    faint = run(BUMPS, moved(far), coefficient=1e-12, components=components, periodic=periodic)
    assert faint.force[1] == pytest.approx(sign * full(BUMPS, 1e-12), rel=1e-4, abs=0.0)
