"""Pairs of effects that act on each other: equations of the pair, and limits where one vanishes.

`brute_force` solves a contact of a few pixels by dense matrices, for given unknowns, with plain and
much damped steps between them. It shares no step with the package, whose
operators it takes as matrices.
"""

import math
from typing import ClassVar

import numpy as np
import pytest
from attrs import evolve, field, frozen

import contactkit as ck
from contactkit.contact.effects.base import ContactEffect
from contactkit.contact.effects.elasticity import bodies_of
from contactkit.contact.outer.displacement import TractionDisplacement
from contactkit.contact.slip.coupling import coupling_of
from contactkit.elasticity.hardness_rules import effective_hardness

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

N, PIXEL = 10, 10e-9
WORK, RANGE = 0.05, 2e-9
SOLID = ck.Material(young_modulus=5e9, poisson_ratio=0.1, hardness=5e8)
COATED = ck.Stack(
    layers=(
        ck.Layer(
            material=ck.Material(young_modulus=8e9, poisson_ratio=0.2, hardness=6e8),
            thickness=2e-9,
        ),
    ),
    substrate=ck.Material(young_modulus=4e9, poisson_ratio=0.2, hardness=1e8),
)
SLIDING = (ck.FrictionTraction(coefficient=0.6, direction=0.4), ck.FrictionCoupling())
WATER = ck.Meniscus(
    liquid=ck.Liquid(name="water", surface_tension=0.072, viscosity=1e-3),
    contact_angle_lower=0.2,
    contact_angle_upper=0.2,
)


def adhesion(work=WORK):
    return ck.Adhesion(law=ck.ExponentialAttraction(work_of_adhesion=work, range=RANGE))


def slip(coefficient=0.3, steps=2, **given):
    path = (ck.TangentialStep(ratio=0.5),)
    choices = {"components": 2, "coupled": True, "pressing_steps": steps} | given
    return ck.PartialSlip(coefficient=coefficient, path=path, **choices)


def heights(seed=5):
    rng = np.random.default_rng(seed)
    x = (np.arange(N) + 0.5) / N - 0.5
    bump = -6e-9 * (x[:, None] ** 2 + x**2) / 0.25
    return bump + 5e-10 * rng.normal(size=(N, N))


def solved(*effects, solid=SOLID, loading=None, periodic=False, start=None, meniscus=None):
    compliance = ck.LayeredHalfSpace() if isinstance(solid, ck.Stack) else ck.HalfSpace()
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Heights(heights=heights(), pixel_size=PIXEL)),
            meniscus=meniscus,
        ),
        window=ck.Window(periodic=periodic),
        loading=loading or ck.Pressing(pressure=8e7),
        effects=(compliance, *effects),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(rtol=1e-9)), start=start)


def matrix_of(operator):
    """Columns of an operator on maps."""
    columns = []
    for i in range(N * N):
        unit = np.zeros((N, N))
        unit.flat[i] = 1.0
        columns.append(operator(unit).ravel())
    return np.array(columns).T


def bounded(compliance, right, bound):
    """Pressure between 0 and a bound: gap zero where it is free, by trying sets of free pixels."""
    q = np.zeros(N * N)
    for _ in range(200):
        trial = q - (compliance @ q - right) / compliance[0, 0]
        free, full = (trial > 0.0) & (trial < bound), trial >= bound
        made = np.where(full, bound, 0.0) if full.any() else np.zeros(N * N)
        made[free] = np.linalg.solve(
            compliance[np.ix_(free, free)], right[free] - compliance[free] @ made
        )
        if np.abs(made - q).max() <= 1e-13 * made.max(initial=1.0):
            return made
        q = made
    raise AssertionError("the sets of free pixels cycle")


def brute_force(result, *, ratio=(0.0, 0.0), work=0.0, hardness=None, steps=200, damping=0.3):
    """Pressure of contact, tension, displacement by friction and bound at the approach found."""
    plan = result.plan
    compliance = matrix_of(plan.prepared.solver.displacement)
    caused_by = coupling_of(plan.grid, *bodies_of(plan.scene.interface))
    coupling = matrix_of(lambda p: caused_by(ratio[0] * p, ratio[1] * p))
    h = result.heights.ravel() + result.rigid_approach
    t, w, bound = np.zeros(N * N), np.zeros(N * N), np.full(N * N, np.inf)
    if hardness is not None:
        bound = np.asarray(hardness(np.zeros(N * N)))
    for _ in range(steps):
        q = bounded(compliance, h - w + compliance @ t, bound + t)
        u = compliance @ (q - t)
        gap = np.where(q > 0.0, 0.0, np.maximum(u + w - h, 0.0))
        others = (
            work / RANGE * np.exp(-gap / RANGE),
            coupling @ q,
            bound if hardness is None else np.asarray(hardness(np.maximum(u, 0.0))),
        )
        t, w = t + damping * (others[0] - t), w + damping * (others[1] - w)
        if hardness is not None:
            bound = bound + damping * (others[2] - bound)
    return q.reshape(N, N), t.reshape(N, N)


