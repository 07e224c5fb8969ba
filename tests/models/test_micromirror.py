"""The micromirror: what its run reports, in numbers."""

from __future__ import annotations

import csv
import math

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.app.scenes import OpenedDevice, open_scene
from contactkit.models.micromirror.coupling import FREE
from contactkit.models.micromirror.release import landing, release, release_curve, smallest_reset
from contactkit.models.micromirror.report.cosimulation import cosimulate_flips
from contactkit.models.micromirror.report.run import report, run_errors
from contactkit.models.micromirror.tip_film import adhesion, tip_law


@pytest.fixture(scope="module")
def device():
    return open_scene("micromirror")


@pytest.fixture(scope="module")
def short(device):
    """Two quick flips, long steps, two humidities; the file has eleven of them, at 5 kHz."""
    scene = device.scene
    wave = evolve(scene.mirror.waveform, period=60e-6, start_delay=0.5e-6)
    study = evolve(scene.study, humidities=(0.0, 0.9), communication_step=40e-9)
    return OpenedDevice(evolve(scene, mirror=evolve(scene.mirror, waveform=wave), study=study))


@pytest.fixture(scope="module")
def run(short):
    return cosimulate_flips(short.scene, None, lambda fraction: None)


def test_what_is_stored_and_what_presses(device):
    """Preload is the moment of the electrodes less that of the hinge, over the arm."""
    scene = device.scene
    found = landing(scene)
    assert math.degrees(found.tilt) == pytest.approx(10.49, abs=0.01)
    assert found.preload == pytest.approx(101.4e-9, rel=1e-3)
    assert found.hinge_force == pytest.approx(6.2e-9, rel=0.01)
    assert found.spring_energy == pytest.approx(0.5 * found.preload * found.bend, rel=1e-12)


def test_adhesion_grows_with_humidity_to_that_of_a_full_meniscus(device):
    held = [adhesion(device.scene.tip, h) for h in (0.0, 0.2, 0.4, 0.6, 0.8)]
    forces, energies = [one.force for one in held], [one.energy for one in held]
    assert forces == sorted(forces)
    assert energies == sorted(energies)
    # van der Waals: A R/(6 D^2)
    assert held[0].force == pytest.approx(1e-19 * 1e-7 / (6 * 0.4e-9**2), rel=1e-12)
    tension, cosine = 0.0727, math.cos(math.radians(40.0))
    assert held[-1].meniscus_force < 4 * math.pi * 1e-7 * tension * cosine
    # Thin film law: 1 - D/(2 r_K cos t) of it, some per cent more than the exact one.
    reach = 2.0 * held[-1].kelvin_radius * cosine
    thin = 4 * math.pi * 1e-7 * tension * cosine * (1 - 0.4e-9 / reach)
    assert held[-1].meniscus_force == pytest.approx(thin, rel=0.1)


@pytest.mark.parametrize("humidity", [0.3, 0.7, 0.95])
def test_the_condensed_volume_has_the_pressure_of_the_vapour(device, humidity):
    """At the landed gap the meniscus of fixed pressure and that of its volume pull alike."""
    tip = device.scene.tip
    angle = tip.interface.meniscus.contact_angle_lower
    at_pressure = ck.Meniscus(
        liquid=tip.interface.meniscus.liquid,
        relative_humidity=humidity,
        contact_angle_lower=angle,
        contact_angle_upper=angle,
    )
    scene = evolve(
        tip, interface=evolve(tip.interface, meniscus=at_pressure), effects=(ck.MeniscusForce(),)
    )
    made, held = ck.plan(scene), adhesion(tip, humidity)
    gap = tip.loading.initial_gap
    assert made.film.static_force(gap) == pytest.approx(held.meniscus_force, rel=1e-6)
    # Kept at its pressure it breaks sooner than with its volume, and with less work.
    assert made.film.end < held.break_gap
    assert made.film.static_force(2.0 * gap) < held.meniscus_force


def test_the_energy_would_do_but_the_force_does_not(device):
    """At 60 % the tips store ten times the energy of the separation, and stay."""
    scene = device.scene
    held, n = adhesion(scene.tip, 0.6), scene.mirror.tips.per_side
    assert landing(scene).spring_energy > 10.0 * n * held.energy
    assert n * held.force > landing(scene).preload
    assert math.isnan(release(scene, tip_law(scene.tip, 0.6), None))
    assert release(scene, tip_law(scene.tip, 0.3), None) < 0.6e-6


def test_the_smallest_pulse_is_a_threshold(device):
    scene = device.scene
    made = tip_law(scene.tip, 0.7)
    volts, free = smallest_reset(scene, made)
    assert volts == pytest.approx(29.6, abs=0.3)
    assert 0.35e-6 < free < 1.2e-6
    assert math.isnan(release(scene, made, volts - 0.1))
    assert release(scene, made, volts + 0.1) > 0.0


def test_more_humidity_takes_more_voltage(short):
    found = release_curve(short.scene, lambda fraction: None)
    dry, humid = found
    assert dry.adhesion.volume == 0.0
    assert dry.alone < 0.5e-6
    assert math.isnan(humid.alone)
    assert dry.reset_voltage < humid.reset_voltage
    assert humid.reset_voltage < abs(short.scene.mirror.waveform.reset_voltage)


@pytest.mark.slow
def test_it_flips_over_and_back(short, run):
    """Thirty microseconds after each pulse the mirror is captured on the other side."""
    time, tilt = run.coupled["time"], np.degrees(run.coupled["tilt"])
    assert tilt[0] == pytest.approx(10.49, abs=0.01)
    over, back = tilt[(time > 30e-6) & (time < 60e-6)], tilt[time > 90e-6]
    assert -13.0 < over.min() < over.max() < -8.0
    assert 8.0 < back.min() < back.max() < 13.0
    for side in ("plus", "minus"):  # its tips become free
        free = run.coupled[f"state_{side}"] == FREE
        assert np.count_nonzero(free[1:] & ~free[:-1]) >= 1


@pytest.mark.slow
def test_the_fmus_agree_with_the_monolithic_model(short, run):
    free, error = run_errors(short.scene, run)
    assert 1e-6 < free < 1.6e-6
    assert error < 2e-3
    gone = run.coupled["time"][run.coupled["state_plus"] == 3.0][0]
    assert abs(gone - free) < short.scene.study.communication_step


@pytest.mark.slow
def test_the_report_and_its_figures(short, run, tmp_path):
    made = report(short.scene, run, tmp_path, lambda fraction: None)
    files = (*made.write(), *made.draw())
    names = {path.name for path in files}
    assert names == {
        "signals.csv",
        "signals.npz",
        "release.csv",
        "side-view.png",
        "flips.png",
        "first-flip.png",
        "lift-off.png",
        "release-against-humidity.png",
        "force-gap.png",
    }
    assert all(path.stat().st_size > 100 for path in files)
    for word in ("it is the force that fails", "spring alone", "pulls in at", "OUT OF RANGE"):
        assert word in made.text
    assert made.scalars["smallest_reset_90_percent"][1] == "V"
    with (tmp_path / "signals.csv").open() as file:
        assert next(csv.reader(file))[:2] == ["time [s]", "tilt [rad]"]


def test_the_plan_says_what_is_simulated(device):
    text = device.plan_text()
    for word in ("meniscus-force", "van-der-waals-force", "50 % relative humidity", "tip-contact"):
        assert word in text


def test_the_scene_becomes_the_parameters_of_the_fmu(device):
    name, values, _ = device.fmu_start()
    assert name == "tip-contact"
    assert values["R"] == pytest.approx(1e-7)
    assert 1e-26 < values["V"] < 1e-24
