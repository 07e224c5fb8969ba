"""Kinds of one's own, from outside the package: surface, laws, loading; in plan, file and study."""

import json
import math
import subprocess
import sys

import numpy as np
import pytest
from attrs import evolve, field, frozen

import contactkit as ck
from contactkit.app.scene_fmu import fmu_start
from contactkit.contact.effects.attraction_laws import AttractionLaw, TensionLaw
from contactkit.errors import DescriptionError
from contactkit.fmu.native.film import free_liquid, prepared_film
from contactkit.liquids.temperature_laws import TemperatureLaw
from contactkit.scene.loading import ContactLoading, ImposedForce
from contactkit.scene.materials import Solid
from contactkit.scene.surfaces import ShortWave, Surface
from contactkit.units import si
from contactkit.validators import positive

STEEL = ck.Material(young_modulus=200e9, poisson_ratio=0.3)
MODULUS = STEEL.young_modulus / (1.0 - STEEL.poisson_ratio**2)


@frozen(kw_only=True)
class Cone(Surface):
    """A blunt cone, whose contact Love and Sneddon solved."""

    kind = "cone"
    slope: float = field(validator=positive, metadata=si("-"))

    def heights_on(self, grid):
        return -self.slope * np.hypot(*grid.from_centre())


@frozen(kw_only=True)
class Ripple(Surface):
    """A wave that states its length."""

    kind = "ripple"
    length: float = field(validator=positive, metadata=si("m"))

    def shortest_waves(self, grid):
        return (ShortWave("Ripple.length", self.length, grid.pixel_size[1]),)

    def heights_on(self, grid):
        y, x = grid.from_centre()
        return 1e-9 * np.cos(2.0 * math.pi * x / self.length) + 0.0 * y


@frozen(kw_only=True)
class Nothing(Surface):
    """A surface without heights."""

    kind = "nothing"


@frozen(kw_only=True)
class Ragged(Surface):
    """A surface whose heights are not those of the grid."""

    kind = "ragged"

    def heights_on(self, grid):
        return np.zeros((2, 3))


@frozen(kw_only=True)
class DeadWeight(ContactLoading):
    """A mass that lies on the body."""

    kind = "dead-weight"
    mass: float = field(validator=positive, metadata=si("kg"))

    def mean_pressure(self, area):
        return 9.81 * self.mass / area


@frozen(kw_only=True)
class StandardPull(ImposedForce):
    """A pull of a test rig, with its mass."""

    kind = "standard-pull"
    mass: float = field(default=2e-3, validator=positive, metadata=si("kg"))


@frozen(kw_only=True)
class Arrhenius(TemperatureLaw):
    """Viscosity ``A exp(B/T)``."""

    kind = "arrhenius"
    unit = "Pa.s"
    why = "nothing else is known"
    factor: float = field(validator=positive, metadata=si("Pa.s"))
    activation_temperature: float = field(validator=positive, metadata=si("K"))

    @property
    def meaningful(self):
        return (0.0, math.inf)

    def value_at(self, temperature):
        return self.factor * math.exp(self.activation_temperature / temperature)


@frozen(kw_only=True)
class LinearAttraction(AttractionLaw):
    """Tension that falls linearly to zero at the range."""

    kind = "linear"
    source = "nobody"

    def on_grid(self, self_influence):
        w, r = self.work_of_adhesion, self.range

        def tension(gap):
            return 2.0 * w / r * np.maximum(1.0 - gap / r, 0.0)

        def energy(gap):
            return -w * np.maximum(1.0 - gap / r, 0.0) ** 2

        return TensionLaw(tension, energy, (), 2.0 * w / r, r, 2.0 * w / r**2)