def ratios(traction):
    c = traction.coefficient
    return c * math.cos(traction.direction), c * math.sin(traction.direction)


def rule(u):
    layer, ground = COATED.layers[0], COATED.substrate
    return effective_hardness(
        u,
        (layer.material.young_modulus, ground.young_modulus),
        (6e8, 1e8),
        (layer.thickness,),
        shift=0.3,
    )


@pytest.mark.parametrize("loading", [ck.Pressing(pressure=8e7), ck.Approach(approach=1e-9)])
def test_adhesion_with_friction_coupling_is_that_of_plain_steps(loading):
    result = solved(adhesion(), *SLIDING, loading=loading)
    q, t = brute_force(result, ratio=ratios(SLIDING[0]), work=WORK)
    assert result.pressure == pytest.approx(q - t, abs=2e-6 * q.max())
    alone = solved(adhesion(), loading=loading)
    assert np.abs(alone.pressure - result.pressure).max() > 0.02 * q.max()
    assert result.of(ck.FrictionCoupling).pressure_change > 0.02
    force = result.of(ck.FrictionTraction).force
    assert force == pytest.approx(0.6 * q.sum() * PIXEL**2, rel=1e-5)


def test_adhesion_with_a_local_hardness_is_that_of_plain_steps():
    result = solved(
        adhesion(),
        ck.HardnessLimit(rule=ck.ContinuousHardness(displacement="local")),
        solid=COATED,
        loading=ck.Pressing(pressure=8e7),
    )
    q, t = brute_force(result, work=WORK, hardness=rule)
    assert result.scalars()["plastic_fraction"][0] > 0.05
    assert result.pressure == pytest.approx(q - t, abs=2e-6 * q.max())
    assert np.ptp(result.of(ck.HardnessLimit).hardness) > 1e7


def test_adhesion_with_one_hardness_is_that_of_its_largest_displacement():
    result = solved(adhesion(), ck.HardnessLimit(), solid=COATED)
    found = result.of(ck.HardnessLimit).hardness
    assert found < 5.9e8
    largest = result.displacement[result.contact].max()
    assert found == pytest.approx(float(rule(np.array(largest))), rel=2e-7)
    fixed = solved(
        adhesion(), ck.HardnessLimit(rule=ck.ConstantHardness(hardness=found)), solid=COATED
    )
    assert result.pressure == pytest.approx(fixed.pressure, abs=1e-6 * result.max_pressure)


def test_friction_is_that_of_the_pressure_of_contact_under_adhesion():
    """Derjaguin: the force is mu times load and tension; none acts across the gap."""
    result = solved(adhesion(), ck.FrictionTraction(coefficient=0.5), ck.SubsurfaceStress())
    tension = result.of(ck.Adhesion).tension
    part = result.of(ck.FrictionTraction)
    pull = tension[result.contact].sum() * PIXEL**2
    net = result.pressure[result.contact].sum() * PIXEL**2
    assert part.force == pytest.approx(0.5 * (net + pull), rel=1e-9)
    assert not part.traction_x[~result.contact].any()
    assert (~result.contact).any()
    surface = solved(
        adhesion(),
        ck.FrictionTraction(coefficient=0.5),
        ck.SubsurfaceStress(depths=(0.0,), keep="planes", reading="uniform"),
    ).of(ck.SubsurfaceStress)
    shear = np.abs(surface.planes[4, 0] if surface.planes.ndim == 4 else surface.planes[4])
    assert shear[~result.contact].max() < 0.05 * shear.max()


def test_partial_slip_slides_at_the_friction_of_the_pressure_of_contact():
    given = {"components": 1, "coupled": False, "pressing_steps": None}
    result = solved(adhesion(), slip(**given))
    part, tension = result.of(ck.PartialSlip), result.of(ck.Adhesion).tension
    pressed = np.where(result.contact, result.pressure + tension, 0.0)
    assert part.force[-1] == pytest.approx(0.5 * 0.3 * pressed.sum() * PIXEL**2, rel=1e-6)
    assert np.all(np.abs(part.traction_x[-1]) <= 0.3 * pressed * (1.0 + 1e-9) + 1.0)


