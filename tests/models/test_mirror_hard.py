"""Hard cases of the micromirror: extreme tips, long and short steps, no film, no release."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from attrs import evolve

from contactkit.app.scenes import open_scene
from contactkit.errors import DescriptionError, InfeasibleError
from contactkit.models.micromirror.coupling import couple, longest_step
from contactkit.models.micromirror.flight import Root
from contactkit.models.micromirror.mirror import electrode_volts, landed_tilt, switching_times
from contactkit.models.micromirror.tip import advance_tip, film_force, free_start, landed_start
from contactkit.models.micromirror.tip_film import (
    adhesion,
    condensed_volume,
    pressure_law,
    tip_law,
)

pytestmark = pytest.mark.hard


@pytest.fixture(scope="module")
def scene():
    return open_scene("micromirror").scene


@pytest.fixture(scope="module")
def wet(scene):
    return tip_law(scene.tip, 0.5)


def test_a_step_of_any_length(wet):
    """One step over all of a release, and one far below the time of an atom."""
    long = advance_tip(wet, 2e-10, landed_start(wet), Root(-5e-8, 0.5), 1e-5)
    assert long.free
    assert long.motion.n_breaks == 1
    short = advance_tip(wet, 2e-10, landed_start(wet), Root(1e-7), 1e-18)
    assert short.time == pytest.approx(1e-18)
    none = advance_tip(wet, 2e-10, landed_start(wet), Root(1e-7), 0.0)
    assert none == landed_start(wet)


@pytest.mark.parametrize("dt", [-1e-9, math.inf, math.nan])
def test_an_impossible_step_is_refused(wet, dt):
    with pytest.raises(DescriptionError, match=r"advance_tip\(dt\) must be zero or positive"):
        advance_tip(wet, 0.0, landed_start(wet), Root(0.0), dt)


@pytest.mark.parametrize("factor", [1e-3, 1e3])
def test_a_mass_ratio_of_a_million(scene, factor):
    """The tip follows its spring whatever it weighs; the heavy one later."""
    tip = evolve(scene.tip, loading=evolve(scene.tip.loading, mass=4e-16 * factor))
    made = tip_law(tip, 0.5)
    state = advance_tip(made, 0.0, landed_start(made), Root(-1e-8, 0.05), 5e-5 * factor**0.5)
    assert state.free
    assert state.motion.break_time > 5e-8


def test_a_tip_that_never_dries_out_or_wets(scene):
    """Without re-wetting it lands dry: only the solids hold it."""
    meniscus = evolve(scene.tip.interface.meniscus, rewetting=0.0)
    tip = evolve(scene.tip, interface=evolve(scene.tip.interface, meniscus=meniscus))
    made = tip_law(tip, 0.5)
    state = advance_tip(made, 0.0, free_start(made, 1e-8), Root(1e-8, -0.1), 2e-7)
    assert state.motion.in_contact
    assert state.motion.broken
    assert film_force(made, state) == pytest.approx(adhesion(tip, 0.0).force, rel=1e-9)


def test_a_tip_glued_for_good(scene):
    """A root that does not pull hard enough leaves it where it is."""
    made = tip_law(scene.tip, 0.9)
    hold = adhesion(scene.tip, 0.9).force
    state = advance_tip(made, 0.0, landed_start(made), Root(0.999 * hold), 1.0)
    assert state.motion.in_contact
    freed = advance_tip(made, 0.0, landed_start(made), Root(1.001 * hold), 1e-6)
    assert freed.free


@pytest.mark.parametrize("angle", [0.0, 90.0, 180.0])
def test_contact_angles(scene, angle):
    """What the liquid wets it fills; what it does not stays dry at any humidity."""
    theta = math.radians(angle)
    meniscus = evolve(
        scene.tip.interface.meniscus, contact_angle_lower=theta, contact_angle_upper=theta
    )
    tip = evolve(scene.tip, interface=evolve(scene.tip.interface, meniscus=meniscus))
    volume = condensed_volume(tip, 0.8)
    assert (volume > 0.0) is (angle < 90.0)
    held = adhesion(tip, 0.8)
    assert (held.meniscus_force > 0.0) is (angle < 90.0)
    assert held.solid_force > 0.0


@pytest.mark.parametrize("humidity", [0.0, 1e-9, 0.01, 0.13])
def test_air_too_dry_to_span_the_gap(scene, humidity):
    held = adhesion(scene.tip, humidity)
    assert held.volume == held.meniscus_force == held.kelvin_radius == 0.0
    assert math.isnan(held.break_gap)


def test_next_to_saturation(scene):
    """The force nears that of a thick bridge, and the pressure law ends far out."""
    held = adhesion(scene.tip, 0.99)
    tension = scene.tip.interface.meniscus.liquid.at(scene.temperature).surface_tension
    most = 4.0 * math.pi * 1e-7 * tension * math.cos(math.radians(40.0))
    assert 0.5 * most < held.meniscus_force < most
    gaps = np.array([0.4e-9, 10e-9, 1e-6])
    forces = pressure_law(scene.tip, 0.99, gaps)
    assert forces[0] == pytest.approx(held.meniscus_force, rel=1e-6)
    assert forces[0] > forces[1] > forces[2] == 0.0


def test_without_solids_and_vapour_nothing_holds(scene):
    import contactkit as ck

    alone = evolve(scene, effects=(ck.MeniscusForce(),))
    with pytest.raises(InfeasibleError, match="nothing else holds a tip; list van-der-waals-force"):
        tip_law(alone.tip, 0.05)


def test_a_step_beyond_stability_is_refused(scene, wet):
    longest = longest_step(scene.mirror, scene.loading.stiffness)
    with pytest.raises(InfeasibleError, match="the longest with which the spring tips can be"):
        couple(scene.mirror, scene.tips(wet), 1.0, scene.start, 1e-6, 0.51 * longest)
    for stop, step in ((0.0, 1e-9), (1e-6, math.nan)):
        with pytest.raises(DescriptionError, match="must be positive and finite"):
            couple(scene.mirror, scene.tips(wet), 1.0, scene.start, stop, step)


def test_a_pulse_that_pulls_the_plate_on_its_electrode(scene, wet):
    mirror = scene.first_flip(200.0)
    mirror = evolve(mirror, waveform=evolve(mirror.waveform, reset_time=3e-6))
    with pytest.raises(InfeasibleError, match="the plate meets the electrode at a tilt of"):
        couple(mirror, scene.tips(wet), 1.0, scene.start, 3e-6, 2e-8)


def test_voltages_that_do_not_hold_or_hold_too_well(scene):
    with pytest.raises(InfeasibleError, match="5 V do not hold the mirror at its landing tilt"):
        landed_tilt(scene.mirror, 1.0, (5.0, 0.0))
    with pytest.raises(InfeasibleError, match="100 V press the plate through its spring tips"):
        landed_tilt(scene.mirror, 1.0, (100.0, 0.0))


def test_switching_times_and_volts_agree(scene):
    """Between two switching times nothing changes; at each something does."""
    wave = scene.mirror.waveform
    times = [0.0, *switching_times(wave, 0.0, wave.stop_time), wave.stop_time]
    assert len(times) == 2 + 3 * wave.flips
    seen = []
    for low, high in pairwise(times):
        inside = {electrode_volts(wave, low + x * (high - low)) for x in (0.01, 0.5, 0.99)}
        assert len(inside) == 1
        seen.append(inside.pop())
    assert all(a != b for a, b in pairwise(seen))
    # Over and back: the last bias holds the other side than the first, twice.
    assert seen[0] == seen[-1]
