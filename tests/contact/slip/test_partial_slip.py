"""Partial slip against closed forms, a superposition of pressures, and dense matrices."""

from __future__ import annotations

import numpy as np
import pytest

import contactkit as ck
from contactkit.contact.slip.states import Zone
from contactkit.reference import hertz, partial_slip

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

E, NU, MU, LOAD, RADIUS = 70e9, 0.3, 0.3, 1.0, 1e-3
CONTACT = hertz.sphere(LOAD, RADIUS, E / (1.0 - NU**2))
SPHERE = partial_slip.Sphere(LOAD, MU, CONTACT.contact_radius, 0.5 * E / (1.0 + NU) / (2.0 - NU))


def approx(value, rel, absolute=0.0):
    """Lengths are smaller than the tolerance that pytest allows on its own."""
    return pytest.approx(value, rel=rel, abs=absolute)


def ratios(*values, steps=1):
    return tuple(ck.TangentialStep(ratio=value, steps=steps) for value in values)


def slip(path, coefficient=MU, **choices):
    return ck.PartialSlip(coefficient=coefficient, path=path, **choices)


def sphere(effect, grid=64, surface=None):
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=ck.Material(young_modulus=E, poisson_ratio=NU)),
            upper=ck.Body(surface=surface or ck.Paraboloid(radius=RADIUS)),
        ),
        window=ck.Window(width=2.4 * CONTACT.contact_radius if grid else None, periodic=False),
        loading=ck.Pressing(force=LOAD),
        effects=(ck.HalfSpace(), effect),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=grid)))


def wave_map(n, side):
    """Deterministic rough map: a sum of given cosines."""
    x = (np.arange(n) + 0.5) / n
    grid_x, grid_y = np.meshgrid(x, x)
    h, k = np.zeros((n, n)), 0
    for i in range(-6, 7):
        for j in range(7):
            q = np.hypot(i, j)
            if 2 <= q <= 6.5 and not (j == 0 and i < 0):
                k += 1
                phase = 2.399963229728653 * k * k
                h += q**-1.8 * np.cos(2 * np.pi * (i * grid_x + j * grid_y) + phase)
    return h * (2e-9 / h.std()), side / n


def rough(effect, solid, periodic=False, pressure=3e6, n=48, rtol=1e-10):
    heights, pixel = wave_map(n, 1e-6)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Heights(heights=heights, pixel_size=pixel)),
        ),
        window=ck.Window(periodic=periodic),
        loading=ck.Pressing(pressure=pressure),
        effects=(ck.LayeredHalfSpace(), effect),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(rtol=rtol)))


def material(modulus, ratio):
    return ck.Material(young_modulus=modulus, poisson_ratio=ratio)


RIGID_FILM = ck.Stack(
    layers=(ck.Layer(material=material(4e9, 0.3), thickness=5e-8),), substrate=material(1e9, 0.2)
)
SOFT_FILM = ck.Stack(
    layers=(ck.Layer(material=material(1e8, 0.4), thickness=5e-8),), substrate=material(1e9, 0.3)
)

# --- Spheres --------------------------------------------------------------------------------------

FORCES = (0.3, 0.6, 0.8, 0.4, 0.0, -0.4, -0.8, 0.0, 0.8)


