"""Measured bridges of Pitois 2000, digitised by others, and what contactkit leaves out there.

The only measured forces over a distance that could be read. contactkit does not meet them with the
conditions that are quoted: the tests state by how much, and what each reason accounts for.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import contactkit as ck

GALLERY = Path(__file__).parents[2] / "examples" / "gallery" / "measured"
CASES = json.loads((GALLERY / "measurements.json").read_text(encoding="utf-8"))
OPENING, CLOSING = CASES["pitois_2000_fig5"], CASES["pitois_2000_fig6"]
RADIUS, VOLUME = OPENING["sphere_radius_m"], OPENING["volume_m3"]
WEIGHT = 9.80665 * OPENING["density_kg_m3"] * VOLUME
DISTANCE, MEASURED = (np.array(OPENING[key]) for key in ("d_over_r", "force_N"))
NEAR, FAR = DISTANCE < 0.055, DISTANCE > 0.11


def spheres(first, last, speed, *effects):
    """The spheres and their oil, over distances over R at a speed [m/s]."""
    oil = ck.Liquid(
        name="silicone oil",
        viscosity=OPENING["viscosity_Pas"],
        surface_tension=OPENING["surface_tension_N_m"],
        density=OPENING["density_kg_m3"],
    )
    ball = ck.Body(surface=ck.Sphere(radius=RADIUS))
    film = ck.Meniscus(liquid=oil, volume=VOLUME, contact_angle_lower=0.0, contact_angle_upper=0.0)
    return ck.SeparationScene(
        interface=ck.Interface(lower=ball, upper=ball, meniscus=film),
        loading=ck.ImposedSpeed(speed=speed, initial_gap=first * RADIUS, final_gap=last * RADIUS),
        effects=effects,
    )


def computed(distance, speed):
    """Capillary and viscous force [N] at distances over R, through a scene."""
    scene = spheres(distance[0], distance[-1], speed, ck.MeniscusForce(), ck.ViscousForce())
    with pytest.warns(ck.ValidityWarning, match="weight of the meniscus"):
        found = ck.simulate(ck.plan(scene))
    at = np.argsort(found.gap)
    return [
        np.interp(distance * RADIUS, found.gap[at], found.columns[name][at])
        for name in ("meniscus_force", "viscous_force")
    ]


def off(force, where):
    return float((force / MEASURED - 1.0)[where].mean())


@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_the_measured_forces_are_missed_as_quoted():
    """A third too little close by, and two fifths too much far off."""
    capillary, viscous = computed(DISTANCE, OPENING["gap_rate_m_s"])
    assert off(capillary + viscous, NEAR) == pytest.approx(-0.33, abs=0.01)
    assert off(capillary + viscous, FAR) == pytest.approx(0.41, abs=0.01)


@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_close_by_the_quoted_rate_is_in_doubt():
    """Twice the rate, as in the other figure, leaves a seventh; the static point is met."""
    capillary, viscous = computed(DISTANCE, 2.0 * OPENING["gap_rate_m_s"])
    assert off(capillary + viscous, NEAR) == pytest.approx(-0.13, abs=0.01)
    static = OPENING["static_first_point"]["force_N"]
    assert capillary[0] == pytest.approx(static, rel=0.08)


@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_far_off_the_weight_of_the_liquid_counts():
    """All of it would take the excess from two fifths to a quarter; equal spheres share it."""
    capillary, viscous = computed(DISTANCE, OPENING["gap_rate_m_s"])
    assert np.max((viscous / capillary)[FAR]) < 0.06
    assert off(capillary + viscous - WEIGHT, FAR) == pytest.approx(0.26, abs=0.01)
    assert WEIGHT / MEASURED[-1] == pytest.approx(0.245, abs=0.005)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_with_film_weight_and_column_half_the_error_is_left():
    """At 10 um/s: 0.29 mm3 stay on the spheres; the lower one is pulled by half the weight less."""
    wetting = ck.LandauLevichFilm(), ck.LiquidWeight(body="lower"), ck.TroutonForce()
    effects = ck.MeniscusForce(), ck.ViscousForce(), *wetting
    scene = spheres(DISTANCE[0], DISTANCE[-1], 1e-5, *effects)
    found = ck.simulate(ck.plan(scene))
    force = np.interp(DISTANCE * RADIUS, found.gap, found.pull)
    assert found["deposited_volume"][-1] == pytest.approx(0.287e-9, rel=0.01)
    assert off(force, NEAR) == pytest.approx(-0.11, abs=0.01)
    assert off(force, FAR) == pytest.approx(0.16, abs=0.01)
    assert np.sqrt(np.mean((force / MEASURED - 1.0) ** 2)) == pytest.approx(0.15, abs=0.01)


@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_a_closing_bridge_attracts_too_much():
    """A receding angle of 0 is no advancing one; the force changes sign at the same distance."""
    distance, measured = (np.array(CLOSING[key])[::-1] for key in ("d_over_r", "force_N"))
    capillary, viscous = computed(distance, -CLOSING["gap_rate_m_s"])
    force = capillary - viscous  # the film is Newtonian: closing, it resists as much
    excess = (force / measured - 1.0)[distance > 0.05]
    assert 0.1 < excess.min() < excess.max() < 1.0
    crossings = [float(np.interp(0.0, f[:8], distance[:8])) for f in (force, measured)]
    assert crossings[0] == pytest.approx(crossings[1], rel=0.12)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_viscosity_and_rate_are_known_by_their_product_and_the_model_misses():
    """Fitted together the points decide 2.5 times the quoted product, and reject the model."""
    effects = ck.MeniscusForce(profile="arc"), ck.ViscousForce()
    ends = 0.9 * DISTANCE[0], 1.1 * DISTANCE[-1]
    scene = spheres(*ends, OPENING["gap_rate_m_s"], *effects)
    curve = ck.MeasuredCurve(
        over="gap",
        at=DISTANCE * RADIUS,
        quantity="pull",
        values=MEASURED,
        noise="proportional",
    )
    sought = {
        "interface.meniscus.liquid.viscosity": (1.0, 1e4),
        "loading.speed": ("0.1 um/s", "1 mm/s"),
    }
    found = ck.fit(scene, curve, sought, intervals="linear")
    assert "what the data decide is viscosity * speed^1 to 1" in found.undecided[0]
    product = found["viscosity"].value * found["speed"].value
    quoted = OPENING["viscosity_Pas"] * OPENING["gap_rate_m_s"]
    assert product / quoted == pytest.approx(2.55, abs=0.1)
    assert found.status == "misfit"
    assert (found.curves[0].noise / MEASURED)[0] == pytest.approx(0.23, abs=0.02)
