"""Films on faces: roughness, reliefs, images in files, and cavities under a sphere."""

import math

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.fmu.native.film import prepared_film
from contactkit.lubrication.reynolds import flow_factors

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

R = 3.175e-3
ETA, GAP, SPEED = 0.1, 5e-6, 1e-3
OIL = ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=ETA))
PULL = ck.ImposedForce(initial_gap=GAP, final_gap=25e-6, force=40.0, mass=0.02)
ROUGHLY = ck.Accuracy(film_rtol=1e-2)
WAVE = ck.Wave(amplitude=1e-6, wavelength=2e-5)
RIDGES = ck.FineRoughness(surface=WAVE, width=2e-5, pixels=32)


def scene(face, *effects, other=None, loading=PULL, meniscus=OIL):
    return ck.SeparationScene(
        interface=ck.Interface(lower=other or ck.Flat(), upper=face, meniscus=meniscus),
        loading=loading,
        effects=(ck.ViscousForce(), *effects),
    )


def force(face, gap=GAP, **more):
    return ck.plan(scene(face, **more), ROUGHLY).force(gap, SPEED)


def numbers(made):
    return {one.name: one for one in made.validity([(GAP, SPEED)])}


# Fine roughness by its flow factors ---------------------------------------------------------------


def ridges_on_a_disc(gap):
    """Between conductivities of the mean of h^3 and of its harmonic mean the pressure is parabolic.

    p = A (R^2 - r^2) solves (kx p,x),x + (ky p,y),y = 12 eta v with A = 6 eta v/(kx + ky).
    """
    h = gap - 1e-6 * np.cos(2.0 * np.pi * np.arange(2000) / 2000)
    across, along = 1.0 / np.mean(h**-3), np.mean(h**3)
    return 0.5 * math.pi * R**4 * 6.0 * ETA * SPEED / (across + along)


def test_ridges_on_a_disc_have_the_conductivities_of_their_profile():
    made = ck.plan(scene(ck.Flat(radius=R, roughness=RIDGES)), ROUGHLY)
    for gap in (GAP, 8e-6, 2e-5):
        assert made.force(gap, SPEED) == pytest.approx(ridges_on_a_disc(gap), rel=5e-4)
    assert made.force(GAP, SPEED) > 1.02 * force(ck.Flat(radius=R))
    assert "Patir and Cheng" in made.cite()
    known = numbers(made)
    for name in ("mean gap over rms roughness", "patch of roughness over the face"):
        assert known[name].is_valid, name
    assert known["mean gap over rms roughness"].value == pytest.approx(5.0 * math.sqrt(2.0))


def test_fine_roughness_on_another_planform_divides_by_its_flow_factor():
    """Of an isotropic patch whatever the outline, as the pressure is that of a smaller gap."""
    egg_box = ck.Wave(amplitude=1e-6, wavelength=2e-5, wavelength_y=2e-5)
    fine = ck.FineRoughness(surface=egg_box, width=2e-5, pixels=32)
    half = ck.Sector(radius=R, start=0.0, end=math.pi)
    rough, smooth = (force(ck.Flat(planform=half, roughness=one)) for one in (fine, None))
    factor = flow_factors(GAP - fine.patch()[0], fine.patch()[1]).factors[0]
    assert 0.9 < factor < 0.999
    assert rough * factor == pytest.approx(smooth, rel=2e-4)


@pytest.mark.slow  # 2 s
def test_gaussian_roughness_is_that_of_perturbation_theory_and_of_patir_and_cheng():
    """Of isotropic roughness 1 - 3/2 (sigma/h)^2 (Tripp 1983), and 1 - 0.9 exp(-0.56 h/sigma)."""
    gauss = ck.GaussianRoughness(rms=1e-6, correlation_length=2e-5, cutoff=8e-6)
    fine = ck.FineRoughness(surface=gauss, width=2e-4, pixels=96)
    rough = force(ck.Flat(radius=R, roughness=fine))
    sigma = float(fine.patch()[0].std())
    factor = 1.0 - 0.9 * math.exp(-0.56 * GAP / sigma)
    ratio = rough / force(ck.Flat(radius=R))
    assert ratio - 1.0 == pytest.approx(1.5 * (sigma / GAP) ** 2, rel=0.1)
    assert ratio == pytest.approx(1.0 / factor, rel=0.01)


