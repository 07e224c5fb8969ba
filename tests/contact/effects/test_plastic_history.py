"""Loading histories of plastic contacts: dense solutions, energy, reloading, hardness by depth."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest

import contactkit as ck
from contactkit.contact.plastic_history import residual_surface
from contactkit.errors import DescriptionError, InfeasibleError, NotSimulatedError, PlanError
from contactkit.roughness.random_surfaces import SelfAffineSpectrum, self_affine

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

# Sphere of 1 mm on 32 x 32 pixels, by dense matrices with the update of section "Loading history":
# step; level [m], elastic energy [J], plastic work [J], pixels in contact, depth [m], volume [m3].
DENSE = [
    (
        2,
        2.0467429546452066e-07,
        2.4315697626050502e-08,
        3.0287007947166527e-10,
        148,
        5.990070639544476e-09,
        4.825031414112762e-19,
    ),
    (
        5,
        3.3351755693145107e-07,
        7.179930149692809e-08,
        1.0338717238489634e-08,
        248,
        4.883903661226787e-08,
        1.6470638349077507e-17,
    ),
    (
        9,
        4.873556750394027e-07,
        1.5551410039552173e-07,
        4.922824322215813e-08,
        376,
        1.193664781594076e-07,
        7.842564720253864e-17,
    ),
    (
        14,
        3.394345984513912e-07,
        4.527046468158897e-08,
        4.922824322215813e-08,
        300,
        1.193664781594076e-07,
        7.842564720253864e-17,
    ),
    (
        19,
        1.2350577956182723e-07,
        1.468099066460178e-12,
        4.922824322215813e-08,
        12,
        1.193664781594076e-07,
        7.842564720253864e-17,
    ),
    (
        24,
        3.394345984513912e-07,
        4.527046468158897e-08,
        4.922824322215813e-08,
        300,
        1.193664781594076e-07,
        7.842564720253864e-17,
    ),
    (
        29,
        4.873556750394028e-07,
        1.5551410039552173e-07,
        4.9228243222158376e-08,
        376,
        1.1936647815940763e-07,
        7.842564720253904e-17,
    ),
]
HARDNESS, WINDOW = 627705922.4646679, 6.836253890716672e-05
UP = tuple(0.1 * i for i in range(1, 11))
LOADS = (*UP, *UP[-2::-1], 1e-3, *UP)

SOFT = ck.Material(name="soft", young_modulus=1e9, poisson_ratio=0.3, hardness=1e8)


def scene(surface, loading, *effects, solid=SOFT, periodic=True):
    law = ck.LayeredHalfSpace() if isinstance(solid, ck.Stack) else ck.HalfSpace()
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Body(surface=surface)),
        window=ck.Window(periodic=periodic),
        loading=loading,
        effects=(law, *effects),
    )


def rough(n=48):
    spectrum = SelfAffineSpectrum(0.8, n / 2 * 1e-9, 8e-9)
    made = self_affine((n, n), (1e-9, 1e-9), None, spectrum, 2, "sample", rms_slope=0.2)
    return ck.Heights(heights=made, pixel_size=1e-9)


def pressed(loading, *effects, **given):
    return ck.solve(ck.plan(scene(rough(), loading, *effects, **given)))


MATERIAL = ck.HardnessLimit(rule="material")


def test_a_sphere_follows_the_dense_solution_up_down_and_up():
    place = (np.arange(32) - 15.5) * WINDOW / 32
    heights = -(place[:, None] ** 2 + place[None, :] ** 2) / 2e-3
    steel = ck.Material(young_modulus=70e9, poisson_ratio=0.3)
    result = ck.solve(
        ck.plan(
            scene(
                ck.Heights(heights=heights, pixel_size=WINDOW / 32),
                ck.Pressing(force=LOADS[-1]),
                ck.HardnessLimit(rule=ck.ConstantHardness(hardness=HARDNESS)),
                ck.PlasticHistory(forces=LOADS[:-1], steps=1),
                solid=steel,
                periodic=False,
            )
        )
    )
    part = result.of(ck.PlasticHistory)
    assert part.load[1:] == pytest.approx(LOADS, rel=1e-12)
    for step, level, elastic, work, pixels, _, volume in DENSE:
        at = step + 1
        assert part.approach[at] - heights.max() == pytest.approx(level, rel=1e-8)
        assert part.elastic_energy[at] == pytest.approx(elastic, rel=1e-7)
        assert part.plastic_work[at] == pytest.approx(work, rel=1e-8)
        assert part.residual_volume[at] == pytest.approx(volume, rel=1e-8)
        assert round(part.contact_area[at] / (WINDOW / 32) ** 2) == pixels
    assert part.residual_depth.max() == pytest.approx(DENSE[-1][5], rel=1e-7)
    assert part.plastic_area[10:30].max() == part.plastic_area[10]
    assert (part.plastic_area[11:20] == 0.0).all()  # unloading is elastic
    assert part.cycle_losses == (part.plastic_work[10],)
    assert part.work_error == pytest.approx(5.7e-3, rel=0.02)  # trapezoids of ten steps


def test_an_imbalance_of_work_is_stated():
    """A path in one step out of contact takes the work of the load for none of the plastic work."""
    name = "imbalance of work and energy over the loading history"
    for steps, is_valid in ((1, False), (8, True)):
        history = ck.PlasticHistory(pressures=(2e7,), steps=steps)
        result = pressed(ck.Pressing(pressure=0.0), MATERIAL, history)
        found = {number.name: number for number in result.validity}[name]
        assert found.value == result.of(ck.PlasticHistory).work_error > 0.0
        assert found.is_valid is is_valid
        assert "use more steps" in str(found)


@pytest.mark.parametrize("periodic", [True, False])
def test_reloading_meets_the_loading_curve_without_new_work(periodic):
    history = ck.PlasticHistory(pressures=(2e7, 0.0), steps=3)
    result = pressed(ck.Pressing(pressure=2e7), MATERIAL, history, periodic=periodic)
    part = result.of(ck.PlasticHistory)
    assert part.load[6] == part.contact_area[6] == 0.0
    assert part.approach[6] > 0.0  # the bodies touch later than before
    assert part.approach[9] == pytest.approx(part.approach[3], rel=1e-8)
    assert part.contact_area[9] == part.contact_area[3]
    assert part.plastic_work[9] == part.plastic_work[3] > 0.0
    assert part.elastic_energy[9] == pytest.approx(part.elastic_energy[3], rel=1e-7)
    assert part.approach[7:10] == pytest.approx(part.approach[5:2:-1], rel=1e-7)
    # One step leads to the same state, as does the contact without a history.
    once = pressed(ck.Pressing(pressure=2e7), MATERIAL, periodic=periodic)
    assert once.rigid_approach == pytest.approx(result.rigid_approach, rel=1e-8)
    scale = part.residual_depth.max()
    overlap = once.of(ck.HardnessLimit).overlap
    np.testing.assert_allclose(part.residual_depth, overlap, atol=1e-6 * scale)
    np.testing.assert_allclose(result.of(ck.HardnessLimit).overlap, overlap, atol=1e-6 * scale)
    np.testing.assert_allclose(result.gap, once.gap, atol=1e-6 * scale)
    assert result.plastic_area == pytest.approx(once.plastic_area)


def test_what_is_left_can_be_pressed_again():
    history = ck.PlasticHistory(pressures=(2e7,), steps=1)
    unloaded = pressed(ck.Pressing(pressure=0.0), MATERIAL, history)
    assert unloaded.status == "no contact"
    part, left = unloaded.of(ck.PlasticHistory), residual_surface(unloaded)
    np.testing.assert_array_equal(left.heights, unloaded.heights - part.residual_depth)
    assert left.is_periodic
    again = ck.solve(ck.plan(scene(left, ck.Pressing(pressure=2e7), MATERIAL)))
    first = pressed(ck.Pressing(pressure=2e7), MATERIAL)
    assert again.rigid_approach == pytest.approx(first.rigid_approach, rel=1e-8)
    assert again.of(ck.HardnessLimit).overlap.max() < 1e-6 * part.residual_depth.max()
    np.testing.assert_array_equal(residual_surface(first).is_periodic, True)
    with pytest.raises(NotSimulatedError, match="HardnessLimit"):
        residual_surface(pressed(ck.Pressing(pressure=2e7)))


@pytest.mark.slow  # 80 steps
def test_the_energy_of_forty_steps_adds_up_to_a_thousandth():
    """Sphere at 0.6 of Hertz's maximum pressure; values of a finer dense solution, 1 %."""
    force, radius = 1.0, 1e-3
    size = (0.75 * force * radius * 0.91 / 1e9) ** (1.0 / 3.0)
    hertz = 1.5 * force / (math.pi * size**2)
    made = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=SOFT), upper=ck.Body(surface=ck.Paraboloid(radius=radius))
        ),
        window=ck.Window(width=3.2 * size, periodic=False),
        loading=ck.Pressing(force=0.0),
        effects=(
            ck.HalfSpace(),
            ck.HardnessLimit(rule=ck.ConstantHardness(hardness=0.6 * hertz)),
            ck.PlasticHistory(forces=(force,), steps=40),
        ),
    )
    part = ck.solve(ck.plan(made, ck.Accuracy(grid=64))).of(ck.PlasticHistory)
    assert part.work_error < 1e-3
    length, energy = size**2 / radius, force * size**2 / radius
    assert part.approach[40] / length == pytest.approx(1.068, abs=2e-3)
    assert part.residual_depth.max() / length == pytest.approx(0.263, abs=1e-3)
    assert part.residual_volume[-1] / (size**4 / radius) == pytest.approx(0.3765, rel=4e-3)
    assert part.plastic_work[-1] / energy == pytest.approx(0.1078, rel=4e-3)
    assert part.elastic_energy[40] / energy == pytest.approx(0.3412, rel=1e-3)
    assert part.elastic_energy[-1] == 0.0  # all of it has come back
    assert part.cycle_losses == (part.plastic_work[-1],)
    assert part.external_work[-1] == pytest.approx(part.plastic_work[-1], rel=5e-3)
    touching = math.sqrt(part.contact_area[40] / math.pi) / size
    assert touching == pytest.approx(1.087, abs=5e-3)


