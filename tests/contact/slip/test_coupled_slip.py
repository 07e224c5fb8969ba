"""Partial slip of dissimilar bodies: pressure and tractions that displace each other's surfaces."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from attrs import evolve
from scipy.optimize import brentq
from scipy.special import ellipk

import contactkit as ck
from contactkit.contact import slip_path
from contactkit.contact.effects.elasticity import bodies_of
from contactkit.contact.slip.coupling import coupling_of
from contactkit.contact.slip.operator import tangential_operator
from contactkit.units import GPa, MPa, mm, nm, um

RADIUS = 1 * mm
REST = (ck.TangentialStep(force=0.0),)
HALF = (ck.TangentialStep(ratio=0.5, steps=2),)

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")]


def pressed(nu=0.2, coefficient=0.2, force=1.0, grid=32, path=REST, **choices):
    """A rigid sphere on a half-space."""
    solid = ck.Material(young_modulus=70 * GPa, poisson_ratio=nu)
    radius = (0.75 * force * RADIUS / solid.plane_strain_modulus) ** (1.0 / 3.0)
    choices = {"components": 2, "coupled": True} | choices
    if choices["coupled"] and "pressing_rtol" not in choices:
        choices.setdefault("pressing_steps", 4)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid), upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS))
        ),
        window=ck.Window(width=2.4 * radius, periodic=False),
        loading=ck.Pressing(force=force),
        effects=(
            ck.HalfSpace(),
            ck.PartialSlip(coefficient=coefficient, path=path, **choices),
        ),
    )
    result = ck.solve(ck.plan(scene, ck.Accuracy(grid=grid)))
    return result, result.of(ck.PartialSlip)


def spence(ratio):
    """Stick radius over contact radius at a ratio of friction to Dundurs' beta (Spence 1975)."""
    return brentq(
        lambda c: math.atanh(c) / c - ratio * ellipk(1.0 - c * c), 1e-6, 1.0 - 1e-12, xtol=1e-12
    )


def test_without_coupling_of_the_bodies_the_choice_changes_nothing():
    coupled, with_it = pressed(nu=0.5, path=HALF)
    plain, without = pressed(nu=0.5, path=HALF, coupled=False)
    np.testing.assert_allclose(
        coupled.pressure, plain.pressure, rtol=0, atol=1e-6 * plain.max_pressure
    )
    scale = np.abs(without.traction_x).max()
    np.testing.assert_allclose(with_it.traction_x, without.traction_x, rtol=0, atol=1e-6 * scale)
    np.testing.assert_allclose(with_it.displacement, without.displacement, rtol=1e-6)


@pytest.mark.slow
def test_the_stick_circle_does_not_depend_on_the_load():
    (_, one), (_, other) = pressed(force=1.0), pressed(force=8.0)
    assert one.stick_fraction[0] == other.stick_fraction[0]
    assert 0.05 < one.stick_fraction[0] < 0.5
    assert one.coupling.pressure_change == pytest.approx(other.coupling.pressure_change, rel=1e-6)


@pytest.mark.slow
def test_without_tractions_in_the_gap_the_stick_circle_is_that_of_spence(monkeypatch):
    monkeypatch.setattr(
        slip_path._Run, "normal", lambda run, traction: np.zeros(run.plan.grid.shape)
    )
    _, part = pressed(grid=64, pressing_steps=16)
    beta = (1.0 - 2.0 * 0.2) / (2.0 * (1.0 - 0.2))
    assert math.sqrt(part.stick_fraction[0]) == pytest.approx(spence(0.2 / beta), rel=0.03)


def punch(nu, coefficient, path=REST, grid=32, **choices):
    """A flat-ended rigid punch of 0.8 of the window across, pressed in one step."""
    x = (np.arange(grid) + 0.5) / grid - 0.5
    on = np.hypot(x[:, None], x) < 0.4
    heights = ck.Heights(heights=np.where(on, 0.0, -1.0) * um, pixel_size=100 * um / grid)
    effects = [ck.HalfSpace()]
    if coefficient:
        choices = {"components": 2, "coupled": True, "pressing_steps": 1} | choices
        effects.append(ck.PartialSlip(coefficient=coefficient, path=path, **choices))
    solid = ck.Material(young_modulus=1 * GPa, poisson_ratio=nu)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Body(surface=heights)),
        window=ck.Window(periodic=False),
        loading=ck.Pressing(pressure=0.1 * MPa),
        effects=tuple(effects),
    )
    return ck.solve(ck.plan(scene))


