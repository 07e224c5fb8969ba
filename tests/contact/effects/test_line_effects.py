"""Adhesion, friction coupling, films and bridges in windows that repeat along one axis."""

from __future__ import annotations

import math

import numpy as np
import pytest

import contactkit as ck

E, NU, R, WIDTH, N = 1e6, 0.3, 1e-3, 100e-6, 64
MODULUS = E / (1.0 - NU**2)
SOLID = ck.Material(young_modulus=E, poisson_ratio=NU)
WATER = ck.Meniscus(
    liquid=ck.Liquid(name="water", surface_tension=0.072, viscosity=1e-3, density=1e3),
    contact_angle_lower=0.3,
    contact_angle_upper=0.3,
)
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")


def solved(heights, edges, loading, *effects, meniscus=None, rtol=1e-8):
    surface = ck.Heights(heights=heights, pixel_size=WIDTH / N)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=SOLID), upper=ck.Body(surface=surface), meniscus=meniscus
        ),
        window=ck.Window(periodic=edges),
        loading=loading,
        effects=(ck.HalfSpace(), *effects),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(rtol=rtol)))


def cylinder(along, long=4, n=N):
    y = (np.arange(n) + 0.5 - n / 2) * WIDTH / N
    heights = np.repeat(-(y**2)[:, None] / (2.0 * R), long, axis=1)
    return heights if along == "x" else heights.T


def rough(ny, nx, seed=0):
    rng = np.random.default_rng(seed)
    q = np.hypot(np.fft.fftfreq(ny)[:, None], np.fft.rfftfreq(nx))
    spectrum = np.where((q > 0.04) & (q < 0.13), 1.0, 0.0) * np.fft.rfft2(rng.normal(size=(ny, nx)))
    heights = np.fft.irfft2(spectrum, (ny, nx))
    return 2e-7 * heights / heights.std()


@pytest.mark.parametrize("along", ["x", "y"])
def test_an_adhering_cylinder_is_as_wide_as_jkrs(along):
    """Barquins 1988: P/L = pi E* b^2 / 4 R - sqrt(2 pi E* w b).

    A finite range spreads the edge: its pixels in contact end before it, the attracted ones after.
    """
    w, load = 5e-4, 0.3
    adhesion = ck.Adhesion(law=ck.DugdaleAttraction(work_of_adhesion=w, range=5e-8))
    pressing, line = ck.Pressing(force=load * 4 * WIDTH / N), 4 * WIDTH / N
    run = solved(cylinder(along), along, pressing, adhesion, rtol=1e-6)
    widths = np.linspace(1e-6, 50e-6, 100_000)
    loads = math.pi * MODULUS * widths**2 / (4.0 * R) - np.sqrt(
        2.0 * math.pi * MODULUS * w * widths
    )
    half_width, found = widths[loads < load][-1], run.of(ck.Adhesion)
    assert np.ptp(found.is_contact.astype(int), axis=1 if along == "x" else 0).max() == 0
    assert 0.9 * half_width < 0.5 * found.contact_area / line < half_width
    assert half_width < 0.5 * found.attracted_area / line < 1.1 * half_width
    assert half_width > 1.3 * math.sqrt(4.0 * load * R / (math.pi * MODULUS))
    assert found.edge_tension == 0.0


def test_adhesion_in_a_strip_is_that_of_a_tall_window():
    adhesion = ck.Adhesion(law=ck.DugdaleAttraction(work_of_adhesion=5e-4, range=1e-7))
    pressing, away = ck.Pressing(force=0.3 * 4 * WIDTH / N), 7 * N // 2
    tall = np.pad(cylinder("x"), ((away, away), (0, 0)), constant_values=-1e-5)
    strip = solved(cylinder("x"), "x", pressing, adhesion, rtol=1e-6)
    both = solved(tall, True, pressing, adhesion, rtol=1e-6)
    atol = 0.01 * strip.max_pressure
    np.testing.assert_allclose(strip.pressure, both.pressure[away:-away], atol=atol)
    assert strip.of(ck.Adhesion).contact_area == both.of(ck.Adhesion).contact_area


def test_an_attraction_that_reaches_the_edges_is_found_at_those_that_do_not_repeat():
    law = ck.ExponentialAttraction(work_of_adhesion=0.05, range=2e-6)
    at_ends = solved(
        cylinder("x", n=16), "x", ck.Pressing(force=1e-5), ck.Adhesion(law=law), rtol=1e-5
    )
    along = solved(
        cylinder("x", n=16).T, "y", ck.Pressing(force=1e-5), ck.Adhesion(law=law), rtol=1e-5
    )
    assert at_ends.of(ck.Adhesion).edge_tension > 0.1
    assert along.of(ck.Adhesion).edge_tension == pytest.approx(
        at_ends.of(ck.Adhesion).edge_tension, rel=1e-4
    )