def violations(result):
    """Largest gap under pressure and overlap [m], by the sums of all displacements."""
    plan, coupling = result.plan, result.of(ck.PartialSlip).coupling
    u = plan.prepared.solver.displacement(result.pressure)
    gap = u + coupling.displacement - plan.heights - result.rigid_approach
    return np.abs(gap[result.contact]).max(), max(-gap.min(), 0.0)


def test_adhesion_with_coupled_slip_meets_the_equations_of_both():
    result = solved(adhesion(), slip())
    part, tension = result.of(ck.PartialSlip), result.of(ck.Adhesion).tension
    assert max(violations(result)) < 1e-5 * np.ptp(result.displacement)
    assert tension == pytest.approx(
        WORK / RANGE * np.exp(-result.gap / RANGE), abs=1e-5 * WORK / RANGE
    )
    caused_by = coupling_of(result.plan.grid, *bodies_of(result.plan.scene.interface))
    caused = caused_by(part.traction_x[-1], part.traction_y[-1])
    scale = np.ptp(result.displacement)
    assert part.coupling.displacement == pytest.approx(caused, abs=1e-6 * scale)
    pressed = np.where(result.contact, result.pressure + tension, 0.0)
    size = np.hypot(part.traction_x[-1], part.traction_y[-1])
    assert np.all(size <= 0.3 * pressed * (1.0 + 1e-6) + 1e-6 * pressed.max())
    assert part.coupling.pressure_change > 0.01


@pytest.mark.parametrize("loading", [ck.Pressing(pressure=8e7), ck.Approach(approach=1e-9)])
def test_without_work_of_adhesion_friction_coupling_is_left(loading):
    pair = solved(adhesion(1e-9), *SLIDING, loading=loading)
    alone = solved(*SLIDING, loading=loading)
    assert pair.pressure == pytest.approx(alone.pressure, abs=1e-5 * alone.max_pressure)
    change = pair.of(ck.FrictionCoupling).pressure_change
    assert change == pytest.approx(alone.of(ck.FrictionCoupling).pressure_change, rel=1e-4)


def test_without_friction_adhesion_is_left():
    smooth = (ck.FrictionTraction(coefficient=1e-9), ck.FrictionCoupling())
    alone = solved(adhesion())
    for pair in (solved(adhesion(), *smooth), solved(adhesion(), slip(1e-9))):
        assert pair.pressure == pytest.approx(alone.pressure, abs=1e-6 * alone.max_pressure)


@pytest.mark.slow
def test_without_work_of_adhesion_coupled_slip_is_left():
    pair, alone = solved(adhesion(1e-9), slip()), solved(slip())
    assert pair.pressure == pytest.approx(alone.pressure, abs=1e-5 * alone.max_pressure)
    one, other = pair.of(ck.PartialSlip), alone.of(ck.PartialSlip)
    assert one.traction_x == pytest.approx(other.traction_x, abs=1e-4 * other.traction_x.max())


def test_a_pull_is_carried_beside_friction_and_too_much_of_it_refused():
    held = solved(adhesion(), *SLIDING, loading=ck.Pressing(pressure=-1e6))
    assert held.mean_pressure == pytest.approx(-1e6, rel=1e-7)
    with pytest.raises(ck.InfeasibleError, match="exceeds the pull-off force"):
        solved(adhesion(), *SLIDING, loading=ck.Pressing(pressure=-1e9))


class LinerDisplacement(TractionDisplacement):
    """Compression of a liner, in proportion to the pressure."""

    name = "compression of the liner"


@frozen(kw_only=True)
class Liner(ContactEffect[None]):
    """An effect of one's own: a liner of independent springs between the bodies."""

    name: ClassVar[str] = "liner"
    summary: ClassVar[str] = "liner of springs"
    sources: ClassVar[tuple[str, ...]] = ("Winkler 1867",)
    softness: float = field(metadata={"unit": "m/Pa"})

    def unknowns(self, view):
        """The compression, which lowers the heights."""
        shape, own = view.grid.shape, view.self_influence
        return (LinerDisplacement(lambda p: self.softness * p, shape, own, self.name),)


