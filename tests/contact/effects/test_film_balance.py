"""Balance of load and film on pixels: alike at any tolerance, and what its steps leave open."""

from __future__ import annotations

import functools
import warnings

import numpy as np
import pytest
from selection import quick

import contactkit as ck

pytestmark = pytest.mark.hard

LOADS = [1e4, 2.3e5, 2e7]


def scene(pressure, *, pulls=True, pixels=64):
    solid = ck.Material(young_modulus=30e9, poisson_ratio=0.45)
    rough = ck.SelfAffineRoughness(
        rms=1.5e-9, hurst=0.7, rolloff=0.6e-6, cutoff=2e-6 * 8 / 64, seed=5
    )
    water = ck.Meniscus(
        liquid=ck.load_liquid("water"), contact_angle_lower=0.7, contact_angle_upper=0.7
    )
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid), upper=ck.Body(surface=rough), meniscus=water
        ),
        window=ck.Window(width=2e-6),
        loading=ck.Pressing(pressure=pressure),
        effects=(ck.HalfSpace(), ck.FilmMeniscus(film_thickness=0.5e-9, self_consistent=pulls)),
    )


@functools.cache
def solved(pressure, rtol=1e-8, **given):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        return ck.solve(ck.plan(scene(pressure, **given), ck.Accuracy(grid=64, rtol=rtol)))


@pytest.mark.parametrize("pressure", quick(LOADS, 1))
@pytest.mark.parametrize("rtol", quick([1e-3, 1e-5], 0))
def test_a_loose_tolerance_leaves_the_balance_where_it_is(pressure, rtol):
    loose, tight = solved(pressure, rtol), solved(pressure)
    assert loose.contact_area == tight.contact_area
    film, same = loose.of(ck.FilmMeniscus), tight.of(ck.FilmMeniscus)
    assert film.force == pytest.approx(same.force, rel=1e-7)
    assert loose.residual <= 1e-8


@pytest.mark.slow
def test_a_flat_balance_states_how_far_others_are():
    pressure = 1e6
    result = solved(pressure)
    film, area = result.of(ck.FilmMeniscus), result.plan.grid.area
    others = []
    for off in np.linspace(-0.05, 0.05, 21):
        load = film.equilibria[0] * (1.0 + off)
        alone = solved(load / area, 1e-7, pulls=False).of(ck.FilmMeniscus).force
        if (pressure * area + alone > load) == (off > 0.0):
            others.append(abs(off))
    assert max(others) > 0.02
    assert film.balance_error > 0.5 * max(others)


def test_a_balance_that_others_are_near_to_is_reported():
    assert solved(1e8).of(ck.FilmMeniscus).balance_error < 0.01
    with pytest.warns(ck.ValidityWarning, match="range of the film balance"):
        ck.solve(ck.plan(scene(1e6), ck.Accuracy(grid=64)))