@pytest.mark.parametrize("along", ["x", "y"])
@pytest.mark.parametrize("coefficient", [0.5, -1.0])
def test_a_sliding_cylinder_is_pressed_off_its_apex(along, coefficient):
    """Johnson 1985, section 7.2: p = E* cos(pi e) (a - x)^(1/2 + e) (a + x)^(1/2 - e) / 2 R.

    With tan(pi e) = beta mu the apex is 2 a e from the middle of the contact, and the centroid of
    the pressure 8 a e / 3 from the apex.
    """
    load, direction = 0.5, math.pi / 2.0 if along == "x" else 0.0
    if coefficient < 0.0:
        direction += math.pi
    friction = ck.FrictionTraction(coefficient=abs(coefficient), direction=direction)
    pressing = ck.Pressing(force=load * 4 * WIDTH / N)
    run = solved(cylinder(along), along, pressing, friction, ck.FrictionCoupling())
    pressure = run.pressure.sum(axis=1 if along == "x" else 0) / 4.0
    e = math.atan(coefficient * (1.0 - 2.0 * NU) / (2.0 * (1.0 - NU))) / math.pi
    a = math.sqrt(4.0 * load * R / (math.pi * MODULUS * (1.0 - 4.0 * e**2)))
    x = (np.arange(N) + 0.5 - N / 2) * WIDTH / N
    centroid = float(x @ pressure / pressure.sum())
    assert abs(centroid) == pytest.approx(8.0 * a * abs(e) / 3.0, rel=0.01)
    x = math.copysign(1.0, centroid * -e) * x + 2.0 * a * e
    inside = np.maximum(a - x, 0.0) ** (0.5 + e) * np.maximum(a + x, 0.0) ** (0.5 - e)
    wanted = MODULUS * math.cos(math.pi * e) / (2.0 * R) * inside
    np.testing.assert_allclose(pressure, wanted, atol=0.06 * wanted.max())


@pytest.mark.parametrize("coefficient", [4.0, 7.0, 12.0])
def test_a_cylinder_slides_under_any_coefficient_as_johnson_says(coefficient):
    """The closed form above; its pressure is all but a jump at one edge, where pixels ring."""
    line = 0.2
    friction = ck.FrictionTraction(coefficient=coefficient, direction=math.pi / 2.0)
    pressing = ck.Pressing(force=line * 4 * WIDTH / N)
    run = solved(cylinder("x"), "x", pressing, friction, ck.FrictionCoupling())
    pressure = run.pressure[:, 0]
    e = math.atan(coefficient * (1.0 - 2.0 * NU) / (2.0 * (1.0 - NU))) / math.pi
    a = math.sqrt(4.0 * line * R / (math.pi * MODULUS * (1.0 - 4.0 * e**2)))
    x = (np.arange(N) + 0.5 - N / 2) * WIDTH / N
    assert abs(x @ pressure / pressure.sum()) == pytest.approx(8.0 * a * e / 3.0, rel=0.02)
    assert 0.5 * run.contact_area / (4 * WIDTH / N) == pytest.approx(a, abs=WIDTH / N)
    x = math.copysign(1.0, -float(x @ pressure)) * x + 2.0 * a * e
    inside = np.maximum(a - x, 0.0) ** (0.5 + e) * np.maximum(a + x, 0.0) ** (0.5 - e)
    wanted = MODULUS * math.cos(math.pi * e) / (2.0 * R) * inside
    missed = np.abs(np.cumsum(pressure - wanted)).max() / np.cumsum(wanted)[-1]
    assert missed < 0.03


def test_friction_along_a_cylinder_moves_nothing():
    friction = (ck.FrictionTraction(coefficient=0.5), ck.FrictionCoupling())
    run = solved(cylinder("x"), "x", ck.Pressing(force=0.5 * 4 * WIDTH / N), *friction)
    np.testing.assert_allclose(run.pressure, run.pressure[::-1], atol=1e-5 * run.max_pressure)
    assert abs(run.of(ck.FrictionCoupling).pressure_change) < 1e-5


@pytest.mark.parametrize("along", ["x", "y"])
def test_a_film_and_its_islands_go_on_across_the_edges_that_repeat_alone(along):
    ends = np.full((16, 32), -3e-6)
    ends[5:11, :4] = ends[5:11, -4:] = 0.0
    heights = ends if along == "x" else ends.T
    film = ck.FilmMeniscus(film_thickness=1e-7, meniscus_height=1e-6)
    bridges = ck.IslandBridges(film_thickness=2e-7, meniscus_height=1e-6)
    run = solved(heights, along, ck.Pressing(pressure=10.0), film, bridges, meniscus=WATER)
    assert run.of(ck.FilmMeniscus).n_menisci == 1
    apart = solved(heights, False, ck.Pressing(pressure=10.0), film, bridges, meniscus=WATER)
    assert apart.of(ck.FilmMeniscus).n_menisci == 2
    across = solved(
        heights, "y" if along == "x" else "x", ck.Pressing(pressure=10.0), film, meniscus=WATER
    )
    assert across.of(ck.FilmMeniscus).n_menisci == 2


def test_both_axes_are_alike_with_every_effect():
    heights = rough(24, 32)
    law = ck.ExponentialAttraction(work_of_adhesion=0.005, range=1e-8)
    cases = [
        ((ck.Adhesion(law=law),), 1e-5),
        ((ck.FrictionTraction(coefficient=0.4, direction=0.0), ck.FrictionCoupling()), 1e-8),
        ((ck.FilmMeniscus(film_thickness=3e-8, meniscus_height=1e-7),), 1e-8),
        ((ck.IslandBridges(film_thickness=3e-8, curvature="summit"),), 1e-8),
    ]
    for effects, rtol in cases:
        turned = tuple(
            ck.FrictionTraction(coefficient=0.4, direction=math.pi / 2.0)
            if isinstance(effect, ck.FrictionTraction)
            else effect
            for effect in effects
        )
        load = ck.Pressing(pressure=4e3)
        one = solved(heights, "x", load, *effects, meniscus=WATER, rtol=rtol)
        two = solved(heights.T, "y", load, *turned, meniscus=WATER, rtol=rtol)
        atol = 1e-3 * one.max_pressure
        np.testing.assert_allclose(one.pressure, two.pressure.T, atol=atol, err_msg=str(effects))
        assert one.contact_area == two.contact_area
        for effect in effects[-1:]:
            if hasattr(one.of(type(effect)), "force"):
                force = one.of(type(effect)).force
                assert force == pytest.approx(two.of(type(effect)).force, rel=1e-6)
