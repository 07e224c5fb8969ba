"""The fuel injector: what the demo reports, in numbers."""

from __future__ import annotations

import csv
import json
import math
import tomllib
from pathlib import Path

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.benchmarks.separation import other_menisci
from contactkit.files.scenes import structure
from contactkit.fmu.slaves.stiction_mass import mass_values
from contactkit.models.injector.delays import delay, dry_delay
from contactkit.models.injector.report.cosimulation import cosimulate_cases
from contactkit.models.injector.report.cycles import cycles, held_pressure, largest_pull, run_error
from contactkit.models.injector.report.run import report
from contactkit.models.injector.scene import Study
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
def test_what_the_cavity_holds_decides_how_long_the_spool_sticks(short, runs):
    for run in runs:
        first, second = (cycle.delay for cycle in cycles(run, short.scene))
        if run.sustained:
            cold = run.temperature < 273.0
            assert first == pytest.approx(0.5545e-3 if cold else 0.5089e-3, rel=1e-3)
        else:
            assert first == pytest.approx(0.3422e-3, rel=1e-3)
        assert second < first  # from a gap that has not closed


@pytest.mark.slow
def test_an_oil_that_never_cavitates_does_not_release_the_spool_within_the_pulse(short):
    for temperature in short.scene.study.temperatures:
        assert math.isnan(delay(short.scene, temperature, cavitates=False))


@pytest.mark.slow
def test_the_fmu_pair_agrees_with_the_monolithic_model(short, runs):
    """At 5 us the coupling is second order; a film that cavitates is a kink within a step."""
    for run in runs:
        assert run_error(run, cycles(run, short.scene)) < 2e-4


@pytest.mark.slow
def test_a_cavitated_film_holds_no_more_than_the_pressure_in_its_cavity(short, runs):
    area = math.pi * 3.175e-3**2
    for run in runs:
        first = cycles(run, short.scene)[0]
        assert 0.3 < first.cavitated_fraction < 0.9
        assert first.meniscus_impulse == 0.0 < first.viscous_impulse
        cavitated = run.coupled["r_cav"] > 0.0
        drop = 1e6 if run.sustained else 101325.0
        assert 0.8 * area * drop < run.coupled["F_v"][cavitated].max() < area * drop
        assert run.coupled["F_peak"][-1] >= 0.5e6 * area * (1.0 - 1e-6)


@pytest.mark.slow
def test_a_dry_spool_is_faster_than_any_other(short, runs):
    dry = dry_delay(short.scene)
    assert dry == pytest.approx(0.319e-3, rel=0.01)
    # Of the first cycle: later ones start from a gap that has not closed.
    assert all(cycles(run, short.scene)[0].delay > dry for run in runs)


@pytest.mark.slow
def test_momentum_balances_over_the_first_opening(short, runs):
    """Pull less film is the momentum of the spool; the pull is sampled at 5 us."""
    run = next(run for run in runs if run.sustained)
    signals, time = run.coupled, run.coupled.time
    released = short.scene.valve.profile.start_delay + cycles(run, short.scene)[0].delay
    end = int(np.searchsorted(time, released))
    moving = (signals["v"] != 0.0) & (np.arange(len(time)) <= end)
    first = int(np.argmax(moving)) - 1
    given = np.trapezoid(signals["F_ext"][first : end + 1], time[first : end + 1])
    taken = signals["J"][end] + signals["J_m"][end] - signals["J"][first] - signals["J_m"][first]
    momentum = short.scene.loading.mass * signals["v"][end]
    assert given - taken == pytest.approx(momentum, rel=0.02)


