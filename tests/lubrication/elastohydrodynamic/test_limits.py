"""Films between deforming bodies: closed forms, conservation of liquid and energy, hard numbers."""

import math

import numpy as np
import pytest

from contactkit.capillary import elastic_bridge
from contactkit.elasticity import rings
from contactkit.lubrication import squeeze_film
from contactkit.lubrication.elastohydrodynamic import response
from contactkit.lubrication.elastohydrodynamic.drive import Driven, Imposed
from contactkit.lubrication.elastohydrodynamic.mesh import RingMesh, disc_nodes, graded_nodes
from contactkit.lubrication.elastohydrodynamic.motion import Phase, SmoothGap, move
from contactkit.lubrication.elastohydrodynamic.step import StepFailedError

R, GAP, ETA, SPEED = 5e-3, 1e-6, 0.1, 1e-5
WIDTH = math.sqrt(R * GAP)
RIGID = 6.0 * math.pi * ETA * R**2 * SPEED / GAP


def half_space(modulus):
    if math.isinf(modulus):
        return lambda nodes: np.zeros((len(nodes), len(nodes)))
    return lambda nodes: rings.half_space_matrix(nodes) / modulus


def modulus_of(beta):
    return ETA * SPEED * R**1.5 / (beta * GAP**2.5) if beta else math.inf


def sphere(beta, **given):
    film = {"radius": R, "rim": 8.0 * WIDTH, "gap": GAP, "viscosity": ETA, **given}
    return SmoothGap(compliance=half_space(modulus_of(beta)), **film)


def opening(times, speed=SPEED):
    drive = Imposed(lambda t: GAP + speed * t)
    return [Phase(lambda *_: drive, times)]


def rigid_force(gap, rim):
    """Of a sphere with ambient pressure at a rim, by Reynolds' equation."""
    end = gap + rim**2 / (2.0 * R)
    share = 1.0 / gap - 1.0 / end - (end - gap) / end**2
    return 6.0 * math.pi * ETA * R**2 * SPEED * share


def test_rigid_sphere_is_that_of_reynolds():
    found = move(sphere(0.0), opening([0.05, 0.1]), speed=SPEED)
    expected = [rigid_force(h, 8.0 * WIDTH) for h in found.columns["gap"][1:]]
    assert found.columns["pull"][1:] == pytest.approx(expected, rel=1e-4)
    # Without a rim: the law of the rigid engine.
    wide = move(sphere(0.0, rim=200.0 * WIDTH), opening([0.05]), speed=SPEED, elements=80)
    h = wide.columns["gap"][-1]
    law = squeeze_film.sphere_force(R, h, math.inf, SPEED, ETA)
    assert wide.columns["pull"][-1] == pytest.approx(law, rel=6e-4)


@pytest.mark.parametrize(("beta", "part", "time"), [(0.01, 0.843, 0.142), (1.0, 0.369, 2.59)])
def test_pull_off_force_over_that_of_rigid_bodies(beta, part, time):
    """Largest force of a pull from rest at constant speed, of a flooded sphere."""
    times = np.linspace(0.0, 2.0 * time, 41)[1:] * GAP / SPEED
    found = move(sphere(beta), opening(times), speed=SPEED)
    pull = found.columns["pull"]
    assert pull.max() / RIGID == pytest.approx(part, rel=6e-3)
    at = found.columns["time"][pull.argmax()] * SPEED / GAP
    assert at == pytest.approx(time, rel=0.06)


@pytest.mark.slow
def test_gap_shrinks_while_it_is_pulled():
    """At beta = 10 to 0.670 of its start, the value of 192 elements; no rigid model has it."""
    times = np.linspace(0.8, 0.95, 16)
    found = move(sphere(10.0), opening(times), speed=SPEED, elements=96)
    # The last of it is snap-off, whose time moves with the mesh: there gaps converge slowly.
    assert found.columns["centre_gap"].min() / GAP == pytest.approx(0.670, abs=1e-2)
    assert found.columns["centre_gap"][-1] > GAP