def test_an_approach_may_be_imposed_instead():
    depth = pressed(ck.Pressing(pressure=2e7), MATERIAL).approach
    history = ck.PlasticHistory(approaches=(depth, 0.0), steps=2)
    part = pressed(ck.Approach(approach=depth), MATERIAL, history).of(ck.PlasticHistory)
    assert part.approach == pytest.approx([0.0, depth / 2, depth, depth / 2, 0.0, depth / 2, depth])
    assert part.load[4] == 0.0  # apart: the residual indentation is deeper than that
    assert part.load[6] == pytest.approx(part.load[2], rel=1e-7)
    assert part.cycle_losses == (part.plastic_work[-1],)
    assert part.plastic_work[-1] > 0.0


def film(hard, soft):
    layer = ck.Material(name="film", young_modulus=2e9, poisson_ratio=0.3, hardness=hard)
    below = ck.Material(name="ground", young_modulus=1e9, poisson_ratio=0.3, hardness=soft)
    return ck.Stack(layers=(ck.Layer(material=layer, thickness=3e-10),), substrate=below)


@pytest.mark.parametrize("displacement", ["largest", "local"])
@pytest.mark.parametrize("hardness", [(3e8, 1e8), (1e8, 3e8)])
def test_unloading_changes_no_hardness_that_depends_on_depth(hardness, displacement):
    limit = ck.HardnessLimit(rule=ck.ContinuousHardness(displacement=displacement))
    history = ck.PlasticHistory(pressures=(2e7, 1e6), steps=2)
    given = {"solid": film(*hardness)}
    result = pressed(ck.Pressing(pressure=2e7), limit, history, **given)
    part = result.of(ck.PlasticHistory)
    signs = np.sign(np.diff(part.hardness[1:3]))
    assert (signs == np.sign(hardness[1] - hardness[0])).all()  # loading: towards the ground's
    assert part.hardness[3:] == pytest.approx(part.hardness[2], rel=1e-4)
    assert (np.diff(part.hardness[2:]) >= 0.0).all()
    assert part.plastic_work[6] == part.plastic_work[2] > 0.0
    assert part.approach[6] == pytest.approx(part.approach[2], rel=1e-8)
    once = pressed(ck.Pressing(pressure=2e7), limit, **given)
    assert once.rigid_approach == pytest.approx(result.rigid_approach, rel=1e-5)