def check_cycle(result, displacement, loss, shape):
    part = result.of(ck.PartialSlip)
    full = SPHERE.friction
    up = [partial_slip.displacement(SPHERE, full * s) for s in FORCES[:3]]
    down = [
        up[2] - 2 * partial_slip.displacement(SPHERE, 0.5 * full * (0.8 - s)) for s in FORCES[3:7]
    ]
    again = [
        down[3] + 2 * partial_slip.displacement(SPHERE, 0.5 * full * (s + 0.8)) for s in FORCES[7:]
    ]
    error = np.abs(part.displacement[1:] - [*up, *down, *again]).max()
    assert error < displacement * SPHERE.sliding_displacement
    assert part.force[1:] == approx(full * np.array(FORCES), rel=1e-9, absolute=1e-12)
    exact = partial_slip.cycle_loss(SPHERE, 0.8 * full)
    assert part.energy_loss(2, 8) == approx(exact, rel=loss)
    n, pixel = result.pressure.shape[0], result.plan.grid.pixel_size[0]
    x = (np.arange(n) - n // 2) * pixel
    q = partial_slip.traction(np.hypot(x[:, None], x), SPHERE, 0.6 * full)
    assert np.linalg.norm(part.traction_x[1] - q) < shape * np.linalg.norm(q)


def test_a_cycle_of_a_sphere_is_that_of_mindlin_and_deresiewicz():
    check_cycle(sphere(slip(ratios(*FORCES))), 5e-5, 2e-3, 1.5e-2)


@pytest.mark.slow
def test_the_same_cycle_on_a_finer_grid():
    check_cycle(sphere(slip(ratios(*FORCES)), grid=128), 2e-5, 1e-3, 1e-2)


def test_the_circle_that_sticks_and_the_stiffness_are_those_of_mindlin():
    result = sphere(slip(ratios(0.6)))
    part = result.of(ck.PartialSlip)
    area = float((part.zones[0] == Zone.STICK).sum()) * result.plan.grid.pixel_area
    found = np.sqrt(area / np.pi)
    assert found == approx(partial_slip.stick_radius(SPHERE, 0.18), rel=0.01)
    assert part.stiffness[0] == approx(partial_slip.stiffness(SPHERE, 0.0), rel=0.01)
    assert part.stiffness[1] == approx(partial_slip.stiffness(SPHERE, 0.18), rel=0.01)


def test_sub_steps_change_nothing_and_work_is_that_of_force_and_displacement():
    one = sphere(slip(ratios(0.7, -0.7, 0.7)), grid=32).of(ck.PartialSlip)
    many = sphere(slip(ratios(0.7, -0.7, 0.7, steps=12)), grid=32).of(ck.PartialSlip)
    assert many.displacement[many.step == 2][-1] == approx(one.displacement[-1], rel=1e-7)
    assert many.energy_loss(0, 2) == approx(one.energy_loss(0, 2), rel=1e-6)
    cycle = slice(many.end_of(0), many.end_of(2) + 1)
    polygon = np.trapezoid(many.force[cycle], many.displacement[cycle])
    assert polygon == approx(many.energy_loss(0, 2), rel=0.01)
    assert polygon != approx(many.energy_loss(0, 2), rel=1e-4)  # what it leaves out


def test_two_components_of_a_sphere():
    """Against projected gradients on dense matrices, the apex between four pixels of 48."""
    pixel = 2.4 * CONTACT.contact_radius / 48
    x = (np.arange(48) - 23.5) * pixel
    apex = ck.Heights(heights=-(x[:, None] ** 2 + x**2) / (2.0 * RADIUS), pixel_size=pixel)
    one = sphere(slip(ratios(0.6)), None, apex).of(ck.PartialSlip)
    two = sphere(slip(ratios(0.6), components=2), None, apex).of(ck.PartialSlip)
    assert one.displacement[-1] == approx(7.599153593906372e-08, rel=2e-6)
    assert two.displacement[-1] == approx(7.595588193283085e-08, rel=2e-6)
    assert (two.traction_x**2).sum() == approx(2.198792418870135e19, rel=1e-4)
    assert (two.traction_y**2).sum() == approx(1.943661819244933e16, rel=1e-3)
    assert np.abs(two.traction_y.sum()) < 1e-9 * two.traction_x.sum()  # by symmetry


def test_a_direction_turns_everything():
    along = sphere(slip(ratios(0.5), components=2), grid=32).of(ck.PartialSlip)
    across = sphere(slip(ratios(0.5), components=2, direction=np.pi / 2), grid=32)
    turned = across.of(ck.PartialSlip)
    assert turned.displacement[-1] == approx(along.displacement[-1], rel=1e-9)
    scale = np.abs(along.traction_x).max()
    assert np.abs(turned.traction_y[0].T - along.traction_x[0]).max() < 1e-6 * scale
    assert np.abs(turned.traction_x[0].T - along.traction_y[0]).max() < 1e-6 * scale


# --- Rough maps -----------------------------------------------------------------------------------

DENSE = {  # force over full sliding: displacement [m], sum of q^2 [Pa2], pixels that stick
    0.3: (3.080467391398693e-10, 4103209905996632.0, 158),
    0.6: (7.201751808104601e-10, 1.5662633426538724e16, 97),
    0.8: (1.0747567351753273e-09, 2.8671545118212336e16, 60),
    0.4: (6.796379143888474e-10, 1.4674991420774916e16, 181),
    0.0: (2.0436204348700996e-10, 8118473385475058.0, 137),
}


def test_a_rough_map_is_that_of_dense_matrices():
    """Direct solves of the active set with matrices of Love and Cerruti, nu = 0."""
    effect = slip(ratios(*DENSE), 0.4, rtol=1e-10)
    part = rough(effect, material(2e9, 0.0)).of(ck.PartialSlip)
    for i, (displacement, squares, sticking) in enumerate(DENSE.values()):
        assert part.displacement[i + 1] == approx(displacement, rel=1e-8)
        assert (part.traction_x[i] ** 2).sum() == approx(squares, rel=1e-8)
        assert (part.zones[i] == Zone.STICK).sum() == sticking
    assert part.traction_x[4].min() == approx(-15855050.981948523, rel=1e-8)


@pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "isolated"])
def test_the_superposition_of_ciavarella_and_jaeger(periodic):
    """With nu = 0 the tangential compliance is the normal one; its displacement is the approach."""
    solid = material(2e9, 0.0)
    result = rough(slip(ratios(0.6), 0.4), solid, periodic)
    other = rough(slip(ratios(0.0), 0.4), solid, periodic, pressure=0.4 * 3e6)
    pressures = {1.0: result.pressure, 0.4: other.pressure}
    exact = partial_slip.superposed(lambda load: pressures[round(load, 9)], 1.0, 0.4, 0.24)
    part = result.of(ck.PartialSlip)
    assert np.abs(part.traction_x[0] - exact).max() < 1e-7 * exact.max()
    approach = 0.4 * (result.rigid_approach - other.rigid_approach)
    assert part.displacement[-1] == approx(approach, rel=1e-7)


