"""Live pages of bridges on spheres at an imposed speed: forces over the gap between the nodes."""

from __future__ import annotations

import pytest
from page_scenes import WATER
from wasm import Wasm, needs_runtime

import contactkit as ck
from contactkit.liquids.temperature_table import liquid_table
from contactkit.live_page.family import Family, family_of, with_values
from contactkit.live_page.scene import kernel_scene
from contactkit.live_page.sliders import family_sliders, sliders_of
from contactkit.live_page.validity import Rules

pytestmark = pytest.mark.slow

STANDARD = ck.Accuracy.standard
SPAN = (1e-10, 2e-8)


def humid():
    """A sphere in humid air, whose meniscus condenses."""
    meniscus = ck.Meniscus(
        liquid=WATER, relative_humidity=0.5, contact_angle_lower=0.35, contact_angle_upper=0.35
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=ck.Flat(), upper=ck.Sphere(radius=1e-3), meniscus=meniscus),
        loading=ck.ImposedSpeed(speed=1e-6, initial_gap=2e-10, final_gap=2e-8),
        effects=(ck.MeniscusForce(),),
    )


def family_with(*names):
    """Tables of the humid sphere over some of what moves; angles are named first, and come last."""
    kernel = kernel_scene(humid(), STANDARD)
    known = {s.name: s for s in family_sliders(kernel, liquid_table(WATER))}
    assert [*known] == ["humidity", "sphere_radius", "angle", "temperature"]
    sliders = tuple(known[name] for name in names)
    found = family_of(kernel, sliders, STANDARD, Rules((), {}), SPAN)
    assert isinstance(found, Family)
    return found


@needs_runtime
@pytest.mark.parametrize(
    ("names", "places"),
    [
        (["humidity"], [(0.8,), (0.37,)]),
        pytest.param(
            ["humidity", "angle"],
            [(0.8, 0.35), (0.37, 0.9), (0.62, 0.1)],
            marks=pytest.mark.exhaustive,
        ),
    ],
    ids=["humidity", "humidity and angle"],
)
def test_humidity_and_angle_move_the_force_over_the_gap(names, places):
    family, wasm = family_with(*reversed(names)), Wasm()
    assert [slider.name for slider in family.sliders] == names
    assert family.error < 5e-3
    if "angle" in names:
        assert family.sliders[0].low > 0.1, "drier, no meniscus spans the first gap"
    for place in places:
        scene = with_values(humid(), dict(zip(family.sliders, place, strict=True)))
        plan = ck.plan(scene)
        wasm.begin(family.at(place)[: family.count])
        assert wasm.end() == pytest.approx(plan.film.end, rel=2.0 * family.error)
        for gap in (2e-10, 0.5 * plan.film.end):
            force = wasm.at(gap, 1e-6)[4]
            assert force == pytest.approx(plan.force(gap), rel=2.0 * family.error)


def test_at_a_speed_only_the_loading_moves_in_the_kernel():
    kernel = kernel_scene(humid(), STANDARD)
    found = {one.name: one for one in sliders_of(kernel, liquid_table(WATER))}
    assert [*found] == ["speed", "initial_gap", "final_gap"]
    assert found["final_gap"].label == "largest gap"
    assert found["speed"].unit == "um/s"
