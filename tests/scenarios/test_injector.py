"""The fuel injector: what the demo reports, in numbers."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path

import numpy as np
import pytest
from attrs import evolve

from contactkit.app.cost.separation import other_menisci
from contactkit.app.run.injector.cosimulation import cosimulate_cases
from contactkit.app.run.injector.cycles import cycles, dry_delay, run_error
from contactkit.app.run.injector.report import report
from contactkit.app.scenes import open_scene
from contactkit.fmu.slaves.stiction_mass import mass_values
from contactkit.separation.effects.base import LimitKind
from contactkit.units import celsius

MODELS = Path(__file__).parents[2] / "models"


@pytest.fixture(scope="module")
def device():
    return open_scene("fuel-injector")


@pytest.fixture(scope="module")
def short(device):
    """Two cycles at two temperatures; the demo has five at three."""
    profile = evolve(device.scene.valve.profile, cycles=2, period=6e-3)
    study = evolve(device.scene.study, temperatures=(celsius(-20.0), celsius(80.0)))
    valve = evolve(device.scene.valve, profile=profile)
    return evolve(device, scene=evolve(device.scene, valve=valve, study=study))


@pytest.fixture(scope="module")
def runs(short):
    return cosimulate_cases(short.scene, None, lambda fraction: None)


@pytest.mark.slow
def test_with_the_tension_limit_every_cycle_is_released_in_about_half_a_millisecond(short, runs):
    for run in runs:
        if run.limited:
            delays = [cycle.delay for cycle in cycles(run, short.scene)]
            assert len(delays) == 2
            assert delays == pytest.approx([0.466e-3] * 2, rel=0.03)


@pytest.mark.slow
def test_without_it_the_cold_spool_is_not_released_within_the_pulse(short, runs):
    cold, warm = (run for run in runs if not run.limited)
    assert all(math.isnan(cycle.delay) for cycle in cycles(cold, short.scene))
    assert all(
        cycle.delay == pytest.approx(2.63e-3, rel=0.01) for cycle in cycles(warm, short.scene)
    )


@pytest.mark.slow
def test_the_fmu_pair_agrees_with_the_monolithic_model(short, runs):
    """At 5 us the coupling is second order and 3e-6 off."""
    for run in runs:
        error = run_error(run, cycles(run, short.scene))
        assert math.isnan(error) or error < 5e-6


@pytest.mark.slow
def test_the_viscous_film_holds_the_spool_and_the_limit_cuts_it_off(short, runs):
    run = next(run for run in runs if run.limited)
    first = cycles(run, short.scene)[0]
    assert first.viscous_impulse > 20.0 * first.meniscus_impulse > 0.0
    assert 0.3 < first.limited_fraction < 0.9
    cap = math.pi * 3.175e-3**2 * 1e6
    assert 0.9 * cap < first.peak_force < 1.05 * cap


@pytest.mark.slow
def test_a_dry_spool_is_faster_than_any_other(short, runs):
    dry = dry_delay(short.scene)
    assert dry == pytest.approx(0.319e-3, rel=0.01)
    delays = [cycle.delay for run in runs for cycle in cycles(run, short.scene)]
    assert all(math.isnan(delay) or delay > dry for delay in delays)


@pytest.mark.slow
def test_momentum_balances_over_the_first_opening(short, runs):
    """Pull less film is the momentum of the spool; the pull is sampled at 5 us."""
    run = next(run for run in runs if run.limited)
    signals, time = run.coupled, run.coupled.time
    end = int(np.searchsorted(time, signals["t_release"][-1] - short.scene.valve.profile.period))
    moving = (signals["v"] != 0.0) & (np.arange(len(time)) <= end)
    first = int(np.argmax(moving)) - 1
    given = np.trapezoid(signals["F_ext"][first : end + 1], time[first : end + 1])
    taken = signals["J"][end] + signals["J_m"][end] - signals["J"][first] - signals["J_m"][first]
    momentum = short.scene.loading.mass * signals["v"][end]
    assert given - taken == pytest.approx(momentum, rel=0.02)


@pytest.mark.slow
def test_the_report_writes_signals_figures_and_fmus(short, runs, tmp_path):
    made = report(short.scene, runs, tmp_path)
    files = (*made.files, *made.draw())
    names = {path.name for path in files}
    assert {"release-zoom.png", "delay-against-temperature.png", "tension-limit.png"} <= names
    assert {"force-balance_minus20degC.png", "signals_80degC.csv", "signals_80degC.npz"} <= names
    assert all(path.stat().st_size > 1000 for path in files)
    assert "coupling" in made.text
    assert "never" in made.text
    assert made.scalars["release_delay_80degC_limited"][1] == "s"
    with (tmp_path / "signals_80degC.csv").open() as file:
        heading = next(csv.reader(file))
    assert heading[0] == "time [s]"
    assert "F_mag [N]" in heading
    with np.load(tmp_path / "signals_80degC.npz") as file:
        header = json.loads(str(file["header"]))
        assert header["units"]["h"] == "m"
        assert np.array_equal(
            file["h"], next(r for r in runs if r.label == "+80 degC").coupled["h"]
        )


@pytest.mark.slow
def test_the_limit_is_reported_when_it_acts(runs):
    run = next(run for run in runs if run.limited)
    acts = run.coupled["limit"] == LimitKind.TENSION
    assert acts.any()
    assert np.all(run.coupled["F_v"][acts] > 0.0)
    free = next(run for run in runs if not run.limited)
    assert not np.any(free.coupled["limit"] == LimitKind.TENSION)


def test_the_plan_says_what_is_simulated(device):
    text = device.plan_text()
    for word in ("viscous-force", "tension-limit", "valve", "off  shear-limit", "-20 degC"):
        assert word in text


def test_the_scene_becomes_the_parameters_of_the_fmu(device):
    name, values, film = device.fmu_start()
    assert name == "stiction-mass"
    assert film == device.scene.separation(device.scene.temperature)
    assert values == mass_values(film)
    assert values["R"] == pytest.approx(3.175e-3)
    assert values["dp_cav"] == 1e6
    assert values["h_break"] == pytest.approx(20e-6)


def test_the_menisci_that_cost_compares_fit_into_the_fmu(device):
    """Else a line of the figure is empty."""
    compared = other_menisci(device.scene.separation(device.scene.temperature))
    assert set(compared) == {"meniscus as an arc", "published meniscus, Eq. (3.11)"}
    laws = {name: mass_values(film)["meniscus_law"] for name, film in compared.items()}
    assert list(laws.values()) == ["ARC", "PUBLISHED"]
