"""Contact scenes and results survive the way to a file and back."""

from __future__ import annotations

import json
from pathlib import Path

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import contactkit as ck
from contactkit.contact.result import ContactResult
from contactkit.files.results import from_bytes, to_bytes
from contactkit.kinds import CONTACT_EFFECTS

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")


def decades(low, high):
    return st.floats(low, high).map(lambda exponent: 10.0**exponent)


# Scenes -------------------------------------------------------------------------------------

lengths, stresses = decades(-10.0, -2.0), decades(3.0, 12.0)
pairs = lengths | st.tuples(lengths, lengths)
# Of any letters: files take no control characters.
names = st.text(st.characters(exclude_categories=("Cc", "Cs")), max_size=12)
materials = st.builds(
    ck.Material,
    name=names,
    young_modulus=stresses,
    poisson_ratio=st.floats(-0.9, 0.5),
    hardness=st.none() | stresses,
) | st.sampled_from(["dlc", "ni-p"]).map(ck.load_material)
materials |= st.builds(
    ck.ViscoelasticMaterial,
    name=names,
    young_modulus=stresses,
    poisson_ratio=st.floats(-0.9, 0.5),
    fractions=st.just((0.5, 0.25)),
    times=st.tuples(decades(-9.0, -1.0), decades(0.0, 9.0)),
)
materials |= st.builds(
    ck.TransverselyIsotropicMaterial,
    name=names,
    young_modulus=st.just(2e9),
    axial_modulus=decades(9.5, 12.0),
    poisson_ratio=st.floats(-0.9, 0.5),
    axial_ratio=st.floats(-0.5, 0.5),
    shear_modulus=stresses,
)
layers = st.builds(ck.Layer, material=materials, thickness=lengths)
stacks = st.builds(
    ck.Stack, layers=st.lists(layers, max_size=3).map(tuple), substrate=materials
) | st.builds(
    ck.Stack,
    layers=st.lists(layers, min_size=1, max_size=3).map(tuple),
    substrate=st.builds(ck.RigidBase, bonded=st.booleans()),
)
solids = materials | stacks
shapes = st.one_of(
    st.builds(ck.Flat, radius=st.none() | lengths),
    st.builds(ck.Sphere, radius=lengths),
    st.builds(ck.Paraboloid, radius=lengths, radius_y=st.none() | lengths),
    st.builds(ck.Wave, amplitude=lengths, wavelength=lengths, wavelength_y=st.none() | lengths),
    st.builds(
        ck.GaussianRoughness,
        rms=lengths,
        correlation_length=pairs,
        cutoff=lengths,
        seed=st.integers(0, 2**40),
    ),
    st.builds(
        ck.SelfAffineRoughness,
        rms=lengths,
        hurst=st.floats(0.01, 1.0),
        rolloff=decades(-5.0, -3.0),
        cutoff=decades(-9.0, -6.0),
        seed=st.integers(0, 99),
    ),
    st.builds(
        ck.Measured,
        path=st.sampled_from(["map.npy", 'folder/a "quoted" µ.xyz']).map(
            lambda name: str(Path.cwd().resolve() / name)  # as a scene that is read has it
        ),
        pixel_size=st.none() | pairs,
        unit=st.sampled_from([None, "nm"]),
        detrend=st.sampled_from(["tilt", "none", "mean", "curvature"]),
        flipped=st.booleans(),
        checksum=st.sampled_from([None, "0" * 64]),
    ),
)
surfaces = shapes | st.builds(ck.CombinedSurface, parts=st.lists(shapes, max_size=3).map(tuple))
menisci = st.builds(
    ck.Meniscus,
    liquid=st.just(ck.load_liquid("water"))
    | st.builds(ck.Liquid, name=names, surface_tension=st.floats(1e-3, 1.0)),
    contact_angle_lower=st.floats(0.0, 3.14),
    count=st.integers(1, 9),
)
interfaces = st.builds(
    ck.Interface,
    lower=st.builds(ck.Body, surface=surfaces, solid=solids),
    upper=st.builds(ck.Body, surface=surfaces, solid=st.none() | solids),
    meniscus=st.none() | menisci,
)
pressings = st.one_of(
    st.builds(ck.Pressing, pressure=stresses),
    st.builds(ck.Pressing, force=decades(-9.0, 3.0)),
    st.builds(ck.Approach, approach=st.floats(-1e-6, 1e-6)),
)
displacements = st.sampled_from(["largest", "local"])
hardness_rules = st.builds(
    ck.HardnessLimit,
    rule=st.one_of(
        st.builds(ck.ContinuousHardness, shift=st.floats(0.0, 1.0), displacement=displacements),
        st.builds(ck.LiteralHardness, displacement=displacements),
        st.builds(ck.MaterialHardness),
        st.builds(ck.ConstantHardness, hardness=stresses),
    ),
)
tangential_steps = st.one_of(
    st.builds(ck.TangentialStep, force=decades(-9.0, 3.0), steps=st.integers(1, 9)),
    st.builds(ck.TangentialStep, displacement=lengths, direction=st.none() | st.floats(-4.0, 4.0)),
    st.builds(ck.TangentialStep, ratio=st.floats(-1.0, 1.0)),
)
EFFECTS = {
    ck.HalfSpace: st.builds(ck.HalfSpace),
    ck.LayeredHalfSpace: st.builds(ck.LayeredHalfSpace),
    ck.HardnessLimit: hardness_rules,
    ck.PlasticHistory: st.builds(
        ck.PlasticHistory,
        pressures=st.lists(stresses, max_size=3).map(tuple),
        approaches=st.lists(lengths, max_size=2).map(tuple),
        steps=st.integers(1, 9),
    ),
    ck.Viscoelasticity: st.builds(
        ck.Viscoelasticity,
        times=st.lists(decades(-6.0, 6.0), min_size=1, max_size=3).map(sorted).map(tuple),
        pressures=st.lists(stresses, max_size=2).map(tuple),
        steps=st.integers(1, 9),
    ),
    ck.FrictionTraction: st.builds(
        ck.FrictionTraction, coefficient=st.floats(0.0, 1e3), direction=st.floats(-4.0, 4.0)
    ),
    ck.FrictionCoupling: st.builds(ck.FrictionCoupling),
    ck.PartialSlip: st.builds(
        ck.PartialSlip,
        coefficient=st.floats(0.0, 1.0),
        path=st.lists(tangential_steps, min_size=1, max_size=3).map(tuple),
        direction=st.floats(-4.0, 4.0),
    )
    | st.builds(
        ck.PartialSlip,
        coefficient=st.floats(0.0, 1.0),
        path=st.lists(tangential_steps, min_size=1, max_size=3).map(tuple),
        components=st.just(2),
        guided=st.booleans(),
        coupled=st.just(True),
        pressing_rtol=st.floats(1e-4, 0.1),
    ),
    ck.SubsurfaceStress: st.builds(
        ck.SubsurfaceStress,
        depths=st.none() | st.lists(lengths, min_size=1, unique=True).map(sorted),
        keep=st.sampled_from(["section", "planes"]),
        window=st.floats(1.0, 50.0),
    ),
    ck.IslandBridges: st.builds(
        ck.IslandBridges,
        film_thickness=st.none() | lengths,
        meniscus_height=st.none() | lengths,
        curvature=st.sampled_from(["island", "summit"]),
        connectivity=st.sampled_from([4, 8]),
    ),
    ck.Adhesion: st.builds(
        ck.Adhesion,
        law=st.one_of(
            st.builds(law, work_of_adhesion=decades(-4.0, 0.0), range=lengths)
            for law in (
                ck.DugdaleAttraction,
                ck.ExponentialAttraction,
                ck.LennardJonesAttraction,
            )
        ),
    ),
    ck.FilmMeniscus: st.builds(
        ck.FilmMeniscus,
        film_thickness=lengths,
        meniscus_height=st.none() | lengths,
        connectivity=st.sampled_from([4, 8]),
        self_consistent=st.booleans(),
    ),
}
scenes = st.builds(
    ck.ContactScene,
    interface=interfaces,
    window=st.builds(
        ck.Window,
        width=st.none() | lengths,
        height=st.none() | lengths,
        periodic=st.sampled_from([True, False, None, "x", "y"]),
    ),
    loading=pressings,
    effects=st.tuples(*EFFECTS.values()).flatmap(
        lambda every: st.lists(st.sampled_from(every), unique=True)
    ),
    temperature=st.floats(200.0, 500.0),
    name=names,
)


