"""A contact does what its effects say, in one scene, and nothing else."""

from __future__ import annotations

import math
import tracemalloc

import attrs
import numpy as np
import pytest

import contactkit as ck
from contactkit.kinds import CONTACT_EFFECTS

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3, hardness=7e9)
DLC = ck.Material(name="dlc", young_modulus=140e9, poisson_ratio=0.25, hardness=20e9)
COATED = ck.Stack(layers=(ck.Layer(material=DLC, thickness=5e-9),), substrate=STEEL)
WATER = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.07275)
SCENE = ck.ContactScene(
    name="slider on a disk",
    interface=ck.Interface(
        lower=ck.Body(solid=COATED),
        upper=ck.Body(
            surface=ck.GaussianRoughness(rms=1e-9, correlation_length=2e-7, cutoff=8e-8),
            solid=STEEL,
        ),
        meniscus=ck.Meniscus(liquid=WATER, contact_angle_lower=1.0, contact_angle_upper=1.0),
    ),
    window=ck.Window(width=1e-6),
    loading=ck.Pressing(pressure=3e7),
    effects=(ck.LayeredHalfSpace(),),
)
ALL = (
    ck.LayeredHalfSpace(),
    ck.HardnessLimit(),
    ck.FrictionTraction(coefficient=0.3),
    ck.FrictionCoupling(),
    ck.SubsurfaceStress(depths=(0.0, 2e-9, 5e-9, 2e-8)),
    ck.FilmMeniscus(film_thickness=1e-9),
    ck.IslandBridges(film_thickness=2e-10),
)


def made(*effects, grid=48, **given):
    return ck.plan(
        attrs.evolve(SCENE, effects=(ck.LayeredHalfSpace(), *effects), **given),
        ck.Accuracy(grid=grid),
    )


def solved(*effects, **given):
    return ck.solve(made(*effects, **given))


@pytest.fixture(scope="module")
def everything():
    return ck.solve(ck.plan(attrs.evolve(SCENE, effects=ALL), ck.Accuracy(grid=48)))


def test_a_plan_says_what_is_on_and_what_is_off():
    plan = made(ck.FrictionTraction(coefficient=0.3))
    lines = str(plan).splitlines()
    assert lines[0].startswith("slider on a disk: mean pressure 3e+07 Pa, window 1e-06 m x 1e-06 m")
    assert "periodic" in lines[0]
    assert "48 x 48 pixels" in lines[0]
    on = {line.split()[1] for line in lines if line.split()[0] == "on"}
    off = {line.split()[1] for line in lines if line.split()[0] == "off"}
    assert on == {"layered-half-space", "friction-traction"}
    assert on | off == {kind.name for kind in CONTACT_EFFECTS}
    assert not on & off


def test_only_what_is_on_is_cited():
    none, some = made().cite(), made(ck.FrictionTraction(coefficient=0.3)).cite()
    assert "Goodman" in some
    assert "Goodman" not in none
    assert "Love" not in none  # a periodic window has no patches
    free = made(window=ck.Window(width=1e-6, periodic=False)).cite()
    assert "Love" in free


def test_every_effect_has_its_part_and_its_numbers(everything):
    numbers = everything.scalars()
    assert set(numbers) >= {
        "hardness",
        "plastic_area",
        "friction_force",
        "coupling_pressure_change",
        "max_von_mises",
        "max_von_mises_depth",
        "meniscus_force",
        "n_menisci",
        "island_force",
        "n_island_bridges",
        "island_coverage",
    }
    assert all(math.isfinite(value) for value, _ in numbers.values())
    for kind in CONTACT_EFFECTS[2:]:
        assert not everything.has(kind) or everything.of(kind) is not None
    alone = solved().scalars()
    assert set(alone) == {
        "load",
        "mean_pressure",
        "max_pressure",
        "contact_area",
        "contact_fraction",
        "corrected_contact_area",
        "max_displacement",
        "approach",
        "residual",
        "energy",
    }