def test_an_effect_of_ones_own_brings_an_unknown():
    result = solved(Liner(softness=2e-18), adhesion())
    compliance = matrix_of(result.plan.prepared.solver.displacement)
    right = (result.heights + result.rigid_approach).ravel()
    tension = result.of(ck.Adhesion).tension.ravel()
    # Springs under the pressure of contact; the tension displaces the solid alone.
    q = bounded(compliance + 2e-18 * np.eye(N * N), right + compliance @ tension, np.inf)
    assert result.pressure.ravel() == pytest.approx(q - tension, abs=1e-5 * q.max())
    alone = solved(adhesion())
    assert result.max_pressure < 0.95 * alone.max_pressure


# Histories ----------------------------------------------------------------------------------

LIMIT = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=3e8))
HARD = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=1e12))
UP_AND_DOWN = ck.PlasticHistory(pressures=(8e7,), steps=2)


@pytest.mark.parametrize("others", [SLIDING, (adhesion(),)], ids=["coupling", "adhesion"])
def test_a_hardness_that_is_never_reached_leaves_the_elastic_contact(others):
    low = ck.Pressing(pressure=2e7)
    pair = solved(HARD, UP_AND_DOWN, *others, loading=low)
    before = solved(*others, loading=ck.Pressing(pressure=8e7))
    between = solved(*others, loading=ck.Pressing(pressure=5e7), start=before)
    alone = solved(*others, loading=low, start=between)
    assert pair.pressure == pytest.approx(alone.pressure, abs=1e-6 * before.max_pressure)
    assert pair.of(ck.PlasticHistory).residual_volume[-1] == 0.0


@pytest.mark.parametrize("others", [SLIDING, (adhesion(1e-9),)], ids=["coupling", "adhesion"])
def test_what_vanishes_leaves_the_plastic_history(others):
    if others is SLIDING:
        others = (ck.FrictionTraction(coefficient=1e-9), ck.FrictionCoupling())
    pair, alone = (
        solved(LIMIT, UP_AND_DOWN, *one, loading=ck.Pressing(pressure=2e7)) for one in (others, ())
    )
    one, other = pair.of(ck.PlasticHistory), alone.of(ck.PlasticHistory)
    assert other.residual_volume[-1] > 0.0
    assert one.residual_depth == pytest.approx(
        other.residual_depth, abs=1e-5 * other.residual_depth.max()
    )
    assert one.plastic_work == pytest.approx(other.plastic_work, rel=1e-5)


def test_adhesion_pulls_a_plastic_contact_deeper():
    alone = solved(LIMIT, UP_AND_DOWN, loading=ck.Pressing(pressure=2e7))
    pair = solved(LIMIT, UP_AND_DOWN, adhesion(), loading=ck.Pressing(pressure=2e7))
    one, other = pair.of(ck.PlasticHistory), alone.of(ck.PlasticHistory)
    assert one.contact_area[-1] > other.contact_area[-1]
    assert pair.pressure.max() <= 3e8 * (1.0 + 1e-9)
    # The unloaded state is that of a separation, from the larger contact before.
    again = ck.solve(pair.plan).of(ck.PlasticHistory)
    assert again.residual_volume[-1] == one.residual_volume[-1]


@pytest.mark.slow
def test_without_flow_the_steps_of_a_history_are_steps_of_pressing():
    """Loads of a quarter and all: those of two steps of pressing."""
    steps = ck.PlasticHistory(pressures=(2e7,), steps=1)
    pair = solved(HARD, steps, slip(0.5, steps=None))
    alone = solved(slip(0.5, steps=2))
    one, other = pair.of(ck.PartialSlip), alone.of(ck.PartialSlip)
    assert pair.pressure == pytest.approx(alone.pressure, abs=1e-5 * alone.max_pressure)
    assert one.traction_x == pytest.approx(other.traction_x, abs=1e-3 * other.traction_x.max())
    assert one.coupling.pressing_steps == 2


def test_without_friction_the_history_of_a_coupled_path_is_left():
    pair = solved(LIMIT, UP_AND_DOWN, slip(1e-9, steps=None))
    alone = solved(LIMIT, UP_AND_DOWN)
    depth = alone.of(ck.PlasticHistory).residual_depth
    assert depth.max() > 0.0
    assert pair.of(ck.PlasticHistory).residual_depth == pytest.approx(depth, abs=1e-5 * depth.max())
    assert pair.pressure == pytest.approx(alone.pressure, abs=1e-5 * alone.max_pressure)


