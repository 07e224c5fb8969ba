"""Menisci of a thin film: islands by brute force, areas of known shapes, the limit of a sphere."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from contactkit.capillary.film_islands import film_force, islands, meniscus_area
from contactkit.roughness.elementary import paraboloid
from contactkit.roughness.random_surfaces import gaussian_exponential

MASKS = arrays(bool, st.tuples(st.integers(1, 7), st.integers(1, 7)))
GAPS = arrays(
    np.float64,
    st.tuples(st.integers(1, 7), st.integers(1, 7)),
    elements=st.sampled_from([0.0, 0.5, 1.5, 2.5]),
)
CONNECTIVITY = st.sampled_from([4, 8])
EDGES = st.sampled_from([True, False, "x", "y"])


def neighbours(i, j, shape, periodic, connectivity):
    for a in (-1, 0, 1):
        for b in (-1, 0, 1):
            if (a, b) == (0, 0) or (connectivity == 4 and a and b):
                continue
            k, m = i + a, j + b
            along_y = periodic in (True, "y") or 0 <= k < shape[0]
            along_x = periodic in (True, "x") or 0 <= m < shape[1]
            if along_y and along_x:
                yield k % shape[0], m % shape[1]


def flood(mask, periodic, connectivity):
    """Islands as sets of pixels, by walking from pixel to pixel."""
    left = {tuple(map(int, at)) for at in np.argwhere(mask)}
    found = []
    while left:
        island, edge = set(), [left.pop()]
        while edge:
            at = edge.pop()
            island.add(at)
            near = set(neighbours(*at, mask.shape, periodic, connectivity)) & left
            left -= near
            edge += near
        found.append(frozenset(island))
    return set(found)


# Islands ------------------------------------------------------------------------------------


@given(MASKS, EDGES, CONNECTIVITY)
def test_islands_are_those_of_a_walk(mask, periodic, connectivity):
    names, n = islands(mask, periodic, connectivity)
    found = {
        frozenset(tuple(map(int, at)) for at in np.argwhere(names == k)) for k in range(1, n + 1)
    }
    assert found == flood(mask, periodic, connectivity)
    np.testing.assert_array_equal(names > 0, mask)


@pytest.mark.parametrize(
    ("periodic", "connectivity", "n"), [(False, 4, 3), (False, 8, 3), (True, 4, 2), (True, 8, 1)]
)
def test_islands_meet_across_edges_and_corners(periodic, connectivity, n):
    """Two pixels meet over an edge; the third meets the first over the corner of the window."""
    mask = np.zeros((5, 6), dtype=bool)
    mask[0, 0] = mask[0, 5] = mask[4, 1] = True
    assert islands(mask, periodic, connectivity)[1] == n


@given(GAPS, st.booleans(), CONNECTIVITY)
def test_the_meniscus_is_on_wetted_islands_and_not_in_contact(gap, periodic, connectivity):
    contact = gap == 0.0
    found = meniscus_area(gap, 1.0, 2.0, contact, periodic, connectivity)
    wetted = [i for i in flood(gap < 2.0, periodic, connectivity) if min(gap[at] for at in i) < 1.0]
    pixels = {at for island in wetted for at in island}
    assert {tuple(map(int, at)) for at in np.argwhere(found.meniscus)} == {
        at for at in pixels if not contact[at]
    }
    assert found.n_wetted_cut == len(pixels)
    assert found.n_meniscus == len(pixels) - int(contact.sum())
    assert found.n_islands == len(wetted)
    assert found.n_cut == int((gap < 2.0).sum())
    assert found.n_islands + found.n_dry_islands == len(flood(gap < 2.0, periodic, connectivity))


@given(GAPS, CONNECTIVITY, st.integers(-9, 9), st.integers(-9, 9))
def test_a_periodic_map_may_be_rolled(gap, connectivity, down, right):
    def found(heights):
        return meniscus_area(heights, 1.0, 2.0, heights == 0.0, True, connectivity)

    rolled = found(np.roll(gap, (down, right), axis=(0, 1)))
    assert rolled[1:] == found(gap)[1:]
    np.testing.assert_array_equal(
        rolled.meniscus, np.roll(found(gap).meniscus, (down, right), (0, 1))
    )


@given(GAPS, st.booleans(), CONNECTIVITY, st.floats(0.1, 3.0), st.floats(0.0, 3.0))
def test_a_thicker_film_wets_no_less(gap, periodic, connectivity, film, more):
    areas = [
        meniscus_area(gap, thickness, 2.0, gap == 0.0, periodic, connectivity).n_meniscus
        for thickness in (film, film + more)
    ]
    assert areas[0] <= areas[1]


def test_every_island_is_wetted_where_film_and_meniscus_are_equally_high():
    heights = gaussian_exponential((96, 128), (0.1, 0.1), 1.0, 1.5, 0.4, seed=3)
    gap = heights.max() - heights
    found = meniscus_area(gap, 1.5, 1.5, gap == 0.0, True)
    assert found.n_islands > 1
    assert found.n_wetted_cut == found.n_cut == int((gap < 1.5).sum())
    assert found.n_dry_islands == 0


def test_without_a_film_there_is_no_meniscus():
    gap = np.array([[0.0, 1.0], [1.0, 2.0]])
    found = meniscus_area(gap, 0.0, 1.5, gap == 0.0, True)
    assert (found.n_meniscus, found.n_islands, found.n_dry_islands) == (0, 0, 1)


# Areas and forces ---------------------------------------------------------------------------


def test_a_row_of_ridges_has_the_area_of_its_strips():
    """Ridges of a cosine: each strip is where the gap is below the height, dry in the middle."""
    nx, height, dry = 4096, 0.3, 0.02
    x = np.arange(nx) * (2.0 * math.pi / nx) * 4.0
    gap = np.broadcast_to(1.0 - np.cos(x), (3, nx))
    found = meniscus_area(gap, 0.1, height, gap < dry, periodic=True)
    fraction = (math.acos(1.0 - height) - math.acos(1.0 - dry)) / math.pi
    # Two edges on each side of four ridges, each off by one pixel at most.
    assert found.n_meniscus / gap.size == pytest.approx(fraction, abs=16 / nx)
    assert found.n_islands == 4


@pytest.mark.parametrize("n", [101, 400])
def test_a_sphere_is_pulled_as_in_the_classical_limit(n):
    radius, height, tension, lower, upper = 1e-3, 2e-9, 0.07275, 0.3, 1.1
    pixel = 3.0 * math.sqrt(2.0 * radius * height) / n
    gap = -paraboloid((n, n), (pixel, pixel), radius)
    found = meniscus_area(gap, height, height, np.zeros(gap.shape, dtype=bool), periodic=False)
    force = film_force(found.n_meniscus * pixel**2, tension, lower, upper, height)
    classical = 2.0 * math.pi * radius * tension * (math.cos(lower) + math.cos(upper))
    # Pixels of a disc of r pixels: off by about r^(2/3) of pi r^2.
    assert float(force) == pytest.approx(classical, rel=(n / 3.0) ** (-4.0 / 3.0))
    assert found.n_islands == 1


def test_the_pressure_of_the_source_acts_on_the_area():
    """Water at 60 degrees under a gap of 1 nm: 72.75 MPa."""
    pressure = film_force(1.0, 0.07275, math.pi / 3, math.pi / 3, 1e-9)
    assert float(pressure) == pytest.approx(72.75e6, rel=1e-14)


def test_a_film_that_does_not_wet_pushes():
    assert film_force(1e-12, 0.07, 2.0, 2.0, 1e-9) < 0.0
    forces = film_force([1e-12, 2e-12], 0.07, 0.0, [[0.0], [math.pi]], 1e-9)
    np.testing.assert_allclose(forces, [[1.4e-4, 2.8e-4], [0.0, 0.0]], rtol=1e-14, atol=1e-20)