def test_an_elastic_contact_has_no_memory():
    history = ck.PlasticHistory(pressures=(2e6,), steps=2)
    limit = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=1e12))
    part = pressed(ck.Pressing(pressure=1e6), limit, history).of(ck.PlasticHistory)
    assert part.plastic_work.max() == part.residual_depth.max() == part.plastic_area.max() == 0.0
    assert part.approach[1] == pytest.approx(part.approach[4], rel=1e-7)
    assert part.cycle_losses == (0.0,)


def test_what_a_window_that_repeats_along_one_axis_leaves_is_pressed_in_it():
    history = ck.PlasticHistory(pressures=(2e7, 0.0), steps=1)
    made = scene(rough(24), ck.Pressing(pressure=2e7), MATERIAL, history, periodic="x")
    result = ck.solve(ck.plan(made))
    part = result.of(ck.PlasticHistory)
    assert part.approach[3] == pytest.approx(part.approach[1], rel=1e-7)
    assert part.plastic_work[3] == part.plastic_work[1] > 0.0
    left = residual_surface(result)
    assert left.is_periodic is None
    again = scene(left, ck.Pressing(pressure=2e7), MATERIAL, periodic="x")
    assert ck.solve(ck.plan(again)).rigid_approach == pytest.approx(result.rigid_approach, rel=1e-7)


