"""Partial slip in windows that repeat along one axis: line contact, layers, coupled bodies."""

import math

import numpy as np
import pytest
from attrs import evolve
from selection import quick

import contactkit as ck
from contactkit.contact.effects.elasticity import bodies_of
from contactkit.contact.slip.coupling import coupling_of
from contactkit.elasticity.layer_stack import Layers
from contactkit.elasticity.tangential import isolated_compliance
from contactkit.elasticity.tangential_one_axis import one_axis_symbol

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

E, NU, MU, RADIUS, LINE_LOAD = 1e9, 0.3, 0.3, 1e-3, 200.0  # [Pa], [-], [-], [m], [N/m]
HALF_WIDTH = math.sqrt(4.0 * LINE_LOAD * RADIUS * (1.0 - NU**2) / (math.pi * E))
HALF = (ck.TangentialStep(ratio=0.5),)


def solid(nu=NU, layers=()):
    made = ck.Material(young_modulus=E, poisson_ratio=nu)
    return ck.Stack(layers=layers, substrate=made) if layers else made


def cylinder(direction, lines=96, path=HALF, **choices):
    """A cylinder along x, four pixels of it."""
    side = 2.4 * HALF_WIDTH
    y = (np.arange(lines) + 0.5) / lines * side - 0.5 * side
    heights = np.repeat(-(y**2) / (2.0 * RADIUS), 4).reshape(lines, 4)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid()),
            upper=ck.Body(surface=ck.Heights(heights=heights, pixel_size=side / lines)),
        ),
        window=ck.Window(periodic="x"),
        loading=ck.Pressing(pressure=LINE_LOAD / side),
        effects=(
            ck.HalfSpace(),
            ck.PartialSlip(coefficient=MU, path=path, direction=direction, **choices),
        ),
    )
    return ck.solve(ck.plan(scene)), y


@pytest.mark.parametrize("direction", [0.0, 0.5 * math.pi], ids=["along", "across"])
def test_a_cylinder_sticks_where_cattaneo_has_it(direction):
    """In plane strain and antiplane alike: c = a sqrt(1 - Q/(mu P)) (Johnson 1985, section 7.2)."""
    result, y = cylinder(direction)
    part = result.of(ck.PartialSlip)
    q = (part.traction_x if direction == 0.0 else part.traction_y)[0][:, 0]
    inner = HALF_WIDTH * math.sqrt(0.5)
    peak = 2.0 * LINE_LOAD / (math.pi * HALF_WIDTH)
    outer = np.sqrt(np.maximum(1.0 - (y / HALF_WIDTH) ** 2, 0.0))
    exact = outer - inner / HALF_WIDTH * np.sqrt(np.maximum(1.0 - (y / inner) ** 2, 0.0))
    assert np.linalg.norm(q - MU * peak * exact) < 0.02 * np.linalg.norm(MU * peak * exact)
    assert part.stick_fraction[-1] == pytest.approx(math.sqrt(0.5), abs=0.02)


def test_its_displacement_is_that_of_a_line_load_from_the_datum():
    """Across a cylinder u = (Q'/(pi E*)) (2 ln(2 l/a) + 1), less that of the strip that sticks."""
    result, _ = cylinder(0.5 * math.pi)
    part = result.of(ck.PartialSlip)
    side = result.plan.grid.shape[0] * result.plan.grid.pixel_size[0]
    inner, modulus = HALF_WIDTH * math.sqrt(0.5), E / (1.0 - NU**2)

    def moved(force, half_width):  # centre of an elliptic traction, seen from the datum
        return force / (math.pi * modulus) * (2.0 * math.log(2.0 * side / half_width) + 1.0)

    full = MU * LINE_LOAD
    exact = moved(full, HALF_WIDTH) - moved(0.5 * full, inner)
    assert part.displacement[-1] == pytest.approx(exact, rel=2e-3)


def rough_scene(axis, *effects, made=None, n=32):
    rng = np.random.default_rng(5)
    k = np.hypot(np.fft.fftfreq(n, 1 / n)[:, None], np.fft.rfftfreq(n, 1 / n))
    amplitude = np.where((k > 1.5) & (k < n / 4), (k + 1e-9) ** -1.8, 0.0)
    heights = np.fft.irfft2(amplitude * np.fft.rfft2(rng.standard_normal((n, n))), s=(n, n))
    heights *= 1e-9 / heights.std()
    if axis == "y":
        heights = heights.T
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=made or solid()),
            upper=ck.Body(surface=ck.Heights(heights=heights, pixel_size=1e-6 / n)),
        ),
        window=ck.Window(periodic=axis),
        loading=ck.Pressing(pressure=2e6),
        effects=(ck.LayeredHalfSpace(), *effects),
    )


