"""Cost of the coupling schemes: the explicit ones are wrong and fast, impulses are right."""

from __future__ import annotations

import pytest

from contactkit.app.scenes import open_scene
from contactkit.benchmarks.separation import monolithic_release
from contactkit.fmu.master.couple import Fmu, Mass, couple
from contactkit.fmu.python import build as building
from contactkit.fmu.slaves.stiction_force import PORTS
from contactkit.fmu.slaves.stiction_mass import mass_values
from contactkit.fmu.slaves.valve_drive import drive_values
from contactkit.models.injector.report.cost import coupling_settings

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def settings(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cost")
    scene = open_scene("fuel-injector").scene
    film = scene.separation(scene.temperature)
    drive = building.build("valve-drive", folder, start=drive_values(scene.valve))
    found = coupling_settings(scene, film, drive, folder)
    return {(setting.method, setting.label): setting.run for setting in found}


def test_every_coupling_scheme_is_there(settings):
    assert {method for method, _ in settings} == {
        "film by force, Jacobi",
        "film by force, Gauss-Seidel",
        "film by force, implicit",
        "film by impulse, fixed step",
        "film by impulse, adaptive steps",
    }


def test_forces_are_wrong_where_impulses_are_right(settings):
    right = settings["film by impulse, adaptive steps", "tolerance 1e-04"]().value
    assert settings["film by impulse, adaptive steps", "tolerance 1e-03"]().value == pytest.approx(
        right, rel=1e-3
    )
    for name in ("Jacobi", "Gauss-Seidel"):
        found = settings[f"film by force, {name}", "step 5 us"]()
        assert abs(found.value / right - 1.0) > 0.02
        assert found.counts["warnings of the film"] == 1
    found = settings["film by force, implicit", "step 5 us"]()
    assert 3e-3 < abs(found.value / right - 1.0) < 3e-2


def test_a_drive_fmu_may_pull(tmp_path):
    """The injector of the bundled scene, force coupled, against the monolithic model."""
    scene = open_scene("fuel-injector").scene
    own = scene.separation(scene.temperature)
    values, profile = mass_values(own), scene.valve.profile
    whole = monolithic_release(own, scene.valve, scene.first_pulse_end, 1e-5).value
    names = {port.name for port in PORTS if port.causality == "parameter"}
    found = couple(
        Fmu(
            building.build("stiction-force", tmp_path),
            {name: value for name, value in values.items() if name in names},
        ),
        Mass(mass=values["m"], rest_gap=values["h_min"]),
        building.build("valve-drive", tmp_path, start=drive_values(scene.valve)),
        scene.first_pulse_end,
        release_gap=values["h_rel"],
        jumps=(profile.start_delay, profile.start_delay + profile.boost_time),
    )
    assert found.release_time - profile.start_delay == pytest.approx(whole, rel=1e-3)
    assert found.n_steps <= 200
