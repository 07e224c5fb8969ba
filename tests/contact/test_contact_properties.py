"""Whatever the surface: contact conditions, scaling laws, symmetries and monotone answers."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import contactkit as ck

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

few = settings(max_examples=12)
E, NU = 1e9, 0.3
SOLID = ck.Material(young_modulus=E, poisson_ratio=NU)
COATED = ck.Stack(
    layers=(
        ck.Layer(material=ck.Material(young_modulus=5e9, poisson_ratio=0.2), thickness=1.5e-8),
        ck.Layer(material=ck.Material(young_modulus=2e8, poisson_ratio=0.45), thickness=2e-8),
    ),
    substrate=SOLID,
)


@st.composite
def maps(draw):
    """Rough, smooth or stepped heights on a small grid, even or odd."""
    ny, nx = (draw(st.integers(3, 18)) for _ in range(2))
    rng = np.random.default_rng(draw(st.integers(0, 2**16)))
    kind = draw(st.sampled_from(["rough", "smooth", "steps", "one peak"]))
    rough = rng.normal(size=(ny, nx))
    if kind == "smooth":
        spectrum = np.fft.rfft2(rough)
        spectrum[2:-1] = 0.0
        spectrum[:, 3:] = 0.0
        rough = np.fft.irfft2(spectrum, s=(ny, nx))
    elif kind == "steps":
        rough = np.round(rough)
    elif kind == "one peak":
        rough = -np.abs(rough)
        rough[rng.integers(ny), rng.integers(nx)] = 3.0
    return 1e-9 * rough


pixels = st.sampled_from([(1e-8, 1e-8), (1e-8, 2.5e-8), (3e-8, 1e-8)])
solids = st.sampled_from([SOLID, COATED])
edges = st.booleans()
loads = st.sampled_from([1e3, 1e5, 3e6, 4e7, 1e9])
caps = st.sampled_from([None, 1.2, 5.0, 100.0])


def scale_of(run):
    """Length [m] and pressure [Pa] that rounding and tolerance refer to."""
    return run.heights.std() + np.ptp(run.displacement), max(run.max_pressure, 1e-300)


def same(run, other, pressure=None, tolerance=2e-6):
    """Two ways to one contact agree where the solution is well determined."""
    length, peak = scale_of(run)
    moved = other.pressure if pressure is None else pressure
    np.testing.assert_allclose(moved, run.pressure, rtol=0, atol=tolerance * peak)
    assert other.approach == pytest.approx(run.approach, rel=1e-6, abs=1e-7 * length)


@few
@given(maps(), pixels, solids, loads, caps, edges)
def test_the_contact_conditions_hold_at_every_pixel(heights, pixel, solid, load, cap, periodic):
    hardness = None if cap is None else cap * load
    run = ck.press(heights, pixel, solid, load, hardness=hardness, periodic=periodic)
    p, gap, most = run.pressure, run.gap, math.inf if hardness is None else hardness
    length, _ = scale_of(run)
    assert run.status == "converged"
    assert p.min() >= 0.0
    assert p.max() <= most * (1.0 + 1e-12)
    assert p.sum() * pixel[0] * pixel[1] == pytest.approx(load * run.plan.grid.area, rel=1e-11)
    assert gap.min() >= 0.0
    assert (p * gap).max() <= 4e-8 * length * p.max()
    overlap = run.heights + run.rigid_approach - run.displacement
    assert overlap[p < most * (1.0 - 1e-9)].max(initial=0.0) <= 4e-8 * length
    if hardness is not None:
        part = run.of(ck.HardnessLimit)
        assert part.overlap.min() >= 0.0
        assert part.area <= run.contact_area * (1.0 + 1e-12)


@few
@given(maps(), pixels, solids, loads, edges)
def test_lengths_and_moduli_scale(heights, pixel, solid, load, periodic):
    """Heights and pixels times s, moduli and pressures times t: pressures t, lengths s."""
    s, t = 3.7e3, 2.3e-5
    run = ck.press(heights, pixel, solid, load, periodic=periodic)
    stack = ck.Stack(substrate=solid) if isinstance(solid, ck.Material) else solid
    moved = ck.Stack(
        layers=tuple(
            ck.Layer(
                material=ck.Material(
                    young_modulus=t * layer.material.young_modulus,
                    poisson_ratio=layer.material.poisson_ratio,
                ),
                thickness=s * layer.thickness,
            )
            for layer in stack.layers
        ),
        substrate=ck.Material(young_modulus=t * E, poisson_ratio=NU),
    )
    far = ck.press(s * heights, (s * pixel[0], s * pixel[1]), moved, t * load, periodic=periodic)
    np.testing.assert_allclose(far.pressure, t * run.pressure, atol=2e-6 * t * run.max_pressure)
    assert far.approach == pytest.approx(s * run.approach, rel=1e-6)
    assert far.energy == pytest.approx(t * s**3 * run.energy, rel=1e-6)


@few
@given(maps(), pixels, solids, loads, edges)
def test_heights_and_load_scale_together(heights, pixel, solid, load, periodic):
    """At the same pixels the problem is linear in heights and pressures together."""
    run = ck.press(heights, pixel, solid, load, periodic=periodic)
    large = ck.press(50.0 * heights, pixel, solid, 50.0 * load, periodic=periodic)
    np.testing.assert_allclose(
        large.pressure / 50.0, run.pressure, rtol=0, atol=2e-6 * run.max_pressure
    )
    assert large.approach == pytest.approx(50.0 * run.approach, rel=1e-6)


@few
@given(maps(), pixels, solids, loads, edges, st.sampled_from(["x", "y", "both"]))
def test_a_mirrored_surface_has_a_mirrored_contact(heights, pixel, solid, load, periodic, about):
    axes = {"x": 1, "y": 0, "both": (0, 1)}[about]
    run = ck.press(heights, pixel, solid, load, periodic=periodic)
    other = ck.press(np.flip(heights, axes), pixel, solid, load, periodic=periodic)
    same(run, other, np.flip(other.pressure, axes))


@few
@given(maps(), pixels, solids, loads, edges)
def test_a_transposed_surface_has_a_transposed_contact(heights, pixel, solid, load, periodic):
    run = ck.press(heights, pixel, solid, load, periodic=periodic)
    other = ck.press(heights.T, pixel[::-1], solid, load, periodic=periodic)
    same(run, other, other.pressure.T)


@few
@given(maps(), pixels, solids, loads, st.integers(1, 9), st.integers(1, 9))
def test_a_periodic_surface_may_begin_anywhere(heights, pixel, solid, load, rows, columns):
    run = ck.press(heights, pixel, solid, load)
    moved = ck.press(np.roll(heights, (rows, columns), (0, 1)), pixel, solid, load)
    same(run, moved, np.roll(moved.pressure, (-rows, -columns), (0, 1)))


@few
@given(maps(), pixels, loads)
def test_a_periodic_surface_repeated_is_the_same_surface(heights, pixel, load):
    run = ck.press(heights, pixel, COATED, load)
    twice = ck.press(np.tile(heights, (2, 3)), pixel, COATED, load)
    ny, nx = heights.shape
    if ny % 2 == 0 and nx % 2 == 0:  # the shortest wave of an even grid is halved by odd tiling
        return
    tiled = np.tile(run.pressure, (2, 3))
    length, _ = scale_of(run)
    np.testing.assert_allclose(twice.pressure, tiled, rtol=0, atol=2e-6 * run.max_pressure)
    assert twice.approach == pytest.approx(run.approach, rel=1e-6, abs=1e-7 * length)


@few
@given(maps(), pixels, solids, edges, caps)
def test_more_load_makes_more_contact(heights, pixel, solid, periodic, cap):
    values = np.array([1e4, 1e6, 1e7, 1e8])
    hardness = None if cap is None else cap * values[-1]
    runs = [
        ck.press(heights, pixel, solid, p, hardness=hardness, periodic=periodic) for p in values
    ]
    for less, more in itertools.pairwise(runs):
        length, _ = scale_of(more)
        assert more.contact_area >= less.contact_area
        assert more.approach >= less.approach - 1e-7 * length


@few
@given(maps(), pixels, solids, st.sampled_from([1e6, 3e7]), edges)
def test_the_energy_falls_as_the_tolerance_does(heights, pixel, solid, load, periodic):
    """The solution is the minimum: whatever else carries the load stores more."""
    energies = [
        ck.press(heights, pixel, solid, load, periodic=periodic, rtol=rtol).energy
        for rtol in (1e-3, 1e-4, 1e-6, 1e-10)
    ]
    least = energies[-1]
    assert all(energy >= least - 1e-10 * abs(least) for energy in energies)
    excess = [energy - least for energy in energies]
    assert excess[2] <= 1e-8 * abs(least)


@few
@given(maps(), pixels, st.sampled_from([1e5, 1e7]), edges, st.integers(2, 4))
def test_a_layer_cut_into_slices_is_the_layer(heights, pixel, load, periodic, slices):
    top, *others = COATED.layers
    thin = ck.Layer(material=top.material, thickness=top.thickness / slices)
    cut = ck.Stack(layers=(*[thin] * slices, *others), substrate=SOLID)
    run = ck.press(heights, pixel, COATED, load, periodic=periodic)
    same(run, ck.press(heights, pixel, cut, load, periodic=periodic))


@few
@given(maps(), pixels, st.sampled_from([1e5, 1e7]), edges)
def test_layers_of_one_material_are_no_layers(heights, pixel, load, periodic):
    alike = ck.Stack(layers=[ck.Layer(material=SOLID, thickness=1e-8)] * 2, substrate=SOLID)
    run = ck.press(heights, pixel, SOLID, load, periodic=periodic)
    same(run, ck.press(heights, pixel, alike, load, periodic=periodic))


@few
@given(maps(), pixels, st.sampled_from([1e5, 1e7]), edges)
def test_the_heights_may_be_on_either_body(heights, pixel, load, periodic):
    """Rigid and rough on smooth, or the other way round, or half on each."""

    def solve(lower, upper, solid):
        surface = {
            "lower": ck.Heights(heights=lower, pixel_size=pixel),
            "upper": ck.Heights(heights=upper, pixel_size=pixel),
        }
        scene = ck.ContactScene(
            interface=ck.Interface(
                lower=ck.Body(surface=surface["lower"], solid=SOLID if solid == "lower" else None),
                upper=ck.Body(surface=surface["upper"], solid=SOLID if solid == "upper" else None),
            ),
            window=ck.Window(periodic=periodic),
            loading=ck.Pressing(pressure=load),
            effects=(ck.HalfSpace(),),
        )
        return ck.solve(ck.plan(scene))

    run = solve(0.0 * heights, heights, "lower")
    same(run, solve(heights, 0.0 * heights, "upper"))
    same(run, solve(0.25 * heights, 0.75 * heights, "lower"))


# Stress -------------------------------------------------------------------------------------

EVEN, ODD = 1.0, -1.0
IN_X = np.array([EVEN, EVEN, EVEN, ODD, ODD, EVEN])[:, None, None, None]  # xx yy zz xy xz yz
IN_Y = np.array([EVEN, EVEN, EVEN, ODD, EVEN, ODD])[:, None, None, None]


def stresses(heights, pixel, solid, friction, angle, periodic):
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Heights(heights=heights, pixel_size=pixel)),
        ),
        window=ck.Window(periodic=periodic),
        loading=ck.Pressing(pressure=3e6),
        effects=(
            ck.LayeredHalfSpace(),
            ck.FrictionTraction(coefficient=friction, direction=angle),
            ck.SubsurfaceStress(depths=(4e-9, 1.5e-8, 3e-8), keep="planes", window=2.0),
        ),
    )
    return ck.solve(ck.plan(scene)).of(ck.SubsurfaceStress)


@pytest.mark.slow
@few
@given(maps(), pixels, solids, edges, st.floats(-3.0, 3.0))
def test_sliding_the_other_way_under_a_mirror_mirrors_the_stress(
    heights, pixel, solid, periodic, angle
):
    here = stresses(heights, pixel, solid, 0.4, angle, periodic)
    size = np.abs(here.planes).max()
    for axis, turned, sign in ((3, math.pi - angle, IN_X), (2, -angle, IN_Y)):
        there = stresses(np.flip(heights, axis - 2), pixel, solid, 0.4, turned, periodic)
        np.testing.assert_allclose(
            sign * np.flip(there.planes, axis), here.planes, rtol=0, atol=1e-5 * size
        )
        mises, mirrored = (part.maxima["von_mises"].value for part in (here, there))
        assert mises == pytest.approx(mirrored, rel=1e-4)


@pytest.mark.slow
@few
@given(maps(), pixels, solids, edges)
def test_the_stress_is_linear_in_friction_and_balances_the_load(heights, pixel, solid, periodic):
    parts = [stresses(heights, pixel, solid, mu, 0.7, periodic) for mu in (0.0, 0.25, 0.5)]
    none, half, full = (part.planes for part in parts)
    size = np.abs(full).max()
    np.testing.assert_allclose(full - none, 2.0 * (half - none), rtol=0, atol=1e-10 * size)
    if periodic:  # every plane carries the whole load
        np.testing.assert_allclose(full[2].mean(axis=(1, 2)), -3e6, rtol=1e-9)
        np.testing.assert_allclose(full[4].mean(axis=(1, 2)), -0.5 * math.cos(0.7) * 3e6, rtol=1e-9)
        np.testing.assert_allclose(full[5].mean(axis=(1, 2)), -0.5 * math.sin(0.7) * 3e6, rtol=1e-9)