def test_every_effect_of_a_contact_is_tried_here():
    assert set(EFFECTS) == set(CONTACT_EFFECTS)


@given(scene=scenes)
def test_a_contact_scene_written_to_a_file_comes_back_the_same(tmp_path_factory, scene):
    path = tmp_path_factory.getbasetemp() / "contact.toml"
    ck.save_scene(scene, path)
    assert ck.load_scene(path) == scene


def test_a_file_may_use_names_of_the_library_and_units(tmp_path):
    path = tmp_path / "slider.toml"
    path.write_text(
        """
        name = "slider on disk"
        temperature = "25 degC"
        effects = [
            {effect = "layered-half-space"},
            {effect = "friction-traction", coefficient = 0.3, direction = "90 deg"},
            {effect = "subsurface-stress", depths = ["1 nm", "5 nm"]},
        ]
        [interface.lower.solid]
        layers = [{material = "dlc", thickness = "5 nm"}, {material = "co-cr", thickness = "20 nm"}]
        [interface.lower.solid.substrate]
        name = "mine"
        young_modulus = "130 GPa"
        poisson_ratio = 0.36
        [interface.upper]
        solid = "rigid"
        surface.shape = "combined"
        [[interface.upper.surface.parts]]
        shape = "paraboloid"
        radius = "1 mm"
        [[interface.upper.surface.parts]]
        shape = "gaussian-roughness"
        rms = "1 nm"
        correlation_length = ["50 nm", "80 nm"]
        cutoff = "10 nm"
        seed = 3
        [interface.meniscus]
        liquid = "water"
        contact_angle_upper = "60 deg"
        [window]
        width = "2 um"
        periodic = false
        [loading]
        kind = "pressing"
        force = "10 mN"
        """,
        encoding="utf-8",
    )
    scene = ck.load_scene(path)
    rough = ck.GaussianRoughness(rms=1e-9, correlation_length=(5e-8, 8e-8), cutoff=1e-8, seed=3)
    assert scene == ck.ContactScene(
        name="slider on disk",
        temperature=298.15,
        interface=ck.Interface(
            lower=ck.Body(
                solid=ck.Stack(
                    layers=(
                        ck.Layer(material=ck.load_material("dlc"), thickness=5e-9),
                        ck.Layer(material=ck.load_material("co-cr"), thickness=2e-8),
                    ),
                    substrate=ck.Material(name="mine", young_modulus=130e9, poisson_ratio=0.36),
                )
            ),
            upper=ck.Body(surface=ck.CombinedSurface(parts=(ck.Paraboloid(radius=1e-3), rough))),
            meniscus=ck.Meniscus(
                liquid=ck.load_liquid("water"), contact_angle_upper=60.0 * ck.units.deg
            ),
        ),
        window=ck.Window(width=2e-6, periodic=False),
        loading=ck.Pressing(force=0.01),
        effects=(
            ck.LayeredHalfSpace(),
            ck.FrictionTraction(coefficient=0.3, direction=90.0 * ck.units.deg),
            ck.SubsurfaceStress(depths=(1e-9, 5e-9)),
        ),
    )