@frozen(kw_only=True)
class Graded(Solid):
    """A coating whose modulus falls linearly to that of the steel below it, in equal layers."""

    kind = "graded"
    top_modulus: float = field(validator=positive, metadata=si("Pa"))
    thickness: float = field(validator=positive, metadata=si("m"))
    n_layers: int = 4

    @property
    def stack(self):
        moduli = np.linspace(self.top_modulus, STEEL.young_modulus, self.n_layers + 1)[:-1]
        each = self.thickness / self.n_layers
        layers = (evolve(STEEL, young_modulus=float(one)) for one in moduli)
        return ck.Stack(
            layers=tuple(ck.Layer(material=one, thickness=each) for one in layers), substrate=STEEL
        )


@frozen(kw_only=True)
class Soft(ck.Material):
    """A material that files could not tell from a `Material`."""


@frozen(kw_only=True)
class Foam(ck.Meniscus):
    """A meniscus that files could not tell from a `Meniscus`."""


OIL = ck.Liquid(
    name="oil",
    viscosity=Arrhenius(
        factor=1e-6, activation_temperature=3400.0, temperature_min=250.0, temperature_max=400.0
    ),
    surface_tension=0.03,
)
HALF_SPACE = ck.HalfSpace()
OWN = (Cone, Ripple, DeadWeight, StandardPull, Arrhenius, LinearAttraction, Graded)


@pytest.fixture
def registered():
    """Every kind of this module, for the length of a test."""
    with ck.KINDS.including(*OWN):
        yield


def contact(surface, effects=(HALF_SPACE,), width=8e-6, **more):
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=STEEL), upper=surface),
        window=ck.Window(width=width, periodic=False),
        **{"loading": ck.Pressing(force=0.02), "effects": effects} | more,
    )


def film(loading=None):
    face = ck.Flat(radius=1e-3)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=face, upper=face, meniscus=ck.Meniscus(liquid=OIL, volume=1e-11)
        ),
        loading=loading or ck.ImposedSpeed(speed=1e-3, initial_gap=2e-6, final_gap=1e-5),
        effects=(ck.ViscousForce(),),
        temperature=300.0,
    )


# Through plan, file, study and FMU ----------------------------------------------------------


@pytest.mark.usefixtures("registered")
@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_a_cone_is_pressed_as_sneddon_says_saved_and_varied(tmp_path):
    scene = contact(Cone(slope=0.02))
    result = ck.solve(ck.plan(scene, ck.Accuracy(grid=128)))
    radius = math.sqrt(2.0 * 0.02 / (math.pi * MODULUS * 0.02))  # F = pi/2 a^2 E* tan
    assert math.sqrt(result.contact_area / math.pi) == pytest.approx(radius, rel=0.03)
    assert result.approach == pytest.approx(0.5 * math.pi * radius * 0.02, rel=0.03)
    assert ck.load_scene(ck.save_scene(scene, tmp_path / "cone.toml")) == scene
    assert 'shape = "cone"' in (tmp_path / "cone.toml").read_text("utf-8")
    again = ck.load_result(ck.save_result(result, tmp_path / "cone"))
    assert again.plan.scene == scene
    study = ck.study(scene, {"interface.upper.surface.slope": [0.02, 0.04]}, ck.Accuracy(grid=64))
    wide, steep = study.column("contact_area")
    assert wide / steep == pytest.approx(2.0, rel=0.1)


@pytest.mark.usefixtures("registered")
def test_a_cone_in_a_sum_is_saved_and_names_itself_in_errors(tmp_path):
    rough = ck.CombinedSurface(parts=(Cone(slope=0.02), Ripple(length=0.6e-6)))
    scene = contact(rough)
    assert ck.load_scene(ck.save_scene(scene, tmp_path / "sum.toml")) == scene
    with pytest.raises(DescriptionError, match=r"Ripple.length must be at least two pixels"):
        ck.plan(scene, ck.Accuracy(grid=16))
    (tmp_path / "sum.toml").write_text(
        (tmp_path / "sum.toml").read_text("utf-8").replace("slope", "slop"), encoding="utf-8"
    )
    with pytest.raises(DescriptionError, match=r"Cone.slop must be a known key.*'slope'"):
        ck.load_scene(tmp_path / "sum.toml")


