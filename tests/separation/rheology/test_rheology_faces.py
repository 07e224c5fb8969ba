"""Films of any flow law on faces that are no even discs, against closed forms and quadrature."""

from __future__ import annotations

import math

import attrs
import numpy as np
import pytest
from films import BARUS, CARREAU, ETA, EYRING, POWER, RIM, ROELANDS, face_scene
from refusals import refuses
from scipy.integrate import quad
from scipy.optimize import brentq

import contactkit as ck
from contactkit.errors import InfeasibleError
from contactkit.liquids.rheology.shear import PowerLawViscosity
from contactkit.lubrication.flow_laws import on_grid, unit_flow
from contactkit.lubrication.flow_laws.squeeze import squeeze_force
from contactkit.lubrication.flow_laws.walls import Paraboloid
from contactkit.separation.rheology.correction import Correction

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

ALL = ck.ViscousForce(rheology="all")
ROUND = ck.Flat(planform=ck.Ellipse(semi_axes=(RIM, RIM)))  # no disc to the scene, but one
SQUARE = ck.Flat(planform=ck.Rectangle(length=2 * RIM, width=2 * RIM))
DRAFT = ck.Accuracy(film_rtol=1e-2)
SHAKEN = ck.ImposedSpeed(
    speed=1e-4,
    initial_gap=4e-6,
    final_gap=1e-5,
    vibration=ck.Vibration(amplitude=1e-6, frequency=300.0),
)


def plan_of(face, accuracy=None, loading=None, **liquid):
    return ck.plan(face_scene(face, ALL, loading=loading, **liquid), accuracy)


def film_of(plan):
    return plan.prepared.rheology.film.film


def force(plan, gap, speed=1e-3):
    """Force [N] of one solution, without a table."""
    return film_of(plan).solved_force(gap, speed)


def over_radius(law, height, inner=0.0, turn=0.0):
    """Force [N] of a flux (r - turn^2/r)/2 per speed, by parts: pi r^2 times the gradient."""

    def ring(r):
        return math.pi * r**2 * law.gradient(0.5e-3 * (r - turn**2 / r), height(r))

    return sum(quad(ring, a, b, epsrel=1e-8)[0] for a, b in ((inner, 0.5 * RIM), (0.5 * RIM, RIM)))


# Faces whose flux the volume fixes -------------------------------------------------------------


@pytest.mark.parametrize(
    "liquid",
    [{"shear_viscosity": EYRING}, {"shear_viscosity": POWER}, {"pressure_viscosity": BARUS}],
    ids=["eyring", "power law", "barus"],
)
def test_a_disc_as_a_planform_is_the_disc(liquid):
    found, disc = (plan_of(face, **liquid) for face in (ROUND, ck.Flat(radius=RIM)))
    assert film_of(found).error < 1.5e-3
    for gap in (6e-6, 2e-6):
        expected = film_of(disc).force(gap, 1e-3)
        assert force(found, gap) == pytest.approx(expected, rel=1e-3)
    assert abs(expected / film_of(found).linear_force(gap, 1e-3) - 1.0) > 1e-2
    assert next(iter(liquid.values())).cite in found.cite()


@pytest.mark.slow
@pytest.mark.parametrize("loading", [None, SHAKEN], ids=["opens", "closes"])
@pytest.mark.parametrize(
    "liquid",
    [
        {"shear_viscosity": EYRING, "pressure_viscosity": BARUS},
        {"shear_viscosity": CARREAU, "slip_length_lower": 1e-6},
        {"shear_viscosity": POWER, "pressure_viscosity": ROELANDS},
    ],
    ids=["eyring and barus", "carreau and slip", "power law and roelands"],
)
def test_a_disc_as_a_planform_with_all_at_once(liquid, loading):
    faces = ROUND, ck.Flat(radius=RIM)
    found, disc = (plan_of(face, DRAFT, loading, **liquid) for face in faces)
    speed = 1e-3 if loading is None else -1e-3
    for gap in (2e-6, 9e-6) if loading is None else (3.2e-6, 5e-6):
        expected = film_of(disc).force(gap, speed)
        assert force(found, gap, speed) == pytest.approx(expected, rel=3e-3)


def test_a_dome_of_a_liquid_that_thins_slips_and_thickens():
    liquid = {"shear_viscosity": EYRING, "slip_length_lower": 5e-7}
    plan = plan_of(ck.Flat(radius=RIM, crown_radius=5e-2), DRAFT, **liquid)
    for gap in (2e-6, 8e-6):
        expected = squeeze_force(film_of(plan).law, Paraboloid(radius=5e-2), gap, 1e-3, RIM)
        assert force(plan, gap) == pytest.approx(expected, rel=3e-3)