@pytest.mark.parametrize("rms", [0.0, 1e-9])
def test_a_contact_with_coupled_friction_opens_again(rms):
    """The displacement by friction has to fall to nothing, and so does what it is small against."""
    heights = rms * np.random.default_rng(0).normal(size=(16, 12))
    hard = ck.Material(young_modulus=3e9, poisson_ratio=0.2, hardness=1e8)
    result = ck.solve(
        ck.plan(
            scene(
                ck.Heights(heights=heights, pixel_size=2e-8),
                ck.Pressing(pressure=0.0),
                MATERIAL,
                ck.PlasticHistory(pressures=(2e6,), steps=2),
                ck.FrictionTraction(coefficient=0.5),
                ck.FrictionCoupling(),
                solid=ck.Stack(layers=(ck.Layer(material=hard, thickness=5e-9),), substrate=SOFT),
                periodic=False,
            )
        )
    )
    assert result.status == "no contact"
    assert not result.pressure.any()
    part = result.of(ck.PlasticHistory)
    assert part.load[-2] > part.load[-1] == 0.0


def test_holes_carry_no_load_and_stay_holes():
    holes = np.zeros((48, 48), dtype=bool)
    holes[10:14, 20:30] = True
    surface = ck.Heights(heights=np.ma.MaskedArray(rough().heights, holes), pixel_size=1e-9)
    history = ck.PlasticHistory(pressures=(2e7,), steps=2)
    result = ck.solve(ck.plan(scene(surface, ck.Pressing(pressure=1e7), MATERIAL, history)))
    part = result.of(ck.PlasticHistory)
    assert part.residual_depth.max() > 0.0
    assert (part.residual_depth[holes] == 0.0).all()
    np.testing.assert_array_equal(residual_surface(result).holes, holes)


def test_a_history_is_kept_in_files_and_pickles(tmp_path):
    history = ck.PlasticHistory(pressures=(2e7, 0.0), steps=1)
    result = pressed(ck.Pressing(pressure=1e7), MATERIAL, history)
    part = result.of(ck.PlasticHistory)
    ck.save_result(result, tmp_path / "history.npz")
    read = ck.load_result(tmp_path / "history.npz", ck.ContactResult)
    for other in (read, pickle.loads(pickle.dumps(result))):
        for mine, theirs in zip(part, other.of(ck.PlasticHistory), strict=True):
            np.testing.assert_array_equal(mine, theirs)
    assert [str(one) for one in read.validity] == [str(one) for one in result.validity]
    assert read.scalars()["plastic_work"] == (part.plastic_work[-1], "J")


@pytest.mark.parametrize(
    ("effects", "loading", "message"),
    [
        ((ck.PlasticHistory(pressures=(1e6,)),), ck.Pressing(pressure=1e6), "HardnessLimit"),
        ((MATERIAL, ck.PlasticHistory()), ck.Pressing(pressure=1e6), "exactly one of pressures"),
        (
            (MATERIAL, ck.PlasticHistory(pressures=(1e6,), forces=(1.0,))),
            ck.Pressing(pressure=1e6),
            "exactly one of pressures",
        ),
        (
            (MATERIAL, ck.PlasticHistory(approaches=(1e-9,))),
            ck.Pressing(pressure=1e6),
            r"loading = Approach",
        ),
        (
            (MATERIAL, ck.PlasticHistory(forces=(1e-9,))),
            ck.Approach(approach=1e-9),
            r"loading = Pressing",
        ),
    ],
)
def test_what_does_not_fit_a_history_is_refused(effects, loading, message):
    with pytest.raises(PlanError, match=message):
        ck.plan(scene(rough(), loading, *effects))


def test_impossible_loads_before_are_refused_when_planned():
    too_much = ck.PlasticHistory(pressures=(2e8,))
    with pytest.raises(InfeasibleError, match="hardness"):
        ck.plan(scene(rough(), ck.Pressing(pressure=1e6), MATERIAL, too_much))
    for wrong in ({"pressures": (-1.0,)}, {"steps": 0}, {"forces": (math.inf,)}):
        with pytest.raises(DescriptionError, match=next(iter(wrong))):
            ck.PlasticHistory(**wrong)
    history = ck.PlasticHistory(pressures=(1e6,))
    with pytest.raises(PlanError, match="plastic-history"):
        ck.load_displacement(scene(rough(), ck.Pressing(pressure=1e6), MATERIAL, history))
