"""The amount of liquid in a scene file: by a contact radius or by a coverage, at a gap."""

from __future__ import annotations

import math
import re

import pytest
from selection import quick

import contactkit as ck

pytestmark = pytest.mark.errors

SCENE = """
[interface.lower]
shape = "flat"
{upper}
[interface.meniscus]
liquid = "water"
contact_angle_lower = "60 deg"
contact_angle_upper = "30 deg"
{amount}
[loading]
kind = "imposed-speed"
initial_gap = "2 nm"
final_gap = "20 nm"
speed = "1 um/s"
[[effects]]
effect = "meniscus-force"
"""
RADIUS = 'radius = "100 nm"\nat_gap = "2 nm"\n'
COVERAGE = 'coverage = "25 %"\narea = "1 um2"\nat_gap = "2 nm"\n'
ROUND = '[interface.upper]\nshape = "sphere"\nradius = "1 um"\n'


@pytest.fixture
def read(tmp_path):
    def read(amount, upper=""):
        path = tmp_path / "film.toml"
        path.write_text(SCENE.format(amount=amount, upper=upper))
        return ck.load_scene(path, ck.SeparationScene)

    return read


WATER = {
    "liquid": ck.load_liquid("water"),
    "contact_angle_lower": math.radians(60.0),
    "contact_angle_upper": math.radians(30.0),
}


@pytest.mark.parametrize(
    ("more", "given"),
    quick(
        [
            ("", {}),
            ("count = 4\n", {"count": 4}),
            ('body = "upper"\nprofile = "arc"\n', {"body": "upper", "profile": "arc"}),
        ],
        2,
        1,
    ),
)
def test_a_radius_at_a_gap_is_that_of_python(read, more, given):
    made = ck.Meniscus.from_radius(radius=100e-9, at_gap=2e-9, **WATER, **given)
    assert read(RADIUS + more).interface.meniscus == made


def test_the_meniscus_starts_with_that_radius(read):
    result = ck.simulate(ck.plan(read(RADIUS)))
    assert result["contact_radius_lower"][0] == pytest.approx(100e-9, rel=1e-9)


def test_a_coverage_at_a_gap_is_that_of_python(read):
    made = ck.Meniscus.from_coverage(coverage=0.25, area=1e-12, at_gap=2e-9, count=100, **WATER)
    assert read(COVERAGE + "count = 100").interface.meniscus == made


@pytest.mark.parametrize("amount", [RADIUS, COVERAGE])
def test_a_saved_scene_reads_back_the_same(read, tmp_path, amount):
    scene = read(amount + "rewetting = 0.5")
    assert scene.interface.meniscus.rewetting == 0.5
    assert ck.load_scene(ck.save_scene(scene, tmp_path / "again.toml")) == scene


@pytest.mark.parametrize(
    ("amount", "message"),
    [
        ('radius = "100 nm"', "Meniscus.at_gap must be given with radius [m], got None; the gap"),
        ('coverage = 0.5\nat_gap = "2 nm"', "Meniscus.area must be given with coverage [m2]"),
        ('at_gap = "2 nm"', "Meniscus.at_gap must come with radius [m], or with coverage [-]"),
        ('volume = 1e-20\nat_gap = "2 nm"', "Meniscus.at_gap must come with radius [m], or"),
        (RADIUS + "volume = 1e-20", "got ['radius', 'volume']; each of them is the amount"),
        (RADIUS + "coverage = 0.5", "got ['radius', 'coverage']; each of them is the amount"),
        (COVERAGE + "relative_humidity = 0.5", "got ['coverage', 'relative_humidity']; each of"),
        (RADIUS + "area = 1e-12", "Meniscus.area must be left out with radius, got 1e-12"),
        (COVERAGE + 'body = "upper"', "Meniscus.body must be left out with coverage"),
        ('radius = "100 nm2"\nat_gap = 2e-9', "Meniscus.radius must be in a unit that converts"),
        ('radius = "100 nm"\nat_gap = "2 um"', "give a larger radius or a smaller gap"),
        ('volume = 1e-20\nradiuss = "100 nm"', "did you mean 'radius'?"),
    ],
)
def test_a_wrong_amount_is_refused_with_its_cure(read, amount, message):
    with pytest.raises(ck.DescriptionError, match=re.escape(message)) as caught:
        read(amount)
    assert "at interface.meniscus" in str(caught.value)


@pytest.mark.parametrize(("amount", "key"), [(RADIUS, "radius"), (COVERAGE, "coverage")])
def test_a_sphere_has_no_single_gap(read, amount, key):
    message = rf"Meniscus\.{key} must be given between two flats.*meniscus\.volume \[m3\]"
    with pytest.raises(ck.DescriptionError, match=message):
        read(amount, ROUND)