@pytest.mark.usefixtures("registered")
@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_a_loading_of_ones_own_presses_with_its_load(tmp_path):
    scene = contact(ck.Paraboloid(radius=1e-3), width=40e-6, loading=DeadWeight(mass=2e-3))
    plan = ck.plan(scene, ck.Accuracy(grid=48))
    assert "mass 0.002 kg" in str(plan)
    assert ck.solve(plan).load == pytest.approx(2e-3 * 9.81, rel=1e-6)
    assert ck.load_scene(ck.save_scene(scene, tmp_path / "weight.toml")) == scene
    study = ck.study(scene, {"loading.mass": ["1 g", "2 g"]}, ck.Accuracy(grid=48))
    assert study.column("load")[1] / study.column("load")[0] == pytest.approx(2.0, rel=1e-6)
    with pytest.raises(DescriptionError, match=r"DeadWeight.mass must be|loading.mass must be"):
        ck.plan(evolve(scene, loading=DeadWeight(mass=1e12)), ck.Accuracy(grid=48))


@pytest.mark.usefixtures("registered")
@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_a_viscosity_of_ones_own_is_in_film_file_and_native_fmu(tmp_path):
    scene = film()
    viscosity = 1e-6 * math.exp(3400.0 / 300.0)
    plain = evolve(OIL, viscosity=viscosity)
    meniscus = evolve(scene.interface.meniscus, liquid=plain)
    same = evolve(scene, interface=evolve(scene.interface, meniscus=meniscus))
    assert ck.plan(scene).force(3e-6, 1e-3) == pytest.approx(
        ck.plan(same).force(3e-6, 1e-3), rel=1e-12
    )
    assert ck.load_scene(ck.save_scene(scene, tmp_path / "film.toml")) == scene
    moved = evolve(scene, loading=StandardPull(force=1.0, initial_gap=2e-6, final_gap=1e-5))
    assert free_liquid(prepared_film(moved).prepared).viscosity == pytest.approx(viscosity)


@pytest.mark.usefixtures("registered")
@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_a_pull_of_ones_own_moves_the_mass_as_the_one_it_is(tmp_path):
    own = film(StandardPull(force=1.0, initial_gap=2e-6, final_gap=1e-5))
    given = film(ck.ImposedForce(force=1.0, initial_gap=2e-6, final_gap=1e-5, mass=2e-3))
    times = [ck.simulate(ck.plan(one)).scalars()["release_time"][0] for one in (own, given)]
    assert times[0] == times[1] > 0.0
    assert ck.load_scene(ck.save_scene(own, tmp_path / "pull.toml")) == own


@pytest.mark.usefixtures("registered")
@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_an_attraction_of_ones_own_pulls_off_a_sphere(tmp_path):
    """Of short range it is JKR's or Maugis' limit: 3/2 to 2 pi w R."""
    law = LinearAttraction(work_of_adhesion=0.1, range=100e-9)
    soft = ck.Material(young_modulus=1e9, poisson_ratio=0.3)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=soft), upper=ck.Paraboloid(radius=100e-6)),
        window=ck.Window(width=24e-6, periodic=False),
        loading=ck.Approach(approach=0.0),
        effects=(ck.HalfSpace(), ck.Adhesion(law=law)),
    )
    result = ck.solve(ck.plan(scene, ck.Accuracy(grid=64)))
    assert 0.8 < -result.load / (2.0 * math.pi * 0.1 * 100e-6) < 1.0
    path = ck.save_scene(scene, tmp_path / "linear.toml")
    assert 'law = "linear"' in path.read_text("utf-8")
    assert ck.load_scene(path) == scene