@pytest.mark.slow  # 2 s
def test_a_rough_face_in_motion_file_study_and_native_fmu(tmp_path):
    made = scene(ck.Flat(radius=R, roughness=RIDGES))
    result = ck.simulate(ck.plan(made, ROUGHLY))
    assert result.status == "released"
    path = ck.save_scene(made, tmp_path / "rough.toml")
    assert "roughness" in path.read_text("utf-8")
    assert ck.load_scene(path) == made
    assert ck.load_result(result.save(tmp_path / "rough")).plan.scene == made
    vary = {"interface.upper.surface.roughness.surface.amplitude": ["0.1 um", "1 um"]}
    fine, coarse = ck.study(made, vary, ROUGHLY).column("release_time")
    assert coarse == result.state.release_time
    assert 1.01 * fine < coarse
    tables = prepared_film(made, ROUGHLY).tables
    assert tables.films[0].laws  # the table of its force, as of every full film


@pytest.mark.parametrize(
    ("made", "message"),
    [
        (scene(ck.Flat(radius=R, roughness=RIDGES), ck.TensionLimit()), "needs smooth faces: cav"),
        (scene(ck.Flat(radius=R, roughness=RIDGES, tilt=(1e-4, 0.0))), "even faces; beside tilt"),
        (
            scene(ck.Flat(roughness=RIDGES, radius=R), other=ck.Flat(radius=R, roughness=RIDGES)),
            "FineRoughness on one face",
        ),
        (scene(ck.Sphere(radius=1.0), other=ck.Flat(radius=R, roughness=RIDGES)), "beside tilt"),
        (scene(ck.Flat(radius=R, roughness=RIDGES), ck.ShearLimit(strength=1e6)), "even disc"),
    ],
)
def test_what_flow_factors_do_not_know_is_refused(made, message):
    with pytest.raises(ck.PlanError, match=message):
        ck.plan(made)


@pytest.mark.parametrize(
    ("fine", "message"),
    [
        (lambda: ck.FineRoughness(surface=WAVE), "width must be given where no surface"),
        (lambda: ck.FineRoughness(surface=WAVE, width=3e-5), "fit a whole number of times"),
        (lambda: ck.FineRoughness(surface=WAVE, width=2e-5, pixels=1), "at least two pixels"),
        (lambda: ck.FineRoughness(surface=ck.Flat(), width=2e-5), "be a surface with heights"),
        (
            lambda: ck.FineRoughness(
                surface=ck.Heights(heights=np.eye(4) * 1e-7, pixel_size=1e-6), width=1e-5
            ),
            "be left out: a measured surface has its own",
        ),
        (
            lambda: ck.FineRoughness(surface=evolve(WAVE, amplitude=6e-6), width=2e-5),
            "leave the film open",  # ridges that touch let nothing across
        ),
    ],
)
def test_a_patch_that_makes_no_sense_is_refused(fine, message):
    with pytest.raises(ck.DescriptionError, match=message):
        ck.plan(scene(ck.Flat(radius=R, roughness=fine())))


# Reliefs ------------------------------------------------------------------------------------------


@pytest.mark.slow  # 2 s
def test_any_surface_with_heights_is_a_relief():
    bowl = force(ck.Flat(radius=R, relief=ck.Paraboloid(radius=1.0)))
    assert bowl == pytest.approx(force(ck.Flat(radius=R, crown_radius=1.0)), rel=2e-3)
    face = ck.Rectangle(length=4e-3, width=3e-3)
    wave = ck.Wave(amplitude=1e-6, wavelength=2e-3)
    x = (np.arange(512) - 255.5) * 4e-3 / 512
    drawn = 1e-6 * np.cos(2.0 * np.pi * (x - x[0]) / 2e-3) * np.ones((2, 1))
    same = ck.Heights(heights=drawn, pixel_size=(1e-2, 4e-3 / 512))
    made = force(ck.Flat(planform=face, relief=wave))
    assert made == pytest.approx(force(ck.Flat(planform=face, relief=same)), rel=1e-4)
    assert made > 1.01 * force(ck.Flat(planform=face))
    both = ck.CombinedSurface(parts=(same, ck.Paraboloid(radius=1e5)))
    assert force(ck.Flat(planform=face, relief=both)) == pytest.approx(made, rel=5e-3)