@pytest.mark.parametrize("ratio", [0.5, 1.0])
def test_a_flat_punch_sticks_as_far_as_a_sphere(monkeypatch, ratio):
    """Spence: all punches of a power law have one stick radius; pressing this one is one step."""
    monkeypatch.setattr(
        slip_path._Run, "normal", lambda run, traction: np.zeros(run.plan.grid.shape)
    )
    beta = (1.0 - 2.0 * 0.2) / (2.0 * (1.0 - 0.2))
    part = punch(0.2, ratio * beta, grid=96).of(ck.PartialSlip)
    assert math.sqrt(part.stick_fraction[0]) == pytest.approx(spence(ratio), rel=0.01)


@pytest.mark.parametrize("nu", [0.0, 0.2, 0.45])
def test_a_bonded_punch_is_as_stiff_as_mossakovskii_has_it(nu):
    """P = 4 G a d ln(3 - 4 nu)/(1 - 2 nu), over 4 G a d/(1 - nu) without friction."""
    bonded, free = punch(nu, 1e3), punch(nu, 0.0)
    exact = (1.0 - nu) * math.log(3.0 - 4.0 * nu) / (1.0 - 2.0 * nu)
    assert bonded.of(ck.PartialSlip).stick_fraction[0] == 1.0
    assert free.approach / bonded.approach == pytest.approx(exact, rel=1e-3)


def elastic_energy(result, traction):
    """Elastic energy of half-space and tractions (2, ny, nx), by the compliances C, B and H."""
    plan, pressure = result.plan, result.pressure
    bodies = bodies_of(plan.scene.interface)
    coupling = coupling_of(plan.grid, *bodies)
    touching = pressure > 0.0
    q = traction[:, touching]
    tangential = tangential_operator(plan.grid, touching, (bodies[0],), 0.0, 2)
    normal = plan.prepared.solver.displacement(pressure)
    work = float((pressure * normal).sum()) + float((q * tangential(q)).sum())
    return 0.5 * plan.grid.pixel_area * (work + 2.0 * float((pressure * coupling(*traction)).sum()))


def test_pressing_a_punch_balances_work_elastic_energy_and_friction():
    """All grows with the load, so that its work is half of load times approach."""
    result = punch(0.1, 0.35)
    part = result.of(ck.PartialSlip)
    assert 0.2 < part.stick_fraction[0] < 0.8
    traction = np.array([part.traction_x[0], part.traction_y[0]])
    work = 0.5 * result.load * result.approach
    lost = part.dissipated_work[0]
    assert lost > 1e-3 * work
    assert elastic_energy(result, traction) + lost == pytest.approx(work, rel=1e-6)


def test_a_tangential_path_balances_work_elastic_energy_and_friction():
    """Incompressible, so that the pressure stays: the work is the integral of force over path."""
    steps = (ck.TangentialStep(ratio=0.8, steps=24), ck.TangentialStep(ratio=-0.5, steps=40))
    result, part = pressed(nu=0.5, path=steps, coupled=False)
    traction = np.array([part.traction_x[-1], part.traction_y[-1]])
    work = float(np.trapezoid(part.force, part.displacement))
    pressed_in = elastic_energy(result, 0.0 * traction)
    stored = elastic_energy(result, traction) - pressed_in
    assert part.dissipated_work[-1] > 0.1 * work > 0.0
    assert stored + part.dissipated_work[-1] == pytest.approx(work, rel=2e-3)