def test_what_only_looks_changes_nothing():
    alone = solved()
    watched = solved(*ALL[2:3], *ALL[4:])
    np.testing.assert_array_equal(watched.pressure, alone.pressure)
    np.testing.assert_array_equal(watched.displacement, alone.displacement)
    assert watched.work.n_operator_applications == alone.work.n_operator_applications
    assert watched.work.n_ffts == alone.work.n_ffts


def test_the_order_of_the_effects_does_not_matter(everything):
    reverse = attrs.evolve(SCENE, effects=ALL[::-1])
    again = ck.solve(ck.plan(reverse, ck.Accuracy(grid=48)))
    np.testing.assert_array_equal(again.pressure, everything.pressure)
    assert again.scalars() == everything.scalars()


def test_the_hardness_lies_between_those_of_the_materials(everything):
    part = everything.of(ck.HardnessLimit)
    assert 7e9 <= part.hardness <= 20e9
    assert everything.max_pressure <= part.hardness * (1.0 + 1e-12)
    assert everything.plastic_area == part.area


def test_friction_drags_by_its_coefficient_along_its_direction():
    part = solved(ck.FrictionTraction(coefficient=0.3, direction=0.5)).of(ck.FrictionTraction)
    run = solved()
    assert part.force == pytest.approx(0.3 * run.load)
    np.testing.assert_allclose(part.traction_x, 0.3 * math.cos(0.5) * run.pressure)
    np.testing.assert_allclose(part.traction_y, 0.3 * math.sin(0.5) * run.pressure)


def test_the_surface_plane_is_the_load_itself():
    """At z = 0: szz = -p and sxz = -mu p, whatever lies below; both faces of each interface."""
    run = solved(
        ck.FrictionTraction(coefficient=0.3), ck.SubsurfaceStress(depths=(0.0, 8e-9), keep="planes")
    )
    part = run.of(ck.SubsurfaceStress)
    size = 1e-9 * run.max_pressure
    np.testing.assert_allclose(part.planes[2, 0], -run.pressure, rtol=0, atol=size)
    np.testing.assert_allclose(part.planes[4, 0], -0.3 * run.pressure, rtol=0, atol=size)
    above, below = np.flatnonzero(np.isclose(part.depth, 5e-9, rtol=1e-9, atol=0.0))
    assert (part.side[above], part.layer[above]) == ("-", 0)
    assert (part.side[below], part.layer[below]) == ("+", 1)
    for component in (2, 4, 5):  # what acts across the interface is continuous, the rest jumps
        np.testing.assert_allclose(
            part.planes[component, above], part.planes[component, below], rtol=0, atol=size
        )
    assert np.abs(part.planes[0, above] - part.planes[0, below]).max() > 1e3 * size


def test_a_section_is_a_row_of_the_planes_and_the_maxima_are_theirs():
    depths = (1e-9, 4e-9, 2e-8)
    friction = ck.FrictionTraction(coefficient=0.3)
    kept = solved(friction, ck.SubsurfaceStress(depths=depths, keep="planes"))
    kept = kept.of(ck.SubsurfaceStress)
    part = solved(friction, ck.SubsurfaceStress(depths=depths)).of(ck.SubsurfaceStress)
    assert part.planes is None
    np.testing.assert_array_equal(part.section, kept.planes[:, :, part.row])
    xx, yy, zz, xy, xz, yz = kept.planes
    mises = np.sqrt(
        0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3.0 * (xy**2 + xz**2 + yz**2)
    )
    np.testing.assert_allclose(part.largest_von_mises, mises.max(axis=(1, 2)), rtol=1e-9)
    tensor = np.moveaxis(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), (0, 1), (-2, -1))
    principal = np.linalg.eigvalsh(tensor)
    most = {
        "von_mises": mises,
        "tension": principal[..., 2],
        "sigma_xz": np.abs(xz),
        "tresca": 0.5 * (principal[..., 2] - principal[..., 0]),
    }
    for name, values in most.items():
        assert part.maxima[name].value == pytest.approx(values.max(), rel=1e-9), name