@pytest.mark.parametrize(
    "liquid", [{"shear_viscosity": POWER}, {"slip_length_lower": 1e-6}], ids=["power law", "slip"]
)
def test_a_recess_shares_out_the_gap(liquid):
    recess = ck.Recess(shape=ck.Disc(radius=0.5 * RIM), depth=2e-5)
    plan = plan_of(ck.Flat(radius=RIM, recesses=(recess,)), DRAFT, **liquid)
    for gap in (2e-6, 8e-6):
        expected = over_radius(film_of(plan).law, lambda r, h=gap: h + 2e-5 * (r < 0.5 * RIM))
        assert force(plan, gap) == pytest.approx(expected, rel=3e-3)


def test_slip_on_a_tilted_face_is_that_of_a_wider_gap():
    """Far below the slip length of both walls the flux is b h^2/(2 eta) for h^3/(12 eta)."""
    tilted = attrs.evolve(SQUARE, tilt=(1e-3, 0.0))
    slips = plan_of(tilted, DRAFT, slip_length_lower=1e-2, slip_length_upper=1e-2)
    gap, x = 2e-6, np.linspace(-RIM, RIM, 2001)
    assert slips.film.laws[ck.ViscousForce].rate == "proportional"
    # Between an even face at the mean gap and one at the smallest, by the same law.
    mean = 6e-2 / (gap + 1e-3 * RIM)
    even = ck.plan(face_scene(SQUARE)).force(gap + 1e-3 * RIM, 1e-3) / mean
    ratio = float((1.0 / (gap + 1e-3 * (x + RIM)) ** 2).mean()) * (gap + 1e-3 * RIM) ** 2
    assert 1.0 < force(slips, gap) / even < ratio


# Faces whose flux the law decides --------------------------------------------------------------


def test_a_vented_ring_by_the_radius_without_flux():
    hole = 0.3 * RIM
    ring = ck.Flat(planform=ck.Ring(radius=RIM, hole_radius=hole))
    plan = plan_of(ring, shear_viscosity=EYRING)
    law = film_of(plan).law
    for gap in (2e-6, 5e-6):
        r = np.linspace(hole, RIM, 8001)

        def drop(turn, h=gap, r=r):
            return float(np.trapezoid(law.gradient(0.5e-3 * (r - turn**2 / r), h), r))

        turn = brentq(drop, 1.01 * hole, 0.99 * RIM)
        expected = over_radius(law, lambda r, h=gap: h, hole, turn)
        assert force(plan, gap) == pytest.approx(expected, rel=1.5e-3)


def test_the_middle_of_a_long_rectangle_is_a_slot():
    """What a length adds is twice the integral of x g(v x) over half the width."""
    law = PowerLawViscosity(exponent=0.6, critical_rate=1e-2)
    width, gap, forces = 0.5 * RIM, 3e-6, []
    for length in (3.0, 5.0):
        face = ck.Flat(planform=ck.Rectangle(length=length * width, width=width))
        plan = plan_of(face, shear_viscosity=law)
        forces.append(force(plan, gap))
    gradient = film_of(plan).law.gradient
    slot, _ = quad(lambda x: 2.0 * x * gradient(1e-3 * x, gap), 0.0, 0.5 * width, epsrel=1e-9)
    assert (forces[1] - forces[0]) / (2.0 * width) == pytest.approx(slot, rel=3e-3)


@pytest.mark.slow
@pytest.mark.parametrize("tilt", [0.0, 1e-3])
def test_a_square_is_that_of_a_fine_grid(tilt):
    face = attrs.evolve(SQUARE, tilt=(tilt, 0.0))
    plan = plan_of(face, DRAFT, shear_viscosity=EYRING)
    film, forces = film_of(plan), []
    for cells in (32, 64):
        grid = film._grid(cells)
        args = grid.face, film.law, grid.relief + 2e-6, 1e-3
        forces.append(on_grid.solve_on_grid(*args, rtol=1e-5).force)
    expected = forces[1] + (forces[1] - forces[0]) / 3.0
    assert force(plan, 2e-6) == pytest.approx(expected, rel=4e-3)


# Limits, numbers, cost -------------------------------------------------------------------------


def test_limits_of_slow_and_of_fast_openings():
    film = film_of(plan_of(SQUARE, DRAFT, shear_viscosity=POWER))
    plain = ck.plan(face_scene(SQUARE, ALL))
    assert film.force(3e-6, 1e-9) == pytest.approx(plain.force(3e-6, 1e-9), rel=1e-9)
    fast, faster = film.force(3e-6, 1e-1), film.force(3e-6, 1.0)
    assert math.log10(faster / fast) == pytest.approx(POWER.exponent, abs=2e-3)
    assert film.force(3e-6, 0.0) == 0.0
    assert film.force(3e-6, -1e-3) == pytest.approx(-film.force(3e-6, 1e-3), rel=1e-9)