@pytest.mark.exhaustive
def test_large_coefficients_stick_the_more_the_finer_the_steps_of_pressing():
    _, coarse = pressed(coefficient=10.0, nu=0.0, pressing_steps=2)
    _, fine = pressed(coefficient=10.0, nu=0.0, pressing_steps=8)
    assert 0.9 < coarse.stick_fraction[0] < fine.stick_fraction[0]
    assert fine.stick_fraction[0] > 0.98


def test_friction_makes_the_contact_smaller_and_its_pressure_higher():
    _, part = pressed(coefficient=1.0, nu=0.0)
    assert part.coupling.area_change < 0.0
    assert 0.2 < part.coupling.pressure_change < 0.5
    _, weaker = pressed(coefficient=0.1, nu=0.0)
    assert 0.0 < weaker.coupling.pressure_change < part.coupling.pressure_change


def test_more_steps_of_pressing_change_less():
    errors = [pressed(pressing_steps=n)[1].coupling.step_error for n in (2, 4)]
    assert errors[0] > 2.0 * errors[1] > 0.0
    assert pressed(pressing_steps=1)[1].coupling.step_error is None


@pytest.mark.parametrize(("rtol", "steps"), [(0.1, 16), (0.02, 16), (0.01, 33), (0.001, 256)])
def test_the_number_of_pressing_steps_follows_from_the_tolerance(monkeypatch, rtol, steps):
    """Tractions that err by 0.3 over the number of steps, as they do."""

    def pressed_in(run, targets, last=0.0):
        n = len(targets)
        state = SimpleNamespace(traction=np.full((2, 1, 1), 0.5**0.5 * (1.0 + 0.3 / n)))
        taken = SimpleNamespace(state=state, bound=np.ones(1))
        return SimpleNamespace(taken=taken, solved=SimpleNamespace(problem=""))

    monkeypatch.setattr(slip_path, "_pressed", pressed_in)
    effect = ck.PartialSlip(
        coefficient=0.3, path=REST, components=2, coupled=True, pressing_rtol=rtol
    )
    scene = SimpleNamespace(effect=lambda kind: None)
    run = SimpleNamespace(plan=SimpleNamespace(scene=scene), targets=lambda n: [None] * n)
    found = slip_path._press(run, effect)
    assert found.steps == steps
    assert found.error == pytest.approx(0.3 / steps)


@pytest.mark.exhaustive
def test_the_stated_error_of_pressing_is_no_less_than_the_true_one():
    for mu, nu in ((0.1, 0.45), (0.3, 0.3)):
        result, part = pressed(nu=nu, coefficient=mu, grid=32, pressing_rtol=0.03)
        _, fine = pressed(nu=nu, coefficient=mu, grid=32, pressing_steps=64)
        change = np.hypot(part.traction_x - fine.traction_x, part.traction_y - fine.traction_y)
        error = float(np.linalg.norm(change)) / float(np.linalg.norm(mu * result.pressure))
        assert error <= part.coupling.step_error <= 4.0 * error


@pytest.mark.exhaustive
def test_a_sphere_pressed_by_default_sticks_as_far_as_spence_has_it():
    """Tractions hardly change the pressure here; eight steps, given, are 5 % off."""
    beta = (1.0 - 2.0 * 0.45) / (2.0 * (1.0 - 0.45))
    _, part = pressed(nu=0.45, coefficient=0.1, grid=48, pressing_rtol=0.01)
    assert part.coupling.step_error <= 0.01
    assert math.sqrt(part.stick_fraction[0]) == pytest.approx(spence(0.1 / beta), rel=0.01)
    _, coarse = pressed(nu=0.45, coefficient=0.1, grid=48, pressing_steps=8)
    assert coarse.coupling.pressing_steps == 8
    assert math.sqrt(coarse.stick_fraction[0]) < 0.96 * spence(0.1 / beta)
    assert coarse.coupling.step_error > 0.03


def test_steps_of_pressing_that_nothing_uses_are_refused():
    with pytest.raises(ck.DescriptionError, match=r"pressing_steps must be left out without coup"):
        pressed(coupled=False, pressing_steps=8)
    with pytest.raises(ck.DescriptionError, match=r"pressing_steps must be left out beside press"):
        pressed(pressing_steps=8, pressing_rtol=0.02)