# Results ------------------------------------------------------------------------------------

SOLID = ck.Stack(
    layers=(ck.Layer(material=ck.load_material("dlc"), thickness=2e-8),),
    substrate=ck.load_material("al2o3-tic"),
)
ROUGH = ck.GaussianRoughness(rms=1e-9, correlation_length=3e-7, cutoff=1.25e-7)
WATER = ck.Meniscus(liquid=ck.load_liquid("water"))
FRICTION = ck.FrictionTraction(coefficient=0.2, direction=0.3)


def contact(*effects, pressure=1e8, surface=ROUGH, **accuracy):
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=SOLID), upper=ck.Body(surface=surface), meniscus=WATER
        ),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=pressure),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    accuracy = {"grid": 16, "rtol": 1e-6} | accuracy
    return ck.solve(ck.plan(scene, ck.Accuracy(**accuracy)))


def equal(one, other):
    """Whether two parts of results agree to the last bit, arrays and what holds them."""
    if isinstance(one, np.ndarray):
        assert one.dtype == other.dtype
        return np.array_equal(one, other)
    if isinstance(one, tuple):
        return type(one) is type(other) and all(map(equal, one, other))
    if hasattr(one, "items"):
        return list(one) == list(other) and all(equal(one[k], other[k]) for k in one)
    return one == other


CALLED = {
    "nothing more": (),
    "hardness": (ck.HardnessLimit(),),
    "local hardness": (ck.HardnessLimit(rule="material"),),
    "hardness map": (
        ck.HardnessLimit(rule=ck.ConstantHardness(hardness=ck.HardnessMap(np.full((16, 16), 4e9)))),
    ),
    "coupled friction": (FRICTION, ck.FrictionCoupling()),
    "film": (ck.FilmMeniscus(film_thickness=1e-9),),
    "islands": (ck.IslandBridges(film_thickness=2e-10),),
    "section": (FRICTION, ck.SubsurfaceStress(depths=(0.0, 1e-8, 3e-8), coefficients=(0.0, 0.5))),
    "planes": (ck.SubsurfaceStress(depths=(0.0, 1e-8), keep="planes"), ck.HardnessLimit()),
}


