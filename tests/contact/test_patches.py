"""Contact patches: connectivity, edges of the window, sizes, means."""

from __future__ import annotations

import numpy as np
import pytest

import contactkit as ck
from contactkit.contact.patches import contact_patches, patch_density, patches_of
from contactkit.errors import DescriptionError

PIXEL = (2.0, 0.5)


def spots(text):
    return np.array([[c == "#" for c in line] for line in text.split()])


def test_corners_join_by_choice():
    drawn = spots("##.. ##.. ..## ..##")
    assert patches_of(drawn, PIXEL, False, 8).areas.tolist() == [8.0]
    assert patches_of(drawn, PIXEL, False, 4).areas.tolist() == [4.0, 4.0]


@pytest.mark.parametrize(
    ("drawn", "four", "eight"),
    [
        ("#..# .... .... #..#", [4.0], [4.0]),  # one spot over a corner of the window
        ("#... ...# .... ....", [1.0, 1.0], [2.0]),  # a corner, across an edge
        ("#... .... .... ...#", [1.0, 1.0], [2.0]),  # opposite corners of the window meet
        ("#... .#.. ..#. ...#", [1.0] * 4, [4.0]),
    ],
)
def test_spots_continue_across_the_edges_of_a_periodic_window(drawn, four, eight):
    mask = spots(drawn)
    for connectivity, areas in ((4, four), (8, eight)):
        found = patches_of(mask, (1.0, 1.0), True, connectivity, fewest_pixels=1)
        assert found.areas.tolist() == areas
        assert (found.labels > 0).tolist() == mask.tolist()


@pytest.mark.parametrize(("along", "areas"), [("x", [4.0, 1.0]), ("y", [4.0, 1.0])])
def test_spots_continue_along_the_one_axis_that_repeats(along, areas):
    drawn = spots("#..# #..# .... ...#")  # over x: four pixels; over y: two below, one above
    drawn = drawn if along == "x" else drawn.T
    found = patches_of(drawn, (1.0, 1.0), along, 8, fewest_pixels=1)
    assert found.areas.tolist() == areas
    assert found.labels.shape == drawn.shape
    assert patches_of(drawn, (1.0, 1.0), True, 8, fewest_pixels=1).areas.tolist() == [5.0]
    assert patches_of(drawn, (1.0, 1.0), False, 8, fewest_pixels=1).number == 3


def test_small_ones_are_counted_apart():
    drawn = spots("####.# ####.. ...... #.....")
    found = patches_of(drawn, PIXEL, periodic=False)
    assert (found.number, found.n_small, found.small_area) == (1, 2, 2.0)
    assert found.mean_area == found.area_weighted_mean == 8.0
    both = patches_of(drawn, PIXEL, periodic=False, fewest_pixels=1)
    assert both.mean_area == pytest.approx(10.0 / 3.0)
    assert both.area_weighted_mean == pytest.approx((64.0 + 1.0 + 1.0) / 10.0)
    assert both.area_weighted_mean >= both.mean_area


def test_the_density_counts_each_patch_once():
    areas = np.random.default_rng(1).random((200, 200)) < 0.3
    found = patches_of(areas, PIXEL, True, 4, 1)
    classes = patch_density(found, per_decade=4)
    assert classes.number.sum() == found.number
    assert found.areas.sum() == pytest.approx(areas.sum())  # pixels of area 1
    assert (np.diff(classes.area) > 0.0).all()
    first = classes.number[0] / (10.0**0.25 - 1.0) / found.window_area
    assert classes.density[0] == pytest.approx(first)


@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
def test_no_contact_and_full_contact():
    x = 2.0 * np.pi * np.arange(16) / 16
    heights = 1e-9 * (np.cos(x)[:, None] + np.cos(x)[None, :])
    solid = ck.Material(young_modulus=1e9, poisson_ratio=0.3)
    none, full = (ck.press(heights, 1e-9, solid, p) for p in (0.0, 5e9))
    assert contact_patches(none).number == contact_patches(none).n_small == 0
    assert contact_patches(none).mean_area is None
    assert contact_patches(none).area_weighted_mean is None
    assert patch_density(contact_patches(none)).area.size == 0
    found = contact_patches(full)
    assert found.areas.tolist() == [pytest.approx(256e-18)]
    assert found.mean_area == found.area_weighted_mean == pytest.approx(full.contact_area)


def test_impossible_choices_are_refused():
    drawn = spots("#. .#")
    for wrong in ({"connectivity": 6}, {"fewest_pixels": 0}, {"fewest_pixels": 1.5}):
        with pytest.raises(DescriptionError, match=next(iter(wrong))):
            patches_of(drawn, PIXEL, True, **wrong)
    with pytest.raises(DescriptionError, match="per_decade"):
        patch_density(patches_of(drawn, PIXEL, True), per_decade=0)
