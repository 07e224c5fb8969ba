"""Coupling of friction beyond the coefficients at which contacts under the last traction settle."""

import numpy as np
import pytest

import contactkit as ck
from contactkit.contact.effects.elasticity import bodies_of
from contactkit.contact.slip.coupling import coupling_of, coupling_strength
from contactkit.elasticity.layer_stack import Layers
from contactkit.scene.window import Grid

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

SOLID = ck.Material(young_modulus=1e9, poisson_ratio=0.3, hardness=3e6)


def sliding(coefficient, surface, window, loading, *effects, solid=SOLID, accuracy=None):
    friction = ck.FrictionTraction(coefficient=coefficient), ck.FrictionCoupling()
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Body(surface=surface)),
        window=window,
        loading=loading,
        effects=(ck.HalfSpace(), *friction, *effects),
    )
    return ck.plan(scene, accuracy)


def ball(coefficient, *effects, grid=32, force=1e-3, **given):
    window, surface = ck.Window(width=1e-4, periodic=False), ck.Sphere(radius=1e-3)
    accuracy = ck.Accuracy(grid=grid)
    return sliding(
        coefficient, surface, window, ck.Pressing(force=force), *effects, accuracy=accuracy, **given
    )


def distance(result):
    """Gap [m] under pressure and friction from the operators, of contact conditions alone."""
    plan, p = result.plan, result.pressure
    coupling = coupling_of(plan.grid, *bodies_of(plan.scene.interface))
    coefficient = plan.scene.effect(ck.FrictionTraction).coefficient
    pressed = plan.prepare().prepared.solver.displacement(p)
    return pressed + coupling(coefficient * p, None) - result.heights - result.rigid_approach


@pytest.mark.parametrize("coefficient", [4.0, 10.0])
def test_pressure_and_gap_meet_the_contact_conditions_under_strong_friction(coefficient):
    """The coupling is skew: what meets them is the only solution."""
    result = ck.solve(ball(coefficient))
    gap, touches = distance(result), result.pressure > 0.0
    scale = float(np.ptp(result.displacement))
    assert np.abs(gap[touches]).max() < 3e-6 * scale
    assert gap.min() > -3e-6 * scale
    np.testing.assert_allclose(result.gap, gap, atol=3e-6 * scale)
    assert result.of(ck.FrictionCoupling).area_change > 0.1
    assert result.residual < 1e-8


def test_a_bound_of_the_pressure_is_kept_under_strong_friction():
    """Where it is reached the surfaces overlap."""
    alone, bounded = ck.solve(ball(4.0)), ck.solve(ball(4.0, ck.HardnessLimit()))
    hardness = SOLID.hardness
    assert hardness < 0.9 * alone.max_pressure
    assert bounded.max_pressure <= hardness * (1.0 + 1e-12)
    assert bounded.contact_area > alone.contact_area
    gap, scale = distance(bounded), float(np.ptp(bounded.displacement))
    between = (bounded.pressure > 0.0) & (bounded.pressure < 0.999 * hardness)
    assert np.abs(gap[between]).max() < 3e-6 * scale
    assert gap[bounded.pressure >= 0.999 * hardness].max(initial=0.0) < 3e-6 * scale


def test_half_spaces_of_which_no_grid_resolves_the_trailing_edge_are_refused():
    with pytest.raises(ck.PlanError, match=r"coefficient of at most 17\.5, not 20: .* 5\.71"):
        ball(20.0)
    incompressible = ck.Material(young_modulus=1e9, poisson_ratio=0.5)
    assert ck.solve(ball(20.0, solid=incompressible)).status == "converged"


def test_the_strength_is_dundurs_constant_and_that_of_two_bodies_their_difference():
    grid = Grid((8, 8), (1e-9, 1e-9), periodic=True)
    soft, same = Layers([1e9], [0.0]), Layers([3e9], [0.0])
    assert coupling_strength(grid, soft, None) == pytest.approx(0.5, rel=1e-12)
    assert coupling_strength(grid, soft, soft) == pytest.approx(0.0, abs=1e-12)
    assert coupling_strength(grid, soft, same) == pytest.approx(0.25, rel=1e-12)
    sheet = Layers([1e9], [0.49], [1e-10], "bonded")  # a thin one squeezes out sideways
    assert 2.0 < coupling_strength(grid, sheet, None) < 3.0


@pytest.mark.parametrize("edges", ["x", "y", False])
def test_flats_unloaded_to_first_touch_part(edges):
    """Tractions of the step before would press them together by themselves."""
    history = ck.PlasticHistory(approaches=(1e-8,), steps=2)
    flat = ck.Heights(heights=np.zeros((8, 16)), pixel_size=1e-6)
    solid = ck.Material(young_modulus=1e6, poisson_ratio=0.3, hardness=1e6)
    window, loading = ck.Window(periodic=edges), ck.Approach(approach=0.0)
    effects = ck.HardnessLimit(), history
    result = ck.solve(sliding(0.5, flat, window, loading, *effects, solid=solid))
    assert result.status == "no contact"
    assert not result.pressure.any()
    assert result.of(ck.PlasticHistory).load[2] > 0.0
