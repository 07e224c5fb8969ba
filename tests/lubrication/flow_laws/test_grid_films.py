"""Films of any flow law on a grid: closed forms, films whose flux is not given, energy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve
from scipy.optimize import brentq, minimize

import contactkit as ck
from contactkit.errors import DescriptionError, InfeasibleError
from contactkit.lubrication import reynolds
from contactkit.lubrication.flow_laws.carreau import Carreau
from contactkit.lubrication.flow_laws.closed_forms import barus_disc_force, power_law_disc_force
from contactkit.lubrication.flow_laws.eyring import Eyring
from contactkit.lubrication.flow_laws.newtonian import Newtonian
from contactkit.lubrication.flow_laws.on_grid import solve_on_grid
from contactkit.lubrication.flow_laws.power_law import PowerLaw
from contactkit.lubrication.flow_laws.pressure_laws import Barus, Roelands
from contactkit.lubrication.flow_laws.squeeze import squeeze_force
from contactkit.lubrication.flow_laws.walls import Paraboloid

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

R, GAP, SPEED = 3e-3, 1e-5, 1e-3
OIL = Newtonian(viscosity=0.1)
DISC = reynolds.rasterise(ck.Disc(radius=R), 64)
BARUS = Barus(coefficient=2e-7)


def strip(cells):
    """A slot of unit half width that is endless along y."""
    mask = np.pad(np.ones((2, cells), bool), ((0, 0), (1, 1)))
    return reynolds.face_from_mask(mask, 2.0 / cells, periodic=(True, False))


def test_the_newtonian_film_is_that_of_the_linear_solver():
    face = reynolds.rasterise(ck.Rectangle(length=4e-3, width=2e-3), 32)
    gap = 1e-5 + 0.3 * face.x**2 + 0.0 * face.y
    plain = reynolds.solve_pressure(reynolds.GridFilm(face=face, viscosity=0.1), gap, SPEED)
    film = solve_on_grid(face, OIL, gap, SPEED)
    assert film.iterations == 1
    assert film.pressure == pytest.approx(plain.pressure, rel=1e-10, abs=1e-9)
    assert film.force == pytest.approx(plain.force, rel=1e-12)


@pytest.mark.parametrize("exponent", [0.3, 0.6, 1.5])
def test_a_slot_of_a_power_law_has_a_closed_form(exponent):
    """Flux v x: the gradient is a power of x, the force per length 2 g(1)/(n + 2)."""
    law, errors = PowerLaw(consistency=0.5, exponent=exponent), []
    expected = 2.0 * law.gradient(SPEED, 1e-2) / (exponent + 2.0)
    for cells in (20, 40):
        face = strip(cells)
        found = solve_on_grid(face, law, 1e-2, SPEED).force / (2 * face.pixel_size[0])
        errors.append(abs(found / expected - 1.0))
    assert errors[1] < 4e-3
    assert errors[0] / errors[1] > 3.0  # second order


@pytest.mark.parametrize("exponent", [0.3, 0.5, 1.5])
def test_a_disc_of_a_power_law_is_that_of_scott(exponent):
    law = PowerLaw(consistency=0.1, exponent=exponent)
    film = solve_on_grid(DISC, law, GAP, SPEED)
    expected = power_law_disc_force(R, GAP, SPEED, 0.1, exponent)
    assert film.force == pytest.approx(expected, rel=1.5e-3)
    assert film.dissipation == pytest.approx(film.force * SPEED, rel=1e-10)


def test_barus_between_discs_is_one_solution():
    film = solve_on_grid(DISC, evolve(OIL, pressure_law=BARUS), GAP, SPEED)
    assert film.iterations == 1
    assert film.force == pytest.approx(barus_disc_force(R, GAP, SPEED, 0.1, 2e-7), rel=2e-4)


@pytest.mark.slow
@pytest.mark.parametrize("closes", [False, True])
def test_a_dome_of_a_carreau_liquid_with_slip_and_roelands(closes):
    law = Carreau(
        viscosity=0.1,
        relaxation_time=1e-3,
        exponent=0.4,
        slip_length=(0.0, 2e-6),
        pressure_law=Roelands(viscosity=0.1, exponent=0.6),
    )
    speed = -SPEED if closes else SPEED
    film = solve_on_grid(DISC, law, GAP + (DISC.x**2 + DISC.y**2) / 0.6, speed)
    expected = squeeze_force(law, Paraboloid(radius=0.3), GAP, speed, R)
    assert film.force == pytest.approx(expected, rel=3e-3)


@pytest.mark.parametrize(
    "law", [PowerLaw(consistency=0.5, exponent=0.4), Eyring(viscosity=0.1, eyring_stress=2e4)]
)
def test_the_flux_of_a_ring_depends_on_the_law(law):
    """A vented ring: from the radius without flux inwards and outwards the pressure falls alike."""
    hole = 0.3 * R

    radius = np.linspace(hole, R, 4001)
    width = radius[1] - radius[0]

    def gradient(turn):
        return law.gradient(0.5 * SPEED * (radius - turn * turn / radius), GAP)

    def drop(turn):
        return float(np.trapezoid(gradient(turn), dx=width))

    turn = brentq(drop, 1.01 * hole, 0.99 * R)
    # By parts: the pressure is that of the reservoirs at both rims.
    expected = np.trapezoid(math.pi * radius**2 * gradient(turn), dx=width)
    face = reynolds.rasterise(ck.Ring(radius=R, hole_radius=hole), 96)
    assert solve_on_grid(face, law, GAP, SPEED).force == pytest.approx(expected, rel=6e-3)


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [0.5, 1.4])
def test_a_square_minimises_the_potential_of_its_pressure(exponent):
    """Finite elements on triangles and a quasi-Newton method, both with nothing in common."""
    law = PowerLaw(consistency=1.0, exponent=exponent)
    power = 1.0 + 1.0 / exponent
    unit = law.flux(1.0, 1.0)  # flux is unit g^(1/n)

    def reference(cells):
        size = 1.0 / cells
        inner = np.zeros((cells + 1, cells + 1), bool)
        inner[1:-1, 1:-1] = True

        def energy(free):
            p = np.zeros(inner.shape)
            p[inner] = free
            total, slope = 0.0, np.zeros_like(p)
            low, high = slice(None, -1), slice(1, None)
            # Triangles with their right angles at both ends of a diagonal, both diagonals.
            for y0, y1 in ((low, high), (high, low)):
                for x0, x1 in ((low, high), (high, low)):
                    dx, dy = p[y0, x1] - p[y0, x0], p[y1, x0] - p[y0, x0]
                    square = (dx * dx + dy * dy) / size**2 + 1e-30
                    weight = 0.25 * size * size
                    total += weight * unit * (square ** (0.5 * power)).sum() / power
                    by = weight * unit * square ** (0.5 * power - 1.0) / size**2
                    slope[y0, x1] += by * dx
                    slope[y1, x0] += by * dy
                    slope[y0, x0] -= by * (dx + dy)
            return total - free.sum() * size**2, (slope - size**2)[inner]

        start = np.full(int(inner.sum()), 0.1)
        options = {"maxiter": 20000, "maxfun": 40000, "ftol": 1e-15, "gtol": 1e-10}
        found = minimize(energy, start, jac=True, method="L-BFGS-B", options=options)
        return found.x.sum() * size**2

    coarse, fine = reference(16), reference(32)
    expected = fine + (fine - coarse) / 3.0
    face = reynolds.rasterise(ck.Rectangle(length=1.0, width=1.0), 64)
    assert solve_on_grid(face, law, 1.0, 1.0).force == pytest.approx(expected, rel=4e-3)


def test_flow_between_two_reservoirs_follows_the_law():
    """A slot with a pressure at one end and a gap at rest: q of the gradient 1e5/2."""
    face = strip(40)
    pressure = np.where(face.x < 0.5 * face.pixel_size[1], 1e5, 0.0) + 0.0 * face.y
    face = evolve(face, pressure=np.where(face.loaded, 0.0, pressure))
    law = PowerLaw(consistency=0.5, exponent=0.4)
    film = solve_on_grid(face, law, 1e-2, 0.0)
    assert film.flux[face.loaded] == pytest.approx(law.flux(5e4, 1e-2), rel=1e-6)
    assert film.force == pytest.approx(-5e4 * 2.0 * 2.0 * face.pixel_size[0], rel=1e-9)


def test_the_strength_of_the_liquid_is_the_floor_of_its_pressure():
    law = PowerLaw(consistency=0.1, exponent=0.5)
    free, bound = (solve_on_grid(DISC, law, GAP, SPEED, drop=drop) for drop in (math.inf, 1e3))
    assert -float(free.pressure.min()) > 5e3
    assert float(bound.pressure.min()) == pytest.approx(-1e3, rel=1e-9)
    assert bound.force < free.force


def test_a_film_at_rest_has_no_force():
    film = solve_on_grid(DISC, PowerLaw(consistency=0.1, exponent=0.5), GAP, 0.0)
    assert film.force == film.dissipation == 0.0
    assert (film.flux == 0.0).all()


def test_a_closing_film_that_no_pressure_carries_is_refused():
    law = evolve(OIL, pressure_law=BARUS)
    with pytest.raises(InfeasibleError, match="close more slowly"):
        solve_on_grid(DISC, law, GAP, -0.01)
    with pytest.raises(DescriptionError, match="gap"):
        solve_on_grid(DISC, law, 0.0, SPEED)
