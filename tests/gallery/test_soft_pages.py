"""Pages on films between bodies that deform notice a modulus or viscosity wrong by 30 %."""

from __future__ import annotations

import importlib
import math

import numpy as np
import pytest

import contactkit as ck
from contactkit.gallery.deforming.soft_spheres import (
    GAP,
    RADIUS,
    VISCOSITY,
    half_space,
    wet_sphere,
)
from contactkit.gallery.second_method.unbounded_film import UnboundedFilm

WRONG = 1.3
PAGES = ("vibrating_film", "sticking_sphere", "soft_approach", "wet_rebound")
slow, exhaustive = pytest.mark.slow, pytest.mark.exhaustive


def stiffer(patch):
    solid = ck.Material
    patch.setattr(
        ck,
        "Material",
        lambda young_modulus, **more: solid(young_modulus=WRONG * young_modulus, **more),
    )


def thicker(patch):
    liquid = ck.Liquid
    patch.setattr(
        ck, "Liquid", lambda viscosity, **more: liquid(viscosity=WRONG * viscosity, **more)
    )


def moduli(distance, modulus=1e6):
    """G' and G'' of contactkit and of the second method at D/D_c, over 6 pi eta omega R^2/D."""
    frequency = (8.0 * distance) ** -1.5
    omega = frequency * 1e6 / VISCOSITY * (GAP / RADIUS) ** 1.5
    curve = ck.modulus_curve(wet_sphere(half_space(modulus), 200.0), [omega / math.tau])
    rigid = 6.0 * math.pi * VISCOSITY * omega * RADIUS**2 / GAP
    film = UnboundedFilm(24, math.sqrt(2.0 * max(1.0, 1.0 / distance)))
    other = film.modulus(1.0, frequency) / (6.0 * math.pi * frequency)
    ours = np.array([curve.storage_modulus[0], curve.loss_modulus[0]]) / rigid
    return ours, np.array([other.real, other.imag])


@pytest.mark.parametrize("distance", [10.0, 1.0, 0.3])
def test_moduli_are_those_of_the_second_method(distance):
    ours, other = moduli(distance)
    np.testing.assert_allclose(ours, other, rtol=3e-4)
    wrong, _ = moduli(distance, WRONG * 1e6)
    assert np.abs(wrong / other - 1.0).max() > 0.05


def test_the_second_method_has_the_closed_limits():
    frequency = 1e-4
    found = UnboundedFilm(16, math.sqrt(2.0)).modulus(1.0, frequency)
    stiff = 27.0 * math.pi**3 / 2.0**3.5 * frequency**2
    assert found.real == pytest.approx(stiff, rel=1e-3)
    assert found.imag == pytest.approx(6.0 * math.pi * frequency, rel=1e-6)
    # A half-space that a film in no gap holds: F ~ (i omega)^(1/3).
    plateau = UnboundedFilm(32, 4.0).modulus(0.0, 1.0)
    assert plateau.real / plateau.imag == pytest.approx(math.sqrt(3.0), rel=1e-3)


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        pytest.param(name, wrong, marks=slow if (name, wrong) in CHOSEN else exhaustive)
        for CHOSEN in ({("sticking_sphere", stiffer)},)
        for name in PAGES
        for wrong in (stiffer, thicker)
    ],
)
@pytest.mark.filterwarnings("ignore")
def test_a_page_on_films_notices_what_enters_it(name, wrong, monkeypatch):
    page = importlib.import_module(f"contactkit.gallery.deforming.{name}")
    assert all(one.holds for one in page.check(page.compute(True)))
    with monkeypatch.context() as patch:
        wrong(patch)
        found = page.check(page.compute(True))
    assert [one for one in found if "second method" in one.statement and not one.holds]