def test_a_film_cannot_close_faster_than_any_pressure_drives_it():
    plan = plan_of(SQUARE, DRAFT, loading=SHAKEN, pressure_viscosity=BARUS)
    onset = plan.prepared.face_film.onset(3e-6)
    fastest = 1.0 / (BARUS.pressure_coefficient * ETA * onset)
    assert np.isfinite(plan.force(3e-6, -0.9 * fastest))
    with pytest.raises(InfeasibleError, match="cannot close"):
        plan.force(3e-6, -1.1 * fastest)


def test_errors_of_grid_and_table_are_numbers_of_a_run(monkeypatch):
    """Within 150 linear solutions, where a table of solved forces took thousands."""
    count = []
    for module in (on_grid, unit_flow):
        solve = module.unchecked_pressure

        def counted(*given, solve=solve, **more):
            count.append(1)
            return solve(*given, **more)

        monkeypatch.setattr(module, "unchecked_pressure", counted)
    plan = plan_of(SQUARE, DRAFT, shear_viscosity=EYRING)
    result = ck.simulate(plan)
    assert 0 < len(count) < 150
    numbers = {number.name: number for number in result.validity}
    grid = numbers["error of the rheology on its grid"]
    assert 1e-6 < grid.value < 1e-2
    assert grid.high == pytest.approx(2e-2)
    assert numbers["error of the film in its table"].value < 1e-3
    # It is an upper bound of what the standard accuracy changes.
    fine = force(plan_of(SQUARE, shear_viscosity=EYRING), 2e-6)
    assert abs(plan.force(2e-6, 1e-3) / fine - 1.0) < 2.0 * grid.value


@pytest.mark.slow
def test_corrections_between_their_points_open_and_close():
    """Of Eyring's law with Barus', whose forces differ by 4 % in both directions."""
    both = {"shear_viscosity": EYRING, "pressure_viscosity": BARUS}
    film = film_of(plan_of(SQUARE, DRAFT, SHAKEN, **both))
    forces = []
    for speed in (1e-3, -1e-3):
        forces.append(film.force(3.7e-6, speed))
        assert forces[-1] == pytest.approx(film.solved_force(3.7e-6, speed), rel=1e-3)
    assert -forces[1] > 1.03 * forces[0]


def test_what_a_face_leaves_out_is_stated_for_that_face():
    """A strip five times as long as wide has less pressure than a disc of its area."""
    face = ck.Flat(planform=ck.Rectangle(length=2 * RIM, width=0.4 * RIM))
    changes = [
        ck.plan(face_scene(one, pressure_viscosity=BARUS)).prepared.rheology.changes
        for one in (face, ck.Flat(radius=math.sqrt(0.8 / math.pi) * RIM))
    ]
    small, large = (one["pressure_viscosity"] for one in changes)
    assert 0.1 * large < small < 0.6 * large


def test_points_of_a_correction_are_evaluated_once():
    asked = []

    def cubic(gap, rate):
        asked.append((gap, rate))
        return math.log(gap) * math.log(rate) ** 3

    made = Correction(cubic)
    for rate in (25.0, 28.0, 30.0):
        expected = math.log(2e-6) * math.log(rate) ** 3
        assert made(2e-6, rate) == pytest.approx(expected, rel=1e-12)
    assert len(asked) == len(set(asked)) == 16


# Refusals --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "more",
    [
        {"relief": ck.Wave(amplitude=1e-7, wavelength=1e-3)},
        {
            "roughness": ck.FineRoughness(
                surface=ck.Wave(amplitude=1e-7, wavelength=2e-5), width=2e-5, pixels=16
            )
        },
    ],
    ids=["relief", "roughness"],
)
def test_rough_faces_are_refused(more):
    face = attrs.evolve(SQUARE, **more)
    refuses(
        lambda: ck.plan(face_scene(face, ALL, shear_viscosity=EYRING), DRAFT),
        "ViscousForce knows viscosity over shear",
        "not with FineRoughness, a relief",
        'ViscousForce(rheology="newtonian") leaves it out',
        error=ck.PlanError,
    )


def test_a_cavity_that_is_followed_is_refused():
    scene = face_scene(SQUARE, ALL, ck.TensionLimit(strength=1e6), shear_viscosity=EYRING)
    refuses(
        lambda: ck.plan(scene, DRAFT),
        'TensionLimit(cavity="mass-conserving") knows the edge of a cavity in a Newtonian film',
        error=ck.PlanError,
    )