@pytest.mark.slow
def test_a_scan_holds_one_plane_at_a_time():
    """Peak memory of a section does not grow with the planes; keeping them does."""

    def memory(n, keep):
        """Peak of a solve, and what its result holds."""
        plan = made(
            ck.SubsurfaceStress(depths=tuple(1e-9 * (k + 1) for k in range(n)), keep=keep), grid=96
        )
        ck.solve(plan)  # imports and caches
        tracemalloc.start()
        try:
            kept = ck.solve(plan)
            held, peak = tracemalloc.get_traced_memory()
            assert kept.status == "converged"
            return peak, held
        finally:
            tracemalloc.stop()

    plane = 6 * 96 * 96 * 8
    (few, _), (many, held) = memory(4, "section"), memory(24, "section")
    assert many - few < 4 * plane
    assert memory(24, "planes")[1] - held > 16 * plane


def test_the_stress_below_a_rigid_flat_of_a_periodic_window_is_uniaxial():
    """No lateral strain: sxx = syy = -nu/(1 - nu) p in each layer."""
    interface = attrs.evolve(SCENE.interface, upper=ck.Body())
    run = solved(
        ck.SubsurfaceStress(depths=(1e-9, 1e-8), keep="planes"), interface=interface, grid=8
    )
    part = run.of(ck.SubsurfaceStress)
    for plane, layer in enumerate(part.layer):
        nu = (DLC, STEEL)[layer].poisson_ratio
        fraction = nu / (1.0 - nu)
        wanted = -3e7 * np.array([fraction, fraction, 1.0, 0.0, 0.0, 0.0])
        stress = part.planes[:, plane].reshape(6, -1)
        np.testing.assert_allclose(stress, np.repeat(wanted[:, None], 64, 1), atol=1e-2)


def test_a_film_reports_its_pull_and_leaves_the_load_alone():
    run, alone = solved(ck.FilmMeniscus(film_thickness=1e-9)), solved()
    part = run.of(ck.FilmMeniscus)
    np.testing.assert_array_equal(run.pressure, alone.pressure)
    wet = (run.gap < 1e-9) & (run.pressure == 0.0)
    np.testing.assert_array_equal(part.is_meniscus, wet)
    area = wet.sum() * run.plan.grid.pixel_area
    assert part.area == pytest.approx(area)
    assert part.force == pytest.approx(0.07275 * 2.0 * math.cos(1.0) * area / 1e-9)
    assert part.relative_force == pytest.approx(part.force / run.load)


def test_menisci_higher_than_the_film_stand_only_on_islands_that_touch_it():
    low = solved(ck.FilmMeniscus(film_thickness=5e-10)).of(ck.FilmMeniscus)
    high = ck.FilmMeniscus(film_thickness=5e-10, meniscus_height=1.5e-9)
    run = solved(high)
    part = run.of(ck.FilmMeniscus)
    assert low.area < part.area
    assert not (part.is_meniscus & (run.gap >= 1.5e-9)).any()
    corners = attrs.evolve(high, connectivity=4)
    assert solved(corners).of(ck.FilmMeniscus).area <= part.area


def test_a_force_is_the_pressure_over_the_window():
    window = ck.Window(width=1e-6, height=0.5e-6)
    force = solved(window=window, loading=ck.Pressing(force=1.5e-5), grid=(24, 48))
    pressure = solved(window=window, loading=ck.Pressing(pressure=3e7), grid=(24, 48))
    np.testing.assert_allclose(force.pressure, pressure.pressure, rtol=1e-9)
    assert force.load == pytest.approx(1.5e-5, rel=1e-12)