def test_liquid_is_conserved_by_a_moving_rim():
    wetting = 0.01
    film = sphere(0.2, rim=2.0 * WIDTH, wetting=wetting)
    found = move(film, opening([0.1, 0.2]), speed=SPEED)
    liquid = found.columns["liquid_volume"]
    assert np.ptp(liquid) < 1e-12 * liquid[0]


def test_slow_bridge_passes_through_its_statics():
    """At a ten-thousandth of the speed the force is that of the closed form."""
    slow, wetting = 1e-4 * SPEED, 0.01
    film = sphere(0.05, rim=2.0 * WIDTH, wetting=wetting)
    found = move(film, opening([0.5 * GAP / slow, GAP / slow], slow), speed=slow)
    E, volume = modulus_of(0.05), float(found.columns["liquid_volume"][0])
    for gap, pull in zip(found.columns["gap"], found.columns["pull"], strict=True):
        static = elastic_bridge.bridge_of_volume(float(gap), volume, R, E, wetting)
        assert pull == pytest.approx(static.force, rel=4e-4)


@pytest.mark.slow
def test_energy_of_a_cycle_is_dissipated():
    """Of work, dissipation and elastic energy, over a cycle that ends where it began."""
    period = 4.0 * GAP / SPEED
    wave = Imposed(lambda t: GAP * (1.0 + 0.6 * math.sin(2.0 * math.pi * t / period)))
    film = sphere(0.3)
    times = np.linspace(0.0, 2.0 * period, 65)[1:]
    found = move(film, [Phase(lambda *_: wave, times)], speed=SPEED)
    work, lost = found.columns["work"], found.columns["dissipated_energy"]
    stored = found.columns["elastic_energy"]
    assert work[-1] > 0.0
    assert work == pytest.approx(lost + stored - stored[0], abs=2e-3 * lost[-1])


@pytest.mark.slow
def test_rest_ends_in_the_contact_of_hertz():
    """F = (4/3) E* sqrt(R) (h_c - z)^1.5, without any pressure of the film."""
    beta, cutoff, low = 0.1, 0.3 * GAP, -0.5 * GAP
    film = sphere(beta, cutoff=cutoff)
    end = (GAP - low) / SPEED
    phases = [
        Phase(lambda *_: Imposed(lambda t: GAP - SPEED * t), [end]),
        Phase(lambda *_: Imposed(lambda t: low), [1e4 * end]),
    ]
    found = move(film, phases, speed=SPEED, elements=32)
    hertz = 4.0 / 3.0 * modulus_of(beta) * math.sqrt(R) * (cutoff - low) ** 1.5
    assert found.columns["contact_force"][-1] == pytest.approx(hertz, rel=3e-3)
    assert abs(found.columns["film_force"][-1]) < 1e-9 * hertz


def test_first_instant_of_a_flat_that_cavitates():
    """4 k dp/(v R^2) = 1 - x^2 + 2 x^2 ln x at the edge of the cavity of a rigid disc."""
    x = 0.5
    speed, gap, radius = 1e-5, 1e-6, 1e-3
    mobility = gap**3 / (12.0 * ETA)
    tension = speed * radius**2 * (1.0 - x**2 + 2.0 * x**2 * math.log(x)) / (4.0 * mobility)
    film = SmoothGap(math.inf, radius, gap, ETA, half_space(math.inf), cavity=tension)
    drive = Imposed(lambda t: gap + speed * t)
    found = move(film, [Phase(lambda *_: drive, [1e-5 * gap / speed])], speed=speed, elements=96)
    section = found.profiles[-1]
    cavity = section.radius[section.film_pressure <= -tension * (1.0 - 1e-9)]
    assert cavity.max() / radius == pytest.approx(x, abs=0.03)


