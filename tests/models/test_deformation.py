"""Deformation of the devices against closed forms, and stiction of a landing bump."""

import math

import pytest
from attrs import evolve

from contactkit.app.scenes import open_scene
from contactkit.models.head_disk.stiction import bump_stiction, landing_bump, unanswered
from contactkit.models.injector.report.deformation import deformation, deformation_numbers
from contactkit.models.micromirror.report import deformation as tips


@pytest.fixture(scope="module")
def injector():
    return open_scene("fuel-injector").scene


def test_the_injectors_faces_hardly_deform(injector):
    """beta = F/(1.5 pi E* R h) of a flat under a force, whatever the oil."""
    force = 40.0
    found = deformation(injector, force)
    modulus = 0.5 * 210e9 / (1.0 - 0.09)
    beta = force / (1.5 * math.pi * modulus * 3.175e-3 * 5e-6)
    assert found.beta == pytest.approx(beta, rel=1e-9)
    assert 1e-4 < found.rigid_release < 2e-4
    assert abs(found.change) < 1e-3
    lines, numbers = deformation_numbers(injector, force)
    assert "does not matter" in lines[0]
    assert numbers["release_change_by_deformation"] == (found.change, "-")


def test_what_a_report_has_no_time_for_is_stated(injector):
    face = evolve(injector.interface.lower.surface, tilt=(1e-5, 0.0))
    lower = evolve(injector.interface.lower, surface=face)
    tilted = evolve(injector, interface=evolve(injector.interface, lower=lower))
    lines, numbers = deformation_numbers(tilted, 40.0)
    assert "not evaluated" in lines[0]
    assert "on a map" in lines[0]
    assert not numbers


def test_the_mirrors_tips_are_drawn_in_by_water():
    scene = open_scene("micromirror").scene
    assert tips.tip_deformation(scene, 0.0) is None
    assert tips.tip_deformation(scene, 0.1) is None  # no bridge spans the gap
    found = tips.tip_deformation(scene, 0.5)
    # Force over 2 pi R gc (1 - z/h) of rigid bodies; p, a and h of Kelvin at 20 degC.
    suction = 8.314463 * 293.15 * math.log(2.0) / (0.018015 / 998.2)
    wetting = 2.0 * 0.0727 * math.cos(math.radians(40.0))
    modulus = 0.5 * 70e9 / (1.0 - 0.33**2)
    height, half = wetting / suction, 4.0 * 1e-7 * suction / (math.pi * modulus)
    square = 2.0 * 1e-7 * (height - 0.4e-9)
    rim = half + math.sqrt(half**2 + square)
    assert found.change == pytest.approx(rim**2 / square - 1.0, rel=5e-3)
    assert found.number == pytest.approx(wetting * rim / (modulus * height**2), rel=5e-3)
    assert found.closes == pytest.approx(2.0 * suction * rim / (modulus * 0.4e-9), rel=5e-3)
    lines, numbers = tips.deformation_numbers(scene, [(0.4e-9, 1e-3), (2e-9, 0.1)])
    assert "at rest matters" in lines[0]
    assert "does not matter" in lines[1]
    beta = 1.0016e-3 * 1e-3 * (1e-7) ** 1.5 / (modulus * (0.4e-9) ** 2.5)
    assert numbers["film_deformation_over_gap"][0] == pytest.approx(
        max(beta, beta * 100.0 * 0.2**2.5), rel=5e-3
    )


@pytest.fixture(scope="module")
def disk():
    return open_scene("head-disk").scene


def test_the_rough_disk_is_refused_by_name(disk):
    text = unanswered(disk)
    assert "GaussianRoughness" in text
    assert "half-spaces" in text
    assert landing_bump(disk).interface.lower.solid.name == "Ni-P"


@pytest.mark.exhaustive
@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
def test_a_landing_bump_sticks_once_it_has_drained(disk):
    """The numbers of docs/head-disk-detail.md, and the order of 2 pi R gc = 4.57 uN."""
    found = bump_stiction(disk, [1e-8, 1e-6], [0.9, 0.95])
    assert found.pull_off_force == pytest.approx([3.49e-6, 3.74e-6, 3.97e-6, 5.47e-6], rel=2e-2)
    assert found.largest_contact_force[:2].tolist() == [0.0, 0.0]
    assert (found.largest_contact_force[2:] > 2e-5).all()
