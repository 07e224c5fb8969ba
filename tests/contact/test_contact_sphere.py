"""Spheres on solids: Hertz, Hamilton under friction, layers, and two bodies that deform."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import ellipe, ellipk
from selection import quick

import contactkit as ck
from contactkit.benchmarks.references.tables import reference
from contactkit.reference import hamilton, hertz

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

CASES = reference("contact")
SPHERES = {case["name"]: case for case in CASES["spheres"]}

E, NU, RADIUS, A0 = 1e9, 0.3, 1e-3, 1e-6  # substrate, sphere, and Hertz's contact on it
MODULUS = E / (1.0 - NU**2)
LOAD = 4.0 * MODULUS * A0**3 / (3.0 * RADIUS)
P_HERTZ = 2.0 * A0 * MODULUS / (math.pi * RADIUS)
SOLID = ck.Material(young_modulus=E, poisson_ratio=NU)


def stack(layers):
    """Stack of (modulus over that of the substrate, thickness over a0)."""
    return ck.Stack(
        layers=tuple(
            ck.Layer(
                material=ck.Material(young_modulus=ratio * E, poisson_ratio=NU), thickness=h * A0
            )
            for ratio, h in layers
        ),
        substrate=SOLID,
    )


def sphere_scene(width, *effects, lower=SOLID, upper=None, force=LOAD, shape=None, height=None):
    ball = shape or ck.Paraboloid(radius=RADIUS)
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=lower), upper=ck.Body(surface=ball, solid=upper)
        ),
        window=ck.Window(width=width, height=height, periodic=False),
        loading=ck.Pressing(force=force),
        effects=(ck.LayeredHalfSpace(), *effects),
    )


def solved(width, grid, *effects, **given):
    return ck.solve(ck.plan(sphere_scene(width, *effects, **given), ck.Accuracy(grid=grid)))


def radii(grid, centre=(0.0, 0.0)):
    """Distance of the pixels [m] from a point beside the apex, which is the middle pixel."""
    (ny, nx), (dy, dx) = grid.shape, grid.pixel_size
    y = (np.arange(ny) - ny // 2) * dy - centre[0]
    x = (np.arange(nx) - nx // 2) * dx - centre[1]
    return np.hypot(y[:, None], x[None, :])


def order(sizes, errors):
    """Slope of the line through the errors in a log-log plot."""
    return float(np.polyfit(np.log(sizes), np.log(np.abs(errors)), 1)[0])


# Hertz --------------------------------------------------------------------------------------


def test_hertz_converges_with_second_order_in_pressure_and_approach():
    a = hertz.sphere(LOAD, RADIUS, MODULUS)
    cells = np.array([8, 16, 32, 64])
    runs = [solved(2.5 * A0, int(2.5 * n)) for n in cells]
    peak = np.array([run.max_pressure / a.peak_pressure - 1.0 for run in runs])
    depth = np.array([run.approach / a.approach - 1.0 for run in runs])
    assert abs(peak[2]) < 1e-4
    assert abs(peak[3]) < 3e-5
    assert abs(depth[2]) < 5e-5
    assert order(1.0 / cells, peak) > 1.8
    assert order(1.0 / cells, depth) > 1.5
    assert runs[2].load == pytest.approx(LOAD, rel=1e-12)
    assert math.sqrt(runs[2].contact_area / math.pi) == pytest.approx(a.contact_radius, rel=6e-3)


def test_pressure_displacement_and_gap_follow_hertz_everywhere():
    a = hertz.sphere(LOAD, RADIUS, MODULUS)
    run = solved(4.0 * A0, 96)
    r = radii(run.plan.grid)
    inside, outside = r < 0.9 * A0, r > 1.1 * A0
    pressure = hertz.pressure(r, a.contact_radius, a.peak_pressure)
    np.testing.assert_allclose(run.pressure[inside], pressure[inside], rtol=4e-3)
    assert not run.pressure[outside].any()
    moved = hertz.surface_displacement(r, a.contact_radius, a.peak_pressure, MODULUS)
    np.testing.assert_allclose(run.displacement, moved, atol=5e-4 * a.approach)
    far = r > 1.5 * A0
    np.testing.assert_allclose(run.displacement[far], moved[far], rtol=1e-4)
    gap = hertz.gap(r, a.contact_radius, RADIUS)
    np.testing.assert_allclose(run.gap[outside], gap[outside], atol=5e-4 * a.approach)
    assert run.gap[inside].max() < 1e-7 * a.approach


@pytest.mark.parametrize("along", ["x", "y"])
def test_an_ellipse_follows_hertz_on_pixels_that_are_not_square(along):
    """Johnson 1985, Eqs. 4.25-4.28; the longer axis lies along the larger radius."""
    long, short = 1e-6, 0.5e-6
    square = 1.0 - (short / long) ** 2
    first, second = ellipk(square), ellipe(square)
    ratio = (long / short) ** 2 * second - first, first - second
    peak = 1e6
    mean = 0.5 / (peak / MODULUS * short / (long**2 * square) * math.sqrt(ratio[0] * ratio[1]))
    # mean = sqrt(R' R''); R'/R'' from the ratio of the axes.
    larger, smaller = (mean * (ratio[0] / ratio[1]) ** s for s in (0.5, -0.5))
    force = 2.0 * math.pi / 3.0 * long * short * peak
    approach = 1.5 * force / (math.pi * long * MODULUS) * first
    radii_xy = (larger, smaller) if along == "x" else (smaller, larger)
    body = ck.Paraboloid(radius=radii_xy[0], radius_y=radii_xy[1])
    width, height = (2.6 * long, 2.6 * short) if along == "x" else (2.6 * short, 2.6 * long)
    grid = (60, 91) if along == "x" else (91, 60)
    run = solved(width, grid, shape=body, force=force, height=height)
    assert run.max_pressure == pytest.approx(peak, rel=5e-4)
    assert run.approach == pytest.approx(approach, rel=5e-4)
    (dy, dx), touching = run.plan.grid.pixel_size, run.contact
    spans = {"y": touching.any(axis=1).sum() * dy, "x": touching.any(axis=0).sum() * dx}
    across = "y" if along == "x" else "x"
    assert spans[along] == pytest.approx(2.0 * long, abs=2.1 * max(dx, dy))
    assert spans[across] == pytest.approx(2.0 * short, abs=2.1 * max(dx, dy))


def test_two_bodies_deform_by_the_sum_of_their_compliances():
    other = ck.Material(young_modulus=3.0 * E, poisson_ratio=0.45)
    both = 1.0 / (1.0 / MODULUS + 1.0 / other.plane_strain_modulus)
    one = ck.Material(young_modulus=both * (1.0 - 0.2**2), poisson_ratio=0.2)
    two, single = solved(3.0 * A0, 65, upper=other), solved(3.0 * A0, 65, lower=one)
    np.testing.assert_allclose(two.pressure, single.pressure, atol=1e-7 * single.max_pressure)
    assert two.approach == pytest.approx(single.approach, rel=1e-8)
    swapped = solved(3.0 * A0, 65, lower=other, upper=SOLID)
    np.testing.assert_allclose(swapped.pressure, two.pressure, atol=1e-7 * two.max_pressure)
    expected = hertz.sphere(LOAD, RADIUS, both)
    assert two.max_pressure == pytest.approx(expected.peak_pressure, rel=1e-3)
    assert two.approach == pytest.approx(expected.approach, rel=5e-4)


def test_two_equal_coatings_are_one_of_half_the_modulus():
    coated = stack([(4.0, 0.5), (0.5, 0.3)])
    half = ck.Stack(
        layers=tuple(
            ck.Layer(
                material=ck.Material(
                    young_modulus=0.5 * layer.material.young_modulus, poisson_ratio=NU
                ),
                thickness=layer.thickness,
            )
            for layer in coated.layers
        ),
        substrate=ck.Material(young_modulus=0.5 * E, poisson_ratio=NU),
    )
    two = solved(3.2 * A0, 48, lower=coated, upper=coated)
    one = solved(3.2 * A0, 48, lower=half)
    np.testing.assert_allclose(two.pressure, one.pressure, atol=1e-7 * one.max_pressure)
    assert two.approach == pytest.approx(one.approach, rel=1e-8)


# Stress under a sphere ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("friction", "angle"), [(0.0, 0.0), (0.25, 0.0), (0.25, 0.5 * math.pi), (0.25, math.pi)]
)
def test_the_field_in_the_solid_is_that_of_hamilton(friction, angle):
    a = hertz.sphere(LOAD, RADIUS, MODULUS)
    depths = (0.25 * A0, 0.5 * A0, 1.0 * A0)
    effects = [ck.SubsurfaceStress(depths=depths, keep="planes", window=16.0)]
    effects += [ck.FrictionTraction(coefficient=friction, direction=angle)] if friction else []
    run = solved(3.0 * A0, 96, *effects)
    part = run.of(ck.SubsurfaceStress)
    (ny, nx), (dy, dx) = run.plan.grid.shape, run.plan.grid.pixel_size
    y, x = np.meshgrid(
        (np.arange(ny) - ny // 2) * dy, (np.arange(nx) - nx // 2) * dx, indexing="ij"
    )
    # Hamilton slides along +x: turn the axes, and the tensor back.
    c, s = math.cos(angle), math.sin(angle)
    turn = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    for k, z in enumerate(depths):
        field = hamilton.stress(
            c * x + s * y, -s * x + c * y, z, a.contact_radius, a.peak_pressure, NU, friction
        )
        xx, yy, zz, xy, xz, yz = field
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        back = np.einsum("ki,klyx,lj->ijyx", turn, tensor, turn)
        wanted = np.array([back[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))])
        error = np.abs(part.planes[:, k] - wanted).max() / a.peak_pressure
        assert error < 1.5e-3, (k, error)


def test_the_maximum_under_a_sphere_is_where_hertz_has_it():
    """nu = 0.3: Tresca 0.3100 p0, von Mises 0.6200 p0, both 0.4809 a deep."""
    run = solved(2.5 * A0, 80, ck.SubsurfaceStress(tolerance=1e-4))
    found = run.of(ck.SubsurfaceStress).maxima
    centre = 40 * 2.5 * A0 / 80
    for name, value in (("tresca", 0.31002), ("von_mises", 0.62004), ("sqrt_j2", 0.35798)):
        one = found[name]
        assert one.value / P_HERTZ == pytest.approx(value, rel=1e-3), name
        assert one.z / A0 == pytest.approx(0.481, abs=0.01)
        assert (one.x, one.y) == pytest.approx((centre, centre))
        assert one.error <= 1e-4
    assert run.scalars()["max_tresca"] == (found["tresca"].value, "Pa")


# Layers -------------------------------------------------------------------------------------

STRESSED = [
    "homogeneous",
    "single E1/E2=0.25 h/a0=0.5",
    "single E1/E2=4 h/a0=1",
    "two-layer case IV E1/E3=1 E2/E3=0.5 h1=h2=0.5a0",
    "two-layer case V E1/E3=1 E2/E3=2 h1=h2=0.5a0",
]


@pytest.fixture(scope="module")
def layered():
    """Contacts of the table, by name and friction; solved once, at 32 pixels to the radius."""
    kept = {}

    def get(name, friction="0"):
        if (name, friction) not in kept:
            case = SPHERES[name]
            width = 2.5 * case["contact_radius"] * A0
            mu = float(friction)
            effects = [ck.SubsurfaceStress(tolerance=1e-4, window=16.0)]
            effects += [ck.FrictionTraction(coefficient=mu)] if mu else []
            scene = sphere_scene(width, *effects, lower=stack(case["layers"]))
            kept[name, friction] = ck.solve(ck.plan(scene, ck.Accuracy(grid=80)))
        return kept[name, friction]

    return get


@pytest.mark.parametrize("name", quick(list(SPHERES), 3, 6))
def test_a_coated_half_space_carries_the_sphere_as_the_table_says(layered, name):
    case, run = SPHERES[name], layered(name)
    assert run.max_pressure / P_HERTZ == pytest.approx(case["peak_pressure"], rel=2e-4)
    assert run.approach / (A0**2 / RADIUS) == pytest.approx(case["approach"], rel=5e-4)
    radius = math.sqrt(run.contact_area / math.pi) / A0
    assert radius == pytest.approx(case["contact_radius"], rel=6e-3)
    row = run.pressure[40, 40:] / P_HERTZ
    places = np.arange(40) / 32.0
    for place, value in zip(case["radii"], case["pressures"], strict=True):
        if place < 0.9:  # between pixels the square-root edge cannot be interpolated
            assert np.interp(place, places, row) == pytest.approx(value, rel=1e-3)


@pytest.mark.parametrize(
    ("name", "friction"),
    quick(
        [(STRESSED[0], "0.25"), (STRESSED[0], "0.5"), (STRESSED[3], "0"), (STRESSED[3], "0.25")]
        + [(STRESSED[k], friction) for k in (1, 2, 4) for friction in ("0", "0.25", "0.5")],
        1,
        8,
    ),
)
def test_the_largest_stress_is_that_of_the_table(layered, name, friction):
    case, found = SPHERES[name], layered(name, friction).of(ck.SubsurfaceStress).maxima["sqrt_j2"]
    wanted = case["maxima"][friction]
    radius = case["contact_radius"]
    at_the_edge = wanted["z"] == 0.0 and abs(wanted["x"] + radius) < 1e-4
    tolerance = 3e-2 if at_the_edge else 1e-3
    assert found.value / P_HERTZ == pytest.approx(wanted["sqrt_j2"], rel=tolerance)
    assert found.z / A0 == pytest.approx(wanted["z"], abs=0.01)
    place = found.x / A0 - 40 * 2.5 * radius / 80
    assert place == pytest.approx(wanted["x"], abs=2.1 * radius / 32)
    assert found.layer == wanted["material"]


@pytest.mark.parametrize(
    "name", quick([n for n, case in SPHERES.items() if case["samples"]][:3], 1)
)
def test_stresses_at_points_are_those_of_the_table(name):
    """On both faces of an interface too: pixels of a0/20, so that the points lie on pixels."""
    case = SPHERES[name]
    samples = [one for one in case["samples"] if one["friction"] == 0.25 and one["z"] >= 0.25]
    depths = tuple(sorted({one["z"] * A0 for one in samples}))
    effects = (
        ck.SubsurfaceStress(depths=depths, keep="planes", window=16.0),
        ck.FrictionTraction(coefficient=0.25),
    )
    run = solved(4.0 * A0, 80, *effects, lower=stack(case["layers"]))
    part = run.of(ck.SubsurfaceStress)
    assert len(samples) >= 5
    for one in samples:
        at_depth = np.flatnonzero(np.isclose(part.depth, one["z"] * A0, rtol=1e-9))
        (plane,) = [k for k in at_depth if len(at_depth) == 1 or part.side[k] == one["side"]]
        row, column = (round(40 + 20 * one[c]) for c in "yx")
        stress = part.planes[:, plane, row, column] / P_HERTZ
        np.testing.assert_allclose(stress, one["stress"], atol=1e-3 * case["peak_pressure"])


def test_thin_and_thick_layers_lead_to_the_sphere_on_one_material():
    thin, thick = stack([(4.0, 1e-4)]), stack([(4.0, 3e3)])
    as_substrate = solved(2.5 * A0, 40, lower=thin)
    bare = solved(2.5 * A0, 40)
    assert as_substrate.max_pressure == pytest.approx(bare.max_pressure, rel=2e-4)
    a = hertz.sphere(LOAD, RADIUS, 4.0 * MODULUS)
    as_layer = solved(2.5 * a.contact_radius, 40, lower=thick)
    assert as_layer.max_pressure == pytest.approx(a.peak_pressure, rel=2e-3)
    assert as_layer.max_pressure / P_HERTZ == pytest.approx(4.0 ** (2.0 / 3.0), rel=2e-3)