@pytest.mark.parametrize("name", CALLED)
def test_a_saved_contact_answers_the_same(tmp_path, name):
    result = contact(*CALLED[name])
    again = ck.load_result(ck.save_result(result, tmp_path / "contact"))
    for field in attrs.fields(ContactResult):
        if field.name not in ("plan", "parts"):
            assert equal(getattr(again, field.name), getattr(result, field.name)), field.name
    assert again.scalars() == result.scalars()
    assert again.plan.grid == result.plan.grid
    assert again.plan.accuracy == result.plan.accuracy
    assert set(again.parts) == set(result.parts)
    for effect in CALLED[name]:
        assert equal(again.of(type(effect)), result.of(type(effect)))
    with pytest.raises(ck.NotSimulatedError, match="does not call for"):
        again.of(ck.HalfSpace)
    assert not again.pressure.flags.writeable
    if name != "hardness map":
        assert again.plan.scene == result.plan.scene


def test_no_load_no_contact_and_an_infinite_ratio_survive(tmp_path):
    result = contact(ck.FilmMeniscus(film_thickness=1e-9), pressure=0.0)
    again = ck.load_result(ck.save_result(result, tmp_path / "contact"))
    assert again.status == result.status == "no contact"
    assert again.of(ck.FilmMeniscus).relative_force == result.of(ck.FilmMeniscus).relative_force
    assert again.scalars() == result.scalars()


def test_arrays_of_a_scene_are_kept_with_the_result(tmp_path):
    heights = 1e-9 * np.random.default_rng(1).standard_normal((16, 16))
    parts = (ck.Paraboloid(radius=1.0), ck.Heights(heights=heights, pixel_size=(1e-6 / 16,) * 2))
    hard = ck.HardnessMap(np.linspace(3e9, 5e9, 256).reshape(16, 16))
    result = contact(
        ck.HardnessLimit(rule=ck.ConstantHardness(hardness=hard)),
        surface=ck.CombinedSurface(parts=parts),
        grid=None,
    )
    path = ck.save_result(result, tmp_path / "contact")
    scene = ck.load_result(path).plan.scene
    loaded = scene.interface.upper.surface.parts[1]
    assert (loaded.heights == heights).all()
    assert loaded.pixel_size == (1e-6 / 16,) * 2
    assert loaded.checksum == parts[1].checksum
    assert (scene.effect(ck.HardnessLimit).rule.hardness.values == hard.values).all()
    again = ck.solve(ck.plan(scene, result.plan.accuracy))
    assert again.contact_area == result.contact_area


def test_a_name_that_reads_like_a_map_stays_a_name(tmp_path):
    """In a file the arrays of a scene are found by name, and so are the maps of its result."""
    named = attrs.evolve(ROUGH, seed=2)
    result = contact(surface=ck.CombinedSurface(parts=(named,)))
    plan = attrs.evolve(result.plan, scene=attrs.evolve(result.plan.scene, name="pressure"))
    again = ck.load_result(ck.save_result(attrs.evolve(result, plan=plan), tmp_path / "contact"))
    assert again.plan.scene == plan.scene


def test_a_file_needs_neither_pickle_nor_contactkit(tmp_path):
    result = contact(FRICTION)
    with np.load(ck.save_result(result, tmp_path / "contact"), allow_pickle=False) as file:
        header = json.loads(str(file["header"]))
        assert float(file["pressure"].max()) == result.max_pressure
    assert header["scalars"]["contact_area"] == [result.contact_area, "m2"]
    assert header["scene"]["loading"] == {"kind": "pressing", "pressure": 1e8}
    assert header["contactkit"] == ck.__version__


def test_a_result_outlives_its_height_map(tmp_path):
    path = tmp_path / "map.npy"
    np.save(path, 1e-9 * np.random.default_rng(1).standard_normal((16, 16)))
    surface = ck.Measured(path=str(path), pixel_size=1e-6 / 16, unit="m")
    saved = ck.save_result(contact(surface=surface, grid=None), tmp_path / "contact")
    path.unlink()
    again = ck.load_result(saved)
    assert again.plan.grid.shape == (16, 16)
    assert again.plan.scene.interface.upper.surface == surface


def test_a_result_may_travel_as_bytes():
    result = contact(ck.FilmMeniscus(film_thickness=1e-9))
    assert equal(from_bytes(to_bytes(result)).of(ck.FilmMeniscus), result.of(ck.FilmMeniscus))


def test_a_loaded_result_lists_its_numbers_in_the_same_order():
    effects = (ck.HardnessLimit(), FRICTION, ck.FilmMeniscus(film_thickness=1e-9))
    result = contact(*effects)
    assert list(from_bytes(to_bytes(result)).scalars()) == list(result.scalars())
