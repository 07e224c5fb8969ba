"""Films of any flow law from the flux of a Newtonian one: where it is exact, and what it leaves."""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.lubrication import reynolds
from contactkit.lubrication.flow_laws.closed_forms import barus_disc_force
from contactkit.lubrication.flow_laws.eyring import Eyring
from contactkit.lubrication.flow_laws.newtonian import Newtonian
from contactkit.lubrication.flow_laws.on_grid import solve_on_grid
from contactkit.lubrication.flow_laws.power_law import PowerLaw
from contactkit.lubrication.flow_laws.pressure_laws import Barus, Roelands
from contactkit.lubrication.flow_laws.squeeze import squeeze_force
from contactkit.lubrication.flow_laws.unit_flow import solution_ratio, tensions, unit_flow
from contactkit.lubrication.flow_laws.walls import Flats

R, GAP, SPEED = 3e-3, 1e-5, 1e-3
OIL = Newtonian(viscosity=0.1)
SQUARE = reynolds.rasterise(ck.Rectangle(length=2 * R, width=2 * R), 32)
EVEN = np.full(SQUARE.shape, GAP)


def estimate(face, law, gap, speed=SPEED):
    """Force [N] from the flux."""
    flow = unit_flow(face, gap, law.slip_length)
    return float((tensions(flow, law, 0.1, np.array([speed])) @ flow.area)[0])


def slot(cells):
    """A slot of unit half width that is endless along y."""
    mask = np.pad(np.ones((2, cells), bool), ((0, 0), (1, 1)))
    return reynolds.face_from_mask(mask, 2.0 / cells, periodic=(True, False))


@pytest.mark.parametrize(
    "law",
    [
        PowerLaw(consistency=0.5, exponent=0.3),
        PowerLaw(consistency=0.5, exponent=1.5),
        Eyring(viscosity=0.1, eyring_stress=0.05),
    ],
    ids=["thins", "thickens", "eyring"],
)
def test_a_slot_needs_no_correction_on_any_grid(law):
    """Its flux v x is that of the volume; the force is twice the integral of x g(v x)."""
    x = (np.arange(20000) + 0.5) / 20000
    expected = 2.0 * float((x * law.gradient(SPEED * x, 1e-2)).mean())
    errors = []
    for cells in (10, 40):
        face = slot(cells)
        gap = np.full(face.shape, 1e-2)
        assert solution_ratio(unit_flow(face, gap), law, gap, SPEED) == pytest.approx(1, abs=1e-6)
        found = estimate(face, law, gap) / (2 * face.pixel_size[0])
        errors.append(abs(found / expected - 1.0))
    assert errors[1] < 2e-3
    assert errors[1] < 0.3 * errors[0]


def test_a_stepped_slot_needs_none_either():
    face = slot(40)
    gap = np.where(np.abs(face.x - face.x.mean()) < 0.5, 3e-2, 1e-2) + 0.0 * face.y
    law = PowerLaw(consistency=0.5, exponent=0.5, slip_length=2e-3)
    x = (np.arange(20000) + 0.5) / 20000
    g = law.gradient(SPEED * x, np.where(x < 0.5, 3e-2, 1e-2))
    expected = 2.0 * float((x * g).mean())
    assert estimate(face, law, gap) / (2 * face.pixel_size[0]) == pytest.approx(expected, rel=4e-3)


@pytest.mark.parametrize("exponent", [0.3, 0.6, 1.5])
def test_the_flux_of_a_newtonian_film_bounds_the_force_of_a_power_law(exponent):
    """Its power is (n + 1) times the least complementary energy."""
    law = PowerLaw(consistency=0.1, exponent=exponent)
    ratio = solution_ratio(unit_flow(SQUARE, EVEN), law, EVEN, SPEED)
    assert 0.98 < ratio < 1.0 - 1e-3
    # On one grid both are what they are without a Newtonian flux.
    solved = solve_on_grid(SQUARE, law, GAP, SPEED)
    assert ratio * estimate(SQUARE, law, EVEN) == pytest.approx(solved.force, rel=5e-3)


@pytest.mark.parametrize("speed", [SPEED, -SPEED], ids=["opens", "closes"])
@pytest.mark.parametrize(
    "law", [Barus(coefficient=1e-7), Roelands(viscosity=0.1, exponent=3.0)], ids=["barus", "roel."]
)
def test_a_viscosity_over_pressure_is_exact_with_slip_on_a_tilted_face(law, speed):
    liquid = evolve(OIL, pressure_law=law, slip_length=(0.0, 1e-6))
    gap = GAP + 2e-3 * (SQUARE.x + R) + 0.0 * SQUARE.y
    solved = solve_on_grid(SQUARE, liquid, gap, 2.0 * speed).force
    assert estimate(SQUARE, liquid, gap, 2.0 * speed) == pytest.approx(solved, rel=1e-4)
    plain = solve_on_grid(SQUARE, evolve(liquid, pressure_law=None), gap, 2.0 * speed).force
    assert abs(solved / plain - 1.0) > 0.02


def test_barus_between_discs_and_its_fastest_closing():
    face = reynolds.rasterise(ck.Disc(radius=R), 64)
    law, gap = evolve(OIL, pressure_law=Barus(coefficient=2e-7)), np.full(face.shape, GAP)
    expected = barus_disc_force(R, GAP, SPEED, 0.1, 2e-7)
    assert estimate(face, law, gap) == pytest.approx(expected, rel=3e-4)
    fastest = GAP**3 / (2e-7 * 3.0 * 0.1 * R**2)
    assert math.isfinite(estimate(face, law, gap, -0.98 * fastest))
    assert estimate(face, law, gap, -1.02 * fastest) == -math.inf


@pytest.mark.parametrize("speed", [SPEED, -SPEED], ids=["opens", "closes"])
def test_barus_beside_a_power_law_between_discs(speed):
    """The integral of dp/M^n is the pressure of the power law alone, nearly that of a parabola."""
    face = reynolds.rasterise(ck.Disc(radius=R), 64)
    law = PowerLaw(consistency=1.0, exponent=0.5, pressure_law=Barus(coefficient=2e-6))
    expected = squeeze_force(law, Flats(), GAP, speed, R)
    plain = squeeze_force(evolve(law, pressure_law=None), Flats(), GAP, speed, R)
    assert abs(expected / plain - 1.0) > 0.02
    found = estimate(face, law, np.full(face.shape, GAP), speed)
    assert found == pytest.approx(expected, rel=5e-3)


def test_the_factor_of_a_pressure_to_a_power():
    for law in (Barus(coefficient=2e-8), Roelands(viscosity=0.1, exponent=0.6)):
        for pressure in (-3e7, 2e8):
            expected = law.multiplier(pressure) ** 0.4
            assert law.to_power(0.4).multiplier(pressure) == pytest.approx(expected, rel=1e-12)
