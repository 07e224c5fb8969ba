"""Pixels that carry no load: a hole is as if the body were infinitely deep there."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.contact.solver.contact_solver import ContactSolver
from contactkit.errors import DescriptionError, PlanError

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

STEEL = ck.Material(name="steel", young_modulus=200e9, poisson_ratio=0.3)
PIXEL = 1e-8


def masked(shape=(32, 40)):
    rng = np.random.default_rng(0)
    made = np.ma.array(1e-9 * rng.standard_normal(shape), mask=rng.random(shape) < 0.1)
    made[3:9, 4:10] = np.ma.masked
    made.data[made.mask] = np.nan  # what is masked must not matter
    return made


def scene(heights, *effects, loading=None):
    surface = ck.Heights(heights=heights, pixel_size=PIXEL)
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=STEEL), upper=ck.Body(surface=surface)),
        loading=loading or ck.Pressing(pressure=2e9),
        effects=(ck.HalfSpace(), *effects),
    )


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("hardness", [None, 3e10])
def test_a_hole_is_an_infinitely_deep_one(periodic, hardness):
    heights = masked()
    deep = np.where(heights.mask, -1e-4, heights.filled(0.0))
    one, other = (
        ck.press(given, PIXEL, STEEL, 2e9, hardness=hardness, periodic=periodic)
        for given in (heights, deep)
    )
    assert np.array_equal(one.holes, heights.mask)
    assert not one.pressure[heights.mask].any()
    assert one.mean_pressure == pytest.approx(2e9, rel=1e-12)
    assert np.abs(one.pressure - other.pressure).max() < 1e-6 * other.max_pressure
    assert np.abs(one.gap - other.gap)[~heights.mask].max() < 1e-6 * heights.std()
    assert np.isfinite(one.gap).all()
    assert "masked pixels carry no load" in one.message


def test_the_solver_itself_takes_a_mask():
    heights = masked((16, 16))

    def symbol(shape, pixel):
        q = np.hypot(np.fft.fftfreq(shape[0])[:, None], np.fft.rfftfreq(shape[1]))
        return np.divide(1e-19, q, out=np.zeros_like(q), where=q > 0.0)

    solver = ContactSolver((16, 16), (PIXEL, PIXEL), symbol, True)
    found = solver.solve(heights, mean_pressure=1e9, bound=1e11)
    assert found.converged
    assert not found.pressure[heights.mask].any()


def test_full_contact_around_a_hole():
    """Around a hole the mean plane may be passed: the surface rises in it."""
    heights = masked()
    touch = float(heights.max() - heights.mean())
    found = ck.solve(ck.plan(scene(heights, loading=ck.Approach(approach=3.0 * touch))))
    assert found.contact_fraction > 0.6
    assert not found.pressure[heights.mask].any()
    with pytest.raises(ck.InfeasibleError, match="mean plane"):
        ck.plan(scene(heights.filled(0.0) * 0, loading=ck.Approach(approach=3.0 * touch)))


def test_a_mask_without_a_hole_changes_nothing():
    heights = np.ma.array(masked().filled(0.0))
    assert ck.Heights(heights=heights, pixel_size=PIXEL).holes is None


def test_files_copies_and_plans_carry_the_holes(tmp_path):
    heights = masked()
    made = ck.plan(scene(heights))
    assert f"holes: {heights.mask.sum()} of {heights.size} pixels" in str(made)
    found = ck.solve(made)
    ck.save_result(found, tmp_path / "holes.npz")
    for again in (ck.load_result(tmp_path / "holes.npz"), pickle.loads(pickle.dumps(found))):
        assert np.array_equal(again.holes, heights.mask)
        assert np.array_equal(again.pressure, found.pressure)
        repeated = ck.solve(ck.plan(again.plan.scene))
        assert not repeated.pressure[heights.mask].any()


def test_holes_of_both_bodies_and_of_sums_add_up():
    one, other = masked(), masked()[::-1, ::-1]
    lower = ck.CombinedSurface(parts=(ck.Heights(heights=one, pixel_size=PIXEL),))
    upper = ck.Heights(heights=other, pixel_size=PIXEL)
    found = ck.solve(
        ck.plan(
            ck.ContactScene(
                interface=ck.Interface(
                    lower=ck.Body(solid=STEEL, surface=lower), upper=ck.Body(surface=upper)
                ),
                loading=ck.Pressing(pressure=1e9),
                effects=(ck.HalfSpace(),),
            )
        )
    )
    assert np.array_equal(found.holes, one.mask | other.mask)
    assert not found.pressure[found.holes].any()


def test_effects_of_the_gap_refuse_holes():
    water = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.07)
    film = ck.Meniscus(liquid=water, contact_angle_lower=1.0, contact_angle_upper=1.0)
    asked = scene(masked(), ck.FilmMeniscus(film_thickness=1e-9))
    asked = evolve(asked, interface=evolve(asked.interface, meniscus=film))
    with pytest.raises(PlanError, match="FilmMeniscus needs the gap at every pixel"):
        ck.plan(asked)


def test_more_load_than_the_pixels_beside_the_holes_carry():
    heights = masked()
    with pytest.raises(ck.InfeasibleError, match="bound can carry"):
        ck.press(heights, PIXEL, STEEL, 2.9e9, hardness=3e9)


@pytest.mark.parametrize(
    ("heights", "match"),
    [
        (np.ma.masked_all((4, 4)), "every pixel"),
        (np.ma.array(np.full((4, 4), np.nan), mask=np.eye(4)), "masked_invalid"),
        (np.where(np.eye(4) > 0, np.nan, 1e-9), "masked_invalid"),
    ],
)
def test_what_no_mask_cures_is_refused(heights, match):
    with pytest.raises(DescriptionError, match=match):
        ck.press(heights, PIXEL, STEEL, 1e9)


def test_a_masked_hardness_is_refused():
    with pytest.raises(DescriptionError, match="masked in the heights"):
        ck.press(np.eye(4) * 1e-9, PIXEL, STEEL, 1e6, hardness=np.ma.masked_all((4, 4)))


def test_points_that_a_topography_has_not_are_holes():
    class Topography:
        physical_sizes, unit, is_periodic = (1.6, 1.6), "um", False

        def heights(self):
            return np.ma.masked_greater(np.arange(256.0).reshape(16, 16) % 7, 5) * 1e-3

    found = ck.press(Topography(), None, STEEL, 1e8)
    assert np.array_equal(found.holes, Topography().heights().mask.T)
    assert not found.pressure[found.holes].any()


@pytest.mark.parametrize("name", ["pressure", "contact_spots"])
def test_maps_hide_the_holes(name):
    plot = pytest.importorskip("contactkit.plot.contact")
    result = ck.press(masked(), PIXEL, STEEL, 2e9)
    covers = getattr(plot, name)(result).get_images()
    assert len(covers) == 2
    assert np.array_equal(np.ma.getmaskarray(covers[1].get_array()), ~result.holes)
    whole = ck.press(np.nan_to_num(masked().data), PIXEL, STEEL, 2e9)
    assert len(getattr(plot, name)(whole).get_images()) == 1
