"""Stress below windows that repeat along one axis: line contact, both axes, wide maps."""

from __future__ import annotations

import numpy as np
import pytest

import contactkit as ck
from contactkit.elasticity.layer_stack import Layers
from contactkit.elasticity.stress.planes import planes
from contactkit.elasticity.stress.tractions import Tractions

HALF, FILM = Layers([1.0], [0.3]), Layers([4.0, 1.0], [0.3, 0.2], [2.0])


def smooth(n, m):
    across = np.exp(-(((np.arange(n) - 0.5 * (n - 1)) / 4.0) ** 2))
    return across[:, None] * (1.0 + 0.5 * np.cos(2.0 * np.pi * np.arange(m) / m))


@pytest.mark.parametrize("reading", ["spline", "trigonometric"])
@pytest.mark.parametrize("along", ["x", "y"])
def test_below_a_line_contact_the_stress_is_hertzs(along, reading):
    """On the axis: Johnson 1985, Eq. 4.46, in plane strain."""
    n, m, a, nu = 129, 4, 0.25, 0.3
    size = 1.0 / n
    y = (np.arange(n) - n // 2) * size
    pressure = np.repeat(np.sqrt(np.maximum(1.0 - (y / a) ** 2, 0.0))[:, None], m, axis=1)
    if along == "y":
        pressure = pressure.T
    load = Tractions((size, size), pressure)
    centre = tuple(count // 2 for count in pressure.shape)
    for at in planes(load, HALF, [0.1, 0.196, 0.5, 1.0], mean=along, reading=reading):
        xx, yy, zz, *_ = at.stress[(slice(None), *centre)]
        own, across = (xx, yy) if along == "x" else (yy, xx)
        root = np.hypot(a, at.depth)
        lateral = -((a * a + 2.0 * at.depth**2) / root - 2.0 * at.depth) / a
        expected = [nu * (lateral - a / root), lateral, -a / root]
        np.testing.assert_allclose([own, across, zz], expected, atol=5e-4)


@pytest.mark.parametrize("layers", [HALF, FILM, Layers([1.0], [0.4], [6.0], "bonded")])
def test_a_long_isolated_row_of_periods_is_the_limit(layers):
    """What its ends change falls with their distance."""
    load, depths = smooth(24, 8), [1.0, 4.0]
    strip = list(planes(Tractions((1.0, 1.0), load), layers, depths, mean="x"))
    worst = []
    for count in (15, 45):
        row = Tractions((1.0, 1.0), np.tile(load, (1, count)))
        middle = slice(8 * (count // 2), 8 * (count // 2) + 8)
        free = planes(row, layers, depths, mean="free")
        pairs = zip(strip, free, strict=True)
        worst.append(max(np.abs(s.stress - f.stress[:, :, middle]).max() for s, f in pairs))
    assert worst[1] < 0.04
    assert worst[1] < max(0.45 * worst[0], 3e-4)


def test_pressure_at_depth_adds_up_to_the_load():
    load = smooth(24, 8)
    sheet = Layers([1.0], [0.3], [3.0], "frictionless")
    (at,) = planes(Tractions((1.0, 1.0), load), sheet, [3.0], mean="x")
    assert at.stress[2].sum() == pytest.approx(-load.sum(), rel=3e-3)


def test_a_cylinder_has_its_maximum_where_hertz_has_it():
    """0.300 of the peak pressure at 0.786 half-widths: Johnson 1985, section 4.2."""
    width, n = 100e-6, 96
    solid = ck.Material(young_modulus=1e9, poisson_ratio=0.3)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid),
            upper=ck.Body(surface=ck.Paraboloid(radius=1e6, radius_y=1e-3)),
        ),
        window=ck.Window(width=width / n * 4, height=width, periodic="x"),
        loading=ck.Pressing(force=400.0 * width / n * 4),
        effects=(ck.HalfSpace(), ck.SubsurfaceStress()),
    )
    run = ck.solve(ck.plan(scene, ck.Accuracy(grid=(n, 4))))
    found = run.of(ck.SubsurfaceStress).maxima["tresca"]
    half_width = 2.0 * 400.0 / (np.pi * run.max_pressure)
    assert found.value / run.max_pressure == pytest.approx(0.300, rel=0.01)
    assert found.z / half_width == pytest.approx(0.786, rel=0.1)