def test_tractions_of_a_rough_map_are_a_superposition_of_pressures():
    """Ciavarella and Jaeger: q = mu (p - p'), p' the pressure under the load that is left."""
    scene = rough_scene("x", ck.PartialSlip(coefficient=MU, path=HALF), made=solid(0.0))
    result = ck.solve(ck.plan(scene, ck.Accuracy(rtol=1e-10)))
    less = evolve(scene, loading=ck.Pressing(pressure=1e6), effects=scene.effects[:1])
    inner = ck.solve(ck.plan(less, ck.Accuracy(rtol=1e-10))).pressure
    exact = MU * (result.pressure - inner)
    part = result.of(ck.PartialSlip)
    np.testing.assert_allclose(part.traction_x[0], exact, rtol=0, atol=1e-6 * exact.max())


@pytest.mark.parametrize("coupled", quick([False, True], 0))
def test_both_axes_are_alike(coupled):
    film = ck.Layer(material=ck.Material(young_modulus=3e9, poisson_ratio=0.25), thickness=5e-8)
    choices = {"coefficient": MU, "path": HALF, "components": 2, "coupled": coupled}
    if coupled:
        choices["pressing_steps"] = 2
    found = []
    for axis, direction in (("x", 0.3), ("y", 0.5 * math.pi - 0.3)):
        effect = ck.PartialSlip(direction=direction, **choices)
        scene = rough_scene(axis, effect, made=solid(layers=(film,)), n=24)
        found.append(ck.solve(ck.plan(scene)))
    one, other = (result.of(ck.PartialSlip) for result in found)
    scale = np.abs(one.traction_x).max()
    np.testing.assert_allclose(one.traction_x[0], other.traction_y[0].T, rtol=0, atol=1e-5 * scale)
    np.testing.assert_allclose(one.traction_y[0], other.traction_x[0].T, rtol=0, atol=1e-5 * scale)
    assert one.displacement[-1] == pytest.approx(other.displacement[-1], rel=1e-5)
    np.testing.assert_allclose(
        found[0].pressure, found[1].pressure.T, rtol=0, atol=1e-5 * found[0].max_pressure
    )


@pytest.mark.parametrize("axis", ["x", "y"])
def test_coupling_is_reciprocal(axis):
    scene = rough_scene(axis, n=24)
    grid = ck.plan(scene).grid
    coupling = coupling_of(grid, *bodies_of(scene.interface))
    p, qx, qy = np.random.default_rng(3).normal(size=(3, *grid.shape))
    x, y = coupling.of_pressure(p)
    work, other = float((coupling(qx, qy) * p).sum()), float((x * qx + y * qy).sum())
    assert work == pytest.approx(other, rel=1e-10)
    assert abs(work) > 0.0


def kernels(shape, layers, along="x"):
    size = (2 * shape[0], shape[1]) if along == "x" else (shape[0], 2 * shape[1])
    return [np.fft.irfft2(one, s=size) for one in one_axis_symbol(shape, (1.0, 1.0), layers, along)]


def summed(shape, layers, many):
    """Sum of images of isolated pixels on either side, at offsets of 0 .. ny - 1, 0 .. nx//2."""
    ny, nx = shape
    images = isolated_compliance((ny, nx * (many + 1)), (1.0, 1.0), layers)
    offsets = np.arange(nx // 2 + 1)
    found = [np.zeros((ny, offsets.size)) for _ in images]
    for one, total, odd in zip(images, found, (False, True, False), strict=True):
        for j in range(-many, many + 1):
            sign = np.sign(offsets - j * nx) if odd else 1.0
            total += one[:ny, np.abs(offsets - j * nx)] * sign
    return found, float(images.xx.max())


def test_coefficients_on_a_base_are_the_sum_of_images():
    """Layers are read as in a periodic window, the pixel that carries the load as uniform."""
    layers = Layers([2.0, 1.0], [0.3, 0.2], [5.0, 6.0], "bonded")
    exact, scale = summed((12, 10), layers, 40)
    for one, total in zip(kernels((12, 10), layers), exact, strict=True):
        np.testing.assert_allclose(one[:12, :6], total, rtol=0, atol=1e-4 * scale)


def test_coefficients_of_a_half_space_are_that_sum_but_for_the_datum():
    exact, scale = summed((12, 10), Layers([1.0], [0.3]), 400)
    found = kernels((12, 10), Layers([1.0], [0.3]))
    for i in (0, 1, 2):
        change = found[i][:12, :6] - exact[i]
        change -= change[6, 3] if i != 1 else 0.0
        # The sum of 800 images lacks what falls off as their number squared.
        np.testing.assert_allclose(change, 0.0, rtol=0, atol=2e-6 * scale)


def test_a_sheet_that_slides_on_its_base_is_refused():
    sheet = ck.Stack(
        layers=(ck.Layer(material=solid(), thickness=1e-7),), substrate=ck.RigidBase(bonded=False)
    )
    scene = rough_scene("x", ck.PartialSlip(coefficient=MU, path=HALF), made=sheet)
    with pytest.raises(ck.PlanError, match="nothing else holds it; bond it"):
        ck.plan(scene)
    with pytest.raises(ck.DescriptionError, match="nothing else holds the layers"):
        one_axis_symbol((8, 8), (1.0, 1.0), Layers([1.0], [0.3], [1.0], "frictionless"), "x")