def test_a_measured_relief_in_a_scene_file_is_looked_for_beside_it(tmp_path, monkeypatch):
    ramp = -5e-4 * 1e-3 * (np.arange(5) - 2.0) * np.ones((5, 1))
    np.save(tmp_path / "ramp.npy", ramp)
    relief = ck.Measured(path=tmp_path / "ramp.npy", pixel_size=1e-3, unit="m", detrend="none")
    face = ck.Flat(planform=ck.Rectangle(length=4e-3, width=3e-3), relief=relief)
    tilted = ck.Flat(planform=face.planform, tilt=(5e-4, 0.0))
    assert force(face, GAP + 1e-6) == pytest.approx(force(tilted), rel=5e-3)
    path = ck.save_scene(scene(face), tmp_path / "face.toml")
    assert 'path = "ramp.npy"' in path.read_text("utf-8")
    monkeypatch.chdir(tmp_path.parent)
    assert ck.load_scene(path).interface.upper.surface.relief.path == str(tmp_path / "ramp.npy")


@pytest.mark.parametrize(
    ("relief", "message"),
    [
        (lambda: ck.Flat(), "be a surface with heights"),
        (lambda: ck.Wave(amplitude=1e-7, wavelength=1e-5), "roughness that is finer has flow fac"),
        (
            lambda: ck.Heights(
                heights=np.ma.masked_less([[0.0, 1e-7], [0.0, 1e-7]], 1e-9), pixel_size=1e-3
            ),
            "have heights at every pixel",
        ),
        (lambda: ck.Sphere(radius=R), "exceed half the diagonal"),
    ],
)
def test_a_relief_that_a_film_cannot_have_is_refused(relief, message):
    with pytest.raises(ck.DescriptionError, match=message):
        ck.plan(scene(ck.Flat(radius=R, relief=relief())), ROUGHLY)


# Images in files ----------------------------------------------------------------------------------


def drawn_disc(n=64):
    x = np.arange(n) - 0.5 * (n - 1)
    return np.clip(0.5 + 0.4 * n - np.hypot(x, x[:, None]), 0.0, 1.0)


@pytest.fixture
def image(tmp_path):
    np.save(tmp_path / "disc.npy", drawn_disc())
    return ck.ImageFile(path=tmp_path / "disc.npy", pixel_size=R / (0.4 * 64))


def test_an_image_in_a_file_is_the_image(image, tmp_path, monkeypatch):
    array = ck.Image(coverage=drawn_disc(), pixel_size=image.pixel_size)
    assert image.area == array.area == pytest.approx(math.pi * R**2, rel=2e-3)
    made = force(ck.Flat(planform=image))
    assert made == force(ck.Flat(planform=array))
    assert made == pytest.approx(force(ck.Flat(radius=R)), rel=5e-3)
    path = ck.save_scene(scene(ck.Flat(planform=image)), tmp_path / "face.toml")
    assert 'path = "disc.npy"' in path.read_text("utf-8")
    monkeypatch.chdir(tmp_path.parent)
    loaded = ck.load_scene(path)
    assert loaded.interface.upper.surface.planform.path == str(tmp_path / "disc.npy")
    assert ck.plan(loaded, ROUGHLY).force(GAP, SPEED) == made
    with pytest.raises(ck.DescriptionError, match=r"use ImageFile\(path="):
        ck.save_scene(scene(ck.Flat(planform=array)), tmp_path / "other.toml")


def test_a_png_has_its_top_at_the_largest_y_and_may_be_drawn_dark(tmp_path):
    drawn = pytest.importorskip("PIL.Image")
    grey = np.zeros((4, 4), np.uint8)
    grey[0, :] = 255
    drawn.fromarray(grey).save(tmp_path / "bar.png")
    bar = ck.ImageFile(path=tmp_path / "bar.png", pixel_size=1e-3)
    assert bar.level(0.0, 1.5e-3) > 0.0 > bar.level(0.0, -1.5e-3)
    rest = evolve(bar, inverted=True)
    assert rest.level(0.0, -1.5e-3) > 0.0 > rest.level(0.0, 1.5e-3)
    assert bar.area + rest.area == pytest.approx(16e-6)