@pytest.mark.parametrize("solid", [RIGID_FILM, SOFT_FILM], ids=["stiff film", "soft film"])
@pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "isolated"])
def test_masings_rule_holds_for_layers(solid, periodic):
    """Unloading is loading at twice the scale: q(Q0) - 2 q((Q0 - Q)/2)."""
    path = ratios(0.25, 0.8, 0.3)
    part = rough(slip(path, rtol=1e-10), solid, periodic).of(ck.PartialSlip)
    q, d = part.traction_x, part.displacement[1:]
    assert np.abs(q[1] - 2.0 * q[0] - q[2]).max() < 1e-6 * q[1].max()
    assert d[2] == approx(d[1] - 2.0 * d[0], rel=1e-6)


def test_the_solution_fulfils_coulombs_law():
    """The displacement of the solution, by other transforms, and the two-body compliance."""
    from contactkit.elasticity.layered import compliance

    result = rough(slip(ratios(0.5), components=2, rtol=1e-10), SOFT_FILM, periodic=True)
    part, n = result.of(ck.PartialSlip), 48
    k = 2.0 * np.pi * np.fft.fftfreq(n, 1e-6 / n)
    xi, eta = np.meshgrid(k, k)
    cross = np.ones((n, n))
    cross[n // 2], cross[:, n // 2] = 0.0, 0.0  # the sign of these waves is not defined
    alpha = np.hypot(xi, eta)
    alpha[0, 0] = 1.0
    found = compliance(alpha, [1e8, 1e9], [0.4, 0.3], [5e-8])
    qx, qy = (np.fft.fft2(one[0]) for one in (part.traction_x, part.traction_y))
    along, across = (xi / alpha) ** 2, (eta / alpha) ** 2
    ux = (along * found.F11 + across * found.Fs) * qx
    ux = np.fft.ifft2(ux + cross * xi * eta / alpha**2 * (found.F11 - found.Fs) * qy).real
    ux -= ux.mean()
    stick = part.zones[0] == Zone.STICK
    assert ux[stick] == approx(part.displacement[-1], 1e-8)
    size = np.hypot(part.traction_x[0], part.traction_y[0])
    assert np.all(size <= 0.3 * result.pressure * (1.0 + 1e-12))
    slips = part.zones[0] > Zone.STICK
    assert size[slips] == approx(0.3 * result.pressure[slips], rel=1e-12)


def test_one_component_is_close_to_two():
    """nu = 0.3, rough: the displacement within 0.1 %, a transverse traction of 3 to 10 %."""
    solid = material(2e9, 0.3)
    one = rough(slip(ratios(0.6), 0.4), solid).of(ck.PartialSlip)
    two = rough(slip(ratios(0.6), 0.4, components=2), solid).of(ck.PartialSlip)
    assert two.displacement[-1] == approx(one.displacement[-1], rel=2e-3)
    assert two.displacement[-1] != approx(one.displacement[-1], rel=1e-5)
    transverse = np.abs(two.traction_y).max() / np.abs(two.traction_x).max()
    assert 0.03 < transverse < 0.1
    free = rough(slip(ratios(0.6), 0.4, components=2, guided=False), solid).of(ck.PartialSlip)
    assert abs(free.transverse_force[-1]) < 1e-9 * free.force[-1]
    assert abs(two.transverse_force[-1]) > 1e-4 * two.force[-1]
    assert two.transverse_displacement[-1] == 0.0 != free.transverse_displacement[-1]


def test_imposed_displacement_and_force_are_one_problem():
    solid = material(2e9, 0.3)
    forced = rough(slip(ratios(0.6, -0.3)), solid).of(ck.PartialSlip)
    path = tuple(ck.TangentialStep(displacement=float(d)) for d in forced.displacement[1:])
    moved = rough(slip(path), solid).of(ck.PartialSlip)
    assert moved.force == approx(forced.force, rel=1e-6)
    far = (ck.TangentialStep(displacement=1e-6), ck.TangentialStep(displacement=2e-6, steps=3))
    slid = rough(slip(far), solid).of(ck.PartialSlip)
    full = 0.3 * 3e6 * 1e-12
    assert slid.force[1:] == approx(full, rel=1e-9)
    assert slid.energy_loss(0, 1) == approx(full * 1e-6, rel=1e-9)
    assert slid.stick_fraction[-1] == 0.0 == slid.stiffness[-1]