@pytest.mark.slow
def test_the_report_writes_signals_figures_and_fmus(short, runs, tmp_path):
    made = report(short.scene, runs, tmp_path)
    files = (*made.write(), *made.draw())
    names = {path.name for path in files}
    assert {"release-zoom.png", "delay-against-temperature.png", "one-cycle.png"} <= names
    assert {"force-balance_minus20degC.png", "delay-against-strength.png"} <= names
    assert {"signals_80degC.csv", "signals_80degC.npz", "signals_80degC_sustained.csv"} <= names
    assert all(path.stat().st_size > 1000 for path in files)
    assert "coupling" in made.text
    assert "an oil of up to 25.7 bar cavitates" in made.text
    assert "from 12.9 bar on the cavity holds the whole pull" in made.text
    assert "delay-against-pressure.png" in names
    assert "from cold to warm: never, never" in made.text
    assert made.scalars["release_delay_80degC_sustained"][1] == "s"
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
def test_the_limit_is_reported_while_the_film_is_cavitated(runs):
    for run in runs:
        acts = run.coupled["limit"] == LimitKind.TENSION
        assert acts.any()
        assert np.array_equal(acts, run.coupled["V_void"] > 0.0)
        assert np.all(run.coupled["V_void"] < math.pi * 3.175e-3**2 * run.coupled["h"])


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
    assert (values["dp_inception"], values["dp_hold"], values["dp_cav"]) == (1e6, 101325.0, 0.0)
    assert values["V"] == values["h_break"] == 0.0


def test_from_the_pressure_at_which_the_cavity_holds_the_pull_the_answer_is_another(device):
    """Area times the drop in the cavity against the pull: statics, whatever the oil."""
    scene = device.scene
    face, vapour = math.pi * 3.175e-3**2, 0.0
    holds = held_pressure(scene, scene.tension_limit, largest_pull(scene))
    assert (holds - vapour) * face == pytest.approx(40.7, rel=0.01)
    low, high = (
        [delay(scene, t, ambient_pressure=p * holds) for t in (253.15, 293.15, 353.15)]
        for p in (0.9, 1.2)
    )
    assert low[0] > low[1] > low[2] > 1.5 * dry_delay(scene)  # worse in the cold
    assert math.isnan(high[0])
    assert math.isnan(high[1])
    assert high[2] > 4.0 * dry_delay(scene)


def test_the_oil_keeps_its_absolute_tension_at_another_pressure_around_the_face(device):
    limit = device.scene.separation(293.15, ambient_pressure=13e5).effect(ck.TensionLimit)
    assert limit.ambient_pressure - limit.tension == pytest.approx(101325.0 - 1e6)
    assert limit.cavity_drop == 13e5


def test_an_oil_may_be_another_one(device):
    scene = device.scene

    def drops(**oil):
        limit = scene.separation(293.15, **oil).effect(ck.TensionLimit)
        return limit.tension, limit.cavity_drop

    assert drops() == (1e6, 101325.0)
    assert drops(strength=2e6) == (2e6, 101325.0)
    assert drops(cavity_pressure=-4e5) == (1e6, 501325.0)
    assert drops(cavity_pressure=-math.inf) == (1e6, 1e6)
    assert drops(strength=3e5, cavity_pressure=-9e5) == (3e5, 3e5)  # not below where it cavitates
    assert scene.separation(293.15, cavitates=False).effect(ck.TensionLimit) is None


def test_the_key_of_earlier_files_names_the_new_ones():
    text = (MODELS / "injector" / "fuel_injector.toml").read_text("utf-8")
    tables = tomllib.loads(text.replace("strengths =", "tension_limits ="))
    with pytest.raises(ck.DescriptionError, match=r"tension_limits.*strengths and"):
        structure(tables["study"], Study, "old.toml")


def test_the_menisci_that_cost_compares_fit_into_the_fmu(device):
    """Else a line of the figure is empty, of an injector whose film has a free surface."""
    flooded = device.scene.separation(device.scene.temperature)
    drop = evolve(flooded.meniscus, volume=math.pi * 3.175e-3**2 * 5e-6)
    film = evolve(
        flooded,
        interface=evolve(flooded.interface, meniscus=drop),
        effects=(ck.MeniscusForce(), *flooded.effects),
    )
    assert not other_menisci(flooded)
    compared = other_menisci(film)
    assert set(compared) == {"meniscus as an arc", "published meniscus, Eq. (3.11)"}
    laws = {name: mass_values(film)["meniscus_law"] for name, film in compared.items()}
    assert list(laws.values()) == ["ARC", "PUBLISHED"]
