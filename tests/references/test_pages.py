"""Pages that hold contactkit against programs and measurements of others: every check holds."""

from __future__ import annotations

import pytest

from contactkit.app.gallery.scripts import folder, load

QUICK = (
    "layered_programs",
    "contact_ball",
    "sphere_bridges",
    "hertz_mindlin",
    "sphere_adhesion",
    "film_forces",
)
SLOW = (
    "contact_square",
    "rupture_work",
    "cold_oil",
    "laser_bumps",
    "bridge_rupture",
)
LONG = ("capillary_rough", "full_contact", "rough_area")  # some seconds; each part has its tests


@pytest.mark.parametrize(
    "name",
    [
        *QUICK,
        *(pytest.param(name, marks=pytest.mark.slow) for name in SLOW),
        *(pytest.param(name, marks=pytest.mark.exhaustive) for name in LONG),
    ],
)
def test_contactkit_agrees_with_others(name):
    module = load(folder() / "measured" / f"{name}.py").module
    found = module.check(module.compute(draft=True))
    assert found
    wrong = [f"{one.statement}: {one.measured}" for one in found if not one.holds]
    assert not wrong, "\n".join(wrong)


@pytest.mark.exhaustive
@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_what_disagrees_disagrees_as_stated():
    module = load(folder() / "measured" / "measured_bridges.py").module
    found = module.check(module.compute(draft=True))
    assert all(one.holds for one in found), found