def test_an_image_that_changes_is_read_again_and_names_points_of_a_store_by_content(
    image, tmp_path
):
    from contactkit.studies.store import scene_key

    before = image.area, scene_key(scene(ck.Flat(planform=image)), ROUGHLY)
    (tmp_path / "copy").mkdir()
    (tmp_path / "copy" / "disc.npy").write_bytes((tmp_path / "disc.npy").read_bytes())
    copy = evolve(image, path=tmp_path / "copy" / "disc.npy")
    assert scene_key(scene(ck.Flat(planform=copy)), ROUGHLY) == before[1]
    np.save(tmp_path / "disc.npy", np.ones((8, 8)))
    assert image.area == pytest.approx(64.0 * image.pixel_size**2)
    assert scene_key(scene(ck.Flat(planform=image)), ROUGHLY) != before[1]


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("none.npy", None, "be a file that exists"),
        ("disc.gif", b"GIF89a", "end in .npy or .png"),
        ("disc.npy", b"no array", "be a numpy file"),
        ("disc.png", b"no image", "be a PNG image"),
        ("greys.npy", np.full((2, 2), 255.0), "lie between 0 and 1"),
        ("line.npy", np.ones(3), "be a map of numbers"),
    ],
)
def test_a_file_that_holds_no_image_is_refused(tmp_path, name, content, message):
    if name.endswith(".png"):
        pytest.importorskip("PIL")
    if isinstance(content, bytes):
        (tmp_path / name).write_bytes(content)
    elif content is not None:
        np.save(tmp_path / name, content)
    with pytest.raises(ck.DescriptionError, match=message):
        _ = ck.ImageFile(path=tmp_path / name, pixel_size=1e-6).area
    np.save(tmp_path / "ones.npy", np.ones((2, 2)))
    with pytest.raises(ck.DescriptionError, match="checksum"):
        _ = ck.ImageFile(path=tmp_path / "ones.npy", pixel_size=1e-6, checksum="0" * 64).area
    with pytest.raises(ck.DescriptionError, match="be a file that exists"):
        _ = ck.ImageFile(path="a" * 5000, pixel_size=1e-6).area


def test_an_image_that_is_covered_up_to_its_edge_ends_there():
    """The film used to go on to the edge of the grid: a quarter more force, without a word."""
    bar = np.zeros((40, 60))
    bar[10:30] = 1.0
    whole = np.ones((20, 60))
    exact = force(ck.Flat(planform=ck.Rectangle(length=6e-3, width=2e-3)))
    for drawn in (bar, whole):
        image = ck.Image(coverage=drawn, pixel_size=1e-4)
        assert force(ck.Flat(planform=image)) == pytest.approx(exact, rel=2e-3)
        assert float(image.level(3e-3, 0.0)) == pytest.approx(0.0, abs=1e-12)
        assert float(image.level(4e-3, 0.0)) == pytest.approx(-1e-3)


def test_a_pixel_of_three_sizes_is_refused():
    """The area used to be that of the first two."""
    for kind, where in ((ck.Image, {"coverage": np.ones((2, 2))}), (ck.ImageFile, {"path": "a"})):
        with pytest.raises(ck.DescriptionError, match=r"pixel_size must be one length or a pair"):
            kind(pixel_size=(1e-6, 1e-6, 1e-6), **where)


# Cavities under a sphere on a face ----------------------------------------------------------------

LIMIT = ck.TensionLimit(strength=2e5)
FACE = ck.Flat(radius=R)
SPHERE = ck.Sphere(radius=1.0)


@pytest.mark.slow  # 3 s
def test_a_cavity_under_a_sphere_is_that_under_a_crown():
    """A crown of the face, whose cavity is tested by itself, has the same gap."""
    ball = scene(SPHERE, LIMIT, other=FACE)
    crown = scene(evolve(FACE, crown_radius=1.0), LIMIT)
    under, on = (ck.simulate(ck.plan(one, ROUGHLY)) for one in (ball, crown))
    assert under.state.release_time == on.state.release_time
    assert under.impulses == on.impulses
    assert under.state.cavity.void == on.state.cavity.void > 0.0
    full = ck.simulate(ck.plan(scene(SPHERE, other=FACE), ROUGHLY))
    assert under.state.release_time < 0.1 * full.state.release_time
    tables = [prepared_film(one, ROUGHLY).tables for one in (ball, crown)]
    is_same = tables[0] == tables[1]  # so that the native FMU is the same
    assert is_same


def test_a_cavity_under_a_sphere_is_refused_where_the_film_has_no_rim():
    drop = evolve(OIL, volume=1e-11)
    for made, message in (
        (scene(SPHERE, LIMIT), r"a Flat with a radius .*or cavity=\"truncated\""),
        (scene(SPHERE, LIMIT, other=FACE, meniscus=drop), r"a flooded film.*or cavity=\"trunc"),
    ):
        with pytest.raises(ck.PlanError, match=message):
            ck.plan(made)
