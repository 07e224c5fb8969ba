"""Stress maxima of rough contacts: planes that follow the spots, their error, and friction."""

from __future__ import annotations

import functools

import attrs
import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.elasticity.stress.measures import von_mises

# Two and four pixels to the shortest wave are meant to be too few.
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

E, PIXEL = 100e9, 20e-6 / 512
SOLID = ck.Material(name="solid", young_modulus=E, poisson_ratio=0.3)
FILM = ck.Material(name="film", young_modulus=3 * E, poisson_ratio=0.25)
SCENE = ck.ContactScene(
    interface=ck.Interface(
        lower=ck.Body(
            solid=SOLID,
            surface=ck.GaussianRoughness(
                rms=1e-9, correlation_length=0.5e-6, cutoff=2.0 * PIXEL, seed=1
            ),
        )
    ),
    window=ck.Window(width=96 * PIXEL),
    loading=ck.Pressing(pressure=1e-5 * E),
    effects=(ck.LayeredHalfSpace(),),
)
MEASURES = ("von_mises", "sqrt_j2", "tension", "tresca", "sigma_xz")
COATED = ck.Stack(layers=(ck.Layer(material=FILM, thickness=30e-9),), substrate=SOLID)
BODIES = {"half-space": SOLID, "coated": COATED}


@functools.cache
def stress(body, mu, effect):
    lower = attrs.evolve(SCENE.interface.lower, solid=BODIES[body])
    scene = attrs.evolve(
        SCENE,
        interface=attrs.evolve(SCENE.interface, lower=lower),
        effects=(*SCENE.effects, ck.FrictionTraction(coefficient=mu), effect),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=96))).of(ck.SubsurfaceStress)


@pytest.mark.parametrize(
    ("body", "mu"),
    quick([("half-space", 0.3), ("coated", 0.0), ("half-space", 0.0), ("coated", 0.3)], 0, 1),
)
def test_maxima_stand_without_depths(body, mu):
    """Two pixels to the shortest wave: spots of one to three pixels, peaks some 10 nm deep."""
    found = stress(body, mu, ck.SubsurfaceStress(keep="planes"))
    dense = stress(body, mu, ck.SubsurfaceStress(depths=tuple(2e-9 * k for k in range(46))))
    assert len(found.depth) < 25
    for name in MEASURES:
        one, exact = found.maxima[name], dense.maxima[name].value
        assert one.error <= 0.01
        assert one.value == pytest.approx(exact, rel=0.02), name
    one = found.maxima["von_mises"]
    values = von_mises(found.planes)
    assert one.value == pytest.approx(values.max(), rel=1e-12)  # that of a pixel of a plane
    (plane,) = np.flatnonzero((found.depth == one.z) & (np.array(found.side) == one.side))
    row, column = round(one.y / PIXEL), round(one.x / PIXEL)
    assert values[plane, row, column] == pytest.approx(one.value, rel=1e-12)
    assert found.largest_von_mises[plane] == pytest.approx(one.value, rel=1e-12)


def test_a_smaller_tolerance_takes_more_planes():
    parts = [stress("half-space", 0.0, ck.SubsurfaceStress(tolerance=t)) for t in (0.1, 1e-3)]
    few, many = (len(part.depth) for part in parts)
    assert few < many < 64
    assert parts[1].maxima["von_mises"].error <= 1e-3


def test_distant_planes_say_how_little_they_know():
    part = stress("half-space", 0.0, ck.SubsurfaceStress(depths=(0.0, 8.7e-9, 34.7e-9, 78e-9)))
    one = part.maxima["von_mises"]
    assert one.value == part.largest_von_mises.max()
    assert one.error > 0.05


def test_further_coefficients_are_contacts_of_their_own():
    depths = (0.0, 5e-9, 2e-8, 6e-8)
    effect = ck.SubsurfaceStress(depths=depths)
    three = attrs.evolve(effect, coefficients=(0.0, 0.3, 0.5))
    part = stress("coated", 0.1, three)
    own = stress("coated", 0.1, effect).maxima
    assert {n: one.value for n, one in part.maxima.items()} == pytest.approx(
        {n: one.value for n, one in own.items()}, rel=1e-12
    )
    assert [one.coefficient for one in part.by_friction] == [0.0, 0.3, 0.5]
    for one in part.by_friction:
        alone = stress("coated", one.coefficient, effect).maxima
        assert set(one.maxima) == set(MEASURES)
        for name in MEASURES:
            assert one.maxima[name].value == pytest.approx(alone[name].value, rel=1e-9), name
            assert one.maxima[name][1:6] == alone[name][1:6], name


def test_planes_follow_the_size_of_the_contact():
    """A contact a thousand times as large, at the same pressure, has all its planes there."""
    large = attrs.evolve(
        SCENE.interface.lower.surface,
        rms=1e-6,
        correlation_length=0.5e-3,
        cutoff=2e3 * PIXEL,
    )
    small = stress("half-space", 0.0, ck.SubsurfaceStress())
    scene = attrs.evolve(
        SCENE,
        interface=ck.Interface(lower=ck.Body(solid=SOLID, surface=large)),
        window=ck.Window(width=96e3 * PIXEL),
        effects=(*SCENE.effects, ck.SubsurfaceStress()),
    )
    part = ck.solve(ck.plan(scene, ck.Accuracy(grid=96))).of(ck.SubsurfaceStress)
    np.testing.assert_allclose(part.depth, 1e3 * small.depth, rtol=1e-6)
    for name in MEASURES:
        assert part.maxima[name].value == pytest.approx(small.maxima[name].value, rel=1e-6)


@pytest.mark.parametrize("periodic", [True, False])
def test_a_contact_without_pressure_has_no_stress(periodic):
    scene = attrs.evolve(
        SCENE,
        window=ck.Window(width=96 * PIXEL, periodic=periodic),
        loading=ck.Approach(approach=0.0),
        effects=(*SCENE.effects, ck.SubsurfaceStress()),
    )
    part = ck.solve(ck.plan(scene, ck.Accuracy(grid=96))).of(ck.SubsurfaceStress)
    assert all(one.value == 0.0 and one.error == 0.0 for one in part.maxima.values())