@pytest.mark.hard
@pytest.mark.parametrize("beta", [1e-6, 1e6])
def test_extreme_stiffness(beta):
    """Stiff bodies give the rigid law; of soft ones that stay together the force is that of a pull
    on the whole face."""
    found = move(sphere(beta), opening([0.05, 0.1]), speed=SPEED)
    pull = found.columns["pull"]
    assert np.isfinite(pull).all()
    if beta < 1.0:
        expected = rigid_force(found.columns["gap"][-1], 8.0 * WIDTH)
        assert pull[-1] == pytest.approx(expected, rel=2e-4)
    else:
        assert found.columns["centre_gap"][-1] == pytest.approx(GAP, rel=1e-2)
        assert 0.0 < pull[-1] < 1e-3 * RIGID


@pytest.mark.hard
def test_gap_of_a_nanometre():
    film = SmoothGap(R, 8.0 * math.sqrt(R * 1e-9), 1e-9, ETA, half_space(1e9))
    drive = Driven(lambda _: 1e-4)
    found = move(film, [Phase(lambda *_: drive, [1e3], until=1e-8)], speed=1e-12)
    assert found.columns["smallest_gap"].min() > 0.0
    assert found.columns["pull"][1:] == pytest.approx(1e-4, rel=1e-9)


@pytest.mark.errors
def test_closing_gap_of_rigid_bodies_is_refused():
    with pytest.raises(StepFailedError):
        move(sphere(0.0), opening([0.11], -SPEED), speed=SPEED, elements=16)


def test_stiff_end_of_the_moduli():
    """G' = (27 pi^3/2^3.5) (eta omega)^2 R^3.5/(E* D^2.5) and G'' = 6 pi eta omega R^2/D."""
    nodes = graded_nodes(400, 400.0)
    args = (RingMesh(nodes), 1.0 + 0.5 * nodes**2, 1e-3 * rings.half_space_matrix(nodes))
    found = response.modulus(*args, 1.0, [1.0])[0]
    storage, loss = response.sphere_stiff_limit(1.0, 1.0, 1e3, 1.0, 1.0)
    assert found.real == pytest.approx(storage, rel=5e-3)
    assert found.imag == pytest.approx(loss, rel=1e-3)


def test_soft_end_of_the_moduli():
    """F ~ (i omega)^(1/3): a phase of 30 degrees, |G| = 5.48 E*^(2/3) (eta omega)^(1/3) R."""
    nodes = graded_nodes(200, 2e4)
    matrix = rings.half_space_matrix(nodes)
    mesh, gap = RingMesh(nodes), 1.0 + 0.5 * nodes**2
    coarse, fine = (response.modulus(mesh, gap, matrix, 1.0, [w])[0] for w in (1e5, 8e5))
    assert math.atan2(fine.imag, fine.real) == pytest.approx(math.pi / 6.0, rel=1e-3)
    assert abs(fine) / abs(coarse) == pytest.approx(2.0, rel=3e-3)


def test_stiff_end_of_a_flat():
    nodes = disc_nodes(100, 1.0)
    matrix = 1e-4 * rings.half_space_matrix(nodes)
    found = response.modulus(RingMesh(nodes), np.ones(101), matrix, 1.0, [1.0])[0]
    storage, loss = response.flat_stiff_limit(1.0, 1.0, 1e4, 1.0, 1.0)
    assert found.real == pytest.approx(storage, rel=1e-4)
    assert found.imag == pytest.approx(loss, rel=2e-4)


def test_hundred_frequencies_need_one_matrix():
    nodes = graded_nodes(60, 20.0)
    args = (RingMesh(nodes), 1.0 + 0.5 * nodes**2, rings.half_space_matrix(nodes), 1.0)
    rates = np.geomspace(1e-3, 1e3, 100)
    found = response.modulus(*args, rates)
    assert (found.real > 0.0).all()
    assert (found.imag > 0.0).all()
    # Of a passive system: the loss over the rate falls, the storage grows.
    assert (np.diff(found.real) > 0.0).all()
    assert (np.diff(found.imag / rates) < 0.0).all()