def test_flow_and_slip_act_on_each_other():
    pair = solved(LIMIT, UP_AND_DOWN, slip(0.5, steps=None))
    part, depth = pair.of(ck.PartialSlip), pair.of(ck.PlasticHistory).residual_depth
    apart = solved(LIMIT, UP_AND_DOWN).of(ck.PlasticHistory).residual_depth
    assert np.abs(depth - apart).max() > 0.01 * apart.max()
    assert pair.pressure.max() <= 3e8 * (1.0 + 1e-9)
    size = np.hypot(part.traction_x[-1], part.traction_y[-1])
    assert np.all(size <= 0.5 * pair.pressure * (1.0 + 1e-6) + 1e-6 * pair.max_pressure)
    u = pair.plan.prepared.solver.displacement(pair.pressure) + part.coupling.displacement
    gap = u - pair.heights + depth - pair.rigid_approach
    elastic = pair.contact & (pair.pressure < 2.99e8)
    assert np.abs(gap[elastic]).max() < 1e-3 * np.ptp(u)


def test_steps_of_pressing_beside_a_history_are_refused():
    with pytest.raises(ck.PlanError, match="no pressing_steps or pressing_rtol beside Plastic"):
        solved(LIMIT, UP_AND_DOWN, slip(steps=4))


def film(**given):
    return ck.FilmMeniscus(film_thickness=1e-9, **given)


def test_a_film_is_reported_on_the_shape_that_a_history_leaves():
    from contactkit.contact.plastic_history import residual_surface

    low = ck.Pressing(pressure=2e7)
    pair = solved(LIMIT, UP_AND_DOWN, film(), loading=low, meniscus=WATER)
    left = residual_surface(pair)
    scene = evolve(
        pair.plan.scene,
        interface=evolve(pair.plan.scene.interface, upper=ck.Body(surface=left)),
        effects=(ck.HalfSpace(), LIMIT, film()),
    )
    again = ck.solve(ck.plan(scene, ck.Accuracy(rtol=1e-9)))
    assert pair.of(ck.FilmMeniscus).force == pytest.approx(again.of(ck.FilmMeniscus).force)
    alone = solved(LIMIT, film(), loading=low, meniscus=WATER).of(ck.FilmMeniscus)
    assert alone.force != pytest.approx(again.of(ck.FilmMeniscus).force, rel=1e-3)


def test_a_film_that_pulls_adds_to_every_load_of_a_history():
    low, pulls = ck.Pressing(pressure=2e7), film(self_consistent=True)
    pair = solved(LIMIT, UP_AND_DOWN, pulls, loading=low, meniscus=WATER)
    part, area = pair.of(ck.PlasticHistory), pair.plan.grid.area
    assert np.all(part.load[1:] > np.array([4e7, 8e7, 5e7, 2e7]) * area * 1.001)
    drawn = pair.of(ck.FilmMeniscus)
    assert part.load[-1] == pytest.approx(2e7 * area + drawn.force, rel=1e-6)
    elastic = solved(HARD, UP_AND_DOWN, pulls, loading=low, meniscus=WATER)
    alone = solved(pulls, loading=low, meniscus=WATER)
    assert elastic.load == pytest.approx(alone.load, rel=1e-6)


@pytest.mark.slow
def test_a_film_that_pulls_adds_to_the_load_of_coupled_slip():
    pulls = film(self_consistent=True)
    pair = solved(slip(steps=1), pulls, meniscus=WATER)
    part = pair.of(ck.PartialSlip)
    drawn = pair.of(ck.FilmMeniscus).force
    imposed = 8e7 * pair.plan.grid.area
    assert drawn > 0.01 * imposed
    assert pair.load == pytest.approx(imposed + drawn, rel=1e-6)
    assert part.force[-1] == pytest.approx(0.5 * 0.3 * pair.load, rel=1e-5)
    alone = solved(pulls, meniscus=WATER)
    smooth = solved(slip(1e-9, steps=1), pulls, meniscus=WATER)
    assert smooth.pressure == pytest.approx(alone.pressure, abs=1e-6 * alone.max_pressure)


@pytest.mark.parametrize(
    "wet", [film(), film(self_consistent=True), ck.IslandBridges(film_thickness=1e-9)]
)
def test_adhesion_across_air_is_refused_where_liquid_fills_the_gap(wet):
    with pytest.raises(ck.PlanError, match=r"solids do not attract each other.*from_meniscus"):
        solved(adhesion(), wet, meniscus=WATER)
