"""Every message of the micromirror's scene objects, and of what its file may get wrong."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from attrs import evolve
from refusals import each_change_refused

from contactkit.analyses.load_displacement.curve import LoadDisplacementCurve
from contactkit.app.scenes import OpenedDevice, open_scene
from contactkit.errors import ConvergenceError, DescriptionError, InfeasibleError, PlanError
from contactkit.models.micromirror import monolithic, tip_impact
from contactkit.models.micromirror.electrostatics import Electrode
from contactkit.models.micromirror.flight import Root
from contactkit.models.micromirror.mirror import Hinge, Mirror, SpringTips, Waveform
from contactkit.models.micromirror.tip import advance_tip, free_start
from contactkit.models.micromirror.tip_film import condensed_volume, tip_law

pytestmark = pytest.mark.errors

MODEL = Path(__file__).parents[2] / "models" / "micromirror" / "micromirror.toml"
HINGE = Hinge(inertia=2e-24, stiffness=2e-13)
PAD = Electrode(width=8e-6, outer=5.5e-6, gap=1.5e-6)
TIPS = SpringTips(arm=6e-6, landing_tilt=0.17)
WAVE = Waveform(bias_voltage=-20.0, release_time=2e-6, period=1e-4)


@pytest.fixture(scope="module")
def scene():
    return open_scene("micromirror").scene


test_an_impossible_number_is_refused = each_change_refused(
    [
        (HINGE, {"inertia": 0.0}, "Hinge.inertia must be positive and finite [kg.m2], got 0.0"),
        (HINGE, {"stiffness": -1.0}, "Hinge.stiffness must be positive and finite [N.m/rad]"),
        (HINGE, {"damping": -1.0}, "Hinge.damping must be zero or positive, and finite"),
        (PAD, {"gap": 0.0}, "Electrode.gap must be positive and finite [m], got 0.0"),
        (PAD, {"inner": -1e-6}, "Electrode.inner must be zero or positive, and finite [m]"),
        (PAD, {"width": float("inf")}, "Electrode.width must be positive and finite [m]"),
        (TIPS, {"arm": 0.0}, "SpringTips.arm must be positive and finite [m], got 0.0"),
        (
            TIPS,
            {"landing_tilt": 10.0},
            "SpringTips.landing_tilt must be less than a right angle "
            "[rad], got 10.0; was it meant in "
            "degrees? write '10 deg'",
        ),
        (TIPS, {"per_side": 0}, "SpringTips.per_side must be a whole number of at least 1, got 0"),
        (TIPS, {"damping": -1.0}, "SpringTips.damping must be zero or positive, and finite"),
        (WAVE, {"bias_voltage": float("nan")}, "Waveform.bias_voltage must be a finite number [V]"),
        (WAVE, {"release_time": 0.0}, "Waveform.release_time must be positive and finite [s]"),
        (WAVE, {"flips": 0}, "Waveform.flips must be a whole number of at least 1, got 0"),
        (
            WAVE,
            {"period": 1e-6},
            "Waveform.period must be at least reset_time + release_time = 2e-06 s [s], got 1e-06",
        ),
    ],
)


def test_the_stop_must_come_before_the_electrode():
    message = "SpringTips.landing_tilt must be less than 0.276"
    with pytest.raises(DescriptionError, match=re.escape(message)):
        Mirror(hinge=HINGE, electrode=PAD, tips=evolve(TIPS, landing_tilt=0.3), waveform=WAVE)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"humidity": 1.0}, "MirrorStudy.humidity must be less than 1, got 1.0; at saturation"),
        ({"humidity": 50.0}, "MirrorStudy.humidity must lie between 0 and 1, got 50.0"),
        ({"humidities": (0.5, -0.1)}, "MirrorStudy.humidities must lie between 0 and 1, got -0.1"),
        ({"largest_reset": 0.0}, "MirrorStudy.largest_reset must be positive and finite [V]"),
        ({"patience": 0.0}, "MirrorStudy.patience must be positive and finite [s], got 0.0"),
        ({"communication_step": -1.0}, "MirrorStudy.communication_step must be positive and"),
    ],
)
def test_an_impossible_study_is_refused(scene, change, message):
    with pytest.raises(DescriptionError, match=re.escape(message)):
        evolve(scene.study, **change)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rest_gap": 0.0}, "ImposedForce.rest_gap must equal initial_gap = 4e-10 m [m], got 0.0"),
        ({"mass": None}, "ImposedForce.mass must be that of a spring tip [kg], got None"),
        ({"stiffness": 0.0}, "ImposedForce.stiffness must be that of a spring tip [N/m], got 0.0"),
    ],
)
def test_a_tip_needs_mass_spring_and_site(scene, change, message):
    with pytest.raises(DescriptionError, match=re.escape(message)):
        evolve(scene, loading=evolve(scene.loading, **change))


def test_a_misspelt_key_names_the_right_one(tmp_path):
    path = tmp_path / "mirror.toml"
    path.write_text(MODEL.read_text().replace("landing_tilt", "landing_tlit"))
    with pytest.raises(DescriptionError, match="landing_tlit"):
        open_scene(str(path))


def test_cost_needs_a_pulse_that_releases(scene):

    wave = evolve(scene.mirror.waveform, reset_voltage=-24.0)
    weak = evolve(scene, mirror=evolve(scene.mirror, waveform=wave))
    weak = evolve(weak, study=evolve(weak.study, patience=1e-6))
    with pytest.raises(PlanError, match="cost needs a pulse that releases; 24 V do not"):
        OpenedDevice(weak).cost(None, lambda fraction: None, 1e-6)


# Failures of what is computed: each names a cure --------------------------------------------------


def flip(scene):
    """The monolithic model of a first flip, dry."""
    mirror = evolve(scene.mirror, waveform=evolve(scene.mirror.waveform, start_delay=0.0, flips=1))
    made = tip_law(scene.tip, 0.0)
    return monolithic.simulate_monolithic(mirror, made, scene.start, 5e-6)


def test_events_without_end_name_a_cure(scene, monkeypatch):
    monkeypatch.setattr(monolithic, "_MOST_PIECES", 1)
    with pytest.raises(ConvergenceError, match=r"without end at .*; end earlier, or give"):
        flip(scene)


def test_a_solver_that_gives_up_names_a_cure(scene, monkeypatch):
    class Failed:
        success, sol, message = False, None, "It failed."

    monkeypatch.setattr(monolithic, "solve_ivp", lambda *_, **__: Failed())
    with pytest.raises(ConvergenceError, match=r"scipy stopped at 0 s: It failed\. Use a larger"):
        flip(scene)


def test_an_impact_that_no_step_meets_names_a_cure(scene, monkeypatch):
    error = (1.0, 1.0, 0.0, 0.0)
    monkeypatch.setattr(tip_impact, "_step", lambda *given: (given[2], error))
    curve = LoadDisplacementCurve(
        approach=(1e-9, 2e-9),
        force=(1e-6, 3e-6),
        contact_area=(1e-16, 2e-16),
        plastic_area=(0.0, 0.0),
        elastic_limit=2e-9,
        nominal_area=1e-13,
    )
    stop = tip_impact.TipStop(curve)
    made = tip_law(scene.tip, 0.0)
    with pytest.raises(ConvergenceError, match=r"time_rtol = 1e-07 at .* s; loosen it"):
        advance_tip(made, 0.0, free_start(made, 1e-9, -1.0), Root(1e-9), 2e-8, stop)


def test_a_liquid_without_surface_tension_names_a_cure(scene):
    meniscus = scene.tip.interface.meniscus
    bare = evolve(meniscus, liquid=evolve(meniscus.liquid, surface_tension=None))
    tip = evolve(scene.tip, interface=evolve(scene.tip.interface, meniscus=bare))
    with pytest.raises(InfeasibleError, match=r"holds no meniscus; give Liquid\.surface_tension"):
        condensed_volume(tip, 0.5)
