"""A relative humidity in a scene file: kept as given, and how a wrong one is refused."""

from __future__ import annotations

import re

import attrs
import pytest

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.capillary.kelvin import laplace_pressure

pytestmark = pytest.mark.errors

SCENE = """
temperature = "{temperature}"
[interface.lower]
shape = "flat"
[interface.upper]
shape = "sphere"
radius = "1 um"
[interface.meniscus]
liquid = "water"
{meniscus}
[loading]
kind = "imposed-speed"
initial_gap = "0.3 nm"
final_gap = "20 nm"
speed = "1 um/s"
[[effects]]
effect = "meniscus-force"
"""


@pytest.fixture
def written(tmp_path):
    def write(meniscus, temperature="25 degC"):
        path = tmp_path / "moist.toml"
        path.write_text(SCENE.format(meniscus=meniscus, temperature=temperature))
        return path

    return write


@pytest.mark.parametrize("humidity", ['"50 %"', "0.5"])
def test_a_humidity_gives_the_pressure_of_kelvins_equation(written, humidity):
    scene = ck.load_scene(written(f"relative_humidity = {humidity}", "40 degC"))
    assert scene.interface.meniscus.relative_humidity == 0.5
    assert scene.interface.meniscus.pressure is None
    volume = ck.load_liquid("water").molar_volume(313.15)
    assert scene.liquid_pressure == laplace_pressure(volume, 313.15, 0.5)


def test_a_humidity_follows_the_temperature_of_the_scene(written):
    scene = ck.load_scene(written("relative_humidity = 0.5", "40 degC"))
    assert attrs.evolve(scene, temperature=293.15).liquid_pressure > scene.liquid_pressure


def test_the_command_line_reads_it_too(written, tmp_path):
    report = open_scene(str(written("relative_humidity = 0.9"))).run(
        tmp_path / "out", lambda fraction: None
    )
    assert report.scalars


def test_a_saved_scene_holds_the_humidity(written, tmp_path):
    scene = ck.load_scene(written("relative_humidity = 0.9"))
    assert ck.load_scene(ck.save_scene(scene, tmp_path / "again.toml")) == scene


@pytest.mark.parametrize(
    ("meniscus", "error", "message"),
    [
        (
            'relative_humidity = 0.5\nvolume = "1 nm3"',
            ck.DescriptionError,
            "one of volume .* got .'volume', 'relative_humidity'",
        ),
        (
            'relative_humidity = 0.5\npressure = "-1 MPa"',
            ck.DescriptionError,
            "one of volume .* got .'pressure', 'relative_humidity'",
        ),
        ("relative_humidity = 50.0", ck.DescriptionError, "per cent"),
        ("relative_humidity = true", ck.DescriptionError, "relative_humidity"),
        ('relative_humidity = "wet"', ck.DescriptionError, "relative_humidity"),
        ("relative_humidity = 0.0", ck.InfeasibleError, "condenses"),
        ("relative_humidity = 1.0", ck.InfeasibleError, "saturat"),
    ],
)
def test_a_wrong_humidity_is_refused(written, meniscus, error, message):
    with pytest.raises(error, match=re.compile(message)):
        ck.plan(ck.load_scene(written(meniscus)))
