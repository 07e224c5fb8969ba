"""The torque of a tilting plate against quadrature, virtual work and the literature."""

from __future__ import annotations

import math

import pytest
from attrs import evolve
from scipy.integrate import quad
from scipy.optimize import brentq

from contactkit.errors import DescriptionError, InfeasibleError
from contactkit.models.micromirror.electrostatics import (
    Electrode,
    capacitance,
    largest_tilt,
    pull_in,
    torque,
    torque_slope,
)

EPSILON0 = 8.8541878128e-12
PAD = Electrode(width=8e-6, inner=1e-6, outer=5.5e-6, gap=1.5e-6)
TILTS = (-0.3, -0.1, -1e-3, -1e-9, 0.0, 1e-12, 1e-6, 1e-3, 0.05, 0.2, 0.27)


def by_quadrature(pad, tilt, voltage):
    s, d = math.sin(tilt), pad.gap

    def one(x):
        return x / (d - x * s) ** 2

    found, _ = quad(one, pad.inner, pad.outer, epsrel=1e-13, epsabs=0.0)
    return 0.5 * EPSILON0 * pad.width * voltage**2 * math.cos(tilt) * found


@pytest.mark.parametrize("tilt", TILTS)
@pytest.mark.parametrize("inner", [0.0, 1e-6, 5.499999e-6])
def test_the_torque_is_the_integral_of_the_pressure(tilt, inner):
    pad = evolve(PAD, inner=inner)
    assert torque(pad, tilt, 20.0) == pytest.approx(
        by_quadrature(pad, tilt, 20.0), rel=1e-12, abs=0.0
    )


def test_it_is_smooth_where_the_series_hands_over_to_the_logarithm():
    """y = 0.2 lies near a tilt of 0.06 here; a jump would show in the second difference."""
    n, h = 400, 1e-5
    values = [torque(PAD, 0.06 + (i - n // 2) * h, 20.0) for i in range(n)]
    bends = [a - 2 * b + c for a, b, c in zip(values, values[1:], values[2:], strict=False)]
    assert max(bends) - min(bends) < 1e-12 * values[0] + 0.2 * max(bends)


@pytest.mark.parametrize("tilt", [-0.2, 1e-4, 0.1, 0.25])
def test_virtual_work(tilt):
    """T = V^2/2 dC/dtheta, and the slope is that of the torque."""
    h = 1e-6
    rise = capacitance(PAD, tilt + h) - capacitance(PAD, tilt - h)
    assert torque(PAD, tilt, 20.0) == pytest.approx(200.0 * rise / (2 * h), rel=1e-7)
    change = torque(PAD, tilt + h, 20.0) - torque(PAD, tilt - h, 20.0)
    assert torque_slope(PAD, tilt, 20.0) == pytest.approx(change / (2 * h), rel=1e-6)


def test_a_level_plate_is_a_condenser():
    area = PAD.width * (PAD.outer - PAD.inner)
    assert capacitance(PAD, 0.0) == pytest.approx(EPSILON0 * area / PAD.gap, rel=1e-15)
    arm = 0.5 * (PAD.outer + PAD.inner)
    pressure = 0.5 * EPSILON0 * (20.0 / PAD.gap) ** 2
    assert torque(PAD, 0.0, -20.0) == pytest.approx(pressure * area * arm, rel=1e-15)


def test_the_pull_in_angle_is_that_of_the_literature():
    """Whole electrode, small tilts: 3 G = q^2/(1 - q)^2 with G = ln(1 - q) + q/(1 - q)."""
    q = brentq(
        lambda q: 3.0 * (math.log1p(-q) + q / (1 - q)) - (q / (1 - q)) ** 2, 0.1, 0.9, xtol=1e-15
    )
    assert q == pytest.approx(0.4404, abs=5e-5)
    pad = Electrode(width=1e-4, outer=1e-3, gap=1e-6)
    found = pull_in(pad, 1e-9)
    assert found.tilt / largest_tilt(pad) == pytest.approx(q, rel=1e-6)
    shape = math.log1p(-q) + q / (1 - q)
    theta = q * pad.gap / pad.outer
    square = 2e-9 * theta**3 / (EPSILON0 * pad.width * shape)
    assert found.voltage == pytest.approx(math.sqrt(square), rel=1e-6)


@pytest.mark.parametrize("inner", [0.0, 1e-6, 4e-6])
def test_pull_in_is_the_highest_voltage_of_a_balance(inner):
    pad, k = evolve(PAD, inner=inner), 2e-13
    found = pull_in(pad, k)

    def balance(tilt):
        return math.sqrt(k * tilt / torque(pad, tilt, 1.0))

    assert balance(found.tilt) == pytest.approx(found.voltage, rel=1e-12)
    for aside in (0.99, 1.01):
        assert balance(aside * found.tilt) < found.voltage
    # A stiffer hinge takes more voltage, to the same tilt.
    assert pull_in(pad, 4 * k).tilt == pytest.approx(found.tilt, rel=1e-12)
    assert pull_in(pad, 4 * k).voltage == pytest.approx(2 * found.voltage, rel=1e-12)


def test_lengths_scale():
    large = Electrode(width=8e-3, inner=1e-3, outer=5.5e-3, gap=1.5e-3)
    assert torque(large, 0.2, 7.0) == pytest.approx(1e3 * torque(PAD, 0.2, 7.0), rel=1e-13)


def test_close_to_the_electrode_and_beyond():
    edge = largest_tilt(PAD)
    tilt = edge * (1 - 1e-9)
    s, d = math.sin(tilt), PAD.gap
    far, near = d - PAD.inner * s, d - PAD.outer * s
    textbook = (math.log(near / far) + d / near - d / far) / s**2
    factor = 0.5 * EPSILON0 * PAD.width * math.cos(tilt)
    assert torque(PAD, tilt, 1.0) == pytest.approx(factor * textbook, rel=1e-12)
    with pytest.raises(InfeasibleError, match=r"the plate meets the electrode at a tilt of 0\.276"):
        torque(PAD, edge * (1 + 1e-9), 1.0)


def test_a_plate_that_never_touches():
    pad = Electrode(width=1e-6, outer=1e-6, gap=5e-6)
    assert largest_tilt(pad) == pytest.approx(math.pi / 2)
    with pytest.raises(
        InfeasibleError,
        match=r"never meets the electrode.*raise Electrode\.outer",
    ):
        pull_in(pad, 1e-12)


def test_an_electrode_needs_an_extent():
    with pytest.raises(DescriptionError, match=r"Electrode\.inner must be less than outer = 1e-06"):
        Electrode(width=1e-6, inner=1e-6, outer=1e-6, gap=1e-6)