def test_press_is_the_scene_in_one_line():
    heights = 1e-9 * np.random.default_rng(2).normal(size=(20, 24))
    hardness = np.full((20, 24), 5e9)
    run = ck.press(heights, (1e-8, 2e-8), COATED, 2e8, hardness=hardness)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=COATED),
            upper=ck.Body(surface=ck.Heights(heights=heights, pixel_size=(1e-8, 2e-8))),
        ),
        loading=ck.Pressing(pressure=2e8),
        effects=(
            ck.LayeredHalfSpace(),
            ck.HardnessLimit(rule=ck.ConstantHardness(hardness=5e9)),
        ),
    )
    same = ck.solve(ck.plan(scene))
    np.testing.assert_allclose(run.pressure, same.pressure, atol=1e-6 * 5e9)
    assert (run.status, run.pressure.shape) == ("converged", (20, 24))
    assert run.plastic_area == pytest.approx(same.plastic_area)
    assert run.work.n_operator_applications > 0
    assert run.work.seconds > 0.0


@pytest.mark.parametrize("method", ["active-set", "quasi-newton", "conjugate-gradient"])
@pytest.mark.parametrize("periodic", [True, False], ids=["periodic", "free"])
def test_every_solver_finds_the_same_contact(method, periodic):
    scene = attrs.evolve(SCENE, window=ck.Window(width=1e-6, periodic=periodic))
    runs = [
        ck.solve(ck.plan(scene, ck.Accuracy(grid=32, method=m))) for m in ("active-set", method)
    ]
    np.testing.assert_allclose(
        runs[1].pressure, runs[0].pressure, rtol=0, atol=1e-5 * runs[0].max_pressure
    )


@pytest.mark.parametrize(
    ("effects", "problem"),
    [
        (
            (ck.FrictionTraction(coefficient=0.5), ck.FrictionCoupling()),
            "friction",
        ),
        ((ck.FilmMeniscus(film_thickness=1e-9, self_consistent=True),), "film"),
    ],
    ids=["friction", "film"],
)
def test_outer_iterations_that_run_out_say_so_and_hand_over_what_they_reached(
    effects, problem, monkeypatch
):
    monkeypatch.setattr("contactkit.contact.outer.iteration.MAX_ITERATIONS", 1)
    plan = made(*effects, grid=32, loading=ck.Pressing(pressure=3e8))
    with pytest.raises(ck.ConvergenceError, match=problem) as caught:
        ck.solve(plan)
    reached = ck.solve(plan, throw=False)
    assert (reached.status, reached.message) == ("not converged", str(caught.value))
    np.testing.assert_array_equal(caught.value.result.pressure, reached.pressure)
    assert reached.residual < 1e-8
    assert reached.load == pytest.approx(3e8 * reached.plan.grid.area, rel=0.5)


def test_a_roughness_is_the_same_surface_every_time_and_another_for_another_seed():
    one, again = solved(grid=32), solved(grid=32)
    np.testing.assert_array_equal(one.heights, again.heights)
    assert one.heights.std() == pytest.approx(1e-9, rel=0.5)
    surface = attrs.evolve(SCENE.interface.upper.surface, seed=2)
    upper = attrs.evolve(SCENE.interface.upper, surface=surface)
    other = solved(interface=attrs.evolve(SCENE.interface, upper=upper), grid=32)
    assert np.abs(other.heights - one.heights).max() > 1e-9


def test_surfaces_add_up():
    ball = ck.Paraboloid(radius=1e-4)
    rough = SCENE.interface.upper.surface
    upper = ck.Body(surface=ck.CombinedSurface(parts=(ball, rough)), solid=STEEL)
    free = ck.Window(width=1e-6, periodic=False)
    both = solved(interface=attrs.evolve(SCENE.interface, upper=upper), window=free, grid=32)
    split = attrs.evolve(
        SCENE.interface,
        lower=ck.Body(surface=ball, solid=COATED),
        upper=ck.Body(surface=rough, solid=STEEL),
    )
    np.testing.assert_array_equal(
        solved(interface=split, window=free, grid=32).pressure, both.pressure
    )