@pytest.mark.usefixtures("registered")
@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_a_solid_of_ones_own_is_pressed_saved_varied_and_stops_a_valve(tmp_path):
    coating = Graded(top_modulus=50e9, thickness=4e-6)

    def pressed(solid):
        return ck.ContactScene(
            interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Paraboloid(radius=1e-3)),
            window=ck.Window(width=40e-6, periodic=False),
            loading=ck.Pressing(force=0.02),
            effects=(ck.LayeredHalfSpace(),),
        )

    accuracy = ck.Accuracy(grid=32, rtol=1e-6)
    own, same = pressed(coating), pressed(coating.stack)
    result = ck.solve(ck.plan(own, accuracy))
    assert result.approach == ck.solve(ck.plan(same, accuracy)).approach
    path = ck.save_scene(own, tmp_path / "graded.toml")
    assert 'kind = "graded"' in path.read_text("utf-8")
    assert ck.load_scene(path) == own
    assert ck.load_result(result.save(tmp_path / "graded")).plan.scene == own
    study = ck.study(own, {"interface.lower.solid.top_modulus": ["50 GPa", "200 GPa"]}, accuracy)
    soft, hard = study.column("approach")
    assert soft == result.approach > 1.2 * hard
    heights = np.zeros((8, 8))
    heights[4, 4] = 1e-9
    assert ck.press(heights, 1e-6, coating, 1e5).has(ck.LayeredHalfSpace)


@pytest.mark.slow  # 2 s
@pytest.mark.usefixtures("registered")
@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_a_solid_of_ones_own_has_the_curve_of_a_stop():
    coating = Graded(top_modulus=50e9, thickness=4e-6)
    scene = contact(ck.Paraboloid(radius=1e-3), (ck.LayeredHalfSpace(),), width=40e-6)
    lower = ck.Body(solid=coating)
    scene = evolve(scene, interface=evolve(scene.interface, lower=lower))
    start = fmu_start(scene, ck.Accuracy(grid=24, rtol=1e-5))
    assert start.name == "contact-stop"


def test_materials_and_stacks_are_written_without_their_kind_and_read_with_it(tmp_path):
    scene = contact(ck.Flat())
    path = ck.save_scene(scene, tmp_path / "steel.toml")
    text = path.read_text("utf-8")
    assert "material" not in text
    named = text.replace("young_modulus", 'kind = "material"\nyoung_modulus')
    path.write_text(named, encoding="utf-8")
    assert ck.load_scene(path) == scene
    path.write_text(named.replace('"material"', '"graided"'), encoding="utf-8")
    with pytest.raises(DescriptionError, match="kind must name a known kind, got 'graided'"):
        ck.load_scene(path)


# Refused by name --------------------------------------------------------------------------------


def test_what_is_not_registered_is_not_written(tmp_path):
    scenes = {
        "Cone": contact(Cone(slope=0.1)),
        "DeadWeight": contact(ck.Flat(), loading=DeadWeight(mass=1.0)),
        "Arrhenius": film(),
        "LinearAttraction": contact(
            ck.Flat(),
            (ck.Adhesion(law=LinearAttraction(work_of_adhesion=0.1, range=1e-9)), ck.HalfSpace()),
        ),
    }
    soft = Soft(young_modulus=1e9, poisson_ratio=0.3)
    layer = ck.Layer(material=soft, thickness=1e-6)
    for solid in (soft, ck.Stack(layers=(layer,), substrate=STEEL)):
        lower = ck.Body(solid=solid)
        scenes["Soft"] = evolve(
            contact(ck.Flat()), interface=ck.Interface(lower=lower, upper=ck.Flat())
        )
        with pytest.raises(DescriptionError, match=r"register it first: ck.register\(Soft\)"):
            ck.save_scene(scenes["Soft"], tmp_path / "own.toml")
    for name, scene in scenes.items():
        with pytest.raises(DescriptionError, match=rf"register it first: ck.register\({name}\)"):
            ck.save_scene(scene, tmp_path / "own.toml")
    assert list(tmp_path.iterdir()) == []


def test_a_class_that_files_could_not_tell_from_its_base_is_refused(tmp_path):
    """A meniscus is no kind: one of one's own would come back as a plain one."""
    scene = film()
    foam = Foam(liquid=OIL, volume=1e-11)
    made = evolve(scene, interface=evolve(scene.interface, meniscus=foam))
    with pytest.raises(DescriptionError, match=r"interface\.meniscus must be a Meniscus itself"):
        ck.save_scene(made, tmp_path / "own.toml")


