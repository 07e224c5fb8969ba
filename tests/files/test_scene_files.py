"""A scene file holds a scene whole, or is not written."""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve, field, frozen

import contactkit as ck
from contactkit.contact.effects.attraction_laws import DugdaleAttraction
from contactkit.errors import DescriptionError
from contactkit.files.results import to_bytes
from contactkit.liquids.temperature_laws import TemperatureLaw
from contactkit.scene.surfaces import Surface
from contactkit.separation.effects.base import ForceLaw, SeparationForce
from contactkit.studies.store import scene_key

STEEL = ck.Material(name="steel", young_modulus=2e11, poisson_ratio=0.3)
OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
FACE = ck.Flat(radius=1e-3)


@frozen(kw_only=True)
class Cone(Surface):
    """A surface of one's own."""

    slope: float
    curvature = 0.0


@frozen(kw_only=True)
class Dome(Surface):
    """Another, with the same field."""

    slope: float
    curvature = 0.0


@frozen(kw_only=True)
class Thinning(TemperatureLaw):
    """A law of one's own."""

    kind = "thinning"
    why = "nothing else is known"
    unit = "Pa.s"
    at_zero: float = 1.0

    @property
    def meaningful(self):
        """Any temperature [K]."""
        return (0.0, 1e4)

    def value_at(self, temperature):
        return self.at_zero * math.exp(-temperature / 300.0)


@frozen(kw_only=True)
class Alloy(ck.Material):
    """A material of one's own."""

    grade: str = "a"


@frozen(kw_only=True)
class Attraction(DugdaleAttraction):
    """A law with the fields of another."""


@frozen(kw_only=True)
class Magnet(SeparationForce):
    """An effect that is not registered."""

    name = "magnet"
    summary = "a magnet"
    sources = ("nobody",)
    column = ck.MeniscusForce.column
    pull: float = field(default=1.0)

    def prepare(self, prepared):
        """Constant pull."""
        return ForceLaw(lambda gap, speed: self.pull)


@frozen(kw_only=True)
class Thicker(ck.ViscousForce):
    """An effect with the name of another."""


class Undecorated(ck.Wave):
    """A class whose own fields nobody knows."""


def contact(surface=None, solid=STEEL, effects=()):
    upper = surface if surface is not None else ck.Wave(amplitude=1e-9, wavelength=1e-6)
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=upper),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=1e7),
        effects=(ck.HalfSpace(), *effects),
    )


def separation(liquid=OIL, effects=(), **more):
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=FACE, upper=FACE, meniscus=ck.Meniscus(liquid=liquid, volume=1e-12)
        ),
        loading=ck.ImposedSpeed(speed=1e-3, initial_gap=1e-6, final_gap=1e-5),
        effects=(*effects, *(() if effects else (ck.ViscousForce(),))),
        **more,
    )


def with_field(scene, name, value):
    """A scene with a value that its validators would not have let through."""
    made = evolve(scene)
    object.__setattr__(made, name, value)
    return made


OWN = {
    "surface": (contact(Cone(slope=0.1)), "ContactScene.interface.upper", "ck.register(Cone)"),
    "combined": (
        contact(ck.CombinedSurface(parts=(ck.Sphere(radius=1e-3), Cone(slope=0.1)))),
        r"interface\.upper\.parts\[1\]",
        "ck.register(Cone)",
    ),
    "law": (
        separation(evolve(OIL, viscosity=Thinning(temperature_min=250.0, temperature_max=400.0))),
        r"meniscus\.liquid\.viscosity",
        "ck.register(Thinning)",
    ),
    "effect": (separation(effects=(Magnet(),)), r"effects\[0\]", "ck.register(Magnet)"),
    "named-as-another": (separation(effects=(Thicker(),)), r"effects\[0\]", "ck.register("),
    "undecorated": (
        contact(Undecorated(amplitude=1e-9, wavelength=1e-6)),
        r"interface\.upper",
        "@attrs.frozen",
    ),
    "material": (
        contact(solid=Alloy(young_modulus=2e11, poisson_ratio=0.3)),
        r"interface\.lower\.solid",
        "ck.register(Alloy)",
    ),
    "function": (with_field(separation(), "name", math.sin), r"SeparationScene\.name", "pickle"),
    "control-character": (separation(name="\x1b[31m"), "control characters", r"'\x1b[31m'"),
    "array": (
        contact(ck.Heights(heights=np.eye(4) * 1e-9, pixel_size=1e-7)),
        r"Heights\.heights",
        "Measured(path=",
    ),
}


@pytest.mark.parametrize("name", OWN)
def test_what_a_file_cannot_hold_is_refused_by_name(tmp_path, name):
    scene, place, cure = OWN[name]
    with pytest.raises(DescriptionError, match=place) as caught:
        ck.save_scene(scene, tmp_path / "sub" / "a.toml")
    assert cure in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_what_is_no_scene_is_refused(tmp_path):
    with pytest.raises(DescriptionError, match=r"save_scene\(scene\) must be a ContactScene"):
        ck.save_scene(STEEL, tmp_path / "a.toml")


def test_a_registered_effect_is_written(tmp_path):
    from contactkit.kinds import SEPARATION_EFFECTS

    scene = separation(effects=(Magnet(pull=2.0),))
    with SEPARATION_EFFECTS.including(Magnet):
        assert ck.load_scene(ck.save_scene(scene, tmp_path / "a.toml")) == scene


@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_a_result_that_could_not_be_read_again_is_refused():
    scene = separation(
        evolve(OIL, viscosity=Thinning(temperature_min=250.0, temperature_max=400.0)),
        temperature=300.0,
    )
    result = ck.simulate(ck.plan(scene, ck.Accuracy(points=20)))
    with pytest.raises(DescriptionError, match=r"meniscus\.liquid\.viscosity"):
        to_bytes(result)


def test_keys_of_the_store_tell_classes_of_ones_own_apart():
    accuracy = ck.Accuracy()
    scenes = [contact(Cone(slope=0.1)), contact(Dome(slope=0.1)), contact(Cone(slope=0.2))]
    scenes += [contact(), contact(solid=Alloy(young_modulus=2e11, poisson_ratio=0.3))]
    scenes += [separation(effects=(Thicker(),)), separation()]
    assert len({scene_key(one, accuracy) for one in scenes}) == len(scenes)
    with pytest.raises(DescriptionError, match="decorate Undecorated"):
        scene_key(contact(Undecorated(amplitude=1e-9, wavelength=1e-6)), accuracy)


def test_numbers_of_numpy_are_written_as_numbers(tmp_path):
    wave = ck.Wave(amplitude=np.float64(1e-9), wavelength=1e-6)
    path = ck.save_scene(contact(wave), tmp_path / "a.toml")
    assert ck.load_scene(path) == contact()