@pytest.mark.slow
def test_the_direction_of_the_load_turns_the_tractions():
    along, x = pressed(path=HALF)
    across, y = pressed(path=HALF, direction=0.5 * math.pi)
    scale = np.abs(x.traction_x).max()
    # Pixels at the edge of sticking stop within the tolerance of the coupling, 1e-4 of the peak.
    np.testing.assert_allclose(
        across.pressure, along.pressure.T, rtol=0, atol=3e-4 * along.max_pressure
    )
    np.testing.assert_allclose(y.traction_y[0], x.traction_x[0].T, rtol=0, atol=3e-4 * scale)


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("is_layered", [False, True])
def test_coupling_is_reciprocal(periodic, is_layered):
    solid = ck.Material(young_modulus=100 * GPa, poisson_ratio=0.25)
    stack = solid
    if is_layered:
        film = ck.Layer(
            material=ck.Material(young_modulus=300 * GPa, poisson_ratio=0.2), thickness=20 * nm
        )
        stack = ck.Stack(layers=(film,), substrate=solid)
    rough = ck.SelfAffineRoughness(rms=1 * nm, hurst=0.8, rolloff=0.5 * um, cutoff=100 * nm, seed=1)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=stack), upper=ck.Body(surface=rough)),
        window=ck.Window(width=1 * um, periodic=periodic),
        loading=ck.Pressing(pressure=1 * GPa),
        effects=(ck.LayeredHalfSpace() if is_layered else ck.HalfSpace(),),
    )
    plan = ck.plan(scene, ck.Accuracy(grid=24))
    coupling = coupling_of(plan.grid, *bodies_of(scene.interface))
    p, qx, qy = np.random.default_rng(3).normal(size=(3, 24, 24))
    x, y = coupling.of_pressure(p)
    work, other = float((coupling(qx, qy) * p).sum()), float((x * qx + y * qy).sum())
    assert work == pytest.approx(other, rel=1e-10)
    assert abs(work) > 0.0
    assert coupling.count == 2

    part = ck.PartialSlip(coefficient=0.3, path=HALF, components=2, coupled=True, pressing_steps=2)
    result = ck.solve(ck.plan(evolve(scene, effects=(*scene.effects, part)), ck.Accuracy(grid=24)))
    slip = result.of(ck.PartialSlip)
    mu_p = 0.3 * result.pressure
    size = np.hypot(slip.traction_x[-1], slip.traction_y[-1])
    assert np.all(size <= mu_p * (1.0 + 1e-6) + 1e-9 * mu_p.max())
    pixel = plan.grid.pixel_size[0] * plan.grid.pixel_size[1]
    assert slip.traction_x[-1].sum() * pixel == pytest.approx(slip.force[-1], rel=1e-6)
    assert result.mean_pressure == pytest.approx(1 * GPa, rel=1e-7)


def test_a_pair_of_tractions_that_is_not_found_states_it():
    with pytest.raises(ck.errors.ConvergenceError, match=r"use more PartialSlip\.pressing_steps"):
        pressed(coefficient=1e3, nu=0.0, pressing_steps=1)


def test_equal_bodies_are_not_coupled():
    steel = ck.Material(young_modulus=200 * GPa, poisson_ratio=0.3)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=steel),
            upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS), solid=steel),
        ),
        window=ck.Window(width=40 * um, periodic=False),
        loading=ck.Pressing(force=1.0),
        effects=(
            ck.HalfSpace(),
            ck.PartialSlip(coefficient=0.2, path=HALF, components=2, coupled=True),
        ),
    )
    part = ck.solve(ck.plan(scene, ck.Accuracy(grid=24))).of(ck.PartialSlip)
    assert part.coupling is None


@pytest.mark.parametrize(
    ("choices", "message"),
    [
        ({"components": 1}, "components=2 with coupled=True"),
    ],
)
def test_what_coupling_needs_is_stated(choices, message):
    with pytest.raises(ck.errors.PlanError, match=message):
        pressed(**choices)