def test_a_solid_that_is_no_stack_is_refused_by_name():
    kind = frozen(kw_only=True)(type("Jelly", (Solid,), {"kind": "jelly", "stack": 3.0}))
    scene = contact(ck.Flat())
    made = evolve(scene, interface=ck.Interface(lower=ck.Body(solid=kind()), upper=ck.Flat()))
    with pytest.raises(ck.PlanError, match=r"Jelly\.stack must be a Stack"):
        ck.plan(made, ck.Accuracy(grid=16))


def test_a_surface_without_heights_is_refused_by_name():
    with pytest.raises(
        ck.PlanError, match=r"Nothing has none: give the class .*heights_on\(grid\)"
    ):
        ck.plan(contact(Nothing()), ck.Accuracy(grid=16))
    with pytest.raises(DescriptionError, match=r"Ragged.heights_on\(grid\) must be finite heights"):
        ck.plan(contact(Ragged()), ck.Accuracy(grid=16))


def test_a_film_refuses_a_surface_it_does_not_know():
    scene = film()
    faces = evolve(scene.interface, upper=ck.Body(surface=Cone(slope=0.1)))
    with pytest.raises(ck.PlanError, match=r"interface.upper.surface is a Cone"):
        ck.plan(evolve(scene, interface=faces))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"kind": "sphere"}, r"Own.kind must be a name that no other surface has, .*Sphere has it"),
        ({"kind": "My Cone"}, "the kind of Own must be of small letters and hyphens"),
        ({}, "Own needs kind"),
    ],
)
def test_a_surface_that_is_not_complete_is_not_registered(changes, message):
    kind = frozen(kw_only=True)(type("Own", (Surface,), changes))
    n = len(ck.KINDS)
    with pytest.raises(DescriptionError, match=message):
        ck.register(kind)
    assert len(ck.KINDS) == n


def test_what_is_of_no_family_is_not_registered():
    with pytest.raises(DescriptionError, match=r"base class is a role .* or Surface or "):
        ck.register(ck.Layer)


# Installed --------------------------------------------------------------------------------------

_PACKAGE = """
import numpy as np
from attrs import field, frozen
from contactkit.scene.surfaces import Surface
from contactkit.units import si


@frozen(kw_only=True)
class Pyramid(Surface):
    kind = "pyramid"
    slope: float = field(metadata=si("-"))

    def heights_on(self, grid):
        y, x = grid.from_centre()
        return -self.slope * np.maximum(abs(x), abs(y))
"""
_RUN = """
import json, sys
import contactkit as ck
before = "indenters" in sys.modules
scene = ck.load_scene(sys.argv[1])
plan = ck.plan(scene, ck.Accuracy(grid=16))
print(json.dumps([before, type(scene.interface.upper.surface).__name__, float(plan.heights.min())]))
"""


def test_a_surface_of_an_installed_package_is_known_in_files(tmp_path):
    (tmp_path / "indenters.py").write_text(_PACKAGE, encoding="utf-8")
    info = tmp_path / "indenters-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: indenters\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[contactkit.surfaces]\npyramid = indenters:Pyramid\n")
    with ck.KINDS.including(Cone):
        path = ck.save_scene(contact(Cone(slope=0.5)), tmp_path / "tip.toml")
    path.write_text(path.read_text("utf-8").replace('"cone"', '"pyramid"'), encoding="utf-8")
    code = f"import sys; sys.path.insert(0, {str(tmp_path)!r})\n{_RUN}"
    ran = subprocess.run(
        [sys.executable, "-c", code, str(path)], capture_output=True, text=True, check=False
    )
    assert ran.returncode == 0, ran.stderr
    assert json.loads(ran.stdout) == [False, "Pyramid", pytest.approx(-0.5 * 4e-6)]
